/* SPDX-License-Identifier: MIT
 *
 * Another model of the water behind water.k: a periodic table of heights, a cubic B-spline that drifts with the wind. The kernels that search to the
 * first hit, take Newton's last steps and filter a pixel are those of the library; only sines.k is replaced.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include "unit/random_numbers.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */

/* ---- the table in double ---- */

enum { SIDE = 32 };

typedef struct height_table {
    double texel;    /* metres */
    double drift[2]; /* metres that it moves in half of the shutter */
    double coefficients[SIDE][SIDE];
} height_table;

typedef struct table_point {
    double height, slope[2], hessian[3];
} table_point;

/* The B-spline's four weights at t in [0, 1] after the first of the middle two, and their derivatives. */
static void spline_weights(double t, double w[4], double d[4], double dd[4])
{
    const double s = 1 - t;
    w[0] = s * s * s / 6, w[1] = (3 * t * t * t - 6 * t * t + 4) / 6, w[2] = (3 * s * s * s - 6 * s * s + 4) / 6, w[3] = t * t * t / 6;
    d[0] = -s * s / 2, d[1] = (3 * t * t - 4 * t) / 2, d[2] = -(3 * s * s - 4 * s) / 2, d[3] = t * t / 2;
    dd[0] = s, dd[1] = 3 * t - 2, dd[2] = 3 * s - 2, dd[3] = t;
}

static table_point table_at(const height_table *table, double x, double z)
{
    const double u = x / table->texel, v = z / table->texel, left = floor(u), top = floor(v);
    double wx[4], dx[4], ddx[4], wz[4], dz[4], ddz[4];
    spline_weights(u - left, wx, dx, ddx);
    spline_weights(v - top, wz, dz, ddz);
    table_point p = {0};
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) {
            const double c = table->coefficients[((int)top + j - 1) & (SIDE - 1)][((int)left + i - 1) & (SIDE - 1)];
            p.height += c * wx[i] * wz[j];
            p.slope[0] += c * dx[i] * wz[j] / table->texel;
            p.slope[1] += c * wx[i] * dz[j] / table->texel;
            p.hessian[0] += c * ddx[i] * wz[j] / (table->texel * table->texel);
            p.hessian[1] += c * dx[i] * dz[j] / (table->texel * table->texel);
            p.hessian[2] += c * wx[i] * ddz[j] / (table->texel * table->texel);
        }
    return p;
}

/* ---- the model ---- */

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/common/types.k"
#include "kernels/waves/foam_types.k"

typedef struct WaveData {
    const height_table *table;
} WaveData;
typedef WaveData SearchWave;

struct kernel_context {
    const FrameData *frame;
    const TileData *tile;
    WaveData wave[1];
    double *found; /* of each row of a column, how far along its ray its hit is */
};

#define FRAME(cx) (*(cx)->frame)
#define TILE(cx) (*(cx)->tile)
#define CHOPPY(cx) (TILE(cx).pressed > 0.0f ? 1 : 0)
#define PARTS(cx) TILE(cx).parts
#define FOAMY(cx) 0
#define FOAM(cx) ((FoamData){0})
#define FOAM_WAVE(cx, i) ((FoamWave){0})
#define FOAM_SINE(cx, i) ((FoamSine){0})
#define WAVE(cx, i) ((cx)->wave[i])
#define SEARCH_WAVE(cx, i) ((cx)->wave[i])
#define UPWELLING(cx) vec3(0.0f, 0.0f, 0.0f)
#define MIRRORS_OBJECTS(cx) 0
#define OBJECTS_COVERAGE(cx) 0.0f
#define OBJECTS_COLOR(cx) vec3(0.0f, 0.0f, 0.0f)
#define CLEAR_TO_LIGHT(cx) vec3(1.0f, 1.0f, 1.0f)
#define DEEP_WATER(cx) vec3(0.0f, 0.0f, 0.0f)
#define FRONT_COVERAGE(cx) 0.0f
#define SKYLINE(cx, i) vec2(0.0f, 0.0f)
#define SKY_TEXEL(cx, column, row) scale(vec3(column, row, 0.0f), 0.0f)

#define WAVE_MODEL /* instead of sines.k */
#include "kernels/waves/water.k"

typedef struct place {
    double x, z;
} place;

KERNEL place wave_at(CTX cx, WaveData w, real x, real z) { return (place){(double)x, (double)z}; }
KERNEL place wave_coarsely_at(CTX cx, WaveData w, real x, real z) { return wave_at(cx, w, x, z); }

/* `sign`: −1 when the shutter opens, 1 when it closes. */
static table_point drifted(const height_table *t, place p, int sign) { return table_at(t, p.x - sign * t->drift[0], p.z - sign * t->drift[1]); }

static Surface add_point(Surface s, table_point middle, table_point open, table_point close)
{
    s.height_even += (float)((open.height + close.height) / 2);
    s.height_odd += (float)((close.height - open.height) / 2);
    s.slope_even = add(s.slope_even, vec2((float)((open.slope[0] + close.slope[0]) / 2), (float)((open.slope[1] + close.slope[1]) / 2)));
    s.slope_odd = add(s.slope_odd, vec2((float)((open.slope[0] - close.slope[0]) / 2), (float)((open.slope[1] - close.slope[1]) / 2)));
    s.bend_xx += (float)middle.hessian[0];
    s.bend_xz += (float)middle.hessian[1];
    s.bend_zz += (float)middle.hessian[2];
    return s;
}

KERNEL Surface add_instant(CTX cx, Surface s, WaveData w, place p)
{
    const table_point here = drifted(w.table, p, 0);
    return add_point(s, here, here, here);
}

KERNEL Surface add_wave(CTX cx, Surface s, WaveData w, place p)
{
    return add_point(s, drifted(w.table, p, 0), drifted(w.table, p, -1), drifted(w.table, p, 1));
}

/* Means over taps in the pixel; what they vary by beside their bend is unresolved. */
KERNEL Surface add_filtered(CTX cx, Surface s, WaveData w, place p, Footprint f)
{
    enum { TAPS = 8 };
    table_point mean[3] = {{0}};
    double square[3] = {0};
    for (int k = 0; k < TAPS * TAPS; k++) {
        const double u = (k % TAPS + 0.5) / TAPS - 0.5, v = (k / TAPS + 0.5) / TAPS - 0.5;
        const place at = {p.x + u * (double)f.right.x + v * (double)f.down.x, p.z + u * (double)f.right.y + v * (double)f.down.y};
        for (int sign = -1; sign <= 1; sign++) {
            const table_point one = drifted(w.table, at, sign);
            table_point *sum = &mean[sign + 1];
            sum->height += one.height / (TAPS * TAPS);
            for (int i = 0; i < 2; i++)
                sum->slope[i] += one.slope[i] / (TAPS * TAPS);
            for (int i = 0; i < 3; i++) {
                sum->hessian[i] += one.hessian[i] / (TAPS * TAPS);
                square[i] += sign == 0 ? one.slope[i == 2] * one.slope[i != 0] / (TAPS * TAPS) : 0;
            }
        }
    }
    const table_point *m = &mean[1];
    double lost[3];
    for (int i = 0; i < 3; i++)
        lost[i] = square[i] - m->slope[i == 2] * m->slope[i != 0];
    const double side[2][2] = {{(double)f.right.x, (double)f.right.y}, {(double)f.down.x, (double)f.down.y}};
    for (int k = 0; k < 2; k++) {
        const double bx = m->hessian[0] * side[k][0] + m->hessian[1] * side[k][1], bz = m->hessian[1] * side[k][0] + m->hessian[2] * side[k][1];
        lost[0] -= bx * bx / 12, lost[1] -= bx * bz / 12, lost[2] -= bz * bz / 12;
    }
    s = add_point(s, *m, mean[0], mean[2]);
    s.variance_xx += (float)lost[0];
    s.variance_xz += (float)lost[1];
    s.variance_zz += (float)lost[2];
    return s;
}

KERNEL vec2 add_filtered_slope(CTX cx, vec2 slope, WaveData w, place p, Footprint f)
{
    const Surface s = add_filtered(cx, (Surface){0}, w, p, f);
    return (vec2){slope.x + s.slope_even.x, slope.y + s.slope_even.y};
}

/* A table has no parts that are resolved in part. */
KERNEL Surface add_shared(CTX cx, Surface s, WaveData w, Footprint f)
{
    (void)cx, (void)w, (void)f;
    return s;
}

KERNEL SearchSums add_searched(CTX cx, SearchSums s, SearchWave w, bool live, bool coarse, real x, real z)
{
    (void)coarse;
    const table_point p = table_at(w.table, (double)x, (double)z);
    const double share = live ? 1 : 0;
    s.height += (float)(share * p.height);
    s.slope = add(s.slope, vec2((float)(share * p.slope[0]), (float)(share * p.slope[1])));
    return s;
}

/* A table is not choppy. */
KERNEL SearchSums add_searched_shift(CTX cx, SearchSums s, SearchWave w, bool live, bool coarse, real x, real z)
{
    return add_searched(cx, s, w, live, coarse, x, z);
}

KERNEL RestSums add_instant_at_rest(CTX cx, RestSums r, WaveData w, place t)
{
    r.surface = add_instant(cx, r.surface, w, t);
    return r;
}

KERNEL RestSums add_wave_at_rest(CTX cx, RestSums r, WaveData w, place t)
{
    r.surface = add_wave(cx, r.surface, w, t);
    return r;
}

KERNEL RestSums add_filtered_at_rest(CTX cx, RestSums r, WaveData w, place t, Footprint p)
{
    r.surface = add_filtered(cx, r.surface, w, t, p);
    return r;
}

#include "kernels/glitter/glitter.k"
#include "kernels/glitter/pixel.k"

static void keep_hit(const struct kernel_context *cx, float row, HitEstimate hit, bool where);
#define HIT_FOUND(cx, column, row, hit, where) keep_hit(cx, row, hit, where)

#include "kernels/glitter/lattice.k"
#include "kernels/glitter/sample.k"

#include "unit/kernel_words_off.h"

/* ---- tests ---- */

/* The B-spline stays within its coefficients, its derivatives within their differences. */
static TileData tile_of(const height_table *t, double camera_height)
{
    double height = 0, slope[2] = {0}, bend[3] = {0};
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            const int right = (i + 1) % SIDE, left = (i + SIDE - 1) % SIDE, below = (j + 1) % SIDE, above = (j + SIDE - 1) % SIDE;
            const double(*c)[SIDE] = t->coefficients;
            height = fmax(height, fabs(c[j][i]));
            slope[0] = fmax(slope[0], fabs(c[j][right] - c[j][i]));
            slope[1] = fmax(slope[1], fabs(c[below][i] - c[j][i]));
            bend[0] = fmax(bend[0], fabs(c[j][right] - 2 * c[j][i] + c[j][left]));
            bend[1] = fmax(bend[1], fabs(c[below][right] - c[below][i] - c[j][right] + c[j][i]));
            bend[2] = fmax(bend[2], fabs(c[below][i] - 2 * c[j][i] + c[above][i]));
        }
    return (TileData){.camera_height = (float)camera_height,
                      .resolved_count = 1,
                      .search_count = 1,
                      .hit_rows = 1,
                      .coarse_count = 1,
                      .search_bound = (float)height,
                      .search_slope = (float)(hypot(slope[0], slope[1]) / t->texel),
                      .search_bend = (float)((fmax(bend[0], bend[2]) + bend[1]) / (t->texel * t->texel)),
                      .search_tolerance = (float)(0.02 * t->texel),
                      .far_distance = 1e5f};
}

static height_table rough_table(random_state *r)
{
    height_table t = {.texel = 0.4, .drift = {0.11, -0.07}};
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++)
            t.coefficients[j][i] = random_range(r, -0.25, 0.25);
    return t;
}

/* The first place along a ray under the surface: steps of a thousandth of a texel, then halving. */
static double brute_force(const height_table *t, double camera_height, const double ray[3], double step, double end)
{
    double above = 0;
    for (double along = 0; along < end; above = along, along += step)
        if (camera_height + along * ray[1] < table_at(t, along * ray[0], along * ray[2]).height) {
            double below = along;
            for (int i = 0; i < 60; i++) {
                const double middle = (above + below) / 2;
                if (camera_height + middle * ray[1] < table_at(t, middle * ray[0], middle * ray[2]).height)
                    below = middle;
                else
                    above = middle;
            }
            return below;
        }
    return HUGE_VAL;
}

static void first_hits_are_those_of_brute_force(void **state)
{
    (void)state;
    enum { RAYS = 400 };
    random_state r = {71};
    const height_table t = rough_table(&r);
    const FrameData frame = {0};
    int off = 0;
    double worst = 0, slope = 0;
    for (int k = 0; k < RAYS; k++) {
        const double azimuth = random_range(&r, -3.1415, 3.1415), dip = random_range(&r, 0.08, 1.2), height = random_range(&r, 0.5, 3);
        const TileData tile = tile_of(&t, height);
        const struct kernel_context cx = {&frame, &tile, {{&t}}, NULL};
        const vec3 ray = {(float)(cos(azimuth) * cos(dip)), (float)-sin(dip), (float)(sin(azimuth) * cos(dip))};
        const double exact_ray[3] = {(double)ray.x, (double)ray.y, (double)ray.z};
        const SampleHit hit = sample_hit(&cx, ray, (HitEstimate){0, 0, 1, {0, 0}, {0, 0}});
        const double exact = brute_force(&t, height, exact_ray, 0.0004, (height + 0.3) / sin(dip) + 1);
        assert_true(hit.found == 1 && exact < HUGE_VAL);
        const double wrong = fabs((double)hit.along - exact);
        if (wrong > 0.01) { /* a crest that is grazed within the search's tolerance */
            off++;
            continue;
        }
        const table_point p = table_at(&t, exact * exact_ray[0], exact * exact_ray[2]);
        worst = fmax(worst, wrong);
        slope = fmax(slope, hypot((double)hit.slope.x - p.slope[0], (double)hit.slope.y - p.slope[1]));
    }
    printf("first hits: %d of %d elsewhere; the others at most %.2g m off, slopes %.2g\n", off, RAYS, worst, slope);
    assert_true(off <= 1);
    assert_true(worst < 3e-4 && slope < 3e-4);
}

static void keep_hit(const struct kernel_context *cx, float row, HitEstimate hit, bool where)
{
    if (where)
        cx->found[(int)row] = (cx->tile->camera_height - hit.height) / (0.0f - pixel_ray_filtered(cx, 0, row).ray.y);
}

/* How far the table lies over a ray, in metres. */
static double over(const height_table *t, double height, const double ray[3], double along)
{
    return table_at(t, along * ray[0], along * ray[2]).height - (height + along * ray[1]);
}

static double most_over(const height_table *t, double height, const double ray[3], double from, double to)
{
    enum { STEPS = 200 };
    double most = 0;
    for (int i = 0; i <= STEPS && from < to; i++)
        most = fmax(most, over(t, height, ray, from + (to - from) * i / STEPS));
    return most;
}

/* In grazing water a ray begins at the hit of the ray below it: nothing that it would have met before may be lost, but for crests that reach less than
 * a tenth of a row above it, and the hit is as near to the surface. */
static void columns_lose_no_crest(void **state)
{
    (void)state;
    enum { COLUMNS = 24, ROWS = TILE_HEIGHT * HIT_ROWS };
    random_state r = {73};
    const height_table t = rough_table(&r);
    const FrameData frame = {0};
    int off = 0;
    for (int k = 0; k < COLUMNS; k++) {
        const double azimuth = random_range(&r, -3.1415, 3.1415), dip = random_range(&r, 0.03, 0.2), height = random_range(&r, 0.5, 2);
        const float step = 0.003f;
        double found[ROWS];
        TileData tile = tile_of(&t, height);
        tile.grazing = 1;
        tile.refined = k % 2;
        tile.hit_rows = HIT_ROWS;
        tile.ray_x = (float)cos(azimuth);
        tile.ray_y = (float)-dip;
        tile.ray_z = (float)sin(azimuth);
        tile.down_y = 0.0f - step;
        tile.right_x = tile.ray_z * step;
        tile.right_z = 0.0f - tile.ray_x * step;
        tile.horizon_steepness = step;
        tile.horizon_inverse = 1 / step;
        const struct kernel_context cx = {&frame, &tile, {{&t}}, found};
        for (int part = 0; part < walk_parts(&cx); part++)
            walk_column(&cx, 0, part);
        for (int row = 0; row < ROWS; row++) {
            const vec3 seen = pixel_ray_filtered(&cx, 0, (float)row).ray;
            const double ray[3] = {(double)seen.x, (double)seen.y, (double)seen.z};
            const double exact = brute_force(&t, height, ray, 0.002, (height + 0.3) / -ray[1] + 1);
            const double tenth = 0.1 * found[row] * (double)step;
            off += fabs(over(&t, height, ray, found[row])) > tenth || most_over(&t, height, ray, exact, found[row] - 0.01) > tenth;
        }
    }
    printf("columns: %d of %d hits elsewhere\n", off, COLUMNS * ROWS);
    assert_true(off <= COLUMNS * ROWS / 100);
}

static void slopes_are_those_of_differences(void **state)
{
    (void)state;
    random_state r = {72};
    const height_table t = rough_table(&r);
    const FrameData frame = {0};
    const TileData tile = tile_of(&t, 2);
    const struct kernel_context cx = {&frame, &tile, {{&t}}, NULL};
    const Footprint none = {{0, 0}, {0, 0}, {0, 0}};
    double slope = 0, bend = 0, ends = 0;
    for (int k = 0; k < 500; k++) {
        const float x = (float)random_range(&r, -20, 20), z = (float)random_range(&r, -20, 20), h = 1.0f / 64;
        const Surface s = surface_full(&cx, x, z, vec2(0, 0)), east = surface_full(&cx, x + h, z, vec2(0, 0)), west = surface_full(&cx, x - h, z, vec2(0, 0));
        const double twice = 2 * (double)h;
        slope = fmax(slope, fabs((double)(east.height_even - west.height_even) / twice - (double)s.slope_even.x));
        bend = fmax(bend, fabs((double)(east.slope_even.x - west.slope_even.x) / twice - (double)s.bend_xx));
        bend = fmax(bend, fabs((double)(east.slope_even.y - west.slope_even.y) / twice - (double)s.bend_xz));
        const Surface shutter = surface_filtered(&cx, vec3(0, -1, 0), 1, x, z, none, vec2(0, 0));
        const table_point close = table_at(&t, (double)x - t.drift[0], (double)z - t.drift[1]);
        ends = fmax(ends, fabs((double)(shutter.height_even + shutter.height_odd) - close.height));
        ends = fmax(ends, fabs((double)(shutter.slope_even.x - shutter.slope_odd.x) - close.slope[0]));
    }
    printf("slopes %.2g, second derivatives %.2g, shutter's end %.2g\n", slope, bend, ends);
    assert_true(slope < 5e-3 && bend < 0.1 && ends < 1e-6);
}

/* Mean slope and covariance, that of the bend included, are those of random points in the pixel. */
static void filtered_covariance_is_that_of_averages(void **state)
{
    (void)state;
    enum { POINTS = 40000 };
    random_state r = {73};
    height_table t = rough_table(&r);
    t.drift[0] = t.drift[1] = 0; /* the mean slope is that of both ends of the shutter */
    const FrameData frame = {0};
    TileData tile = tile_of(&t, 2);
    tile.resolved_count = 0;
    tile.mixed_count = 1;
    const struct kernel_context cx = {&frame, &tile, {{&t}}, NULL};
    double mean_error = 0, error = 0;
    for (int k = 0; k < 20; k++) {
        const double x = random_range(&r, -10, 10), z = random_range(&r, -10, 10), size = exp(random_range(&r, -3, 0.3));
        const Footprint f = {{(float)size, (float)(0.3 * size)}, {(float)(-0.2 * size), (float)(1.5 * size)}, {0, 0}};
        const double sides[2][2] = {{(double)f.right.x, (double)f.right.y}, {(double)f.down.x, (double)f.down.y}};
        const Surface s = surface_filtered(&cx, vec3(0, -1, 0), 1, (float)x, (float)z, f, vec2(0, 0));
        double mean[2] = {0}, square[3] = {0}, ours[3] = {(double)s.variance_xx, (double)s.variance_xz, (double)s.variance_zz};
        for (int i = 0; i < POINTS; i++) {
            const double u = random_range(&r, -0.5, 0.5), v = random_range(&r, -0.5, 0.5);
            const table_point p = table_at(&t, x + u * sides[0][0] + v * sides[1][0], z + u * sides[0][1] + v * sides[1][1]);
            mean[0] += p.slope[0] / POINTS, mean[1] += p.slope[1] / POINTS;
            for (int c = 0; c < 3; c++)
                square[c] += p.slope[c == 2] * p.slope[c != 0] / POINTS;
        }
        for (int side = 0; side < 2; side++) {
            const double bend[2] = {(double)s.bend_xx * sides[side][0] + (double)s.bend_xz * sides[side][1],
                                    (double)s.bend_xz * sides[side][0] + (double)s.bend_zz * sides[side][1]};
            for (int c = 0; c < 3; c++)
                ours[c] += bend[c == 2] * bend[c != 0] / 12;
        }
        mean_error = fmax(mean_error, hypot((double)s.slope_even.x - mean[0], (double)s.slope_even.y - mean[1]));
        const double whole = square[0] - mean[0] * mean[0] + square[2] - mean[1] * mean[1];
        for (int c = 0; c < 3; c++)
            error = fmax(error, fabs(ours[c] - (square[c] - mean[c == 2] * mean[c != 0])) / whole);
    }
    printf("filtered: mean slope %.2g off, covariance %.2g of its trace\n", mean_error, error);
    assert_true(mean_error < 0.01 && error < 0.03);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_hits_are_those_of_brute_force),
        cmocka_unit_test(columns_lose_no_crest),
        cmocka_unit_test(slopes_are_those_of_differences),
        cmocka_unit_test(filtered_covariance_is_that_of_averages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
