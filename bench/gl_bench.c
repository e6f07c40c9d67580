/* SPDX-License-Identifier: MIT
 *
 * OpenGL: time per frame of every method at three sizes, against the peak of the GPU and against the CPU backend, as tables in Markdown. What one table
 * compares takes turns. GPU time is the sum of the passes' timers, without reading back.
 *
 * usage: gl_bench [--quick] [--gl-device N]      exit 77 where there is no OpenGL
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_scene.h"
#include "gl_frame.h"
#include "gl_peak.h"
#include "operation_frame.h"
#include "params/methods.h"
#include "timing.h"

enum { RUN_LIMIT = 9, PAIRS = 5, METHODS = 5, SIZES = 3, CPU_THREADS = 2 };

static const char *const methods[METHODS] = {"none", "ssaa2", "podee-uniform", "podee-pixel", "mangata"};
static const uint32_t sizes[SIZES][2] = {{1280, 720}, {1920, 1080}, {3840, 2160}};
static const double goal_4k = 2e-3, goal_4k_256 = 5e-3, goal_ratio = 1.5, goal_cpu = 8;

typedef struct bench {
    bool quick;
    int runs;
    gl_frame frame;
    mgt_context *cpu;
    mgt_context_info info, cpu_info;
} bench;

static bool time_methods(const bench *b, const bench_scene *scene, timing out[METHODS])
{
    double seconds[METHODS][RUN_LIMIT];
    mgt_scene scenes[METHODS];
    for (int m = 0; m < METHODS; m++) {
        scenes[m] = scene->scene;
        method_from_name(methods[m], &scenes[m].quality);
        mgt_scene first = scenes[m]; /* builds programs; hardware also grows its buffers and wakes up */
        if (b->frame.software)
            first.image = (mgt_image){.width = 64, .height = 36};
        if (!frame_render(b->frame.gl, &first, b->frame.pixels))
            return false;
    }
    for (int run = 0; run < b->runs; run++)
        for (int m = 0; m < METHODS; m++)
            if ((seconds[m][run] = gl_frame_seconds(&b->frame, &scenes[m], NULL, NULL)) < 0)
                return false;
    for (int m = 0; m < METHODS; m++)
        out[m] = timing_of(seconds[m], (size_t)b->runs);
    return true;
}

static const char *goal(const bench *b, bool met) { return b->frame.software ? "for a GPU" : verdict(met); }

static bool bench_size(const bench *b, uint32_t width, uint32_t height)
{
    bench_scene scene;
    timing t[METHODS];
    if (!bench_scene_load(&scene, "smooth", width, height))
        return false;
    const bool done = time_methods(b, &scene, t);
    for (int m = 0; m < METHODS && done; m++) {
        printf("| %u × %u | %s | %.3f | %.3f – %.3f | %.1f | %.2f |\n", width, height, methods[m], 1e3 * t[m].median, 1e3 * t[m].least, 1e3 * t[m].most,
               1 / t[m].median, t[m].median / t[0].median);
        fflush(stdout);
    }
    if (done && width == 3840) {
        const timing *mangata = &t[METHODS - 1];
        printf("| goals at %u × %u | mangata ≤ %.0f ms | %s | | | ≤ %.1f: %s |\n", width, height, 1e3 * goal_4k, goal(b, mangata->median <= goal_4k),
               goal_ratio, goal(b, mangata->median <= goal_ratio * t[0].median));
    }
    bench_scene_free(&scene);
    return done;
}

static bool bench_sizes(const bench *b)
{
    printf("## Time per frame\n\nScene `smooth` (64 waves) with the sky of the day. %s.\n\n",
           b->frame.software ? "Wall time of a single frame, with reading back" : "GPU time of all passes");
    printf("| size | method | ms a frame | least – most | frames/s | of `none` |\n|---|---|---:|---:|---:|---:|\n");
    for (int i = 0; i < SIZES; i++)
        if (!bench_size(b, b->quick ? 64 : sizes[i][0], b->quick ? 36 : sizes[i][1]) || b->quick)
            return b->quick;
    printf("\n");
    return true;
}

/* More waves at the largest size, pass by pass. */
static bool bench_passes(const bench *b)
{
    static const uint32_t counts[] = {64, 256};
    printf("## Passes of `mangata`\n\n| waves | size |");
    printf(" passes, ms | all, ms | goal | |\n|---:|---|---|---:|---:|---|\n");
    for (size_t i = 0; i < 2; i++) {
        const uint32_t width = b->quick ? 64 : b->frame.software ? 640 : 3840, height = b->quick ? 36 : b->frame.software ? 360 : 2160;
        bench_scene scene;
        mgt_gl_timing passes[GL_FRAME_PASSES];
        size_t count = 0;
        if (!bench_scene_load(&scene, "smooth", width, height))
            return false;
        bool done = counts[i] == 64 || bench_scene_extend(&scene, counts[i]);
        double best = -1;
        for (int run = 0; run < b->runs && done; run++) {
            mgt_gl_timing now[GL_FRAME_PASSES];
            const double seconds = gl_frame_seconds(&b->frame, &scene.scene, now, &count);
            done = seconds >= 0;
            if (best < 0 || seconds < best) {
                best = seconds;
                memcpy(passes, now, sizeof passes);
            }
        }
        bench_scene_free(&scene);
        if (!done)
            return false;
        printf("| %u | %u × %u |", counts[i], width, height);
        for (size_t p = 0; p < count; p++)
            printf(" %s %.3f%s", passes[p].name, 1e3 * passes[p].seconds, p + 1 < count ? "," : "");
        const double limit = counts[i] == 64 ? goal_4k : goal_4k_256;
        printf(" | %.3f | ≤ %.0f | %s |\n", 1e3 * best, 1e3 * limit, goal(b, best <= limit));
    }
    printf("\nThe best of %d frames.\n\n", b->runs);
    return true;
}

/* The same frame by both backends, in turn. */
static bool bench_cpu(bench *b)
{
    bench_scene scene;
    double gl[RUN_LIMIT], cpu[RUN_LIMIT], ratio[RUN_LIMIT];
    if (!bench_scene_load(&scene, "smooth", b->quick ? 64 : 1280, b->quick ? 36 : 720))
        return false;
    bool done = frame_render(b->cpu, &scene.scene, b->frame.pixels) && frame_render(b->frame.gl, &scene.scene, b->frame.pixels);
    const int runs = b->quick ? 1 : PAIRS;
    for (int run = 0; run < runs && done; run++) {
        const double start = seconds_now();
        done = frame_render(b->cpu, &scene.scene, b->frame.pixels);
        cpu[run] = seconds_now() - start;
        gl[run] = done ? gl_frame_seconds(&b->frame, &scene.scene, NULL, NULL) : -1;
        done = gl[run] >= 0;
        ratio[run] = gl[run] / cpu[run];
    }
    bench_scene_free(&scene);
    if (!done)
        return false;
    const timing tg = timing_of(gl, (size_t)runs), tc = timing_of(cpu, (size_t)runs), tr = timing_of(ratio, (size_t)runs);
    printf("## Against the CPU backend\n\n`mangata`, scene `smooth`, %s: OpenGL %.2f ms, the CPU backend (%s, %u threads) %.2f ms.\n\n",
           b->quick ? "64 × 36" : "1280 × 720", 1e3 * tg.median, mgt_isa_name(b->cpu_info.isa), b->cpu_info.threads, 1e3 * tc.median);
    printf("| figure | measured | least – most | limit | |\n|---|---:|---:|---:|---|\n");
    printf("| OpenGL's time / the CPU backend's | %.2f | %.2f – %.2f | %s | %s |\n\n", tr.median, tr.least, tr.most,
           b->frame.software ? "≥ 8 by a software rasteriser" : "", b->frame.software ? verdict(tr.median >= goal_cpu) : "");
    return true;
}

static bool bench_rate(const bench *b)
{
    bench_scene scene;
    timing t[METHODS];
    stage_count count;
    const uint32_t width = b->quick ? 64 : 1280, height = b->quick ? 36 : 720;
    if (!bench_scene_load(&scene, "smooth", width, height))
        return false;
    const bool done = count_frame(&scene.scene, &count) && time_methods(b, &scene, t);
    bench_scene_free(&scene);
    if (!done)
        return false;
    const double peak = gl_fma_peak(b->quick), rate = flops(&count.all) / t[METHODS - 1].median;
    printf("## Operations and the peak\n\nThe operations that a `mangata` frame of `smooth` needs (%.2f × 10⁹, counted by the instrumented kernels; what "
           "neighbours wait for each other is not counted), over its GPU time, beside fused multiply-adds in registers at their best.\n\n",
           1e-9 * flops(&count.all));
    printf("| FMA peak, GFLOP/s | ms a frame | GFLOP/s | fraction of the peak |\n|---:|---:|---:|---:|\n| %.1f | %.3f | %.1f | %.1f %% |\n\n", 1e-9 * peak,
           1e3 * t[METHODS - 1].median, 1e-9 * rate, 100 * rate / peak);
    return true;
}

static int start(bench *b, uint32_t device)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = CPU_THREADS;
    b->info.struct_size = b->cpu_info.struct_size = sizeof(mgt_context_info);
    if (mgt_context_create(&b->cpu, &desc) != MGT_OK)
        return 1;
    desc.backend = MGT_BACKEND_GL;
    desc.gl_device = device;
    if (mgt_context_create(&b->frame.gl, &desc) != MGT_OK) {
        fprintf(stderr, "gl_bench: %s\n", mgt_last_error(NULL));
        return 77;
    }
    mgt_context_get_info(b->frame.gl, &b->info);
    mgt_context_get_info(b->cpu, &b->cpu_info);
    b->frame.software = b->info.software;
    b->runs = b->quick || b->frame.software ? 1 : RUN_LIMIT;
    b->frame.pixels = calloc((size_t)3840 * 2160, 12);
    return b->frame.pixels ? 0 : 1;
}

int main(int argc, char **argv)
{
    bench b = {0};
    uint32_t device = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--quick") == 0) {
            b.quick = true;
        } else if (strcmp(argv[i], "--gl-device") == 0 && i + 1 < argc) {
            device = (uint32_t)strtoul(argv[++i], NULL, 10);
        } else {
            fprintf(stderr, "usage: gl_bench [--quick] [--gl-device N]\n");
            return 64;
        }
    }
    int code = start(&b, device);
    if (code == 0) {
        printf("Renderer: %s%s\n\n", b.info.renderer, b.frame.software ? " — **a software rasteriser: these figures say nothing of a GPU**" : "");
        code = bench_sizes(&b) && bench_passes(&b) && bench_cpu(&b) && bench_rate(&b) ? 0 : 1;
    }
    mgt_context_destroy(b.frame.gl);
    mgt_context_destroy(b.cpu);
    free(b.frame.pixels);
    return code;
}
