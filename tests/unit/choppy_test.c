/* SPDX-License-Identifier: MIT
 *
 * Choppy water: the surface in double against derivatives by differences, kernels, renders, questions and rays against that surface, and what folds.
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

#include "cpu/query_lanes.h"
#include "frame/frame_waves.h"
#include "mangata/mangata.h"
#include "params/methods.h"
#include "reference/equations.h"
#include "reference/reference_frame.h"

#include "unit/depth_picture.h"
#include "unit/random_numbers.h"

#include "unit/kernel_lane.h"

#include "kernels/glitter/sample.k"

#include "unit/kernel_words_off.h"

enum { WAVES = 40 };

static const double pi = 3.14159265358979323846;

/* A sea of all directions that does not fold: where it is pressed most a quarter of its area is left. */
static mgt_scene choppy_scene(mgt_wave waves[WAVES], float choppiness)
{
    random_state r = {21};
    random_waves(&r, waves, WAVES, 0.4, 30, 0.16);
    mgt_scene scene = black_scene(640, 360, waves, WAVES);
    scene.water.choppiness = choppiness;
    return scene;
}

/* Where the water of a place of rest is, and what it is like, by the definition alone. */
static void shifted(const mgt_water *water, const double rest[2], double time, double point[3])
{
    point[0] = rest[0], point[1] = 0, point[2] = rest[1];
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double phase = w->kx * rest[0] + w->kz * rest[1] + w->omega * time + w->phase, k = hypot(w->kx, w->kz);
        point[1] += w->amplitude * sin(phase);
        point[0] += (double)water->choppiness * w->kx / k * w->amplitude * cos(phase);
        point[2] += (double)water->choppiness * w->kz / k * w->amplitude * cos(phase);
    }
}

/* ---- the oracle ---- */

static void the_surface_is_that_of_shifted_water(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    random_state r = {5};
    double height = 0, slope = 0, bend = 0;
    const mgt_scene scene = choppy_scene(waves, 1);
    for (int i = 0; i < 300; i++) {
        const double rest[2] = {random_range(&r, -40, 40), random_range(&r, -40, 40)}, h = 1e-4;
        double p[3];
        shifted(&scene.water, rest, 3, p);
        const water_point s = water_surface(&scene.water, p[0], p[2], 3);
        height = fmax(height, fabs(s.height - p[1]));
        const water_point east = water_surface(&scene.water, p[0] + h, p[2], 3), west = water_surface(&scene.water, p[0] - h, p[2], 3);
        const water_point south = water_surface(&scene.water, p[0], p[2] + h, 3), north = water_surface(&scene.water, p[0], p[2] - h, 3);
        slope = fmax(slope, fabs((east.height - west.height) / (2 * h) - s.slope[0]));
        slope = fmax(slope, fabs((south.height - north.height) / (2 * h) - s.slope[1]));
        bend = fmax(bend, fabs((east.slope[0] - west.slope[0]) / (2 * h) - s.hessian[0]));
        bend = fmax(bend, fabs((south.slope[0] - north.slope[0]) / (2 * h) - s.hessian[1]));
        bend = fmax(bend, fabs((south.slope[1] - north.slope[1]) / (2 * h) - s.hessian[2]));
    }
    expect_below("height off, metres", height, 1e-11);
    expect_below("slope off differences of heights", slope, 1e-4);
    expect_below("second derivatives off differences of slopes", bend, 1e-2);
}

/* Crests are sharper than troughs, and the more so the choppier the water is. */
static void crests_are_sharp(void **state)
{
    (void)state;
    mgt_wave wave = {.amplitude = 0.4, .kx = 1, .omega = 0};
    double before = 0;
    for (int i = 0; i <= 4; i++) {
        const mgt_water water = {.waves = &wave, .wave_count = 1, .choppiness = 0.25f * (float)i};
        const water_point crest = water_surface(&water, pi / 2, 0, 0), trough = water_surface(&water, -pi / 2, 0, 0);
        assert_float_equal(crest.height, 0.4, 1e-12);
        assert_float_equal(trough.height, -0.4, 1e-12);
        const double ratio = crest.hessian[0] / -trough.hessian[0]; /* (1 + λAk)² / (1 − λAk)² */
        const double expected = pow((1 + 0.1 * i) / (1 - 0.1 * i), 1) * pow((1 + 0.1 * i) / (1 - 0.1 * i), 1);
        print_message("  choppiness %.2f: a crest is %.3f times as sharp as a trough\n", 0.25 * i, ratio);
        assert_float_equal(ratio, expected, 1e-4 * expected);
        assert_true(i == 0 || ratio > before);
        before = ratio;
    }
}

/* ---- kernels ---- */

static void kernels_see_the_surface(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    random_state r = {6};
    const mgt_scene scene = choppy_scene(waves, 1);
    kernel_bench *b = kernel_bench_create(&scene);
    kernel_bench_tile(b, false, false, 320, 300);
    double height = 0, slope = 0, bend = 0;
    for (int i = 0; i < 500; i++) {
        const float x = (float)random_range(&r, -5, 5), z = (float)random_range(&r, -5, 5);
        const double at[2] = {scene.camera.position[0] + (double)b->tile.data.origin_x + (double)x,
                              scene.camera.position[2] + (double)b->tile.data.origin_z + (double)z};
        const water_point exact = water_surface(&scene.water, at[0], at[1], scene.time);
        const Surface s = surface_full(&b->cx, x, z, vec2(0, 0));
        height = fmax(height, fabs((double)s.height_even - exact.height));
        slope = fmax(slope, fmax(fabs((double)s.slope_even.x - exact.slope[0]), fabs((double)s.slope_even.y - exact.slope[1])));
        const double sharp = fabs(exact.hessian[0]) + fabs(exact.hessian[2]);
        bend = fmax(bend, fabs((double)s.bend_xx - exact.hessian[0]) / (1 + sharp));
        bend = fmax(bend, fabs((double)s.bend_xz - exact.hessian[1]) / (1 + sharp));
        bend = fmax(bend, fabs((double)s.bend_zz - exact.hessian[2]) / (1 + sharp));
    }
    kernel_bench_destroy(b);
    expect_below("height off, metres", height, 1e-4);
    expect_below("slope off", slope, 2e-3);
    /* The place of rest is off by a fiftieth of the shortest wave at most; heights and slopes are moved from there along their derivatives, these are not:
     * they turn by 2π/50. */
    expect_below("second derivatives off, over 1 + their sum", bend, 2 * pi / 50);
}

/* Both ends of a short shutter, at a fixed point of the world: water moves sideways below it. */
static void the_shutters_ends_are_the_surface_then(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    random_state r = {7};
    mgt_scene scene = choppy_scene(waves, 1);
    scene.shutter = 1.0 / 240;
    kernel_bench *b = kernel_bench_create(&scene);
    kernel_bench_tile(b, true, false, 320, 300);
    const Footprint p = {{1e-4f, 0}, {0, 1e-4f}, {0, 0}};
    double slope = 0, moved = 0, height = 0, rose = 0;
    for (int i = 0; i < 300; i++) {
        const float x = (float)random_range(&r, -5, 5), z = (float)random_range(&r, -5, 5);
        const double at[2] = {scene.camera.position[0] + (double)b->tile.data.origin_x + (double)x,
                              scene.camera.position[2] + (double)b->tile.data.origin_z + (double)z};
        const Surface s = surface_filtered(&b->cx, vec3(0, -1, 0), 1, x, z, p, vec2(0, 0));
        const water_point close = water_surface(&scene.water, at[0], at[1], scene.time),
                          open = water_surface(&scene.water, at[0], at[1], scene.time - scene.shutter);
        slope += pow(2 * (double)s.slope_odd.x - (open.slope[0] - close.slope[0]), 2) + pow(2 * (double)s.slope_odd.y - (open.slope[1] - close.slope[1]), 2);
        moved += pow(open.slope[0] - close.slope[0], 2) + pow(open.slope[1] - close.slope[1], 2);
        height += pow(2 * (double)s.height_odd - (close.height - open.height), 2);
        rose += pow(close.height - open.height, 2);
    }
    kernel_bench_destroy(b);
    expect_below("the slope's change over its own RMS, off by", sqrt(slope / moved), 0.02);
    expect_below("the height's change over its own RMS, off by", sqrt(height / rose), 0.02);
}

/* Short waves on a long one: the variance of their slopes at points of the world, over that at rest, on the crest and in the trough. */
static void ripples_lean_more_on_crests(void **state)
{
    (void)state;
    enum { RIPPLES = 24, SEAS = 3000 };
    mgt_wave waves[1 + RIPPLES];
    waves[0] = (mgt_wave){.amplitude = 0.35, .kx = 1};
    random_state r = {31};
    for (int i = 1; i <= RIPPLES; i++)
        waves[i] = (mgt_wave){.amplitude = 0.02 / 60 / sqrt(RIPPLES), .kx = 60 * cos(i * 0.26), .kz = 60 * sin(i * 0.26)};
    const mgt_water water = {.waves = waves, .wave_count = 1 + RIPPLES, .choppiness = 1}, flat = {.waves = waves, .wave_count = 1, .choppiness = 1};
    for (int side = 0; side < 2; side++) {
        const double x = side == 0 ? pi / 2 : -pi / 2, mean = water_surface(&flat, x, 0, 0).slope[0], stretch = side == 0 ? 1 - 0.35 : 1 + 0.35;
        double along = 0, across = 0;
        for (int sea = 0; sea < SEAS; sea++) {
            for (int i = 1; i <= RIPPLES; i++)
                waves[i].phase = random_range(&r, 0, 2 * pi);
            const water_point s = water_surface(&water, x, 0, 0);
            along += pow(s.slope[0] - mean, 2) / SEAS;
            across += pow(s.slope[1], 2) / SEAS;
        }
        const double rest = 0.02 * 0.02 / 4;
        print_message("  %s: × %.3f along, %.3f across; B⁻¹ says %.3f, 1\n", side == 0 ? "crest" : "trough", along / rest, across / rest,
                      1 / (stretch * stretch));
        assert_float_equal(along / rest * stretch * stretch, 1, 0.08);
        assert_float_equal(across / rest, 1, 0.08);
    }
}

/* The covariance of slopes that a pixel holds of which it resolves nothing, against the means at points of the world over many seas of other phases. */
static void slopes_of_a_whole_sea(void **state)
{
    (void)state;
    enum { SEAS = 40000 };
    mgt_wave waves[WAVES];
    mgt_scene scene = black_scene(640, 360, waves, WAVES);
    random_state r = {41};
    for (int i = 0; i < WAVES; i++) { /* along x twice as steep as across */
        const double length = exp(random_range(&r, log(0.4), log(30))), k = 2 * pi / length, angle = random_range(&r, -0.9, 0.9);
        waves[i] = (mgt_wave){.amplitude = 0.06 / k, .kx = k * cos(angle), .kz = k * sin(angle)};
    }
    scene.water.choppiness = 1;
    kernel_bench *b = kernel_bench_create(&scene);
    kernel_bench_tile(b, false, false, 320, 300);
    double rest[2] = {0, 0}, said[2] = {0, 0}, found[2] = {0, 0};
    for (int i = 0; i < WAVES; i++) {
        rest[0] += pow(waves[i].amplitude * waves[i].kx, 2) / 2, rest[1] += pow(waves[i].amplitude * waves[i].kz, 2) / 2;
        said[0] += (double)b->set.data[i].variance_xx, said[1] += (double)b->set.data[i].variance_zz;
    }
    kernel_bench_destroy(b);
    for (int sea = 0; sea < SEAS; sea++) {
        for (int i = 0; i < WAVES; i++)
            waves[i].phase = random_range(&r, 0, 2 * pi);
        const water_point s = water_surface(&scene.water, 0, 0, 0);
        for (int axis = 0; axis < 2; axis++)
            found[axis] += pow(s.slope[axis], 2) / SEAS;
    }
    for (int axis = 0; axis < 2; axis++) {
        print_message("  variance %s at rest %.4f: × %.3f in the world, the library says %.3f\n", axis ? "across" : "along", rest[axis],
                      found[axis] / rest[axis], said[axis] / rest[axis]);
        assert_float_equal(said[axis] / rest[axis], found[axis] / rest[axis], 0.02);
    }
    assert_true(found[0] / rest[0] > 1.04);
}

/* ---- renders ---- */

enum { WIDTH = 96, HEIGHT = 54 };

static void depth_of(mgt_scene scene, mgt_method method, float depth[WIDTH * HEIGHT])
{
    scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    scene.quality.method = method;
    render_depth(&scene, depth);
}

static void rays_meet_choppy_water_first(void **state)
{
    (void)state;
    static float found[2][WIDTH * HEIGHT];
    mgt_wave waves[WAVES];
    mgt_scene scene = choppy_scene(waves, 1);
    scene.camera.position[1] = 2.5;
    scene.camera.target[1] = 2.2;
    scene.camera_open = scene.camera;
    depth_of(scene, MGT_METHOD_NONE, found[0]);
    depth_of(scene, MGT_METHOD_REFERENCE, found[1]);
    scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    int off[2] = {0}, looked = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i += 17) {
        const water_hit exact = first_hit_brute_force(&scene, i % WIDTH + 0.5, i / WIDTH + 0.5, scene.time);
        looked++;
        for (int k = 0; k < 2; k++) {
            const double distance = (double)found[k][i];
            off[k] += exact.hit ? !(fabs(distance - exact.distance) <= fmax(0.01 * exact.distance, 0.005)) : !isinf(distance);
        }
    }
    print_message("  of %d rays none is off on %d, reference on %d\n", looked, off[0], off[1]);
    assert_true(off[0] <= 1);
    assert_int_equal(off[1], 0);
}

/* Water that folds everywhere is drawn without holes or NaN, by every method. */
static void folds_are_drawn(void **state)
{
    (void)state;
    static float color[3 * WIDTH * HEIGHT];
    mgt_wave waves[WAVES];
    mgt_scene scene = choppy_scene(waves, 1);
    for (int i = 0; i < WAVES; i++)
        waves[i].amplitude *= 4;
    scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    scene.camera.position[1] = scene.camera_open.position[1] = 9;
    scene.camera.target[1] = scene.camera_open.target[1] = 8;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, NULL), MGT_OK);
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.format = MGT_FORMAT_RGB32F;
    target.pixels = color;
    for (size_t i = 0; i < method_count; i++) {
        const mgt_method method = (mgt_method)i;
        if (method == MGT_METHOD_REFERENCE || method == MGT_METHOD_SSAA)
            continue;
        scene.quality.method = method;
        if (mgt_render(context, &scene, &target, 1) != MGT_OK)
            fail_msg("%s: %s", mgt_method_name(method), mgt_last_error(context));
        for (int c = 0; c < 3 * WIDTH * HEIGHT; c++)
            if (!(color[c] >= 0 && color[c] < 1e9f))
                fail_msg("%s: %g at %d", mgt_method_name(method), (double)color[c], c);
    }
    mgt_context_destroy(context);
}

/* ---- questions ---- */

enum { POINTS = 2001 };

static void questions_find_the_place_of_rest(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = choppy_scene(waves, 1);
    static double points[2 * POINTS], height[POINTS], exact_height[POINTS];
    static float normal[3 * POINTS], velocity[3 * POINTS], jacobian[POINTS];
    random_state r = {8};
    for (int i = 0; i < 2 * POINTS; i++)
        points[i] = random_range(&r, -1e4, 1e4);
    mgt_water_answers answers;
    for (uint32_t exact = 0; exact < 2; exact++) {
        mgt_water_answers_init(&answers, sizeof answers);
        answers.exact = exact;
        answers.height = exact ? exact_height : height;
        answers.normal = normal;
        answers.velocity = velocity;
        answers.jacobian = jacobian;
        assert_int_equal(mgt_water_query(&scene.water, 3, points, POINTS, &answers), MGT_OK);
        assert_int_equal(answers.unsettled, 0);
        double off = 0, leans = 0;
        for (int i = 0; i < POINTS; i += 5) {
            const water_point s = water_surface(&scene.water, points[2 * i], points[2 * i + 1], 3);
            const double inverse = 1 / sqrt(1 + s.slope[0] * s.slope[0] + s.slope[1] * s.slope[1]);
            off = fmax(off, fabs(answers.height[i] - s.height));
            leans = fmax(leans, fabs((double)normal[3 * i] + s.slope[0] * inverse));
        }
        double sum = 0;
        for (int i = 0; i < WAVES; i++)
            sum += waves[i].amplitude;
        expect_below(exact ? "exact: height off, metres" : "height off, over the sum of amplitudes", exact ? off : off / sum, exact ? 1e-9 : 1e-6);
        expect_below("normal off", leans, exact ? 1e-6 : 1e-5);
    }
    /* A particle's way over a hundredth of a second, and the area of a small patch. */
    double speed = 0, area = 0;
    for (int i = 0; i < 200; i++) {
        const double rest[2] = {random_range(&r, -50, 50), random_range(&r, -50, 50)}, h = 1e-3;
        double now[3], before[3], after[3], east[3], south[3], west[3], north[3];
        shifted(&scene.water, rest, 3, now);
        shifted(&scene.water, rest, 3 - h, before);
        shifted(&scene.water, rest, 3 + h, after);
        shifted(&scene.water, (const double[]){rest[0] + h, rest[1]}, 3, east);
        shifted(&scene.water, (const double[]){rest[0] - h, rest[1]}, 3, west);
        shifted(&scene.water, (const double[]){rest[0], rest[1] + h}, 3, south);
        shifted(&scene.water, (const double[]){rest[0], rest[1] - h}, 3, north);
        float v[3], j;
        const double at[2] = {now[0], now[2]};
        mgt_water_answers_init(&answers, sizeof answers);
        answers.velocity = v;
        answers.jacobian = &j;
        assert_int_equal(mgt_water_query(&scene.water, 3, at, 1, &answers), MGT_OK);
        for (int c = 0; c < 3; c++)
            speed = fmax(speed, fabs((double)v[c] - (after[c] - before[c]) / (2 * h)));
        const double patch = ((east[0] - west[0]) * (south[2] - north[2]) - (east[2] - west[2]) * (south[0] - north[0])) / (4 * h * h);
        area = fmax(area, fabs((double)j - patch));
    }
    expect_below("velocity off, m/s", speed, 1e-4);
    expect_below("Jacobian off", area, 1e-4);
}

/* Where one wave folds, three places of rest are shifted to one point: the answer is the highest. */
static void a_fold_answers_with_its_highest_water(void **state)
{
    (void)state;
    mgt_wave wave = {.amplitude = 1.5, .kx = 1};
    const mgt_water water = {.waves = &wave, .wave_count = 1, .choppiness = 1};
    double worst = 0;
    for (int i = -50; i <= 50; i++) {
        const double x = pi / 2 + 0.008 * i, at[2] = {x, 0};
        double highest = -9, before = 0, answer;
        for (int k = 0; k <= 20000; k++) { /* all crossings along the wave */
            const double u = x - 2 + 4.0 * k / 20000, off = u + 1.5 * cos(u) - x;
            if (k > 0 && (off > 0) != (before > 0))
                highest = fmax(highest, 1.5 * sin(u));
            before = off;
        }
        mgt_water_answers answers;
        mgt_water_answers_init(&answers, sizeof answers);
        answers.height = &answer;
        assert_int_equal(mgt_water_query(&water, 0, at, 1, &answers), MGT_OK);
        assert_int_equal(answers.unsettled, 0);
        worst = fmax(worst, fabs(answer - highest));
    }
    expect_below("height off the highest of the fold, metres", worst, 1e-3);
}

static double water_at(const mgt_water *water, double x, double z)
{
    const double at[2] = {x, z};
    double height;
    mgt_water_answers answers;
    mgt_water_answers_init(&answers, sizeof answers);
    answers.height = &height;
    answers.exact = 1;
    assert_int_equal(mgt_water_query(water, 0, at, 1, &answers), MGT_OK);
    return height;
}

/* Where water folds, rays meet the highest of it, that of queries; flat ones seldom later than where they get below it. */
static void rays_meet_the_highest_water_of_a_fold(void **state)
{
    (void)state;
    enum { RAYS = 100 };
    const mgt_wave wave = {.amplitude = 1.2 / 0.7, .kx = 0.7};
    const mgt_water water = {.waves = &wave, .wave_count = 1, .choppiness = 1};
    double rays[6 * RAYS], distance[RAYS], worst = 0;
    int inside = 0;
    for (int i = 0; i < RAYS; i++)
        memcpy(rays + 6 * i, (const double[6]){i ? 0.31 * i : 2.315903, 20, 0.1 * i, 0, -1, 0}, 6 * sizeof *rays);
    assert_int_equal(mgt_water_trace(&water, 0, rays, RAYS, 100, distance), MGT_OK);
    expect_below("the highest water that a ray straight down meets, off by metres", fabs(20 - distance[0] - 1.6514), 1e-4);
    for (int i = 0; i < RAYS; i++)
        worst = fmax(worst, fabs(20 - distance[i] - water_at(&water, rays[6 * i], rays[6 * i + 2])));
    expect_below("rays straight down off the answers of queries, metres", worst, 1e-8);
    for (int i = 0; i < RAYS; i++) {
        rays[6 * i + 3] = i % 2 ? 1 : -1;
        rays[6 * i + 4] = -0.2 - 0.01 * i;
    }
    assert_int_equal(mgt_water_trace(&water, 0, rays, RAYS, 1000, distance), MGT_OK);
    for (int i = 0; i < RAYS; i++) {
        const double *r = rays + 6 * i, before = distance[i] - 1e-2;
        assert_true(isfinite(distance[i]));
        inside += water_at(&water, r[0] + before * r[3], r[2]) > r[1] + before * r[4] + 1e-6;
    }
    expect_below("rays, of 100, more than a centimetre behind the end of a crest that hangs over", inside, 1);
}

static void lanes_answer_alike(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = choppy_scene(waves, 1);
    static double points[2 * POINTS], height[2][POINTS];
    random_state r = {9};
    for (int i = 0; i < 2 * POINTS; i++)
        points[i] = random_range(&r, -1e4, 1e4);
    points[20] = NAN;
    double covariance[3];
    water_term room[WAVES];
    const water_terms terms = water_terms_at(&scene.water, 3, 0, room, covariance);
    for (uint32_t exact = 0; exact < 2; exact++) {
        for (int k = 0; k < 2; k++) {
            mgt_water_answers answers;
            mgt_water_answers_init(&answers, sizeof answers);
            answers.exact = exact;
            answers.height = height[k];
            (k == 0 ? query_lanes_1 : query_lanes().query)(&terms, 0, points, POINTS, &answers, NULL);
        }
        assert_memory_equal(height[0], height[1], sizeof height[0]);
        assert_true(isnan(height[0][10]));
    }
}

static void rays_are_traced_to_choppy_water(void **state)
{
    (void)state;
    mgt_wave waves[WAVES];
    const mgt_scene scene = choppy_scene(waves, 1);
    random_state r = {10};
    int hits = 0;
    double worst = 0;
    for (int i = 0; i < 60; i++) {
        const double ray[6] = {random_range(&r, -50, 50), 2.5, random_range(&r, -50, 50), cos(i), random_range(&r, -0.6, -0.08), sin(i)};
        double found;
        assert_int_equal(mgt_water_trace(&scene.water, 3, ray, 1, 60, &found), MGT_OK);
        double free = 0, first = INFINITY;
        for (double along = 0; along <= 60 && !isfinite(first); along += 0.01) {
            if (ray[1] + along * ray[4] <= water_surface(&scene.water, ray[0] + along * ray[3], ray[2] + along * ray[5], 3).height)
                first = along;
            else
                free = along;
        }
        if (isinf(first) || isinf(found)) {
            assert_true(isinf(first) && isinf(found));
            continue;
        }
        double low = free, high = first;
        for (int k = 0; k < 40; k++) {
            const double middle = (low + high) / 2;
            const bool above = ray[1] + middle * ray[4] > water_surface(&scene.water, ray[0] + middle * ray[3], ray[2] + middle * ray[5], 3).height;
            low = above ? middle : low;
            high = above ? high : middle;
        }
        hits++;
        worst = fmax(worst, fabs(found - high));
    }
    print_message("  %d of 60 rays hit\n", hits);
    assert_true(hits > 30);
    expect_below("distance off", worst, 1e-6);
}

/* First place of a ray under the surface, by steps of a centimetre and halving; INFINITY: none within `end` metres. */
static double meet_surface(const mgt_water *water, double time, const double from[3], const double direction[3], double end)
{
    double free = 0, under = INFINITY;
    for (double along = 0.01; along <= end && !isfinite(under); along += 0.01) {
        const double height = water_surface(water, from[0] + along * direction[0], from[2] + along * direction[2], time).height;
        if (from[1] + along * direction[1] > height)
            free = along;
        else
            under = along;
    }
    for (int k = 0; k < 40 && isfinite(under); k++) {
        const double middle = (free + under) / 2, height = water_surface(water, from[0] + middle * direction[0], from[2] + middle * direction[2], time).height;
        if (from[1] + middle * direction[1] > height)
            free = middle;
        else
            under = middle;
    }
    return under;
}

/* Begins the batch's rays at the crest-side hits of a camera's rays, mirrored there, as the ground truth of refraction does. */
static void begin_mirrored(const reference_frame *truth, reference_batch *batch)
{
    random_state r = {12};
    for (int i = 0; i < REFERENCE_BATCH; i++) {
        const double x = cos(i), y = -random_range(&r, 0.03, 0.25), z = sin(i), length = hypot(y, 1);
        batch->origin_x[i] = batch->origin_z[i] = batch->time_offset[i] = 0;
        batch->origin_y[i] = 2.5;
        batch->direction_x[i] = x / length, batch->direction_y[i] = y / length, batch->direction_z[i] = z / length;
    }
    truth->search(truth, batch, REFERENCE_BATCH);
    for (int i = 0; i < REFERENCE_BATCH; i++) {
        const double along = isfinite(batch->distance[i]) ? batch->distance[i] : 0, length = sqrt(1 + pow(batch->slope_x[i], 2) + pow(batch->slope_z[i], 2));
        const double normal[3] = {-batch->slope_x[i] / length, 1 / length, -batch->slope_z[i] / length}, aside = 2e-8 * (1 + along);
        const double cosine = batch->direction_x[i] * normal[0] + batch->direction_y[i] * normal[1] + batch->direction_z[i] * normal[2];
        batch->origin_x[i] += along * batch->direction_x[i] + aside * normal[0];
        batch->origin_y[i] += along * batch->direction_y[i] + aside * normal[1];
        batch->origin_z[i] += along * batch->direction_z[i] + aside * normal[2];
        batch->direction_x[i] -= 2 * cosine * normal[0];
        batch->direction_y[i] -= 2 * cosine * normal[1];
        batch->direction_z[i] -= 2 * cosine * normal[2];
    }
}

/* What a crest mirrors may be another wave; it is never the crest itself, at once. */
static void mirrored_rays_meet_other_waves(void **state)
{
    (void)state;
    enum { FAR = 20 };
    static reference_batch batch;
    mgt_wave waves[WAVES];
    const mgt_scene scene = choppy_scene(waves, 1);
    reference_frame *truth;
    assert_int_equal(reference_frame_create(&truth, &scene, NULL, NULL), MGT_OK);
    begin_mirrored(truth, &batch);
    truth->search(truth, &batch, REFERENCE_BATCH);
    int hits = 0, passed = 0;
    double worst = 0;
    for (int i = 0; i < REFERENCE_BATCH; i++) {
        const double direction[3] = {batch.direction_x[i], batch.direction_y[i], batch.direction_z[i]};
        if (direction[1] > 0.2 || (isinf(batch.distance[i]) && passed == 20))
            continue;
        const double from[3] = {batch.origin_x[i], batch.origin_y[i], batch.origin_z[i]}, end = fmin(batch.distance[i] + 0.5, FAR);
        const double exact = meet_surface(&scene.water, scene.time, from, direction, end);
        if (isinf(exact)) {
            assert_true(batch.distance[i] > FAR);
            passed++;
            continue;
        }
        hits++;
        worst = fmax(worst, fabs(batch.distance[i] - exact));
    }
    reference_frame_destroy(truth);
    print_message("  %d mirrored rays meet a wave, %d none\n", hits, passed);
    assert_true(hits > 30 && passed > 10);
    expect_below("distance off", worst, 1e-6);
}

static void choppiness_out_of_range_is_refused(void **state)
{
    (void)state;
    double height;
    const double point[2] = {0, 0};
    static const float wrong[] = {-0.1f, 1.1f, NAN};
    for (int i = 0; i < 3; i++) {
        const mgt_water water = {.index_of_refraction = 1.333, .choppiness = wrong[i]};
        mgt_water_answers answers;
        mgt_water_answers_init(&answers, sizeof answers);
        answers.height = &height;
        assert_int_equal(mgt_water_query(&water, 0, point, 1, &answers), MGT_ERROR_SCENE);
        assert_non_null(strstr(mgt_last_error(NULL), "choppiness"));
        mgt_context *context = NULL;
        assert_int_equal(mgt_context_create(&context, NULL), MGT_OK);
        mgt_scene scene;
        mgt_scene_init(&scene, sizeof scene);
        scene.water.choppiness = wrong[i];
        assert_int_equal(mgt_scene_check(context, &scene), MGT_ERROR_SCENE);
        assert_non_null(strstr(mgt_last_error(context), "water.choppiness"));
        mgt_context_destroy(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_surface_is_that_of_shifted_water),
        cmocka_unit_test(crests_are_sharp),
        cmocka_unit_test(kernels_see_the_surface),
        cmocka_unit_test(the_shutters_ends_are_the_surface_then),
        cmocka_unit_test(ripples_lean_more_on_crests),
        cmocka_unit_test(slopes_of_a_whole_sea),
        cmocka_unit_test(rays_meet_choppy_water_first),
        cmocka_unit_test(folds_are_drawn),
        cmocka_unit_test(questions_find_the_place_of_rest),
        cmocka_unit_test(a_fold_answers_with_its_highest_water),
        cmocka_unit_test(rays_meet_the_highest_water_of_a_fold),
        cmocka_unit_test(lanes_answer_alike),
        cmocka_unit_test(rays_are_traced_to_choppy_water),
        cmocka_unit_test(mirrored_rays_meet_other_waves),
        cmocka_unit_test(choppiness_out_of_range_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
