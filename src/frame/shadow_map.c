/* SPDX-License-Identifier: MIT
 * Which points of a world the light's centre sees. */
#include "frame/shadow_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A vertex: the place where the light's ray through it meets the mean surface, and its height. */
typedef struct light_point {
    double u, v, y;
} light_point;

static light_point place_of(const shadow_rays *rays, const double p[3])
{
    const double *lean = p[1] >= 0 ? rays->air : rays->water;
    return (light_point){p[0] - lean[0] * p[1], p[2] - lean[1] * p[1], p[1]};
}

/* Rays that are not refracted, for points in dry hulls. */
static shadow_rays straight_rays(const shadow_rays *rays) { return (shadow_rays){{rays->air[0], rays->air[1]}, {rays->air[0], rays->air[1]}}; }

void shadow_map_free(shadow_map *m)
{
    if (m) {
        free(m->height);
        free(m->range);
    }
    free(m);
}

typedef struct bounds {
    float low[3], high[3];
} bounds;

/* Bounds of the objects that can cast shadows. A flat level object under all others is left out: a large ground would leave few texels for the others. */
static bounds bounds_of_casters(const world *w)
{
    bounds all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    float lowest_top = INFINITY;
    for (size_t i = 0; i < w->object_count; i++)
        if (w->objects[i].triangle_count > 0)
            lowest_top = fminf(lowest_top, w->objects[i].high[1]);
    for (size_t i = 0; i < w->object_count; i++) {
        const world_object *o = &w->objects[i];
        if (o->triangle_count == 0 || (o->low[1] == o->high[1] && o->high[1] <= lowest_top))
            continue;
        for (int k = 0; k < 3; k++)
            all.low[k] = fminf(all.low[k], o->low[k]), all.high[k] = fmaxf(all.high[k], o->high[k]);
    }
    if (all.low[0] > all.high[0]) {
        memcpy(all.low, w->low, sizeof all.low);
        memcpy(all.high, w->high, sizeof all.high);
    }
    return all;
}

/* Places the map over all places of the casters' bounds. In each medium a place is linear in the point, so the bounds' corners and their sections with the
 * mean surface suffice. */
static void place_map(shadow_map *m, const world *w)
{
    const bounds b = bounds_of_casters(w);
    const shadow_rays straight = straight_rays(&m->rays);
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int place = 0; place < 12 * (int)m->halves; place++) {
        const int corner = place % 12;
        const double y = corner < 4 ? (double)b.low[1] : corner < 8 ? (double)b.high[1] : 0;
        const double p[3] = {(double)(corner & 1 ? b.high[0] : b.low[0]), y, (double)(corner & 2 ? b.high[2] : b.low[2])};
        const light_point at = place_of(place < 12 ? &m->rays : &straight, p);
        low[0] = fmin(low[0], at.u), high[0] = fmax(high[0], at.u);
        low[1] = fmin(low[1], at.v), high[1] = fmax(high[1], at.v);
    }
    const double size = fmax(fmax(high[0] - low[0], high[1] - low[1]), 1e-3);
    m->texel = (float)(size / (SHADOW_SIDE - 4));
    m->left = (float)(low[0] - 2 * (double)m->texel);
    m->top = (float)(low[1] - 2 * (double)m->texel);
    m->columns = (uint32_t)((high[0] - low[0]) / (double)m->texel) + 4;
    m->rows = (uint32_t)((high[1] - low[1]) / (double)m->texel) + 4;
}

/* A half of a map, and its rays. */
typedef struct map_half {
    const shadow_map *map;
    shadow_rays rays;
    float *height;
} map_half;

/* Raises every texel whose centre is within the triangle to the triangle's height there. */
static void draw_triangle(const map_half *h, const light_point corner[3])
{
    const shadow_map *m = h->map;
    const light_point *a = &corner[0], *b = &corner[1], *c = &corner[2];
    const double bu = b->u - a->u, bv = b->v - a->v, cu = c->u - a->u, cv = c->v - a->v, det = bu * cv - bv * cu;
    if (!(fabs(det) > 1e-12))
        return;
    const double low = fmin(fmin(a->v, b->v), c->v), high = fmax(fmax(a->v, b->v), c->v);
    const double first = ceil(fmax(low - 0.5, 0)), last = floor(fmin(high - 0.5, (double)m->rows - 1));
    for (double row = first; row <= last; row++) {
        /* The triangle covers the columns between the edges that cross the row's middle. */
        const double v = row + 0.5;
        double from = INFINITY, to = -INFINITY;
        for (int i = 0; i < 3; i++) {
            const light_point *p = &corner[i], *q = &corner[(i + 1) % 3];
            if ((p->v <= v) == (q->v <= v))
                continue;
            const double u = p->u + (v - p->v) / (q->v - p->v) * (q->u - p->u);
            from = fmin(from, u), to = fmax(to, u);
        }
        const double left = ceil(fmax(from - 0.5, 0)), right = floor(fmin(to - 0.5, (double)m->columns - 1));
        float *texels = h->height + (size_t)row * m->columns;
        for (double column = left; column <= right; column++) {
            const double du = column + 0.5 - a->u, dv = v - a->v;
            const double s = (du * cv - dv * cu) / det, t = (bu * dv - bv * du) / det;
            const float y = (float)(a->y + s * (b->y - a->y) + t * (c->y - a->y));
            float *texel = &texels[(size_t)column];
            *texel = y > *texel ? y : *texel;
        }
    }
}

static void draw_points(const map_half *h, const double (*points)[3], size_t count)
{
    light_point seen[4];
    for (size_t i = 0; i < count; i++) {
        const shadow_map *m = h->map;
        seen[i] = place_of(&h->rays, points[i]);
        seen[i].u = (seen[i].u - (double)m->left) / (double)m->texel;
        seen[i].v = (seen[i].v - (double)m->top) / (double)m->texel;
    }
    for (size_t i = 2; i < count; i++) {
        const light_point corner[3] = {seen[0], seen[i - 1], seen[i]};
        draw_triangle(h, corner);
    }
}

/* Draws the part of a triangle on one side of the mean surface, where the light's rays are straight. */
static void draw_side(const map_half *h, const double p[3][3], double side)
{
    double part[4][3];
    size_t count = 0;
    for (int i = 0; i < 3; i++) {
        const double *a = p[i], *b = p[(i + 1) % 3];
        if (a[1] * side >= 0)
            memcpy(part[count++], a, sizeof *part);
        if ((a[1] * side > 0 && b[1] * side < 0) || (a[1] * side < 0 && b[1] * side > 0)) {
            const double s = a[1] / (a[1] - b[1]);
            part[count][0] = a[0] + s * (b[0] - a[0]);
            part[count][1] = 0;
            part[count++][2] = a[2] + s * (b[2] - a[2]);
        }
    }
    draw_points(h, (const double(*)[3])part, count);
}

static void draw_world(const map_half *h, const world *w)
{
    for (size_t t = 0; t < w->triangle_count; t++) {
        double p[3][3];
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                p[c][k] = (double)w->positions[3 * (size_t)w->indices[3 * t + (size_t)c] + (size_t)k];
        const bool above = p[0][1] > 0 || p[1][1] > 0 || p[2][1] > 0, below = p[0][1] < 0 || p[1][1] < 0 || p[2][1] < 0;
        if (above || !below)
            draw_side(h, (const double(*)[3])p, 1);
        if (below)
            draw_side(h, (const double(*)[3])p, -1);
    }
}

/* ---- blocks ---- */

typedef struct height_range {
    float least, greatest;
} height_range;

static height_range joined(height_range a, height_range b)
{
    return (height_range){a.least < b.least ? a.least : b.least, a.greatest > b.greatest ? a.greatest : b.greatest};
}

static const height_range no_heights = {INFINITY, -INFINITY};

static void set_levels(shadow_map *m)
{
    const uint32_t side = m->columns > m->rows ? m->columns : m->rows;
    for (bool whole = false; !whole; m->levels++) {
        const uint32_t block = (uint32_t)SHADOW_BLOCK << m->levels;
        m->across[m->levels] = (int)((m->columns + block - 1) / block);
        m->start[m->levels] = m->blocks;
        m->blocks += m->across[m->levels] * (int)((m->rows + block - 1) / block);
        whole = block >= side;
    }
}

static int blocks_down(const shadow_map *m, int level)
{
    return ((level + 1 < m->levels ? m->start[level + 1] : m->blocks) - m->start[level]) / m->across[level];
}

/* The ranges of a level's blocks, row by row. */
typedef struct range_plane {
    height_range *of;
    int across, down;
} range_plane;

/* Range of a square of four blocks, of which (column, row) is the upper left one. */
static height_range range_of_four(const range_plane *p, int column, int row)
{
    height_range r = no_heights;
    for (int y = row; y < row + 2 && y < p->down; y++)
        for (int x = column; x < column + 2 && x < p->across; x++)
            r = joined(r, p->of[(size_t)y * (size_t)p->across + (size_t)x]);
    return r;
}

static height_range range_of_texels(const shadow_map *m, const float *half, int column, int row)
{
    height_range r = no_heights;
    for (uint32_t y = (uint32_t)row * SHADOW_BLOCK; y < (uint32_t)(row + 1) * SHADOW_BLOCK && y < m->rows; y++)
        for (uint32_t x = (uint32_t)column * SHADOW_BLOCK; x < (uint32_t)(column + 1) * SHADOW_BLOCK && x < m->columns; x++) {
            const float height = half[(size_t)y * m->columns + x];
            r = joined(r, (height_range){height, height});
        }
    return r;
}

/* Fills the ranges of single blocks of a half; each level is made from the one before. */
static void find_blocks(const shadow_map *m, const float *half, height_range *blocks)
{
    for (int level = 0; level < m->levels; level++) {
        const int across = m->across[level], down = blocks_down(m, level);
        const range_plane finer = level > 0 ? (range_plane){blocks + m->start[level - 1], m->across[level - 1], blocks_down(m, level - 1)} : (range_plane){0};
        height_range *out = blocks + m->start[level];
        for (int row = 0; row < down; row++)
            for (int column = 0; column < across; column++)
                *out++ = level > 0 ? range_of_four(&finer, 2 * column, 2 * row) : range_of_texels(m, half, column, row);
    }
}

static void join_blocks(const shadow_map *m, height_range *blocks, float *range)
{
    for (int level = 0; level < m->levels; level++) {
        const range_plane plane = {blocks + m->start[level], m->across[level], blocks_down(m, level)};
        for (int row = 0; row < plane.down; row++)
            for (int column = 0; column < plane.across; column++) {
                const height_range r = range_of_four(&plane, column, row);
                *range++ = r.least, *range++ = r.greatest;
            }
    }
}

static bool find_ranges(shadow_map *m)
{
    set_levels(m);
    height_range *blocks = malloc((size_t)m->blocks * sizeof *blocks);
    m->range = malloc((size_t)m->blocks * m->halves * 2 * sizeof *m->range);
    for (size_t half = 0; half < m->halves && blocks && m->range; half++) {
        find_blocks(m, m->height + half * m->columns * m->rows, blocks);
        join_blocks(m, blocks, m->range + half * (size_t)m->blocks * 2);
    }
    free(blocks);
    return blocks && m->range;
}

/* ---- the map ---- */

static bool make_room(shadow_map *m)
{
    const size_t count = (size_t)m->columns * m->rows * m->halves;
    m->height = malloc(count * sizeof *m->height);
    for (size_t i = 0; i < count && m->height; i++)
        m->height[i] = -INFINITY;
    return m->height != NULL;
}

static void draw_map(const shadow_map *m, const world *w)
{
    draw_world(&(map_half){m, m->rays, m->height}, w);
    if (m->halves > 1)
        draw_world(&(map_half){m, straight_rays(&m->rays), m->height + (size_t)m->columns * m->rows}, w);
}

mgt_status shadow_map_update(shadow_map **map, const world *w, const shadow_rays *rays)
{
    if (*map && (*map)->version == w->version && memcmp(&(*map)->rays, rays, sizeof *rays) == 0)
        return MGT_OK;
    shadow_map_free(*map);
    shadow_map *m = *map = calloc(1, sizeof *m);
    if (!m)
        return MGT_ERROR_MEMORY;
    m->version = w->version;
    m->rays = *rays;
    m->halves = w->dry ? 2 : 1;
    if (w->triangle_count == 0)
        return MGT_OK;
    place_map(m, w);
    if (make_room(m)) {
        draw_map(m, w);
        if (find_ranges(m))
            return MGT_OK;
    }
    shadow_map_free(m);
    *map = NULL;
    return MGT_ERROR_MEMORY;
}
