/* SPDX-License-Identifier: MIT */
/* FLIP, the difference that a viewer sees when two pictures alternate at the same place. Private to src/image and its tests.
 * Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020; HDR-FLIP: "Visualizing Errors in Rendered High
 * Dynamic Range Images", Eurographics 2021 (short). 0: the same, 1: as unlike as can be. */
#ifndef MANGATA_IMAGE_METRICS_FLIP_H
#define MANGATA_IMAGE_METRICS_FLIP_H

#include <stdint.h>

#include "image/file_error.h"

#define FLIP_PIXELS_PER_DEGREE (3840 * 3.14159265358979323846 / 180) /* 67.0206: a 0.7 m wide screen of 3840 pixels at 0.7 m, as in the papers */

/* Filters and buffers for one size. It keeps nothing of pictures between calls. One thread at a time. */
typedef struct flip flip;

/* `pixels_per_degree`: 4 … 400. Returns FILE_OK, FILE_ARGUMENT or FILE_MEMORY; on failure *result is NULL. */
file_status flip_create(flip **result, uint32_t width, uint32_t height, double pixels_per_degree, file_error *error);
void flip_free(flip *flip);

/* A picture: finite linear light with sRGB's primaries, top row first, with 1 channel (grey) or 3 interleaved ones. */
typedef struct flip_picture {
    const float *pixels;
    uint32_t channels;
} flip_picture;

/* Mean FLIP over the picture. Values are clamped to 0 … 1 first. It is symmetric in A and B. `map`: width · height floats; NULL: not wanted. */
double flip_ldr(flip *flip, flip_picture a, flip_picture b, float *map);

/* `count` exposures, stops, at equal distances from first to last. If `count` is 1, it is the first. */
typedef struct flip_exposures {
    double first, last;
    uint32_t count;
} flip_exposures;

enum { FLIP_EXPOSURES_MAX = 64 };

/* The papers' exposures: from that at which the reference's greatest luminance is tone-mapped to 0.85 to that at which its median is. There is one per stop, at
 * least two and at most FLIP_EXPOSURES_MAX. For an even number of pixels the median is the mean of the two in the middle. If it is 0, the median of positive
 * luminances replaces it. A black picture gives {0, 0, 1}. */
flip_exposures flip_exposures_of(flip *flip, flip_picture reference);

/* Mean HDR-FLIP: the greatest FLIP of each pixel over the exposures. At an exposure, light is multiplied by 2^stops, tone-mapped by Narkowicz's fit of ACES,
 * and clamped. `map`: as in flip_ldr(). */
double flip_hdr(flip *flip, flip_picture a, flip_picture b, const flip_exposures *exposures, float *map);

/* ---- parts, for tests ---- */

/* The tone curve of HDR-FLIP. */
double flip_tone(double light);
/* Its inverse: the light that is mapped to `value`, 0 < value < 1. */
double flip_tone_inverse(double value);

/* Colour difference of a pixel without filters: HyAB in Hunt-adjusted L*a*b*, redistributed to 0 … 1. */
float flip_color_difference(const float a[3], const float b[3]);

#endif
