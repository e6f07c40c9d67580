/* SPDX-License-Identifier: MIT */
/* Pixels as compressed text for a page. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_PIXELS_H
#define MANGATA_CLI_COMPARE_COMPARE_PIXELS_H

#include <stddef.h>
#include <stdint.h>

#include "image/picture.h"

/* Packs an image as base64 of a zlib stream, which cli/compare/page/1-pixels.js reads. Values are multiplied by `scale` and rounded to half floats. Three
 * channels are stored as G, R − G and B − G. Each pixel is stored as the difference from its left neighbour, in the first column from the pixel above. All
 * these differences are those of the bits modulo 2¹⁶. The high bytes of all values come first, then the low bytes. The caller frees the text. NULL: out of
 * memory. */
char *pixels_pack(const float_image *image, float scale, size_t *length);

#endif
