/* SPDX-License-Identifier: MIT
 * Pictures by the CPU's kernels: what is shown without WebGL, and the judge's brute force, sample by sample in two halves. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "params/methods.h"

static struct picture {
    mgt_method method;
    uint32_t columns, rows;
    bool sampled;
    uint32_t samples;
    frame frame;
    wave_set set;
    float *half[2]; /* 4 floats a pixel: colour, coverage of the light. Samples with odd numbers are in the second */
    uint8_t *shown;
} picture;

static void *room(void *old, size_t size)
{
    void *data = realloc(old, size);
    if (!data)
        abort();
    return data;
}

/* Begins a picture of the scene as it is now; `sampled`: of point samples over pixel and shutter instead of the method's. The rays are moved by the jitter, in pixels. */
EXPORT(picture_begin) void page_picture_begin(int method, int columns, int rows, int sampled, double jitter_x, double jitter_y)
{
    struct picture *p = &picture;
    const size_t pixels = (size_t)columns * (size_t)rows, halves = sampled ? 2 : 1;
    if (p->columns * p->rows != pixels)
        p->shown = room(p->shown, 4 * pixels);
    for (size_t h = 0; h < halves; h++) {
        p->half[h] = room(p->half[h], 4 * pixels * sizeof(float));
        memset(p->half[h], 0, 4 * pixels * sizeof(float));
    }
    p->method = (mgt_method)method;
    p->columns = (uint32_t)columns;
    p->rows = (uint32_t)rows;
    p->sampled = sampled;
    p->samples = 0;
    p->frame = page_frame(p->method, p->columns, p->rows, (const double[2]){jitter_x, jitter_y});
    bool filter;
    const interval time = page_interval(&p->frame, p->method, &filter);
    wave_set_build(&p->frame, &p->frame.close, time, filter, &p->set);
}

/* A place in the pixel: additive recurrence over a half's samples, another start for each pixel and half. */
static void jitter(uint32_t tile_x, uint32_t tile_y, uint32_t sample, float *dx, float *dy)
{
    const double first = sample / 2 * 0.7548776662466927, second = sample / 2 * 0.5698402909980532;
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint64_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH, bits = hash_of(x << 32 | y << 1 | sample % 2);
        const float u = hash_unit(bits) + (float)(first - (uint32_t)first);
        const float v = hash_unit(hash_of(bits)) + (float)(second - (uint32_t)second);
        dx[i] = u - (u >= 1) - 0.5f;
        dy[i] = v - (v >= 1) - 0.5f;
    }
}

static void keep_tile(uint32_t tile_x, uint32_t tile_y, const tile_pixels *t)
{
    float *half = picture.half[picture.samples % 2];
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint32_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH;
        if (x >= picture.columns || y >= picture.rows)
            continue;
        float *pixel = half + 4 * ((size_t)y * picture.columns + x);
        pixel[0] += t->red[i];
        pixel[1] += t->green[i];
        pixel[2] += t->blue[i];
        pixel[3] += t->coverage[i];
    }
}

/* The tiles from `first` up to `end` of a row of the picture, or of its next sample. */
EXPORT(picture_row) void page_picture_row(int row, int first, int end)
{
    static page_tile tile;
    static tile_estimate estimate[HIT_ROWS];
    static tile_pixels pixels;
    static float dx[TILE_PIXELS], dy[TILE_PIXELS];
    const FrameData *data = &picture.frame.data;
    for (uint32_t x = (uint32_t)first; x < (uint32_t)end; x++) {
        page_sort(data, &picture.set, x, (uint32_t)row, &tile);
        page_estimate(data, &tile, estimate);
        memset(&pixels, 0, sizeof pixels);
        if (picture.sampled) {
            jitter(x, (uint32_t)row, picture.samples, dx, dy);
            page_sample(data, &tile, estimate, dx, dy, 1, &pixels);
        } else {
            page_shade(data, picture.method, &tile, estimate, &pixels);
        }
        keep_tile(x, (uint32_t)row, &pixels);
    }
}

/* The next sample of every pixel is at another instant of the shutter. */
EXPORT(picture_next_sample) void page_picture_next_sample(void)
{
    const mgt_scene *s = page_scene();
    const double share = ++picture.samples * 0.6180339887498949;
    const double instant = s->time - s->shutter * (share - (double)(uint32_t)share);
    wave_set_build(&picture.frame, &picture.frame.close, (interval){instant, 0}, false, &picture.set);
}

EXPORT(picture_frame) const void *page_picture_frame(void) { return &picture.frame.data; }
EXPORT(picture_half) const float *page_picture_half(int half) { return picture.half[half]; }

/* `count` pixels from `first` of a method's picture as they are displayed: 4 bytes each. */
EXPORT(picture_shown) const uint8_t *page_picture_shown(int first, int count)
{
    page_display(&picture.frame.data, picture.half[0] + 4 * first, picture.shown + 4 * first, (size_t)count);
    return picture.shown + 4 * first;
}

/* Displayed luma in [0, 1] of `count` pixels of 4 floats, which are multiplied by `weight`. */
EXPORT(picture_luma) void page_picture_luma(const float *rgba, float weight, int count, float *luma)
{
    page_luma(&picture.frame.data, rgba, weight, luma, (size_t)count);
}

/* The number of a method's name; -1: there is none. */
EXPORT(method_number) int page_method_number(const char *name)
{
    mgt_quality quality;
    mgt_quality_init(&quality, sizeof quality);
    return method_from_name(name, &quality) ? (int)quality.method : -1;
}

EXPORT(take) void *page_take(size_t size) { return room(NULL, size); }
EXPORT(give) void page_give(void *data) { free(data); }
