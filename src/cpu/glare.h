/* SPDX-License-Identifier: MIT
 *
 * Glare: the light that the eye (or a lens) scatters around bright points, as a blur pyramid over the finished radiance image.
 */
#ifndef MANGATA_CPU_GLARE_H
#define MANGATA_CPU_GLARE_H

#include "frame/glare_plan.h"
#include "mangata/mangata.h"

/* Runs body(arg, 0) … body(arg, count − 1), in any order and on any threads, and returns when all are done. */
typedef void (*glare_parallel_for)(void *user, size_t count, void (*body)(void *arg, size_t index), void *arg);

/* image := (1 − glare)·image + glare·(image * spread), the spread falling off about as 1/θ² from a pixel or two to a good part of the
 * picture; it depends on the image's height, not on its resolution, and keeps the sum of the picture (what would leave it over an edge
 * is mirrored back). `rgb` holds height rows of width·3 floats, `row_stride` floats apart (≥ 3·width), finite and ≥ 0.
 * glare in [0, 1]; 0 leaves the image untouched. parallel_for NULL: serial. The bytes do not depend on it.
 * Allocates at most half of the image's size during the call. MGT_OK or MGT_ERROR_MEMORY (image untouched). */
mgt_status glare_apply(float *rgb, size_t width, size_t height, size_t row_stride, float glare, glare_parallel_for parallel_for, void *user);

#endif
