/* SPDX-License-Identifier: MIT
 *
 * The depth layer of the standard scenes, by point samples and by the reference renderer, against the first hit by exhaustive steps.
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
#include "reference/equations.h"
#include "scene/scene_file.h"
#include "unit/depth_picture.h"

enum { WIDTH = 160, HEIGHT = 90, SAMPLES = 1500 };

static scene_file *load(const char *name, mgt_scene *scene)
{
    char path[512];
    snprintf(path, sizeof path, MGT_SOURCE_DIR "/scenes/%s.json", name);
    scene_error error;
    scene_file *file = scene_file_load(path, NULL, 0, &error);
    assert_non_null(file);
    assert_true(scene_file_frame(file, 0, scene));
    scene->image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    return file;
}

static void depth_by(mgt_scene scene, mgt_method method, float *depth)
{
    scene.quality = (mgt_quality){.method = method, .spatial_samples = 1, .time_samples = 1};
    render_depth(&scene, depth);
}

/* Per cent of sampled pixels that are off by more than max(1%, 5 mm). */
static double share_off(const mgt_scene *scene, mgt_method method)
{
    static float depth[WIDTH * HEIGHT];
    depth_by(*scene, method, depth);
    int off = 0;
    for (int i = 0; i < SAMPLES; i++) {
        /* A stride that shares no factor with the number of pixels visits each once. */
        const uint32_t pixel = (uint32_t)((uint64_t)i * 5701 % (WIDTH * HEIGHT)), x = pixel % WIDTH, y = pixel / WIDTH;
        const water_hit exact = first_hit_brute_force(scene, x + 0.5, y + 0.5, scene->time);
        const double found = (double)depth[pixel];
        if (!exact.hit)
            off += !isinf(found);
        else
            off += !(fabs(found - exact.distance) <= fmax(0.01 * exact.distance, 0.005));
    }
    return 100.0 * off / SAMPLES;
}

static void check(const char *name, mgt_method method, double limit)
{
    mgt_scene scene;
    scene_file *file = load(name, &scene);
    const double share = share_off(&scene, method);
    scene_file_free(file);
    print_message("  %-8s %-10s %.4f%% off (≤ %g%%)\n", name, method == MGT_METHOD_NONE ? "none" : "reference", share, limit);
    assert_true(share <= limit);
}

static void point_samples_find_the_first_hit(void **state)
{
    (void)state;
    check("simple", MGT_METHOD_NONE, 0.1);
    check("high", MGT_METHOD_NONE, 0.1);
    check("rough", MGT_METHOD_NONE, 0.5);
}

static void the_reference_finds_the_first_hit(void **state)
{
    (void)state;
    check("simple", MGT_METHOD_REFERENCE, 0);
    check("high", MGT_METHOD_REFERENCE, 0);
    check("rough", MGT_METHOD_REFERENCE, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(point_samples_find_the_first_hit),
        cmocka_unit_test(the_reference_finds_the_first_hit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
