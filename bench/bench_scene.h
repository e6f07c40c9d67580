/* SPDX-License-Identifier: MIT
 * The scenes that are measured. */
#ifndef MANGATA_BENCH_SCENE_H
#define MANGATA_BENCH_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "mangata/mangata.h"
#include "scene/scene_file.h"

/* A scene and what owns its waves. */
typedef struct bench_scene {
    scene_file *file;
    mgt_wave *waves; /* generated ones, or NULL */
    mgt_scene scene; /* frame 0, method mangata */
    char name[64];
} bench_scene;

/* scenes/NAME.json at this size with the sky of the day; 0 × 0 keeps the file's size. Says on stderr what is wrong. */
bool bench_scene_load(bench_scene *out, const char *name, uint32_t width, uint32_t height);

/*
 * The same scene over `count` waves of a spectrum that reaches to shorter waves the more there are: from the longest wave of the file
 * to k_max = k_max(file)·count/count(file), so that twice the waves are one octave more. Every octave has the slope variance that the
 * file's octaves have on average; directions spread over ±80° about +z; ω² = g k.
 */
bool bench_scene_extend(bench_scene *scene, uint32_t count);

void bench_scene_free(bench_scene *scene);

#endif
