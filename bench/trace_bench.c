/* SPDX-License-Identifier: MIT
 * Rays traced per second by one thread and by all, time and memory of the tree: a bumpy floor seen from above as refracted rays see it, and the shadows on it.
 *
 *   trace_bench [--quick] */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/thread_pool.h"
#include "timing.h"
#include "trace/trace.h"

enum { WIDTH = 1280, HEIGHT = 720, ROW = WIDTH };

/* Two triangles a cell of a floor of `side`² cells on 12 × 12 m, two metres below the water. */
static float *floor_triangles(uint32_t side)
{
    float *corners = malloc(((size_t)18 * side * side + 1) * sizeof *corners), *c = corners;
    if (!corners)
        return NULL;
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            static const uint32_t cell[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
            for (int k = 0; k < 6; k++) {
                const float i = 12.0f * (float)(x + cell[k][0]) / (float)side, j = 12.0f * (float)(y + cell[k][1]) / (float)side;
                *c++ = i - 6;
                *c++ = 0.3f * sinf(3 * i) * cosf(2 * j) - 2;
                *c++ = -j;
            }
        }
    return corners;
}

typedef struct picture {
    const trace_scene *scene;
    const trace_ray *rays;
    trace_hit *hits;
    uint8_t *occluded; /* NULL: nearest hits are looked for */
} picture;

static void trace_row(void *argument, size_t row, uint32_t worker)
{
    (void)worker;
    const picture *p = argument;
    if (p->occluded)
        trace_occluded(p->scene, ROW, p->rays + row * ROW, p->occluded + row * ROW);
    else
        trace_nearest(p->scene, ROW, p->rays + row * ROW, p->hits + row * ROW);
}

/* From the surface of a wavy pool, down. */
static void aim(trace_ray *rays)
{
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const float u = 10 * ((float)x / WIDTH - 0.5f), v = -10 * (float)y / HEIGHT;
            rays[(size_t)y * WIDTH + x] = (trace_ray){{u, 0, v - 0.5f}, {0.1f * u + 0.02f * sinf(5 * u), -1, -0.3f + 0.02f * cosf(7 * v)}, 0, FLT_MAX};
        }
}

static void aim_at_light(trace_ray *rays, const trace_hit *hits)
{
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        for (int k = 0; k < 3; k++)
            rays[i].origin[k] += hits[i].along * rays[i].direction[k];
        rays[i].direction[0] = 0.5f;
        rays[i].direction[1] = 0.6f;
        rays[i].direction[2] = -0.3f;
        rays[i].least = 1e-3f;
    }
}

static double rays_per_second(thread_pool *pool, picture *p, int rounds)
{
    double times[9];
    for (int i = 0; i < rounds; i++) {
        const double start = seconds_now();
        thread_pool_run(pool, &(thread_loop){HEIGHT, trace_row, p, NULL});
        times[i] = seconds_now() - start;
    }
    return (double)WIDTH * HEIGHT / timing_of(times, (size_t)rounds).median;
}

static void measure(uint32_t side, uint32_t threads, bool quick)
{
    const size_t count = (size_t)2 * side * side, pixels = (size_t)WIDTH * HEIGHT;
    char error[REPORTER_TEXT] = "";
    const reporter quiet = {.error = error};
    float *corners = floor_triangles(side);
    trace_ray *rays = malloc(pixels * sizeof *rays);
    trace_hit *hits = malloc(pixels * sizeof *hits);
    uint8_t *occluded = malloc(pixels);
    thread_pool *pool = thread_pool_create(threads);
    trace_scene *scene = NULL;
    uint32_t *indices = malloc(3 * count * sizeof *indices);
    for (size_t i = 0; indices && i < 3 * count; i++)
        indices[i] = (uint32_t)i;
    const trace_triangles triangles = {count, 3 * count, corners, indices, 1};
    const double start = seconds_now();
    if (!corners || !indices || !rays || !hits || !occluded || !pool || trace_scene_update(&scene, &triangles, threads, &quiet) != MGT_OK) {
        fprintf(stderr, "trace_bench: %s\n", error[0] ? error : "out of memory");
        exit(1);
    }
    const double built = seconds_now() - start;
    aim(rays);
    picture p = {scene, rays, hits, NULL};
    const double nearest = rays_per_second(pool, &p, quick ? 1 : 9);
    aim_at_light(rays, hits);
    p.occluded = occluded;
    const double shadow = rays_per_second(pool, &p, quick ? 1 : 9);
    printf("%10zu %8u %10.3f %10.1f %10.1f %12.2f %12.2f\n", count, threads, built, (double)trace_scene_bytes(scene) / 1048576,
           (double)trace_scene_bytes(scene) / (double)count, nearest / 1e6, shadow / 1e6);
    trace_scene_free(scene);
    thread_pool_destroy(pool);
    free(occluded);
    free(hits);
    free(rays);
    free(indices);
    free(corners);
}

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    if (!trace_available()) {
        fprintf(stderr, "trace_bench: this build traces no rays\n");
        return 77;
    }
    printf("%10s %8s %10s %10s %10s %12s %12s\n", "triangles", "threads", "build s", "MiB", "bytes each", "nearest M/s", "shadow M/s");
    static const uint32_t sides[] = {90, 253, 1582}; /* 16 200, 128 018 and 5 005 448 triangles */
    for (int i = 0; i < (quick ? 1 : 3); i++)
        for (uint32_t threads = 1; threads <= thread_pool_usable_cpus(); threads++)
            measure(sides[i], threads, quick);
    return 0;
}
