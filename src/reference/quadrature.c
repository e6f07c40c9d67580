/* SPDX-License-Identifier: MIT
 *
 * Adaptive Gauss–Legendre quadrature.
 */
#include "reference/quadrature.h"

#include <math.h>

enum { deepest_level = 40, most_cuts = 14 };

static double panel(integrand *f, const void *user, double from, double to)
{
    static const double node[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959, 0.96028985649753623168};
    static const double weight[4] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054, 0.10122853629037625915};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (int i = 0; i < 4; i++)
        sum += weight[i] * (f(middle - half * node[i], user) + f(middle + half * node[i], user));
    return sum * half;
}

static double refine(integrand *f, const void *user, double from, double to, double whole, double tolerance, int level)
{
    const double middle = 0.5 * (from + to);
    const double left = panel(f, user, from, middle), right = panel(f, user, middle, to);
    if (fabs(left + right - whole) <= tolerance || level == deepest_level)
        return left + right;
    return refine(f, user, from, middle, left, 0.5 * tolerance, level + 1) + refine(f, user, middle, to, right, 0.5 * tolerance, level + 1);
}

double integrate(integrand *f, const void *user, double from, double to, double tolerance)
{
    if (!(to > from))
        return 0;
    return refine(f, user, from, to, panel(f, user, from, to), tolerance, 0);
}

double integrate_pieces(integrand *f, const void *user, double from, double to, const double *cuts, int count, double tolerance)
{
    double sorted[most_cuts];
    int used = 0;
    for (int i = 0; i < count && used < most_cuts; i++) {
        if (!(cuts[i] > from && cuts[i] < to))
            continue;
        int at = used++;
        for (; at > 0 && sorted[at - 1] > cuts[i]; at--)
            sorted[at] = sorted[at - 1];
        sorted[at] = cuts[i];
    }
    double sum = 0, left = from;
    for (int i = 0; i <= used; i++) {
        const double right = i < used ? sorted[i] : to;
        sum += integrate(f, user, left, right, tolerance / (used + 1));
        left = right;
    }
    return sum;
}
