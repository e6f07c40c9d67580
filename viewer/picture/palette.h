/* SPDX-License-Identifier: MIT
 * The colours that stand for numbers: one palette for amounts, one for signed differences. */
#ifndef MANGATA_VIEWER_PICTURE_PALETTE_H
#define MANGATA_VIEWER_PICTURE_PALETTE_H

#include <stdint.h>

typedef enum palette_kind { PALETTE_AMOUNT = 0, PALETTE_DIFFERENCE = 1 } palette_kind;
enum { PALETTE_KINDS = 2, PALETTE_STEPS = 256 };

/* 0xRRGGBBAA, displayed colour, opaque; `fraction` from 0 to 1. Lightness rises with an amount; a difference of 0 is in the middle and dark. */
uint32_t palette_color(palette_kind kind, double fraction);

/* The colour of a normal that leans to (x, z), as a fraction of the lean whose colour is full: hue by direction, dark where the water is level. */
uint32_t palette_lean(double x, double z);

#endif
