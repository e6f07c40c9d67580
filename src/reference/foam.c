/* SPDX-License-Identifier: MIT
 *
 * Foam at a point in double precision.
 */
#include "reference/foam.h"

#include <math.h>

static double normal(double x) { return 0.5 * erfc(-x / sqrt(2)); }

double reference_normal_quantile(double p)
{
    double low = -10, high = 10;
    for (int i = 0; i < 80; i++) {
        const double middle = 0.5 * (low + high);
        if (normal(middle) < p)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* J at a moment: its mean over the moment's length, and the variance and the skewness of its deviation from that. */
typedef struct moment_press {
    double mean, variance, skewness;
} moment_press;

static moment_press press_at(const foam_sea *sea, int moment, double x, double z, double time)
{
    double xx = 1, xz = 0, zz = 1, lost = 0;
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_wave *w = &sea->waves[i];
        const double k2 = w->x * w->x + w->z * w->z, held = w->held[moment];
        const double pressed = w->press * held / k2 * sin(w->x * x + w->z * z + w->frequency * (time - sea->age[moment]) + w->start);
        xx -= pressed * w->x * w->x;
        xz -= pressed * w->x * w->z;
        zz -= pressed * w->z * w->z;
        lost += w->press * w->press / 2 * (1 - held * held);
    }
    /* k̂ᵀ adj(B) k̂ = p c² + q cs + r s² over the directions of the sea. */
    const double p = zz, q = -2 * xz, r = xx, *t = sea->shape;
    const double cxx = p * t[0] + q * t[1] + r * t[2], cxz = p * t[1] + q * t[2] + r * t[3], czz = p * t[2] + q * t[3] + r * t[4];
    const double squared = p * cxx + q * cxz + r * czz;
    moment_press m = {.mean = xx * zz - xz * xz, .variance = lost * squared};
    if (m.variance > 0)
        m.skewness = 6 * lost * lost * (cxx * czz - cxz * cxz) / pow(m.variance, 1.5);
    return m;
}

/* A gamma distribution by its first three moments. */
static double share_below(double least, moment_press m)
{
    if (!(m.variance > 1e-14))
        return m.mean < least ? 1 : 0;
    const double z = (least - m.mean) / sqrt(m.variance), cube = fmax(1 + 0.5 * m.skewness * z, 0);
    if (m.skewness < 1e-6)
        return normal(z);
    return normal(6 / m.skewness * (cbrt(cube) - 1) + m.skewness / 6);
}

void reference_foam_moments(const foam_sea *sea, double x, double z, double time, double shares[FOAM_MOMENTS])
{
    for (int j = 0; j < FOAM_MOMENTS; j++)
        shares[j] = j < sea->moments ? share_below(sea->least, press_at(sea, j, x, z, time)) : 0;
}

static double field_at(const foam_sine sines[FOAM_SINES], double x, double z)
{
    double sum = 0;
    for (int i = 0; i < FOAM_SINES; i++)
        sum += sines[i].size * cos(sines[i].x * x + sines[i].z * z + sines[i].start);
    return sum;
}

foam_point reference_foam_at(const foam_sea *sea, double x, double z, double time)
{
    double shares[FOAM_MOMENTS], old = 0, white = 0;
    reference_foam_moments(sea, x, z, time, shares);
    for (int j = 1; j < sea->moments; j++) {
        old += sea->weight[j] * shares[j];
        white += sea->weight[j] * shares[j] * sea->whiteness[j];
    }
    foam_point p = {0};
    double fresh = sea->weight[0] * shares[0], lace = 0;
    const double all = fresh;
    if (fresh > 0)
        fresh = normal((reference_normal_quantile(fmin(fresh, 0.999)) - field_at(sea->fresh, x, z)) / (double)FOAM_FINE);
    if (old > 0) {
        const double a = reference_normal_quantile(0.5 + 0.5 * fmin(old / (1 - fmin(all, 0.9)), 0.999)), g = field_at(sea->old, x, z);
        lace = (normal((a - g) / (double)FOAM_FINE) - normal((-a - g) / (double)FOAM_FINE)) * (1 - fresh);
        p.white = lace * white / old;
    }
    p.share = fmin(fresh + lace, 1);
    p.white += fresh * sea->whiteness[0];
    return p;
}
