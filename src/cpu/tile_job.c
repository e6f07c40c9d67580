/* SPDX-License-Identifier: MIT
 * One tile of a frame by any method, into the worker's own planes. */
#include "cpu/tile_job.h"

#include <math.h>
#include <string.h>

/* A uniform number in [0, 1) for a counter; the finaliser of SplitMix64 applied twice. */
static uint64_t mix(uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static float unit(uint64_t bits)
{
    return (float)(bits >> 40) * 0x1p-24f;
}

static void build(const frame *f, const lane_kernels *kernels, const camera_rays *camera, interval time, bool filter, uint32_t tile_x,
                  uint32_t tile_y, tile_waves *waves, tile_guess *guess)
{
    tile_build(f, camera, time, filter, tile_x, tile_y, waves);
    if (tile_sees_water(waves))
        kernels->guess(&f->data, waves, guess);
    else
        memset(guess, 0, sizeof *guess);
}

/* ---- point samples ---- */

static camera_rays camera_at(const frame *f, double share)
{
    const mgt_scene *s = f->scene;
    if (!s->camera_moves)
        return f->close;
    mgt_camera camera = s->camera;
    for (int i = 0; i < 3; i++) {
        camera.position[i] = s->camera_open.position[i] + share * (s->camera.position[i] - s->camera_open.position[i]);
        camera.target[i] = s->camera_open.target[i] + share * (s->camera.target[i] - s->camera_open.target[i]);
        camera.up[i] = s->camera_open.up[i] + share * (s->camera.up[i] - s->camera_open.up[i]);
    }
    camera.fov_y_deg = s->camera_open.fov_y_deg + share * (s->camera.fov_y_deg - s->camera_open.fov_y_deg);
    return camera_rays_of(&camera, s->image.width, s->image.height);
}

/* A jittered place in stratum `index` of n × n for every pixel of the tile. */
static void jitter(uint64_t seed, uint32_t tile_x, uint32_t tile_y, uint32_t n, uint64_t index, uint64_t sample, tile_scratch *scratch)
{
    const float column = (float)(index % n), row = (float)(index / n), size = 1.0f / (float)n;
    const uint64_t key = mix(seed ^ mix(sample));
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint64_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH;
        const uint64_t bits = mix(key ^ (x << 32 | y));
        scratch->jitter_x[i] = (column + unit(bits)) * size - 0.5f;
        scratch->jitter_y[i] = (row + unit(mix(bits))) * size - 0.5f;
    }
}

static void render_samples(const frame *f, const lane_kernels *kernels, const float *sky, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch)
{
    const mgt_quality *q = &f->scene->quality;
    const uint64_t per_time = (uint64_t)q->spatial_samples * q->spatial_samples;
    const uint64_t first = q->sample_first;
    const uint64_t count = q->sample_count ? q->sample_count : per_time * q->time_samples - first;
    const float weight = 1.0f / (float)count;
    memset(&scratch->pixels, 0, sizeof scratch->pixels);
    for (uint64_t sample = first; sample < first + count;) {
        const uint64_t m = sample / per_time, end = (m + 1) * per_time < first + count ? (m + 1) * per_time : first + count;
        const double share = q->time_samples == 1 ? 1 : ((double)m + (double)unit(mix(q->seed ^ mix(~m)))) / q->time_samples;
        const interval time = {f->scene->time - (1 - share) * f->scene->shutter, 0};
        const camera_rays camera = camera_at(f, share);
        build(f, kernels, &camera, time, false, tile_x, tile_y, &scratch->close, &scratch->close_guess);
        for (; sample < end; sample++) {
            jitter(q->seed, tile_x, tile_y, q->spatial_samples, sample % per_time, sample, scratch);
            kernels->sample(&f->data, sky, &scratch->close, &scratch->close_guess, scratch->jitter_x, scratch->jitter_y, weight, &scratch->pixels);
        }
    }
}

static void render_centre(const frame *f, const lane_kernels *kernels, const float *sky, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch)
{
    build(f, kernels, &f->close, (interval){f->scene->time, 0}, false, tile_x, tile_y, &scratch->close, &scratch->close_guess);
    memset(&scratch->pixels, 0, sizeof scratch->pixels);
    kernels->sample(&f->data, sky, &scratch->close, &scratch->close_guess, NULL, NULL, 1, &scratch->pixels);
}

/* ---- filtered methods ---- */

static void render_filtered(const frame *f, const lane_kernels *kernels, const float *sky, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch)
{
    const mgt_scene *s = f->scene;
    if (!s->camera_moves) {
        const interval shutter = {s->time - s->shutter / 2, s->shutter / 2};
        build(f, kernels, &f->close, shutter, true, tile_x, tile_y, &scratch->close, &scratch->close_guess);
        kernels->filtered(&f->data, sky, s->quality.method, &scratch->close, &scratch->close_guess, NULL, NULL, &scratch->pixels);
        return;
    }
    build(f, kernels, &f->close, (interval){s->time, 0}, true, tile_x, tile_y, &scratch->close, &scratch->close_guess);
    build(f, kernels, &f->open, (interval){s->time - s->shutter, 0}, true, tile_x, tile_y, &scratch->open, &scratch->open_guess);
    kernels->filtered(&f->data, sky, s->quality.method, &scratch->close, &scratch->close_guess, &scratch->open, &scratch->open_guess,
                      &scratch->pixels);
}

static bool is_filtered(mgt_method method)
{
    return method == MGT_METHOD_MANGATA || method == MGT_METHOD_PODEE_UNIFORM || method == MGT_METHOD_PODEE_PIXEL;
}

void tile_render(const frame *f, const lane_kernels *kernels, const float *sky, tile_wants wants, uint32_t tile_x, uint32_t tile_y, tile_scratch *scratch)
{
    const mgt_quality *q = &f->scene->quality;
    if (wants.pixels && is_filtered(q->method))
        render_filtered(f, kernels, sky, tile_x, tile_y, scratch);
    else if (wants.pixels && q->method == MGT_METHOD_SSAA)
        render_samples(f, kernels, sky, tile_x, tile_y, scratch);
    else if (wants.pixels)
        render_centre(f, kernels, sky, tile_x, tile_y, scratch);
    if (!wants.surface)
        return;
    const interval now = {f->scene->time, 0};
    build(f, kernels, &f->close, now, false, tile_x, tile_y, &scratch->close, &scratch->close_guess);
    kernels->surface(&f->data, &scratch->close, &scratch->close_guess, &scratch->surface);
    if (is_filtered(q->method)) {
        build(f, kernels, &f->close, now, true, tile_x, tile_y, &scratch->close, &scratch->close_guess);
        kernels->filtered_normal(&f->data, &scratch->close, &scratch->close_guess, &scratch->surface);
    }
}
