/* SPDX-License-Identifier: MIT
 *
 * Floating-point operations of a `mangata` frame, counted by the instrumented kernels at one lane, and the rate that this makes of its
 * time, beside the fused multiply-adds that the same machine does in registers at its best.
 *
 * usage: operations_bench [--quick]
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_scene.h"
#include "fma_peak.h"
#include "operation_frame.h"
#include "timing.h"

enum { RUNS = 9, THREADS = 2 };

static void print_count(const char *name, const operation_count *n, double water)
{
    printf("| %s | %.3f | %.3f | %.3f | %.4f | %.4f | %.3f | %.3f | %.0f |\n", name, 1e-9 * (double)n->fused, 1e-9 * (double)n->add, 1e-9 * (double)n->multiply,
           1e-9 * (double)n->divide, 1e-9 * (double)n->square_root, 1e-9 * (double)n->other, 1e-9 * flops(n), flops(n) / water);
}

static bool print_counts(const bench_scene *scene, stage_count *count)
{
    if (!count_frame(&scene->scene, count))
        return false;
    printf("Scene `%s`, %u × %u, %zu waves: %.0f water pixels, %.2f evaluations of the disk-path integral's integrand for each.\n\n", scene->name,
           scene->scene.image.width, scene->scene.image.height, scene->scene.water.wave_count, count->water, (double)count->all.integrands / count->water);
    printf("| 10⁹ operations | fma | + − | × | ÷ | √ | others | flop, an fma being two | flop a water pixel |\n"
           "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    print_count("lattice of first hits", &count->lattice, count->water);
    print_count("whole frame", &count->all, count->water);
    printf("\n");
    return true;
}

/* Seconds of a frame by the library itself. */
static bool time_frame(const mgt_scene *scene, mgt_isa isa, uint32_t threads, int runs, timing *out)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.isa = isa;
    desc.threads = threads;
    mgt_context *context = NULL;
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.format = MGT_FORMAT_RGB32F;
    target.pixels = calloc((size_t)scene->image.width * scene->image.height, 12);
    double seconds[RUNS];
    bool done = target.pixels && mgt_context_create(&context, &desc) == MGT_OK && mgt_render(context, scene, &target, 1) == MGT_OK;
    for (int i = 0; i < runs && done; i++) {
        const double start = seconds_now();
        done = mgt_render(context, scene, &target, 1) == MGT_OK;
        seconds[i] = seconds_now() - start;
    }
    mgt_context_destroy(context);
    free(target.pixels);
    if (done)
        *out = timing_of(seconds, (size_t)runs);
    return done;
}

int main(int argc, char **argv)
{
    static const struct {
        mgt_isa isa;
        int lanes;
        fma_rounds *run;
    } isas[] = {
#if defined(__x86_64__)
        {MGT_ISA_AVX512, 16, fma_rounds_16},
        {MGT_ISA_AVX2, 8, fma_rounds_8},
        {MGT_ISA_SSE2, 4, fma_rounds_4},
#else
        {MGT_ISA_NEON, 4, fma_rounds_4},
#endif
    };
    const bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    const uint32_t width = quick ? 64 : 1280, height = quick ? 36 : 720;
    bench_scene smooth = {0}, sunset = {0};
    stage_count count, other;
    bool done = bench_scene_load(&smooth, "smooth", width, height) && bench_scene_load(&sunset, "sunset", width, height);
    printf("## Operations and the peak\n\n");
    done = done && print_counts(&smooth, &count) && print_counts(&sunset, &other);
    if (done)
        printf("A frame of `smooth` by `mangata` against the peak: %d independent chains of fma in registers (SSE2: a multiplication and an "
               "addition), the best of 20 runs. The peak is measured next to the frame's time, for the clock differs by instruction set.\n\n"
               "| instruction set | threads | FMA peak, GFLOP/s | ms a frame | GFLOP/s | fraction of the peak |\n|---|---:|---:|---:|---:|---:|\n",
               FMA_CHAINS);
    for (size_t i = 0; i < sizeof isas / sizeof *isas && done; i++)
        for (uint32_t threads = 1; threads <= THREADS && done; threads++) {
            timing t;
            if (!mgt_isa_available(isas[i].isa))
                continue;
            const double before = fma_peak(isas[i].run, isas[i].lanes, (int)threads, quick ? 0.001 : 0.2);
            done = time_frame(&smooth.scene, isas[i].isa, threads, quick ? 1 : RUNS, &t);
            const double after = fma_peak(isas[i].run, isas[i].lanes, (int)threads, quick ? 0.001 : 0.2);
            const double peak = before > after ? before : after, rate = flops(&count.all) / t.median;
            if (done)
                printf("| %s | %u | %.1f | %.2f (%.2f – %.2f) | %.1f | %.1f %% |\n", mgt_isa_name(isas[i].isa), threads, 1e-9 * peak, 1e3 * t.median,
                       1e3 * t.least, 1e3 * t.most, 1e-9 * rate, 100 * rate / peak);
        }
    printf("\n");
    bench_scene_free(&smooth);
    bench_scene_free(&sunset);
    return done ? 0 : 1;
}
