/* SPDX-License-Identifier: MIT
 * The scenes that are measured. */
#include "bench_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bool bench_scene_load(bench_scene *out, const char *name, uint32_t width, uint32_t height)
{
    char path[1024], sides[2][32];
    const char *overrides[3] = {"sky.model=atmosphere", sides[0], sides[1]};
    snprintf(path, sizeof path, "%s/scenes/%s.json", MGT_SOURCE_DIR, name);
    snprintf(sides[0], sizeof sides[0], "image.width=%u", (unsigned)width);
    snprintf(sides[1], sizeof sides[1], "image.height=%u", (unsigned)height);
    scene_error error;
    *out = (bench_scene){.file = scene_file_load(path, overrides, width && height ? 3 : 1, &error)};
    if (!out->file || !scene_file_frame(out->file, 0, &out->scene)) {
        fprintf(stderr, "bench: %s\n", out->file ? path : error.text);
        bench_scene_free(out);
        return false;
    }
    out->scene.quality.method = MGT_METHOD_MANGATA;
    snprintf(out->name, sizeof out->name, "%s", name);
    return true;
}

/* A number in [0, 1) for a counter (the finaliser of SplitMix64). */
static double unit(uint64_t x)
{
    x = (x + 1) * 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

bool bench_scene_extend(bench_scene *scene, uint32_t count)
{
    const double pi = 3.14159265358979323846;
    const mgt_water *water = &scene->scene.water;
    double least = INFINITY, most = 0, variance = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double k = hypot(w->kx, w->kz);
        least = fmin(least, k);
        most = fmax(most, k);
        variance += w->amplitude * w->amplitude * k * k / 2;
    }
    mgt_wave *waves = calloc(count, sizeof *waves);
    if (!waves || !(most > least))
        return free(waves), false;
    const double octaves = log2(most / least * count / (double)water->wave_count);
    const double wave_variance = variance / log2(most / least) * octaves / count;
    for (uint32_t i = 0; i < count; i++) {
        const double k = least * exp2(octaves * (i + unit(3 * i)) / count), angle = (unit(3 * i + 1) - 0.5) * 160 * pi / 180;
        waves[i].amplitude = sqrt(2 * wave_variance) / k;
        waves[i].kx = k * sin(angle);
        waves[i].kz = k * cos(angle);
        waves[i].omega = -sqrt(9.81 * k);
        waves[i].phase = 2 * pi * unit(3 * i + 2);
    }
    free(scene->waves);
    scene->waves = waves;
    scene->scene.water.waves = waves;
    scene->scene.water.wave_count = count;
    return true;
}

void bench_scene_free(bench_scene *scene)
{
    free(scene->waves);
    scene_file_free(scene->file);
    *scene = (bench_scene){0};
}
