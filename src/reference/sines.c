/* SPDX-License-Identifier: MIT
 *
 * Sine waves in double precision.
 */
#include "reference/sines.h"

#include <math.h>
#include <stdlib.h>

#include "reference/equations.h"

static const long double pi = 3.14159265358979323846264338327950288L;

/* Choppy water at a place of rest: its height, its shift, and their derivatives, from which those of the shifted surface follow. */
typedef struct rest_sums {
    water_point flat;  /* height and its derivatives at rest */
    double shift[2];   /* metres */
    double stretch[3]; /* xx, xz, zz of 1 + ∂shift/∂place */
    double bend[4];    /* xxx, xxz, xzz, zzz of ∂²shift/∂place² */
} rest_sums;

static rest_sums sums_at_rest(const mgt_water *water, double x, double z, double time)
{
    rest_sums r = {.stretch = {1, 0, 1}};
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *wave = &water->waves[i];
        const double phase = wave->kx * x + wave->kz * z + wave->omega * time + wave->phase;
        const double sine = wave->amplitude * sin(phase), cosine = wave->amplitude * cos(phase);
        r.flat.height += sine;
        r.flat.slope[0] += wave->kx * cosine;
        r.flat.slope[1] += wave->kz * cosine;
        r.flat.hessian[0] -= wave->kx * wave->kx * sine;
        r.flat.hessian[1] -= wave->kx * wave->kz * sine;
        r.flat.hessian[2] -= wave->kz * wave->kz * sine;
        const double k = hypot(wave->kx, wave->kz), shift = k > 0 ? (double)water->choppiness / k : 0;
        r.shift[0] += shift * wave->kx * cosine;
        r.shift[1] += shift * wave->kz * cosine;
        r.stretch[0] -= shift * wave->kx * wave->kx * sine;
        r.stretch[1] -= shift * wave->kx * wave->kz * sine;
        r.stretch[2] -= shift * wave->kz * wave->kz * sine;
        r.bend[0] -= shift * wave->kx * wave->kx * wave->kx * cosine;
        r.bend[1] -= shift * wave->kx * wave->kx * wave->kz * cosine;
        r.bend[2] -= shift * wave->kx * wave->kz * wave->kz * cosine;
        r.bend[3] -= shift * wave->kz * wave->kz * wave->kz * cosine;
    }
    return r;
}

/* The surface at the place x = u + D(u) to which the water is shifted, with derivatives by x. */
static water_point shifted_surface(const rest_sums *r)
{
    const double *b = r->stretch, det = b[0] * b[2] - b[1] * b[1];
    const double u[2][2] = {{b[2] / det, -b[1] / det}, {-b[1] / det, b[0] / det}}; /* ∂u/∂x */
    water_point p = {.height = r->flat.height};
    for (int i = 0; i < 2; i++)
        p.slope[i] = u[i][0] * r->flat.slope[0] + u[i][1] * r->flat.slope[1];
    const double rest[3] = {r->flat.hessian[0] - p.slope[0] * r->bend[0] - p.slope[1] * r->bend[1],
                            r->flat.hessian[1] - p.slope[0] * r->bend[1] - p.slope[1] * r->bend[2],
                            r->flat.hessian[2] - p.slope[0] * r->bend[2] - p.slope[1] * r->bend[3]};
    for (int i = 0; i < 3; i++) {
        const double *left = u[i == 2], *right = u[i > 0];
        p.hessian[i] = left[0] * (rest[0] * right[0] + rest[1] * right[1]) + left[1] * (rest[1] * right[0] + rest[2] * right[1]);
    }
    return p;
}

water_point water_surface(const mgt_water *water, double x, double z, double time)
{
    double u[2] = {x, z};
    rest_sums r = sums_at_rest(water, x, z, time);
    if (!(water->choppiness > 0))
        return r.flat;
    /* Newton's steps, shortened until they come nearer; if none does, half a fixed-point step, which always comes nearer. */
    for (int i = 0; i < 300; i++) {
        const double left[2] = {x - u[0] - r.shift[0], z - u[1] - r.shift[1]}, off = hypot(left[0], left[1]);
        if (off < 1e-14 * (1 + fabs(x) + fabs(z)))
            break;
        const double *b = r.stretch, det = b[0] * b[2] - b[1] * b[1];
        const double newton[2] = {(b[2] * left[0] - b[1] * left[1]) / det, (b[0] * left[1] - b[1] * left[0]) / det};
        double part = 1;
        for (int halvings = 0; halvings < 6; halvings++, part /= 2) { /* as far as it comes nearer */
            const rest_sums next = sums_at_rest(water, u[0] + part * newton[0], u[1] + part * newton[1], time);
            if (hypot(x - u[0] - part * newton[0] - next.shift[0], z - u[1] - part * newton[1] - next.shift[1]) < off)
                break;
        }
        const bool nearer = part > 0.02 && det > 0;
        u[0] += nearer ? part * newton[0] : 0.5 * left[0];
        u[1] += nearer ? part * newton[1] : 0.5 * left[1];
        r = sums_at_rest(water, u[0], u[1], time);
    }
    return shifted_surface(&r);
}

void water_worst_case(const mgt_water *water, const double direction[3], double *height, double *slope)
{
    double steepest = 0;
    *height = *slope = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *wave = &water->waves[i];
        *height += fabs(wave->amplitude);
        *slope += fabs(wave->amplitude * (wave->kx * direction[0] + wave->kz * direction[2]));
        steepest += fabs(wave->amplitude) * hypot(wave->kx, wave->kz);
    }
    /* If the steepest slope of sines is S, then choppiness compresses the surface by at most choppiness · S, which makes slopes steeper. */
    const double pressed = fmin((double)water->choppiness * steepest, 0.9);
    *slope /= 1 - pressed;
}

/* long double, because a camera may stand at phases of 10⁷ radians. */
static double reduced_half_turns(const mgt_wave *wave, const mgt_scene *scene)
{
    const long double phase = (long double)wave->kx * scene->camera.position[0] + (long double)wave->kz * scene->camera.position[2] +
                              (long double)wave->omega * scene->time + (long double)wave->phase;
    return (double)remainderl(phase / pi, 2.0L);
}

static const uint32_t most_single = 32; /* up to as many waves a single level is as fast; chosen by measurements */

static int order_of(double a, double b) { return (a > b) - (a < b); }

/* The longest first; waves that tie in everything may stand in any order. */
static int compare_waves(const void *left, const void *right)
{
    const reference_wave *p = left, *q = right;
    int order = order_of(p->a * p->a + p->b * p->b, q->a * q->a + q->b * q->b);
    order = order ? order : order_of(p->a, q->a);
    order = order ? order : order_of(p->b, q->b);
    order = order ? order : order_of(p->amplitude, q->amplitude);
    order = order ? order : order_of(p->half_turns_c, q->half_turns_c);
    return order ? order : order_of(p->phase, q->phase);
}

void reference_waves_of(const mgt_scene *scene, reference_wave *out)
{
    for (size_t i = 0; i < scene->water.wave_count; i++) {
        const mgt_wave *from = &scene->water.waves[i];
        out[i] = (reference_wave){.amplitude = from->amplitude,
                                  .a = from->kx,
                                  .b = from->kz,
                                  .amplitude_a = from->amplitude * from->kx,
                                  .amplitude_b = from->amplitude * from->kz,
                                  .half_turns_a = (double)(from->kx / pi),
                                  .half_turns_b = (double)(from->kz / pi),
                                  .half_turns_c = (double)(from->omega / pi),
                                  .phase = reduced_half_turns(from, scene)};
    }
    if (scene->water.wave_count > most_single)
        qsort(out, scene->water.wave_count, sizeof *out, compare_waves);
}

double reference_waves_bound(const reference_wave *waves, size_t count, double deviations)
{
    double sum = 0, square = 0;
    for (size_t i = 0; i < count; i++) {
        sum += fabs(waves[i].amplitude);
        square += waves[i].amplitude * waves[i].amplitude;
    }
    return fmin(sum, deviations * sqrt(0.5 * square));
}

/* Sum of the squared second derivatives' amplitudes. */
static double square_curvature(const reference_wave *waves, size_t count)
{
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        const double curvature = waves[i].amplitude * (waves[i].a * waves[i].a + waves[i].b * waves[i].b);
        square += curvature * curvature;
    }
    return square;
}

uint32_t reference_levels_of(const reference_wave *waves, uint32_t count, double deviations, reference_level levels[REFERENCE_LEVELS])
{
    const double ratio = 2; /* least ratio of the curvatures of neighbouring levels; chosen by measurements */
    uint32_t waves_of[REFERENCE_LEVELS] = {count}, used = 1;
    uint32_t fewer = count <= REFERENCE_MOST_WAVES ? (count - 1) / REFERENCE_BLOCK * REFERENCE_BLOCK : REFERENCE_MOST_WAVES;
    while (count > most_single && used < REFERENCE_LEVELS && fewer > 0) {
        if (square_curvature(waves, fewer) * ratio * ratio <= square_curvature(waves, waves_of[used - 1]))
            waves_of[used++] = fewer;
        fewer -= REFERENCE_BLOCK;
    }
    for (uint32_t level = 0; level < used; level++) {
        const uint32_t now = waves_of[used - 1 - level];
        levels[level] = (reference_level){.waves = now, .rest = reference_waves_bound(waves + now, count - now, deviations)};
        levels[level].random = levels[level].rest < reference_waves_bound(waves + now, count - now, HUGE_VAL);
        for (uint32_t i = 0; i < now; i++)
            levels[level].amplitudes += fabs(waves[i].amplitude);
    }
    return used;
}

void reference_columns_of(const reference_wave *waves, uint32_t count, reference_columns *columns)
{
    *columns = (reference_columns){0};
    for (uint32_t i = 0; i < count && i < REFERENCE_MOST_WAVES; i++) {
        columns->half_turns_a[i] = waves[i].half_turns_a;
        columns->half_turns_b[i] = waves[i].half_turns_b;
        columns->half_turns_c[i] = waves[i].half_turns_c;
        columns->phase[i] = waves[i].phase;
        columns->amplitude_a[i] = waves[i].amplitude_a;
        columns->amplitude_b[i] = waves[i].amplitude_b;
        columns->amplitude[i] = (float)waves[i].amplitude;
    }
}

void reference_columns_shift(const reference_wave *waves, uint32_t count, double choppiness, reference_columns *columns)
{
    for (uint32_t i = 0; i < count && i < REFERENCE_MOST_WAVES; i++) {
        const reference_wave *w = &waves[i];
        const double k = hypot(w->a, w->b), shift = k > 0 ? choppiness / k : 0;
        columns->height[i] = w->amplitude;
        columns->shift_a[i] = shift * w->amplitude_a;
        columns->shift_b[i] = shift * w->amplitude_b;
        columns->press_aa[i] = shift * w->amplitude_a * w->a;
        columns->press_ab[i] = shift * w->amplitude_a * w->b;
        columns->press_bb[i] = shift * w->amplitude_b * w->b;
    }
}

/* Bound of the derivative of this order of the waves' height. */
static double derivative_bound(const reference_wave *waves, uint32_t count, int order, double deviations)
{
    double sum = 0, square = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double most = fabs(waves[i].amplitude) * pow(hypot(waves[i].a, waves[i].b), order);
        sum += most;
        square += most * most;
    }
    return fmin(sum, deviations * sqrt(0.5 * square));
}

void choppy_levels_of(const reference_wave *waves, double choppiness, double deviations, const reference_level *levels, uint32_t level_count, choppy_level *out)
{
    const uint32_t all = levels[level_count - 1].waves;
    const double size = fabs(choppiness);
    for (uint32_t i = 0; i < level_count; i++) {
        const uint32_t count = levels[i].waves;
        const double slope = derivative_bound(waves, count, 1, deviations), bend = derivative_bound(waves, count, 2, deviations);
        /* A step along the curve goes sideways, too, because the shift changes its direction. */
        const double pressed = fmin(size * slope, 0.9), aside = 1 + pressed;
        out[i] = (choppy_level){.waves = count,
                                .shift = size * derivative_bound(waves, all, 0, deviations),
                                .rest = levels[i].rest,
                                .rest_shift = size * levels[i].rest * slope * aside,
                                .slope = slope,
                                .bend = bend * aside * aside * (1 + pressed),
                                .most_stretch = aside,
                                .shift_bend = size * bend * aside * aside};
    }
}

void choppy_bend_at_rest(const reference_wave *waves, uint32_t count, double choppiness, const double place[3], const double slope[2], double bend[3],
                         choppy_sums *sums)
{
    *sums = (choppy_sums){.stretch = {1, 0, 1}};
    bend[0] = bend[1] = bend[2] = 0;
    for (uint32_t i = 0; i < count; i++) {
        const reference_wave *w = &waves[i];
        const double half_turns = place[0] * w->half_turns_a + place[1] * w->half_turns_b + place[2] * w->half_turns_c + w->phase;
        const double phase = (double)pi * remainder(half_turns, 2), sine = sin(phase), cosine = cos(phase);
        const double k = hypot(w->a, w->b), shift = k > 0 ? choppiness / k : 0;
        /* −∂²h: A sin ψ k k; ∂²D_i: −shift A cos ψ k_i k k. */
        const double part = -w->amplitude * sine + shift * w->amplitude * cosine * (slope[0] * w->a + slope[1] * w->b);
        bend[0] += part * w->a * w->a;
        bend[1] += part * w->a * w->b;
        bend[2] += part * w->b * w->b;
        sums->stretch[0] -= shift * w->amplitude_a * w->a * sine;
        sums->stretch[1] -= shift * w->amplitude_a * w->b * sine;
        sums->stretch[2] -= shift * w->amplitude_b * w->b * sine;
    }
}

static double farthest(const double sides[4][2], const reference_wave *wave)
{
    double most = 0;
    for (int i = 0; i < 4; i++)
        most = fmax(most, fabs(wave->a * sides[i][0] + wave->b * sides[i][1]));
    return most;
}

reference_bend reference_waves_bend(const reference_wave *waves, uint32_t count, const double sides[2][4][2], const double whole[2], const double axes[2][2])
{
    reference_bend bend = {{0}, {0}, {0}, 0};
    for (const reference_wave *wave = waves; wave < waves + count; wave++) {
        const double first = 0.5 * farthest(sides[0], wave), second = 0.5 * farthest(sides[1], wave); /* radians to the border */
        bend.height += fabs(wave->amplitude) * fmin(first * whole[0] + second * whole[1], 2);
        for (int axis = 0; axis < 2; axis++) {
            const double slope = 0.5 * fabs(wave->amplitude_a * axes[axis][0] + wave->amplitude_b * axes[axis][1]);
            bend.first[axis] += slope * first * first;
            bend.both[axis] += slope * 2 * first * second;
            bend.second[axis] += slope * second * second;
        }
    }
    return bend;
}

double reference_waves_straight(const reference_wave *waves, uint32_t count, double share)
{
    double square = 0, bend = 0;
    for (const reference_wave *wave = waves; wave < waves + count; wave++) {
        const double squared_length = wave->a * wave->a + wave->b * wave->b, slope = fabs(wave->amplitude) * sqrt(squared_length);
        square += 0.5 * slope * slope;
        bend += 0.5 * slope * squared_length;
    }
    return bend > 0 ? 2 * sqrt(share * sqrt(0.5 * square) / bend) : HUGE_VAL;
}

void reference_waves_mirror(reference_wave *waves, size_t count)
{
    for (size_t i = 0; i < count; i++)
        waves[i].phase += 1; /* half a turn, so that amplitudes stay positive, as the bounds need them */
}
