/* SPDX-License-Identifier: MIT
 *
 * Functions on single waves and on sums of waves.
 */
#include "params/waves.h"

#include <math.h>

const field_row wave_rows[] = {{"amplitude", FIELD_NUMBER, offsetof(mgt_wave, amplitude), FIELD_REQUIRED, 0, 1000, "m",
                                .doc = "height of the crest over the mean surface"},
                               {"a", FIELD_NUMBER, offsetof(mgt_wave, kx), FIELD_REQUIRED, -1e5, 1e5, "rad/m", .doc = "wave vector along x", .member = "kx"},
                               {"b", FIELD_NUMBER, offsetof(mgt_wave, kz), FIELD_REQUIRED, -1e5, 1e5, "rad/m", .doc = "wave vector along z", .member = "kz"},
                               {"c", FIELD_NUMBER, offsetof(mgt_wave, omega), FIELD_REQUIRED, -1e5, 1e5, "rad/s", .doc = "angular speed", .member = "omega"},
                               {"phase", FIELD_NUMBER, offsetof(mgt_wave, phase), 0, -1e9, 1e9, "rad", .doc = "phase at x = z = 0, time 0"},
                               {0}};

bool wave_is_legal(const mgt_wave *wave)
{
    for (const field_row *field = wave_rows; field->key; field++)
        if (!field_is_legal(field, field_at(field, wave)))
            return false;
    return true;
}

wave_course wave_course_of(const mgt_wave *wave, double least)
{
    const double k = hypot(wave->kx, wave->kz);
    return k > least ? (wave_course){k, atan2(wave->kx, -wave->kz), -wave->omega / k} : (wave_course){k, 0, 0};
}

void wave_set_course(mgt_wave *wave, wave_course course)
{
    wave->kx = course.number * sin(course.heading);
    wave->kz = -course.number * cos(course.heading);
    wave->omega = fmin(fmax(-course.speed * course.number, -1e5), 1e5);
}

mgt_wave wave_from(double height, double x, double z, double frequency, double phase)
{
    return (mgt_wave){.amplitude = height, .kx = x, .kz = z, .omega = frequency, .phase = phase};
}

void waves_scale(mgt_wave *waves, size_t count, double factor, double most)
{
    for (size_t i = 0; i < count; i++)
        waves[i].amplitude = fmin(waves[i].amplitude * factor, most);
}

double wave_crest(const mgt_wave *wave) { return wave->amplitude; }

double waves_height(const mgt_wave *waves, size_t count, double x, double z, double time)
{
    double height = 0;
    for (size_t i = 0; i < count; i++)
        height += waves[i].amplitude * sin(waves[i].kx * x + waves[i].kz * z + waves[i].omega * time + waves[i].phase);
    return height;
}

wave_variances waves_variances(const mgt_wave *waves, size_t count, double x, double z)
{
    wave_variances sum = {0};
    for (size_t i = 0; i < count; i++) {
        const mgt_wave *w = &waves[i];
        const double variance = w->amplitude * w->amplitude / 2, along = w->kx * x + w->kz * z, across = w->kx * z - w->kz * x;
        sum.height += variance;
        sum.along += variance * along * along;
        sum.across += variance * across * across;
    }
    return sum;
}

wave_numbers wave_numbers_of(const mgt_wave *wave) { return (wave_numbers){wave->amplitude, wave->kx, wave->kz, wave->omega, wave->phase}; }
