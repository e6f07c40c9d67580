/* SPDX-License-Identifier: MIT
 * The kernels over a tile once more, with what the page's shaders read of it. The library's file is a part of this one. */
#include "cpu/lanes.c"

#include "cpu/baseline_lanes.h"
#include "cpu/tile_job.h"
#include "page.h"

void page_sort(const FrameData *data, const wave_set *set, uint32_t x, uint32_t y, page_tile *out)
{
    const struct kernel_context cx = {.frame = data, .view = &set->view};
    tile_sorting sorting;
    classify_tile(&cx, set, x, y, &sorting);
    list_tile(&cx, set, &sorting, &out->waves);
    static const float kinds[] = {WAVE_RESOLVED, WAVE_MIXED};
    int count = 0;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < set->view.wave_count; i++)
            if (sorting.classes.kind[i] == kinds[k])
                out->list[count++] = (page_wave){(float)i, sorting.classes.turns[i], sorting.classes.share[i], 0};
}

static size_t hits_of_pixels(const tile_estimate *estimate, int rows, float *values)
{
    for (int i = 0; i < rows * TILE_PIXELS; i++, values += NODE_VALUES) {
        const tile_estimate *e = &estimate[i / TILE_PIXELS];
        const int p = i % TILE_PIXELS;
        const float hit[NODE_VALUES] = {e->height[p], e->slope_x[p], e->slope_z[p], 0, e->shift_x[p], e->shift_z[p]};
        memcpy(values, hit, sizeof hit);
    }
    return (size_t)rows * TILE_PIXELS * NODE_VALUES;
}

size_t page_hits(const FrameData *data, const page_tile *tile, float *values)
{
    const tile_waves *waves = &tile->waves;
    const struct kernel_context cx = {.frame = data, .tile = &waves->data, .waves = waves->waves, .search = waves->search};
    if (waves->data.grazing && tile_sees_water(waves)) {
        static tile_estimate estimate[HIT_ROWS];
        lanes_estimate(data, waves, estimate);
        return hits_of_pixels(estimate, (int)waves->data.hit_rows, values);
    }
    if (waves->data.search_pixels || !tile_sees_water(waves))
        return 0;
    tile_nodes n;
    search_nodes(&cx, &n);
    for (int i = 0; i < NODE_COUNT; i++, values += NODE_VALUES) {
        const float node[NODE_VALUES] = {n.along[i], n.found[i], n.level[i], n.height[i], n.slope_x[i], n.slope_z[i], n.shift_x[i], n.shift_z[i]};
        memcpy(values, node, sizeof node);
    }
    return NODE_COUNT * NODE_VALUES;
}

void page_sample(const FrameData *data, const page_tile *tile, const tile_estimate *estimate, const float *dx, const float *dy, float weight, tile_pixels *out)
{
    lanes_sample(data, page_sky()->table, NULL, &tile->waves, estimate, dx, dy, weight, out);
}

void page_estimate(const FrameData *data, const page_tile *tile, tile_estimate *estimate)
{
    if (tile_sees_water(&tile->waves))
        lanes_estimate(data, &tile->waves, estimate);
    else
        memset(estimate, 0, (size_t)tile->waves.data.hit_rows * sizeof *estimate);
}

void page_shade(const FrameData *data, mgt_method method, const page_tile *tile, const tile_estimate *estimate, tile_pixels *out)
{
    const method_tile t = {.frame = data, .sky = page_sky()->table, .close = &tile->waves, .close_estimate = estimate};
    lanes_method(method, &t, out);
}

enum { PACKED = 64 };

/* Colours of at most PACKED pixels of 4 floats, times `weight`. Returns how many. */
static size_t pack(const float *rgba, float weight, size_t count, float rgb[3 * PACKED])
{
    const size_t pixels = count < PACKED ? count : PACKED;
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = weight * rgba[4 * i + c];
    return pixels;
}

void page_display(const FrameData *data, const float *rgba, uint8_t *shown, size_t count)
{
    float rgb[3 * PACKED];
    for (size_t i = 0; i < count; i += PACKED)
        lanes_display(data, rgb, shown + 4 * i, pack(rgba + 4 * i, 1, count - i, rgb));
}

void page_luma(const FrameData *data, const float *rgba, float weight, float *luma, size_t count)
{
    float rgb[3 * PACKED];
    for (size_t i = 0; i < count; i += PACKED)
        baseline_kernels_4.luma(data, rgb, luma + i, pack(rgba + 4 * i, weight, count - i, rgb));
}
