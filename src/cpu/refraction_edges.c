/* SPDX-License-Identifier: MIT
 * Rays against the few triangles that a pixel of a layer and its neighbours show. */
#include <math.h>

#include "cpu/refraction_state.h"
#include "base/triples.h"

refraction_facet refraction_facet_of(const refraction *r, int32_t triangle, const double from[3])
{
    const world *w = r->world;
    const float *p[3];
    refraction_facet f;
    for (size_t c = 0; c < 3; c++)
        p[c] = w->positions + 3 * (size_t)w->indices[3 * (size_t)triangle + c];
    for (int k = 0; k < 3; k++) {
        f.edges[0][k] = (double)p[1][k] - (double)p[0][k];
        f.edges[1][k] = (double)p[2][k] - (double)p[0][k];
        f.to[k] = from[k] - (double)p[0][k];
    }
    cross3(f.to, f.edges[0], f.turned);
    f.level = dot3(f.edges[1], f.turned);
    return f;
}

double refraction_meet(const refraction_facet *f, const double ray[3])
{
    double across[3];
    cross3(ray, f->edges[1], across);
    const double det = dot3(f->edges[0], across);
    if (fabs(det) < 1e-300)
        return INFINITY;
    const double inverse = 1 / det, u = dot3(f->to, across) * inverse, v = dot3(ray, f->turned) * inverse, along = f->level * inverse;
    return u >= 0 && v >= 0 && u + v <= 1 && along > 0 ? along : INFINITY;
}

size_t refraction_neighbours(const gbuffer *g, size_t element, int32_t triangles[REFRACTION_NEIGHBOURS])
{
    const size_t x = element % g->width, y = element / g->width;
    size_t count = 0;
    for (size_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row < g->height; row++)
        for (size_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column < g->width; column++) {
            const int32_t t = g->triangle[row * g->width + column];
            bool known = t < 0;
            for (size_t k = 0; k < count && !known; k++)
                known = triangles[k] == t;
            if (!known)
                triangles[count++] = t;
        }
    return count;
}

/* Whether an element or one beside it shows nothing. */
static bool by_nothing(const gbuffer *g, size_t element)
{
    const size_t x = element % g->width, y = element / g->width;
    for (size_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row < g->height; row++)
        for (size_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column < g->width; column++)
            if (g->triangle[row * g->width + column] < 0)
                return true;
    return false;
}

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/refraction/edges.k"

static void sharpen_pixel(const refraction *r, tile_objects *o, size_t i)
{
    tile_ends *e = &o->ends;
    const camera_rays *c = &r->camera;
    const double side = r->frame->under ? -1 : 1, along = (double)o->water.along[i];
    const double from[3] = {c->position[0] - r->world->origin[0] + along * (double)o->water.view[0][i],
                            c->position[1] + along * side * (double)o->water.view[1][i],
                            c->position[2] - r->world->origin[1] + along * (double)o->water.view[2][i]};
    const double ray[3] = {(double)e->direction[0][i], (double)e->direction[1][i], (double)e->direction[2][i]};
    const gbuffer *g = r->narrow.layers[e->total[i] > 0];
    int32_t triangles[REFRACTION_NEIGHBOURS];
    const size_t count = refraction_neighbours(g, (size_t)e->pixel[i], triangles);
    double nearest = INFINITY;
    int32_t met = -1;
    for (size_t k = 0; k < count; k++) {
        const refraction_facet f = refraction_facet_of(r, triangles[k], from);
        const double way = refraction_meet(&f, ray);
        if (way < nearest)
            nearest = way, met = triangles[k];
    }
    /* Over the water the sky is all around. */
    const bool open = r->frame->under && e->total[i] == 0;
    if (met < 0 && !open && !by_nothing(g, (size_t)e->pixel[i]))
        return;
    e->triangle[i] = met;
    e->after[i] = met < 0 ? 0 : (float)nearest;
    refraction_spread_again(e, i);
    for (int k = 0; k < 3 && met >= 0; k++)
        e->position[k][i] = (float)(from[k] + nearest * ray[k]);
    e->water[i] = metres_in_water(NULL, r->narrow.data.side, o->water.along[i], e->after[i], e->total[i] > 0);
}

void refraction_sharpen(const refraction *r, tile_objects *o, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        const size_t i = o->list[k];
        if (o->ends.doubt[i] > 0 && o->ends.pixel[i] >= 0 && point_can_be_sharpened(NULL, o->ends.error[i]))
            sharpen_pixel(r, o, i);
    }
}
