/* SPDX-License-Identifier: MIT
 * Intersects rays with the few triangles that a pixel of a layer and its neighbours show. */
#include <math.h>

#include "cpu/surface_lane.h"

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

/* Prefetches the triangles that an element and its neighbours show, because they are far apart in memory. */
static void prefetch_neighbours(const refraction *r, const gbuffer *g, size_t element)
{
    int32_t triangles[REFRACTION_NEIGHBOURS];
    const size_t count = refraction_neighbours(g, element, triangles);
    for (size_t k = 0; k < count; k++)
        __builtin_prefetch(&r->surface[triangles[k]]);
}

static void sharpen_pixel(const refraction *r, tile_objects *o, size_t i)
{
    tile_ends *e = &o->ends;
    const camera_rays *c = &r->camera;
    const double side = r->frame->under ? -1 : 1, along = (double)o->met->along[i];
    const int layer = e->total[i] > 0 ? LAYER_REFLECTED : LAYER_REFRACTED;
    const gbuffer *g = r->narrow.layers[e->total[i] > 0];
    double from[3];
    for (int k = 0; k < 3; k++)
        from[k] = e->way[i] > 0 ? (double)e->from[k][i]
                                : c->position[k] - (k == 1 ? 0 : r->world->origin[k / 2]) + along * (k == 1 ? side : 1) * (double)o->met->view[k][i];
    prefetch_neighbours(r, g, (size_t)e->pixel[i]);
    surface_way way;
    way.count = 0;
    way.perhaps = 0;
    const struct kernel_context cx = {.surface = r->surface, .r = r, .layer = g, .way = &way};
    const vec2 pixel = pixel_of_element(g, e->pixel[i]), last = pixel_of_element(g, e->last[i]);
    const DoubtfulEnd end = {.from = vec3(from[0], from[1], from[2]),
                             .direction = vec3((double)e->direction[0][i], (double)e->direction[1][i], (double)e->direction[2][i]),
                             .layer = layer,
                             .column = pixel.x,
                             .row = pixel.y,
                             .last_column = last.x,
                             .last_row = last.y,
                             .error = (double)e->error[i],
                             .after = (double)(e->after[i] - e->way[i])};
    const ShownSurfaces s = surfaces_shown(&cx, end, r->frame->under);
    if (s.stands)
        return;
    e->triangle[i] = s.met;
    refraction_end_at(r, o, i, s.met < 0 ? 0 : (float)s.nearest);
    if (s.met < 0)
        return;
    const vec3 at = add(end.from, scale(end.direction, s.nearest));
    e->position[0][i] = (float)at.x, e->position[1][i] = (float)at.y, e->position[2][i] = (float)at.z;
}

void refraction_sharpen(const refraction *r, tile_objects *o, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (o->ends.doubt[o->list[k]] > 0 && o->ends.pixel[o->list[k]] >= 0)
            sharpen_pixel(r, o, o->list[k]);
}
