/* SPDX-License-Identifier: MIT
 *
 * What mgt_render() and mgt_scene_check() refuse: every field out of its range, by name, on both backends alike; and that nothing is
 * written then.
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
#include "params/methods.h"
#include "params/options.h"

enum { SIDE = 8 };

typedef struct api_state {
    mgt_context *contexts[2]; /* null and CPU */
    mgt_scene scene;          /* a small legal one */
    mgt_wave waves[2];
    float pixels[SIDE * SIDE];
    mgt_target target;
} api_state;

static int setup(void **state)
{
    static const mgt_backend backends[2] = {MGT_BACKEND_NULL, MGT_BACKEND_CPU};
    api_state *a = calloc(1, sizeof *a);
    assert_non_null(a);
    for (int i = 0; i < 2; i++) {
        mgt_context_desc desc;
        mgt_context_desc_init(&desc, sizeof desc);
        desc.backend = backends[i];
        desc.threads = 1;
        assert_int_equal(mgt_context_create(&a->contexts[i], &desc), MGT_OK);
    }
    mgt_scene_init(&a->scene, sizeof a->scene);
    a->scene.image = (mgt_image){.width = SIDE, .height = SIDE};
    a->scene.sky.model = MGT_SKY_GRADIENT;
    a->waves[0] = a->waves[1] = (mgt_wave){0.01, 1, 2, -3, 0};
    a->scene.water.waves = a->waves;
    a->scene.water.wave_count = 2;
    mgt_target_init(&a->target, sizeof a->target);
    a->target.layer = MGT_LAYER_COVERAGE;
    a->target.format = MGT_FORMAT_R32F;
    a->target.pixels = a->pixels;
    *state = a;
    return 0;
}

static int teardown(void **state)
{
    api_state *a = *state;
    for (int i = 0; i < 2; i++)
        mgt_context_destroy(a->contexts[i]);
    free(a);
    return 0;
}

static void expect(api_state *a, const mgt_scene *scene, mgt_status status, const char *text)
{
    for (int i = 0; i < 2; i++) {
        for (int p = 0; p < SIDE * SIDE; p++)
            a->pixels[p] = -7;
        const mgt_status checked = mgt_scene_check(a->contexts[i], scene);
        const mgt_status rendered = mgt_render(a->contexts[i], scene, &a->target, 1);
        const char *said = mgt_last_error(a->contexts[i]);
        if (checked != status || rendered != status || (text && !strstr(said, text)))
            fail_msg("expected status %d with \"%s\", got %d and %d: %s", (int)status, text ? text : "", (int)checked, (int)rendered, said);
        if (status == MGT_OK)
            assert_string_equal(said, "");
        else
            for (int p = 0; p < SIDE * SIDE; p++)
                assert_true(a->pixels[p] == -7);
    }
}

#define REFUSE_AS(status, field, value, name) \
    do {                                      \
        mgt_scene changed_ = a->scene;        \
        changed_.field = (value);             \
        expect(a, &changed_, status, name);   \
    } while (0)
#define REFUSE(field, value) REFUSE_AS(MGT_ERROR_SCENE, field, value, #field)
#define ACCEPT(field, value) REFUSE_AS(MGT_OK, field, value, NULL)
/* Nothing that is no number, and nothing just beyond both ends; the ends themselves. */
#define RANGE(field, below, low, high, above) \
    do {                                      \
        REFUSE(field, NAN);                   \
        REFUSE(field, INFINITY);              \
        REFUSE(field, -INFINITY);             \
        REFUSE(field, below);                 \
        REFUSE(field, above);                 \
        ACCEPT(field, low);                   \
        ACCEPT(field, high);                  \
    } while (0)

static void defaults_are_legal(void **state)
{
    api_state *a = *state;
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    for (int i = 0; i < 2; i++)
        assert_int_equal(mgt_scene_check(a->contexts[i], &scene), MGT_OK);
    expect(a, &a->scene, MGT_OK, NULL);
    for (mgt_source body = MGT_SOURCE_SUN; body <= MGT_SOURCE_MOON; body++) {
        mgt_light light;
        mgt_light_init(&light, body);
        ACCEPT(light, light);
    }
}

static void image_is_checked(void **state)
{
    api_state *a = *state;
    REFUSE(image.width, 0);
    REFUSE(image.height, 0);
    REFUSE(image.width, MGT_MAX_IMAGE_SIDE + 1);
    REFUSE(image.height, 100000);
    REFUSE(image.height, UINT32_MAX);
    REFUSE_AS(MGT_ERROR_SCENE, image.crop_x, SIDE, "image.crop");
    REFUSE_AS(MGT_ERROR_SCENE, image.crop_y, UINT32_MAX, "image.crop");
    REFUSE_AS(MGT_ERROR_SCENE, image.crop_width, SIDE + 1, "image.crop");
    REFUSE_AS(MGT_ERROR_SCENE, image.crop_height, UINT32_MAX, "image.crop");
    mgt_scene s = a->scene;
    s.image.crop_x = 3, s.image.crop_width = UINT32_MAX - 1; /* their sum wraps round */
    expect(a, &s, MGT_ERROR_SCENE, "image.crop");
    s.image.crop_width = SIDE - 3;
    expect(a, &s, MGT_OK, NULL);
}

static void camera_is_checked(void **state)
{
    api_state *a = *state;
    for (int i = 0; i < 3; i++) {
        static const double bad[] = {NAN, INFINITY, -INFINITY, 1.1e9, -1.1e9};
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            REFUSE_AS(MGT_ERROR_SCENE, camera.position[i], bad[k], "camera.position");
            REFUSE_AS(MGT_ERROR_SCENE, camera.target[i], bad[k], "camera.target");
            REFUSE_AS(MGT_ERROR_SCENE, camera.up[i], bad[k], "camera.up");
        }
    }
    REFUSE(camera.fov_y_deg, 0);
    REFUSE(camera.fov_y_deg, 179);
    REFUSE(camera.fov_y_deg, -1);
    REFUSE(camera.fov_y_deg, NAN);
    ACCEPT(camera.fov_y_deg, 178.9);
    ACCEPT(camera.fov_y_deg, 1e-3);
    ACCEPT(camera.position[1], 0);
    ACCEPT(camera.position[1], -1);
    mgt_scene s = a->scene;
    memcpy(s.camera.target, s.camera.position, sizeof s.camera.target);
    expect(a, &s, MGT_ERROR_SCENE, "camera.target");
    s = a->scene;
    for (int i = 0; i < 3; i++)
        s.camera.up[i] = 2 * (s.camera.target[i] - s.camera.position[i]);
    expect(a, &s, MGT_ERROR_SCENE, "camera.up");
    for (int i = 0; i < 3; i++)
        s.camera.up[i] = 0;
    expect(a, &s, MGT_ERROR_SCENE, "camera.up");
    /* The camera at shutter open counts only where the camera moves. */
    s = a->scene;
    s.camera_open.fov_y_deg = NAN;
    expect(a, &s, MGT_OK, NULL);
    s.camera_moves = true;
    expect(a, &s, MGT_ERROR_SCENE, "camera_open.fov_y_deg");
}

static void time_and_light_are_checked(void **state)
{
    api_state *a = *state;
    RANGE(time, -1.1e9, -1e9, 1e9, 1.1e9);
    RANGE(shutter, -1e-9, 0, 1e6, 1.1e6);
    RANGE(frame_interval, -1e-9, 0, 1e6, 1.1e6);
    RANGE(light.elevation_deg, -90.001, -90, 90, 90.001);
    RANGE(light.azimuth_deg, -1.1e6, -1e6, 1e6, 1.1e6);
    RANGE(light.angular_radius_deg, 0, 1e-4, 20, 20.001);
    REFUSE(light.body, (mgt_source)2);
    REFUSE(light.body, (mgt_source)-1);
    for (int i = 0; i < 3; i++) {
        REFUSE_AS(MGT_ERROR_SCENE, light.radiance[i], -1, "light.radiance");
        REFUSE_AS(MGT_ERROR_SCENE, light.radiance[i], NAN, "light.radiance");
        REFUSE_AS(MGT_ERROR_SCENE, light.radiance[i], INFINITY, "light.radiance");
        ACCEPT(light.radiance[i], 0);
    }
}

static void sky_and_post_are_checked(void **state)
{
    api_state *a = *state;
    REFUSE(sky.model, (mgt_sky_model)3);
    REFUSE(sky.model, (mgt_sky_model)-1);
    RANGE(sky.turbidity, 0.99f, 1, 10, 10.01f);
    for (int i = 0; i < 3; i++) {
        static const float bad[] = {-1, NAN, INFINITY};
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            REFUSE_AS(MGT_ERROR_SCENE, sky.zenith[i], bad[k], "sky.zenith");
            REFUSE_AS(MGT_ERROR_SCENE, sky.horizon[i], bad[k], "sky.horizon");
            REFUSE_AS(MGT_ERROR_SCENE, sky.night[i], bad[k], "sky.night");
            REFUSE_AS(MGT_ERROR_SCENE, water.body_albedo[i], bad[k], "water.body_albedo");
        }
        REFUSE_AS(MGT_ERROR_SCENE, water.body_albedo[i], 1.01f, "water.body_albedo");
    }
    RANGE(post.exposure_ev, -61, -60, 60, 61);
    RANGE(post.glare, -0.01f, 0, 1, 1.01f);
    REFUSE(post.tone_map, (mgt_tone_map)4);
    REFUSE(post.tone_map, (mgt_tone_map)-1);
}

static void water_is_checked(void **state)
{
    api_state *a = *state;
    static mgt_wave many[10000];
    RANGE(water.index_of_refraction, 0.99, 1, 3, 3.01);
    mgt_scene s = a->scene;
    s.water.waves = many;
    s.water.wave_count = 10000;
    expect(a, &s, MGT_ERROR_SCENE, "water.waves");
    s.water.wave_count = MGT_MAX_WAVES + 1;
    expect(a, &s, MGT_ERROR_SCENE, "water.waves");
    s.water.wave_count = SIZE_MAX;
    expect(a, &s, MGT_ERROR_SCENE, "water.waves");
    s.water.wave_count = MGT_MAX_WAVES;
    expect(a, &s, MGT_OK, NULL);
    s.water.waves = NULL;
    expect(a, &s, MGT_ERROR_ARGUMENT, "water.waves is NULL");
    s.water.wave_count = 0;
    expect(a, &s, MGT_OK, NULL);

    static const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        for (size_t member = 0; member < 5; member++) {
            const mgt_wave kept = a->waves[1];
            double values[5] = {kept.amplitude, kept.kx, kept.kz, kept.omega, kept.phase};
            values[member] = bad[k];
            a->waves[1] = (mgt_wave){values[0], values[1], values[2], values[3], values[4]};
            expect(a, &a->scene, MGT_ERROR_SCENE, "water.waves[1]");
            a->waves[1] = kept;
        }
    a->waves[0].amplitude = -1e-9;
    expect(a, &a->scene, MGT_ERROR_SCENE, "water.waves[0]");
    a->waves[0].amplitude = 0;
    expect(a, &a->scene, MGT_OK, NULL);
    a->waves[0].amplitude = 0.01;
}

static void quality_is_checked(void **state)
{
    api_state *a = *state;
    REFUSE(quality.method, (mgt_method)method_count);
    REFUSE(quality.method, (mgt_method)-1);
    REFUSE(quality.spatial_samples, 0);
    REFUSE(quality.spatial_samples, 1025);
    REFUSE(quality.time_samples, 0);
    REFUSE(quality.time_samples, 65537);
    REFUSE_AS(MGT_ERROR_SCENE, quality.sample_first, 16, "sample_first");
    REFUSE_AS(MGT_ERROR_SCENE, quality.sample_first, UINT64_MAX, "sample_first");
    REFUSE_AS(MGT_ERROR_SCENE, quality.sample_count, 17, "sample_count");
    REFUSE_AS(MGT_ERROR_SCENE, quality.sample_count, UINT64_MAX, "sample_count");
    ACCEPT(quality.sample_first, 15);
    ACCEPT(quality.sample_count, 16);
}

/* What podee-* alone takes, with it and without. */
static void podee_is_checked(void **state)
{
    api_state *a = *state;
    REFUSE_AS(MGT_ERROR_SCENE, quality.kernels, MGT_MIXTURE_9, "podee-uniform or podee-pixel");
    REFUSE_AS(MGT_ERROR_SCENE, quality.path_segments, 2, "podee-uniform or podee-pixel");
    REFUSE_AS(MGT_ERROR_SCENE, quality.transition_hard, true, "podee-uniform or podee-pixel");
    REFUSE_AS(MGT_ERROR_SCENE, quality.transition_width, 0.2, "podee-uniform or podee-pixel");
    REFUSE_AS(MGT_ERROR_SCENE, quality.elongation_limit, 9, "podee-uniform or podee-pixel");
    a->scene.quality.method = MGT_METHOD_PODEE_PIXEL;
    REFUSE(quality.kernels, (mgt_mixture)2);
    REFUSE(quality.kernels, (mgt_mixture)-1);
    REFUSE(quality.kernels, (mgt_mixture)34);
    REFUSE(quality.elongation_limit, 0.99);
    REFUSE(quality.elongation_limit, 1e7);
    REFUSE(quality.elongation_limit, NAN);
    REFUSE(quality.path_segments, 65);
    REFUSE(quality.transition_width, -0.1);
    REFUSE(quality.transition_width, 0.51);
    REFUSE(quality.transition_width, NAN);
    ACCEPT(quality.kernels, MGT_MIXTURE_RIEMANN);
    ACCEPT(quality.elongation_limit, 1);
    ACCEPT(quality.path_segments, 64);
    ACCEPT(quality.transition_width, 0.5);
    ACCEPT(quality.transition_hard, true);
}

/* What mangata/scene.h says of members that the method does not read: all are refused but these. */
static void unread_options_are_refused_or_ignored(void **state)
{
    static const char *const ignored = " spatial_samples time_samples sample_first sample_count ndf_mean_drop tess_error ";
    api_state *a = *state;
    int refused = 0, left = 0;
    for (const field_row *field = quality_fields; field->key; field++) {
        if (!field->when[0].key)
            continue;
        mgt_scene scene = a->scene;
        scene.quality.method = MGT_METHOD_NONE;
        scene.quality.refraction = MGT_REFRACTION_OFF;
        void *place = (char *)&scene.quality + field->offset;
        if (field->type == FIELD_NUMBER)
            *(double *)place = field->max;
        else if (field->type == FIELD_COUNT)
            *(uint32_t *)place = 3;
        else if (field->type == FIELD_LARGE)
            *(uint64_t *)place = 3;
        else if (field->type == FIELD_SWITCH)
            *(bool *)place = true;
        else
            *(int *)place = field->values ? field->values[1] : 1;
        char name[64];
        snprintf(name, sizeof name, " %s ", field->member ? field->member : field->key);
        const bool ignores = strstr(ignored, name) != NULL;
        name[strlen(name) - 1] = 0;
        expect(a, &scene, ignores ? MGT_OK : MGT_ERROR_SCENE, ignores ? NULL : name + 1);
        ignores ? left++ : refused++;
    }
    assert_int_equal(left, 6);
    assert_true(refused > 10);
}

static void null_is_refused(void **state)
{
    api_state *a = *state;
    expect(a, NULL, MGT_ERROR_ARGUMENT, "NULL");
    assert_int_equal(mgt_scene_check(NULL, &a->scene), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_render(NULL, &a->scene, &a->target, 1), MGT_ERROR_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(defaults_are_legal, setup, teardown),
        cmocka_unit_test_setup_teardown(image_is_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(camera_is_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(time_and_light_are_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(sky_and_post_are_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(water_is_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(quality_is_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(podee_is_checked, setup, teardown),
        cmocka_unit_test_setup_teardown(unread_options_are_refused_or_ignored, setup, teardown),
        cmocka_unit_test_setup_teardown(null_is_refused, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
