/* SPDX-License-Identifier: MIT */
/* Structural similarity: Wang et al., "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004. Private to
 * src/image and its tests. */
#ifndef MANGATA_IMAGE_METRICS_SSIM_H
#define MANGATA_IMAGE_METRICS_SSIM_H

#include <stddef.h>
#include <stdint.h>

enum { SSIM_BUFFERS = 7, SSIM_RADIUS = 5 };

/* Mean SSIM of two grey pictures with values in 0 … 1. The window is a Gaussian of 11 × 11 pixels with σ 1.5; K1 = .01, K2 = .03. The mean is over pixels whose
 * window lies within the picture, or over all pixels if there are none. `map` receives the SSIM of every pixel; NULL: not wanted. `buffers`: scratch memory of
 * SSIM_BUFFERS · width · height floats. */
double ssim_mean(const float *a, const float *b, uint32_t width, uint32_t height, float *map, float *buffers);

#endif
