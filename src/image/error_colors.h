/* SPDX-License-Identifier: MIT */
/* Colours of error maps, from black by violet, magenta and orange to pale yellow: near to the map "magma" in which the papers of FLIP show theirs, but
 * computed. Lightness L* of CIELAB rises evenly from 0 to 98, so that errors keep their order in grey too. */
#ifndef MANGATA_IMAGE_ERROR_COLORS_H
#define MANGATA_IMAGE_ERROR_COLORS_H

#include <stdint.h>

enum { ERROR_COLORS = 256 };

/* sRGB-encoded colours of errors from 0, the first, to 1, the last. */
void error_colors(uint8_t colors[ERROR_COLORS][3]);

#endif
