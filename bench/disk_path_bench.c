/* SPDX-License-Identifier: MIT */
/* Time of the Gaussian-disk-path integral and of sincos, per full vector of lanes, at every width this processor has, on made-up
 * cases. (--quick: once, to see that it works.) */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "disk_path_reference.h"
#include "kernel_probe.h"

enum { COUNT = 4096, ROUNDS = 60 };

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double best_time(const struct kernel_probe *probe, enum probe_function function, int rounds, const float *const *in, float *const *out)
{
    double best = 1e9;
    for (int i = 0; i < rounds; i++) {
        double start = seconds();
        probe->run(function, in, out, COUNT);
        best = fmin(best, seconds() - start);
    }
    return best;
}

/* Neighbouring pixels of a sea: the mean slope drifts from lane to lane, the spread changes slowly. In units of the radius. */
static struct disk_path_case sea_case(uint64_t *state, int i, double spread, double reach)
{
    double drift = i * 0.37, minor = spread * (0.8 + 0.4 * random_unit(state)), major = minor * (1.2 + sin(drift * 0.1));
    struct disk_path_case c = {
        .start = {reach * sin(drift * 0.31) + random_unit(state), reach * cos(drift * 0.17) + random_unit(state)},
        .xx = major * major,
        .xy = 0.2 * minor * major,
        .yy = minor * minor,
        .radius = 1,
    };
    c.end[0] = c.start[0] + 0.6 * spread * (random_unit(state) - 0.3);
    c.end[1] = c.start[1] + 0.6 * spread * (random_unit(state) - 0.3);
    return c;
}

int main(int argc, char **argv)
{
    const int rounds = argc > 1 && strcmp(argv[1], "--quick") == 0 ? 1 : ROUNDS;
    struct kernel_probe probes[MOST_PROBES];
    int widths = kernel_lane_probes(probes);
    float *memory = calloc((size_t)COUNT * (PROBE_INPUTS + PROBE_OUTPUTS), sizeof *memory);
    if (!memory)
        return 1;
    const float *in[PROBE_INPUTS];
    float *out[PROBE_OUTPUTS];
    for (int k = 0; k < PROBE_INPUTS; k++)
        in[k] = memory + (size_t)k * COUNT;
    for (int k = 0; k < PROBE_OUTPUTS; k++)
        out[k] = memory + (size_t)(PROBE_INPUTS + k) * COUNT;

    static const char *const names[] = {"mixed, elongation 1 to 100", "sea, real sun (spread 20 radii)", "sea, large light (spread 1 radius)",
                                        "sea, sharp (spread 0.1 radii)", "out of reach"};
    static const double spreads[] = {0, 20, 1, 0.1, 1}, reaches[] = {0, 30, 1, 0.5, 60};
    for (int set = 0; set < 5; set++) {
        uint64_t state = 7;
        for (int i = 0; i < COUNT; i++) {
            struct disk_path_case c = set == 0 ? random_disk_path_case(&state) : sea_case(&state, i, spreads[set], reaches[set]);
            if (set == 4) {
                c.start[0] += 200;
                c.end[0] += 200;
            }
            const double values[] = {c.start[0], c.start[1], c.end[0], c.end[1], c.xx, c.xy, c.yy, c.radius};
            for (int k = 0; k < 8; k++)
                memory[(size_t)k * COUNT + i] = (float)values[k];
        }
        long before = probes[0].evaluations();
        probes[0].run(PROBE_DISK_PATH, in, out, COUNT);
        printf("disk path, %s: %.2f evaluations a case\n", names[set], (double)(probes[0].evaluations() - before) / COUNT);
        for (int w = 0; w < widths; w++) {
            double time = best_time(&probes[w], PROBE_DISK_PATH, rounds, in, out);
            printf("    %2d lanes: %7.1f ns a vector, %6.2f ns a pixel\n", probes[w].lanes, 1e9 * time * probes[w].lanes / COUNT, 1e9 * time / COUNT);
        }
    }
    for (int i = 0; i < COUNT; i++)
        memory[i] = (float)i * 0.137f;
    for (int w = 0; w < widths; w++) {
        double turns = best_time(&probes[w], PROBE_SINCOS_TURNS, rounds, in, out), radians = best_time(&probes[w], PROBE_SINCOS_REDUCED, rounds, in, out);
        printf("sincos, %2d lanes: turns %.2f, radians %.2f ns a vector, loads and stores of all arrays included\n", probes[w].lanes,
               1e9 * turns * probes[w].lanes / COUNT, 1e9 * radians * probes[w].lanes / COUNT);
    }
    free(memory);
    return 0;
}
