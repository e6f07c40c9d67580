/* SPDX-License-Identifier: MIT
 *
 * Adaptive Gauss–Legendre quadrature for the oracle.
 */
#ifndef MANGATA_REFERENCE_QUADRATURE_H
#define MANGATA_REFERENCE_QUADRATURE_H

typedef double integrand(double x, const void *user);

/* ∫ f over [from, to] to an absolute `tolerance`: halves panels of 8 points until both halves agree with the whole. */
double integrate(integrand *f, const void *user, double from, double to, double tolerance);

/* The same, cut first at the `count` points (any order, those outside are ignored; at most 14) where f may bend sharply. */
double integrate_pieces(integrand *f, const void *user, double from, double to, const double *cuts, int count, double tolerance);

#endif
