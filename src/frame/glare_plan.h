/* SPDX-License-Identifier: MIT
 * The blur pyramid of glare: its levels, and what each of them spreads. */
#ifndef MANGATA_FRAME_GLARE_PLAN_H
#define MANGATA_FRAME_GLARE_PLAN_H

#include <stdbool.h>
#include <stddef.h>

enum { GLARE_MAX_LEVELS = 16 };

typedef struct glare_size {
    size_t width, height;
} glare_size;

/* The levels of a picture's pyramid; sizes[0] has half of the image's size. No levels: no glare. */
typedef struct glare_plan {
    glare_size image;
    size_t count;
    glare_size sizes[GLARE_MAX_LEVELS];
} glare_plan;

glare_plan glare_plan_of(size_t width, size_t height);

/* Fraction of the light that each level spreads, for glare in [0, 1]; returns the fraction that stays. */
float glare_plan_fractions(const glare_plan *plan, float glare, float fractions[GLARE_MAX_LEVELS]);

/* For each level four weights a column, then four a row, on the finer pixels 2i − 1 … 2i + 2: 4·Σ(width + height) floats. False without
 * memory. */
bool glare_plan_weights(const glare_plan *plan, float *weights);

/* Weights along one axis, four a coarse pixel, and the coarse pixels' masses; `fine_mass` NULL: 1 each. */
void glare_weigh_axis(size_t fine_count, const float *fine_mass, size_t coarse_count, float *weights, float *mass);

#endif
