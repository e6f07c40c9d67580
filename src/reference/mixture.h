/* SPDX-License-Identifier: MIT
 * Circular Gaussians in place of an elliptical one (Podee et al. 2021, Appendix C): how far apart they are. The ellipse has the deviations 1 and e ≥
 * 1, the kernels' centres stand on its long axis. */
#ifndef MANGATA_REFERENCE_MIXTURE_H
#define MANGATA_REFERENCE_MIXTURE_H

enum { MIXTURE_MEMBERS = 9 };

typedef struct mixture_part {
    double weight, deviation, place; /* along the long axis */
} mixture_part;

typedef struct mixture {
    int count;
    mixture_part members[MIXTURE_MEMBERS];
} mixture;

/* Feline's own formulae (McCormack et al. 1999, simple Feline): 2e − 1 probes, rounded, at most `most` (to nine), as wide as the ellipse is narrow
 * or, where they are too few, wider; evenly along what the ellipse is longer than they, weighed by its Gaussian; an ellipse's radius being two
 * deviations. Weights sum to 1. */
mixture mixture_feline(double e, int most);

/* ∬ (ellipse − mixture)² (Eq. 25), and the same over ∬ ellipse². */
double mixture_error(const mixture *m, double e);
double mixture_relative_error(const mixture *m, double e);

/* Eq. 28 as printed, for a centre and one pair, b read as w₁. */
double mixture_error_printed(double center_weight, double center_deviation, double pair_weight, double pair_deviation, double distance, double e);

#endif
