/* SPDX-License-Identifier: MIT
 *
 * Gaussians, arcs and chords against the light's disk.
 */
#include <math.h>

#include "reference/equations.h"
#include "reference/quadrature.h"

static const double pi = 3.14159265358979323846;

/* The Gaussian in its principal axes: standard deviations along the major and the minor axis. */
typedef struct disk_case {
    double mean[2];
    double major, minor;
    double radius;
} disk_case;

typedef struct path_case {
    double start[2], step[2]; /* in the Gaussian's axes */
    disk_case disk;
} path_case;

/* P(low < X < high) for X ~ N(0, 1), exact in the tails too. */
static double normal_between(double low, double high)
{
    if (low > 0)
        return 0.5 * (erfc(low * M_SQRT1_2) - erfc(high * M_SQRT1_2));
    if (high < 0)
        return 0.5 * (erfc(-high * M_SQRT1_2) - erfc(-low * M_SQRT1_2));
    return 0.5 * (erf(high * M_SQRT1_2) - erf(low * M_SQRT1_2));
}

/* One chord of the disk along the minor axis, at radius·sin θ along the major one. */
static double chord_probability(double theta, const void *user)
{
    const disk_case *c = user;
    const double along = c->radius * sin(theta), half = c->radius * cos(theta);
    const double t = (along - c->mean[0]) / c->major;
    const double density = exp(-0.5 * t * t) / (c->major * sqrt(2 * pi));
    return density * half * normal_between((-half - c->mean[1]) / c->minor, (half - c->mean[1]) / c->minor);
}

static double angle_of(double along, double radius) { return asin(fmax(-1, fmin(1, along / radius))); }

static double probability_in_axes(const disk_case *c)
{
    const double from = angle_of(c->mean[0] - 9 * c->major, c->radius), to = angle_of(c->mean[0] + 9 * c->major, c->radius);
    double cuts[12];
    int count = 0;
    const double around[3] = {c->mean[0] - 3 * c->major, c->mean[0], c->mean[0] + 3 * c->major};
    for (int i = 0; i < 3; i++)
        cuts[count++] = angle_of(around[i], c->radius);
    for (int i = -1; i <= 1; i++) { /* where the chord's end passes the mean, and 4 deviations to either side */
        const double half = fabs(c->mean[1] + 4 * i * c->minor);
        if (half < c->radius) {
            cuts[count++] = acos(half / c->radius);
            cuts[count++] = -acos(half / c->radius);
        }
    }
    cuts[count++] = 0;
    return integrate_pieces(chord_probability, c, from, to, cuts, count, 1e-10);
}

/* Deviations and the unit vector of the major axis. */
static void principal_axes(const double covariance[3], double *major, double *minor, double axis[2])
{
    const double mean = 0.5 * (covariance[0] + covariance[2]), half = 0.5 * (covariance[0] - covariance[2]);
    const double spread = hypot(half, covariance[1]);
    const double determinant = covariance[0] * covariance[2] - covariance[1] * covariance[1];
    const double angle = 0.5 * atan2(covariance[1], half);
    *major = sqrt(mean + spread);
    *minor = sqrt(fmax(determinant / (mean + spread), 1e-18 * (mean + spread)));
    axis[0] = cos(angle);
    axis[1] = sin(angle);
}

static void into_axes(const double axis[2], const double p[2], double result[2])
{
    result[0] = axis[0] * p[0] + axis[1] * p[1];
    result[1] = -axis[1] * p[0] + axis[0] * p[1];
}

double disk_probability(const double mean[2], const double covariance[3], double radius)
{
    disk_case c;
    double axis[2];
    principal_axes(covariance, &c.major, &c.minor, axis);
    into_axes(axis, mean, c.mean);
    c.radius = radius;
    return probability_in_axes(&c);
}

static double probability_on_path(double at, const void *user)
{
    const path_case *path = user;
    disk_case c = path->disk;
    for (int i = 0; i < 2; i++)
        c.mean[i] = path->start[i] + at * path->step[i];
    return probability_in_axes(&c);
}

/* Where the line start + at·step passes a circle or comes closest to its centre. */
static int path_cuts(const double start[2], const double step[2], double radius, double cuts[3])
{
    const double length2 = step[0] * step[0] + step[1] * step[1];
    if (!(length2 > 0))
        return 0;
    const double nearest = -(start[0] * step[0] + start[1] * step[1]) / length2;
    const double miss = (start[0] * step[1] - start[1] * step[0]) / sqrt(length2);
    cuts[0] = nearest;
    if (!(fabs(miss) < radius))
        return 1;
    const double half = sqrt((radius * radius - miss * miss) / length2);
    cuts[1] = nearest - half;
    cuts[2] = nearest + half;
    return 3;
}

double disk_path_quadrature(const double p0[2], const double p1[2], const double covariance[3], double radius)
{
    path_case path;
    double axis[2], end[2], cuts[3];
    principal_axes(covariance, &path.disk.major, &path.disk.minor, axis);
    path.disk.radius = radius;
    into_axes(axis, p0, path.start);
    into_axes(axis, p1, end);
    for (int i = 0; i < 2; i++)
        path.step[i] = end[i] - path.start[i];
    if (path.step[0] == 0 && path.step[1] == 0)
        return probability_on_path(0, &path);
    const int count = path_cuts(path.start, path.step, radius, cuts);
    return integrate_pieces(probability_on_path, &path, 0, 1, cuts, count, 2e-9);
}

/* The part [*enter, *leave] ⊂ [0, 1] of the segment from p0 to p1 that lies within the disk. */
static bool segment_in_disk(const double p0[2], const double p1[2], double radius, double *enter, double *leave)
{
    const double step[2] = {p1[0] - p0[0], p1[1] - p0[1]};
    double cuts[3];
    if (path_cuts(p0, step, radius, cuts) < 3)
        return false;
    *enter = fmax(cuts[1], 0);
    *leave = fmin(cuts[2], 1);
    return *enter < *leave;
}

static bool inside(const double p[2], double radius) { return p[0] * p[0] + p[1] * p[1] < radius * radius; }

double light_chord_ratio(const double p0[2], const double p1[2], double radius)
{
    double enter, leave;
    if (p0[0] == p1[0] && p0[1] == p1[1])
        return inside(p0, radius);
    return segment_in_disk(p0, p1, radius, &enter, &leave) ? leave - enter : 0;
}

/* Angle between (p, 1) and (q, 1). */
static double angle_between(const double p[2], const double q[2])
{
    const double x = p[1] - q[1], y = q[0] - p[0], z = p[0] * q[1] - p[1] * q[0];
    return atan2(sqrt(x * x + y * y + z * z), p[0] * q[0] + p[1] * q[1] + 1);
}

double light_arc_ratio(const double p0[2], const double p1[2], double radius)
{
    double enter, leave;
    const double whole = angle_between(p0, p1);
    if (!(whole > 0))
        return inside(p0, radius);
    if (!segment_in_disk(p0, p1, radius, &enter, &leave))
        return 0;
    double from[2], to[2];
    for (int i = 0; i < 2; i++) {
        from[i] = p0[i] + enter * (p1[i] - p0[i]);
        to[i] = p0[i] + leave * (p1[i] - p0[i]);
    }
    return angle_between(from, to) / whole;
}
