/* SPDX-License-Identifier: MIT
 * Points, triangles and pixels of layers, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a point, an edge or a pixel sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/kernel_context.h"
#include "cpu/raster_lanes.h"

#include <math.h>
#include <string.h>

#include "base/triples.h"

#define LANES_NAME_(n) raster_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)
static const float infinity = INFINITY;

#include "kernels/common/prelude_c.h"

#define REFRACT(cx) (*(cx)->refract)
#define PICTURE(cx) (*(cx)->picture)
#include "kernels/refraction/refract_patch.k"

static inline real load(const float *p)
{
    real r;
    memcpy(&r, p, sizeof r);
    return r;
}

static inline void store(float *p, real r) { memcpy(p, &r, sizeof r); }

static inline vec3 load3(const float *const p[3], size_t i) { return (vec3){load(p[0] + i), load(p[1] + i), load(p[2] + i)}; }

/* ---- points ---- */

static void lanes_virtual_points(const RefractData *refract, size_t count, const float *const in[3], float *const out[3])
{
    const struct kernel_context cx = {.refract = refract};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const vec3 p = virtual_point(&cx, load3(in, i));
        store(out[0] + i, p.x), store(out[1] + i, p.y), store(out[2] + i, p.z);
    }
}

static void lanes_true_points(const RefractData *refract, size_t count, const float *const in[3], float *const out[3])
{
    const struct kernel_context cx = {.refract = refract};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const vec3 p = true_point(&cx, load3(in, i));
        store(out[0] + i, p.x), store(out[1] + i, p.y), store(out[2] + i, p.z);
    }
}

static void lanes_images(const RefractData *refract, const PictureData *picture, const float foot[2], size_t count, const float *positions, float *images)
{
    const struct kernel_context cx = {.refract = refract, .picture = picture};
    for (size_t i = 0; i < count; i += MGT_LANES) {
        const size_t valid = count - i < MGT_LANES ? count - i : MGT_LANES;
        float in[3][MGT_LANES], out[4][MGT_LANES];
        memset(in, 0, sizeof in);
        for (size_t lane = 0; lane < valid; lane++)
            for (size_t k = 0; k < 3; k++)
                in[k][lane] = positions[3 * (i + lane) + k];
        const vec3 p = {load(in[0]) - foot[0], load(in[1]), load(in[2]) - foot[1]};
        const real far = p.y * (0.0f - refract->side);
        const mask mapped = far >= real(0.0f);
        vec3 image = straight_image(&cx, p);
        if (refract->map != 0 && any_lane(mapped))
            image = SELECT3(mapped, far_image(&cx, p), image);
        store(out[0], image.x), store(out[1], image.y), store(out[2], image.z), store(out[3], far);
        for (size_t lane = 0; lane < valid; lane++)
            for (size_t k = 0; k < 4; k++)
                images[4 * (i + lane) + k] = out[k][lane];
    }
}

/* ---- patches ---- */

static inline vec3 load_corner(const float from[3][3][PATCH_BATCH], int corner, size_t i)
{
    return (vec3){load(from[corner][0] + i), load(from[corner][1] + i), load(from[corner][2] + i)};
}

static inline void store_corner(float to[3][3][PATCH_BATCH], int corner, size_t i, vec3 p)
{
    store(to[corner][0] + i, p.x), store(to[corner][1] + i, p.y), store(to[corner][2] + i, p.z);
}

static void fill_up(patch_batch *b)
{
    for (size_t i = b->count; i % MGT_LANES != 0; i++)
        for (int corner = 0; corner < 3; corner++)
            for (int k = 0; k < 3; k++) {
                b->corner[corner][k][i] = b->corner[corner][k][i - 1];
                b->image[corner][k][i] = b->image[corner][k][i - 1];
            }
}

static void lanes_patches(const RefractData *refract, const PictureData *picture, int place, patch_batch *b)
{
    const struct kernel_context cx = {.refract = refract, .picture = picture};
    fill_up(b);
    for (size_t i = 0; i < b->count; i += MGT_LANES) {
        vec3 corner[3], image[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = load_corner(b->corner, k, i);
            if (place)
                store_corner(b->image, k, i, far_image(&cx, corner[k]));
            image[k] = load_corner(b->image, k, i);
        }
        real hidden = real(0.0f), splits = real(0.0f);
        for (int k = 0; k < 3; k++) {
            const int next = k == 2 ? 0 : k + 1;
            const PatchEdge edge = patch_edge(&cx, corner[k], corner[next], image[k], image[next]);
            store_corner(b->middle, k, i, edge.middle);
            store_corner(b->middle_image, k, i, edge.image);
            store(b->split[k] + i, edge.split);
            splits = max(splits, edge.split);
        }
        const Beyond beyond = both_beyond(&cx, both_beyond(&cx, beyond_of(&cx, image[0]), beyond_of(&cx, image[1])), beyond_of(&cx, image[2]));
        const mask outside = most_beyond(&cx, beyond) > real(0.0f), whole = splits <= real(0.0f);
        hidden = SELECT(AND(outside, whole), real(1.0f), hidden);
        if (refract->map == 1 && any_lane(AND(outside, NOT(whole))))
            hidden = SELECT(AND(outside, NOT(whole)), patch_hidden(&cx, corner[0], corner[1], corner[2]), hidden);
        store(b->hidden + i, hidden);
    }
}

/* ---- setup ---- */

/* a b − c d with an error of about one rounding, so that it is 0 only if the exact value is. */
static inline real difference_of_products(real a, real b, real c, real d)
{
    const real product = c * d;
    return fma(a, b, real(0.0f) - product) - product_error(c, d);
}

/* Whether a pixel's centre lies between two coordinates in subpixels. */
static inline mask holds_center(real low, real high) { return floor(high * (1.0f / SUBPIXELS)) * (float)SUBPIXELS >= low; }

static inline mask reaches_over(vec3 image, float least_depth)
{
    const real reach = image.z * (float)COORDINATE_LIMIT;
    return OR(OR(abs(image.x) > reach, abs(image.y) > reach), image.z < real(least_depth));
}

static void set_up(const PictureData *picture, const vec3 image[3], setup_batch *out, size_t i)
{
    real x[3], y[3], inverse[3];
    mask over = real(0.0f) > real(1.0f);
    for (int k = 0; k < 3; k++)
        over = OR(over, reaches_over(image[k], picture->least_depth));
    for (int k = 0; k < 3; k++) {
        inverse[k] = real(1.0f) / SELECT(over, real(1.0f), image[k].z);
        x[k] = round_even(SELECT(over, real(0.0f), image[k].x) * inverse[k] * (float)SUBPIXELS);
        y[k] = round_even(SELECT(over, real(0.0f), image[k].y) * inverse[k] * (float)SUBPIXELS);
    }
    const real x1 = x[1] - x[0], y1 = y[1] - y[0], x2 = x[2] - x[0], y2 = y[2] - y[0];
    const real area = difference_of_products(x1, y2, y1, x2), zero = real(0.0f);
    const mask flat = area <= zero, turned = area < zero, empty = AND(flat, area >= zero);
    const real low_x = min(min(x[0], x[1]), x[2]), high_x = max(max(x[0], x[1]), x[2]);
    const real low_y = min(min(y[0], y[1]), y[2]), high_y = max(max(y[0], y[1]), y[2]);
    const mask box = AND(holds_center(low_x, high_x), holds_center(low_y, high_y));
    const mask inside = AND(AND(high_x >= real(picture->left * SUBPIXELS), low_x <= real(picture->right * SUBPIXELS)),
                            AND(high_y >= real(picture->top * SUBPIXELS), low_y <= real(picture->bottom * SUBPIXELS)));
    const real scaled = real((float)SUBPIXELS) / SELECT(empty, real(1.0f), area);
    const real d1 = inverse[1] - inverse[0], d2 = inverse[2] - inverse[0];
    store(out->slope_x + i, difference_of_products(d1, y2, d2, y1) * scaled);
    store(out->slope_y + i, difference_of_products(d2, x1, d1, x2) * scaled);
    store(out->inverse_depth + i, inverse[0]);
    store(out->least + i, min(min(inverse[0], inverse[1]), inverse[2]));
    store(out->most + i, max(max(inverse[0], inverse[1]), inverse[2]));
    store(out->x[0] + i, x[0]), store(out->x[1] + i, SELECT(turned, x[2], x[1])), store(out->x[2] + i, SELECT(turned, x[1], x[2]));
    store(out->y[0] + i, y[0]), store(out->y[1] + i, SELECT(turned, y[2], y[1])), store(out->y[2] + i, SELECT(turned, y[1], y[2]));
    const mask seen = AND(AND(box, inside), NOT(empty));
    store(out->state + i, SELECT(over, real(2.0f), SELECT(seen, real(1.0f), zero)));
}

static void lanes_setups(const PictureData *picture, patch_batch *b, setup_batch *out)
{
    fill_up(b);
    for (size_t i = 0; i < b->count; i += MGT_LANES) {
        const vec3 image[3] = {load_corner(b->image, 0, i), load_corner(b->image, 1, i), load_corner(b->image, 2, i)};
        set_up(picture, image, out, i);
    }
}

/* ---- tiles ---- */

static void lanes_tile_clear(raster_tile *tile)
{
    memset(tile->inverse_depth, 0, sizeof tile->inverse_depth);
    memset(tile->triangle, 0xff, sizeof tile->triangle);
}

/* The edge function of an edge at the pixels of a tile: 0 or more inside. Its unit is subpixels × pixels. It is rounded down to whole numbers, which keeps its
 * sign. */
typedef struct edge_number {
    int32_t first, right, down; /* value at the tile's first pixel, and changes per pixel to the right and down */
} edge_number;

/* Fills the edge function. If the whole tile lies inside, it is 0 everywhere. False: the whole tile lies outside. Pixels on an edge belong to the triangle if
 * the edge is a top or a left one, so they belong to one of the two triangles that share it. */
static inline bool place_edge(const raster_triangle *t, int from, int to, const raster_tile *tile, edge_number *out)
{
    const int64_t dx = (int64_t)t->x[to] - t->x[from], dy = (int64_t)t->y[to] - t->y[from];
    const int64_t px = (int64_t)tile->x * SUBPIXELS - t->x[from], py = (int64_t)tile->y * SUBPIXELS - t->y[from];
    const bool kept = dy < 0 || (dy == 0 && dx > 0);
    const int64_t first = (dx * py - dy * px - (kept ? 0 : 1)) >> 8;
    const int64_t across = -dy * (tile->width - 1), down = dx * (tile->height - 1);
    if (first + (across > 0 ? across : 0) + (down > 0 ? down : 0) < 0)
        return false;
    const bool inside = first + (across < 0 ? across : 0) + (down < 0 ? down : 0) >= 0;
    *out = inside ? (edge_number){0, 0, 0} : (edge_number){(int32_t)first, (int32_t)-dy, (int32_t)dx};
    return true;
}

/* First pixel, from the tile's first one, whose centre lies at or behind a coordinate in subpixels. */
static inline int32_t first_pixel(int32_t least, int32_t origin)
{
    const int32_t pixel = ((least + SUBPIXELS - 1) >> 8) - origin;
    return pixel > 0 ? pixel : 0;
}

/* Last pixel, from the tile's first one, whose centre lies at or before a coordinate in subpixels. */
static inline int32_t last_pixel(int32_t most, int32_t origin, int32_t size)
{
    const int32_t pixel = (most >> 8) - origin;
    return pixel < size - 1 ? pixel : size - 1;
}

static inline mask load_ints(const int32_t *p)
{
    mask m;
    memcpy(&m, p, sizeof m);
    return m;
}

static inline void store_ints(int32_t *p, mask m) { memcpy(p, &m, sizeof m); }

/* Members of raster_triangle in every lane. */
typedef struct drawn_triangle {
    real inverse_depth, slope_x, slope_y, least, most, triangle;
} drawn_triangle;

static inline void draw_vector(const drawn_triangle *t, raster_tile *tile, size_t at, mask inside, real x, real row)
{
    const real stored = load(tile->inverse_depth + at);
    const real depth = clamp(fma(x, t->slope_x, row), t->least, t->most);
    const mask nearer = AND(inside, depth > stored);
    if (!any_lane(nearer))
        return;
    store(tile->inverse_depth + at, SELECT(nearer, depth, stored));
    store_ints(tile->triangle + at, real_bits(real_select(nearer, t->triangle, real_from_bits(load_ints(tile->triangle + at)))));
}

static inline mask lane_counts(void)
{
    static const int32_t numbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    return load_ints(numbers);
}

static void draw_triangle(raster_tile *tile, const raster_triangle *t)
{
    edge_number edge[3];
    for (int k = 0; k < 3; k++)
        if (!place_edge(t, k, k == 2 ? 0 : k + 1, tile, &edge[k]))
            return;
    const int32_t left = first_pixel(LEAST3(t->x), tile->x), right = last_pixel(MOST3(t->x), tile->x, tile->width);
    const int32_t top = first_pixel(LEAST3(t->y), tile->y), bottom = last_pixel(MOST3(t->y), tile->y, tile->height);
    const float corner_x = (float)t->x[0] * (1.0f / SUBPIXELS), corner_y = (float)t->y[0] * (1.0f / SUBPIXELS);
    const drawn_triangle d = {real(t->inverse_depth), real(t->slope_x), real(t->slope_y),
                              real(t->least),         real(t->most),    real_from_bits((mask){0} + t->triangle)};
    const mask lanes = lane_counts();
    const real first_x = real_from_int(lanes) + ((float)(tile->x + left) - corner_x);
    real below = real((float)(tile->y + top) - corner_y);
    mask number[3], across[3], down[3];
    for (int k = 0; k < 3; k++) {
        number[k] = lanes * edge[k].right + (edge[k].first + left * edge[k].right + top * edge[k].down);
        across[k] = (mask){0} + edge[k].right * MGT_LANES;
        down[k] = (mask){0} + edge[k].down;
    }
    for (int32_t y = top; y <= bottom; y++) {
        const real row = fma(below, d.slope_y, d.inverse_depth);
        const size_t at = (size_t)(y * RASTER_STRIDE);
        mask here[3] = {number[0], number[1], number[2]};
        real x = first_x;
        for (int32_t i = left; i <= right; i += MGT_LANES) {
            /* Lanes beyond `right` lie outside of an edge or in the row's padding. */
            draw_vector(&d, tile, at + (size_t)i, (here[0] | here[1] | here[2]) >= 0, x, row);
            for (int k = 0; k < 3; k++)
                here[k] += across[k];
            x = x + (float)MGT_LANES;
        }
        for (int k = 0; k < 3; k++)
            number[k] += down[k];
        below = below + 1.0f;
    }
}

static void lanes_tile_draw(raster_tile *tile, const raster_triangle *triangles, const uint32_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++)
        draw_triangle(tile, &triangles[list[i]]);
}

static void lanes_tile_row(const raster_tile *tile, int32_t row, float *depth, int32_t *triangle)
{
    const float *inverse = tile->inverse_depth + row * RASTER_STRIDE;
    for (int32_t i = 0; i < tile->width; i += MGT_LANES) {
        const real v = load(inverse + i);
        const mask there = v > real(0.0f);
        store(depth + i, SELECT(there, real(1.0f) / SELECT(there, v, real(1.0f)), real(infinity)));
    }
    memcpy(triangle, tile->triangle + row * RASTER_STRIDE, (size_t)tile->width * sizeof *triangle);
}

const raster_kernels LANES_NAME(MGT_LANES) = {
    lanes_virtual_points, lanes_true_points, lanes_images, lanes_patches, lanes_setups, lanes_tile_clear, lanes_tile_draw, lanes_tile_row,
};
