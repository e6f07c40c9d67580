/* SPDX-License-Identifier: MIT
 *
 * Time of the broad phase of refraction: virtual images of points in lanes, beside the machine's fused multiply-adds, and both G-buffers of a pool
 * with a moving camera.
 *
 * usage: refract_bench [--quick]
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/gbuffer.h"
#include "cpu/raster_lanes.h"
#include "fma_peak.h"
#include "operation_count.h"
#include "operation_frame.h"
#include "scene/scene_file.h"
#include "timing.h"

enum { POINTS = 2048, RUNS = 41, THREADS = 2 };

void counting_virtual_points(const RefractData *refract, size_t count, const float *const in[3]);

typedef struct isa_kernels {
    const char *name;
    mgt_isa isa;
    int lanes;
    const raster_kernels *kernels;
    fma_rounds *run;
} isa_kernels;

static const isa_kernels isas[] = {
#if defined(__x86_64__)
    {"AVX-512", MGT_ISA_AVX512, 16, &raster_kernels_16, fma_rounds_16},
    {"AVX2", MGT_ISA_AVX2, 8, &raster_kernels_8, fma_rounds_8},
    {"SSE2", MGT_ISA_SSE2, 4, &raster_kernels_4, fma_rounds_4},
#else
    {"NEON", MGT_ISA_NEON, 4, &raster_kernels_4, fma_rounds_4},
#endif
};
enum { ISAS = sizeof isas / sizeof *isas };

/* ---- points ---- */

/* Places of a pool, 0 to 3 m on the far side and up to 20 m away. */
static void fill_points(float points[3][POINTS], float side)
{
    for (int i = 0; i < POINTS; i++) {
        points[0][i] = (float)(20 * sin(0.37 * i));
        points[1][i] = -side * (float)(0.003 * (i % 1000));
        points[2][i] = (float)(20 * cos(0.23 * i));
    }
}

static double seconds_a_point(const raster_kernels *kernels, const RefractData *refract, const float *const in[3], int runs)
{
    static float memory[3][POINTS];
    float *out[3] = {memory[0], memory[1], memory[2]};
    double best = INFINITY;
    for (int i = 0; i < runs; i++) {
        const double start = seconds_now();
        for (int k = 0; k < 8; k++)
            kernels->virtual_points(refract, POINTS, in, out);
        best = fmin(best, (seconds_now() - start) / (8 * POINTS));
    }
    return best;
}

static void print_points(bool quick)
{
    static float points[3][POINTS];
    const float *in[3] = {points[0], points[1], points[2]};
    printf("## Points seen through a flat surface\n\nOne thread; the limit is 5 ns a point with the widest instruction set. The peak is that of independent "
           "fma in registers; a division and a square root count as one operation each, though they take as long as dozens.\n\n"
           "| camera | instruction set | ns a point | | flop a point | GFLOP/s | share of the FMA peak |\n|---|---|---:|---|---:|---:|---:|\n");
    bool first = true;
    for (size_t i = 0; i < ISAS; i++) {
        if (!mgt_isa_available(isas[i].isa))
            continue;
        for (int below = 0; below < 2; below++) {
            const RefractData refract = refract_data_of(below ? -1.5 : 1.5, 1.333, MAP_SAGITTAL);
            fill_points(points, refract.side);
            operations_done = (operation_count){0};
            counting_virtual_points(&refract, POINTS, in);
            const double work = flops(&operations_done) / POINTS, peak = fma_peak(isas[i].run, isas[i].lanes, 1, quick ? 0.001 : 0.2);
            const double time = seconds_a_point(isas[i].kernels, &refract, in, quick ? 1 : 400);
            printf("| %s | %s | %.2f | %s | %.0f | %.1f | %.0f %% |\n", below ? "below" : "above", isas[i].name, 1e9 * time, first ? verdict(time <= 5e-9) : "",
                   work, 1e-9 * work / time, 100 * work / time / peak);
        }
        first = false;
    }
    printf("\n");
}

/* ---- G-buffers ---- */

typedef struct pool_case {
    const char *name;
    double position[3], target[3];
    int triangles;
    int map;
} pool_case;

static const pool_case cases[] = {
    {"coarse basin, split", {0.8, 4, 7.2}, {0.3, 0, 0.4}, 12, MAP_SAGITTAL},    {"above", {0.8, 4, 7.2}, {0.3, 0, 0.4}, 16000, MAP_SAGITTAL},
    {"above, unrefracted", {0.8, 4, 7.2}, {0.3, 0, 0.4}, 16000, MAP_STRAIGHT},  {"above", {0.8, 4, 7.2}, {0.3, 0, 0.4}, 128000, MAP_SAGITTAL},
    {"above, unrefracted", {0.8, 4, 7.2}, {0.3, 0, 0.4}, 128000, MAP_STRAIGHT}, {"grazing", {0.5, 0.6, 7.5}, {0.2, -0.3, 0}, 128000, MAP_SAGITTAL},
    {"under water", {0.8, -1.5, 4}, {0.3, 0.3, 2}, 128000, MAP_SAGITTAL},
};
enum { CASES = sizeof cases / sizeof *cases };

typedef struct pool_run {
    scene_file *file;
    mgt_scene scene;
    world *world;
    gbuffers layers;
    double seconds[THREADS][RUNS];
} pool_run;

static bool load_pool(pool_run *run, const pool_case *c, thread_pool *pool)
{
    char text[400];
    scene_error error;
    const int length = snprintf(text, sizeof text,
                                "mangata: 1\nimage: {width: 1280, height: 720}\ncamera: {position: [%g, %g, %g], target: [%g, %g, %g], fov_y_deg: 45}\n"
                                "objects: [{shape: pool, size: [6, 2, 12], rim_height: 0.15, rim_width: 0.4, triangles: %d}]\n",
                                c->position[0], c->position[1], c->position[2], c->target[0], c->target[1], c->target[2], c->triangles);
    run->file = scene_file_parse(text, (size_t)length, "pool", NULL, 0, &error);
    return run->file && scene_file_frame(run->file, 0, &run->scene) && world_update(&run->world, &run->scene, pool) == MGT_OK;
}

/* Every run looks from a little farther on, so that nothing of the last one serves. */
static bool draw_pool(pool_run *run, const pool_case *c, const raster_kernels *kernels, thread_pool *pool, int step)
{
    const mgt_image *image = &run->scene.image;
    gbuffer_job job = {.camera = camera_rays_of(&run->scene.camera, image->width, image->height),
                       .width = image->width,
                       .height = image->height,
                       .index = 1.333,
                       .map = c->map,
                       .crest = 0.05};
    job.camera.position[0] += 1e-4 * step;
    return gbuffers_draw(&run->layers, run->world, &job, kernels, pool) == MGT_OK;
}

static void print_run(const pool_case *c, pool_run *run, int runs)
{
    const timing one = timing_of(run->seconds[0], (size_t)runs), two = timing_of(run->seconds[1], (size_t)runs);
    printf("| %s | %zu | %zu + %zu | %.1f | %.2f (%.2f – %.2f) | %.2f (%.2f – %.2f) |\n", c->name, run->world->triangle_count,
           run->layers.counts.front_triangles, run->layers.counts.far_triangles, 1e-6 * (double)world_size(run->world), 1e3 * one.median, 1e3 * one.least,
           1e3 * one.most, 1e3 * two.median, 1e3 * two.least, 1e3 * two.most);
}

static bool print_gbuffers(bool quick)
{
    const raster_kernels *kernels = &raster_kernels_1;
    for (size_t i = ISAS; i-- > 0;)
        if (mgt_isa_available(isas[i].isa))
            kernels = isas[i].kernels;
    thread_pool *pools[THREADS] = {thread_pool_create(1), thread_pool_create(2)};
    static pool_run runs[CASES];
    const int count = quick ? 1 : RUNS;
    bool done = pools[0] && pools[1];
    for (int i = 0; i < CASES && done; i++)
        done = load_pool(&runs[i], &cases[i], pools[1]);
    for (int t = 0; t < THREADS && done; t++)
        for (int r = -1; r < count && done; r++) /* all of them in turn, the first time for warming up */
            for (int i = 0; i < CASES && done; i++) {
                const double start = seconds_now();
                done = draw_pool(&runs[i], &cases[i], kernels, pools[t], t * RUNS + r);
                if (r >= 0)
                    runs[i].seconds[t][r] = seconds_now() - start;
            }
    if (done)
        printf("## G-buffers\n\nBoth layers of a pool of 6 × 2 × 12 m, 1280 × 720 pixels and a guard band, tess_error 0.25, with a camera that moves: "
               "median, least and most of %d runs in turn. Triangles drawn are those that touch a pixel's centre, on the camera's side and on the other.\n\n"
               "| view | triangles | drawn | MB of world | ms, 1 thread | ms, 2 threads |\n|---|---:|---:|---:|---:|---:|\n",
               count);
    for (int i = 0; i < CASES && done; i++)
        print_run(&cases[i], &runs[i], count);
    printf("\n");
    for (int i = 0; i < CASES; i++) {
        gbuffers_free(&runs[i].layers);
        world_free(runs[i].world);
        scene_file_free(runs[i].file);
    }
    for (int t = 0; t < THREADS; t++)
        if (pools[t])
            thread_pool_destroy(pools[t]);
    return done;
}

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    print_points(quick);
    return print_gbuffers(quick) ? 0 : 1;
}
