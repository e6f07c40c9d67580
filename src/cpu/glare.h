/* SPDX-License-Identifier: MIT
 *
 * Glare is the light that an eye or a lens scatters around bright points. It is a blur pyramid over the finished radiance image.
 */
#ifndef MANGATA_CPU_GLARE_H
#define MANGATA_CPU_GLARE_H

#include "frame/glare_plan.h"
#include "mangata/mangata.h"

/* Runs body(arg, 0) … body(arg, count − 1), in any order and on any threads, and returns when all are done. */
typedef void (*glare_parallel_for)(void *user, size_t count, void (*body)(void *arg, size_t index), void *arg);

/* Sets the image to (1 − glare)·image + glare·(image * spread). The spread falls off about as 1/θ² from a pixel or two to a good part of the picture. It scales
 * with the image's height, and keeps the sum of the picture, because light that would leave over an edge is mirrored back. `rgb` holds `height` rows of width·3
 * floats, `row_stride` ≥ 3·width floats apart, finite and ≥ 0. glare in [0, 1]; 0 leaves the image unchanged. `parallel_for` NULL: serial; the bytes do not
 * depend on it. The call allocates at most half of the image's size. Returns MGT_OK, or MGT_ERROR_MEMORY and leaves the image unchanged. */
mgt_status glare_apply(float *rgb, size_t width, size_t height, size_t row_stride, float glare, glare_parallel_for parallel_for, void *user);

#endif
