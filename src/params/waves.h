/* SPDX-License-Identifier: MIT
 *
 * Functions on single waves and on sums of waves.
 */
#ifndef MANGATA_PARAMS_WAVES_H
#define MANGATA_PARAMS_WAVES_H

#include "mangata/mangata.h"
#include "params/field.h"

extern const field_row wave_rows[]; /* rows of an mgt_wave */

/* Whether every number is within the range of its row. Numbers that are not finite are in no range. */
bool wave_is_legal(const mgt_wave *wave);

typedef struct wave_course {
    double number;  /* wave number, radians per metre */
    double heading; /* azimuth that the crests travel to, radians; 0 is −z, π/2 is +x */
    double speed;   /* phase speed, metres per second */
} wave_course;

/* The course of a wave. Heading and speed are 0 if the wave number is at most `least`. */
wave_course wave_course_of(const mgt_wave *wave, double least);

/* Sets a wave's wave vector and angular frequency. The frequency is clamped to the range of the API. */
void wave_set_course(mgt_wave *wave, wave_course course);

/* A wave of this amplitude, wave vector, angular frequency and phase. */
mgt_wave wave_from(double height, double x, double z, double frequency, double phase);

/* A wave as height · sin(x·X + z·Z + frequency·t + start), with its amplitude as `height`. */
typedef struct wave_numbers {
    double height, x, z, frequency, start;
} wave_numbers;

wave_numbers wave_numbers_of(const mgt_wave *wave);

/* Multiplies the amplitudes of waves by a factor. Amplitudes are at most `most` metres. */
void waves_scale(mgt_wave *waves, size_t count, double factor, double most);

/* Height of the wave's crest over the mean surface, metres. */
double wave_crest(const mgt_wave *wave);

/* Height of the water at a place and time. */
double waves_height(const mgt_wave *waves, size_t count, double x, double z, double time);

/* Variances of the height, and of the slopes along (x, z) and across it. */
typedef struct wave_variances {
    double height, along, across;
} wave_variances;

wave_variances waves_variances(const mgt_wave *waves, size_t count, double x, double z);

#endif
