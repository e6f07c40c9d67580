/* SPDX-License-Identifier: MIT
 * The kernels of surfaces.k and shown.k for C: one ray at a time, in double precision. Include it after all other headers. */
#ifndef MANGATA_CPU_SURFACE_LANE_H
#define MANGATA_CPU_SURFACE_LANE_H

#include "cpu/refraction_state.h"

#include "kernels/common/prelude_double.h"

enum { KNOWN_FACETS = 32 };

/* The triangles and pixels that a ray has visited. */
typedef struct surface_way {
    int count;                     /* number of elements of `visited` */
    int32_t visited[KNOWN_FACETS]; /* triangles that the ray has been tested against */
    uint64_t perhaps;              /* Bloom filter over `visited`: bit (triangle mod 64) is set */
    int32_t along[SHARP_PLACES];   /* elements of the layer along the ray's image, −1: outside of it; filled by the first ALONG_RAY */
} surface_way;

/* The kernels' data. Members besides `surface` may be NULL in kernels that do not read pixels of a layer. */
struct kernel_context {
    const surface_triangle *surface;
    const refraction *r;
    const gbuffer *layer;
    surface_way *way;
    const int32_t *asked; /* triangles that a place in front of the water is tested against anyway */
    size_t asked_count;
};

KERNEL vec3 vec3_of(const float v[3]) { return vec3((double)v[0], (double)v[1], (double)v[2]); }

KERNEL vec3 SURFACE_CORNER(CTX cx, int triangle, int i) { return vec3_of(cx->surface[triangle].corners[i]); }
KERNEL vec3 SURFACE_NORMAL(CTX cx, int triangle) { return vec3_of(cx->surface[triangle].normal); }
KERNEL int SURFACE_NEIGHBOUR(CTX cx, int triangle, int i) { return cx->surface[triangle].neighbours[i]; }

KERNEL bool IS_TESTED(CTX cx, int triangle)
{
    bool asked = false;
    for (size_t i = 0; i < cx->asked_count && !asked; i++)
        asked = cx->asked[i] == triangle;
    return asked;
}

#define IS_IN_LAYER(cx, number, column, row) ((column) >= 0 && (row) >= 0 && (column) < (cx)->layer->width && (row) < (cx)->layer->height)
#define SHOWN_TRIANGLE(cx, number, column, row) ((cx)->layer->triangle[(size_t)(row) * (cx)->layer->width + (size_t)(column)])

KERNEL bool SURFACE_KNOWN(CTX cx, int triangle)
{
    surface_way *w = cx->way;
    const uint64_t bit = (uint64_t)1 << (triangle & 63);
    for (int i = 0; i < w->count && (w->perhaps & bit); i++)
        if (w->visited[i] == triangle)
            return true;
    if (w->count < KNOWN_FACETS) {
        w->visited[w->count++] = triangle;
        w->perhaps |= bit;
    }
    return false;
}

static void find_along(const struct kernel_context *cx, int layer, vec3 from, vec3 direction, double nearest)
{
    const narrow_scene *n = &cx->r->narrow;
    const double foot_x = (double)n->data.foot_x, foot_z = (double)n->data.foot_z, side = (double)n->data.side;
    const float begin[3] = {(float)(from.x - foot_x), (float)(side * from.y), (float)(from.z - foot_z)};
    const float turn[3] = {(float)direction.x, (float)(side * direction.y), (float)direction.z};
    cx->r->kernels->narrow->along(n, layer, begin, turn, (float)nearest, cx->way->along);
}

static inline vec2 pixel_of_element(const gbuffer *g, int32_t element)
{
    return element < 0 ? vec2(-1.0, -1.0) : vec2((double)(element % (int32_t)g->width), (double)(element / (int32_t)g->width));
}

/* Place 0 is read first, and finds all places. */
#define ALONG_RAY(cx, end, nearest, i) \
    ((i) == 0 ? find_along(cx, (end).layer, (end).from, (end).direction, nearest) : (void)0, pixel_of_element((cx)->layer, (cx)->way->along[i]))

#include "kernels/refraction/shown.k"

#endif
