/* SPDX-License-Identifier: MIT
 * Waves by length, direction and speed. */
#include "viewer/scene/wave_shape.h"
#include "params/waves.h"
#include "sea/spectrum_model.h"

#include <math.h>

static const double pi = 3.14159265358979323846;
static const double longest = 1e5, shortest = 1e-4; /* limits of wavelengths, metres */

const field_row wave_shape_fields[] = {{"wavelength", FIELD_NUMBER, offsetof(wave_shape, wavelength), 0, 1e-4, 1e5, "m", .doc = "from crest to crest"},
                                       {"direction_deg", FIELD_NUMBER, offsetof(wave_shape, direction_deg), 0, -180, 180, "degrees",
                                        .doc = "where crests travel to: 0 is -z, 90 is +x"},
                                       {"speed", FIELD_NUMBER, offsetof(wave_shape, speed), 0, -1000, 1000, "m/s", .doc = "of the crests, along the direction"},
                                       {0}};

wave_shape wave_shape_of(const mgt_wave *wave)
{
    const wave_course c = wave_course_of(wave, 2 * pi / longest);
    if (!(c.number > 2 * pi / longest))
        return (wave_shape){longest, 0, 0};
    return (wave_shape){fmax(2 * pi / c.number, shortest), c.heading * 180 / pi, c.speed};
}

void wave_set_shape(mgt_wave *wave, const wave_shape *shape)
{
    wave_set_course(wave, (wave_course){2 * pi / fmin(fmax(shape->wavelength, shortest), longest), shape->direction_deg * pi / 180, shape->speed});
}

mgt_wave wave_new(size_t index)
{
    const double golden = 0.6180339887498949, fraction = fmod((double)(index + 1) * golden, 1);
    const double length = 0.5 * pow(8, fraction);
    const wave_shape shape = {length, 80 * (fmod(fraction * 7, 1) - 0.5), sqrt(SPECTRUM_GRAVITY * length / (2 * pi))};
    mgt_wave wave = wave_from(0.008 * length, 0, 0, 0, 2 * pi * fmod(fraction * 5, 1));
    wave_set_shape(&wave, &shape);
    return wave;
}
