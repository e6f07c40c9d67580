/* SPDX-License-Identifier: MIT
 * The error of mixtures of circular Gaussians that stand for an elliptical one (Podee et al. 2021, Appendix C). The elliptical Gaussian has the standard
 * deviations 1 and e ≥ 1. The centres of the kernels lie on its long axis. */
#ifndef MANGATA_REFERENCE_MIXTURE_H
#define MANGATA_REFERENCE_MIXTURE_H

enum { MIXTURE_MEMBERS = 9 };

typedef struct mixture_part {
    double weight, deviation, place; /* `place` is the centre's coordinate along the long axis */
} mixture_part;

typedef struct mixture {
    int count;
    mixture_part members[MIXTURE_MEMBERS];
} mixture;

/* The mixture of simple Feline (McCormack et al. 1999). It has 2e − 1 probes, rounded, but at most `most` ≤ 9. A probe is as wide as the ellipse's short axis,
 * or wider if there are fewer than 2e − 1 probes. Probes lie at equal distances along the length by which the ellipse exceeds a probe. Their weights follow the
 * ellipse's Gaussian and sum to 1. An ellipse's radius is two standard deviations. */
mixture mixture_feline(double e, int most);

/* ∬ (ellipse − mixture)² (Eq. 25). */
double mixture_error(const mixture *m, double e);

/* That error divided by ∬ ellipse². */
double mixture_relative_error(const mixture *m, double e);

/* Eq. 28 as printed, for a centre and one pair; its b is taken as w₁. */
double mixture_error_printed(double center_weight, double center_deviation, double pair_weight, double pair_deviation, double distance, double e);

#endif
