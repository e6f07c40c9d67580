/* SPDX-License-Identifier: MIT
 * The blur pyramid of glare: its levels, and the fraction of the light that each of them spreads. cpu/glare.c has the mathematics. */
#include "frame/glare_plan.h"
#include "kernels/common/constants.h"

#include <math.h>
#include <stdlib.h>

/* The finest and the coarsest spread of glare, as log2 of a fraction of the image's height: 1/512 and 1/4. */
#define FINEST_OCTAVE (-9.0)
#define COARSEST_OCTAVE (-2.0)

/* ∫ 2^(−x/2) dx, times a constant, over the part of [centre − ½, centre + ½] that lies between the finest and the coarsest octave. */
static double octave_fraction(double centre)
{
    double from = fmax(centre - 0.5, FINEST_OCTAVE), to = fmin(centre + 0.5, COARSEST_OCTAVE);
    return from < to ? exp2(-0.5 * from) - exp2(-0.5 * to) : 0.0;
}

float glare_plan_fractions(const glare_plan *plan, float glare, float fractions[GLARE_MAX_LEVELS])
{
    double all = exp2(-0.5 * FINEST_OCTAVE) - exp2(-0.5 * COARSEST_OCTAVE), spread = 0.0;
    glare = fminf(glare, 1.0f);
    for (size_t k = 0; k < plan->count; ++k) {
        double fraction = glare * octave_fraction((double)(k + 1) - log2((double)plan->image.height)) / all;
        fractions[k] = (float)fraction;
        spread += fraction;
    }
    return (float)(1.0 - spread);
}

void glare_weigh_axis(size_t fine_count, const float *fine_mass, size_t coarse_count, float *weights, float *mass)
{
    for (size_t i = 0; i < coarse_count; ++i) {
        static const float subdivision[4] = {GLARE_FAR, GLARE_NEAR, GLARE_NEAR, GLARE_FAR};
        float *w = &weights[4 * i], sum = 0.0f;
        for (size_t t = 0; t < 4; ++t) {
            bool inside = 2 * i + t >= 1 && 2 * i + t - 1 < fine_count;
            w[t] = inside ? subdivision[t] : 0.0f;
        }
        if (i == 0) {
            w[1] += GLARE_FAR; /* a fine pixel at the edge takes its whole value from the coarse pixel at the edge */
        }
        if (i + 1 == coarse_count && 2 * i + 1 < fine_count) {
            w[2] += GLARE_FAR;
        }
        for (size_t t = 0; t < 4; ++t) {
            if (w[t] > 0.0f) {
                w[t] *= fine_mass ? fine_mass[2 * i + t - 1] : 1.0f;
            }
            sum += w[t];
        }
        mass[i] = sum;
        for (size_t t = 0; t < 4; ++t) {
            w[t] /= sum;
        }
    }
}

bool glare_plan_weights(const glare_plan *plan, float *weights)
{
    const size_t side = plan->image.width + plan->image.height;
    float *masses = malloc(2 * side * sizeof(float)), *mass_x = NULL, *mass_y = NULL;
    if (!masses) {
        return false;
    }
    for (size_t k = 0; k < plan->count; ++k) {
        const glare_size *fine = k ? &plan->sizes[k - 1] : &plan->image, *coarse = &plan->sizes[k];
        float *coarse_x = masses + (k % 2) * side, *coarse_y = coarse_x + coarse->width;
        glare_weigh_axis(fine->width, mass_x, coarse->width, weights, coarse_x);
        glare_weigh_axis(fine->height, mass_y, coarse->height, weights + 4 * coarse->width, coarse_y);
        weights += 4 * (coarse->width + coarse->height);
        mass_x = coarse_x;
        mass_y = coarse_y;
    }
    free(masses);
    return true;
}

/* Levels are added while both sides are longer than a pixel and the next octave is not past the coarsest one. */
glare_plan glare_plan_of(size_t width, size_t height)
{
    glare_plan plan = {.image = {width, height}};
    double octave = 1.0 - log2((double)height);
    while (plan.count < GLARE_MAX_LEVELS && width > 1 && height > 1 && octave - 0.5 < COARSEST_OCTAVE) {
        width = (width + 1) / 2;
        height = (height + 1) / 2;
        octave += 1.0;
        plan.sizes[plan.count++] = (glare_size){width, height};
    }
    return plan;
}
