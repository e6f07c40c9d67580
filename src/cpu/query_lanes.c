/* SPDX-License-Identifier: MIT
 *
 * Queries of the water at points and along rays. Phases are computed and reduced in double precision, because points may be many wavelengths from the origin.
 * Sums over waves are in single or double precision.
 */
#include <math.h>
#include <stddef.h>

#include "cpu/query_lanes.h"

#include "kernels/common/prelude_c.h"

#include "kernels/common/math.k"

#include "cpu/rest_lane.h"
#include "cpu/wide_lane.h"

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

/* ---- a group of points ---- */

/* Points of water that is not choppy, one per lane, and sums over waves. */
typedef struct query_group {
    double x[MGT_LANES], z[MGT_LANES];
    double height[MGT_LANES], slope_x[MGT_LANES], slope_z[MGT_LANES], rise[MGT_LANES];
} query_group;

/* Fills the sums in single precision. `moving`: with the velocity. */
static inline __attribute__((always_inline)) void sum_single(const water_terms *w, query_group *g, bool moving)
{
    real height = real_broadcast(0), slope_x = height, slope_z = height, rise = height;
    const wide_places places = load_places(g->x, g->z);
    for (int i = 0; i < w->count; i++) {
        const SinCos t = sincos_turns(NULL, turns_of(w, i, &places));
        height = real_fma(t.s, real_broadcast(w->of[i].single.height), height);
        slope_x = real_fma(t.c, real_broadcast(w->of[i].single.slope_x), slope_x);
        slope_z = real_fma(t.c, real_broadcast(w->of[i].single.slope_z), slope_z);
        if (moving)
            rise = real_fma(t.c, real_broadcast(w->of[i].single.vertical_velocity), rise);
    }
    store_sum(g->height, height);
    store_sum(g->slope_x, slope_x);
    store_sum(g->slope_z, slope_z);
    store_sum(g->rise, rise);
}

static inline void sum_double(const water_terms *w, query_group *g)
{
    for (int half = 0; half < HALVES; half++) {
        const wide x = wide_load(g->x + half * WIDE), z = wide_load(g->z + half * WIDE);
        wide height = wide_of(0), slope_x = height, slope_z = height, rise = height;
        for (int i = 0; i < w->count; i++) {
            const wide_sine t = sine_of_turns(turns_at(w, i, x, z));
            height = wide_fma(t.sine, wide_of(w->of[i].height), height);
            slope_x = wide_fma(t.cosine, wide_of(w->of[i].slope_x), slope_x);
            slope_z = wide_fma(t.cosine, wide_of(w->of[i].slope_z), slope_z);
            rise = wide_fma(t.cosine, wide_of(w->of[i].vertical_velocity), rise);
        }
        wide_store(g->height + half * WIDE, height);
        wide_store(g->slope_x + half * WIDE, slope_x);
        wide_store(g->slope_z + half * WIDE, slope_z);
        wide_store(g->rise + half * WIDE, rise);
    }
}

/* ---- choppy water ---- */

static void write_choppy(const double at[2], const settled_point *p, double level, size_t i, mgt_water_answers *answers)
{
    const double here = 0 * (at[0] + at[1]);
    if (answers->height)
        answers->height[i] = here == 0 ? level + p->height : here;
    if (answers->normal) {
        const double x = -p->slope[0], z = -p->slope[1], inverse = 1 / __builtin_sqrt(x * x + 1 + z * z);
        answers->normal[3 * i] = here == 0 ? (float)(x * inverse) : (float)here;
        answers->normal[3 * i + 1] = here == 0 ? (float)inverse : (float)here;
        answers->normal[3 * i + 2] = here == 0 ? (float)(z * inverse) : (float)here;
    }
    if (answers->velocity)
        for (int c = 0; c < 3; c++)
            answers->velocity[3 * i + (size_t)c] = here == 0 ? (float)p->velocity[c] : (float)here;
    if (answers->jacobian)
        answers->jacobian[i] = here == 0 ? (float)p->jacobian : (float)here;
    answers->unsettled += !p->settled;
}

static void query_choppy(const water_terms *terms, double level, const double *points, size_t count, mgt_water_answers *answers, double *rest)
{
    for (size_t first = 0; first < count; first += MGT_LANES) {
        rest_group g;
        double at[MGT_LANES][2];
        settled_point found[MGT_LANES];
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const size_t i = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            at[lane][0] = g.x[lane] = points[2 * i];
            at[lane][1] = g.z[lane] = points[2 * i + 1];
            if (0 * (at[lane][0] + at[lane][1]) != 0)
                g.x[lane] = g.z[lane] = 0;
        }
        settle(terms, answers, at, &g, found);
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++) {
            const bool finite = 0 * (at[lane][0] + at[lane][1]) == 0;
            if (finite && (!found[lane].settled || found[lane].least < terms->folded))
                settle_folded(terms, answers, at[lane], &found[lane]);
            write_choppy(at[lane], &found[lane], level, first + (size_t)lane, answers);
            for (size_t c = 0; c < 2 && rest; c++)
                rest[2 * (first + (size_t)lane) + c] = finite ? found[lane].rest[c] : at[lane][c];
        }
    }
}

static void write_point(const query_group *g, int lane, double level, size_t i, const mgt_water_answers *answers)
{
    const double here = 0 * (g->x[lane] + g->z[lane]); /* 0, or NaN if the point is not finite */
    if (answers->height)
        answers->height[i] = level + g->height[lane] + here;
    if (answers->normal) {
        const double x = here - g->slope_x[lane], z = here - g->slope_z[lane], inverse = 1 / __builtin_sqrt(x * x + 1 + z * z);
        answers->normal[3 * i] = (float)(x * inverse);
        answers->normal[3 * i + 1] = (float)inverse;
        answers->normal[3 * i + 2] = (float)(z * inverse);
    }
    if (answers->jacobian)
        answers->jacobian[i] = (float)(1 + here);
    if (answers->velocity) {
        answers->velocity[3 * i] = answers->velocity[3 * i + 2] = (float)here;
        answers->velocity[3 * i + 1] = (float)(g->rise[lane] + here);
    }
}

void JOIN(query_lanes_, MGT_LANES)(const water_terms *terms, double level, const double *points, size_t count, mgt_water_answers *answers, double *rest)
{
    answers->unsettled = 0;
    if (terms->choppy) {
        query_choppy(terms, level, points, count, answers, rest);
        return;
    }
    for (size_t first = 0; first < count; first += MGT_LANES) {
        query_group g;
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const size_t i = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            g.x[lane] = points[2 * i];
            g.z[lane] = points[2 * i + 1];
        }
        if (answers->exact)
            sum_double(terms, &g);
        else if (answers->velocity)
            sum_single(terms, &g, true);
        else
            sum_single(terms, &g, false);
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++)
            write_point(&g, lane, level, first + (size_t)lane, answers);
    }
}

/* ---- rays ---- */

/* A ray whose hit with the surface is searched. Rates are per unit of `along`, the multiple of the ray's direction. */
typedef struct traced_ray {
    double origin[3], direction[3]; /* the origin's height is relative to the mean surface */
    double side;                    /* 1: the ray comes from above; −1: from below; 0: unknown so far */
    double closing, bend;           /* upper bounds of the rate at which the gap shrinks, and of the growth of this rate */
    double along, speed;            /* `speed`: metres per unit of `along` */
    double shift[2];                /* estimate of the shift of choppy water at `along` */
    int tries;                      /* number of steps of this estimate at `along` */
    double outside;                 /* in water that folds: the last `along` on the ray's side of the surface */
    bool arrived;
} traced_ray;

/* A ray at the point at which it enters the slab that contains the surface. */
static traced_ray ray_start(const water_terms *w, double level, const double *ray, double crest, double reach)
{
    traced_ray r = {.origin = {ray[0], ray[1] - level, ray[2]}, .direction = {ray[3], ray[4], ray[5]}};
    double length = 0, finite = 0;
    for (int c = 0; c < 3; c++) {
        length += r.direction[c] * r.direction[c];
        finite += 0 * (r.origin[c] + r.direction[c]);
    }
    if (!(length >= 0.99e-200) || finite != 0 || !(length <= 1.01e200)) {
        r.along = __builtin_nan("");
        r.arrived = true;
        return r;
    }
    r.speed = __builtin_sqrt(length);
    r.bend = 1e-12 * length;
    double slope = 0;
    for (int i = 0; i < w->count; i++) {
        const double turns = w->of[i].along_x * r.direction[0] + w->of[i].along_z * r.direction[2], radians = 6.28318530717958647692 * turns;
        slope += __builtin_fabs(w->of[i].height * radians);
        r.bend += w->of[i].height * radians * radians;
    }
    if (w->choppy) {
        /* A wave of slope S that is compressed by at most P has a slope of at most S/√(1 − P²). The curvature on its crest is that at rest over (1 − P)². So is
         * that of a short wave on the crest of a long one. */
        slope /= __builtin_sqrt(1 - w->pressed * w->pressed);
        r.bend /= (1 - w->pressed) * (1 - w->pressed);
    }
    r.closing = slope + __builtin_fabs(r.direction[1]) + 1e-12 * r.speed;
    const double above = __builtin_fabs(r.origin[1]) - crest;
    if (above > 0) {
        const double toward = r.origin[1] > 0 ? -r.direction[1] : r.direction[1];
        r.along = toward > 0 ? above / toward : __builtin_inf();
        r.arrived = !(r.along <= reach);
        if (r.arrived)
            r.along = __builtin_inf();
    }
    return r;
}

/* A step that skips no crest, as search_step() in search_step.k. Near the surface it approaches Newton's step. */
static double ray_step(const traced_ray *r, double gap, double closing)
{
    const double root = __builtin_sqrt(closing * closing + 2 * r->bend * gap), spare = r->closing - closing;
    if (root > r->closing)
        return gap / r->closing + spare * spare / (2 * r->closing * r->bend);
    return closing > 0 ? 2 * gap / (root + closing) : (root - closing) / r->bend;
}

static void ray_advance(traced_ray *r, double height, double slope_x, double slope_z, double crest, double reach)
{
    double gap = r->origin[1] + r->direction[1] * r->along - height;
    if (r->side == 0)
        r->side = gap >= 0 ? 1 : -1;
    gap = gap * r->side > 0 ? gap * r->side : 0;
    const double closing = r->side * (slope_x * r->direction[0] + slope_z * r->direction[2] - r->direction[1]);
    const double step = ray_step(r, gap, closing), out = r->side * (r->origin[1] + r->direction[1] * r->along);
    if (gap <= 1e-9 || step <= 1e-9 * (r->along + 1 / r->speed)) {
        r->arrived = true;
        r->along += closing > 0 ? gap / closing < step ? gap / closing : step : 0;
        return;
    }
    r->along += step;
    const bool leaves = out > crest && r->side * r->direction[1] >= 0;
    if (r->along > reach || leaves) {
        r->along = __builtin_inf();
        r->arrived = true;
    }
}

/* The highest water of a fold ends abruptly under an overhanging crest, so a step may pass its end. The end is then found by bisection between a point before
 * and a point behind it. True: the ray has been moved back, and its point must be evaluated again. */
static bool ray_returns(traced_ray *r, double height)
{
    const double gap = (r->origin[1] + r->direction[1] * r->along - height) * r->side;
    if (!(gap < -1e-9)) {
        r->outside = r->along;
        return false;
    }
    if (r->side == 0 || r->along - r->outside <= 1e-9 * (r->along + 1 / r->speed))
        return false;
    r->along = 0.5 * (r->outside + r->along);
    return true;
}

/* Evaluates the water at the rays' points. Where it folds, the highest water counts, as in queries. */
static void look_at_folds(const water_terms *w, const traced_ray *r, query_group *g)
{
    mgt_water_answers exact = {.exact = 1};
    rest_group rest;
    double at[MGT_LANES][2];
    settled_point found[MGT_LANES];
    for (int lane = 0; lane < MGT_LANES; lane++) {
        at[lane][0] = rest.x[lane] = r[lane].arrived ? 0 : g->x[lane];
        at[lane][1] = rest.z[lane] = r[lane].arrived ? 0 : g->z[lane];
    }
    settle(w, &exact, at, &rest, found);
    for (int lane = 0; lane < MGT_LANES; lane++) {
        if (!r[lane].arrived && (!found[lane].settled || found[lane].least < w->folded))
            settle_folded(w, &exact, at[lane], &found[lane]);
        g->height[lane] = found[lane].height;
        g->slope_x[lane] = found[lane].slope[0];
        g->slope_z[lane] = found[lane].slope[1];
    }
}

/* Evaluates the water at the rays' points. In choppy water each call takes one step towards the place at rest. `ready`: lanes whose place has been found. */
static void look_at_points(const water_terms *w, traced_ray *r, query_group *g, bool *ready)
{
    if (!w->choppy || w->folds) {
        if (w->folds)
            look_at_folds(w, r, g);
        else
            sum_double(w, g);
        for (int lane = 0; lane < MGT_LANES; lane++)
            ready[lane] = true;
        return;
    }
    enum { MOST_TRIES = 200 };
    rest_group rest;
    for (int lane = 0; lane < MGT_LANES; lane++) {
        rest.x[lane] = g->x[lane] - r[lane].shift[0];
        rest.z[lane] = g->z[lane] - r[lane].shift[1];
    }
    rest_double(w, &rest);
    for (int lane = 0; lane < MGT_LANES; lane++) {
        const double left[2] = {r[lane].shift[0] - rest.shift_x[lane], r[lane].shift[1] - rest.shift_z[lane]};
        const double squared = left[0] * left[0] + left[1] * left[1], straight = w->straight * w->straight;
        double value[2], direction[2], step[2] = {left[0], left[1]}, slope[2];
        stretch_of(rest.xx[lane], rest.xz[lane], rest.zz[lane], value, direction);
        const double least = 1 - w->pressed, most = value[0] > least ? value[0] : least;
        value[1] = value[1] > least ? value[1] : least;
        if (squared < straight) {
            to_rest_by(most, value[1], direction, left, step);
            const double far = step[0] * step[0] + step[1] * step[1];
            if (far > straight) { /* Newton's step is too long where the water is most compressed */
                const double shorter = __builtin_sqrt(straight / far);
                step[0] *= shorter;
                step[1] *= shorter;
            }
        }
        to_rest_by(most, value[1], direction, (const double[]){rest.slope_x[lane], rest.slope_z[lane]}, slope);
        r[lane].shift[0] -= step[0];
        r[lane].shift[1] -= step[1];
        g->height[lane] = rest.height[lane] + slope[0] * left[0] + slope[1] * left[1];
        g->slope_x[lane] = slope[0];
        g->slope_z[lane] = slope[1];
        ready[lane] = squared < 1e-8 * straight * (1 - w->pressed) * (1 - w->pressed) || ++r[lane].tries >= MOST_TRIES;
        if (ready[lane])
            r[lane].tries = 0;
    }
}

void JOIN(trace_lanes_, MGT_LANES)(const water_terms *terms, double level, const double *rays, size_t count, double reach, double *distance)
{
    enum { MOST_LOOKS = 100000 };
    double crest = 1e-9;
    for (int i = 0; i < terms->count; i++)
        crest += terms->of[i].height;
    for (size_t first = 0; first < count; first += MGT_LANES) {
        traced_ray r[MGT_LANES];
        query_group g;
        int travelling = 0;
        for (int lane = 0; lane < MGT_LANES; lane++) {
            const size_t i = first + (size_t)lane < count ? first + (size_t)lane : count - 1;
            r[lane] = ray_start(terms, level, rays + 6 * i, crest, reach);
            travelling += !r[lane].arrived;
        }
        for (int look = 0; look < MOST_LOOKS && travelling > 0; look++) {
            for (int lane = 0; lane < MGT_LANES; lane++) {
                const double along = r[lane].arrived ? 0 : r[lane].along;
                g.x[lane] = r[lane].origin[0] + r[lane].direction[0] * along;
                g.z[lane] = r[lane].origin[2] + r[lane].direction[2] * along;
            }
            bool ready[MGT_LANES];
            look_at_points(terms, r, &g, ready);
            travelling = 0;
            for (int lane = 0; lane < MGT_LANES; lane++) {
                if (!r[lane].arrived && ready[lane] && !(terms->folds && ray_returns(&r[lane], g.height[lane])))
                    ray_advance(&r[lane], g.height[lane], g.slope_x[lane], g.slope_z[lane], crest, reach);
                travelling += !r[lane].arrived;
            }
        }
        for (int lane = 0; lane < MGT_LANES && first + (size_t)lane < count; lane++)
            distance[first + (size_t)lane] = r[lane].arrived ? r[lane].along : __builtin_nan("");
    }
}
