/* SPDX-License-Identifier: MIT
 *
 * Adaptive Gauss–Legendre quadrature for the reference.
 */
#ifndef MANGATA_REFERENCE_QUADRATURE_H
#define MANGATA_REFERENCE_QUADRATURE_H

typedef double integrand(double x, const void *user);

/* ∫ f over [from, to] with an absolute `tolerance`. A panel of 8 points is halved until the sum of its halves agrees with the whole. */
double integrate(integrand *f, const void *user, double from, double to, double tolerance);

/* ∫ f like integrate(), over pieces between `count` ≤ 14 points where f may bend sharply. The points may be in any order; those outside of [from, to] are
 * ignored. */
double integrate_pieces(integrand *f, const void *user, double from, double to, const double *cuts, int count, double tolerance);

#endif
