/* SPDX-License-Identifier: MIT
 * How well a Jacobian approximates the mirror's map of slopes onto the light plane (Podee et al. 2021, Appendix B). A Gaussian distribution of slopes is
 * mapped by the true map and by its linearisation at a slope. The visibility of slopes is left out. */
#ifndef MANGATA_REFERENCE_LINEAR_MIRROR_H
#define MANGATA_REFERENCE_LINEAR_MIRROR_H

#include <stdbool.h>

/* A Gaussian distribution of slopes. The covariance xx, xz, zz is positive definite. */
typedef struct slope_law {
    double mean[2], covariance[3];
} slope_law;

/* The fraction of slopes whose mirrored ray meets the light's disk of this radius on the plane r·L = 1, by quadrature over the disk. */
double mirror_disk_fraction(const double to_eye[3], const double light[3], const slope_law *law, double radius);

/* This fraction with the map replaced by its first-order expansion at the slope `at`. It is 0 if the mirrored ray of `at` points away from the light. */
double linear_disk_fraction(const double to_eye[3], const double light[3], const slope_law *law, double radius, const double at[2]);

/* ∬ |linear − true| over the light plane for the densities by the two maps, with the expansion at the law's mean; 0 … 2. */
double linear_density_error(const double to_eye[3], const double light[3], const slope_law *law);

#endif
