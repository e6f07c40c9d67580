/* SPDX-License-Identifier: MIT */
/* The Gaussian-disk-path integral by dense quadrature in double. */
#include "disk_path_reference.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

double random_unit(uint64_t *state)
{
    *state += 0x9e3779b97f4a7c15u; /* splitmix64 */
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

struct disk_path_case random_disk_path_case(uint64_t *state)
{
    double elongation = pow(100, random_unit(state));
    double minor = 0.02 * pow(150, random_unit(state));
    double length = 0.01 * pow(1000, random_unit(state));
    double heading = 2 * pi * random_unit(state);
    double tilt = 2 * pi * random_unit(state);
    double from = 1.5 * (1 + minor) * sqrt(random_unit(state));
    double around = 2 * pi * random_unit(state);
    double major = minor * elongation;
    double cosine = cos(tilt), sine = sin(tilt);
    struct disk_path_case c = {
        .start = {(float)(from * cos(around)), (float)(from * sin(around))},
        .xx = (float)(major * major * cosine * cosine + minor * minor * sine * sine),
        .xy = (float)((major * major - minor * minor) * cosine * sine),
        .yy = (float)(major * major * sine * sine + minor * minor * cosine * cosine),
        .radius = 1,
    };
    c.end[0] = (float)(c.start[0] + length * cos(heading));
    c.end[1] = (float)(c.start[1] + length * sin(heading));
    return c;
}

static double normal_density(double t) { return exp(-t * t / 2) / sqrt(2 * pi); }
static double normal_probability(double t) { return erfc(-t / sqrt(2.0)) / 2; }

static double antiderivative(double x, double sigma)
{
    double t = x / sigma;
    return sigma * (t * normal_probability(t) + normal_density(t));
}

double disk_path_by_chords(const struct disk_path_case *c, int chords)
{
    double r = c->radius;
    double dx = c->end[0] - c->start[0], dy = c->end[1] - c->start[1];
    double length = hypot(dx, dy);
    double ux = dx / length, uy = dy / length;
    double uv = (c->yy - c->xx) * ux * uy + c->xy * (ux * ux - uy * uy);
    double vv = c->xx * uy * uy - 2 * c->xy * ux * uy + c->yy * ux * ux;
    double lean = uv / vv, across = sqrt(vv), along = sqrt((c->xx * c->yy - c->xy * c->xy) / vv);
    double u0 = c->start[0] * ux + c->start[1] * uy, v0 = c->start[1] * ux - c->start[0] * uy;

    double low = asin(fmax(-1, fmin(1, (v0 - 9 * across) / r))), high = asin(fmin(1, fmax(-1, (v0 + 9 * across) / r)));
    double spacing = (high - low) / chords, sum = 0;
    for (int i = 0; i < chords; i++) {
        double angle = low + (i + 0.5) * spacing;
        double v = r * sin(angle), h = r * cos(angle);
        double mean = u0 + lean * (v - v0);
        double share = antiderivative(h - mean, along) - antiderivative(h - mean - length, along) - antiderivative(-h - mean, along) +
                       antiderivative(-h - mean - length, along);
        sum += normal_density((v - v0) / across) / across * h * share;
    }
    return sum * spacing / length;
}

static double share_at(const struct disk_path_case *c, double x, double y, int chords)
{
    double deviation = sqrt(c->yy), lean = c->xy / c->yy, rest = sqrt(c->xx - c->xy * lean);
    double r = c->radius;
    double low = asin(fmax(-1, fmin(1, (y - 9 * deviation) / r))), high = asin(fmin(1, fmax(-1, (y + 9 * deviation) / r)));
    double spacing = (high - low) / chords, sum = 0;
    for (int i = 0; i < chords; i++) {
        double angle = low + (i + 0.5) * spacing;
        double h = r * cos(angle), offset = r * sin(angle) - y;
        double mean = x + lean * offset;
        sum += normal_density(offset / deviation) / deviation * h * (normal_probability((h - mean) / rest) - normal_probability((-h - mean) / rest));
    }
    return sum * spacing;
}

double disk_path_by_steps(const struct disk_path_case *c, int steps, int chords)
{
    double sum = 0;
    for (int i = 0; i < steps; i++) {
        double t = (i + 0.5) / steps;
        sum += share_at(c, c->start[0] + t * (c->end[0] - c->start[0]), c->start[1] + t * (c->end[1] - c->start[1]), chords);
    }
    return sum / steps;
}
