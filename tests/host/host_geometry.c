/* SPDX-License-Identifier: MIT
 * See host_geometry.h. */
#include "host_geometry.h"

#include <math.h>

/* Counted so that one unit is one metre along the camera's axis. */
typedef struct ray {
    double eye[3], step[3];
} ray;

static ray ray_of(const geometry *g, uint32_t x, uint32_t y)
{
    const double *p = g->projection, *v = g->view;
    const double in_eye[3] = {(2 * (x + 0.5) / g->width - 1 + p[8]) / p[0], (2 * (y + 0.5) / g->height - 1 + p[9]) / p[5], -1};
    ray r;
    for (int i = 0; i < 3; i++) {
        r.eye[i] = -(v[4 * i] * v[12] + v[4 * i + 1] * v[13] + v[4 * i + 2] * v[14]);
        r.step[i] = v[4 * i] * in_eye[0] + v[4 * i + 1] * in_eye[1] + v[4 * i + 2] * in_eye[2];
    }
    return r;
}

/* Height of the ray over the surface. */
static double gap_at(const geometry *g, const ray *r, double along)
{
    const double x = r->eye[0] + along * r->step[0], z = r->eye[2] + along * r->step[2];
    double gap = r->eye[1] + along * r->step[1];
    for (size_t i = 0; i < g->wave_count; i++) {
        const mgt_wave *w = &g->waves[i];
        gap -= w->amplitude * sin(w->kx * x + w->kz * z + w->omega * g->time + w->phase);
    }
    return gap;
}

/* Steps that no slope can jump over, but for a ten-thousandth of the way; then halving. */
static double water_depth(const geometry *g, const ray *r)
{
    double height = 0, slope = 0;
    for (size_t i = 0; i < g->wave_count; i++) {
        height += g->waves[i].amplitude;
        slope += g->waves[i].amplitude * hypot(g->waves[i].kx, g->waves[i].kz);
    }
    if (r->step[1] >= 0)
        return INFINITY;
    const double fall = -r->step[1], speed = slope * hypot(r->step[0], r->step[2]) + fall;
    const double leave = (r->eye[1] + height) / fall;
    double along = fmax((r->eye[1] - height) / fall, 0), before = along, gap = gap_at(g, r, along);
    while (gap > 0 && along < leave) {
        before = along;
        along += fmax(gap / speed, 1e-4 * along);
        gap = gap_at(g, r, along);
    }
    double low = before, high = along;
    for (int i = 0; i < 30; i++) {
        const double middle = (low + high) / 2;
        if (gap_at(g, r, middle) > 0)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* The nearest positive root of a·t² + 2·b·t + c = 0. */
static double nearest_root(double a, double b, double c)
{
    const double square = b * b - a * c;
    if (square < 0 || a == 0)
        return INFINITY;
    const double first = (-b - sqrt(square)) / a, second = (-b + sqrt(square)) / a;
    return first > 0 ? first : second > 0 ? second : INFINITY;
}

static double ball_depth(const double ball[4], const ray *r)
{
    double a = 0, b = 0, c = -ball[3] * ball[3];
    for (int i = 0; i < 3; i++) {
        const double off = r->eye[i] - ball[i];
        a += r->step[i] * r->step[i];
        b += r->step[i] * off;
        c += off * off;
    }
    return nearest_root(a, b, c);
}

/* An open tube; seen from outside and not from above its top. */
static double pole_depth(const double pole[5], const ray *r)
{
    const double x = r->eye[0] - pole[0], z = r->eye[2] - pole[2];
    const double depth = nearest_root(r->step[0] * r->step[0] + r->step[2] * r->step[2], r->step[0] * x + r->step[2] * z, x * x + z * z - pole[3] * pole[3]);
    return fabs(r->eye[1] + depth * r->step[1] - pole[1]) <= pole[4] / 2 ? depth : INFINITY;
}

geometry_depths geometry_at(const geometry *g, uint32_t x, uint32_t y)
{
    const ray r = ray_of(g, x, y);
    return (geometry_depths){water_depth(g, &r), ball_depth(g->ball, &r), pole_depth(g->pole, &r)};
}
