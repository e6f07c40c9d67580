/* SPDX-License-Identifier: MIT
 * What a frame prepares of sine waves: as tiles sort them, as the first-hit search bounds them, on the grid of a map of slopes. Only what
 * implements sines looks inside the structs. */
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

/* The waves over an interval as a camera meets them: what is the same for every tile. Sorted by amplitude, the largest first. */
typedef struct wave_set {
    ViewData view;
    WaveData data[MGT_MAX_WAVES]; /* phase left open */
    /* SortData's members, an array each; room for the widest lanes, and zero there. */
    float keys[SORT_KEYS][MGT_MAX_WAVES + KEY_GAP];
    bool has_foam;
    foam_set foam;
    float skyline[SKYLINE_MOST][2]; /* where view.skyline is 1: how high crests rise over the horizon, metres a metre, and how far off they stand, metres */
} wave_set;

/* Where and when waves are met: a point of the mean surface, and an interval of time. `turns` are added to every phase: half of one turns the
 * surface over. */
typedef struct wave_meeting {
    double x, z;
    double middle, half;
    double turns;
} wave_meeting;

/* The waves' numbers by falling amplitude. */
void sines_order(const mgt_water *water, uint16_t *order);

/* Fills the set but for the camera's part of its view. */
void sines_place(const mgt_water *water, const uint16_t *order, wave_meeting at, wave_set *set);

/* The set as the GPU sorts it. */
void sines_sort_data(const wave_set *set, SortData *out);

/* The set's waves as rays look for them from under the camera. */
void sines_for_rays(const wave_set *set, SearchWave *out);

/* Variances of the slopes and of the second derivatives of the set's first waves. */
void sines_first(const wave_set *set, int count, double *slope, double *bend);

/* Variance of the heights of the set's waves from the i-th on, metres². */
double sines_lesser_variance(const wave_set *set, int i);

/* Waves of the set that are not flat; they come first. */
int sines_moving(const wave_set *set);

/* The scene's waves for the light they gather, relative to the point and the interval's middle. */
void sines_searched(const mgt_water *water, wave_meeting at, SearchWave *out);

/* What the waves seldom rise above the mean surface by: four deviations, or their sum where that is less. */
double sines_crest(const mgt_water *water);

/* What their slopes and second derivatives seldom are above, likewise. */
double sines_steepest(const mgt_water *water);
double sines_sharpest(const mgt_water *water);

/* Share of its area that the shift of choppy water seldom takes from it, at most .9; 0: the waves are sines. */
double sines_pressed(const mgt_water *water);

/* Root of the sum of the waves' slope variances, each times (1 − cos(omega·half))²: how far the slopes' path over ± half seconds is from a
 * straight one. */
double sines_path_bend(const mgt_water *water, double half);

/* `gap`, the height of a ray's point over the mean surface, less the waves; `closing`, how fast it grows, likewise. `ray`: its direction. */
void sines_lower(const mgt_water *water, const double point[2], double time, const double ray[3], double *gap, double *closing);

/* ---- the grid of the map of slope moments of methods lean and leadr ---- */

enum {
    LEAN_LEVELS = 13,
    LEAN_MOMENTS = 5, /* mean x, z; second moments xx, xz, zz */
    LEAN_BLOCK = 16,  /* columns side by side in lean_waves.columns */
    LEAN_ROWS = 4,    /* rows filled at a time */
};

/* Waves with whole periods across the map. */
typedef struct lean_waves {
    size_t count;
    double turns[MGT_MAX_WAVES]; /* phase under the camera */
    LeanWave waves[MGT_MAX_WAVES];
    const float *columns; /* while the map is filled: by blocks of columns: for every wave LEAN_BLOCK cosines, then as many sines */
} lean_waves;

/* Snaps the waves to the map's grid. Those too short for it go to the rest. */
LeanData sines_snap(const mgt_water *water, wave_meeting at, lean_waves *out);

/* Parts of LEAN_SIZE of a turn that wave i passes up to a column, and turns up to a row. */
static inline unsigned lean_column_part(const lean_waves *w, size_t i, size_t column) { return (unsigned)w->waves[i].periods_x * (unsigned)column; }
double lean_row_angle(const lean_waves *waves, size_t i, size_t row);

static inline LeanWave lean_wave(const lean_waves *w, size_t i) { return w->waves[i]; }

#endif
