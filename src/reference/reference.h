/* SPDX-License-Identifier: MIT
 *
 * The path-traced reference: every pixel is the mean of jittered samples. A sample is a ray that is mirrored at its first hit of the displaced surface. It
 * uses double precision throughout and shares no code with the kernels.
 *
 * Samples. quality.spatial_samples N and time_samples M give N·N·M strata of (pixel area × shutter). Each has one sample, which is jittered in x, y and time by
 * a hash of seed, pixel and sample index alone. N·N consecutive samples cover all spatial strata, with interleaved time strata, and all N·N·M samples cover
 * each pair once. With shutter 0 every sample shows scene.time.
 *
 * The coverage of a sample is 1 if the mirrored ray lies within a light's angular radius and that light's centre stands at or above the horizon. Only the first
 * hit counts, and nothing shadows the mirrored ray.
 *
 * Sums over samples are exact (base/exact_sum.h). Their bits depend neither on the order nor on the ranges in which samples are taken.
 *
 * With quality.light_cells, samples show the sky alone, and mirrored lights come from light_cells.h, whatever the range of samples is. Coverage is then an
 * estimate that may exceed 1 a little.
 */
#ifndef MANGATA_REFERENCE_REFERENCE_H
#define MANGATA_REFERENCE_REFERENCE_H

#include <stddef.h>
#include <stdint.h>

#include "mangata/mangata.h"
#include "reference/light.h"

/* Radiances for the colour layer, in any unit. Several threads read it while frames render. */
typedef struct reference_sky {
    /* Radiance of the sky without the light's disk, for a unit direction with direction[1] ≥ 0. NULL: black. */
    void (*lookup)(const void *user, const double direction[3], double rgb[3]);
    /* Transmittance and in-scattered light of the air up to water `distance` metres along a unit direction. NULL: there is no air. */
    void (*air)(const void *user, const double direction[3], double distance, double leaves[3], double light[3]);
    /* Radiance that stars add in a unit direction with direction[1] ≥ 0. It is negative between stars, because the sky includes their mean. Stars are spread
     * over a square of the pixel's solid angle, whose side is `pixel_angle` radians. NULL: there are no stars. */
    void (*stars)(const void *user, const double direction[3], double pixel_angle, double rgb[3]);
    const void *user;
    double disks[REFERENCE_LIGHTS][3];                   /* mean radiance of each light's disk at the observer, what the horizon hides being black */
    double hidden[REFERENCE_LIGHTS];                     /* fraction of each disk's light that the horizon hides */
    double body_radiance[3];                             /* upwelling radiance; a view gets 1 − F of it, F being Fresnel's reflectance */
    double foam_sky[3], foam_beams[REFERENCE_LIGHTS][3]; /* radiance of foam with albedo 1: by the sky, and by each light for foam that faces it */
} reference_sky;

typedef struct reference_options {
    mgt_isa isa; /* MGT_ISA_AUTO: the best one. SSE2 and NEON run the one-lane build. The bits do not depend on it. */

    /* Number of standard deviations in the bounds of the waves' slope and curvature along the ray, by which the hit search steps. A bound is this many
     * standard deviations or the exhaustive bound, for which all crests are aligned, whichever is smaller. 0: REFERENCE_BOUND_DEVIATIONS. INFINITY: only the
     * exhaustive bound. A sum of sines of random phases is sub-Gaussian, so a point exceeds k deviations with a probability below exp(−k²/2). */
    double bound_deviations;
} reference_options;

#define REFERENCE_BOUND_DEVIATIONS 5.0

typedef struct reference_frame reference_frame;

/* Number of words of a pixel's sums: two for each of the radiances of red, green and blue, coverage, mask and foam. */
enum { REFERENCE_SUM_WORDS = 12 };

/* Planes of floats that begin with the block's top left pixel. Any pointer may be NULL. */
typedef struct reference_result {
    float *color;          /* 3 per pixel: linear RGB */
    float *coverage;       /* 1 per pixel */
    float *mask;           /* 1 per pixel: fraction of the samples that meet water */
    float *foam;           /* 1 per pixel: fraction of the samples' area that foam covers */
    float *depth;          /* 1 per pixel: metres along the centre ray at scene.time; +inf: no water */
    float *normal;         /* 3 per pixel: normal of the surface at the centre ray's hit; (0, 0, 0): no water */
    size_t row_stride;     /* pixels from a row to the next; 0: the block's width */
    const uint64_t *sums;  /* sums by reference_sum_block() over the frame's range of samples, which are then not rendered again; NULL: none */
    size_t sums_stride;    /* pixels from a row of sums to the next; 0: the block's width */
    uint64_t *evaluations; /* the number of evaluated sums of waves per ray is added to it, whether of all waves or of the longest; NULL: not wanted */
} reference_result;

/* Prepares a frame, which the caller destroys. `scene` must have passed mgt_scene_check(). The scene, its waves and *sky are copied, but not the data at
 * sky->user. `sky` NULL: the colour layer is black. `options` NULL: defaults. Returns MGT_OK, MGT_ERROR_MEMORY, or MGT_ERROR_UNAVAILABLE if this processor
 * lacks options->isa; after an error *frame is NULL. */
mgt_status reference_frame_create(reference_frame **frame, const mgt_scene *scene, const reference_sky *sky, const reference_options *options);
void reference_frame_destroy(reference_frame *frame);

/* Renders the pixels [x0, x0 + width) × [y0, y0 + height) of the image. Blocks may have any size and any order, and any number of threads may call. It uses
 * about 400 KiB of stack and allocates nothing. */
void reference_render_block(const reference_frame *frame, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, const reference_result *result);

/* Adds the frame's samples of a block to `sums`, which begin with the block's top left pixel. Otherwise it works like reference_render_block(), without
 * light_cells, which are not sums of samples. */
void reference_sum_block(const reference_frame *frame, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, uint64_t *sums, size_t row_stride);

#endif
