/* SPDX-License-Identifier: MIT
 *
 * Time per frame as tables in Markdown: methods, instruction sets, sizes, threads, numbers of waves. What one table compares takes
 * turns, so that a change of the machine's pace meets all of it; each figure is the median of its runs with the least and the most.
 *
 * usage: frame_bench [--quick]     (--quick: tiny pictures once, to see that it works)
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench_scene.h"
#include "params/methods.h"
#include "timing.h"

enum { CASE_LIMIT = 16, RUN_LIMIT = 31, THREADS = 2 };

/* One thing whose frames are timed. */
typedef struct frame_case {
    mgt_context *context;
    mgt_scene scene;
    double seconds[RUN_LIMIT];
    timing time;
} frame_case;

typedef struct bench {
    bool quick;
    mgt_context *context; /* best instruction set, THREADS threads */
    mgt_context_info info;
    float *pixels; /* room for the largest frame */
    uint32_t width, height, large_width, large_height;
    frame_case cases[CASE_LIMIT];
    size_t case_count;
} bench;

static mgt_context *context_of(mgt_isa isa, uint32_t threads)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.isa = isa;
    desc.threads = threads;
    mgt_context *context = NULL;
    if (mgt_context_create(&context, &desc) != MGT_OK)
        fprintf(stderr, "frame_bench: %s\n", mgt_last_error(NULL));
    return context;
}

static frame_case *add_case(bench *b, mgt_context *context, const mgt_scene *scene, const char *method)
{
    frame_case *c = &b->cases[b->case_count++];
    *c = (frame_case){.context = context, .scene = *scene};
    method_from_name(method, &c->scene.quality);
    return c;
}

static bool render(const bench *b, const frame_case *c, mgt_layer layer)
{
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.layer = layer;
    target.format = layer == MGT_LAYER_COLOR ? MGT_FORMAT_RGB32F : MGT_FORMAT_R32F;
    target.pixels = b->pixels;
    if (mgt_render(c->context, &c->scene, &target, 1) == MGT_OK)
        return true;
    fprintf(stderr, "frame_bench: %s\n", mgt_last_error(c->context));
    return false;
}

/* The first frame of each case builds tables and touches memory, and does not count; of cases that are measured once, being slow, one
 * frame does for all. */
static bool measure(bench *b, int runs)
{
    if (b->quick)
        runs = 1;
    for (size_t i = runs > 1 ? 0 : b->case_count - 1; i < b->case_count; i++)
        if (!render(b, &b->cases[i], MGT_LAYER_COLOR))
            return false;
    for (int run = 0; run < runs; run++)
        for (size_t i = 0; i < b->case_count; i++) {
            const double start = seconds_now();
            if (!render(b, &b->cases[i], MGT_LAYER_COLOR))
                return false;
            b->cases[i].seconds[run] = seconds_now() - start;
        }
    for (size_t i = 0; i < b->case_count; i++) {
        double sorted[RUN_LIMIT];
        memcpy(sorted, b->cases[i].seconds, sizeof sorted);
        b->cases[i].time = timing_of(sorted, (size_t)runs);
    }
    return true;
}

static void print_case(const char *label, const frame_case *c)
{
    const timing *t = &c->time;
    printf("| %s | %s | %.2f | %.2f – %.2f | %.1f | %.1f |\n", label, method_name(&c->scene.quality).text, 1e3 * t->median, 1e3 * t->least, 1e3 * t->most,
           1 / t->median, 1e-6 * c->scene.image.width * c->scene.image.height / t->median);
}

static void print_head(const char *what) { printf("| %s | method | ms a frame | least – most | frames/s | Mpixel/s |\n|---|---|---:|---:|---:|---:|\n", what); }

static double water_pixels(const bench *b, const frame_case *c)
{
    double sum = 0;
    if (render(b, c, MGT_LAYER_MASK))
        for (size_t i = 0; i < (size_t)c->scene.image.width * c->scene.image.height; i++)
            sum += b->pixels[i];
    return sum;
}

/* ---- tables ---- */

static bool bench_methods(bench *b, const bench_scene *smooth)
{
    static const char *const methods[] = {"none", "ssaa2", "podee-uniform", "podee-pixel", "mangata"};
    b->case_count = 0;
    for (size_t i = 0; i < 5; i++)
        add_case(b, b->context, &smooth->scene, methods[i]);
    if (!measure(b, 9))
        return false;
    printf("## Time per frame\n\nScene `smooth` (%zu waves) with the sky of the day, %u × %u, %u threads.\n\n", smooth->scene.water.wave_count, b->width,
           b->height, b->info.threads);
    print_head("instruction set");
    for (size_t i = 0; i < b->case_count; i++)
        print_case(mgt_isa_name(b->info.isa), &b->cases[i]);
    const frame_case *none = &b->cases[0], *mangata = &b->cases[4];
    const double water = water_pixels(b, mangata), each = mangata->time.median / (water * (double)smooth->scene.water.wave_count);
    const bool judged = b->info.isa == MGT_ISA_AVX512;
    printf("\n| figure | measured | limit | |\n|---|---:|---:|---|\n");
    printf("| `mangata`, ms a frame | %.2f | ≤ 33 with AVX-512 on 2 cores | %s |\n", 1e3 * mangata->time.median,
           judged ? verdict(mangata->time.median <= 0.033) : "not this machine");
    printf("| `mangata` / `none` | %.2f | ≤ 1.5 | %s |\n", mangata->time.median / none->time.median, verdict(mangata->time.median <= 1.5 * none->time.median));
    printf("| `mangata`, ns per water pixel (%.0f of them) and wave | %.3f | | |\n", water, 1e9 * each);
    printf("| the same, times %u threads | %.3f | | |\n\n", b->info.threads, 1e9 * each * b->info.threads);
    return true;
}

static bool bench_isas(bench *b, const bench_scene *smooth)
{
    static const mgt_isa isas[] = {MGT_ISA_AVX2, MGT_ISA_NEON, MGT_ISA_SSE2, MGT_ISA_SCALAR};
    static const char *const methods[] = {"none", "ssaa2", "podee-uniform", "podee-pixel", "mangata"};
    bool done = true;
    printf("The same by narrower instruction sets (`--isa`); scalar is the plain reference, built to be exact and not to be fast.\n\n");
    print_head("instruction set");
    for (size_t i = 0; i < sizeof isas / sizeof *isas && done; i++) {
        if (isas[i] == b->info.isa || !mgt_isa_available(isas[i]))
            continue;
        mgt_context *context = context_of(isas[i], THREADS);
        b->case_count = 0;
        for (size_t m = 0; m < 5; m++)
            if (m != 1 || isas[i] == MGT_ISA_AVX2)
                add_case(b, context, &smooth->scene, methods[m]);
        done = context && measure(b, isas[i] == MGT_ISA_SCALAR ? 1 : isas[i] == MGT_ISA_AVX2 ? 5 : 3);
        for (size_t c = 0; c < b->case_count && done; c++)
            print_case(mgt_isa_name(isas[i]), &b->cases[c]);
        mgt_context_destroy(context);
    }
    printf("\n");
    return done;
}

static bool bench_sizes(bench *b)
{
    bench_scene small, large;
    if (!bench_scene_load(&small, "sunset", b->width, b->height))
        return false;
    if (!bench_scene_load(&large, "sunset", b->large_width, b->large_height))
        return bench_scene_free(&small), false;
    b->case_count = 0;
    static const char *const methods[] = {"none", "podee-pixel", "mangata"};
    for (size_t i = 0; i < 6; i++)
        add_case(b, b->context, i < 3 ? &small.scene : &large.scene, methods[i % 3]);
    const bool done = measure(b, 5);
    if (done) {
        printf("Scene `sunset`, %u threads.\n\n", b->info.threads);
        print_head("size");
        for (size_t i = 0; i < 6; i++) {
            char size[32];
            snprintf(size, sizeof size, "%u × %u", b->cases[i].scene.image.width, b->cases[i].scene.image.height);
            print_case(size, &b->cases[i]);
        }
        printf("\n");
    }
    bench_scene_free(&small);
    bench_scene_free(&large);
    return done;
}

static bool bench_threads(bench *b, const bench_scene *smooth)
{
    mgt_context *one = context_of(b->info.isa, 1);
    const int runs = b->quick ? 1 : 15;
    b->case_count = 0;
    add_case(b, one, &smooth->scene, "mangata");
    add_case(b, b->context, &smooth->scene, "mangata");
    const bool done = one && measure(b, runs);
    if (done) {
        double ratio[RUN_LIMIT];
        for (int i = 0; i < runs; i++)
            ratio[i] = b->cases[0].seconds[i] / b->cases[1].seconds[i];
        const timing t = timing_of(ratio, (size_t)runs);
        printf("## Threads\n\n`mangata`, scene `smooth`, %u × %u: %.2f ms by one thread, %.2f ms by %u; speed-up of frames measured one after the "
               "other, the median of %d pairs.\n\n",
               b->width, b->height, 1e3 * b->cases[0].time.median, 1e3 * b->cases[1].time.median, b->info.threads, runs);
        printf("| figure | measured | least – most | limit | |\n|---|---:|---:|---:|---|\n| speed-up | %.3f | %.2f – %.2f | ≥ 1.85 | %s |\n\n", t.median,
               t.least, t.most, verdict(t.median >= 1.85));
    }
    mgt_context_destroy(one);
    return done;
}

/* Slope of log time over log waves by least squares. */
static double exponent(const double *waves, const double *seconds, int count)
{
    double x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < count; i++) {
        const double u = log(waves[i]), v = log(seconds[i]);
        x += u, y += v, xx += u * u, xy += u * v;
    }
    return (count * xy - x * y) / (count * xx - x * x);
}

static bool bench_growth(bench *b)
{
    enum { STEPS = 5 };
    static const double counts[STEPS] = {16, 64, 256, 512, 2048};
    static const char *const methods[] = {"none", "podee-uniform", "mangata"};
    enum { METHODS = 3 };
    bench_scene scenes[STEPS] = {{0}};
    bool done = true;
    b->case_count = 0;
    for (int i = 0; i < STEPS && done; i++) {
        done = bench_scene_load(&scenes[i], "smooth", b->width, b->height) && bench_scene_extend(&scenes[i], (uint32_t)counts[i]);
        for (int m = 0; m < METHODS && done; m++)
            add_case(b, b->context, &scenes[i].scene, methods[m]);
    }
    if (done && (done = measure(b, 5))) {
        printf("## Growth with the number of waves\n\nThe sea of `smooth` with its spectrum extended to shorter waves: twice the waves are one octave "
               "more, each octave with the same slope variance; %u × %u, %u threads. The exponent is that of the least-squares line of log time "
               "over log waves.\n\n| method |",
               b->width, b->height, b->info.threads);
        for (int i = 0; i < STEPS; i++)
            printf(" %.0f waves, ms |", counts[i]);
        printf(" exponent | limit | |\n|---|---:|---:|---:|---:|---:|---:|---:|---|\n");
        for (int m = 0; m < METHODS; m++) {
            double seconds[STEPS];
            printf("| `%s` |", methods[m]);
            for (int i = 0; i < STEPS; i++) {
                const timing *t = &b->cases[i * METHODS + m].time;
                seconds[i] = t->median;
                printf(" %.1f (%.1f – %.1f) |", 1e3 * t->median, 1e3 * t->least, 1e3 * t->most);
            }
            const double p = exponent(counts, seconds, STEPS);
            printf(" %.2f | %s | %s |\n", p, m == METHODS - 1 ? "≤ 0.6" : "", m == METHODS - 1 ? verdict(p <= 0.6) : "");
        }
        printf("\n");
    }
    for (int i = 0; i < STEPS; i++)
        bench_scene_free(&scenes[i]);
    return done;
}

int main(int argc, char **argv)
{
    bench *b = calloc(1, sizeof *b);
    bench_scene smooth = {0};
    bool done = false;
    if (!b)
        return 1;
    b->quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    b->width = b->quick ? 64 : 1280, b->height = b->quick ? 36 : 720;
    b->large_width = 3 * b->width, b->large_height = 3 * b->height;
    b->context = context_of(MGT_ISA_AUTO, THREADS);
    b->pixels = calloc((size_t)b->large_width * b->large_height * 3, sizeof *b->pixels);
    if (!b->context || !b->pixels || !bench_scene_load(&smooth, "smooth", b->width, b->height))
        goto end;
    b->info.struct_size = sizeof b->info;
    mgt_context_get_info(b->context, &b->info);
    done = bench_methods(b, &smooth) && bench_isas(b, &smooth) && bench_sizes(b) && bench_threads(b, &smooth) && bench_growth(b);
end:
    bench_scene_free(&smooth);
    mgt_context_destroy(b->context);
    free(b->pixels);
    free(b);
    return done ? 0 : 1;
}
