/* SPDX-License-Identifier: MIT
 * Palettes, which show numbers as colours: one for amounts, one for signed differences. */
#ifndef MANGATA_VIEWER_PICTURE_PALETTE_H
#define MANGATA_VIEWER_PICTURE_PALETTE_H

#include <stdint.h>

typedef enum palette_kind { PALETTE_AMOUNT = 0, PALETTE_DIFFERENCE = 1 } palette_kind;
enum { PALETTE_KINDS = 2, PALETTE_STEPS = 256 };

/* The palette's opaque displayed colour at `fraction` in [0, 1], as 0xRRGGBBAA. Lightness increases with an amount. A difference of 0 is at 0.5 and is dark. */
uint32_t palette_color(palette_kind kind, double fraction);

/* The colour of a normal whose horizontal part is (x, z), divided by the length that has the full colour. The hue shows the direction. Level water is dark. */
uint32_t palette_lean(double x, double z);

#endif
