/* SPDX-License-Identifier: MIT
 * Objects in front of the water, with smooth edges.
 *
 * The front layer has one point per pixel. At edges, where a neighbour does not continue the pixel's surface, and along waterlines, eight rays through the
 * pixel are intersected with the surfaces of the triangles that it and its neighbours show, and with the water's plane. */
#include <math.h>
#include <string.h>

#include "base/triples.h"
#include "cpu/surface_lane.h"

/* A pixel of the tile. */
typedef struct front_pixel {
    const refraction *r;
    uint32_t x, y;  /* place in the image */
    size_t element; /* element of the front layer */
    size_t i;       /* index in the tile */
    bool dry;       /* the last hit lies inside of a dry hull */
    double eye[3];
    size_t candidate_count;
    int32_t candidates[REFRACTION_NEIGHBOURS];
    Facet facets[REFRACTION_NEIGHBOURS]; /* the candidates for rays from the eye */
} front_pixel;

static void ray_through(const refraction *r, double x, double y, double ray[3])
{
    const camera_rays *c = &r->camera;
    for (int k = 0; k < 3; k++)
        ray[k] = c->corner[k] + x * c->right[k] + y * c->down[k];
}

/* ---- points to shade ---- */

static void flush(const refraction *r, tile_objects *o, size_t *count)
{
    refraction_shade(r, o, *count);
    for (size_t j = 0; j < *count; j++)
        for (int k = 0; k < 3; k++)
            o->color[k][o->list[j]] += o->rgb[3 * j + (size_t)k];
    *count = 0;
}

static void add_point(const front_pixel *p, const double ray[3], double along, int32_t triangle, tile_objects *o, size_t *count)
{
    const refraction *r = p->r;
    const double length = sqrt(dot3(ray, ray));
    tile_ends *e = &o->ends;
    if (*count == TILE_PIXELS)
        flush(r, o, count);
    const size_t at = (*count)++;
    o->list[at] = (uint16_t)p->i;
    e->triangle[at] = triangle;
    for (int k = 0; k < 3; k++) {
        e->position[k][at] = (float)(p->eye[k] + along * ray[k]);
        e->direction[k][at] = (float)(ray[k] / length);
    }
    e->before[at] = (float)(along * length);
    const float pixel = e->before[at] * r->frame->data.pixel_angle;
    e->spread[0][at] = e->spread[2][at] = EDGE_PART * pixel * pixel / 12;
    e->spread[1][at] = 0;
    e->after[at] = 0;
    e->gain[at] = 1;
    e->water[at] = p->dry ? IN_DRY_HULL : r->frame->under ? e->before[at] : 0;
    o->share[p->i] += 1;
    const float *plane = r->planes + 4 * (size_t)triangle;
    const double normal[3] = {(double)plane[0], (double)plane[1], (double)plane[2]};
    const float towards = dot3(normal, ray) > 0 ? -1 : 1;
    o->along[p->i] = e->before[at];
    for (int k = 0; k < 3; k++)
        o->normal[k][p->i] = towards * plane[k];
}

/* ---- edges ---- */

static void look_at_pixel(const refraction *r, const tile_offset *at, size_t i, front_pixel *p)
{
    const gbuffer *g = &r->direct.front;
    const double *position = r->camera.position;
    p->r = r, p->i = i;
    p->x = at->column + (uint32_t)i % TILE_WIDTH, p->y = at->row + (uint32_t)i / TILE_WIDTH;
    p->element = (size_t)(g->top + p->y) * g->width + g->left + p->x;
    p->eye[0] = position[0] - r->world->origin[0], p->eye[1] = position[1], p->eye[2] = position[2] - r->world->origin[1];
    p->candidate_count = refraction_neighbours(g, p->element, p->candidates);
    const struct kernel_context cx = {.surface = r->surface};
    for (size_t k = 0; k < p->candidate_count; k++)
        p->facets[k] = facet_of(&cx, p->candidates[k], vec3(p->eye[0], p->eye[1], p->eye[2]));
}

/* Multiple of a ray at which it meets the surface's tangent plane in pixel i of the tile. */
static double meet_water(const tile_water *w, size_t i, bool under, const double ray[3])
{
    const double up = under ? -1 : 1;
    const vec3 normal = vec3((double)w->normal[0][i], up * (double)w->normal[1][i], (double)w->normal[2][i]);
    const vec3 view = vec3((double)w->view[0][i], up * (double)w->view[1][i], (double)w->view[2][i]);
    return meet_surface(NULL, w->share[i] > 0, normal, view, (double)w->along[i], vec3(ray[0], ray[1], ray[2]));
}

/* Dry level of the side of a triangle that a ray meets. */
static double level_of(const refraction *r, int32_t triangle, const double ray[3])
{
    const float *levels = r->front.dry, *plane = r->planes + 4 * (size_t)triangle;
    const double facing = (double)plane[0] * ray[0] + (double)plane[1] * ray[1] + (double)plane[2] * ray[2];
    return levels ? level_faced(NULL, (double)levels[2 * (size_t)triangle], (double)levels[2 * (size_t)triangle + 1], facing) : -INFINITY;
}

/* The triangle that the neighbour nearest to a place of the pixel shows; −1: nothing. */
static int32_t triangle_beside(const front_pixel *p, vec2 place)
{
    const gbuffer *g = &p->r->direct.front;
    const vec2 side = edge_side(NULL, place);
    return g->triangle[(size_t)((ptrdiff_t)p->element + (ptrdiff_t)side.x + (ptrdiff_t)g->width * (ptrdiff_t)side.y)];
}

/* The hit in front of the water of the ray through a place of the pixel. `triangle` −1: there is none. */
static inline FrontHit hit_in_front(front_pixel *p, const tile_water *water, vec2 place, double ray[3])
{
    const refraction *r = p->r;
    const gbuffer *g = &r->direct.front;
    const struct kernel_context cx = {.surface = r->surface, .asked = p->candidates, .asked_count = p->candidate_count};
    const FrontHit none = {-1, INFINITE};
    FrontHit hit = none;
    ray_through(r, p->x + (double)place.x, p->y + (double)place.y, ray);
    for (size_t k = 0; k < p->candidate_count; k++)
        hit = nearer_hit(&cx, hit, p->candidates[k], p->facets[k], vec3(p->eye[0], p->eye[1], p->eye[2]), vec3(ray[0], ray[1], ray[2]));
    const int32_t own = g->triangle[p->element];
    if (own >= 0 && shows_pixel(NULL, hit, own, triangle_beside(p, place)))
        hit = (FrontHit){own, (double)g->depth[p->element]};
    if (hit.triangle < 0)
        return none;
    const double along = meet_water(water, p->i, r->frame->under, ray), level = level_of(r, hit.triangle, ray);
    p->dry = is_inside_dry(NULL, (double)(float)(p->eye[1] + hit.along * ray[1]), level);
    return stands_in_front(NULL, hit.along, along, (double)(float)(p->eye[1] + along * ray[1]), level) ? hit : none;
}

bool refraction_is_hidden(const refraction *r, const tile_offset *at, const tile_objects *o, size_t i, float x, float y)
{
    if (!o->at_front[i] || !(o->share[i] > 0))
        return false;
    front_pixel p;
    look_at_pixel(r, at, i, &p);
    double ray[3];
    return hit_in_front(&p, &o->water, vec2((double)x, (double)y), ray).triangle >= 0;
}

static void see_edge(front_pixel *p, tile_objects *o, size_t *count)
{
    for (int place = 0; place < EDGE_PLACES; place++) {
        double ray[3];
        const FrontHit hit = hit_in_front(p, &o->water, edge_place(NULL, place), ray);
        if (hit.triangle >= 0)
            add_point(p, ray, hit.along, hit.triangle, o, count);
    }
}

static size_t list_inside(const tile_front *front, tile_objects *o)
{
    size_t count = 0;
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        o->share[i] = front->kind[i] == FRONT_INSIDE;
        o->list[count] = (uint16_t)i;
        count += front->kind[i] == FRONT_INSIDE;
    }
    return count;
}

static void see_edges(const refraction *r, const tile_offset *at, const tile_front *front, tile_objects *o)
{
    size_t count = 0;
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        o->at_front[i] = front->kind[i] == FRONT_EDGE;
        if (!o->at_front[i])
            continue;
        front_pixel p;
        look_at_pixel(r, at, i, &p);
        see_edge(&p, o, &count);
    }
    if (count > 0)
        flush(r, o, &count);
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        if (front->kind[i] != FRONT_EDGE)
            continue;
        for (int k = 0; k < 3 && o->share[i] > 0; k++)
            o->color[k][i] /= o->share[i];
        o->share[i] /= EDGE_PLACES;
        if (o->share[i] < FRONT_SHOWS)
            o->along[i] = INFINITY;
    }
}

void refraction_front(const refraction *r, uint32_t column, uint32_t row, tile_objects *o)
{
    const tile_offset at = {column, row, 0, 0};
    tile_front front = {.along = o->along, .normal = o->normal};
    r->kernels->front->points(&r->front, &at, &o->water, &front, &o->ends);
    memset(o->color, 0, sizeof o->color);
    const size_t inside = list_inside(&front, o);
    if (inside > 0) {
        refraction_shade_listed(r, o, inside);
        refraction_spread(o, inside, o->color);
    }
    see_edges(r, &at, &front, o);
}
