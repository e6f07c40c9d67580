/* SPDX-License-Identifier: MIT
 * Clips triangles of homogeneous images, snaps them to subpixels, and sorts them into the tiles that they may touch.
 *
 * Neighbouring triangles meet without gap or overlap, because a shared vertex gives the same subpixels in each of its triangles, and a shared edge is always
 * cut from its inner end. */
#include "cpu/raster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/triples.h"

static const double coordinate_limit = COORDINATE_LIMIT;

enum { MOST_CORNERS = 9 }; /* a triangle that five borders cut has up to eight */

typedef struct polygon {
    int count;
    double corner[MOST_CORNERS][3];
} polygon;

static bool reserve(void **memory, size_t *room, size_t wanted, size_t size)
{
    if (wanted <= *room)
        return true;
    const size_t more = wanted > 2 * *room ? wanted : 2 * *room;
    void *grown = realloc(*memory, more * size);
    if (!grown)
        return false;
    *memory = grown;
    *room = more;
    return true;
}

/* ---- clipping ---- */

static double side_of(const double plane[3], const double p[3]) { return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2]; }

/* The part of a polygon where plane·p ≥ offset. */
static polygon clipped(const polygon *p, const double plane[3], double offset)
{
    polygon out = {.count = 0};
    for (int i = 0; i < p->count; i++) {
        const double *a = p->corner[i], *b = p->corner[i + 1 == p->count ? 0 : i + 1];
        const double at_a = side_of(plane, a) - offset, at_b = side_of(plane, b) - offset;
        if (at_a >= 0)
            memcpy(out.corner[out.count++], a, sizeof out.corner[0]);
        if ((at_a >= 0) == (at_b >= 0))
            continue;
        const double *in = at_a >= 0 ? a : b, *beyond = at_a >= 0 ? b : a;
        const double share = (at_a >= 0 ? at_a : at_b) / fabs(at_a - at_b);
        for (int k = 0; k < 3; k++)
            out.corner[out.count][k] = in[k] + (beyond[k] - in[k]) * share;
        out.count++;
    }
    return out;
}

static polygon clip_to_limits(const float image[3][3], double least_depth)
{
    static const double front[3] = {0, 0, 1};
    const double borders[4][3] = {{1, 0, coordinate_limit}, {-1, 0, coordinate_limit}, {0, 1, coordinate_limit}, {0, -1, coordinate_limit}};
    polygon p = {.count = 3};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p.corner[i][k] = (double)image[i][k];
    p = clipped(&p, front, least_depth);
    for (int i = 0; i < 4 && p.count > 0; i++)
        p = clipped(&p, borders[i], 0);
    return p;
}

/* ---- setup ---- */

/* Bounds of the pixels whose centres a triangle may cover, inclusive, from the picture's first pixel. */
typedef struct pixel_box {
    int32_t left, right, top, bottom;
} pixel_box;

static pixel_box box_of(const raster_triangle *t, const raster_grid *grid)
{
    pixel_box box = {((LEAST3(t->x) + SUBPIXELS - 1) >> 8) + grid->middle_x, (MOST3(t->x) >> 8) + grid->middle_x,
                     ((LEAST3(t->y) + SUBPIXELS - 1) >> 8) + grid->middle_y, (MOST3(t->y) >> 8) + grid->middle_y};
    box.left = box.left > 0 ? box.left : 0;
    box.top = box.top > 0 ? box.top : 0;
    box.right = box.right < grid->width - 1 ? box.right : grid->width - 1;
    box.bottom = box.bottom < grid->height - 1 ? box.bottom : grid->height - 1;
    return box;
}

/* Sets up a triangle with clockwise corners. False: it covers no pixel's centre. */
static bool set_up(const double corner[3][3], const raster_grid *grid, int32_t triangle, raster_triangle *t, pixel_box *box)
{
    double inverse[3];
    for (int i = 0; i < 3; i++) { /* in floats, because shared corners must get the same subpixels as in raster_kernels.setups */
        const float one_over = 1.0f / (float)corner[i][2];
        inverse[i] = (double)one_over;
        t->x[i] = (int32_t)lrintf((float)corner[i][0] * one_over * SUBPIXELS);
        t->y[i] = (int32_t)lrintf((float)corner[i][1] * one_over * SUBPIXELS);
    }
    *box = box_of(t, grid);
    const int64_t x1 = (int64_t)t->x[1] - t->x[0], y1 = (int64_t)t->y[1] - t->y[0], x2 = (int64_t)t->x[2] - t->x[0], y2 = (int64_t)t->y[2] - t->y[0];
    const int64_t area = x1 * y2 - y1 * x2;
    if (area == 0 || box->left > box->right || box->top > box->bottom)
        return false;
    const double scale = SUBPIXELS / (double)area, d1 = inverse[1] - inverse[0], d2 = inverse[2] - inverse[0];
    t->slope_x = (float)((d1 * (double)y2 - d2 * (double)y1) * scale);
    t->slope_y = (float)((d2 * (double)x1 - d1 * (double)x2) * scale);
    t->inverse_depth = (float)inverse[0];
    t->least = (float)LEAST3(inverse);
    t->most = (float)MOST3(inverse);
    t->triangle = triangle;
    if (area < 0) {
        const int32_t x = t->x[1], y = t->y[1];
        t->x[1] = t->x[2], t->y[1] = t->y[2];
        t->x[2] = x, t->y[2] = y;
    }
    return true;
}

/* ---- bins ---- */

/* Whether the whole tile lies outside of an edge of the triangle. */
static bool misses_tile(const raster_triangle *t, const raster_grid *grid, int32_t column, int32_t row)
{
    const int64_t size = (RASTER_TILE - 1) * SUBPIXELS;
    const int64_t left = (int64_t)(column * RASTER_TILE - grid->middle_x) * SUBPIXELS, top = (int64_t)(row * RASTER_TILE - grid->middle_y) * SUBPIXELS;
    for (int k = 0; k < 3; k++) {
        const int next = k == 2 ? 0 : k + 1;
        const int64_t dx = (int64_t)t->x[next] - t->x[k], dy = (int64_t)t->y[next] - t->y[k];
        const int64_t px = left + (dy < 0 ? size : 0) - t->x[k], py = top + (dx > 0 ? size : 0) - t->y[k];
        if (dx * py - dy * px < 0)
            return true;
    }
    return false;
}

static bool bin_triangle(raster_bins *bins, const raster_grid *grid, int layer, const raster_triangle *t, const pixel_box *box)
{
    const int32_t left = box->left / RASTER_TILE, right = box->right / RASTER_TILE, top = box->top / RASTER_TILE, bottom = box->bottom / RASTER_TILE;
    const size_t most = (size_t)(right - left + 1) * (size_t)(bottom - top + 1);
    if (!reserve((void **)&bins->entries, &bins->entry_room, bins->entry_count + most, sizeof *bins->entries) ||
        !reserve((void **)&bins->triangles, &bins->triangle_room, bins->triangle_count + 1, sizeof *bins->triangles)) {
        bins->failed = true;
        return false;
    }
    const uint32_t first = (uint32_t)(layer * grid->columns * grid->rows);
    const size_t before = bins->entry_count;
    for (int32_t row = top; row <= bottom; row++)
        for (int32_t column = left; column <= right; column++)
            if (most <= 2 || !misses_tile(t, grid, column, row))
                bins->entries[bins->entry_count++] = (bin_entry){first + (uint32_t)(row * grid->columns + column), (uint32_t)bins->triangle_count};
    if (bins->entry_count == before)
        return false;
    bins->triangles[bins->triangle_count++] = *t;
    return true;
}

static bool add_flat(raster_bins *bins, const raster_grid *grid, int layer, const double corner[3][3], int32_t triangle)
{
    raster_triangle t;
    pixel_box box;
    return set_up(corner, grid, triangle, &t, &box) && bin_triangle(bins, grid, layer, &t, &box);
}

size_t raster_bins_add(raster_bins *bins, const raster_grid *grid, int layer, const setup_batch *from, size_t i, const float image[3][3], int32_t triangle)
{
    if (!(from->state[i] > 0))
        return 0;
    if (from->state[i] < 2) {
        raster_triangle t = {.inverse_depth = from->inverse_depth[i],
                             .slope_x = from->slope_x[i],
                             .slope_y = from->slope_y[i],
                             .least = from->least[i],
                             .most = from->most[i],
                             .triangle = triangle};
        for (int k = 0; k < 3; k++) {
            t.x[k] = (int32_t)from->x[k][i];
            t.y[k] = (int32_t)from->y[k][i];
        }
        const pixel_box box = box_of(&t, grid);
        return box.left <= box.right && box.top <= box.bottom && bin_triangle(bins, grid, layer, &t, &box);
    }
    const polygon p = clip_to_limits(image, grid->least_depth);
    size_t added = 0;
    for (int k = 1; k + 1 < p.count; k++) {
        double corner[3][3];
        memcpy(corner[0], p.corner[0], sizeof corner[0]);
        memcpy(corner[1], p.corner[k], 2 * sizeof corner[0]);
        added += add_flat(bins, grid, layer, (const double(*)[3])corner, triangle);
    }
    return added;
}

void raster_bins_sort(raster_bins *bins, const raster_grid *grid)
{
    const size_t count = (size_t)LAYERS * (size_t)grid->columns * (size_t)grid->rows;
    if (!reserve((void **)&bins->starts, &bins->start_room, count + 2, sizeof *bins->starts) ||
        !reserve((void **)&bins->list, &bins->list_room, bins->entry_count + 1, sizeof *bins->list)) {
        bins->failed = true;
        return;
    }
    /* Counts are kept two places further on. Filling the list increments each start to that of the next bin, which leaves it in its own place. */
    memset(bins->starts, 0, (count + 2) * sizeof *bins->starts);
    for (size_t i = 0; i < bins->entry_count; i++)
        bins->starts[bins->entries[i].bin + 2]++;
    for (size_t i = 2; i < count + 2; i++)
        bins->starts[i] += bins->starts[i - 1];
    for (size_t i = 0; i < bins->entry_count; i++)
        bins->list[bins->starts[bins->entries[i].bin + 1]++] = bins->entries[i].triangle;
}

void raster_bins_clear(raster_bins *bins)
{
    bins->triangle_count = bins->entry_count = 0;
    bins->failed = false;
}

void raster_bins_free(raster_bins *bins)
{
    free(bins->triangles);
    free(bins->entries);
    free(bins->list);
    free(bins->starts);
    *bins = (raster_bins){0};
}
