/* SPDX-License-Identifier: MIT
 *
 * A frame of the reference renderer, and the batch of rays that its lane builds trace.
 */
#ifndef MANGATA_REFERENCE_REFERENCE_FRAME_H
#define MANGATA_REFERENCE_REFERENCE_FRAME_H

#include <stdint.h>

#include "reference/foam.h"
#include "reference/reference.h"
#include "reference/sines.h"

typedef struct reference_view {
    double position[3]; /* x and z relative to camera.position of scene.camera; y absolute */
    double target[3];   /* in the coordinates of `position` */
    double up[3];
    double fov_half_turns; /* half of the vertical field of view */
} reference_view;

#define REFERENCE_BATCH 512 /* rays; a multiple of every lane count */

/* One batch of rays. The first three arrays are the input. */
typedef struct reference_batch {
    _Alignas(64) double pixel_x[REFERENCE_BATCH]; /* continuous, the pixel (0,0) covers [0,1)² */
    double pixel_y[REFERENCE_BATCH];
    double time_offset[REFERENCE_BATCH]; /* seconds, ≤ 0 */

    double origin_x[REFERENCE_BATCH], origin_y[REFERENCE_BATCH], origin_z[REFERENCE_BATCH];
    double direction_x[REFERENCE_BATCH], direction_y[REFERENCE_BATCH], direction_z[REFERENCE_BATCH];
    double slope_bound[REFERENCE_BATCH], curvature_bound[REFERENCE_BATCH]; /* bounds of the derivatives of the water's height along the ray */
    double start[REFERENCE_BATCH], end[REFERENCE_BATCH];                   /* distances between which the hit is searched, metres */
    double above[REFERENCE_BATCH];                                         /* the last distance known to be above the water */

    double distance[REFERENCE_BATCH];                          /* metres to the first hit; +inf: none; 0: the camera is under the surface */
    double slope_x[REFERENCE_BATCH], slope_z[REFERENCE_BATCH]; /* slope at the hit */
    double rest_x[REFERENCE_BATCH], rest_z[REFERENCE_BATCH];   /* only for choppy water: the hit's place at rest */
    double bend_xx[REFERENCE_BATCH], bend_xz[REFERENCE_BATCH], bend_zz[REFERENCE_BATCH]; /* second derivatives at the hit, 1/metre */

    uint64_t evaluations; /* the number of evaluated sums of waves is added to it */
} reference_batch;

typedef void reference_trace(const reference_frame *frame, reference_batch *batch, uint32_t count);

struct reference_cells;
typedef void reference_judge(const reference_frame *frame, struct reference_cells *cells, uint32_t count);

struct reference_frame {
    mgt_scene scene; /* its water.waves is NULL; the waves are in `waves` */
    reference_sky sky;
    reference_trace *trace, *search, *bend;
    reference_judge *judge;

    reference_view view, view_open;
    double view_scale_x; /* width / height */
    reference_lights *lights;
    bool light_cells; /* mirrored lights are found by light_cells.h */

    double bound_deviations;
    double height_bound; /* the waves' height stays within ± this, metres */

    uint64_t sample_first, sample_count; /* range of the samples; the scene's zeros are replaced by its defaults */
    double most;                         /* limit of what one sample adds, so that the sums cannot overflow */

    uint32_t level_count;
    reference_level levels[REFERENCE_LEVELS];
    reference_columns columns;
    double choppiness; /* < 0: the surface is turned upside down; 0: the waves are sines */
    choppy_level choppy[REFERENCE_LEVELS];
    foam_sea *foam; /* NULL: there is no foam */
    double foam_toward[REFERENCE_LIGHTS][3];
    uint32_t wave_count;
    reference_wave waves[];
};

/* Turns the surface upside down. */
void reference_frame_mirror(reference_frame *frame);

/* Traces a batch of rays through pixels to their first hits. There is a function for each lane count; all give the same bits. */
void reference_trace_1(const reference_frame *frame, reference_batch *batch, uint32_t count);
void reference_trace_4(const reference_frame *frame, reference_batch *batch, uint32_t count);
void reference_trace_8(const reference_frame *frame, reference_batch *batch, uint32_t count);

/* Traces a batch of rays whose origin, unit direction and time_offset are the input. A ray that starts at or under the surface has its hit at its origin. */
void reference_search_1(const reference_frame *frame, reference_batch *batch, uint32_t count);
void reference_search_4(const reference_frame *frame, reference_batch *batch, uint32_t count);
void reference_search_8(const reference_frame *frame, reference_batch *batch, uint32_t count);

/* Fills bend_… of the rays that hit. Call reference_trace_…() or reference_search_…() first. */
void reference_bend_1(const reference_frame *frame, reference_batch *batch, uint32_t count);
void reference_bend_4(const reference_frame *frame, reference_batch *batch, uint32_t count);
void reference_bend_8(const reference_frame *frame, reference_batch *batch, uint32_t count);

/* See light_lanes.h. */
void reference_judge_1(const reference_frame *frame, struct reference_cells *cells, uint32_t count);
void reference_judge_4(const reference_frame *frame, struct reference_cells *cells, uint32_t count);
void reference_judge_8(const reference_frame *frame, struct reference_cells *cells, uint32_t count);

#endif
