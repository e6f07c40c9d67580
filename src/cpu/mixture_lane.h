/* SPDX-License-Identifier: MIT
 * The mixtures that podee-* renders with, in one lane and outside a frame: for figures and tests. */
#ifndef MANGATA_CPU_MIXTURE_LANE_H
#define MANGATA_CPU_MIXTURE_LANE_H

#include "mangata/mangata.h"
#include "frame/podee_tables.h"
#include "reference/mixture.h"

/* `kernels` (1, 3, 5 or 9) circular Gaussians fitted to an ellipse of deviations 1 and e, 1 ≤ e ≤ 9, as mixture_fits.k has them. */
mixture mixture_fitted(int kernels, double e);

/* The share of a Gaussian on a straight path of means that lies in the disk of radius 1, as a frame with `kernels` takes it, never falling back;
 * Riemann sums leave the path out. covariance: xx, xy, yy. */
double mixture_path_fraction(const podee_tables *tables, mgt_mixture kernels, const double from[2], const double to[2], const double covariance[3]);

#endif
