/* SPDX-License-Identifier: MIT */
/* Structural similarity: Wang et al., "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004. Private to
 * src/image and its tests. */
#ifndef MANGATA_IMAGE_METRICS_SSIM_H
#define MANGATA_IMAGE_METRICS_SSIM_H

#include <stddef.h>
#include <stdint.h>

enum { SSIM_BUFFERS = 7, SSIM_RADIUS = 5 };

/* Mean SSIM of two grey pictures whose values span 0 … 1: Gaussian window of 11 × 11 with σ 1.5, K1 = .01, K2 = .03, over the places where
 * the window lies inside, or over all where there are none. `map`: SSIM of every pixel, or NULL. `buffers`: SSIM_BUFFERS · width · height
 * floats of scratch. */
double ssim_mean(const float *a, const float *b, uint32_t width, uint32_t height, float *map, float *buffers);

#endif
