/* SPDX-License-Identifier: MIT */
/* Colours of error maps, from black over violet, magenta and orange to pale yellow. They are computed and resemble the map "magma" of the papers on FLIP. The
 * lightness L* of CIELAB rises evenly from 0 to 98, so that errors keep their order in grey, too. */
#ifndef MANGATA_IMAGE_ERROR_COLORS_H
#define MANGATA_IMAGE_ERROR_COLORS_H

#include <stdint.h>

enum { ERROR_COLORS = 256 };

/* Fills sRGB-encoded colours. The first one is for the error 0, the last one for the error 1. */
void error_colors(uint8_t colors[ERROR_COLORS][3]);

#endif
