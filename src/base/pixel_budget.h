/* SPDX-License-Identifier: MIT
 * How many pixels pictures that are read may have, as a file of a few kilobytes can hold thousands of millions. */
#ifndef MANGATA_BASE_PIXEL_BUDGET_H
#define MANGATA_BASE_PIXEL_BUDGET_H

#include <stdint.h>

/* The variable of the environment that raises it, and the pixels where it is not set: 7680 x 4320 and a little more. */
#define PIXEL_BUDGET_VARIABLE "MANGATA_PIXELS"
enum { PIXEL_BUDGET_DEFAULT = 1 << 25 };

/* Of one picture, and of all textures of a scene together. */
uint64_t pixel_budget(void);

#endif
