/* SPDX-License-Identifier: MIT
 *
 * Foam: its share of a sea against random places of that sea, its patterns against their own mean, kernels against double precision, what an eye sees of it
 * against integrals, and water that folds.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "mangata/mangata.h"
#include "reference/foam.h"

#include "unit/random_numbers.h"

#include "unit/kernel_lane.h"

enum { WAVES = 48 };

static mgt_scene foam_scene(mgt_wave waves[WAVES], float share, double steepness)
{
    random_state r = {33};
    random_waves(&r, waves, WAVES, 0.5, 60, steepness);
    mgt_scene scene = black_scene(640, 360, waves, WAVES);
    scene.water.choppiness = 0.7f;
    scene.foam = share;
    return scene;
}

/* The scene must outlive the bench. In its tile no wave counts as resolved by every pixel, because the tests choose footprints of any size. */
static kernel_bench *foam_bench(const mgt_scene *scene, bool filter)
{
    kernel_bench *b = kernel_bench_create(scene);
    kernel_bench_tile(b, filter, filter, 320, 180);
    b->tile.data.whole_waves = 0;
    b->cx = context_for(&b->frame.data, &b->tile);
    return b;
}

/* det B of the breaking waves at a place of rest. */
static double area_at(const foam_sea *sea, double x, double z, double time)
{
    double xx = 1, xz = 0, zz = 1;
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_wave *w = &sea->waves[i];
        const double pressed = w->press / (w->x * w->x + w->z * w->z) * sin(w->x * x + w->z * z + w->frequency * time + w->start);
        xx -= pressed * w->x * w->x;
        xz -= pressed * w->x * w->z;
        zz -= pressed * w->z * w->z;
    }
    return xx * zz - xz * xz;
}

/* ---- the sea ---- */

static void foam_covers_the_share_that_is_asked_for(void **state)
{
    (void)state;
    static const float shares[] = {0.004f, 0.02f, 0.1f, 0.25f};
    static foam_sea sea;
    mgt_wave waves[WAVES];
    for (size_t k = 0; k < 4; k++) {
        const mgt_scene scene = foam_scene(waves, shares[k], 0.2);
        assert_true(foam_sea_of(&scene, &sea));
        random_state r = {7};
        double area = 0, fresh = 0, all = 0;
        for (int i = 0; i < 60000; i++) {
            const double x = random_range(&r, 0, 5000), z = random_range(&r, 0, 5000), time = random_range(&r, 0, 500);
            const double weight = area_at(&sea, x, z, time);
            double moments[FOAM_MOMENTS];
            reference_foam_moments(&sea, x, z, time, moments);
            area += weight;
            fresh += weight * moments[0];
            for (int j = 0; j < FOAM_MOMENTS; j++)
                all += weight * sea.weight[j] * moments[j];
        }
        char text[80];
        snprintf(text, sizeof text, "share %.3f, all moments over what was asked for less 1", (double)shares[k]);
        expect_below(text, fabs(all / area / (double)shares[k] - 1), 0.04);
        snprintf(text, sizeof text, "share %.3f, fresh foam over that", (double)shares[k]);
        expect_below(text, fresh / all, 1.6);
        assert_true(fresh / all > 0.6);
    }
}

static void winds_have_the_share_of_monahan(void **state)
{
    (void)state;
    expect_below("10 m/s", fabs(foam_share_of_wind(10) - 0.00987), 1e-4);
    assert_true(foam_share_of_wind(0) == 0);
    assert_true(foam_share_of_wind(75) <= MOST_FOAM);
}

/* ---- patterns ---- */

static void quantiles_are_those_of_the_normal_distribution(void **state)
{
    (void)state;
    double most = 0;
    for (int i = 1; i < 2000; i++)
        most = fmax(most, fabs((double)normal_quantile(NULL, (float)i / 2000) - reference_normal_quantile(i / 2000.0)));
    expect_below("quantile of the normal distribution", most, 3e-4);
}

static void patterns_cover_their_share(void **state)
{
    (void)state;
    static const float shares[] = {0.02f, 0.1f, 0.3f, 0.7f};
    static const double sides[] = {0, 0.2, 1, 30};
    mgt_wave waves[WAVES];
    const mgt_scene scene = foam_scene(waves, 0.05f, 0.2);
    kernel_bench *b = foam_bench(&scene, true);
    random_state r = {5};
    for (int side = 0; side < 4; side++)
        for (int k = 0; k < 4; k++) {
            double patches = 0, lace = 0;
            const int count = 20000;
            const float s = (float)sides[side];
            const Footprint p = {{s, 0}, {0, s}, {0, 0}};
            for (int i = 0; i < count; i++) {
                const float x = (float)random_range(&r, -300, 300), z = (float)random_range(&r, -300, 300);
                patches += (double)foam_patches(&b->cx, foam_field(&b->cx, 0, x, z, p), shares[k]) / count;
                lace += (double)foam_lace(&b->cx, foam_field(&b->cx, FOAM_SINES, x, z, p), shares[k]) / count;
            }
            char text[80];
            snprintf(text, sizeof text, "share %.2f, pixels of %g m: patches, lace", (double)shares[k], sides[side]);
            expect_below(text, fmax(fabs(patches - (double)shares[k]), fabs(lace - (double)shares[k])), 0.012);
        }
    kernel_bench_destroy(b);
}

/* ---- kernels ---- */

static void kernels_agree_with_double_precision(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = foam_scene(waves, 0.1f, 0.2);
    kernel_bench *b = foam_bench(&scene, false);
    const foam_sea *sea = &b->frame.foam.sea;
    const Footprint none = {{0, 0}, {0, 0}, {0, 0}};
    random_state r = {9};
    double worst = 0, mean = 0;
    const int count = 4000;
    for (int i = 0; i < count; i++) {
        const float x = (float)random_range(&r, -100, 100), z = (float)random_range(&r, -100, 100);
        const foam_point want = reference_foam_at(sea, (double)x + scene.camera.position[0], (double)z + scene.camera.position[2], scene.time);
        const FoamShares f = foam_shares(&b->cx, x, z, none, foam_sight_even(&b->cx));
        const Foam foam = foam_patterned(&b->cx, f, x, z, none);
        const double off = fmax(fabs((double)foam.share - want.share), fabs((double)foam.white - want.white));
        worst = fmax(worst, off);
        mean += off / count;
    }
    expect_below("foam at a point, kernel less double: mean", mean, 3e-4);
    expect_below("greatest", worst, 0.003);
    kernel_bench_destroy(b);
}

/* The share over the sea is the same at every footprint. */
static void footprints_keep_the_share(void **state)
{
    (void)state;
    static const double sides[] = {0.1, 1, 4, 16, 1000};
    mgt_wave waves[WAVES];
    const mgt_scene scene = foam_scene(waves, 0.05f, 0.2);
    kernel_bench *b = foam_bench(&scene, true);
    for (int side = 0; side < 5; side++) {
        random_state r = {11};
        double area = 0, covered = 0;
        const float s = (float)sides[side];
        const Footprint p = {{s, 0}, {0, s}, {0, 0}};
        for (int i = 0; i < 30000; i++) {
            const float x = (float)random_range(&r, -2000, 2000), z = (float)random_range(&r, -2000, 2000);
            const FoamShares f = foam_shares(&b->cx, x, z, p, foam_sight_even(&b->cx));
            const double weight = 1 / (double)(f.inverse.xx * f.inverse.zz - f.inverse.xz * f.inverse.xz);
            area += weight;
            covered += weight * (double)(f.fresh + f.old);
        }
        char text[80];
        snprintf(text, sizeof text, "pixels of %g m: share over what was asked for less 1", sides[side]);
        expect_below(text, fabs(covered / area / 0.05 - 1), 0.02);
    }
    kernel_bench_destroy(b);
}

static void folds_give_numbers(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    mgt_scene scene = foam_scene(waves, 0.3f, 1.5);
    scene.water.choppiness = 1;
    kernel_bench *b = foam_bench(&scene, true);
    random_state r = {13};
    for (int i = 0; i < 20000; i++) {
        const float s = (float)exp(random_range(&r, -6, 6)), x = (float)random_range(&r, -500, 500), z = (float)random_range(&r, -500, 500);
        const Footprint p = {{s, 0}, {0, 2 * s}, {0, 0}};
        const vec3 view = {0.6f, (float)random_range(&r, 0.001, 0.8), 0.2f};
        const FoamSight sight = foam_sight(&b->cx, view, (vec2){0.3f, -0.2f}, (Symmetric){0.2f, 0.01f, 0.3f});
        const Foam foam = foam_patterned(&b->cx, foam_shares(&b->cx, x, z, p, sight), x, z, p);
        assert_true(foam.share >= 0 && foam.share <= 1);
        assert_true(foam.white >= 0 && foam.white <= 1);
        const float slopes[] = {1e30f, -1e30f, INFINITY, NAN}; /* at the horizon, where places are beyond numbers */
        const vec3 light = foam_light(&b->cx, foam, (vec2){slopes[i % 4], 0.1f});
        assert_true(isfinite(light.x) && isfinite(light.y) && isfinite(light.z));
    }
    kernel_bench_destroy(b);
}

/* Waves that all pixels of a tile resolve are not split: what that changes. */
static void whole_waves_need_no_split(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = foam_scene(waves, 0.05f, 0.2);
    kernel_bench *b = foam_bench(&scene, true);
    static const double sides[] = {0.1, 0.5, 2};
    for (int side = 0; side < 3; side++) {
        random_state r = {21};
        const float s = (float)sides[side];
        const Footprint p = {{s, 0}, {0, s}, {0, 0}};
        double squared = 0, all = 0, difference = 0;
        for (int i = 0; i < 4000; i++) {
            const float x = (float)random_range(&r, -500, 500), z = (float)random_range(&r, -500, 500);
            const vec3 view = {0.5f, 0.3f, 0.2f};
            const FoamSight sight = foam_sight(&b->cx, view, (vec2){0, 0}, (Symmetric){0.01f, 0, 0.01f});
            b->tile.data.whole_waves = 0;
            const FoamShares split = foam_shares(&b->cx, x, z, p, sight);
            b->tile.data.whole_waves = 0.03f / (2 * s * s);
            const FoamShares whole = foam_shares(&b->cx, x, z, p, sight);
            const double off = (double)(whole.fresh + whole.old - split.fresh - split.old);
            squared += off * off;
            difference += off;
            all += (double)(split.fresh + split.old);
        }
        char text[80];
        snprintf(text, sizeof text, "pixels of %g m: whole waves less split ones, rms over the mean", sides[side]);
        expect_below(text, sqrt(squared * 4000) / all, 0.03);
        snprintf(text, sizeof text, "pixels of %g m: the mean, less 1", sides[side]);
        expect_below(text, fabs(difference / all), 0.005);
    }
    kernel_bench_destroy(b);
}

/* No pixel of a tile sees more of its whole waves than .173 cycles on the mean surface. */
static void whole_waves_are_long_on_the_screen(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = foam_scene(waves, 0.05f, 0.2);
    kernel_bench *b = kernel_bench_create(&scene);
    double most = 0;
    int tiles = 0;
    for (uint32_t y = 0; y < 360; y += TILE_HEIGHT)
        for (uint32_t x = 0; x < 640; x += TILE_WIDTH) {
            kernel_bench_tile(b, true, true, x, y);
            const struct kernel_context cx = context_for(&b->frame.data, &b->tile);
            if (b->tile.data.whole_waves == 0)
                continue;
            tiles++;
            for (int i = 0; i < 64; i++) {
                const PixelRay pixel =
                    pixel_ray_filtered(&cx, (float)(i % 8 * (TILE_WIDTH - 1)) / 7, (float)(i / 8 * ((int)b->tile.data.hit_rows * TILE_HEIGHT - 1)) / 7);
                const Footprint p = footprint_at(&cx, pixel.ray, -b->tile.data.camera_height / pixel.ray.y);
                for (double angle = 0; angle < M_PI; angle += 0.1) {
                    const double turns = sqrt((double)b->tile.data.whole_waves), along_x = turns * cos(angle), along_z = turns * sin(angle);
                    most =
                        fmax(most, hypot((double)p.right.x * along_x + (double)p.right.y * along_z, (double)p.down.x * along_x + (double)p.down.y * along_z));
                }
            }
        }
    assert_true(tiles > 20);
    expect_below("cycles a pixel of waves that count as resolved", most, 0.1735);
    kernel_bench_destroy(b);
}

/* Old foam of moment 1 alone at a place, for a pixel of this side. */
static double old_foam(const kernel_bench *b, const FoamData *data, double x, double z, float side, FoamSight sight)
{
    struct kernel_context cx = b->cx;
    cx.foam = data;
    const Footprint p = {{side, 0}, {0, side}, {0, 0}};
    return (double)foam_shares(&cx, (float)x, (float)z, p, sight).old;
}

/* The covariance of J at moment 1 and the slope now that a pixel of this side leaves to the sight, along x and z, by every wave's 1 − √c. */
static void lean_left(const foam_sea *sea, double side, double lean[2])
{
    lean[0] = lean[1] = 0;
    for (int i = 0; i < sea->wave_count; i++) {
        const foam_wave *w = &sea->waves[i];
        const double f = side * hypot(w->x, w->z) / (2 * M_PI), root = fmax(1 - f * f / 1.44, 0);
        const double all = w->height * w->press * w->held[1] / 2 * sin(w->frequency * sea->age[1]);
        lean[0] += (1 - root) * all * w->x;
        lean[1] += (1 - root) * all * w->z;
    }
}

/* A sight along x and one along z change foam as what is left of the covariances along these axes; where every wave is resolved, by nothing. */
static void resolved_waves_are_seen_once(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = foam_scene(waves, 0.1f, 0.2);
    kernel_bench *b = foam_bench(&scene, true);
    FoamData data = *b->cx.foam;
    data.weight_2 = data.weight_3 = 0;
    const FoamSight along_x = {.facing = {0.03f, 0}, .above = 0, .kept = 1}, along_z = {.facing = {0, 0.03f}, .above = 0, .kept = 1};
    const FoamSight even = foam_sight_even(&b->cx);
    for (double side = 0; side <= 8; side += 2) {
        random_state r = {15};
        double x_changes = 0, z_changes = 0, lean[2];
        for (int i = 0; i < 500; i++) {
            const double x = random_range(&r, -500, 500), z = random_range(&r, -500, 500), none = old_foam(b, &data, x, z, (float)side, even);
            x_changes += old_foam(b, &data, x, z, (float)side, along_x) - none;
            z_changes += old_foam(b, &data, x, z, (float)side, along_z) - none;
        }
        if (side == 0) {
            expect_below("foam of resolved waves: change by the sight", hypot(x_changes, z_changes) / 500, 1e-6);
            continue;
        }
        lean_left(&b->frame.foam.sea, side, lean);
        char text[80];
        snprintf(text, sizeof text, "pixels of %g m: angle of the change from that of 1 - sqrt c", side);
        expect_below(text, fabs(remainder(atan2(z_changes, x_changes) - atan2(lean[1], lean[0]), M_PI)), 1e-3);
    }
    kernel_bench_destroy(b);
}

/* The mean over hits of waves that a footprint on the hit's own face resolves in part, with 1 − √c of the covariance left for the sight, against what is seen
 * of whole waves. `slope`: standard deviations of the slope to the eye; `fall`: the ray's in these units. The face's fraction is c = (1 − length²/fall²)². */
static void half_resolved_waves_are_seen_once(void **state)
{
    (void)state;
    const double deviation = 0.2, threshold = -1.3;
    FoamData data = {.least = (float)(1 + threshold * deviation)};
    const struct kernel_context cx = {.foam = &data};
    const FoamMean now = {.mean = 1, .squared = 1, .skewness = 0};
    double worst = 0;
    for (int falls = 0; falls < 2; falls++)
        for (double correlation = -0.3; correlation < 0.35; correlation += 0.15) {
            const double fall = falls ? 1 : 0.1;
            FoamSight sight = foam_sight(&cx, (vec3){1, (float)fall, 0}, (vec2){0, 0}, (Symmetric){(float)(1 / (FOAM_LONGER * FOAM_LONGER)), 0, 0});
            sight.above = 0;
            sight.kept = 1;
            for (double length = 0.2; length < 2.5; length *= 1.6) {
                double foam = 0, exact = 0;
                for (double slope = -fall; slope < 6; slope += 0.05)
                    for (double x = -6; x < 6; x += 0.05) { /* of J beside what goes with the slope */
                        const double j = correlation * slope + sqrt(1 - correlation * correlation) * x,
                                     weight = (fall + slope) * exp(-(slope * slope + x * x) / 2);
                        const double root = fmax(1 - length * length / fmax((fall + slope) * (fall + slope), 1e-9), 0), c = root * root;
                        const FoamMean then = {.mean = (float)(1 + deviation * c * j), .squared = 1, .skewness = 0};
                        const FoamView view = foam_view(&cx, sight, (float)((root - 1) * correlation * deviation) * sight.facing.x, 0, 0);
                        foam += weight * (double)foam_share_at(&cx, now, then, (float)(deviation * deviation * (1 - c * c)), 0, view);
                        exact += j < threshold ? weight : 0;
                    }
                worst = fmax(worst, fabs(foam / exact - 1));
            }
        }
    expect_below("foam seen of waves resolved in part, over all waves' less 1", worst, 0.08);
}

/* Where the highest of several points is seen: the share of it that is foam, weighted by its area, against the integral over height and J. */
static void crests_are_seen_first(void **state)
{
    (void)state;
    FoamData data = {0};
    const struct kernel_context cx = {.foam = &data};
    double worst = 0;
    for (int points = 2; points <= 8; points *= 2)
        for (double correlation = -0.6; correlation < -0.1; correlation += 0.2) {
            const double deviation = 0.2, least = 1 - 1.8 * deviation;
            data.least = (float)least;
            double foam = 0, all = 0;
            for (double h = -6; h < 6; h += 0.02)
                for (double x = -6; x < 6; x += 0.02) { /* of J beside what goes with the height */
                    const double area = 1 + deviation * (correlation * h + sqrt(1 - correlation * correlation) * x);
                    const double seen = points * pow(0.5 * erfc(-h * M_SQRT1_2), points - 1) * exp(-(h * h + x * x) / 2) * area;
                    all += seen;
                    foam += area < least ? seen : 0;
                }
            const real others = log((double)points);
            const FoamSight sight = {.above = 0.86f * others / (1 + 0.1f * others), .kept = 1 / (1 + others * (0.63f + 0.075f * others))};
            const float high = (float)(deviation * correlation), variance = (float)(deviation * deviation);
            const FoamMean level = {.mean = 1, .squared = 1, .skewness = 0};
            const double got = (double)foam_share_at(&cx, level, level, variance, variance, foam_view(&cx, sight, 0, high, high));
            worst = fmax(worst, fabs(got / (foam / all) - 1));
        }
    expect_below("foam on the highest of 2, 4, 8 points, over the integral less 1", worst, 0.08);
}

/* Faces that are turned to the eye are seen first: the share of them that is foam, weighted by its area, against the integral over J and the slope. The
 * covariance of J with that slope is positive where foam is turned away. */
static void faces_are_seen_first(void **state)
{
    (void)state;
    FoamData data = {0};
    const struct kernel_context cx = {.foam = &data};
    const double deviation = 0.2, slope = 0.1, least = 1 - 1.8 * deviation;
    data.least = (float)least;
    double worst = 0;
    for (int falls = 0; falls < 3; falls++)
        for (double correlation = -0.3; correlation < 0.35; correlation += 0.1) {
            const double fall = slope * (const double[]){0.1, 1, 3}[falls];
            double foam = 0, all = 0;
            for (double s = -6; s < 6; s += 0.02)
                for (double x = -6; x < 6; x += 0.02) { /* of J beside what goes with the slope */
                    const double area = 1 + deviation * (correlation * s + sqrt(1 - correlation * correlation) * x);
                    const double seen = fmax(fall - slope * s, 0) * exp(-(s * s + x * x) / 2) * area;
                    all += seen;
                    foam += area < least ? seen : 0;
                }
            const float wider = (float)(slope * slope / (FOAM_LONGER * FOAM_LONGER)), variance = (float)(deviation * deviation);
            FoamSight sight = foam_sight(&cx, (vec3){1, (float)fall, 0}, (vec2){0, 0}, (Symmetric){wider, 0, 0});
            sight.above = 0;
            sight.kept = 1;
            const FoamMean level = {.mean = 1, .squared = 1, .skewness = 0};
            const FoamView view = foam_view(&cx, sight, sight.facing.x * (float)(correlation * deviation * slope), 0, 0);
            worst = fmax(worst, fabs((double)foam_share_at(&cx, level, level, variance, variance, view) / (foam / all) - 1));
        }
    expect_below("foam on faces by their visible area, over the integral less 1", worst, 0.08);
}

/* ---- scenes ---- */

static void water_without_foam_has_none(void **state)
{
    (void)state;
    static foam_sea sea;
    mgt_wave waves[WAVES];
    mgt_scene scene = foam_scene(waves, 0, 0.2);
    assert_false(foam_sea_of(&scene, &sea));
    scene.foam = 0.1f;
    scene.water.choppiness = 0;
    assert_false(foam_sea_of(&scene, &sea));
    scene.water.choppiness = 0.7f;
    scene.water.wave_count = 0;
    assert_false(foam_sea_of(&scene, &sea));
    scene.water.wave_count = WAVES;
    scene.camera.position[1] = -1;
    assert_false(foam_sea_of(&scene, &sea));
    scene.camera.position[1] = 1;
    scene.foam_persistence = 0;
    assert_true(foam_sea_of(&scene, &sea));
    assert_int_equal(sea.moments, 1);
    assert_true(fabs(foam_sea_share(&sea, sea.least) - 0.1) < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(foam_covers_the_share_that_is_asked_for),
        cmocka_unit_test(winds_have_the_share_of_monahan),
        cmocka_unit_test(quantiles_are_those_of_the_normal_distribution),
        cmocka_unit_test(patterns_cover_their_share),
        cmocka_unit_test(kernels_agree_with_double_precision),
        cmocka_unit_test(footprints_keep_the_share),
        cmocka_unit_test(whole_waves_need_no_split),
        cmocka_unit_test(whole_waves_are_long_on_the_screen),
        cmocka_unit_test(resolved_waves_are_seen_once),
        cmocka_unit_test(half_resolved_waves_are_seen_once),
        cmocka_unit_test(crests_are_seen_first),
        cmocka_unit_test(faces_are_seen_first),
        cmocka_unit_test(folds_give_numbers),
        cmocka_unit_test(water_without_foam_has_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
