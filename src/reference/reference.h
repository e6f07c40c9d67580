/* SPDX-License-Identifier: MIT
 *
 * The brute-force renderer: every pixel is the mean of jittered samples, each the exact mirror of one ray at the first hit
 * of the displaced surface. Double precision throughout; shares no code with the kernels it judges.
 *
 * Samples. quality.spatial_samples N and time_samples M give N·N·M strata of (pixel area × shutter): one sample in each,
 * jittered in x, y and time by a hash of (seed, pixel x, pixel y, sample index) alone. Every N·N consecutive samples cover all
 * spatial strata, with the time strata interleaved; all N·N·M cover each pair once. With shutter 0 every sample shows scene.time.
 *
 * Coverage of a sample is 1 when the mirrored ray lies within a light's angular radius and that light's centre stands at or
 * above the horizon. Only the first hit counts; nothing shadows the mirrored ray.
 *
 * Sums over samples are exact (base/exact_sum.h): whatever the order and the ranges in which samples are taken, their sums have the same bits.
 *
 * With quality.light_cells samples show the sky alone, and mirrored lights are found as light_cells.h tells, all of them whatever the range of samples.
 * Coverage is then an estimate that may exceed 1 a little.
 */
#ifndef MANGATA_REFERENCE_REFERENCE_H
#define MANGATA_REFERENCE_REFERENCE_H

#include <stddef.h>
#include <stdint.h>

#include "mangata/mangata.h"
#include "reference/light.h"

/* Radiances for the colour layer, in any unit. Read while frames render, from several threads. */
typedef struct reference_sky {
    /* Radiance of the sky without the light's disk, for a unit direction with direction[1] ≥ 0. NULL: black. */
    void (*lookup)(const void *user, const double direction[3], double rgb[3]);
    /* Transmittance and in-scattered light of the air up to water `distance` metres along a unit direction. NULL: there is no air. */
    void (*air)(const void *user, const double direction[3], double distance, double leaves[3], double light[3]);
    /* What stars add in a unit direction with direction[1] ≥ 0; below 0 between them. `pixel_angle`: side in radians of a square of the pixel's solid
     * angle, over which they are spread. NULL: there are none. */
    void (*stars)(const void *user, const double direction[3], double pixel_angle, double rgb[3]);
    const void *user;
    double disks[REFERENCE_LIGHTS][3];                   /* mean over each light's disk, at the observer */
    double body_radiance[3];                             /* leaves the water with the factor 1 − F */
    double foam_sky[3], foam_beams[REFERENCE_LIGHTS][3]; /* what white foam sends up: by the sky, and by each light facing it */
} reference_sky;

typedef struct reference_options {
    mgt_isa isa; /* AUTO: the best; SSE2 and NEON run the one-lane build. Every choice gives the same bits. */

    /* The search steps by bounds on the waves' slope and curvature along the ray: the smaller of the exhaustive bound (all crests
     * aligned) and this many standard deviations. 0: the default, REFERENCE_BOUND_DEVIATIONS. INFINITY: exhaustive alone.
     * A sum of sines of random phases is sub-Gaussian, so a point exceeds k deviations with probability < exp(−k²/2). */
    double bound_deviations;
} reference_options;

#define REFERENCE_BOUND_DEVIATIONS 5.0

typedef struct reference_frame reference_frame;

/* Words of a pixel's sums, two a sum: radiance of red, green and blue, coverage, mask and foam. */
enum { REFERENCE_SUM_WORDS = 12 };

/* Planes of floats, the first pixel being the block's own top left one. Any pointer may be NULL. */
typedef struct reference_result {
    float *color;          /* 3 per pixel */
    float *coverage;       /* 1 */
    float *mask;           /* 1: share of the samples that meet water */
    float *foam;           /* 1: share of the samples' area that foam covers */
    float *depth;          /* 1: metres along the centre ray at scene.time, +inf without water */
    float *normal;         /* 3: of the surface at that hit, (0,0,0) without water */
    size_t row_stride;     /* pixels from a row to the next; 0: the block's width */
    const uint64_t *sums;  /* of reference_sum_block(), whose means stand in for samples of its own: those of the frame's range; NULL: none */
    size_t sums_stride;    /* pixels from a row of sums to the next; 0: the block's width */
    uint64_t *evaluations; /* adds how often a sum of waves, of all or of the longest, was evaluated for a ray; NULL: not wanted */
} reference_result;

/* Prepares a frame; `scene` must have passed mgt_scene_check(). The scene and its waves are copied, `sky` too (but not what its
 * `user` points to); a NULL `sky` makes the colour layer black. `options` may be NULL. The caller destroys the frame.
 * MGT_ERROR_MEMORY, or MGT_ERROR_UNAVAILABLE when this processor lacks options->isa; *frame is then NULL. */
mgt_status reference_frame_create(reference_frame **frame, const mgt_scene *scene, const reference_sky *sky, const reference_options *options);
void reference_frame_destroy(reference_frame *frame);

/* Samples that run side by side: 1, 4 or 8. */
uint32_t reference_frame_lanes(const reference_frame *frame);

/* Renders the pixels [x0, x0 + width) × [y0, y0 + height) of the whole image, blocks of any size in any order from any number
 * of threads. Uses about 400 KiB of stack and allocates nothing. */
void reference_render_block(const reference_frame *frame, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, const reference_result *result);

/* Adds the frame's samples of a block to sums, the first ones being those of the block's own top left pixel. As above, but for light_cells, which
 * belong to pictures. */
void reference_sum_block(const reference_frame *frame, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, uint64_t *sums, size_t row_stride);

#endif
