/* SPDX-License-Identifier: MIT */
/* FLIP, the difference that a viewer sees when two pictures are flipped at the same place. Private to src/image and its tests.
 * Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020; HDR-FLIP: "Visualizing Errors in Rendered High
 * Dynamic Range Images", Eurographics 2021 (short). 0: the same, 1: as unlike as can be. */
#ifndef MANGATA_IMAGE_METRICS_FLIP_H
#define MANGATA_IMAGE_METRICS_FLIP_H

#include <stdint.h>

#include "image/file_error.h"

#define FLIP_PIXELS_PER_DEGREE (3840 * 3.14159265358979323846 / 180) /* 67.0206: a 0.7 m wide screen of 3840 pixels at 0.7 m, as in the papers */

/* Filters and buffers for one size; holds nothing of the pictures from call to call. One thread at a time. */
typedef struct flip flip;

/* `pixels_per_degree`: 4 … 400. FILE_ARGUMENT, FILE_MEMORY; on failure *flip is NULL. */
file_status flip_create(flip **result, uint32_t width, uint32_t height, double pixels_per_degree, file_error *error);
void flip_free(flip *flip);

/* A picture as FLIP takes it: linear light of sRGB's primaries, top row first, 1 (grey) or 3 interleaved channels, all finite. */
typedef struct flip_picture {
    const float *pixels;
    uint32_t channels;
} flip_picture;

/* Mean over the picture; values are clamped to 0 … 1 first. `map`: width · height floats, or NULL. A and B may be exchanged. */
double flip_ldr(flip *flip, flip_picture a, flip_picture b, float *map);

/* Exposures in stops, evenly spread from first to last; count 1 takes the first alone. */
typedef struct flip_exposures {
    double first, last;
    uint32_t count;
} flip_exposures;

enum { FLIP_EXPOSURES_MAX = 64 };

/* The papers' range: from where the reference's brightest luminance is tone-mapped to 0.85 up to where its median is (of an even number of
 * pixels the mean of the two in the middle); one a stop, at least two, at most FLIP_EXPOSURES_MAX. Where the median is 0, that of the positive
 * luminances stands in; a black picture gives {0, 0, 1}. */
flip_exposures flip_exposures_of(flip *flip, flip_picture reference);

/* HDR-FLIP: the greatest FLIP of each pixel over the exposures, each of 2^stops · light, tone-mapped by Narkowicz's fit of ACES, clamped. */
double flip_hdr(flip *flip, flip_picture a, flip_picture b, const flip_exposures *exposures, float *map);

/* ---- parts, for tests ---- */

/* The tone curve of HDR-FLIP and the light that it maps to `value`, 0 < value < 1. */
double flip_tone(double light);
double flip_tone_inverse(double value);

/* One pixel's colour difference before any filter: HyAB in Hunt-adjusted L*a*b*, redistributed to 0 … 1. */
float flip_color_difference(const float a[3], const float b[3]);

#endif
