/* SPDX-License-Identifier: MIT
 * Voxels of distances, and sphere tracing through them. Distances are exact in a band around the triangles. Beyond it they are those of the exact Euclidean
 * transform of P. Felzenszwalb and D. Huttenlocher, Distance Transforms of Sampled Functions, 2012. */
#include "cpu/distance_field.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Distance from a triangle up to which points of the grid have its exact distance, voxels. It is above the diagonal of a cell, so it includes the corners of
 * every cell that the triangle crosses. */
static const float band = 1.8f;
/* Largest distance of a point in space from the nearest point of the grid, voxels, rounded up. */
static const float half_diagonal = 0.8661f;

enum { LINES = 64, MOST_STEPS = 4096 };

typedef struct vector {
    float x, y, z;
} vector;

static vector minus(vector a, vector b) { return (vector){a.x - b.x, a.y - b.y, a.z - b.z}; }

static vector plus_scaled(vector a, vector b, float t) { return (vector){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z}; }

static float dot(vector a, vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static float clamped(float x) { return x > 0 ? fminf(x, 1) : 0; }

/* ---- a point and a triangle ---- */

typedef struct corners {
    vector a, b, c;
} corners;

static corners corners_of(const world *w, size_t triangle)
{
    vector v[3];
    for (int i = 0; i < 3; i++) {
        const float *p = w->positions + 3 * (size_t)w->indices[3 * triangle + (size_t)i];
        v[i] = (vector){p[0], p[1], p[2]};
    }
    return (corners){v[0], v[1], v[2]};
}

static float square_to_edge(vector p, vector a, vector b)
{
    const vector edge = minus(b, a), from = minus(p, a);
    const float length = dot(edge, edge);
    const vector rest = plus_scaled(from, edge, -clamped(length > 0 ? dot(from, edge) / length : 0));
    return dot(rest, rest);
}

/* Squared distance of a point from a triangle. */
static float square_to_triangle(vector p, const corners *t)
{
    const vector ab = minus(t->b, t->a), ac = minus(t->c, t->a), ap = minus(p, t->a);
    const float bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), b = dot(ap, ab), c = dot(ap, ac), area = bb * cc - bc * bc;
    const float v = b * cc - c * bc, w = c * bb - b * bc;
    if (area > 0 && v >= 0 && w >= 0 && v + w <= area) {
        const vector rest = plus_scaled(plus_scaled(ap, ab, -v / area), ac, -w / area);
        return dot(rest, rest);
    }
    return fminf(square_to_edge(p, t->a, t->b), fminf(square_to_edge(p, t->b, t->c), square_to_edge(p, t->c, t->a)));
}

/* ---- building ---- */

typedef struct build_job {
    distance_field *field;
    const world *world;
    float *squares; /* squared distance to the nearest point that lies within half_diagonal of a triangle, voxels² */
    int axis;       /* axis of the current pass */
    _Atomic int failed;
} build_job;

static size_t index_of(const distance_field *f, uint32_t x, uint32_t y, uint32_t z) { return ((size_t)z * f->size[1] + y) * f->size[0] + x; }

typedef struct span {
    uint32_t from, to; /* `to` is one past the last */
} span;

/* Points along an axis within the band around an interval. */
static span band_of(const distance_field *f, int axis, float least, float most)
{
    const float from = ceilf((least - f->low[axis]) / f->voxel - band), to = floorf((most - f->low[axis]) / f->voxel + band) + 1;
    const float size = (float)f->size[axis];
    return (span){(uint32_t)fminf(fmaxf(from, 0), size), (uint32_t)fminf(fmaxf(to, 0), size)};
}

static span span_of(const distance_field *f, int axis, float a, float b, float c) { return band_of(f, axis, fminf(a, fminf(b, c)), fmaxf(a, fmaxf(b, c))); }

static void enter_triangle(distance_field *f, const corners *t, int32_t triangle, span layers)
{
    const span xs = span_of(f, 0, t->a.x, t->b.x, t->c.x), ys = span_of(f, 1, t->a.y, t->b.y, t->c.y);
    const float reach = band * f->voxel;
    for (uint32_t z = layers.from; z < layers.to; z++)
        for (uint32_t y = ys.from; y < ys.to; y++)
            for (uint32_t x = xs.from; x < xs.to; x++) {
                const vector p = {f->low[0] + f->voxel * (float)x, f->low[1] + f->voxel * (float)y, f->low[2] + f->voxel * (float)z};
                const float distance = sqrtf(square_to_triangle(p, t));
                const size_t i = index_of(f, x, y, z);
                if (distance <= reach && distance < f->distance[i]) {
                    f->distance[i] = distance;
                    f->triangle[i] = triangle;
                }
            }
}

/* Enters all triangles into eight layers z of the grid. Of several triangles at the same distance the first one is kept. */
static void enter_layers(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    build_job *job = argument;
    distance_field *f = job->field;
    const uint32_t first = (uint32_t)index * 8, end = first + 8 < f->size[2] ? first + 8 : f->size[2];
    for (size_t i = index_of(f, 0, 0, first); i < index_of(f, 0, 0, end); i++) {
        f->distance[i] = FLT_MAX;
        f->triangle[i] = -1;
    }
    for (size_t i = 0; i < job->world->triangle_count; i++) {
        const corners t = corners_of(job->world, i);
        const span zs = span_of(f, 2, t.a.z, t.b.z, t.c.z);
        const span layers = {zs.from > first ? zs.from : first, zs.to < end ? zs.to : end};
        if (layers.from < layers.to)
            enter_triangle(f, &t, (int32_t)i, layers);
    }
    for (size_t i = index_of(f, 0, 0, first); i < index_of(f, 0, 0, end); i++)
        job->squares[i] = f->distance[i] <= half_diagonal * f->voxel ? 0 : FLT_MAX;
}

/* Lines across the memory's order are copied in groups of so many neighbours, which share cache lines. */
enum { BESIDE = 16 };

/* Scratch memory for up to BESIDE lines, one after the other, and for the lower envelope of one line's parabolas. */
typedef struct line_room {
    float *square;     /* all lines: squared distances */
    float *from;       /* one line: place from which on each parabola of the envelope is the lowest */
    int32_t *triangle; /* all lines: nearest triangles */
    uint32_t *place;   /* one line: vertex of each parabola of the envelope */
    float *lowest;     /* all lines: the envelope */
    int32_t *nearest;  /* all lines: triangle of the envelope's parabola */
} line_room;

static void transform_line(const line_room *e, const float *square, const int32_t *triangle, size_t first, uint32_t length)
{
    int count = 0;
    for (uint32_t q = 0; q < length; q++) {
        if (square[q] == FLT_MAX)
            continue;
        float from = -FLT_MAX;
        while (count > 0) {
            const uint32_t p = e->place[count - 1];
            const float fp = (float)p, fq = (float)q;
            from = (square[q] + fq * fq - square[p] - fp * fp) / (2 * (fq - fp));
            if (from > e->from[count - 1])
                break;
            count--;
        }
        e->place[count] = q;
        e->from[count] = count ? from : -FLT_MAX;
        count++;
    }
    int at = 0;
    for (uint32_t q = 0; q < length; q++) {
        while (at + 1 < count && e->from[at + 1] < (float)q)
            at++;
        const uint32_t p = count > 0 ? e->place[at] : q;
        const float d = (float)q - (float)p;
        e->lowest[first + q] = square[p] + d * d;
        e->nearest[first + q] = triangle[p];
    }
}

/* Transforms a line along x, whose points are consecutive in memory. */
static void transform_one(build_job *job, const line_room *e, size_t start, uint32_t length)
{
    distance_field *f = job->field;
    transform_line(e, job->squares + start, f->triangle + start, 0, length);
    memcpy(job->squares + start, e->lowest, length * sizeof *e->lowest);
    for (uint32_t q = 0; q < length; q++)
        f->triangle[start + q] = f->distance[start + q] == FLT_MAX ? e->nearest[q] : f->triangle[start + q];
}

/* Transforms neighbouring lines along y or z. `start`: index of the first line's first point. `step`: from point to point. */
static void transform_some(build_job *job, const line_room *e, size_t start, size_t step, uint32_t length, uint32_t lines)
{
    distance_field *f = job->field;
    for (uint32_t q = 0; q < length; q++)
        for (uint32_t k = 0; k < lines; k++) {
            e->square[k * length + q] = job->squares[start + q * step + k];
            e->triangle[k * length + q] = f->triangle[start + q * step + k];
        }
    for (uint32_t k = 0; k < lines; k++)
        transform_line(e, e->square + (size_t)k * length, e->triangle + (size_t)k * length, (size_t)k * length, length);
    for (uint32_t q = 0; q < length; q++)
        for (uint32_t k = 0; k < lines; k++) {
            const size_t i = start + q * step + k;
            job->squares[i] = e->lowest[k * length + q];
            if (f->distance[i] == FLT_MAX)
                f->triangle[i] = e->nearest[k * length + q];
        }
}

static void transform_lines(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    build_job *job = argument;
    const distance_field *f = job->field;
    const int axis = job->axis;
    const uint32_t length = f->size[axis], across = axis == 0 ? f->size[1] : f->size[0], lines = across * (axis == 2 ? f->size[1] : f->size[2]);
    const size_t step = axis == 0 ? 1 : axis == 1 ? f->size[0] : (size_t)f->size[0] * f->size[1], all = (size_t)length * BESIDE;
    float *room = malloc((4 * all + 2 * (size_t)length) * sizeof *room);
    if (!room) {
        job->failed = 1;
        return;
    }
    int32_t *const whole = (int32_t *)(void *)(room + 2 * all + length);
    const line_room e = {.square = room,
                         .lowest = room + all,
                         .from = room + 2 * all,
                         .triangle = whole,
                         .nearest = whole + all,
                         .place = (uint32_t *)(void *)(whole + 2 * all)};
    const uint32_t end = (uint32_t)(index + 1) * LINES < lines ? (uint32_t)(index + 1) * LINES : lines;
    for (uint32_t line = (uint32_t)index * LINES, some = 1; line < end; line += some) {
        const uint32_t i = line % across, j = line / across, left = end - line < across - i ? end - line : across - i;
        some = axis == 0 ? 1 : left < BESIDE ? left : BESIDE;
        if (axis == 0)
            transform_one(job, &e, index_of(f, 0, i, j), length);
        else
            transform_some(job, &e, axis == 1 ? index_of(f, i, 0, j) : index_of(f, i, j, 0), step, length, some);
    }
    free(room);
}

static void finish_layer(void *argument, size_t z, uint32_t worker)
{
    (void)worker;
    build_job *job = argument;
    distance_field *f = job->field;
    for (size_t i = index_of(f, 0, 0, (uint32_t)z); i < index_of(f, 0, 0, (uint32_t)z + 1); i++)
        if (f->distance[i] == FLT_MAX)
            f->distance[i] = f->voxel * fmaxf(sqrtf(job->squares[i]) - half_diagonal, band);
}

/* Sets a grid that contains the world and the band around it. */
static void choose_grid(distance_field *f, const world *w)
{
    f->voxel = (float)DISTANCE_FIELD_VOXEL;
    for (;; f->voxel *= 1.1f) {
        double count = 8;
        for (int k = 0; k < 3; k++) {
            f->low[k] = w->low[k] - 2 * f->voxel;
            const double points = ceil(((double)w->high[k] - (double)f->low[k]) / (double)f->voxel) + 3;
            f->size[k] = points < 1e9 ? (uint32_t)points : 1000000000;
            count *= points;
        }
        if (count <= (double)DISTANCE_FIELD_BYTES)
            return;
    }
}

static bool build(distance_field *f, const world *w, thread_pool *pool)
{
    choose_grid(f, w);
    const size_t count = (size_t)f->size[0] * f->size[1] * f->size[2];
    build_job job = {.field = f, .world = w, .squares = malloc(count * sizeof *job.squares)};
    f->distance = malloc(count * sizeof *f->distance);
    f->triangle = malloc(count * sizeof *f->triangle);
    const bool allocated = job.squares && f->distance && f->triangle;
    if (allocated) {
        thread_pool_run(pool, &(thread_loop){(f->size[2] + 7) / 8, enter_layers, &job, NULL});
        for (job.axis = 0; job.axis < 3; job.axis++)
            thread_pool_run(pool, &(thread_loop){count / f->size[job.axis] / LINES + 1, transform_lines, &job, NULL});
        thread_pool_run(pool, &(thread_loop){f->size[2], finish_layer, &job, NULL});
    }
    free(job.squares);
    return allocated && !job.failed;
}

mgt_status distance_field_update(distance_field **field, const world *w, thread_pool *pool, const reporter *r)
{
    if (*field && (*field)->version == w->version)
        return MGT_OK;
    distance_field_free(*field);
    *field = calloc(1, sizeof **field);
    if (*field && (w->triangle_count == 0 || build(*field, w, pool))) {
        (*field)->version = w->version;
        return MGT_OK;
    }
    distance_field_free(*field);
    *field = NULL;
    return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the voxels of distances of refraction distance-field");
}

void distance_field_free(distance_field *field)
{
    if (!field)
        return;
    free(field->distance);
    free(field->triangle);
    free(field);
}

size_t distance_field_bytes(const distance_field *field) { return field ? sizeof *field + (size_t)8 * field->size[0] * field->size[1] * field->size[2] : 0; }

/* ---- rays ---- */

/* Distance interpolated between eight points of the grid. `at`: place in voxels from the first point, within the grid. */
static float distance_at(const distance_field *f, vector at)
{
    const float limit[3] = {(float)(f->size[0] - 2), (float)(f->size[1] - 2), (float)(f->size[2] - 2)};
    const float x = fminf(floorf(at.x), limit[0]), y = fminf(floorf(at.y), limit[1]), z = fminf(floorf(at.z), limit[2]);
    const float u = at.x - x, v = at.y - y, w = at.z - z;
    const float *low = f->distance + index_of(f, (uint32_t)x, (uint32_t)y, (uint32_t)z), *high = low + (size_t)f->size[0] * f->size[1];
    const size_t row = f->size[0];
    const float a = low[0] + u * (low[1] - low[0]), b = low[row] + u * (low[row + 1] - low[row]);
    const float c = high[0] + u * (high[1] - high[0]), d = high[row] + u * (high[row + 1] - high[row]);
    const float front = a + v * (b - a), back = c + v * (d - c);
    return front + w * (back - front);
}

static int32_t triangle_at(const distance_field *f, vector at)
{
    return f->triangle[index_of(f, (uint32_t)(at.x + 0.5f), (uint32_t)(at.y + 0.5f), (uint32_t)(at.z + 0.5f))];
}

/* The part of a ray within the grid. It is empty if from > to. */
typedef struct stretch {
    float from, to;
} stretch;

static stretch within_grid(const distance_field *f, const trace_ray *ray)
{
    stretch s = {ray->least, ray->most};
    for (int k = 0; k < 3; k++) {
        const float low = f->low[k] - ray->origin[k], high = low + f->voxel * (float)(f->size[k] - 1);
        const float a = low / ray->direction[k], b = high / ray->direction[k];
        if (ray->direction[k] != 0) {
            s.from = fmaxf(s.from, fminf(a, b));
            s.to = fminf(s.to, fmaxf(a, b));
        } else if (!(low <= 0 && high >= 0)) {
            return (stretch){1, 0};
        }
    }
    return s;
}

static float within(float x, uint32_t size) { return fminf(fmaxf(x, 0), (float)(size - 1)); }

static trace_hit search(const distance_field *f, const trace_ray *ray)
{
    const trace_hit none = {.along = HUGE_VALF, .triangle = -1};
    const stretch s = within_grid(f, ray);
    float along = s.from;
    for (int i = 0; i < MOST_STEPS && along <= s.to; i++) {
        vector at = {(ray->origin[0] + along * ray->direction[0] - f->low[0]) / f->voxel, (ray->origin[1] + along * ray->direction[1] - f->low[1]) / f->voxel,
                     (ray->origin[2] + along * ray->direction[2] - f->low[2]) / f->voxel};
        if (!isfinite(at.x + at.y + at.z))
            return none;
        at = (vector){within(at.x, f->size[0]), within(at.y, f->size[1]), within(at.z, f->size[2])};
        const float distance = distance_at(f, at);
        if (distance < 0.5f * f->voxel)
            return (trace_hit){.along = along, .triangle = triangle_at(f, at)};
        along += fmaxf(distance - 0.25f * f->voxel, 0.25f * f->voxel);
    }
    return none;
}

void distance_field_nearest(const distance_field *field, size_t count, const trace_ray *rays, trace_hit *hits)
{
    for (size_t i = 0; i < count; i++)
        hits[i] = field->size[0] ? search(field, &rays[i]) : (trace_hit){.along = HUGE_VALF, .triangle = -1};
}
