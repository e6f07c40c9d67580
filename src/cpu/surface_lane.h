/* SPDX-License-Identifier: MIT
 * The kernels of rays against the triangles of surfaces, for C: a ray at a time, in double precision. Include it after all other headers. */
#ifndef MANGATA_CPU_SURFACE_LANE_H
#define MANGATA_CPU_SURFACE_LANE_H

#include "cpu/refraction_state.h"

#include "kernels/common/prelude_double.h"

enum { KNOWN_FACETS = 32 };

/* What a ray came by. */
typedef struct surface_way {
    int count;
    int32_t visited[KNOWN_FACETS]; /* triangles that it met */
    uint64_t perhaps;              /* a filter: the bits that the numbers of `visited` set */
    int32_t along[SHARP_PLACES];   /* elements of its layer along its image, −1 outside; once they are asked for */
} surface_way;

/* What the kernels can reach through their accessors. */
struct kernel_context {
    const surface_triangle *surface;
    const refraction *r; /* this and what follows: only where pixels of a layer are asked */
    const gbuffer *layer;
    surface_way *way;
    const int32_t *asked; /* of a place in front of the water: the triangles that it asks */
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

/* All are found when the first one is asked for. */
#define ALONG_RAY(cx, end, nearest, i) \
    ((i) == 0 ? find_along(cx, (end).layer, (end).from, (end).direction, nearest) : (void)0, pixel_of_element((cx)->layer, (cx)->way->along[i]))

#include "kernels/refraction/shown.k"

#endif
