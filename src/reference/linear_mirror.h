/* SPDX-License-Identifier: MIT
 * How well one Jacobian stands for the mirror's map of slopes onto the light plane (Podee et al. 2021, Appendix B): a Gaussian of slopes through the
 * true map, and through its linearisation at any slope. No visibility of slopes. */
#ifndef MANGATA_REFERENCE_LINEAR_MIRROR_H
#define MANGATA_REFERENCE_LINEAR_MIRROR_H

#include <stdbool.h>

/* A Gaussian of slopes: covariance xx, xz, zz, positive definite. */
typedef struct slope_law {
    double mean[2], covariance[3];
} slope_law;

/* The share of slopes whose mirror ray meets the light's disk of this radius on the plane r·L = 1, by quadrature over the disk. */
double mirror_disk_fraction(const double to_eye[3], const double light[3], const slope_law *law, double radius);

/* The same with the map replaced by its first-order expansion at the slope `at`; 0 where the ray of `at` points away from the light. */
double linear_disk_fraction(const double to_eye[3], const double light[3], const slope_law *law, double radius, const double at[2]);

/* ∬ |linear − true| of the two densities on the light plane, expanded at the law's mean; 0 … 2. */
double linear_density_error(const double to_eye[3], const double light[3], const slope_law *law);

#endif
