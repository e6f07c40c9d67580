/* SPDX-License-Identifier: MIT
 * Pictures by the CPU's kernels: what is shown without WebGL, and the judge's brute force, sample by sample. */
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
    float *color;    /* 3 floats a pixel */
    float *coverage; /* of the light */
    uint8_t *shown;
} picture;

/* Begins a picture of the scene as it is now; `sampled`: of point samples over pixel and shutter instead of the method's. */
EXPORT(picture_begin) int page_picture_begin(int method, int columns, int rows, int sampled)
{
    struct picture *p = &picture;
    const size_t pixels = (size_t)columns * (size_t)rows;
    if (p->columns * p->rows != pixels) {
        free(p->color), free(p->coverage), free(p->shown);
        p->color = malloc(3 * pixels * sizeof *p->color);
        p->coverage = malloc(pixels * sizeof *p->coverage);
        p->shown = malloc(4 * pixels);
        if (!p->color || !p->coverage || !p->shown)
            return 0;
    }
    p->method = (mgt_method)method;
    p->columns = (uint32_t)columns;
    p->rows = (uint32_t)rows;
    p->sampled = sampled;
    p->samples = 0;
    memset(p->color, 0, 3 * pixels * sizeof *p->color);
    memset(p->coverage, 0, pixels * sizeof *p->coverage);
    p->frame = page_frame(p->method, p->columns, p->rows, (const double[2]){0, 0});
    bool filter;
    const interval time = page_interval(&p->frame, p->method, &filter);
    wave_set_build(&p->frame, &p->frame.close, time, filter, &p->set);
    return 1;
}

/* A place in the pixel: additive recurrence over the samples, another start for each pixel. */
static void jitter(uint32_t tile_x, uint32_t tile_y, uint32_t sample, float *dx, float *dy)
{
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint64_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH, bits = hash_of(x << 32 | y);
        const float u = hash_unit(bits) + (float)(sample * 0.7548776662466927 - (uint32_t)(sample * 0.7548776662466927));
        const float v = hash_unit(hash_of(bits)) + (float)(sample * 0.5698402909980532 - (uint32_t)(sample * 0.5698402909980532));
        dx[i] = u - (u >= 1) - 0.5f;
        dy[i] = v - (v >= 1) - 0.5f;
    }
}

static void keep_tile(uint32_t tile_x, uint32_t tile_y, const tile_pixels *t)
{
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint32_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH;
        if (x >= picture.columns || y >= picture.rows)
            continue;
        const size_t at = (size_t)y * picture.columns + x;
        picture.color[3 * at] += t->red[i];
        picture.color[3 * at + 1] += t->green[i];
        picture.color[3 * at + 2] += t->blue[i];
        picture.coverage[at] += t->coverage[i];
    }
}

/* The next row of tiles of the picture, or of its next sample. */
EXPORT(picture_row) void page_picture_row(int row)
{
    static page_tile tile;
    static tile_estimate estimate[HIT_ROWS];
    static tile_pixels pixels;
    static float dx[TILE_PIXELS], dy[TILE_PIXELS];
    const FrameData *data = &picture.frame.data;
    for (uint32_t x = 0; x * TILE_WIDTH < picture.columns; x++) {
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

EXPORT(picture_color) const float *page_picture_color(void) { return picture.color; }
EXPORT(picture_coverage) const float *page_picture_coverage(void) { return picture.coverage; }

/* The picture as it is displayed: 4 bytes a pixel. The sums of samples are divided by their number. */
EXPORT(picture_shown) const uint8_t *page_picture_shown(void)
{
    FrameData data = picture.frame.data;
    if (picture.samples > 1)
        data.exposure /= (float)picture.samples;
    page_display(&data, picture.color, picture.shown, (size_t)picture.columns * picture.rows);
    return picture.shown;
}

/* The number of a method's name; -1: there is none. */
EXPORT(method_number) int page_method_number(const char *name)
{
    mgt_quality quality;
    mgt_quality_init(&quality, sizeof quality);
    return method_from_name(name, &quality) ? (int)quality.method : -1;
}

EXPORT(take) void *page_take(size_t size) { return malloc(size); }
