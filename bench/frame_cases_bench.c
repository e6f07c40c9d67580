/* SPDX-License-Identifier: MIT
 *
 * The Gaussian-disk-path integral on the cases of real frames, and a frame's time by stage on one thread.
 *
 * usage: frame_cases_bench [--quick]
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_scene.h"
#include "frame_cases.h"
#include "tile_frame.h"
#include "timing.h"

enum { RUNS = 7, BLOCK = 256, REPEAT = 4, WIDTHS = 3 };

typedef struct width {
    mgt_isa isa;
    const frame_cases_kernels *cases;
} width;

static const width widths[] = {
#if defined(__x86_64__)
    {MGT_ISA_AVX512, &frame_cases_16},
    {MGT_ISA_AVX2, &frame_cases_8},
#endif
    {MGT_ISA_SCALAR, &frame_cases_1},
};

/* ---- the integral ---- */

static double replay_time(const width *w, const disk_path_cases *cases, volatile float *sink)
{
    double samples[RUNS];
    for (int run = 0; run < RUNS; run++) {
        double total = 0;
        /* Blocks that stay in the cache: the frame's cases do not lie in memory either. */
        for (size_t first = 0; first < cases->count; first += BLOCK) {
            const size_t count = cases->count - first < BLOCK ? cases->count - first : BLOCK;
            *sink += w->cases->replay(cases, first, count);
            const double start = seconds_now();
            for (int i = 0; i < REPEAT; i++)
                *sink += w->cases->replay(cases, first, count);
            total += seconds_now() - start;
        }
        samples[run] = total / REPEAT;
    }
    return timing_of(samples, RUNS).median;
}

static bool bench_integral(const bench_scene *scene, tile_frame *f, tile_scratch *scratch)
{
    const size_t pixels = (size_t)f->columns * f->rows * TILE_PIXELS;
    volatile float sink = 0;
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        const width *w = &widths[i];
        const uint32_t lanes = (uint32_t)w->cases->kernels->lanes;
        if (!mgt_isa_available(w->isa))
            continue;
        disk_path_cases cases = {.capacity = pixels / lanes};
        cases.values = malloc(cases.capacity * lanes * DISK_PATH_INPUTS * sizeof *cases.values);
        if (!cases.values)
            return false;
        w->cases->keep(&cases);
        tile_frame_render(f, w->cases->kernels, scratch);
        w->cases->keep(NULL);
        const double seconds = cases.count ? replay_time(w, &cases, &sink) : 0;
        const double reached = (double)(cases.in_reach ? cases.in_reach : 1);
        printf("| %s | %s, %u | %zu | %.1f %% | %.2f | %.1f | %.2f | %.2f |\n", scene->name, mgt_isa_name(w->isa), lanes, cases.calls,
               100.0 * (double)cases.in_reach / (double)(cases.calls ? cases.calls : 1), (double)cases.evaluations / reached, 1e9 * seconds / reached,
               1e9 * seconds / reached / lanes, 1e3 * seconds);
        free(cases.values);
    }
    return true;
}

/* ---- stages ---- */

enum { TIME_LISTS, TIME_LATTICE, TIME_SURFACE, TIME_COVERAGE, TIME_ALL, TIMES };

static void time_stages(const tile_frame *f, const frame_cases_kernels *w, tile_scratch *s, double seconds[TIMES])
{
    memset(seconds, 0, TIMES * sizeof *seconds);
    for (uint32_t i = 0; i < f->rows * f->columns; i++) {
        double t[TIMES + 1];
        t[0] = seconds_now();
        w->kernels->sort(&f->frame.data, &f->waves->shutter, &f->waves->shutter.view, i % f->columns, i / f->columns, &s->close);
        t[1] = seconds_now();
        if (tile_sees_water(&s->close))
            w->kernels->estimate(&f->frame.data, &s->close, s->close_estimate);
        t[2] = seconds_now();
        w->run_stage(STAGE_SURFACE, &f->frame.data, f->sky->table, &s->close, s->close_estimate, &s->pixels);
        t[3] = seconds_now();
        w->run_stage(STAGE_COVERAGE, &f->frame.data, f->sky->table, &s->close, s->close_estimate, &s->pixels);
        t[4] = seconds_now();
        const method_tile shaded = {.frame = &f->frame.data, .sky = f->sky->table, .close = &s->close, .close_estimate = s->close_estimate};
        w->kernels->method(MGT_METHOD_MANGATA, &shaded, &s->pixels);
        t[5] = seconds_now();
        for (int k = 0; k < TIMES; k++)
            seconds[k] += t[k + 1] - t[k];
    }
}

static void bench_stages(const bench_scene *scene, const tile_frame *f, tile_scratch *s)
{
    const width *w = widths;
    while (!mgt_isa_available(w->isa))
        w++;
    double samples[TIMES][RUNS], medians[TIMES];
    for (int run = 0; run < RUNS; run++) {
        double seconds[TIMES];
        time_stages(f, w->cases, s, seconds);
        for (int k = 0; k < TIMES; k++)
            samples[k][run] = seconds[k];
    }
    for (int k = 0; k < TIMES; k++)
        medians[k] = 1e3 * timing_of(samples[k], RUNS).median;
    printf("| %s, %zu waves | %s | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", scene->name, scene->scene.water.wave_count, mgt_isa_name(w->isa),
           medians[TIME_LISTS], medians[TIME_LATTICE], medians[TIME_SURFACE], medians[TIME_COVERAGE] - medians[TIME_SURFACE],
           medians[TIME_ALL] - medians[TIME_COVERAGE], medians[TIME_LISTS] + medians[TIME_LATTICE] + medians[TIME_ALL]);
}

int main(int argc, char **argv)
{
    enum { SCENES = 3, CASE_SCENES = 2 };
    static const char *const names[SCENES] = {"smooth", "sunset", "smooth"};
    const bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    bench_scene scenes[SCENES] = {{0}};
    tile_frame *frames[SCENES] = {NULL};
    tile_scratch *scratch = calloc(1, sizeof *scratch);
    bool done = scratch;
    for (int i = 0; i < SCENES && done; i++) {
        done = bench_scene_load(&scenes[i], names[i], quick ? 64 : 1280, quick ? 36 : 720) && (i < CASE_SCENES || bench_scene_extend(&scenes[i], 512));
        frames[i] = done ? tile_frame_create(&scenes[i].scene) : NULL;
        done = frames[i];
    }
    if (done) {
        printf("## The Gaussian-disk-path integral on the cases of a frame\n\nThe arguments of every call in a `mangata` frame of %u × %u are kept and "
               "the calls made again on one thread. A vector is in reach when any of its pixels is; the others cost a bound. Times are for a full "
               "vector in reach; evaluations of the integrand likewise.\n\n",
               scenes[0].scene.image.width, scenes[0].scene.image.height);
        printf("| scene | instruction set, lanes | vectors | in reach | evaluations a vector | ns a vector | ns a pixel | ms a frame, 1 thread |\n"
               "|---|---|---:|---:|---:|---:|---:|---:|\n");
    }
    for (int i = 0; i < CASE_SCENES && done; i++)
        done = bench_integral(&scenes[i], frames[i], scratch);
    if (done)
        printf("\n## A frame's time by stage\n\nMethod `mangata` on one thread, milliseconds a frame: differences between runs that stop after each "
               "stage.\n\n| scene | instruction set | tile lists | first-hit lattice | hit, sums over waves, mirror map | integral and its weight | "
               "colour: sky, Fresnel | together |\n|---|---|---:|---:|---:|---:|---:|---:|\n");
    for (int i = 0; i < SCENES && done; i++)
        bench_stages(&scenes[i], frames[i], scratch);
    printf("\n");
    for (int i = 0; i < SCENES; i++) {
        tile_frame_free(frames[i]);
        bench_scene_free(&scenes[i]);
    }
    free(scratch);
    return done ? 0 : 1;
}
