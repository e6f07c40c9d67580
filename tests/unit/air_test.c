/* SPDX-License-Identifier: MIT
 *
 * The air before the water: its light and what it leaves against integrals in double precision, its table, its kernel, and the horizon.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "frame/air.h"
#include "frame/atmosphere.h"
#include "frame/kernel_data.h"
#include "reference/air.h"
#include "unit/random_numbers.h"

static double double_exp(double x) { return exp(x); }
static double double_sqrt(double x) { return sqrt(x); }

#include "unit/sky_lane.h"

#include "kernels/sky/air.k"

#include "unit/kernel_words_off.h"

static void near(double value, double wanted, double tolerance, int line)
{
    if (!(fabs(value - wanted) <= tolerance))
        fail_msg("line %d: %.9g, not %.9g", line, value, wanted);
}
#define assert_near(value, wanted, tolerance) near(value, wanted, tolerance, __LINE__)

static sky_state *seen_from(double height, double elevation, double turbidity, mgt_scene *scene)
{
    mgt_scene_init(scene, sizeof *scene);
    scene->aerial = true;
    scene->sky.turbidity = (float)turbidity;
    scene->light.elevation_deg = elevation;
    scene->light.azimuth_deg = 30;
    scene->camera.position[1] = height;
    sky_state *s = sky_state_create();
    assert_non_null(s);
    assert_int_equal(sky_state_build(s, &scene->sky, &scene->light), MGT_OK);
    assert_true(sky_state_see_air(s, scene));
    return s;
}

/* ---- the path ---- */

/* In-scattered light of one band from a metre of air along a path. */
typedef struct metre {
    const scattering *air;
    scattering_ray *ray;
    double start, way_sine, sin_light, cos_angle; /* of the whole path, at its beginning */
    int band;
} metre;

static double metre_source(const void *user, double height, double sine, double distance)
{
    const metre *m = user;
    const double length = 1e-3;
    double radiance[SPECTRUM_BANDS];
    scattering_ray_aim_through(m->air, height, sine, length, m->ray);
    const double sin_light = (m->start * m->sin_light + distance * m->cos_angle) / (6371 + height);
    scattering_radiance(m->air, m->ray, sin_light, m->cos_angle, radiance);
    return radiance[m->band] / length;
}

static void ways_agree_with_integrals(void **unused)
{
    static const double turbidities[] = {1, 1.8, 6}, heights[] = {0.002, 0.1, 1, 4}, lengths[] = {0.05, 2, 15, 60}, lights[] = {0.7, 0.05, -0.06};
    for (int t = 0; t < 3; t++) {
        scattering *air = scattering_create(turbidities[t], 0.0047);
        scattering_ray *ray = scattering_ray_create(), *short_ray = scattering_ray_create();
        assert_true(air && ray && short_ray);
        for (int i = 0; i < 48; i++) {
            const double height = heights[i % 4], length = lengths[i / 4 % 4], sin_light = lights[i / 16];
            const double sine = length > height ? -height / length : -1;
            const reference_way way = {turbidities[t], height, sine, fmin(length, sine <= -1 ? height : length)};
            const double cos_angle = sine * sin_light + double_sqrt((1 - sine * sine) * (1 - sin_light * sin_light)) * cos(0.4 * i);
            double through[SPECTRUM_BANDS], radiance[SPECTRUM_BANDS];
            scattering_ray_aim_through(air, height, sine, way.length, ray);
            scattering_ray_transmittance(ray, through);
            scattering_radiance(air, ray, sin_light, cos_angle, radiance);
            for (int band = 1; band < SPECTRUM_BANDS; band += 4) {
                const double nm = SPECTRUM_FIRST + SPECTRUM_STEP * band;
                assert_near(through[band], reference_air_leaves(&way, nm), 2e-3);
                const metre m = {air, short_ray, 6371 + height, sine, sin_light, cos_angle, band};
                const double light = reference_air_light(&way, nm, metre_source, &m);
                if (!(fabs(radiance[band] - light) <= 0.02 * light))
                    fail_msg("turbidity %g, height %g, length %g, light %g, band %d: %g, not %g", turbidities[t], height, way.length, sin_light, band,
                             radiance[band], light);
            }
        }
        scattering_ray_destroy(ray);
        scattering_ray_destroy(short_ray);
        scattering_destroy(air);
    }
}

/* ---- the table and the kernel ---- */

static void exact_way(const sky_state *s, const mgt_scene *scene, const double direction[3], double distance, double leaves[3], double light[3])
{
    const spectrum_weights weights = spectrum_weights_make();
    const light_state *l = lights_get(s->lights, 0);
    air_view view = {.height = scene->camera.position[1], .sin_light = light_toward(l)[1]};
    light_beam_outside(l, view.rgb_irradiance);
    const double *azimuth = light_azimuth(l), across = double_sqrt(direction[0] * direction[0] + direction[2] * direction[2]);
    const double cosine = across > 0 ? (direction[0] * azimuth[0] + direction[2] * azimuth[1]) / across : 1;
    air_along(s->air, &weights, &view, distance, cosine, s->ray, leaves, light);
}

static double peak(const double rgb[3]) { return fmax(rgb[0], fmax(rgb[1], rgb[2])); }

/* Eyes below 20 km, paths with a transmittance above 1/30; errors of light relative to that of the horizon or of the path. */
static void table_agrees_with_ways(void **unused)
{
    static const double heights[] = {2, 30, 300, 2000}, elevations[] = {50, 12, 1, -4}, turbidities[] = {1, 1.8, 5};
    random_state numbers = {7};
    for (int i = 0; i < 48; i++) {
        mgt_scene scene;
        const double height = heights[i % 4];
        sky_state *s = seen_from(height, elevations[i / 4 % 4], turbidities[i / 16], &scene);
        for (int k = 0; k < 60; k++) {
            const double distance = height * double_exp(random_range(&numbers, 0, log(fmax(fmin(20000, 3.4 / s->air_rate) / height, 1)))),
                         angle = random_range(&numbers, 0, 6.283);
            const double sine = -fmin(height / distance, 1), cosine = double_sqrt(1 - sine * sine),
                         direction[3] = {cosine * sin(angle), sine, cosine * cos(angle)};
            double leaves[3], light[3], true_leaves[3], true_light[3], horizon[3];
            sky_air_lookup(s, direction, distance, leaves, light);
            exact_way(s, &scene, direction, distance, true_leaves, true_light);
            sky_lookup(s, (const double[3]){direction[0], 0, direction[2]}, horizon);
            for (int c = 0; c < 3; c++) {
                assert_near(leaves[c], true_leaves[c], 6e-3);
                if (!(fabs(light[c] - true_light[c]) <= 0.02 * fmax(peak(horizon), peak(true_light))))
                    fail_msg("eye %g, elevation %g, turbidity %g, distance %g, azimuth %g, channel %d: %g, not %g; horizon %g", height, elevations[i / 4 % 4],
                             turbidities[i / 16], distance, angle, c, light[c], true_light[c], peak(horizon));
            }
        }
        sky_state_destroy(s);
    }
}

static void kernel_agrees_with_double(void **unused)
{
    mgt_scene scene;
    sky_state *s = seen_from(40, 9, 2.5, &scene);
    FrameData frame = {.air_rate = (float)s->air_rate};
    lights_place(s->lights, false, &frame);
    const struct kernel_context cx = {.frame = &frame, .sky = s->table};
    random_state numbers = {3};
    for (int i = 0; i < 20000; i++) {
        const float x = (float)random_range(&numbers, -1, 1), y = -(float)random_range(&numbers, 0, 1), z = (float)random_range(&numbers, -1, 1);
        const float distance = i == 0 ? 0.0f : i == 1 ? INFINITY : (float)double_exp(random_range(&numbers, 0, 16));
        const AirPath path = air_path(&cx, vec3(x, y, z), distance);
        double leaves[3], light[3];
        sky_air_lookup(s, (const double[3]){(double)x, (double)y, (double)z}, (double)distance, leaves, light);
        const double got[6] = {(double)path.leaves.x, (double)path.leaves.y, (double)path.leaves.z,
                               (double)path.light.x,  (double)path.light.y,  (double)path.light.z};
        for (int c = 0; c < 3; c++) {
            assert_near(got[c], leaves[c], 3e-6);
            assert_near(got[3 + c], light[c], 3e-6 * (1 + light[c]));
        }
    }
    sky_state_destroy(s);
}

/* ---- the horizon ---- */

static void far_water_is_the_horizon(void **unused)
{
    static const double elevations[] = {40, 3, -5};
    for (int i = 0; i < 3; i++) {
        mgt_scene scene;
        sky_state *s = seen_from(10, elevations[i], 1.8, &scene);
        double before[3] = {1, 1, 1};
        for (double distance = 1; distance < 1e9; distance *= 1.3) {
            double leaves[3], light[3], horizon[3];
            sky_air_lookup(s, (const double[3]){1, 0, 0}, distance, leaves, light);
            sky_lookup(s, (const double[3]){1, 0, 0}, horizon);
            for (int c = 0; c < 3; c++) {
                assert_true(leaves[c] >= 0 && leaves[c] <= before[c] && light[c] >= 0);
                before[c] = leaves[c];
                if (distance > 5e8) {
                    assert_near(leaves[c], 0, 1e-9);
                    assert_near(light[c], horizon[c], 1e-9 * horizon[c]);
                }
            }
        }
        sky_state_destroy(s);
    }
}

/* All numbers are finite for any height and any light. */
static void extremes_are_finite(void **unused)
{
    static const double heights[] = {0, 1e-6, 1e3, 1e5, 1e9}, elevations[] = {90, 0, -90};
    for (int i = 0; i < 15; i++) {
        mgt_scene scene;
        sky_state *s = seen_from(heights[i % 5], elevations[i / 5], i % 2 ? 1 : 10, &scene);
        assert_true(s->air_rate > 0 && isfinite(s->air_rate));
        for (size_t k = 0; k < (size_t)SKY_TABLE_ROWS * SKY_COLUMNS * 3; k++)
            assert_true(isfinite(s->table[k]) && s->table[k] >= 0);
        assert_false(sky_state_see_air(s, &scene));
        scene.aerial = false;
        assert_false(sky_state_has_air(&scene));
        sky_state_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ways_agree_with_integrals), cmocka_unit_test(table_agrees_with_ways),
                                       cmocka_unit_test(kernel_agrees_with_double), cmocka_unit_test(far_water_is_the_horizon),
                                       cmocka_unit_test(extremes_are_finite)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
