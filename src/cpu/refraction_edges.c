/* SPDX-License-Identifier: MIT
 * Rays against the few triangles that a pixel of a layer and its neighbours show. */
#include <math.h>

#include "cpu/refraction_state.h"
#include "base/triples.h"

surface_facet refraction_facet_of(const refraction *r, int32_t triangle, const double from[3])
{
    const surface_triangle *t = &r->surface[triangle];
    surface_facet f;
    for (int k = 0; k < 3; k++) {
        const double first = (double)t->corners[0][k];
        f.edges[0][k] = (double)t->corners[1][k] - first;
        f.edges[1][k] = (double)t->corners[2][k] - first;
        f.to[k] = from[k] - first;
    }
    cross3(f.to, f.edges[0], f.turned);
    f.level = dot3(f.edges[1], f.turned);
    return f;
}

/* Where a ray meets a triangle's plane. */
typedef struct crossing {
    double weight[3]; /* of the corners; negative beyond the edge across */
    double along;     /* multiple of the ray; +inf: nowhere */
} crossing;

static crossing crossing_of(const surface_facet *f, const double ray[3])
{
    double across[3];
    cross3(ray, f->edges[1], across);
    const double det = dot3(f->edges[0], across);
    if (fabs(det) < 1e-300)
        return (crossing){.along = INFINITY};
    const double inverse = 1 / det, u = dot3(f->to, across) * inverse, v = dot3(ray, f->turned) * inverse;
    return (crossing){{1 - u - v, u, v}, f->level * inverse};
}

static bool is_within(const crossing *c) { return c->weight[1] >= 0 && c->weight[2] >= 0 && c->weight[1] + c->weight[2] <= 1; }

double refraction_meet(const surface_facet *f, const double ray[3])
{
    const crossing c = crossing_of(f, ray);
    return c.along > 0 && is_within(&c) ? c.along : INFINITY;
}

/* ---- surfaces ---- */

enum { KNOWN_FACETS = 32 };

/* A ray, and where it meets the surfaces that it follows. */
typedef struct surface_ray {
    const refraction *r;
    double from[3], direction[3]; /* in the world's coordinates */
    double nearest;               /* metres, +inf: nowhere */
    int32_t met;                  /* triangle there, −1: none */
    bool lost;                    /* following a surface ended after SURFACE_STEPS triangles */
    bool open;                    /* a pixel that was asked shows nothing */
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

static bool faces(const surface_ray *s, int32_t triangle)
{
    const float *normal = s->r->surface[triangle].normal;
    return (double)normal[0] * s->direction[0] + (double)normal[1] * s->direction[1] + (double)normal[2] * s->direction[2] < 0;
}

/* The triangle across the edge that the ray passes farthest beyond, if it shows the ray the same side; −1: none. */
static int32_t triangle_towards(const surface_ray *s, int32_t triangle, const crossing *c)
{
    const int32_t *neighbours = s->r->surface[triangle].neighbours;
    const bool facing = faces(s, triangle);
    double least = 0;
    int32_t next = -1;
    for (int corner = 0; corner < 3; corner++) {
        const int32_t across = neighbours[corner == 2 ? 0 : corner + 1];
        if (c->weight[corner] < least && across >= 0 && faces(s, across) == facing)
            least = c->weight[corner], next = across;
    }
    return next;
}

/* Follows the surface that a triangle near the ray belongs to, from triangle to triangle across the edges that the ray passes beyond, to the one that it
 * meets; outlines and borders end the way, and triangles whose way is known. The nearest of all surfaces that were followed counts. */
static void follow_surface(surface_ray *s, int32_t triangle)
{
    int32_t before = -1;
    for (int step = 0; step < SURFACE_STEPS; step++) {
        if (was_visited(s, triangle))
            return;
        const surface_facet f = refraction_facet_of(s->r, triangle, s->from);
        const crossing c = crossing_of(&f, s->direction);
        if (!(c.along > 0 && c.along < INFINITY))
            return;
        const bool within = is_within(&c);
        const int32_t next = within ? -1 : triangle_towards(s, triangle, &c);
        const bool between = next >= 0 && next == before; /* both, by rounding */
        if ((within || between) && c.along < s->nearest)
            s->nearest = c.along, s->met = triangle;
        if (next < 0 || between)
            return;
        before = triangle;
        triangle = next;
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

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/refraction/edges.k"

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
    const double foot[3] = {(double)r->narrow.data.foot_x, 0, (double)r->narrow.data.foot_z};
    float from[3], direction[3];
    for (int k = 0; k < 3; k++) {
        const double up = k == 1 ? (double)r->narrow.data.side : 1;
        from[k] = (float)(up * (s->from[k] - foot[k]));
        direction[k] = (float)(up * s->direction[k]);
    }
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
    surface_ray s = {.r = r, .nearest = INFINITY, .met = -1};
    for (int k = 0; k < 3; k++) {
        s.from[k] = e->way[i] > 0 ? (double)e->from[k][i]
                                  : c->position[k] - (k == 1 ? 0 : r->world->origin[k / 2]) + along * (k == 1 ? side : 1) * (double)o->met->view[k][i];
        s.direction[k] = (double)e->direction[k][i];
    }
    int32_t triangles[REFRACTION_NEIGHBOURS];
    const size_t count = refraction_neighbours(g, (size_t)e->pixel[i], triangles);
    for (size_t k = 0; k < count; k++) /* they lie far apart */
        __builtin_prefetch(&r->surface[triangles[k]]);
    for (size_t k = 0; k < count; k++)
        follow_surface(&s, triangles[k]);
    if (s.lost && point_is_near(NULL, e->error[i]) && (double)(e->after[i] - e->way[i]) < s.nearest)
        return;
    /* Over the water the sky is all around. */
    s.open = (r->frame->under && e->total[i] == 0) || by_nothing(g, (size_t)e->pixel[i]);
    if (point_is_lost(NULL, e->error[i]))
        follow_lost(&s, g, e->pixel[i], e->last[i], e->total[i] > 0);
    if (s.met < 0 && !s.open)
        return;
    e->triangle[i] = s.met;
    refraction_end_at(r, o, i, s.met < 0 ? 0 : (float)s.nearest);
    for (int k = 0; k < 3 && s.met >= 0; k++)
        e->position[k][i] = (float)(s.from[k] + s.nearest * s.direction[k]);
}

void refraction_sharpen(const refraction *r, tile_objects *o, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (o->ends.doubt[o->list[k]] > 0 && o->ends.pixel[o->list[k]] >= 0)
            sharpen_pixel(r, o, o->list[k]);
}
