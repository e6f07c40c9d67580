/* SPDX-License-Identifier: MIT
 * What the shaders read of a frame: its uniform structs, and the tiles with their waves and first hits. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

#include "params/methods.h"

/* A buffer that grows. */
typedef struct page_buffer {
    void *data;
    size_t capacity;
} page_buffer;

static void *reserve(page_buffer *b, size_t size)
{
    if (size > b->capacity) {
        b->capacity = size + size / 2;
        b->data = realloc(b->data, b->capacity);
        if (!b->data)
            abort();
    }
    return b->data;
}

/* Where a tile's parts begin, in elements of theirs. `first_hit` below 0: no hits have been sought. */
typedef struct tile_parts {
    int first_wave, first_search, first_hit, padding;
} tile_parts;

typedef struct shader_tile {
    TileData data;
    tile_parts parts;
} shader_tile;
_Static_assert(sizeof(shader_tile) % 16 == 0, "texels");

/* What the page uploads: first what a frame has, then what a row of tiles has. */
static struct page_upload {
    const void *frame_data, *waves, *foam, *lean_data, *lean_waves;
    int wave_count, has_foam, choppy, lean_count;
    int tile_columns, tile_rows;
    const void *tiles, *lists, *searched, *hits;
    int list_count, search_count, hit_count;
    const void *skyline; /* pairs of floats */
    int skyline_count;   /* of them, even; 0: the tiles read none */
} upload;

static frame prepared;
static wave_set set;
static LeanData lean_data;
static lean_waves lean;
static page_buffer tiles, lists, searched, hits;

EXPORT(tile_bytes) int page_tile_bytes(void) { return sizeof(shader_tile); }
EXPORT(block_waves) int page_block_waves(void) { return BLOCK_WAVES; }
EXPORT(wave_bytes) int page_wave_bytes(void) { return sizeof(WaveData); }
EXPORT(foam_wave_bytes) int page_foam_wave_bytes(void) { return sizeof(FoamWave); }
EXPORT(lean_bytes) int page_lean_bytes(void) { return sizeof(LeanData); }
EXPORT(lean_wave_bytes) int page_lean_wave_bytes(void) { return sizeof(LeanWave); }
EXPORT(frame_bytes) int page_frame_bytes(void) { return sizeof(FrameData); }
EXPORT(foam_bytes) int page_foam_bytes(void) { return sizeof(FoamData) + 2 * FOAM_SINES * sizeof(FoamSine); }

static void add_tile(const FrameData *data, uint32_t x, uint32_t y)
{
    static page_tile tile;
    page_sort(data, &set, x, y, &tile);
    const TileData *d = &tile.waves.data;
    const int count = d->resolved_count + d->mixed_count;
    shader_tile *t = (shader_tile *)tiles.data + x;
    t->data = *d;
    t->parts = (tile_parts){upload.list_count, upload.search_count, upload.hit_count, 0};
    page_wave *list = reserve(&lists, (size_t)(upload.list_count + count) * sizeof *list);
    memcpy(list + upload.list_count, tile.list, (size_t)count * sizeof *list);
    SearchWave *search = reserve(&searched, (size_t)(upload.search_count + d->search_count) * sizeof *search);
    memcpy(search + upload.search_count, tile.waves.search, (size_t)d->search_count * sizeof *search);
    float *values = reserve(&hits, ((size_t)upload.hit_count + HIT_ROWS * TILE_PIXELS) * NODE_VALUES * sizeof *values);
    const size_t found = page_hits(data, &tile, values + (size_t)upload.hit_count * NODE_VALUES) / NODE_VALUES;
    if (found == 0)
        t->parts.first_hit = -1;
    upload.list_count += count;
    upload.search_count += d->search_count;
    upload.hit_count += (int)found;
}

/* Prepares a picture of columns × rows pixels. `sorted` 0: every wave is looked at in every pixel, to measure what sorting gains. */
EXPORT(prepare) const void *page_prepare(int method, int columns, int rows, double jitter_x, double jitter_y, int sorted)
{
    bool filter;
    prepared = page_frame((mgt_method)method, (uint32_t)columns, (uint32_t)rows, (const double[2]){jitter_x, jitter_y});
    if (!sorted) {
        prepared.data.sort_start = -1;
        prepared.data.sort_end = 1e30f;
        prepared.data.sort_weights = 0;
    }
    const interval time = page_interval(&prepared, (mgt_method)method, &filter);
    wave_set_build(&prepared, &prepared.close, time, filter, &set);
    upload = (struct page_upload){.frame_data = &prepared.data,
                                  .waves = set.data,
                                  .foam = &set.foam,
                                  .skyline = set.skyline,
                                  .skyline_count = set.view.skyline ? SKYLINE_MOST : 0,
                                  .wave_count = set.view.wave_count,
                                  .has_foam = set.has_foam,
                                  .choppy = page_scene()->water.choppiness > 0,
                                  .tile_columns = (columns + TILE_WIDTH - 1) / TILE_WIDTH,
                                  .tile_rows = (rows + TILE_HEIGHT - 1) / TILE_HEIGHT};
    if (method_of((mgt_method)method)->tables & METHOD_LEAN_MAP) {
        lean_data = sines_snap(&page_scene()->water, frame_meeting(&prepared, &prepared.close, (interval){page_scene()->time, 0}), &lean);
        upload.lean_data = &lean_data;
        upload.lean_waves = lean.waves;
        upload.lean_count = (int)lean.count;
        page_lean_begin(&lean);
    }
    reserve(&tiles, (size_t)upload.tile_columns * sizeof(shader_tile));
    return &upload;
}

/* The tiles from `first` up to `end` of a row of the prepared picture; what the others hold does not matter. */
EXPORT(prepare_row) const void *page_prepare_row(int row, int first, int end)
{
    upload.list_count = upload.search_count = upload.hit_count = 0;
    for (int x = first; x < end; x++)
        add_tile(&prepared.data, (uint32_t)x, (uint32_t)row);
    upload.tiles = tiles.data;
    upload.lists = lists.data;
    upload.searched = searched.data;
    upload.hits = hits.data;
    return &upload;
}
