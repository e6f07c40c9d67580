/* SPDX-License-Identifier: MIT
 * Mixtures of podee-* in one lane and without a frame, for figures and tests. */
#ifndef MANGATA_CPU_MIXTURE_LANE_H
#define MANGATA_CPU_MIXTURE_LANE_H

#include "mangata/mangata.h"
#include "frame/podee_tables.h"
#include "reference/mixture.h"

/* The mixture of `kernels` circular Gaussians (1, 3, 5 or 9) that mixture_fits.k fits to an elliptic one of deviations 1 and e, 1 ≤ e ≤ 9. */
mixture mixture_fitted(int kernels, double e);

/* Fraction of a Gaussian that lies in the disk of radius 1 while its mean moves on a straight path, as a frame with `kernels` computes it, but without the
 * fallback. Riemann sums leave the path out. `covariance`: xx, xy, yy. */
double mixture_path_fraction(const podee_tables *tables, mgt_mixture kernels, const double from[2], const double to[2], const double covariance[3]);

#endif
