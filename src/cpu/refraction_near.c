/* SPDX-License-Identifier: MIT
 * Objects in front of the water, with smooth edges.
 *
 * The near layer knows what the centre of each pixel sees. At edges, where a neighbour sees something else, and along waterlines, eight places of the
 * pixel ask the triangles that it and its neighbours see, and the surface's plane. */
#include <math.h>
#include <string.h>

#include "cpu/refraction_state.h"

enum { PLACES = 8, MOST_CANDIDATES = 9 };

/* One in each row and column of an 8 × 8 grid, from the pixel's centre. */
static const double place_x[PLACES] = {-7 / 16.0, -5 / 16.0, -3 / 16.0, -1 / 16.0, 1 / 16.0, 3 / 16.0, 5 / 16.0, 7 / 16.0};
static const double place_y[PLACES] = {-1 / 16.0, 5 / 16.0, -5 / 16.0, 3 / 16.0, -7 / 16.0, 7 / 16.0, 1 / 16.0, -3 / 16.0};

/* The tile's pixel at hand. */
typedef struct near_pixel {
    const refraction *r;
    uint32_t x, y;  /* in the image */
    size_t element; /* of the near layer */
    size_t i;       /* in the tile */
    size_t candidate_count;
    int32_t candidates[MOST_CANDIDATES];
} near_pixel;

static void ray_through(const refraction *r, double x, double y, double ray[3])
{
    const camera_rays *c = &r->camera;
    for (int k = 0; k < 3; k++)
        ray[k] = c->corner[k] + x * c->right[k] + y * c->down[k];
}

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross3(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Multiple of the camera's ray at which it meets a triangle; +inf: it does not. */
static double meet_triangle(const refraction *r, int32_t triangle, const double ray[3])
{
    const world *w = r->world;
    const double eye[3] = {r->camera.position[0] - w->origin[0], r->camera.position[1], r->camera.position[2] - w->origin[1]};
    double p[3][3], e1[3], e2[3], from[3], across[3], turned[3];
    for (size_t c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            p[c][k] = (double)w->positions[3 * (size_t)w->indices[3 * (size_t)triangle + c] + (size_t)k];
    for (int k = 0; k < 3; k++)
        e1[k] = p[1][k] - p[0][k], e2[k] = p[2][k] - p[0][k], from[k] = eye[k] - p[0][k];
    cross3(ray, e2, across);
    const double det = dot3(e1, across);
    if (fabs(det) < 1e-300)
        return INFINITY;
    const double u = dot3(from, across) / det;
    cross3(from, e1, turned);
    const double v = dot3(ray, turned) / det, along = dot3(e2, turned) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && along > 0 ? along : INFINITY;
}

/* Multiple of a ray through the pixel at which it meets the plane of the surface there. */
static double meet_water(const tile_objects *o, size_t i, bool under, const double ray[3])
{
    const tile_water *w = &o->water;
    if (!(w->share[i] > 0))
        return INFINITY;
    const double up = under ? -1 : 1;
    const double normal[3] = {(double)w->normal[0][i], up * (double)w->normal[1][i], (double)w->normal[2][i]};
    const double view[3] = {(double)w->view[0][i], up * (double)w->view[1][i], (double)w->view[2][i]};
    const double closing = dot3(normal, ray);
    return closing < 0 ? (double)w->along[i] * dot3(normal, view) / closing : INFINITY;
}

/* ---- what is shaded ---- */

static void flush(const refraction *r, tile_objects *o, size_t *count)
{
    refraction_shade(r, o, *count);
    for (size_t j = 0; j < *count; j++)
        for (int k = 0; k < 3; k++)
            o->color[k][o->list[j]] += o->rgb[3 * j + (size_t)k];
    *count = 0;
}

static void add_point(const near_pixel *p, const double ray[3], double along, int32_t triangle, tile_objects *o, size_t *count)
{
    const refraction *r = p->r;
    const camera_rays *c = &r->camera;
    const double foot[3] = {c->position[0] - r->world->origin[0], c->position[1], c->position[2] - r->world->origin[1]};
    const double length = sqrt(dot3(ray, ray));
    tile_ends *e = &o->ends;
    if (*count == TILE_PIXELS)
        flush(r, o, count);
    const size_t at = (*count)++;
    o->list[at] = (uint16_t)p->i;
    e->triangle[at] = triangle;
    for (int k = 0; k < 3; k++) {
        e->position[k][at] = (float)(foot[k] + along * ray[k]);
        e->direction[k][at] = (float)(ray[k] / length);
        e->slopes[k][at] = 0;
    }
    e->before[at] = (float)(along * length);
    e->after[at] = 0;
    e->water[at] = r->frame->under ? e->before[at] : 0;
    o->share[p->i] += 1;
    const float *plane = r->planes + 4 * (size_t)triangle;
    const double normal[3] = {(double)plane[0], (double)plane[1], (double)plane[2]};
    const float towards = dot3(normal, ray) > 0 ? -1 : 1;
    o->along[p->i] = e->before[at];
    for (int k = 0; k < 3; k++)
        o->normal[k][p->i] = towards * plane[k];
}

/* ---- edges ---- */

static bool like(const refraction *r, size_t a, size_t b)
{
    const gbuffer *g = &r->direct.near;
    const int32_t s = g->triangle[a], t = g->triangle[b];
    if (s == t)
        return true;
    if (s < 0 || t < 0)
        return false;
    const float *p = r->planes + 4 * (size_t)s, *q = r->planes + 4 * (size_t)t;
    const bool level = fabsf(p[0] * q[0] + p[1] * q[1] + p[2] * q[2]) > 0.9f;
    return level && fabsf(g->depth[a] - g->depth[b]) < 0.05f * g->depth[a];
}

static bool is_edge(const near_pixel *p, const tile_objects *o)
{
    const gbuffer *g = &p->r->direct.near;
    const size_t row = g->width, at = p->element;
    if (!like(p->r, at, at - 1) || !like(p->r, at, at + 1) || !like(p->r, at, at - row) || !like(p->r, at, at + row))
        return true;
    if (g->triangle[at] < 0 || !(o->water.share[p->i] > 0))
        return false;
    /* A waterline: within a pixel or two the object may be on the other side of the surface. */
    double ray[3];
    ray_through(p->r, p->x, p->y, ray);
    const double object = (double)g->depth[at] * sqrt(dot3(ray, ray)), water = (double)o->water.along[p->i];
    const double pixel = water * (double)p->r->frame->data.pixel_angle / fmax(-(double)o->water.view[1][p->i], 0.02);
    return fabs(object - water) < 2 * pixel;
}

static void list_candidates(near_pixel *p)
{
    const gbuffer *g = &p->r->direct.near;
    p->candidate_count = 0;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int32_t t = g->triangle[(size_t)((ptrdiff_t)p->element + dy * (ptrdiff_t)g->width + dx)];
            bool known = t < 0;
            for (size_t k = 0; k < p->candidate_count && !known; k++)
                known = p->candidates[k] == t;
            if (!known)
                p->candidates[p->candidate_count++] = t;
        }
}

/* Whether the place lies between two pixels that both see something: then it does, too, even if it meets none of the tiny triangles at hand. */
static bool between_objects(const near_pixel *p, int place)
{
    const gbuffer *g = &p->r->direct.near;
    const bool across = fabs(place_x[place]) > fabs(place_y[place]);
    const ptrdiff_t step = across ? (place_x[place] > 0 ? 1 : -1) : (ptrdiff_t)g->width * (place_y[place] > 0 ? 1 : -1);
    return g->triangle[p->element] >= 0 && g->triangle[(size_t)((ptrdiff_t)p->element + step)] >= 0;
}

static void see_edge(near_pixel *p, tile_objects *o, size_t *count)
{
    const gbuffer *g = &p->r->direct.near;
    list_candidates(p);
    for (int place = 0; place < PLACES; place++) {
        double ray[3], nearest = INFINITY;
        int32_t triangle = -1;
        ray_through(p->r, p->x + place_x[place], p->y + place_y[place], ray);
        for (size_t k = 0; k < p->candidate_count; k++) {
            const double along = meet_triangle(p->r, p->candidates[k], ray);
            if (along < nearest)
                nearest = along, triangle = p->candidates[k];
        }
        if (triangle < 0 && between_objects(p, place))
            nearest = (double)g->depth[p->element], triangle = g->triangle[p->element];
        if (triangle >= 0 && nearest < meet_water(o, p->i, p->r->frame->under, ray))
            add_point(p, ray, nearest, triangle, o, count);
    }
}

static void see_inside(const near_pixel *p, tile_objects *o, size_t *count)
{
    const gbuffer *g = &p->r->direct.near;
    if (g->triangle[p->element] < 0)
        return;
    double ray[3];
    ray_through(p->r, p->x, p->y, ray);
    const double along = (double)g->depth[p->element];
    if (along >= meet_water(o, p->i, p->r->frame->under, ray))
        return;
    add_point(p, ray, along, g->triangle[p->element], o, count);
}

void refraction_near(const refraction *r, uint32_t column, uint32_t row, tile_objects *o)
{
    const gbuffer *g = &r->direct.near;
    const mgt_image *image = &r->frame->scene->image;
    size_t count = 0;
    float places[TILE_PIXELS];
    memset(o->share, 0, sizeof o->share);
    memset(o->color, 0, sizeof o->color);
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        near_pixel p = {.r = r, .x = column + i % TILE_WIDTH, .y = row + i / TILE_WIDTH, .i = i};
        o->along[i] = INFINITY;
        places[i] = 1;
        if (p.x >= image->width || p.y >= image->height)
            continue;
        p.element = (size_t)(g->top + p.y) * g->width + g->left + p.x;
        if (!is_edge(&p, o)) {
            see_inside(&p, o, &count);
            continue;
        }
        places[i] = PLACES;
        see_edge(&p, o, &count);
    }
    flush(r, o, &count);
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        for (int k = 0; k < 3 && o->share[i] > 0; k++)
            o->color[k][i] /= o->share[i];
        o->share[i] /= places[i];
        if (o->share[i] < 0.5f)
            o->along[i] = INFINITY;
    }
}
