/* SPDX-License-Identifier: MIT
 * Edges of layers, and points of the front layer between them, compiled once per lane width (MGT_LANES).
 *
 * Whatever the width, a pixel sees the same operations in the same order: the bits do not depend on it. */
#include "cpu/kernel_context.h"
#include "cpu/front_lanes.h"

#include <math.h>
#include <string.h>

#include "frame/atmosphere.h"

#define LANES_NAME_(n) front_kernels_##n
#define LANES_NAME(n) LANES_NAME_(n)

static const float infinity = INFINITY;

#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"
#include "kernels/refraction/edges.k"

/* ---- edges ---- */

static mask load_whole(const int32_t *p)
{
    mask m;
    memcpy(&m, p, sizeof m);
    return m;
}

static void store_bits(uint8_t *out, mask m)
{
    float lanes[MGT_LANES];
    store(lanes, SELECT(m, real(1.0f), real(0.0f)));
    for (int i = 0; i < MGT_LANES; i++)
        out[i] = lanes[i] > 0;
}

static mask load_bits(const uint8_t *bits)
{
    float lanes[MGT_LANES];
    for (int i = 0; i < MGT_LANES; i++)
        lanes[i] = bits[i];
    return load(lanes) > real(0.0f);
}

static vec3 normal_of(const float *planes, mask triangle)
{
    const mask at = 4 * (triangle & ~(triangle >> 31));
    return vec3(gather_floats(planes, at), gather_floats(planes + 1, at), gather_floats(planes + 2, at));
}

/* Dry level of the side of each lane's triangle that its ray meets. */
static real levels_of(const float *dry, mask triangle, vec3 normal, vec3 ray)
{
    if (!dry)
        return real(0.0f) - real(infinity);
    const mask at = 2 * (triangle & ~(triangle >> 31));
    return level_faced(NULL, gather_floats(dry, at), gather_floats(dry + 1, at), dot(normal, ray));
}

static void lanes_breaks(const gbuffer *g, const float *planes, float focal, uint32_t row, uint8_t *out)
{
    memset(out, 1, g->width);
    if (row == 0 || row + 1 >= g->height)
        return;
    const ptrdiff_t width = (ptrdiff_t)g->width, beside[4] = {-1, 1, -width, width};
    for (ptrdiff_t i = 0; i < width; i += MGT_LANES) {
        const float *d = g->depth + row * (size_t)width + i;
        const int32_t *t = g->triangle + row * (size_t)width + i;
        const mask here = load_whole(t);
        const real inverse = 1.0f / load(d);
        real others[4];
        mask broken = lane_numbers() < real(0.0f);
        for (int k = 0; k < 4; k++) {
            /* The first and the last pixel of a row read a pixel of another row here. Both are set to 1 below. */
            const mask there = load_whole(t + beside[k]);
            const mask differ = AND(here != there, AND(here >= 0, there >= 0));
            others[k] = 1.0f / load(d + beside[k]);
            if (any_lane(differ))
                broken = OR(broken, AND(differ, planes_bend(NULL, normal_of(planes, here), normal_of(planes, there))));
        }
        store_bits(out + i, OR(broken, depth_breaks(NULL, inverse, others[0], others[1], others[2], others[3], focal)));
    }
    out[0] = out[width - 1] = 1;
}

/* Objects of triangles. Triangles below 0 get any object. */
static mask object_of(const uint32_t *objects, mask triangle) { return gather_ints((const int *)objects, triangle & ~(triangle >> 31)); }

static void lanes_edges(const gbuffer *g, const float *planes, const uint32_t *objects, uint32_t row, uint8_t *out)
{
    const ptrdiff_t width = (ptrdiff_t)g->width, beside[4] = {-1, 1, -width, width};
    for (ptrdiff_t i = 0; i < width; i += MGT_LANES) {
        const float *d = g->depth + row * (size_t)width + i;
        const int32_t *t = g->triangle + row * (size_t)width + i;
        const mask here = load_whole(t);
        const real depth = load(d);
        mask edge = lane_numbers() < real(0.0f);
        for (int k = 0; k < 4; k++) {
            const mask there = load_whole(t + beside[k]), differ = here != there;
            if (!any_lane(differ))
                continue;
            const mask goes_on = surface_goes_on(NULL, object_of(objects, here) == object_of(objects, there), normal_of(planes, here), normal_of(planes, there),
                                                 depth, load(d + beside[k]));
            edge = OR(edge, AND(differ, NOT(AND(goes_on, AND(here >= 0, there >= 0)))));
        }
        store_bits(out + i, edge);
    }
}

/* ---- points ---- */

static vec3 ray_through(const front_scene *n, real x, real y)
{
    return vec3(fma(x, real(n->right[0]), fma(y, real(n->down[0]), real(n->corner[0]))),
                fma(x, real(n->right[1]), fma(y, real(n->down[1]), real(n->corner[1]))),
                fma(x, real(n->right[2]), fma(y, real(n->down[2]), real(n->corner[2]))));
}

static vec3 load_vector(const float (*planes)[TILE_PIXELS], size_t i, float up)
{
    return vec3(load(planes[0] + i), load(planes[1] + i) * up, load(planes[2] + i));
}

static void store_vector(float (*planes)[TILE_PIXELS], size_t i, vec3 v)
{
    store(planes[0] + i, v.x);
    store(planes[1] + i, v.y);
    store(planes[2] + i, v.z);
}

static void lanes_points(const front_scene *n, const tile_offset *at, const tile_water *water, tile_front *out, tile_ends *ends)
{
    memset(out->kind, FRONT_NOTHING, sizeof out->kind);
    const float up = n->under ? -1 : 1;
    const gbuffer *g = n->layer;
    for (size_t i = 0; i < TILE_PIXELS; i += MGT_LANES) {
        const uint32_t x = at->column + (uint32_t)(i % TILE_WIDTH), y = at->row + (uint32_t)(i / TILE_WIDTH);
        store(out->along + i, real(infinity));
        if (x >= n->columns || y >= n->rows)
            continue;
        const size_t element = (size_t)(g->top + y) * g->width + g->left + x;
        const mask image = lane_numbers() + (float)x < real((float)n->columns);
        const mask triangle = load_whole(g->triangle + element), shown = AND(image, triangle >= 0);
        mask edge = AND(image, load_bits(n->edges + element));
        if (!any_lane(OR(shown, edge)))
            continue;
        const real depth = SELECT(shown, load(g->depth + element), real(1.0f));
        const vec3 ray = ray_through(n, lane_numbers() + (float)x, real((float)y));
        const real length = sqrt(length_squared(ray)), along = depth * length;
        const mask wet = load(water->share + i) > real(0.0f);
        const vec3 surface = load_vector(water->normal, i, up), view = load_vector(water->view, i, up);
        edge = OR(edge, AND(AND(shown, wet), front_waterline(NULL, along, load(water->along + i), load(water->view[1] + i), n->pixel_angle)));
        const real met = meet_surface(NULL, wet, surface, view, load(water->along + i), ray);
        const vec3 normal = normal_of(n->planes, triangle);
        const real level = levels_of(n->dry, triangle, normal, ray);
        const mask inside = AND(AND(shown, NOT(edge)), stands_in_front(NULL, depth, met, fma(met, ray.y, real(n->foot[1])), level));
        float kinds[MGT_LANES];
        store(kinds, SELECT(inside, real(1.0f), SELECT(edge, real(2.0f), real(0.0f))));
        for (int lane = 0; lane < MGT_LANES; lane++)
            out->kind[i + (size_t)lane] = (uint8_t)kinds[lane];
        if (!any_lane(inside))
            continue;
        store(out->along + i, SELECT(inside, along, real(infinity)));
        store_vector(out->normal, i, scale(normal, SELECT(dot(normal, ray) > real(0.0f), real(-1.0f), real(1.0f))));
        memcpy(ends->triangle + i, &triangle, sizeof triangle);
        const vec3 position = add(vec3(n->foot[0], n->foot[1], n->foot[2]), scale(ray, depth));
        store_vector(ends->position, i, position);
        store_vector(ends->direction, i, scale(ray, real(1.0f) / length));
        const real variance = (n->pixel_angle * n->pixel_angle / 12) * along * along;
        store_vector(ends->spread, i, vec3(variance, real(0.0f), variance));
        store(ends->before + i, along);
        store(ends->after + i, real(0.0f));
        store(ends->gain + i, real(1.0f));
        store(ends->water + i, SELECT(is_inside_dry(NULL, position.y, level), real(IN_DRY_HULL), n->under ? along : real(0.0f)));
    }
}

const front_kernels LANES_NAME(MGT_LANES) = {lanes_breaks, lanes_edges, lanes_points};
