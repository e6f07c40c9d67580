/* SPDX-License-Identifier: MIT
 *
 * Choppy water at points. A search finds the place at rest that the water's shift moves to a point. It runs in single precision relative to where it began, or
 * in double precision. B is 1 + ∂shift/∂place. For files that are compiled once per lane width, after the kernel prelude and math.k.
 */
#ifndef MANGATA_CPU_REST_LANE_H
#define MANGATA_CPU_REST_LANE_H

#include <math.h>

#include "cpu/wide_lane.h"
#include "mangata/mangata.h"

/* Sums over waves at places at rest, one per lane, in double precision. */
typedef struct rest_group {
    double x[MGT_LANES], z[MGT_LANES]; /* the place at rest */
    double height[MGT_LANES], slope_x[MGT_LANES], slope_z[MGT_LANES], rise[MGT_LANES];
    double shift_x[MGT_LANES], shift_z[MGT_LANES], drift_x[MGT_LANES], drift_z[MGT_LANES];
    double xx[MGT_LANES], xz[MGT_LANES], zz[MGT_LANES]; /* −∂shift/∂place */
} rest_group;

/* The waves' phases where a search began, turns. Single precision is enough, because the search stays within a few wavelengths. */
typedef struct rest_search {
    float turns[MGT_MAX_WAVES][MGT_LANES];
} rest_search;

static void begin_search(const water_terms *w, const rest_group *g, rest_search *s)
{
    const wide_places places = load_places(g->x, g->z);
    for (int i = 0; i < w->count; i++) {
        const real single = turns_of(w, i, &places);
        __builtin_memcpy(s->turns[i], &single, sizeof single);
    }
}

/* Phase of a wave at a distance (away_x, away_z) from where the search began, turns. */
static inline real turns_away(const water_terms *w, int i, const rest_search *s, real away_x, real away_z)
{
    real at;
    __builtin_memcpy(&at, s->turns[i], sizeof at);
    return real_fma(away_x, real_broadcast(w->of[i].single.along_x), real_fma(away_z, real_broadcast(w->of[i].single.along_z), at));
}

typedef struct shift_sums {
    real x, z;       /* shift, metres */
    real xx, xz, zz; /* −∂shift/∂place */
} shift_sums;

/* Sums over the `count` largest waves at a distance (away_x, away_z) from where the search began. */
static inline shift_sums shift_away(const water_terms *w, int count, const rest_search *s, real away_x, real away_z)
{
    const real zero = real_broadcast(0);
    shift_sums d = {zero, zero, zero, zero, zero};
    for (int i = 0; i < count; i++) {
        const SinCos t = sincos_wave(NULL, turns_away(w, i, s, away_x, away_z));
        d.x = real_fma(t.c, real_broadcast(w->of[i].single.shift_x), d.x);
        d.z = real_fma(t.c, real_broadcast(w->of[i].single.shift_z), d.z);
        d.xx = real_fma(t.s, real_broadcast(w->of[i].single.press_xx), d.xx);
        d.xz = real_fma(t.s, real_broadcast(w->of[i].single.press_xz), d.xz);
        d.zz = real_fma(t.s, real_broadcast(w->of[i].single.press_zz), d.zz);
    }
    return d;
}

/* Sums over waves at places at rest in single precision. */
typedef struct rest_sums {
    real height, slope_x, slope_z, rise, drift_x, drift_z;
    shift_sums shift;
    real bend_xx, bend_xz, bend_zz; /* −∂slope/∂place */
    real xxx, xxz, xzz, zzz;        /* −∂²shift/∂place² */
} rest_sums;

/* Sums at a distance (away_x, away_z) from where the search began. `moving`: with the velocity. */
static inline __attribute__((always_inline)) rest_sums rest_single(const water_terms *w, const rest_search *s, real away_x, real away_z, bool moving)
{
    rest_sums d;
    __builtin_memset(&d, 0, sizeof d);
    for (int i = 0; i < w->count; i++) {
        const SinCos t = sincos_turns(NULL, turns_away(w, i, s, away_x, away_z));
        d.height = real_fma(t.s, real_broadcast(w->of[i].single.height), d.height);
        d.slope_x = real_fma(t.c, real_broadcast(w->of[i].single.slope_x), d.slope_x);
        d.slope_z = real_fma(t.c, real_broadcast(w->of[i].single.slope_z), d.slope_z);
        if (moving) {
            d.rise = real_fma(t.c, real_broadcast(w->of[i].single.vertical_velocity), d.rise);
            d.drift_x = real_fma(t.s, real_broadcast(w->of[i].single.shift_velocity_x), d.drift_x);
            d.drift_z = real_fma(t.s, real_broadcast(w->of[i].single.shift_velocity_z), d.drift_z);
        }
        d.shift.x = real_fma(t.c, real_broadcast(w->of[i].single.shift_x), d.shift.x);
        d.shift.z = real_fma(t.c, real_broadcast(w->of[i].single.shift_z), d.shift.z);
        d.shift.xx = real_fma(t.s, real_broadcast(w->of[i].single.press_xx), d.shift.xx);
        d.shift.xz = real_fma(t.s, real_broadcast(w->of[i].single.press_xz), d.shift.xz);
        d.shift.zz = real_fma(t.s, real_broadcast(w->of[i].single.press_zz), d.shift.zz);
        const real along_x = t.c * w->of[i].single.radians_x, along_z = t.c * w->of[i].single.radians_z, high_x = t.s * w->of[i].single.radians_x,
                   high_z = t.s * w->of[i].single.radians_z;
        d.bend_xx = real_fma(high_x, real_broadcast(w->of[i].single.slope_x), d.bend_xx);
        d.bend_xz = real_fma(high_x, real_broadcast(w->of[i].single.slope_z), d.bend_xz);
        d.bend_zz = real_fma(high_z, real_broadcast(w->of[i].single.slope_z), d.bend_zz);
        d.xxx = real_fma(along_x, real_broadcast(w->of[i].single.press_xx), d.xxx);
        d.xxz = real_fma(along_z, real_broadcast(w->of[i].single.press_xx), d.xxz);
        d.xzz = real_fma(along_x, real_broadcast(w->of[i].single.press_zz), d.xzz);
        d.zzz = real_fma(along_z, real_broadcast(w->of[i].single.press_zz), d.zzz);
    }
    return d;
}

/* Fills the sums of a group. Second derivatives are left out, because a search in double ends so close that they do not matter. */
static inline void rest_double(const water_terms *w, rest_group *g)
{
    for (int half = 0; half < HALVES; half++) {
        const wide x = wide_load(g->x + half * WIDE), z = wide_load(g->z + half * WIDE), zero = wide_of(0);
        wide height = zero, slope_x = zero, slope_z = zero, rise = zero, shift_x = zero, shift_z = zero, drift_x = zero, drift_z = zero;
        wide xx = zero, xz = zero, zz = zero;
        for (int i = 0; i < w->count; i++) {
            const wide_sine t = sine_of_turns(turns_at(w, i, x, z));
            height = wide_fma(t.sine, wide_of(w->of[i].height), height);
            slope_x = wide_fma(t.cosine, wide_of(w->of[i].slope_x), slope_x);
            slope_z = wide_fma(t.cosine, wide_of(w->of[i].slope_z), slope_z);
            rise = wide_fma(t.cosine, wide_of(w->of[i].vertical_velocity), rise);
            shift_x = wide_fma(t.cosine, wide_of(w->of[i].shift_x), shift_x);
            shift_z = wide_fma(t.cosine, wide_of(w->of[i].shift_z), shift_z);
            drift_x = wide_fma(t.sine, wide_of(w->of[i].shift_velocity_x), drift_x);
            drift_z = wide_fma(t.sine, wide_of(w->of[i].shift_velocity_z), drift_z);
            xx = wide_fma(t.sine, wide_of(w->of[i].press_xx), xx);
            xz = wide_fma(t.sine, wide_of(w->of[i].press_xz), xz);
            zz = wide_fma(t.sine, wide_of(w->of[i].press_zz), zz);
        }
        wide_store(g->height + half * WIDE, height);
        wide_store(g->slope_x + half * WIDE, slope_x);
        wide_store(g->slope_z + half * WIDE, slope_z);
        wide_store(g->rise + half * WIDE, rise);
        wide_store(g->shift_x + half * WIDE, shift_x);
        wide_store(g->shift_z + half * WIDE, shift_z);
        wide_store(g->drift_x + half * WIDE, drift_x);
        wide_store(g->drift_z + half * WIDE, drift_z);
        wide_store(g->xx + half * WIDE, xx);
        wide_store(g->xz + half * WIDE, xz);
        wide_store(g->zz + half * WIDE, zz);
    }
}

/* The answer at a point of choppy water. */
typedef struct settled_point {
    double height, slope[2], velocity[3], jacobian;
    double least;    /* lesser eigenvalue of B */
    double worst[2]; /* its unit eigenvector */
    double rest[2];  /* place at rest */
    bool settled;    /* the place was found, or the point is not finite */
} settled_point;

/* Eigenvalues of B = 1 − [xx, xz; xz, zz], the greater one first, and the unit eigenvector of the lesser one. */
static void stretch_of(double xx, double xz, double zz, double value[2], double direction[2])
{
    const double middle = 1 - 0.5 * (xx + zz), half = 0.5 * (zz - xx), radius = __builtin_sqrt(half * half + xz * xz);
    value[0] = middle + radius;
    value[1] = middle - radius;
    /* The eigenvector of B − middle = [half, −xz; −xz, −half] to the eigenvalue −radius. The longer of two expressions for it is taken. */
    const double a = half <= 0 ? radius - half : xz, b = half <= 0 ? xz : radius + half, length = __builtin_sqrt(a * a + b * b);
    direction[0] = length > 0 ? a / length : 1;
    direction[1] = length > 0 ? b / length : 0;
}

/* B⁻¹ v, for B with the eigenvalues `most` and `least`. `direction`: unit eigenvector of `least`. */
static void to_rest_by(double most, double least, const double direction[2], const double v[2], double out[2])
{
    const double along = v[0] * direction[0] + v[1] * direction[1], across = v[1] * direction[0] - v[0] * direction[1];
    out[0] = along / least * direction[0] - across / most * direction[1];
    out[1] = along / least * direction[1] + across / most * direction[0];
}

/* B⁻¹ v with eigenvalues raised to 0.1, so that slopes stay finite where the water folds. */
static void to_rest(const double value[2], const double direction[2], const double v[2], double out[2])
{
    to_rest_by(value[0] > 0.1 ? value[0] : 0.1, value[1] > 0.1 ? value[1] : 0.1, direction, v, out);
}

/* Newton's step B⁻¹ v. Eigenvalues keep away from 0, but the lesser one may be negative, as it is where the water folds over. */
static void newton_step(const double value[2], const double direction[2], const double v[2], double out[2])
{
    const double least = value[1] < 0 ? (value[1] < -0.05 ? value[1] : -0.05) : value[1] > 0.05 ? value[1] : 0.05;
    to_rest_by(value[0] > 0.1 ? value[0] : 0.1, least, direction, v, out);
}

/* Fills the answer at the point that lies `left` beyond the point to which the sums' place is shifted. The sums are extrapolated to it, unless it is too far
 * for that. */
static void keep_point(const water_terms *w, const rest_group *g, int lane, const double left[2], settled_point *p)
{
    double value[2], step[2] = {0, 0};
    stretch_of(g->xx[lane], g->xz[lane], g->zz[lane], value, p->worst);
    if (left[0] * left[0] + left[1] * left[1] < w->straight * w->straight)
        newton_step(value, p->worst, left, step);
    const double slope[2] = {g->slope_x[lane], g->slope_z[lane]};
    to_rest(value, p->worst, slope, p->slope);
    p->height = fmin(fmax(g->height[lane] + slope[0] * step[0] + slope[1] * step[1], -w->sum), w->sum);
    p->velocity[0] = g->drift_x[lane];
    p->velocity[1] = g->rise[lane];
    p->velocity[2] = g->drift_z[lane];
    p->jacobian = value[0] * value[1];
    p->least = value[1];
    p->rest[0] = g->x[lane] + step[0];
    p->rest[1] = g->z[lane] + step[1];
}

/* A step towards the place at rest: Newton's if the point is so near that slopes change little up to it, else the whole difference, which always comes
 * nearer. */
static void rest_step(const water_terms *w, const rest_group *g, int lane, const double left[2], double step[2])
{
    step[0] = left[0];
    step[1] = left[1];
    if (left[0] * left[0] + left[1] * left[1] < w->straight * w->straight) {
        double value[2], direction[2];
        stretch_of(g->xx[lane], g->xz[lane], g->zz[lane], value, direction);
        newton_step(value, direction, left, step);
    }
}

/* B in lanes: [middle + half, −across; −across, middle − half], with the eigenvalues middle ± radius. */
typedef struct stretch_lanes {
    real most, least; /* eigenvalues */
    real half, across, inverse_radius;
} stretch_lanes;

static inline stretch_lanes stretches_of(real xx, real xz, real zz)
{
    const real middle = 1 - 0.5f * (xx + zz), half = 0.5f * (zz - xx), radius = sqrt(half * half + xz * xz);
    return (stretch_lanes){middle + radius, middle - radius, half, xz, 1 / max(radius, real(1e-20f))};
}

/* M⁻¹ v, for a matrix M with the eigenvectors of B and the eigenvalues `most` and `least`. M⁻¹ = middle + part · (B − its mean eigenvalue)/radius. */
static inline vec2 to_rest_lanes(const stretch_lanes *e, real most, real least, vec2 v)
{
    const real middle = 0.5f * (1 / most + 1 / least), part = 0.5f * (1 / most - 1 / least) * e->inverse_radius;
    return vec2(middle * v.x + part * (e->half * v.x - e->across * v.y), middle * v.y - part * (e->across * v.x + e->half * v.y));
}

static inline vec2 newton_steps(const stretch_lanes *e, vec2 left)
{
    return to_rest_lanes(e, max(e->most, real(0.1f)), SELECT(e->least < 0, min(e->least, real(-0.05f)), max(e->least, real(0.05f))), left);
}

/* rest_step() in lanes. */
static inline vec2 rest_steps(const water_terms *w, shift_sums d, vec2 left)
{
    const stretch_lanes e = stretches_of(d.xx, d.xz, d.zz);
    const real straight = real((float)(w->straight * w->straight));
    return SELECT2(left.x * left.x + left.y * left.y < straight, newton_steps(&e, left), left);
}

/* Members of settled_point, one array per member. step_*: from the sums' place to the place at rest. */
typedef struct settled_lanes {
    float height[MGT_LANES], slope_x[MGT_LANES], slope_z[MGT_LANES], jacobian[MGT_LANES], least[MGT_LANES], worst_x[MGT_LANES], worst_z[MGT_LANES];
    float step_x[MGT_LANES], step_z[MGT_LANES], drift_x[MGT_LANES], rise[MGT_LANES], drift_z[MGT_LANES];
} settled_lanes;

static inline void store_lanes(float *to, real value) { __builtin_memcpy(to, &value, sizeof value); }

/* keep_point() in lanes, but with an extrapolation of second order. */
static inline void keep_lanes(const water_terms *w, const rest_sums *d, vec2 left, settled_lanes *out)
{
    const mask near = left.x * left.x + left.y * left.y < (float)(w->straight * w->straight);
    left = SELECT2(near, left, vec2(real(0.0f), real(0.0f)));
    const stretch_lanes e = stretches_of(d->shift.xx, d->shift.xz, d->shift.zz);
    vec2 s = newton_steps(&e, left);
    const real x = d->xxx * s.x * s.x + 2 * d->xxz * s.x * s.y + d->xzz * s.y * s.y, z = d->xxz * s.x * s.x + 2 * d->xzz * s.x * s.y + d->zzz * s.y * s.y;
    s = newton_steps(&e, vec2(left.x + 0.5f * x, left.y + 0.5f * z));
    const real turn_x = d->bend_xx * s.x + d->bend_xz * s.y, turn_z = d->bend_xz * s.x + d->bend_zz * s.y;
    const stretch_lanes there =
        stretches_of(d->shift.xx + d->xxx * s.x + d->xxz * s.y, d->shift.xz + d->xxz * s.x + d->xzz * s.y, d->shift.zz + d->xzz * s.x + d->zzz * s.y);
    const vec2 slope = to_rest_lanes(&there, max(there.most, real(0.1f)), max(there.least, real(0.1f)), vec2(d->slope_x - turn_x, d->slope_z - turn_z));
    const real radius = 0.5f * (there.most - there.least);
    const mask first = there.half <= 0;
    const real a = SELECT(first, radius - there.half, there.across), b = SELECT(first, there.across, radius + there.half), length = sqrt(a * a + b * b);
    const mask round = length <= 0;
    const real inverse = 1 / SELECT(round, real(1.0f), length);
    const real most = real((float)w->sum), height = d->height + ((d->slope_x - 0.5f * turn_x) * s.x + (d->slope_z - 0.5f * turn_z) * s.y);
    store_lanes(out->height, max(min(height, most), 0 - most));
    store_lanes(out->slope_x, slope.x);
    store_lanes(out->slope_z, slope.y);
    store_lanes(out->jacobian, there.most * there.least);
    store_lanes(out->least, there.least);
    store_lanes(out->worst_x, SELECT(round, real(1.0f), a * inverse));
    store_lanes(out->worst_z, b * inverse);
    store_lanes(out->step_x, s.x);
    store_lanes(out->step_z, s.y);
    store_lanes(out->drift_x, d->drift_x);
    store_lanes(out->rise, d->rise);
    store_lanes(out->drift_z, d->drift_z);
}

/* A search in lanes. Both are relative to where it began. */
typedef struct aim_lanes {
    vec2 point; /* the point whose place at rest is searched */
    vec2 away;  /* the estimate of that place */
} aim_lanes;

/* Searches near estimates of the places at rest in single precision. The first steps use the largest waves alone, which saves time. */
static aim_lanes settle_roughly(const water_terms *w, const double at[][2], const rest_group *g, rest_search *s)
{
    enum { LOOKS = 24, FIRST = 3 };
    float off_x[MGT_LANES], off_z[MGT_LANES];
    for (int lane = 0; lane < MGT_LANES; lane++) {
        off_x[lane] = (float)(at[lane][0] - g->x[lane]);
        off_z[lane] = (float)(at[lane][1] - g->z[lane]);
    }
    begin_search(w, g, s);
    const double enough = 0.05 * w->straight + 3e-5 * w->sum;
    const real near = real((float)(enough * enough));
    real away_x = real(0.0f), away_z = real(0.0f), open = real(1.0f), x, z;
    __builtin_memcpy(&x, off_x, sizeof x);
    __builtin_memcpy(&z, off_z, sizeof z);
    for (int look = 0; look < LOOKS && any_lane(open > 0); look++) {
        const int count = look < FIRST && w->count > 16 ? w->count / 4 : w->count;
        const shift_sums d = shift_away(w, count, s, away_x, away_z);
        const vec2 left = vec2(x - away_x - d.x, z - away_z - d.z), step = rest_steps(w, d, left);
        away_x = away_x + open * step.x;
        away_z = away_z + open * step.y;
        if (count == w->count)
            open = SELECT(left.x * left.x + left.y * left.y > near, open, real(0.0f));
    }
    return (aim_lanes){vec2(x, z), vec2(away_x, away_z)};
}

/* Marks points that are not finite as settled, because they have no place at rest. Returns the number of the others. */
static int begin_points(const double at[][2], settled_point *points)
{
    int open = MGT_LANES;
    for (int lane = 0; lane < MGT_LANES; lane++) {
        points[lane].settled = !(0 * (at[lane][0] + at[lane][1]) == 0);
        open -= points[lane].settled;
    }
    return open;
}

/* Finds the places at rest of as many points as there are lanes, in double precision. The search begins at the places of g. */
static void settle_exact(const water_terms *w, const double at[][2], rest_group *g, settled_point *points)
{
    enum { LOOKS = 12 };
    const double near = 1e-11 * (1 + w->sum);
    rest_search search;
    int open = begin_points(at, points);
    const aim_lanes aim = settle_roughly(w, at, g, &search);
    double moved_x[MGT_LANES], moved_z[MGT_LANES];
    store_sum(moved_x, aim.away.x);
    store_sum(moved_z, aim.away.y);
    for (int lane = 0; lane < MGT_LANES; lane++) {
        g->x[lane] += moved_x[lane];
        g->z[lane] += moved_z[lane];
    }
    for (int look = 0; look < LOOKS && open > 0; look++) {
        rest_double(w, g);
        for (int lane = 0; lane < MGT_LANES; lane++) {
            if (points[lane].settled)
                continue;
            const double left[2] = {at[lane][0] - g->x[lane] - g->shift_x[lane], at[lane][1] - g->z[lane] - g->shift_z[lane]};
            points[lane].settled = left[0] * left[0] + left[1] * left[1] <= near * near;
            if (points[lane].settled || look + 1 == LOOKS) {
                keep_point(w, g, lane, left, &points[lane]);
                open -= points[lane].settled;
                continue;
            }
            double step[2];
            rest_step(w, g, lane, left, step);
            g->x[lane] += step[0];
            g->z[lane] += step[1];
        }
    }
}

/* The answer of one lane whose search has ended at the place `away`. */
static settled_point point_of(const settled_lanes *of, int lane, const double away[2], bool settled)
{
    return (settled_point){.height = (double)of->height[lane],
                           .slope = {(double)of->slope_x[lane], (double)of->slope_z[lane]},
                           .velocity = {(double)of->drift_x[lane], (double)of->rise[lane], (double)of->drift_z[lane]},
                           .jacobian = (double)of->jacobian[lane],
                           .least = (double)of->least[lane],
                           .worst = {(double)of->worst_x[lane], (double)of->worst_z[lane]},
                           .rest = {away[0] + (double)of->step_x[lane], away[1] + (double)of->step_z[lane]},
                           .settled = settled};
}

static void settle_single(const water_terms *w, bool moving, const double at[][2], const rest_group *g, settled_point *points)
{
    enum { LOOKS = 12 };
    const double near = 2e-3 * w->straight + 1e-5 * w->sum;
    rest_search search;
    int open = begin_points(at, points);
    aim_lanes aim = settle_roughly(w, at, g, &search);
    for (int look = 0; look < LOOKS && open > 0; look++) {
        const rest_sums d = moving ? rest_single(w, &search, aim.away.x, aim.away.y, true) : rest_single(w, &search, aim.away.x, aim.away.y, false);
        const vec2 left = vec2(aim.point.x - aim.away.x - d.shift.x, aim.point.y - aim.away.y - d.shift.z);
        float far[MGT_LANES], away_x[MGT_LANES], away_z[MGT_LANES];
        settled_lanes found;
        keep_lanes(w, &d, left, &found);
        store_lanes(far, left.x * left.x + left.y * left.y);
        store_lanes(away_x, aim.away.x);
        store_lanes(away_z, aim.away.y);
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const bool settled = (double)far[lane] <= near * near;
            if (points[lane].settled || !(settled || look + 1 == LOOKS))
                continue;
            points[lane] = point_of(&found, lane, (const double[]){g->x[lane] + (double)away_x[lane], g->z[lane] + (double)away_z[lane]}, settled);
            open -= settled;
        }
        const vec2 step = rest_steps(w, d.shift, left);
        aim.away = vec2(aim.away.x + step.x, aim.away.y + step.y);
    }
}

static void settle(const water_terms *w, const mgt_water_answers *asked, const double at[][2], rest_group *g, settled_point *points)
{
    if (asked->exact)
        settle_exact(w, at, g, points);
    else
        settle_single(w, asked->velocity, at, g, points);
}

/* Replaces the answer by that of the highest water at this point. Where water may fold, several places at rest may be shifted to the same point, so searches
 * start from places around the one that was found. */
static void settle_folded(const water_terms *w, const mgt_water_answers *asked, const double at[2], settled_point *p)
{
    enum { STARTS = 32 };
    static const double eighths[8][2] = {{1, 0},  {M_SQRT1_2, M_SQRT1_2},   {0, 1},  {-M_SQRT1_2, M_SQRT1_2},
                                         {-1, 0}, {-M_SQRT1_2, -M_SQRT1_2}, {0, -1}, {M_SQRT1_2, -M_SQRT1_2}};
    settled_point best = *p;
    for (int first = 0; first < STARTS; first += MGT_LANES) {
        rest_group g;
        double ats[MGT_LANES][2];
        settled_point found[MGT_LANES];
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const int k = first + lane < STARTS ? first + lane : STARTS - 1;
            /* The starts lie in eight directions at four distances. The first direction is that in which the water is most compressed. */
            const double away = 1.5 * w->straight * (1 + k / 8), c = p->worst[0], s = p->worst[1];
            const double *turn = eighths[k % 8];
            g.x[lane] = p->rest[0] + away * (c * turn[0] - s * turn[1]);
            g.z[lane] = p->rest[1] + away * (s * turn[0] + c * turn[1]);
            ats[lane][0] = at[0];
            ats[lane][1] = at[1];
        }
        settle(w, asked, ats, &g, found);
        for (int lane = 0; lane < MGT_LANES && first + lane < STARTS; lane++)
            if (found[lane].settled && (!best.settled || found[lane].height > best.height))
                best = found[lane];
    }
    *p = best;
}

#endif
