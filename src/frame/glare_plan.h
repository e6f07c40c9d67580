/* SPDX-License-Identifier: MIT
 * The blur pyramid of glare: its levels, and the fraction of the light that each of them spreads. */
#ifndef MANGATA_FRAME_GLARE_PLAN_H
#define MANGATA_FRAME_GLARE_PLAN_H

#include <stdbool.h>
#include <stddef.h>

enum { GLARE_MAX_LEVELS = 16 };

typedef struct glare_size {
    size_t width, height;
} glare_size;

/* The levels of a picture's pyramid; sizes[0] is half of the image's size. A picture whose pyramid has no levels gets no glare. */
typedef struct glare_plan {
    glare_size image;
    size_t count;
    glare_size sizes[GLARE_MAX_LEVELS];
} glare_plan;

glare_plan glare_plan_of(size_t width, size_t height);

/* Fraction of the light that each level spreads, for glare in [0, 1]; returns the fraction that stays. */
float glare_plan_fractions(const glare_plan *plan, float glare, float fractions[GLARE_MAX_LEVELS]);

/* Fills 4·Σ(width + height) floats: for each level four weights for each column, then four for each row. The weights of column or row i are those of the
 * finer level's pixels 2i − 1 … 2i + 2. Returns false when out of memory. */
bool glare_plan_weights(const glare_plan *plan, float *weights);

/* Fills four weights for each coarse pixel along one axis, and the coarse pixels' masses. `fine_mass` NULL: every fine pixel has the mass 1. */
void glare_weigh_axis(size_t fine_count, const float *fine_mass, size_t coarse_count, float *weights, float *mass);

#endif
