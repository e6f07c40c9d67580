/* SPDX-License-Identifier: MIT
 * Time of questions about the water: a million points up to 10 km out, 64 waves, one thread; what is asked takes turns. And of the five points of a boat.
 *
 *   query_bench [--quick] */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fma_peak.h"
#include "mangata/mangata.h"
#include "timing.h"

enum { WAVES = 64, QUESTIONS = 7, CHOPPY = 4, ROUNDS = 15, FEW = 5 };

/* A point and wave of single precision: phase in double 7, sine and cosine 27, three sums 6. */
static const double flops = 40;

static double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static mgt_water sea(mgt_wave waves[WAVES])
{
    uint64_t state = 5;
    for (int i = 0; i < WAVES; i++) {
        const double k = 0.03 * pow(400, random_unit(&state)), heading = 6.2831853 * random_unit(&state);
        waves[i] = (mgt_wave){.amplitude = 0.03 / k, .kx = k * cos(heading), .kz = k * sin(heading), .omega = sqrt(9.81 * k)};
    }
    return (mgt_water){.waves = waves, .wave_count = WAVES, .index_of_refraction = 1.333};
}

static double ask(const mgt_water *water, const double *points, size_t count, mgt_water_answers *answers)
{
    const double start = seconds_now();
    if (mgt_water_query(water, 12.5, points, count, answers) != MGT_OK)
        exit(1);
    return seconds_now() - start;
}

static double peak_of_one_core(bool quick)
{
    const double seconds = quick ? 0.001 : 0.2;
#if defined(__x86_64__)
    if (mgt_isa_available(MGT_ISA_AVX512))
        return fma_peak(fma_rounds_16, 16, 1, seconds);
    if (mgt_isa_available(MGT_ISA_AVX2))
        return fma_peak(fma_rounds_8, 8, 1, seconds);
#endif
    return fma_peak(fma_rounds_4, 4, 1, seconds);
}

int main(int count, char **arguments)
{
    const bool quick = count > 1 && strcmp(arguments[1], "--quick") == 0;
    const size_t n = quick ? 1000 : 1000000;
    const int rounds = quick ? 1 : ROUNDS;
    static const char *const names[QUESTIONS] = {"height and normal",
                                                 "height alone",
                                                 "height, normal, velocity",
                                                 "the same, exact",
                                                 "choppy: height and normal",
                                                 "choppy: all, exact",
                                                 "choppy as far as it folds: height and normal"};
    double *points = malloc(2 * n * sizeof *points), *height = malloc(n * sizeof *height);
    float *normal = malloc(3 * n * sizeof *normal), *velocity = malloc(3 * n * sizeof *velocity);
    if (!points || !height || !normal || !velocity)
        return 1;
    mgt_wave waves[WAVES];
    const mgt_water water = sea(waves);
    mgt_water waters[QUESTIONS];
    for (int q = 0; q < QUESTIONS; q++) {
        waters[q] = water;
        waters[q].choppiness = q < CHOPPY ? 0 : q + 1 < QUESTIONS ? 0.7f : 1;
    }
    uint64_t state = 3;
    for (size_t i = 0; i < 2 * n; i++)
        points[i] = 2e4 * random_unit(&state) - 1e4;
    mgt_water_answers asked[QUESTIONS];
    for (int q = 0; q < QUESTIONS; q++) {
        mgt_water_answers_init(&asked[q], sizeof *asked);
        asked[q].height = height;
        asked[q].normal = q == 1 ? NULL : normal;
        asked[q].velocity = q == 2 || q == 3 || q == 5 ? velocity : NULL;
        asked[q].exact = q == 3 || q == 5;
    }
    double samples[QUESTIONS][ROUNDS], few[ROUNDS];
    for (int round = -1; round < rounds; round++) /* the first to warm up */
        for (int q = 0; q < QUESTIONS; q++)
            samples[q][round < 0 ? 0 : round] = ask(&waters[q], points, n, &asked[q]);
    for (int round = 0; round < rounds; round++) {
        few[round] = 0;
        for (int i = 0; i < 100; i++)
            few[round] += ask(&water, points, FEW, &asked[2]) / 100;
    }
    const double peak = peak_of_one_core(quick);
    printf("## Questions about the water\n\n%zu points up to 10 km from the origin, %d waves, one thread; the peak of its fma is %.1f GFLOP/s.\n\n", n, WAVES,
           1e-9 * peak);
    printf("| asked | ms, median (least, most) | ns a point | GFLOP/s | of the peak |\n|---|---:|---:|---:|---:|\n");
    for (int q = 0; q < QUESTIONS; q++) {
        const timing t = timing_of(samples[q], (size_t)rounds);
        printf("| %s | %.1f (%.1f, %.1f) | %.1f |", names[q], 1e3 * t.median, 1e3 * t.least, 1e3 * t.most, 1e9 * t.median / (double)n);
        const double rate = flops * WAVES * (double)n / t.median;
        if (q < 2)
            printf(" %.1f | %.0f%% |\n", 1e-9 * rate, 100 * rate / peak);
        else
            printf(" | |\n");
    }
    const timing t = timing_of(few, (size_t)rounds);
    printf("\n%d points, all that there is: %.1f µs a call (%.1f, %.1f).\n", FEW, 1e6 * t.median, 1e6 * t.least, 1e6 * t.most);
    free(velocity);
    free(normal);
    free(height);
    free(points);
    return 0;
}
