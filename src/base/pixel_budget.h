/* SPDX-License-Identifier: MIT
 * The limit on pixels of pictures that are read. It is needed because a file of a few kilobytes can declare billions of pixels. */
#ifndef MANGATA_BASE_PIXEL_BUDGET_H
#define MANGATA_BASE_PIXEL_BUDGET_H

#include <stdint.h>

/* The environment variable that raises the limit. The default is a little more than 7680 x 4320. */
#define PIXEL_BUDGET_VARIABLE "MANGATA_PIXELS"
enum { PIXEL_BUDGET_DEFAULT = 1 << 25 };

/* Largest number of pixels of a picture, and of all textures of a scene together. 0, so that no picture is read, where the variable is no whole number. */
uint64_t pixel_budget(void);

typedef struct pixel_budget_text {
    char text[192];
} pixel_budget_text;

/* What is allowed, for the message that refuses `pixels`: the limit and how it is raised, or what is wrong with the variable. */
pixel_budget_text pixel_budget_allowed(uint64_t pixels);

#endif
