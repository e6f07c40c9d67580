/* SPDX-License-Identifier: MIT
 * Rays against the few triangles that a pixel of a layer and its neighbours show. */
#include <math.h>

#include "cpu/surface_lane.h"

/* ---- surfaces ---- */

enum { KNOWN_FACETS = 32 };

/* A ray, and where it meets the surfaces that it follows. */
typedef struct surface_ray {
    const refraction *r;
    vec3 from, direction; /* in the world's coordinates */
    double nearest;       /* metres, +inf: nowhere */
    int32_t met;          /* triangle there, −1: none */
    bool lost;            /* following a surface ended after SURFACE_STEPS triangles */
    bool open;            /* a pixel that was asked shows nothing */
    int count;
    int32_t visited[KNOWN_FACETS]; /* triangles that it came by … */
    uint64_t perhaps;              /* … and the bits that their numbers share */
} surface_ray;

static bool was_visited(surface_ray *s, int32_t triangle)
{
    const uint64_t bit = (uint64_t)1 << (triangle & 63);
    for (int i = 0; i < s->count && (s->perhaps & bit); i++)
        if (s->visited[i] == triangle)
            return true;
    if (s->count < KNOWN_FACETS) {
        s->visited[s->count++] = triangle;
        s->perhaps |= bit;
    }
    return false;
}

/* Follows the surface that a triangle near the ray belongs to, up to the triangle that it meets; triangles whose way is known end the way. The nearest of
 * all surfaces that were followed counts. */
static void follow_surface(surface_ray *s, int32_t triangle)
{
    const struct kernel_context cx = {s->r->surface};
    int32_t before = -1;
    for (int i = 0; i < SURFACE_STEPS; i++) {
        if (was_visited(s, triangle))
            return;
        const SurfaceStep step = surface_step(&cx, triangle, before, s->from, s->direction);
        if (step.along < s->nearest)
            s->nearest = step.along, s->met = triangle;
        if (step.next < 0)
            return;
        before = triangle;
        triangle = step.next;
    }
    s->lost = true;
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

static void follow_shown(surface_ray *s, const gbuffer *g, double column, double row)
{
    const int32_t triangle = g->triangle[(size_t)row * g->width + (size_t)column];
    if (triangle >= 0)
        follow_surface(s, triangle);
    s->open |= triangle < 0;
}

/* Those that pixels along the ray's image show, up to the point that it is known to meet. */
static void follow_along(surface_ray *s, const gbuffer *g, bool mirrored)
{
    const refraction *r = s->r;
    const double foot_x = (double)r->narrow.data.foot_x, foot_z = (double)r->narrow.data.foot_z, side = (double)r->narrow.data.side;
    const float from[3] = {(float)(s->from.x - foot_x), (float)(side * s->from.y), (float)(s->from.z - foot_z)};
    const float direction[3] = {(float)s->direction.x, (float)(side * s->direction.y), (float)s->direction.z};
    int32_t pixels[SHARP_PLACES];
    r->kernels->narrow->along(&r->narrow, mirrored ? LAYER_REFLECTED : LAYER_REFRACTED, from, direction, (float)s->nearest, pixels);
    for (int k = 0; k < SHARP_PLACES; k++)
        if (pixels[k] >= 0)
            follow_shown(s, g, pixels[k] % g->width, pixels[k] / g->width);
}

/* Follows the surfaces that pixels around this one show: a surface that a nearer one hides here may be seen beside it. */
static void follow_around(surface_ray *s, const gbuffer *g, size_t pixel)
{
    for (int k = 0; k < AROUND_PLACES; k++) {
        const vec2 place = place_around(NULL, k);
        const double column = (double)(pixel % g->width) + (double)place.x, row = (double)(pixel / g->width) + (double)place.y;
        if (column >= 0 && column < g->width && row >= 0 && row < g->height)
            follow_shown(s, g, column, row);
    }
}

/* Follows the surfaces along the image of a ray whose search did not converge, then those around it. An empty pixel of the mirrored layer does not set `open`:
 * that picture may end before the scene does. */
static void follow_lost(surface_ray *s, const gbuffer *g, int32_t pixel, int32_t last, bool mirrored)
{
    const bool open = s->open;
    follow_along(s, g, mirrored);
    if (last >= 0)
        follow_shown(s, g, (double)(last % (int32_t)g->width), (double)(last / (int32_t)g->width));
    if (s->met < 0 && !mirrored)
        follow_around(s, g, (size_t)pixel);
    s->open = open || (s->open && !s->lost && !mirrored);
}

static void sharpen_pixel(const refraction *r, tile_objects *o, size_t i)
{
    tile_ends *e = &o->ends;
    const camera_rays *c = &r->camera;
    const double side = r->frame->under ? -1 : 1, along = (double)o->met->along[i];
    const gbuffer *g = r->narrow.layers[e->total[i] > 0];
    double from[3];
    for (int k = 0; k < 3; k++)
        from[k] = e->way[i] > 0 ? (double)e->from[k][i]
                                : c->position[k] - (k == 1 ? 0 : r->world->origin[k / 2]) + along * (k == 1 ? side : 1) * (double)o->met->view[k][i];
    surface_ray s = {.r = r, .from = vec3(from[0], from[1], from[2]), .nearest = INFINITY, .met = -1};
    s.direction = vec3((double)e->direction[0][i], (double)e->direction[1][i], (double)e->direction[2][i]);
    int32_t triangles[REFRACTION_NEIGHBOURS];
    const size_t count = refraction_neighbours(g, (size_t)e->pixel[i], triangles);
    for (size_t k = 0; k < count; k++) /* they lie far apart */
        __builtin_prefetch(&r->surface[triangles[k]]);
    for (size_t k = 0; k < count; k++)
        follow_surface(&s, triangles[k]);
    if (s.lost && point_is_near(NULL, (double)e->error[i]) && (double)(e->after[i] - e->way[i]) < s.nearest)
        return;
    /* Over the water the sky is all around. */
    s.open = (r->frame->under && e->total[i] == 0) || by_nothing(g, (size_t)e->pixel[i]);
    if (point_is_lost(NULL, (double)e->error[i]))
        follow_lost(&s, g, e->pixel[i], e->last[i], e->total[i] > 0);
    if (s.met < 0 && !s.open)
        return;
    e->triangle[i] = s.met;
    refraction_end_at(r, o, i, s.met < 0 ? 0 : (float)s.nearest);
    if (s.met < 0)
        return;
    const vec3 end = add(s.from, scale(s.direction, s.nearest));
    e->position[0][i] = (float)end.x, e->position[1][i] = (float)end.y, e->position[2][i] = (float)end.z;
}

void refraction_sharpen(const refraction *r, tile_objects *o, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (o->ends.doubt[o->list[k]] > 0 && o->ends.pixel[o->list[k]] >= 0)
            sharpen_pixel(r, o, o->list[k]);
}
