/* SPDX-License-Identifier: MIT
 *
 * sky.k at one lane: the lookup against sky_lookup(), the disk's energy, shape and edge.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "cpu/kernel_context.h"
#include "frame/kernel_data.h"
#include "frame/atmosphere.h"
#include "unit/sky_light.h"

static double double_sqrt(double x) { return sqrt(x); }

#include "unit/sky_lane.h"

#include "kernels/sky/sky.k"

#include "unit/kernel_words_off.h"

static FrameData frame_of(const sky_state *s)
{
    FrameData frame = {0};
    lights_place(s->lights, false, &frame);
    return frame;
}

static sky_state *sunny(double elevation, double azimuth, double radius)
{
    mgt_sky sky = {.model = MGT_SKY_ATMOSPHERE, .turbidity = 2.0f};
    mgt_light light = {.elevation_deg = elevation, .azimuth_deg = azimuth, .angular_radius_deg = radius, .radiance = {1e6f, 1e6f, 1e6f}};
    sky_state *s = sky_state_create();
    assert_non_null(s);
    assert_int_equal(sky_state_build(s, &sky, &light), MGT_OK);
    return s;
}

static void lookup_agrees_with_double(void **unused)
{
    (void)unused;
    sky_state *s = sunny(9, 200, 0.2665);
    FrameData frame = frame_of(s);
    struct kernel_context cx = {.frame = &frame, .sky = s->table};
    unsigned seed = 1;
    for (int i = 0; i < 200000; ++i) {
        double v[3];
        for (int c = 0; c < 3; ++c) {
            seed = seed * 1664525u + 1013904223u;
            v[c] = (double)(seed >> 8) / 8388608.0 - 1.0;
        }
        v[1] = i % 3 ? v[1] * v[1] : v[1] * 1e-3; /* mostly up, a third at the horizon */
        double length = double_sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        float x = (float)(v[0] / length), y = (float)(v[1] / length), z = (float)(v[2] / length);
        if (i == 0) {
            x = z = 0, y = 1;
        } else if (i == 1) {
            x = frame.lights[0].light_azimuth_x, y = 0, z = frame.lights[0].light_azimuth_z;
        } else if (i == 2) {
            x = -frame.lights[0].light_azimuth_x, y = 0, z = -frame.lights[0].light_azimuth_z;
        }
        vec3 fast = sky_radiance(&cx, vec3(x, y, z));
        double exact[3];
        sky_lookup(s, (const double[3]){x, y, z}, exact);
        const double got[3] = {fast.x, fast.y, fast.z};
        for (int c = 0; c < 3; ++c) {
            if (!(fabs(got[c] - exact[c]) <= 1e-5 * exact[c])) {
                fail_msg("direction (%g %g %g) channel %d: %.9g, not %.9g", x, y, z, c, got[c], exact[c]);
            }
        }
    }
    sky_state_destroy(s);
}

/* Radiance of the disk at (a, b) in its tangent plane. */
static double disk_at(const struct kernel_context *cx, const sky_state *s, double a, double b, double pixel)
{
    const double *l = light_toward(lights_get(s->lights, 0)), h = double_sqrt(l[0] * l[0] + l[2] * l[2]);
    const double e[3] = {-l[2] / h, 0, l[0] / h}, f[3] = {l[1] * e[2], l[2] * e[0] - l[0] * e[2], -l[1] * e[0]};
    double d[3], square = 0;
    for (int c = 0; c < 3; ++c) {
        d[c] = l[c] + a * e[c] + b * f[c];
        square += d[c] * d[c];
    }
    double n = double_sqrt(square);
    return light_disk_radiance(cx, 0, vec3((float)(d[0] / n), (float)(d[1] / n), (float)(d[2] / n)), (float)pixel).y;
}

static void disk_keeps_its_power_at_every_pixel_size(void **unused)
{
    (void)unused;
    static const double sizes[] = {0.05, 0.3, 0.7, 1.0, 1.5, 1.72, 1.75, 2.5, 6, 20};
    sky_state *s = sunny(30, 40, 0.2665);
    FrameData frame = frame_of(s);
    struct kernel_context cx = {.frame = &frame, .sky = s->table};
    double power = 3.14159265358979 * light_of(s).tan_radius * light_of(s).tan_radius * light_of(s).light_radiance[1];
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
        double pixel = sizes[i] * light_of(s).tan_radius, sum = 0;
        int reach = (int)(2.0 / sizes[i]) + 3;
        for (int shift = 0; shift < 16; ++shift) { /* mean over where the lattice falls */
            for (int y = -reach; y <= reach; ++y) {
                for (int x = -reach; x <= reach; ++x) {
                    sum += disk_at(&cx, s, (x + 0.25 * (shift % 4) + 0.1) * pixel, (y + 0.25 * (shift / 4) + 0.1) * pixel, pixel) * pixel * pixel / 16;
                }
            }
        }
        if (!(fabs(sum / power - 1) < 0.03)) {
            fail_msg("pixels of %g radii see %g of the disk's power", sizes[i], sum / power);
        }
    }
    sky_state_destroy(s);
}

static void disk_is_darker_at_the_limb_and_ends(void **unused)
{
    (void)unused;
    sky_state *s = sunny(30, 40, 0.2665);
    FrameData frame = frame_of(s);
    struct kernel_context cx = {.frame = &frame, .sky = s->table};
    double r = light_of(s).tan_radius, pixel = 0.02 * r;
    for (double x = 0; x < 0.97; x += 0.1) {
        double expected = light_of(s).light_radiance[1] * light_limb_factor(lights_get(s->lights, 0), x);
        double got = disk_at(&cx, s, x * r, 0, pixel), turned = disk_at(&cx, s, 0, -x * r, pixel);
        assert_true(fabs(got / expected - 1) < 2e-3);
        assert_true(fabs(turned / got - 1) < 2e-3);
    }
    assert_true(disk_at(&cx, s, 1.02 * r, 0, pixel) == 0);
    double edge = disk_at(&cx, s, r, 0, pixel) / (light_of(s).light_radiance[1] * light_limb_factor(lights_get(s->lights, 0), 1));
    assert_true(edge > 0.4 && edge < 0.6);
    vec3 behind = light_disk_radiance(&cx, 0, vec3(-frame.lights[0].light_x, -frame.lights[0].light_y, -frame.lights[0].light_z), (float)pixel);
    assert_true(behind.x == 0 && behind.y == 0 && behind.z == 0);
    sky_state_destroy(s);
}

static void a_setting_disk_keeps_its_radiance(void **unused)
{
    (void)unused;
    static const double elevations[] = {0.2, 0, -0.1, -0.2};
    for (size_t i = 0; i < sizeof elevations / sizeof *elevations; ++i) {
        sky_state *s = sunny(elevations[i], 0, 0.2665);
        FrameData frame = frame_of(s);
        struct kernel_context cx = {.frame = &frame, .sky = s->table};
        double centre = disk_at(&cx, s, 0, 0, 0.01 * light_of(s).tan_radius);
        double expected = light_of(s).light_radiance[1] / light_of(s).light_visible * light_limb_factor(lights_get(s->lights, 0), 0);
        assert_true(expected > 0 && fabs(centre / expected - 1) < 1e-5);
        sky_state_destroy(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lookup_agrees_with_double),
        cmocka_unit_test(disk_keeps_its_power_at_every_pixel_size),
        cmocka_unit_test(disk_is_darker_at_the_limb_and_ends),
        cmocka_unit_test(a_setting_disk_keeps_its_radiance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
