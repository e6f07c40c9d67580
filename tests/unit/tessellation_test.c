/* SPDX-License-Identifier: MIT
 * What splitting triangles is worth: how far the drawn ones are from where refraction shows their points, found by dense sampling in double precision,
 * against grids of a fixed spacing; and meshes without holes stay so. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cpu/broad.h"
#include "cpu/gbuffer.h"
#include "reference/refraction.h"
#include "scene/scene_file.h"

enum { SAMPLES = 9 }; /* along the sides of a triangle */

/* ---- what is drawn ---- */

/* The triangles that go by on their way to be set up; kernels have no other place to leave them. */
static struct {
    patch *patches;
    size_t count, room;
} drawn;

static void record_setups(const PictureData *picture, patch_batch *batch, setup_batch *out)
{
    raster_kernels_1.setups(picture, batch, out);
    for (size_t i = 0; i < batch->count; i++) {
        if (batch->hidden[i] > 0 || batch->split[0][i] > 0 || batch->split[1][i] > 0 || batch->split[2][i] > 0)
            continue;
        if (drawn.count == drawn.room) {
            drawn.room = 2 * drawn.room + 1024;
            drawn.patches = realloc(drawn.patches, drawn.room * sizeof *drawn.patches);
            assert_non_null(drawn.patches);
        }
        patch *p = &drawn.patches[drawn.count++];
        for (int corner = 0; corner < 3; corner++)
            for (int k = 0; k < 3; k++) {
                p->corner[corner][k] = batch->corner[corner][k][i];
                p->image[corner][k] = batch->image[corner][k][i];
            }
    }
}

typedef struct setting {
    scene_file *file;
    mgt_scene scene;
    world *world;
    gbuffer_job job;
    gbuffers layers;
    thread_pool *pool;
} setting;

/* A pool of 6 × 2 × 12 m filled up to 0.15 m under its rim. */
static void draw_pool(setting *s, const char *camera, int triangles, double error)
{
    char text[512];
    const int length = snprintf(text, sizeof text,
                                "mangata: 1\nimage: {width: 640, height: 360}\ncamera: %s\nobjects: [{shape: pool, size: [6, 2, 12], "
                                "rim_height: 0.15, rim_width: 0.4, triangles: %d}]\n",
                                camera, triangles);
    scene_error e;
    memset(s, 0, sizeof *s);
    s->file = scene_file_parse(text, (size_t)length, "pool", NULL, 0, &e);
    if (!s->file)
        fail_msg("%s", e.text);
    assert_true(scene_file_frame(s->file, 0, &s->scene));
    s->pool = thread_pool_create(1);
    assert_int_equal(world_update(&s->world, &s->scene, s->pool), MGT_OK);
    s->job = (gbuffer_job){.camera = camera_rays_of(&s->scene.camera, s->scene.image.width, s->scene.image.height),
                           .width = s->scene.image.width,
                           .height = s->scene.image.height,
                           .index = 1.333,
                           .map = MAP_SAGITTAL,
                           .error = error};
    raster_kernels recording = raster_kernels_1;
    recording.setups = record_setups;
    drawn.count = 0;
    assert_int_equal(gbuffers_draw(&s->layers, s->world, &s->job, &recording, s->pool), MGT_OK);
}

static void close_pool(setting *s)
{
    gbuffers_free(&s->layers);
    world_free(s->world);
    thread_pool_destroy(s->pool);
    scene_file_free(s->file);
}

/* ---- where refraction shows a point ---- */

typedef struct place {
    double x, y, depth;
} place;

static place project(const camera_rays *c, const double p[3])
{
    double d[3], normal[3], across = 0, down = 0, squared = 0, depth = 0, size = 0, corner_right = 0, corner_down = 0;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        d[k] = p[k] - (k == 1 ? c->position[1] : 0);
        normal[k] = c->right[a] * c->down[b] - c->right[b] * c->down[a];
    }
    for (int k = 0; k < 3; k++) {
        depth += d[k] * normal[k];
        size += c->corner[k] * normal[k];
        across += d[k] * c->right[k];
        down += d[k] * c->down[k];
        corner_right += c->corner[k] * c->right[k];
        corner_down += c->corner[k] * c->down[k];
        squared += c->right[k] * c->right[k];
    }
    depth /= size;
    return (place){(across / depth - corner_right) / squared, (down / depth - corner_down) / squared, depth};
}

/* Of a point from the camera's foot. */
static place seen(const camera_rays *c, const double p[3])
{
    const double height = c->position[1], across = hypot(p[0], p[2]), far = fmax(height > 0 ? -p[1] : p[1], 1e-9);
    if (across < 1e-9)
        return project(c, (double[3]){p[0], height > 0 ? p[1] / 1.333 : p[1] * 1.333, p[2]});
    const double air = height > 0 ? reference_air_angle(height, far, across, 1.333) : reference_air_angle(far, -height, across, 1.333);
    const double own = height > 0 ? air : asin(sin(air) / 1.333);
    const double drop = across / tan(own);
    return project(c, (double[3]){p[0], height > 0 ? height - drop : height + drop, p[2]});
}

/* The most pixels that points of a triangle in the picture are off by. */
static double patch_error(const setting *s, const patch *p)
{
    double worst = 0;
    const double left = -32, top = -18; /* the guard band counts, as far as the paper's five percent */
    for (int i = 0; i <= SAMPLES; i++)
        for (int j = 0; i + j <= SAMPLES; j++) {
            const double w[3] = {(double)i / SAMPLES, (double)j / SAMPLES, (double)(SAMPLES - i - j) / SAMPLES};
            double point[3] = {0}, image[3] = {0};
            for (int c = 0; c < 3; c++)
                for (int k = 0; k < 3; k++) {
                    point[k] += w[c] * (double)p->corner[c][k];
                    image[k] += w[c] * (double)p->image[c][k];
                }
            const place at = seen(&s->job.camera, point);
            if (!(at.depth > 0.01) || at.x < left || at.x > 640 - left || at.y < top || at.y > 360 - top)
                continue;
            worst = fmax(worst, hypot(image[0] / image[2] + 320 - at.x, image[1] / image[2] + 180 - at.y));
        }
    return worst;
}

static bool is_in_picture(const patch *p)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int c = 0; c < 3; c++) {
        if (p->image[c][2] <= 0.01f)
            return true;
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], (double)p->image[c][k] / (double)p->image[c][2]);
            high[k] = fmax(high[k], (double)p->image[c][k] / (double)p->image[c][2]);
        }
    }
    return high[0] > -352 && low[0] < 352 && high[1] > -198 && low[1] < 198;
}

/* Of all triangles drawn on the far side; counts those in the picture. */
static double worst_error(const setting *s, size_t *count)
{
    double worst = 0;
    *count = 0;
    const float side = s->layers.refract.side;
    for (size_t i = 0; i < drawn.count; i++) {
        const patch *p = &drawn.patches[i];
        bool far = true, whole = false;
        for (int c = 0; c < 3; c++) {
            far &= -side * p->corner[c][1] >= 0;
            whole |= -side * p->corner[c][1] > 0;
        }
        if (!far || !whole || !is_in_picture(p))
            continue;
        (*count)++;
        worst = fmax(worst, patch_error(s, p));
    }
    return worst;
}

static const struct {
    const char *name, *camera;
    double allowed; /* pixels per pixel of tess_error */
} views[] = {
    {"oblique", "{position: [0.8, 4, 7.2], target: [0.3, 0, 0.4], fov_y_deg: 45}", 1},
    {"steep", "{position: [0.5, 6, 2], target: [0.3, 0, 0.4], fov_y_deg: 60}", 1},
    {"grazing", "{position: [0.5, 0.6, 7.5], target: [0.2, -0.3, 0], fov_y_deg: 50}", 1},
    {"at the water", "{position: [0.5, 0.15, 2], target: [0.2, -0.5, 0], fov_y_deg: 60}", 1},
    {"under water", "{position: [0.8, -1.5, 4], target: [0.3, 0.3, 2], fov_y_deg: 70}", 1},
};
enum { VIEWS = sizeof views / sizeof *views };

static void test_error_is_bounded(void **state)
{
    (void)state;
    static const double errors[] = {0.5, 0.25};
    static const int meshes[] = {12, 400};
    for (int v = 0; v < VIEWS; v++)
        for (int e = 0; e < 2; e++)
            for (int m = 0; m < 2; m++) {
                setting s;
                size_t count;
                draw_pool(&s, views[v].camera, meshes[m], errors[e]);
                const double worst = worst_error(&s, &count);
                print_message("  %-12s %4d triangles, tess_error %.2f: %6zu drawn, off by at most %.3f pixels\n", views[v].name, meshes[m], errors[e], count,
                              worst);
                close_pool(&s);
                if (!(worst <= errors[e] * views[v].allowed))
                    fail_msg("%s: %g pixels are more than %g", views[v].name, worst, errors[e]);
            }
}

/* Grids of the pool's own, finer and finer, none of their triangles split, until they are as exact. */
static void test_grids_need_more(void **state)
{
    (void)state;
    for (int v = 0; v < 3; v++) {
        setting s;
        size_t count, grid_count = 0;
        draw_pool(&s, views[v].camera, 12, 0.5);
        const double worst = worst_error(&s, &count);
        close_pool(&s);
        print_message("  %-8s split: %6zu triangles, %.2f pixels\n", views[v].name, count, worst);
        double grid_worst = INFINITY;
        for (int triangles = 12; triangles <= 100000 && grid_worst > worst; triangles *= 3) {
            draw_pool(&s, views[v].camera, triangles, 100);
            grid_worst = worst_error(&s, &grid_count);
            print_message("           grid:  %6zu triangles, %.2f pixels\n", grid_count, grid_worst);
            close_pool(&s);
        }
        assert_true(grid_count > count || grid_worst > worst);
    }
}

/* The pool is closed below and around: where the far side of its water fills a stretch of the picture nothing shines through. */
static void test_no_cracks(void **state)
{
    (void)state;
    static const double errors[] = {0.1, 0.25, 1, 4};
    size_t looked = 0;
    for (int e = 0; e < 4; e++)
        for (int turn = 0; turn < 8; turn++) {
            char camera[160];
            snprintf(camera, sizeof camera, "{position: [%g, %g, %g], target: [%g, -1.5, %g], fov_y_deg: 50}", 2 * sin(turn), 0.4 + 0.3 * turn, 4 * cos(turn),
                     -1.5 * cos(2 * turn), -1.2 + 0.1 * turn);
            setting s;
            draw_pool(&s, camera, turn % 2 ? 12 : 2000, errors[e]);
            const gbuffer *g = &s.layers.refracted;
            for (size_t i = 0; i < (size_t)g->width * g->height; i++) {
                const double x = (double)(i % g->width) - g->left, y = (double)(i / g->width) - g->top;
                /* The ray's place on the surface, if that is well inside the pool. */
                double ray[3];
                for (int k = 0; k < 3; k++)
                    ray[k] = s.job.camera.corner[k] + x * s.job.camera.right[k] + y * s.job.camera.down[k];
                const double along = -s.job.camera.position[1] / ray[1];
                const double at_x = s.job.camera.position[0] + along * ray[0], at_z = s.job.camera.position[2] + along * ray[2];
                if (!(along > 0 && fabs(at_x) < 2.9 && fabs(at_z) < 5.9))
                    continue;
                looked++;
                if (g->triangle[i] < 0)
                    fail_msg("a hole at pixel (%g, %g), camera %s, tess_error %g", x, y, camera, errors[e]);
            }
            close_pool(&s);
        }
    print_message("  %zu pixels without holes\n", looked);
    assert_true(looked > 1000000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error_is_bounded),
        cmocka_unit_test(test_grids_need_more),
        cmocka_unit_test(test_no_cracks),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(drawn.patches);
    return failed;
}
