/* SPDX-License-Identifier: MIT
 *
 * Foam at a point in double precision: the definition of src/params/foam.h without a footprint.
 */
#ifndef MANGATA_REFERENCE_FOAM_H
#define MANGATA_REFERENCE_FOAM_H

#include "params/foam.h"

typedef struct foam_point {
    double share; /* fraction of the point that foam covers, [0, 1] */
    double white; /* the sum of that fraction times the foam's whiteness, over the moments */
} foam_point;

/* The foam at a place at rest (x, z), world coordinates in metres, and at a time in seconds. */
foam_point reference_foam_at(const foam_sea *sea, double x, double z, double time);

/* The fraction of foam that each moment adds at that place, before the pattern is applied: 0 or 1 for the moment now, in [0, 1] for earlier ones. */
void reference_foam_moments(const foam_sea *sea, double x, double z, double time, double shares[FOAM_MOMENTS]);

/* The quantile of the standard normal distribution for the probability p in (0, 1). */
double reference_normal_quantile(double p);

#endif
