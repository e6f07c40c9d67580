/* SPDX-License-Identifier: MIT */
/* Pixels as text for a page: real values, packed small. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_PIXELS_H
#define MANGATA_CLI_COMPARE_COMPARE_PIXELS_H

#include <stddef.h>
#include <stdint.h>

#include "image/picture.h"

/* Base64 of a zlib stream of half floats times `scale`; cli/compare/page/1-pixels.js is its reader. Per channel (of three: G, R − G, B − G,
 * differences of the bits modulo 2¹⁶) each pixel's bits minus those of its left neighbour (of the one above in the first column), modulo
 * 2¹⁶; first the high bytes of all, then the low ones. The caller frees the text; NULL when memory runs out. */
char *pixels_pack(const float_image *image, float scale, size_t *length);

/* IEEE half precision of `value`, rounded to nearest; beyond its range the largest number, NaN as 0. */
uint16_t half_from_float(float value);

#endif
