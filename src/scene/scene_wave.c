/* SPDX-License-Identifier: MIT
 *
 * Single waves of a scene as people measure them.
 */
#include "scene/scene_wave.h"

#include <math.h>

#include "params/waves.h"
#include "sea/spectrum_math.h"
#include "sea/spectrum_model.h"

static const field_row measured_rows[] = {{"wavelength", FIELD_NUMBER, offsetof(measured_wave, wavelength), FIELD_REQUIRED, 1e-4, 1e5, "m",
                                           .doc = "in place of amplitude, a, b and c: from crest to crest, in deep water"},
                                          {"direction_deg", FIELD_NUMBER, offsetof(measured_wave, direction_deg), 0, -1e6, 1e6, "degrees",
                                           .doc = "beside wavelength: where crests travel to, 0 is -z (\"north\"), 90 is +x (\"east\")"},
                                          {"height", FIELD_NUMBER, offsetof(measured_wave, height), FIELD_REQUIRED, 0, 2000, "m",
                                           .doc = "beside wavelength: from trough to crest, twice the amplitude"},
                                          {"phase", FIELD_NUMBER, offsetof(measured_wave, shift), 0, -1e9, 1e9, "rad", .doc = "phase at x = z = 0, time 0"},
                                          {0}};

static void prepare(void *values) { *(measured_wave *)values = (measured_wave){0}; }

/* Sine and cosine of an angle in degrees, exact at whole quarters of a turn. */
static void turn(double degrees, double *sine, double *cosine)
{
    const double quarters = floor(degrees / 90 + 0.5), rest = (degrees - 90 * quarters) * (SPECTRUM_PI / 180);
    const double s = portable_sin(rest), c = portable_cos(rest);
    switch ((int)(quarters - 4 * floor(quarters / 4))) {
    case 0:
        *sine = s, *cosine = c;
        break;
    case 1:
        *sine = c, *cosine = -s;
        break;
    case 2:
        *sine = -s, *cosine = -c;
        break;
    default:
        *sine = -c, *cosine = s;
        break;
    }
}

static void convert(const void *values, void *item)
{
    const measured_wave *wave = values;
    const double number = 2 * SPECTRUM_PI / wave->wavelength;
    double sine, cosine;
    turn(wave->direction_deg, &sine, &cosine);
    *(mgt_wave *)item =
        wave_from(wave->height / 2, seven_digits(number * sine), seven_digits(-number * cosine), seven_digits(-dispersion_frequency(number, 0)), wave->shift);
}

const field_form measured_wave_form = {measured_rows, sizeof(measured_wave), prepare, convert};
