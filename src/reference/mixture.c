/* SPDX-License-Identifier: MIT
 * Mixtures of circular Gaussians against an ellipse, in double precision. */
#include "reference/mixture.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

mixture mixture_feline(double e, int most)
{
    const double wanted = 2 * e - 1, probes = fmin(floor(wanted + 0.5), most);
    const double deviation = probes < wanted ? 2 * e / (probes + 1) : 1;
    const double spacing = 4 * fmax(e - deviation, 0) / fmax(probes - 1, 1);
    mixture m = {.count = (int)probes};
    double sum = 0;
    for (int i = 0; i < m.count; i++) {
        const double place = (i + 0.5 - 0.5 * probes) * spacing;
        m.members[i] = (mixture_part){exp(-0.5 * place * place / (e * e)), deviation, place};
        sum += m.members[i].weight;
    }
    for (int i = 0; i < m.count; i++)
        m.members[i].weight /= sum;
    return m;
}

/* ∬ of the product of two Gaussians whose centres are `apart` on the long axis, from the sums of their variances. */
static double product(double variance_across, double variance_along, double apart)
{
    return exp(-apart * apart / (2 * variance_along)) / (2 * pi * sqrt(variance_across * variance_along));
}

double mixture_error(const mixture *m, double e)
{
    double sum = product(2, 2 * e * e, 0);
    for (int i = 0; i < m->count; i++) {
        const mixture_part *a = &m->members[i];
        const double variance = a->deviation * a->deviation;
        sum -= 2 * a->weight * product(1 + variance, e * e + variance, a->place);
        for (int j = 0; j < m->count; j++) {
            const mixture_part *b = &m->members[j];
            const double both = variance + b->deviation * b->deviation;
            sum += a->weight * b->weight * product(both, both, a->place - b->place);
        }
    }
    return sum;
}

double mixture_relative_error(const mixture *m, double e) { return mixture_error(m, e) / product(2, 2 * e * e, 0); }

double mixture_error_printed(double center_weight, double center_deviation, double pair_weight, double pair_deviation, double distance, double e)
{
    const double wa = center_weight, sa = center_deviation * center_deviation, w1 = pair_weight, s1 = pair_deviation * pair_deviation;
    const double d = distance * distance, y = e * e;
    return wa * wa / sa + 8 * wa * w1 * exp(-d / (2 * (sa + s1))) / (sa + s1) - 4 * wa / sqrt((sa + 1) * (sa + y)) + 2 * w1 * w1 * (exp(-d / s1) + 1) / s1 -
           8 * w1 * exp(-d / (2 * (s1 + y))) / sqrt((s1 + 1) * (s1 + y)) + 1 / e;
}
