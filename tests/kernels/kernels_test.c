/* SPDX-License-Identifier: MIT */
/*
 * The kernels' functions at every lane width that this processor has: against double precision within the stated bounds, and, with
 * fused multiply-add, against one lane to the bit.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "disk_path_reference.h"
#include "kernel_probe.h"

enum { MAX_COUNT = 1 << 16, CASES = 2000 };

static const double pi = 3.14159265358979323846;

/* Input and output arrays of one run. */
struct arrays {
    float in[PROBE_INPUTS][MAX_COUNT];
    float out[PROBE_OUTPUTS][MAX_COUNT];
};

static void run(const struct kernel_probe *probe, enum probe_function function, struct arrays *a, size_t count)
{
    const float *in[PROBE_INPUTS];
    float *out[PROBE_OUTPUTS];
    for (int k = 0; k < PROBE_INPUTS; k++)
        in[k] = a->in[k];
    for (int k = 0; k < PROBE_OUTPUTS; k++)
        out[k] = a->out[k];
    size_t whole = (count + PROBE_BATCH - 1) / PROBE_BATCH * PROBE_BATCH;
    probe->run(function, in, out, whole);
}

static struct arrays *new_arrays(void)
{
    struct arrays *a = calloc(1, sizeof *a);
    assert_non_null(a);
    return a;
}

/* ---- Elementary functions against double ---- */

static double sin_turns(double x) { return sin(2 * pi * (x - rint(x))); }
static double cos_turns(double x) { return cos(2 * pi * (x - rint(x))); }
static double density(double x) { return exp(-x * x / 2) / sqrt(2 * pi); }
static double distribution(double x) { return erfc(-x / sqrt(2.0)) / 2; }
static double excess(double x) { return x > 0 ? x * distribution(x) + density(x) : density(x) + x * distribution(x); }
static double antiderivative(double x) { return 0.05 * excess(x / (double)0.05f); }

/* error <= absolute + relative |value|; without fused multiply-add the relative part of `plain` applies instead. */
struct bound {
    const char *name;
    enum probe_function function;
    int output;
    double (*exact)(double x);
    double low, high;
    double absolute, relative, plain_absolute, plain_relative;
};

static const struct bound bounds[] = {
    {"sin 2 pi x", PROBE_SINCOS_TURNS, 0, sin_turns, -3, 3, 8e-8, 0, 1.3e-7, 0},
    {"cos 2 pi x", PROBE_SINCOS_TURNS, 1, cos_turns, -3, 3, 1.2e-7, 0, 1.8e-7, 0},
    {"sin 2 pi x", PROBE_SINCOS_TURNS, 0, sin_turns, -1e6, 1e6, 8e-8, 0, 1.3e-7, 0},
    {"cos 2 pi x", PROBE_SINCOS_TURNS, 1, cos_turns, -1e6, 1e6, 1.2e-7, 0, 1.8e-7, 0},
    {"sin 2 pi x of waves", PROBE_SINCOS_WAVE, 0, sin_turns, -3, 3, 1.2e-5, 0, 1.2e-5, 0},
    {"cos 2 pi x of waves", PROBE_SINCOS_WAVE, 1, cos_turns, -3, 3, 3.5e-6, 0, 3.5e-6, 0},
    {"sin 2 pi x of waves", PROBE_SINCOS_WAVE, 0, sin_turns, -1e6, 1e6, 1.2e-5, 0, 1.2e-5, 0},
    {"cos 2 pi x of waves", PROBE_SINCOS_WAVE, 1, cos_turns, -1e6, 1e6, 3.5e-6, 0, 3.5e-6, 0},
    {"sin 2 pi x of searches", PROBE_SINCOS_COARSE, 0, sin_turns, -3, 3, 9.8e-4, 0, 9.8e-4, 0},
    {"cos 2 pi x of searches", PROBE_SINCOS_COARSE, 1, cos_turns, -3, 3, 2.4e-4, 0, 2.4e-4, 0},
    {"sin x", PROBE_SINCOS_REDUCED, 0, sin, -8, 8, 1.4e-7, 0, 2.5e-7, 0},
    {"cos x", PROBE_SINCOS_REDUCED, 1, cos, -8, 8, 1.4e-7, 0, 2.5e-7, 0},
    {"sin x", PROBE_SINCOS_REDUCED, 0, sin, -1000, 1000, 1.4e-7, 0, 2.5e-7, 0},
    {"cos x", PROBE_SINCOS_REDUCED, 1, cos, -1000, 1000, 1.4e-7, 0, 2.5e-7, 0},
    {"sin x", PROBE_SINCOS_REDUCED, 0, sin, -8192, 8192, 1.4e-7, 0, 2.5e-7, 0},
    {"cos x", PROBE_SINCOS_REDUCED, 1, cos, -8192, 8192, 1.4e-7, 0, 2.5e-7, 0},
    {"2^x", PROBE_EXP2, 0, exp2, -126, 127.4, 0, 2.2e-7, 0, 3e-7},
    {"e^x", PROBE_EXP, 0, exp, -87.3, 88.3, 0, 2.5e-7, 0, 6e-6},
    {"e^x", PROBE_EXP, 0, exp, -2, 2, 0, 2.5e-7, 0, 4e-7},
    {"log x", PROBE_LOG, 0, log, 1e-6, 4, 1.5e-7, 1e-7, 3e-7, 2e-7},
    {"log x", PROBE_LOG, 0, log, 1, 1e30, 1.5e-7, 1e-7, 3e-7, 2e-7},
    {"phi", PROBE_NORMAL_PDF, 0, density, -9, 9, 0, 3e-6, 0, 1e-5},
    {"Phi", PROBE_NORMAL_CDF, 0, distribution, -12, 12, 3e-7, 0, 6e-7, 0},
    {"x Phi + phi", PROBE_NORMAL_EXCESS, 0, excess, -12, 12, 2.5e-7, 1e-7, 5e-7, 1e-7},
    {"x Phi + phi", PROBE_NORMAL_EXCESS, 0, excess, -12, -4, 2.5e-8, 0, 3e-8, 0},
    {"E(x, 0.05)", PROBE_CDF_ANTIDERIVATIVE, 0, antiderivative, -1, 1, 1.3e-8, 2e-7, 2.5e-8, 2e-7},
};

static void test_bounds(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    for (int w = 0; w < widths; w++)
        for (size_t b = 0; b < sizeof bounds / sizeof bounds[0]; b++) {
            const struct bound *bound = &bounds[b];
            double absolute = probes[w].fused ? bound->absolute : bound->plain_absolute;
            double relative = probes[w].fused ? bound->relative : bound->plain_relative;
            double worst = 0, worst_absolute = 0, worst_relative = 0, where = 0;
            uint64_t seed = 1 + b;
            for (int i = 0; i < MAX_COUNT; i++) {
                double t = (i + random_unit(&seed)) / MAX_COUNT;
                a->in[0][i] = (float)(bound->low + (bound->high - bound->low) * t);
                a->in[1][i] = 0.05f;
            }
            run(&probes[w], bound->function, a, MAX_COUNT);
            for (int i = 0; i < MAX_COUNT; i++) {
                double exact = bound->exact((double)a->in[0][i]);
                double error = fabs(a->out[bound->output][i] - exact);
                double share = error / (absolute + relative * fabs(exact));
                worst_absolute = fmax(worst_absolute, error);
                worst_relative = fmax(worst_relative, error / fabs(exact));
                if (!(share <= worst)) {
                    worst = share;
                    where = a->in[0][i];
                }
            }
            if (w >= widths - 2 || !(worst <= 1))
                printf("%-9s %-19s [%g, %g]: absolute %.2e  relative %.2e  (%.2f of the bound, at %.9g)\n", probes[w].name, bound->name, bound->low,
                       bound->high, worst_absolute, worst_relative, worst, where);
            assert_true(worst <= 1);
        }
    free(a);
}

static void test_saturation(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    const float extremes[] = {-3e38f, -1e10f, -200, -127, 200, 1e10f, 3e38f, 0};
    for (int w = 0; w < widths; w++) {
        const enum probe_function functions[] = {PROBE_EXP, PROBE_EXP2, PROBE_LOG, PROBE_NORMAL_CDF, PROBE_NORMAL_PDF, PROBE_NORMAL_EXCESS};
        for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
            for (int i = 0; i < PROBE_BATCH; i++)
                a->in[0][i] = extremes[i % 8];
            run(&probes[w], functions[f], a, PROBE_BATCH);
            for (int i = 0; i < PROBE_BATCH; i++)
                assert_true(isfinite(a->out[0][i]));
        }
        run(&probes[w], PROBE_NORMAL_CDF, a, PROBE_BATCH);
        assert_true(a->out[0][0] >= 0 && a->out[0][0] < 2e-8f && a->out[0][6] <= 1 && a->out[0][6] > 1 - 1e-6f);
    }
    free(a);
}

/* ---- The words of the dialect ---- */

static void test_words(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    const float special[] = {0.0f,         -0.0f,      0.5f,        -0.5f,      1.5f,  2.5f,   -2.5f,  0.49999997f,
                             -0.49999997f, 8388607.5f, -8388607.5f, 8388609.0f, 1e30f, -1e30f, 1e-40f, -1.0f};
    uint64_t seed = 5;
    int count = 4096;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 6; k++)
            a->in[k][i] = k == 0 && i < 16 ? special[i] : (float)((random_unit(&seed) - 0.5) * pow(10, 6 * random_unit(&seed)));
    for (int i = 0; i < count; i++)
        a->in[1][i] = i % 5 ? (float)(250 * random_unit(&seed) - 125) : a->in[0][i] + 1;
    for (int w = 0; w < widths; w++) {
        run(&probes[w], PROBE_ROUNDING, a, count);
        for (int i = 0; i < count; i++) {
            float x = a->in[0][i], expected[3] = {rintf(x), floorf(x), fabsf(x)};
            for (int k = 0; k < 3; k++)
                assert_true(probes[w].exact ? memcmp(&a->out[k][i], &expected[k], sizeof(float)) == 0 : fabsf(a->out[k][i] - expected[k]) < 1e-37f);
        }
        run(&probes[w], PROBE_MINMAX, a, count);
        for (int i = 0; i < count; i++) {
            float x = a->in[0][i], y = a->in[1][i];
            assert_true(a->out[0][i] == fminf(x, y) && a->out[1][i] == fmaxf(x, y));
            assert_true(a->out[2][i] == fminf(fmaxf(x, -1), 1));
        }
        run(&probes[w], PROBE_SELECT, a, count);
        for (int i = 0; i < count; i++) {
            float x = a->in[0][i], y = a->in[1][i];
            assert_true(a->out[0][i] == (x < y ? x : y));
            assert_true(a->out[1][i] == (((x < y && !(x < 0)) || y > 1) ? 1.0f : 0.0f));
            int any = 0, all = 1, lanes = probes[w].lanes, from = i / lanes * lanes;
            for (int k = from; k < from + lanes; k++) {
                any |= a->in[0][k] < a->in[1][k];
                all &= a->in[0][k] < a->in[1][k];
            }
            assert_true(a->out[2][i] == (float)(any + 2 * all));
        }
        run(&probes[w], PROBE_PRODUCT_ERROR, a, count);
        for (int i = 0; i < count; i++) {
            double exact = (double)a->in[0][i] * (double)a->in[1][i], sum = (double)a->out[0][i] + (double)a->out[1][i];
            assert_true(fabs(sum - exact) <= (probes[w].fused ? 1e-14 : 6e-8) * fabs(exact) + 1e-37);
        }
        run(&probes[w], PROBE_CROSS, a, count);
        for (int i = 0; i < count; i++) {
            double u[3], v[3];
            for (int k = 0; k < 3; k++) {
                u[k] = a->in[k][i];
                v[k] = a->in[3 + k][i];
            }
            for (int k = 0; k < 3; k++) {
                double left = u[(k + 1) % 3] * v[(k + 2) % 3], right = u[(k + 2) % 3] * v[(k + 1) % 3];
                assert_true(fabs(a->out[k][i] - (left - right)) <= 1.3e-7 * (fabs(left) + fabs(right)) + 1e-30);
            }
        }
        run(&probes[w], PROBE_VECTOR, a, count);
        for (int i = 16; i < count; i++) {
            double x[6];
            for (int k = 0; k < 6; k++)
                x[k] = a->in[k][i];
            double size = fabs(x[0] * x[3]) + fabs(x[1] * x[4]) + fabs(x[2] * x[5]);
            assert_true(fabs(a->out[0][i] - (x[0] * x[3] + x[1] * x[4] + x[2] * x[5])) <= 2.5e-7 * size);
            double squares = pow(x[0] + 2 * x[2], 2) + pow(x[1] + 2 * x[3], 2);
            assert_true(fabs(a->out[1][i] - squares) <= 3e-7 * (squares + x[0] * x[0] + x[2] * x[2] + x[1] * x[1] + x[3] * x[3]));
            assert_true(a->out[1][i] == a->out[2][i]);
        }
        run(&probes[w], PROBE_NORMALIZE, a, count);
        for (int i = 16; i < count; i++) {
            double length = 0;
            for (int k = 0; k < 3; k++)
                length += (double)a->in[k][i] * a->in[k][i];
            for (int k = 0; k < 3; k++)
                assert_true(fabs(a->out[k][i] - a->in[k][i] / sqrt(length)) <= 4e-7);
        }
        for (int i = 0; i < count; i++)
            a->in[0][i] = fabsf(a->in[0][i]) + 1e-30f;
        run(&probes[w], PROBE_EXPONENT, a, count);
        for (int i = 0; i < count; i++) {
            int exponent;
            float mantissa = frexpf(a->in[0][i], &exponent) * 2;
            if (fabsf(a->in[1][i]) <= 126)
                assert_true(a->out[0][i] == exp2f(rintf(a->in[1][i])));
            assert_true(a->out[1][i] == (float)(exponent - 1) && a->out[2][i] == mantissa);
        }
    }
    free(a);
}

/* ---- The same bits at every width ---- */

static void random_inputs(struct arrays *a, enum probe_function function, int count)
{
    uint64_t seed = 100 + function;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < PROBE_INPUTS; k++)
            a->in[k][i] = (float)((random_unit(&seed) - 0.5) * pow(10, 8 * random_unit(&seed) - 4));
        if (function == PROBE_LOG || function == PROBE_EXPONENT)
            a->in[0][i] = fabsf(a->in[0][i]) + 1e-20f;
        if (function == PROBE_EXPONENT)
            a->in[1][i] = (float)(250 * random_unit(&seed) - 125);
        if (function == PROBE_CDF_ANTIDERIVATIVE)
            a->in[1][i] = fabsf(a->in[1][i]);
        if (function == PROBE_DISK_PATH && i % 4) {
            struct disk_path_case c = random_disk_path_case(&seed);
            double size = i % 2 ? 1 : 0.0046;
            const double values[] = {c.start[0] * size,  c.start[1] * size,  c.end[0] * size,    c.end[1] * size,
                                     c.xx * size * size, c.xy * size * size, c.yy * size * size, size};
            for (int k = 0; k < 8; k++)
                a->in[k][i] = (float)values[k];
        }
    }
}

static void test_same_bits(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes), compared = 0;
    struct arrays *a = new_arrays();
    float *one_lane = malloc(sizeof a->out);
    assert_non_null(one_lane);
    for (int function = 0; function < PROBE_COUNT; function++) {
        int count = 16384;
        random_inputs(a, function, count);
        run(&probes[0], function, a, count);
        memcpy(one_lane, a->out, sizeof a->out);
        for (int w = 1; w < widths; w++) {
            if (!probes[w].exact)
                continue;
            memset(a->out, 0, sizeof a->out);
            run(&probes[w], function, a, count);
            for (int k = 0; k < (function == PROBE_SELECT ? 2 : PROBE_OUTPUTS); k++)
                assert_memory_equal(a->out[k], one_lane + (size_t)k * MAX_COUNT, count * sizeof(float));
            compared++;
        }
    }
    printf("%d functions, %d comparisons to the bit\n", PROBE_COUNT, compared);
    free(one_lane);
    free(a);
}

/* The bits do not depend on the compiler either. Inputs are made without rounding, lest a mathematics library change them. */
static void test_known_bits(void **state)
{
    (void)state;
    static const uint64_t expected = 0xa19983210717693fu;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    for (int w = 0; w < widths; w++) {
        if (!probes[w].exact)
            continue;
        uint64_t hash = 0xcbf29ce484222325u, seed = 12; /* FNV-1a */
        for (int function = 0; function <= PROBE_ARC_SHARE; function++) {
            int count = 4096;
            for (int i = 0; i < count; i++)
                for (int k = 0; k < PROBE_INPUTS; k++) {
                    int whole = (int)(4096 * random_unit(&seed)) - (k < 4 ? 2048 : 0);
                    a->in[k][i] = ldexpf((float)whole, -11 + (k < 4 ? i % 4 : 0));
                }
            run(&probes[w], function, a, count);
            for (int k = 0; k < 2; k++)
                for (int i = 0; i < count; i++) {
                    uint32_t bits;
                    memcpy(&bits, &a->out[k][i], sizeof bits);
                    hash = (hash ^ bits) * 0x100000001b3u;
                }
        }
        if (hash != expected)
            print_error("%s: hash 0x%016llx\n", probes[w].name, (unsigned long long)hash);
        assert_true(hash == expected);
    }
    free(a);
}

/* A lane's value does not depend on its neighbours: alone among paths out of reach it is what it is among its like. */
static void test_lanes_are_independent(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    int count = 512;
    float together[512];
    for (int w = 0; w < widths; w++) {
        random_inputs(a, PROBE_DISK_PATH, count);
        run(&probes[w], PROBE_DISK_PATH, a, count);
        memcpy(together, a->out[0], sizeof together);
        for (int lane = 0; lane < PROBE_BATCH; lane++) {
            random_inputs(a, PROBE_DISK_PATH, count);
            for (int i = 0; i < count; i++)
                if (i % PROBE_BATCH != lane)
                    a->in[0][i] = a->in[2][i] = 1e7f;
            run(&probes[w], PROBE_DISK_PATH, a, count);
            for (int i = lane; i < count; i += PROBE_BATCH)
                assert_memory_equal(&a->out[0][i], &together[i], sizeof(float));
        }
    }
    free(a);
}

/* ---- The disk-path integral ---- */

static void set_case(struct arrays *a, int i, const struct disk_path_case *c)
{
    const double values[] = {c->start[0], c->start[1], c->end[0], c->end[1], c->xx, c->xy, c->yy, c->radius};
    for (int k = 0; k < 8; k++)
        a->in[k][i] = (float)values[k];
}

static void test_disk_path_reference(void **state)
{
    (void)state;
    uint64_t seed = 77;
    double worst = 0;
    for (int i = 0; i < 40; i++) {
        struct disk_path_case c = random_disk_path_case(&seed);
        double minor = sqrt(0.5 * (c.xx + c.yy) - hypot(0.5 * (c.xx - c.yy), c.xy));
        int steps = (int)fmin(400, fmax(60, 12 * hypot(c.end[0] - c.start[0], c.end[1] - c.start[1]) / minor));
        worst = fmax(worst, fabs(disk_path_by_steps(&c, steps, 300) - disk_path_by_chords(&c, 3000)));
    }
    printf("reference: chords against steps, largest difference %.2e\n", worst);
    assert_true(worst < 1e-4);
}

static void test_disk_path_cases(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    static double exact[CASES];
    uint64_t seed = 2024;
    for (int i = 0; i < CASES; i++) {
        struct disk_path_case c = random_disk_path_case(&seed);
        set_case(a, i, &c);
        exact[i] = disk_path_by_chords(&c, 2500);
    }
    for (int w = 0; w < widths; w++) {
        long before = probes[w].evaluations();
        run(&probes[w], PROBE_DISK_PATH, a, CASES);
        double evaluations = (double)(probes[w].evaluations() - before) / CASES;
        double squares = 0, worst = 0;
        for (int i = 0; i < CASES; i++) {
            double error = fabs(a->out[0][i] - exact[i]);
            squares += error * error;
            worst = !(error <= worst) ? error : worst;
        }
        printf("disk path, %-9s %d cases: rms %.2e, largest %.2e", probes[w].name, CASES, sqrt(squares / CASES), worst);
        printf(evaluations > 0 ? ", mean evaluations %.2f\n" : "\n", evaluations);
        assert_true(sqrt(squares / CASES) <= 2.5e-4 && worst <= 1e-2 && evaluations <= 7);
    }
    free(a);
}

/* Small lights matter although their share is small: their radiance makes up for it. */
static void test_disk_path_small_lights(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    static double exact[CASES];
    uint64_t seed = 31;
    for (int i = 0; i < CASES; i++) {
        struct disk_path_case c = random_disk_path_case(&seed);
        double size = pow(10, -0.5 - 2.5 * random_unit(&seed));
        double elongation = 1 + 5 * random_unit(&seed), minor = 1;
        double cosine = c.start[0] / hypot(c.start[0], c.start[1]), sine = c.start[1] / hypot(c.start[0], c.start[1]);
        c.xx = (float)(minor * (elongation * cosine * cosine + sine * sine));
        c.yy = (float)(minor * (elongation * sine * sine + cosine * cosine));
        c.xy = (float)(minor * (elongation - 1) * sine * cosine);
        c.radius = (float)size;
        set_case(a, i, &c);
        exact[i] = disk_path_by_chords(&c, 1000);
    }
    for (int w = 0; w < widths; w++) {
        run(&probes[w], PROBE_DISK_PATH, a, CASES);
        double worst = 0, sum = 0;
        int counted = 0;
        for (int i = 0; i < CASES; i++) {
            double density_scale = a->in[7][i] * (double)a->in[7][i] / 2;
            if (exact[i] < 1e-2 * density_scale)
                continue;
            double error = fabs(a->out[0][i] / exact[i] - 1);
            worst = fmax(worst, error);
            sum += error;
            counted++;
        }
        if (w == widths - 1)
            printf("disk path, small lights: relative error mean %.2e, largest %.2e of %d\n", sum / counted, worst, counted);
        assert_true(counted > CASES / 3 && sum / counted < 5e-4 && worst < 2e-2);
    }
    free(a);
}

/* Limits that are known: name, input, lowest and highest answer. */
static void test_disk_path_limits(void **state)
{
    (void)state;
    static const struct {
        float in[8];
        double low, high;
    } limits[] = {
        {{0, 0, 0, 0, 0, 0, 0, 1}, 1 - 1e-4, 1},                    /* a point inside */
        {{2, 0, 2, 0, 0, 0, 0, 1}, 0, 0},                           /* a point outside */
        {{0.9f, 0, 0.9f, 0, 0, 0, 0, 1}, 1 - 1e-4, 1},              /* a point near the edge */
        {{-2, 0, 2, 0, 0, 0, 0, 1}, 0.495, 0.505},                  /* a diameter of a path twice as long */
        {{-2, 0.6f, 2, 0.6f, 0, 0, 0, 1}, 0.395, 0.405},            /* a chord of it */
        {{-2, 1.1f, 2, 1.1f, 0, 0, 0, 1}, 0, 0},                    /* past it */
        {{0, 0, 0.5f, 0, 0, 0, 0, 1}, 1 - 1e-4, 1},                 /* wholly inside */
        {{0, 0, 0, 0, 1, 0, 1, 1}, 0.39347 - 2e-4, 0.39347 + 2e-4}, /* 1 - exp(-1/2) */
        {{0, 0, 0, 0, 1, 0, 1, 3}, 0.98889 - 2e-4, 0.98889 + 2e-4}, /* 1 - exp(-9/2) */
        {{0, 0, 0, 0, 1, 0, 0, 1}, 0.68269 - 1e-3, 0.68269 + 1e-3}, /* rank 1: within one deviation */
        {{0, 0, 0, 0, 1, 1, 1, 1}, 0.52050 - 1e-3, 0.52050 + 1e-3}, /* rank 1, diagonal, deviation sqrt 2 */
        {{0, 0, 0, 0, 4, 0, 4, 1e-3f}, 1.248e-7, 1.251e-7},         /* R^2 / (2 sigma^2) */
        {{0, 0, 0, 0, 1e-2f, 0, 1e-2f, 1e10f}, 1 - 1e-4, 1},        /* a disk without end */
        {{0, 0, 0, 0, 1, 0, 1, 0}, 0, 0},                           /* no disk */
        {{50, 0, 60, 0, 1, 0, 1, 1}, 0, 0},                         /* out of reach */
        {{1e30f, 1e30f, -1e30f, 1e20f, 1, 0, 1, 1}, 0, 1e-6},
        {{8, 0, 9, 0, 1, 0, 1, 1}, 0, 0}, /* six deviations and more */
    };
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes), count = sizeof limits / sizeof limits[0];
    struct arrays *a = new_arrays();
    for (int w = 0; w < widths; w++) {
        for (int i = 0; i < count; i++)
            for (int k = 0; k < 8; k++)
                a->in[k][i] = limits[i].in[k];
        run(&probes[w], PROBE_DISK_PATH, a, count);
        for (int i = 0; i < count; i++) {
            if (!(a->out[0][i] >= limits[i].low && a->out[0][i] <= limits[i].high))
                print_error("%s, limit %d: %.9g\n", probes[w].name, i, a->out[0][i]);
            assert_true(a->out[0][i] >= limits[i].low && a->out[0][i] <= limits[i].high);
        }
    }
    free(a);
}

/* Any finite input, sensible or not, gives a number from 0 to 1. */
static void test_any_finite_input(void **state)
{
    (void)state;
    const float values[] = {0, -0.0f, 1, -1, 0.3f, -2.5f, 1e-10f, 1e-30f, 1e-42f, 1e4f, -1e7f, 1e15f, 1e25f, -3e38f, 3e38f, 0.00465f};
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    uint64_t seed = 9;
    for (int function = PROBE_DISK_PATH; function <= PROBE_ARC_SHARE; function++)
        for (int w = 0; w < widths; w++)
            for (int round = 0; round < 3; round++) {
                for (int i = 0; i < MAX_COUNT; i++) {
                    int kinds = 2 + (int)(15 * random_unit(&seed)); /* often few different values, so that they meet */
                    for (int k = 0; k < PROBE_INPUTS; k++)
                        a->in[k][i] = values[(int)(kinds * random_unit(&seed)) % 16];
                }
                run(&probes[w], function, a, MAX_COUNT);
                for (int i = 0; i < MAX_COUNT; i++) {
                    if (!(a->out[0][i] >= 0 && a->out[0][i] <= 1))
                        print_error("%s: f(%g %g  %g %g  %g %g %g  %g) = %g\n", probes[w].name, a->in[0][i], a->in[1][i], a->in[2][i], a->in[3][i], a->in[4][i],
                                    a->in[5][i], a->in[6][i], a->in[7][i], a->out[0][i]);
                    assert_true(a->out[0][i] >= 0 && a->out[0][i] <= 1);
                }
            }
    free(a);
}

/* ---- The arc ---- */

static double angle_between(const double *p, const double *q)
{
    double cx = p[1] - q[1], cy = q[0] - p[0], cz = p[0] * q[1] - p[1] * q[0];
    return atan2(sqrt(cx * cx + cy * cy + cz * cz), p[0] * q[0] + p[1] * q[1] + 1);
}

static void point_on(const double *p, const double *q, double t, double *point)
{
    for (int k = 0; k < 2; k++)
        point[k] = p[k] + t * (q[k] - p[k]);
}

static int lit_at(const double *p, const double *q, double t, double radius)
{
    double point[2];
    point_on(p, q, t, point);
    return hypot(point[0], point[1]) < radius;
}

/* The lit part found by walking, so that it shares no formula with the kernel; its ends by bisection. */
static double arc_share(const double *p, const double *q, double radius)
{
    enum { STEPS = 1000 };
    double lit = 0;
    for (int i = 0; i < STEPS; i++) {
        double low = (double)i / STEPS, high = (double)(i + 1) / STEPS, from[2], to[2];
        int starts = lit_at(p, q, low, radius), ends = lit_at(p, q, high, radius);
        if (!starts && !ends)
            continue;
        double in = starts ? low : high, out = starts ? high : low;
        for (int k = 0; k < 40 && starts != ends; k++) {
            double middle = (in + out) / 2;
            *(lit_at(p, q, middle, radius) ? &in : &out) = middle;
        }
        point_on(p, q, starts ? low : in, from);
        point_on(p, q, ends ? high : in, to);
        lit += angle_between(from, to);
    }
    return lit / angle_between(p, q);
}

static void test_arc_share(void **state)
{
    (void)state;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_probes(probes);
    struct arrays *a = new_arrays();
    static double exact[CASES];
    uint64_t seed = 4;
    for (int i = 0; i < CASES; i++) {
        double radius = pow(10, -3 + 3 * random_unit(&seed)), p[2], q[2];
        double length = radius * pow(10, -3 + 4.5 * random_unit(&seed)), heading = 2 * pi * random_unit(&seed);
        p[0] = (float)(radius * 3 * (random_unit(&seed) - 0.5));
        p[1] = (float)(radius * 3 * (random_unit(&seed) - 0.5));
        q[0] = (float)(p[0] + length * cos(heading));
        q[1] = (float)(p[1] + length * sin(heading));
        const double in[] = {p[0], p[1], q[0], q[1], (float)radius};
        for (int k = 0; k < 5; k++)
            a->in[k][i] = (float)in[k];
        exact[i] = arc_share(p, q, (float)radius);
    }
    for (int w = 0; w < widths; w++) {
        run(&probes[w], PROBE_ARC_SHARE, a, CASES);
        double worst = 0, sum = 0;
        for (int i = 0; i < CASES; i++) {
            double error = fabs(a->out[0][i] - exact[i]);
            worst = fmax(worst, error);
            sum += error;
        }
        if (w == widths - 1 || worst > 2e-3)
            printf("arc share: error mean %.2e, largest %.2e\n", sum / CASES, worst);
        assert_true(sum / CASES < 1e-4 && worst < 2e-3);
    }
    for (int w = 0; w < widths; w++) {
        const float points[4][6] = {{0.1f, 0, 0.1f, 0, 1, 1}, {2, 0, 2, 0, 1, 0}, {-4, 0, 4, 0, 1, 0.592f}, {3, 1, 3, 2, 1, 0}};
        for (int i = 0; i < PROBE_BATCH; i++)
            for (int k = 0; k < 5; k++)
                a->in[k][i] = points[i % 4][k];
        run(&probes[w], PROBE_ARC_SHARE, a, PROBE_BATCH);
        for (int i = 0; i < PROBE_BATCH; i++) /* 2 atan 1 / 2 atan 4 = 0.59236 */
            assert_true(fabsf(a->out[0][i] - points[i % 4][5]) < 5e-4f);
    }
    free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_saturation),
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_known_bits),
        cmocka_unit_test(test_lanes_are_independent),
        cmocka_unit_test(test_disk_path_reference),
        cmocka_unit_test(test_disk_path_cases),
        cmocka_unit_test(test_disk_path_small_lights),
        cmocka_unit_test(test_disk_path_limits),
        cmocka_unit_test(test_any_finite_input),
        cmocka_unit_test(test_arc_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
