/* SPDX-License-Identifier: MIT
 *
 * Foam at a point in double precision: the definition of src/params/foam.h without a footprint.
 */
#ifndef MANGATA_REFERENCE_FOAM_H
#define MANGATA_REFERENCE_FOAM_H

#include "params/foam.h"

typedef struct foam_point {
    double share; /* of the point that is covered, [0, 1] */
    double white; /* Σ share · whiteness */
} foam_point;

/* At a place of rest in world coordinates and a time in seconds. */
foam_point reference_foam_at(const foam_sea *sea, double x, double z, double time);

/* What of the foam, before its pattern, each moment has there: 0 or 1 now, in [0, 1] before. */
void reference_foam_moments(const foam_sea *sea, double x, double z, double time, double shares[FOAM_MOMENTS]);

/* x of which the standard normal distribution's P is p, for p in (0, 1). */
double reference_normal_quantile(double p);

#endif
