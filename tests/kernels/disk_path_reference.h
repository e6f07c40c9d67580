/* SPDX-License-Identifier: MIT */
/* The Gaussian-disk-path integral by dense quadrature in double, and the random cases on which the kernel is judged. */
#ifndef MGT_TESTS_DISK_PATH_REFERENCE_H
#define MGT_TESTS_DISK_PATH_REFERENCE_H

#include <stdint.h>

struct disk_path_case {
    double start[2], end[2];
    double xx, xy, yy; /* covariance */
    double radius;
};

/* Next number in [0, 1). */
double random_unit(uint64_t *state);

/* Radius 1; elongation log-uniform 1 to 100; minor deviation log-uniform 0.02 to 3; path length log-uniform 0.01 to 10 in any
 * direction; start uniform in the disk of radius 1.5 (1 + minor deviation). Values are rounded to float. */
struct disk_path_case random_disk_path_case(uint64_t *state);

/* Chords along the path, in closed form along it. For covariances of full rank and paths of some length. */
double disk_path_by_chords(const struct disk_path_case *c, int chords);

/* Mean over points of the path, chords along x at each: shares nothing with the kernel's derivation, but is slow. */
double disk_path_by_steps(const struct disk_path_case *c, int steps, int chords);

#endif
