/* SPDX-License-Identifier: MIT
 *
 * Single waves for those who make, read and show them.
 */
#ifndef MANGATA_PARAMS_WAVES_H
#define MANGATA_PARAMS_WAVES_H

#include "mangata/mangata.h"
#include "params/field.h"

extern const field_row wave_rows[]; /* of an mgt_wave */

/* Whether every number is within its row's range, which none is that is not finite. */
bool wave_is_legal(const mgt_wave *wave);

/* How a wave travels: its number in radians per metre, where its crests go to (0 is −z, π/2 is +x), and their speed in metres per second. */
typedef struct wave_course {
    double number, heading, speed;
} wave_course;

/* heading and speed are 0 where the number is at most `least`. */
wave_course wave_course_of(const mgt_wave *wave, double least);

/* Bounded to what the API accepts. */
void wave_set_course(mgt_wave *wave, wave_course course);

/* With its wave vector and angular frequency. */
mgt_wave wave_from(double height, double x, double z, double frequency, double phase);

/* What a wave is, for those who add waves up: height · sin(x·X + z·Z + frequency·t + start). */
typedef struct wave_numbers {
    double height, x, z, frequency, start;
} wave_numbers;

wave_numbers wave_numbers_of(const mgt_wave *wave);

/* Multiplies the heights of waves, up to `most` metres. */
void waves_scale(mgt_wave *waves, size_t count, double factor, double most);

/* Of the crest over the mean surface. */
double wave_crest(const mgt_wave *wave);

/* Height of the water at a place and time. */
double waves_height(const mgt_wave *waves, size_t count, double x, double z, double time);

/* Variances of the height, and of the slopes along (x, z) and across it. */
typedef struct wave_variances {
    double height, along, across;
} wave_variances;

wave_variances waves_variances(const mgt_wave *waves, size_t count, double x, double z);

#endif
