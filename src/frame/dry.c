/* SPDX-License-Identifier: MIT
 * Which sides of triangles face the dry inside of hulls, and up to which height.
 *
 * For one horizontal direction at a time, the triangles of all dry meshes are projected along it and sorted into bins of that picture. The vertical
 * half-plane that begins at a point and extends along the direction meets the triangles of one column of bins alone. It cuts each of them in a span of
 * heights. The spans that join, from the point's height upwards, are the wall in that direction. At most MOST_CLIMBS places follow their walls up to the rim;
 * every other place takes the rim of the nearest of these. */
#include "frame/dry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A point just before a side of a triangle. */
typedef struct dry_place {
    double at[3];
    size_t side;                 /* index into world.dry */
    bool climbs;                 /* true: walls are followed up to their tops; false: only a wall at the place's own height is looked for */
    double tops[DRY_MISSES + 1]; /* tops of the lowest walls so far, in rising order; −inf: no wall */
} dry_place;

/* A triangle's corner in the coordinates of a dry_view, metres. */
typedef struct dry_corner {
    double across, up, ahead;
} dry_corner;

/* The dry triangles, sorted into the bins of their orthographic picture along one direction. */
typedef struct dry_view {
    double across[3], up[3], ahead[3]; /* axes of the picture, and the direction of view */
    double low[2], bin[2];             /* lowest coordinates in the picture, and the size of a bin, metres */
    uint32_t bins;                     /* number of bins along each side */
    dry_corner *corners;               /* 3 for each triangle of dry_search.triangles */
    uint32_t *first;                   /* the items of bin i begin at first[i] and end before first[i + 1] */
    uint32_t *items;                   /* indices into dry_search.triangles */
    size_t room;
} dry_view;

typedef struct dry_search {
    world *world;
    uint32_t *triangles; /* indices of the dry meshes' triangles in the world */
    size_t triangle_count;
    float low[3], high[3]; /* bounds of these triangles */
    double aside;          /* greatest distance of a place from its side, metres */
    double gap;            /* height of the greatest gap that a wall may have, metres */
    dry_view view;
    dry_place *places;
    size_t place_count;
} dry_search;

enum { MOST_BINS = 512, MOST_CLIMBS = 128, BLOCK = 256 };

static double product(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void corners_of(const world *w, size_t triangle, double out[3][3])
{
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            out[c][k] = (double)w->positions[3 * (size_t)w->indices[3 * triangle + (size_t)c] + (size_t)k];
}

/* ---- pictures ---- */

static uint32_t bin_of(const dry_view *v, int axis, double x)
{
    const double at = (x - v->low[axis]) / v->bin[axis];
    return at > 0 ? at < v->bins - 1 ? (uint32_t)at : v->bins - 1 : 0;
}

static double least(double a, double b, double c) { return a < b ? a < c ? a : c : b < c ? b : c; }

static double most(double a, double b, double c) { return -least(-a, -b, -c); }

/* `put` false: counts in first[] the triangles whose bounds touch each bin. `put` true: stores them, moving each first[] back to the bin's begin. */
static void sort_triangles(dry_view *v, size_t count, bool put)
{
    for (size_t i = 0; i < count; i++) {
        const dry_corner *c = v->corners + 3 * i;
        const uint32_t left = bin_of(v, 0, least(c[0].across, c[1].across, c[2].across)), right = bin_of(v, 0, most(c[0].across, c[1].across, c[2].across));
        const uint32_t low = bin_of(v, 1, least(c[0].up, c[1].up, c[2].up)), high = bin_of(v, 1, most(c[0].up, c[1].up, c[2].up));
        for (uint32_t row = low; row <= high; row++)
            for (uint32_t column = left; column <= right; column++) {
                uint32_t *bin = &v->first[(size_t)row * v->bins + column];
                if (put)
                    v->items[--*bin] = (uint32_t)i;
                else
                    ++*bin;
            }
    }
}

static bool set_view(dry_search *s, const double across[3], const double up[3], const double ahead[3])
{
    dry_view *v = &s->view;
    memcpy(v->across, across, sizeof v->across);
    memcpy(v->up, up, sizeof v->up);
    memcpy(v->ahead, ahead, sizeof v->ahead);
    for (int axis = 0; axis < 2; axis++) {
        const double *along = axis == 0 ? across : up;
        double low = 0, high = 0;
        for (int k = 0; k < 3; k++) {
            low += fmin(along[k] * (double)s->low[k], along[k] * (double)s->high[k]);
            high += fmax(along[k] * (double)s->low[k], along[k] * (double)s->high[k]);
        }
        v->low[axis] = low;
        v->bin[axis] = fmax((high - low) / v->bins, 1e-9);
    }
    const size_t bins = (size_t)v->bins * v->bins;
    memset(v->first, 0, (bins + 1) * sizeof *v->first);
    for (size_t i = 0; i < s->triangle_count; i++) {
        double corner[3][3];
        corners_of(s->world, s->triangles[i], corner);
        for (int c = 0; c < 3; c++)
            v->corners[3 * i + (size_t)c] = (dry_corner){product(across, corner[c]), product(up, corner[c]), product(ahead, corner[c])};
    }
    sort_triangles(v, s->triangle_count, false);
    for (size_t i = 1; i <= bins; i++)
        v->first[i] += v->first[i - 1];
    if (v->first[bins] > v->room) {
        uint32_t *items = realloc(v->items, v->first[bins] * sizeof *items);
        if (!items)
            return false;
        v->items = items;
        v->room = v->first[bins];
    }
    sort_triangles(v, s->triangle_count, true);
    return true;
}

/* The heights between which a triangle meets a half-plane. low > high: it does not meet it. */
typedef struct dry_span {
    double low, high;
} dry_span;

static dry_span span_of(const dry_corner corner[3], double column, double from)
{
    double height[2], depth[2];
    int met = 0;
    for (int i = 0; i < 3 && met < 2; i++) {
        const dry_corner *a = &corner[i], *b = &corner[i == 2 ? 0 : i + 1];
        if ((a->across <= column) == (b->across <= column))
            continue;
        const double share = (column - a->across) / (b->across - a->across);
        height[met] = a->up + share * (b->up - a->up);
        depth[met++] = a->ahead + share * (b->ahead - a->ahead) - from;
    }
    if (met < 2 || (depth[0] <= 0 && depth[1] <= 0))
        return (dry_span){INFINITY, -INFINITY};
    for (int i = 0; i < 2; i++)
        if (depth[i] < 0)
            height[i] += depth[i] / (depth[i] - depth[1 - i]) * (height[1 - i] - height[i]);
    return height[0] < height[1] ? (dry_span){height[0], height[1]} : (dry_span){height[1], height[0]};
}

/* Height of the top of the wall ahead of a place: the triangles that stand on the place's height and on each other, with gaps of at most s->gap. −inf: there
 * is no wall. */
static double wall_top(const dry_search *s, const dry_place *p)
{
    const dry_view *v = &s->view;
    const double column = product(v->across, p->at), from = product(v->ahead, p->at), height = product(v->up, p->at);
    const uint32_t first = bin_of(v, 1, height), last = p->climbs ? v->bins - 1 : first;
    double top = height;
    for (uint32_t row = first; row <= last; row++) {
        const size_t bin = (size_t)row * v->bins + bin_of(v, 0, column);
        for (bool more = true; more;) {
            more = false;
            for (uint32_t i = v->first[bin]; i < v->first[bin + 1]; i++) {
                const dry_span span = span_of(v->corners + 3 * (size_t)v->items[i], column, from);
                if (span.low <= top + (top > height ? s->gap : 0) && span.high > top)
                    top = span.high, more = p->climbs;
            }
        }
        if (top < v->low[1] + (row + 1) * v->bin[1])
            break;
    }
    return top > height ? top : -INFINITY;
}

/* ---- places ---- */

static bool is_within(const dry_search *s, const double at[3])
{
    for (int k = 0; k < 3; k++)
        if (!(at[k] > (double)s->low[k] && at[k] < (double)s->high[k]))
            return false;
    return true;
}

enum { PLACES = 2 };

/* A point a little before a side of a triangle, and the side that it stands for. With `which` 0 it is near the lowest corner, where the side is dry from its
 * lowest height on. With `which` 1 it is in the middle, because corners may be stuck through a wall. */
static void place_before(const dry_search *s, size_t triangle, double side, int which, double out[3])
{
    double p[3][3];
    corners_of(s->world, triangle, p);
    const int lowest = p[0][1] <= p[1][1] && p[0][1] <= p[2][1] ? 0 : p[1][1] <= p[2][1] ? 1 : 2;
    double a[3], b[3];
    for (int k = 0; k < 3; k++)
        a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k];
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double area = fmax(sqrt(product(n, n)), 1e-30), aside = side * fmin(s->aside, 0.05 * sqrt(area)), corner = which == 0 ? 0.75 : 0;
    for (int k = 0; k < 3; k++)
        out[k] = corner * p[lowest][k] + (1 - corner) / 3 * (p[0][k] + p[1][k] + p[2][k]) + aside * n[k] / area;
}

typedef void (*place_body)(const dry_search *s, dry_place *p);

typedef struct place_job {
    dry_search *search;
    place_body body;
} place_job;

static void do_block(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const place_job *job = argument;
    const size_t end = (index + 1) * BLOCK < job->search->place_count ? (index + 1) * BLOCK : job->search->place_count;
    for (size_t i = index * BLOCK; i < end; i++)
        job->body(job->search, &job->search->places[i]);
}

static void do_places(dry_search *s, place_body body, thread_pool *pool)
{
    place_job job = {s, body};
    const thread_loop loop = {(s->place_count + BLOCK - 1) / BLOCK, do_block, &job, NULL};
    thread_pool_run(pool, &loop);
}

/* Looks for a triangle straight below a place, in a view downwards. tops[0] becomes −inf if there is none. */
static void look_down(const dry_search *s, dry_place *p)
{
    const double reach = wall_top(s, p);
    p->tops[0] = reach > -INFINITY ? INFINITY : -INFINITY;
    for (int i = 1; i <= DRY_MISSES; i++)
        p->tops[i] = INFINITY;
}

static void look_ahead(const dry_search *s, dry_place *p)
{
    double top = wall_top(s, p);
    for (int i = 0; i <= DRY_MISSES; i++)
        if (top < p->tops[i]) {
            const double other = p->tops[i];
            p->tops[i] = top;
            top = other;
        }
}

static bool list_places(dry_search *s)
{
    const world *w = s->world;
    size_t count = 0;
    for (size_t i = 0; i < w->object_count; i++)
        count += w->objects[i].in_dry ? 2 * PLACES * (size_t)w->objects[i].triangle_count : 0;
    s->places = malloc((count + 1) * sizeof *s->places);
    for (size_t i = 0; s->places && i < w->object_count; i++) {
        const world_object *o = &w->objects[i];
        for (size_t t = o->first_triangle; o->in_dry && t < (size_t)o->first_triangle + o->triangle_count; t++)
            for (int k = 0; k < 2 * PLACES; k++) {
                dry_place p = {.side = 2 * t + (size_t)(k % 2)};
                place_before(s, t, k % 2 ? -1 : 1, k / 2, p.at);
                if (is_within(s, p.at))
                    s->places[s->place_count++] = p;
            }
    }
    return s->places != NULL;
}

/* ---- all ---- */

/* Lists the dry meshes' triangles, finds their bounds, and finds the objects that reach into these bounds. */
static bool list_triangles(dry_search *s, world *w)
{
    size_t count = 0;
    for (int k = 0; k < 3; k++)
        s->low[k] = INFINITY, s->high[k] = -INFINITY;
    for (size_t i = 0; i < w->object_count; i++)
        if (w->objects[i].dry) {
            count += w->objects[i].triangle_count;
            for (int k = 0; k < 3; k++)
                s->low[k] = fminf(s->low[k], w->objects[i].low[k]), s->high[k] = fmaxf(s->high[k], w->objects[i].high[k]);
        }
    double squared = 0;
    for (int k = 0; k < 3; k++)
        squared += pow((double)s->high[k] - (double)s->low[k], 2);
    s->aside = 1e-4 * sqrt(squared);
    s->gap = 5e-3 * sqrt(squared);
    s->triangles = malloc((count + 1) * sizeof *s->triangles);
    for (size_t i = 0; s->triangles && i < w->object_count; i++) {
        world_object *o = &w->objects[i];
        o->in_dry = true;
        for (int k = 0; k < 3; k++)
            o->in_dry = o->in_dry && o->low[k] <= s->high[k] && o->high[k] >= s->low[k];
        for (size_t t = 0; o->dry && t < o->triangle_count; t++)
            s->triangles[s->triangle_count++] = o->first_triangle + (uint32_t)t;
    }
    return s->triangles != NULL;
}

/* The rim's height for a place: that of the nearest inside place that has climbed its walls, which is every step-th. −inf: the place is not inside. */
static float level_of(const dry_search *s, const dry_place *p, size_t step)
{
    double level = -INFINITY, nearest = INFINITY;
    if (!(p->tops[DRY_MISSES] > -INFINITY))
        return -INFINITY;
    for (size_t i = 0; i < s->place_count; i += step) {
        const dry_place *other = &s->places[i];
        const double to[3] = {other->at[0] - p->at[0], other->at[1] - p->at[1], other->at[2] - p->at[2]}, squared = product(to, to);
        if (squared < nearest && other->tops[DRY_MISSES] > -INFINITY)
            nearest = squared, level = other->tops[DRY_MISSES];
    }
    return (float)level;
}

static bool search_levels(dry_search *s, float *levels, thread_pool *pool)
{
    static const double east[3] = {1, 0, 0}, south[3] = {0, 0, 1}, up[3] = {0, 1, 0}, down[3] = {0, -1, 0};
    if (!set_view(s, east, south, down))
        return false;
    do_places(s, look_down, pool);
    size_t left = 0;
    for (size_t i = 0; i < s->place_count; i++)
        if (s->places[i].tops[0] > 0)
            s->places[left++] = s->places[i];
    s->place_count = left;
    const size_t step = left / MOST_CLIMBS + 1;
    for (size_t i = 0; i < left; i += step)
        s->places[i].climbs = true;
    for (int i = 0; i < DRY_DIRECTIONS; i++) {
        const double angle = 6.283185307179586 * (i + 0.37) / DRY_DIRECTIONS; /* not along an axis, because meshes often have seams there */
        const double ahead[3] = {cos(angle), 0, sin(angle)}, across[3] = {-sin(angle), 0, cos(angle)};
        if (!set_view(s, across, up, ahead))
            return false;
        do_places(s, look_ahead, pool);
    }
    for (size_t i = 0; i < left; i++) {
        float *level = &levels[s->places[i].side];
        *level = fmaxf(*level, level_of(s, &s->places[i], step));
    }
    return true;
}

bool dry_levels(world *w, thread_pool *pool)
{
    bool any = false;
    for (size_t i = 0; i < w->object_count; i++)
        any = any || w->objects[i].dry;
    if (!any)
        return true;
    dry_search s = {.world = w};
    w->dry = malloc((2 * w->triangle_count + 1) * sizeof *w->dry);
    bool good = w->dry && list_triangles(&s, w) && list_places(&s);
    if (good) {
        for (size_t i = 0; i < 2 * w->triangle_count; i++)
            w->dry[i] = -INFINITY;
        const double side = sqrt((double)s.triangle_count);
        s.view.bins = side < MOST_BINS ? (uint32_t)side + 1 : MOST_BINS;
        s.view.first = malloc(((size_t)s.view.bins * s.view.bins + 1) * sizeof *s.view.first);
        s.view.corners = malloc((s.triangle_count + 1) * 3 * sizeof *s.view.corners);
        good = s.view.first && s.view.corners && search_levels(&s, w->dry, pool);
    }
    free(s.view.corners);
    free(s.view.first);
    free(s.view.items);
    free(s.triangles);
    free(s.places);
    return good;
}
