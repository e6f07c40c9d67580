/* SPDX-License-Identifier: MIT
 * Sine waves of a frame, prepared for tiles, for the first-hit search and for the map of slope moments. Only the implementation of sines reads the members of
 * the structs. */
#ifndef MANGATA_FRAME_SINES_H
#define MANGATA_FRAME_SINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "frame/foam.h"
#include "frame/kernel_data.h"
#include "kernels/common/constants.h"
#include "mangata/mangata.h"

/* Floats between arrays whose starts would otherwise share a set of the processor's cache. */
enum { KEY_GAP = 16 };

/* The waves over an interval of time relative to a camera, shared by all tiles. They are sorted by amplitude, the largest first. */
typedef struct wave_set {
    ViewData view;
    WaveData data[MGT_MAX_WAVES]; /* without phases, which tiles add */
    /* An array for each of the first SORT_KEYS members of SortData, padded with zeros for the widest lanes. */
    float keys[SORT_KEYS][MGT_MAX_WAVES + KEY_GAP];
    bool has_foam;
    foam_set foam;
    float skyline[SKYLINE_MOST][2]; /* if view.skyline is 1: slope of the ray to the highest crest in a direction, and the crest's distance, metres */
} wave_set;

/* A point of the mean surface, relative to which phases are given, and an interval of time. */
typedef struct wave_meeting {
    double x, z;         /* metres */
    double middle, half; /* middle and half length of the interval, seconds */
    double turns;        /* added to every phase, turns: 1/2 turns the surface upside down */
} wave_meeting;

/* Fills `order` with the waves' indices by falling amplitude. */
void sines_order(const mgt_water *water, uint16_t *order);

/* Fills a set, except for the members of `view` that depend on the camera. */
void sines_place(const mgt_water *water, const uint16_t *order, wave_meeting at, wave_set *set);

/* Fills `out` with the sort keys of the set's waves, for the GPU. */
void sines_sort_data(const wave_set *set, SortData *out);

/* Fills `out` with the set's waves for rays that search the surface, relative to the point under the camera. */
void sines_for_rays(const wave_set *set, SearchWave *out);

/* Variances of the slopes and of the second derivatives of the set's `count` largest waves. */
void sines_first(const wave_set *set, int count, double *slope, double *bend);

/* Variance of the heights of the set's waves from the i-th on, metres². */
double sines_lesser_variance(const wave_set *set, int i);

/* Number of the set's waves with an amplitude above 0; they come first. */
int sines_moving(const wave_set *set);

/* Fills `out` with the scene's waves for rays that search the surface, with phases at the point (at.x, at.z) and the interval's middle. */
void sines_searched(const mgt_water *water, wave_meeting at, SearchWave *out);

/* Height above the mean surface that the waves seldom exceed, metres: four standard deviations, or the sum of the amplitudes if that is less. */
double sines_crest(const mgt_water *water);

/* Slope that the waves seldom exceed, by the same rule. */
double sines_steepest(const mgt_water *water);

/* Second derivative that the waves seldom exceed, by the same rule, 1/metre. */
double sines_sharpest(const mgt_water *water);

/* Relative compression by choppiness that the water seldom exceeds, at most .9; 0: the waves are sines. */
double sines_pressed(const mgt_water *water);

/* RMS distance of the slopes' path over ± half seconds from a straight path: the root of the sum of the waves' slope variances, each times
 * (1 − cos(omega·half))². */
double sines_path_bend(const mgt_water *water, double half);

/* Subtracts the waves' height at `point` from *gap, the height of a ray's point over the mean surface. Subtracts the waves' slope along the direction `ray`
 * from *closing, the derivative of that height along the ray. */
void sines_lower(const mgt_water *water, const double point[2], double time, const double ray[3], double *gap, double *closing);

/* ---- the grid of the map of slope moments of methods lean and leadr ---- */

enum {
    LEAN_LEVELS = 13,
    LEAN_MOMENTS = 5, /* mean slopes x, z; second moments xx, xz, zz */
    LEAN_BLOCK = 16,  /* columns of a block of lean_waves.columns */
    LEAN_ROWS = 4,    /* rows that are filled together */
};

/* Waves that have whole numbers of periods across the map. */
typedef struct lean_waves {
    size_t count;
    double turns[MGT_MAX_WAVES]; /* phase under the camera */
    LeanWave waves[MGT_MAX_WAVES];
    const float *columns; /* only while the map is filled: for each block of columns and each wave LEAN_BLOCK cosines, then LEAN_BLOCK sines */
} lean_waves;

/* Snaps the waves to the map's grid. The returned rest_… members hold the slope covariance of waves that are too short for the grid. */
LeanData sines_snap(const mgt_water *water, wave_meeting at, lean_waves *out);

/* Phase of wave i that the columns up to `column` add, in units of 1/LEAN_SIZE turn. */
static inline unsigned lean_column_part(const lean_waves *w, size_t i, size_t column) { return (unsigned)w->waves[i].periods_x * (unsigned)column; }

/* Phase of wave i at the beginning of a row, radians. */
double lean_row_angle(const lean_waves *waves, size_t i, size_t row);

static inline LeanWave lean_wave(const lean_waves *w, size_t i) { return w->waves[i]; }

#endif
