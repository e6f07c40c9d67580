/* SPDX-License-Identifier: MIT
 * The library as the page calls it: a scene from settings, what a frame's shaders read, and pictures by the CPU's kernels. One thread, one scene. */
#ifndef MANGATA_WEB_PAGE_H
#define MANGATA_WEB_PAGE_H

#include "cpu/lanes.h"
#include "frame/frame.h"

#define EXPORT(name) __attribute__((export_name(#name)))

enum {
#define SETTING(name, ...) SETTING_##name,
#include "settings.h"
#undef SETTING
    SETTING_COUNT
};

/* The scene and the sky that the settings ask for. */
const mgt_scene *page_scene(void);
const sky_state *page_sky(void);

/* A frame of the scene by a method, `columns` × `rows` of pixels. `jitter`: what the rays are moved by, in pixels, to the right and down. */
frame page_frame(mgt_method method, uint32_t columns, uint32_t rows, const double jitter[2]);

/* The waves that a method shades from; false for point samples. */
interval page_interval(const frame *f, mgt_method method, bool *filter);

/* A TileWave whose index is a float, for textures of floats. */
typedef struct page_wave {
    float index, turns, share, padding;
} page_wave;

/* A tile, and its waves as shaders list them. */
typedef struct page_tile {
    tile_waves waves;
    page_wave list[MGT_MAX_WAVES];
} page_tile;

/* Sorts the waves of a tile. */
void page_sort(const FrameData *data, const wave_set *set, uint32_t x, uint32_t y, page_tile *out);

/* The map of slope moments whose bands are asked for. */
void page_lean_begin(const lean_waves *of);

enum { NODE_VALUES = 8 }; /* of a node, or of a hit of grazing water */

/* First hits of a tile as shaders read them: of its nodes, or, in grazing water, of every pixel. Returns how many values there are. */
size_t page_hits(const FrameData *data, const page_tile *tile, float *values);

/* As lane_kernels have them; page_estimate() fills HIT_ROWS of estimates. */
void page_estimate(const FrameData *data, const page_tile *tile, tile_estimate *estimate);
void page_sample(const FrameData *data, const page_tile *tile, const tile_estimate *estimate, const float *dx, const float *dy, float weight, tile_pixels *out);
void page_shade(const FrameData *data, mgt_method method, const page_tile *tile, const tile_estimate *estimate, tile_pixels *out);

/* Displayed pixels, 4 bytes each, and displayed luma, of `count` pixels of 4 floats. */
void page_display(const FrameData *data, const float *rgba, uint8_t *shown, size_t count);
void page_luma(const FrameData *data, const float *rgba, float weight, float *luma, size_t count);

#endif
