/* SPDX-License-Identifier: MIT
 *
 * Lights that the water mirrors, by an integral over the surface; see the header.
 */
#include "reference/light_cells.h"

#include <math.h>
#include <string.h>

#include "reference/equations.h"
#include "reference/light_lanes.h"
#include "reference/reference_frame.h"

typedef struct vec2 {
    double x, z;
} vec2;

typedef struct vec3 {
    double x, y, z;
} vec3;

static double dot2(vec2 a, vec2 b) { return a.x * b.x + a.z * b.z; }
static double dot3(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static vec2 scaled2(vec2 a, double s) { return (vec2){a.x * s, a.z * s}; }
static vec3 scaled3(vec3 a, double s) { return (vec3){a.x * s, a.y * s, a.z * s}; }
static vec3 added3(vec3 a, vec3 b) { return (vec3){a.x + b.x, a.y + b.y, a.z + b.z}; }
static vec3 cross3(vec3 a, vec3 b) { return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
static double length2(vec2 a) { return sqrt(dot2(a, a)); }
static double length3(vec3 a) { return sqrt(dot3(a, a)); }
static vec3 unit3(vec3 a) { return scaled3(a, 1 / length3(a)); }

static uint64_t mix_bits(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static uint64_t key_of(uint64_t key, uint64_t index) { return mix_bits(key + (index + 1) * 0x9e3779b97f4a7c15u); }

/* One of two random numbers in (0, 1) from a key, of 26 bits each; `which` is 0 or 1. */
static double random_of(uint64_t key, int which) { return ((double)(key >> (32 * which) & 0x3ffffff) + 0.5) * 0x1p-26; }

/* ---- the camera at one instant ---- */

typedef struct instant {
    uint64_t key; /* key of a pixel's random numbers at this instant */
    double time_offset;
    vec3 position, forward, right, up;
    double scale_x, scale_y; /* change of the ray of depth 1 per pixel */
    double half_width, half_height;
} instant;

static vec3 between(const double a[3], const double b[3], double weight)
{
    return (vec3){a[0] + weight * (b[0] - a[0]), a[1] + weight * (b[1] - a[1]), a[2] + weight * (b[2] - a[2])};
}

/* The camera at the time `share` shutters before the shutter closes. */
static instant instant_at(const reference_frame *frame, double share)
{
    const reference_view *close = &frame->view, *open = &frame->view_open;
    const double weight = frame->scene.camera_moves && frame->scene.shutter > 0 ? share : 0;
    instant now = {.time_offset = -frame->scene.shutter * share, .position = between(close->position, open->position, weight)};
    const double half_turns = close->fov_half_turns + weight * (open->fov_half_turns - close->fov_half_turns);
    const double extent = tan(half_turns * 3.14159265358979323846);
    now.forward = unit3(added3(between(close->target, open->target, weight), scaled3(now.position, -1)));
    now.right = unit3(cross3(now.forward, between(close->up, open->up, weight)));
    now.up = cross3(now.right, now.forward);
    now.half_width = 0.5 * frame->scene.image.width;
    now.half_height = 0.5 * frame->scene.image.height;
    now.scale_x = extent * frame->view_scale_x / now.half_width;
    now.scale_y = extent / now.half_height;
    return now;
}

/* The ray of depth 1 through a place of the picture. */
static vec3 ray_through(const instant *now, double x, double y)
{
    return added3(now->forward, added3(scaled3(now->right, (x - now->half_width) * now->scale_x), scaled3(now->up, (now->half_height - y) * now->scale_y)));
}

typedef struct place {
    double x, y; /* of the picture */
    double depth;
} place;

static place place_of(const instant *now, vec3 from_camera)
{
    const double depth = dot3(from_camera, now->forward);
    return (place){.x = now->half_width + dot3(from_camera, now->right) / (depth * now->scale_x),
                   .y = now->half_height - dot3(from_camera, now->up) / (depth * now->scale_y),
                   .depth = depth};
}

static const double least_fall = 1e-9; /* a ray of depth 1 that falls by less counts as one that does not meet the mean surface */

/* ---- cells ---- */

typedef struct cell {
    double x, y, half_x, half_y; /* middle and half sides in the picture of the mean surface, pixels */
    double weight;               /* area of the picture for which the cell stands */
    uint64_t key;
    double scale_x, scale_y; /* its sides, divided by those before it was halved */
    uint8_t instant, halvings;
    bool last; /* it is not halved any more, only its point is evaluated */
} cell;

enum { MOST_INSTANTS = 64, MOST_HALVINGS = 18, STACK = 512 };

typedef struct pending_hit {
    double weight, distance;
    double rgb[3];
    uint32_t pixel;
} pending_hit;

/* A cell on the mean surface. */
typedef struct cell_plane {
    double along; /* depth of its middle */
    vec2 at;      /* x and z of its middle */
    vec2 a, b;    /* its half sides */
    double bulge; /* the cell lies within the parallelogram of the half sides a and b times this; +inf: the cell reaches the horizon */
} cell_plane;

typedef struct cells_job {
    const reference_frame *frame;
    const light_cells_area *area;
    light_cells_sum *sums;
    double size; /* size of cells, metres */
    uint64_t evaluations;

    /* The pixel that is being rendered. */
    instant instants[MOST_INSTANTS];
    bool bounded; /* none of the pixel's corners reaches the horizon */
    uint32_t stacked;
    cell stack[STACK];

    reference_cells lanes;
    cell popped[REFERENCE_CELLS];
    cell_plane planes[REFERENCE_CELLS];
    uint32_t hits;
    pending_hit pending[REFERENCE_BATCH];
    reference_batch batch;
} cells_job;

static vec2 plane_step(const instant *now, vec3 ray, vec3 step)
{
    const double along = now->position.y / -ray.y;
    return (vec2){along * (step.x - ray.x * step.y / ray.y), along * (step.z - ray.z * step.y / ray.y)};
}

/* Places a cell on the mean surface. Returns false if the ray through its middle does not meet the mean surface. */
static bool lay_cell(const instant *now, const cell *c, cell_plane *plane)
{
    const vec3 ray = ray_through(now, c->x, c->y);
    if (!(ray.y < -least_fall))
        return false;
    plane->along = now->position.y / -ray.y;
    plane->at = (vec2){now->position.x + plane->along * ray.x, now->position.z + plane->along * ray.z};
    const vec3 right = scaled3(now->right, c->half_x * now->scale_x), down = scaled3(now->up, -c->half_y * now->scale_y);
    plane->a = plane_step(now, ray, right);
    plane->b = plane_step(now, ray, down);
    const double change = (fabs(right.y) + fabs(down.y)) / -ray.y;
    plane->bulge = change < 0.999 ? 1 / (1 - change) : HUGE_VAL;
    return true;
}

/* ---- points ---- */

/* Adds the light of those pending hits that are visible. */
static void settle_hits(cells_job *job)
{
    if (job->hits == 0)
        return;
    job->frame->trace(job->frame, &job->batch, job->hits);
    for (uint32_t i = 0; i < job->hits; i++) {
        const pending_hit *hit = &job->pending[i];
        if (!(fabs(job->batch.distance[i] - hit->distance) <= 1e-6 * hit->distance))
            continue;
        light_cells_sum *sum = &job->sums[hit->pixel];
        sum->coverage += hit->weight;
        for (int c = 0; c < 3; c++)
            sum->rgb[c] += hit->weight * hit->rgb[c];
    }
    job->hits = 0;
}

/* Whether a mirrored ray meets a light. `rgb` becomes the radiance that the eye sees. */
static bool mirrors_light(const reference_frame *frame, vec3 view, vec3 normal, double rgb[3])
{
    const double cosine = -dot3(view, normal);
    const vec3 m = added3(view, scaled3(normal, 2 * cosine));
    const double mirrored[3] = {m.x, m.y, m.z};
    if (!(cosine > 0) || !reference_lights_met(frame->lights, mirrored))
        return false;
    rgb[0] = rgb[1] = rgb[2] = 0;
    reference_lights_add(frame->lights, frame->sky.disks, mirrored, true, rgb);
    const double reflectance = fresnel_dielectric(cosine, frame->scene.water.index_of_refraction);
    for (int c = 0; c < 3; c++)
        rgb[c] *= reflectance;
    return true;
}

static void judge_point(cells_job *job, const cell *c, const cell_plane *plane, uint32_t at)
{
    const reference_cells *p = &job->lanes;
    const instant *now = &job->instants[c->instant];
    const vec3 from_camera = {plane->at.x - now->position.x, p->height[at] - now->position.y, plane->at.z - now->position.z};
    const double distance = length3(from_camera);
    const vec3 up = {-p->slope_x[at], 1, -p->slope_z[at]};
    pending_hit hit = {.distance = distance};
    const vec3 view = scaled3(from_camera, 1 / distance);
    if (!mirrors_light(job->frame, view, unit3(up), hit.rgb))
        return;
    if (job->frame->sky.air) {
        double leaves[3], light[3]; /* samples of the sky show the latter */
        job->frame->sky.air(job->frame->sky.user, (const double[3]){view.x, view.y, view.z}, distance, leaves, light);
        for (int k = 0; k < 3; k++)
            hit.rgb[k] *= leaves[k];
    }
    const place seen = place_of(now, from_camera);
    const double column = floor(seen.x) - job->area->x0, row = floor(seen.y) - job->area->y0;
    if (!(seen.depth > 0) || !(column >= 0 && column < job->area->width && row >= 0 && row < job->area->height))
        return;
    const double ratio = plane->along / seen.depth; /* c_y / (k |w_y|) */
    hit.weight = c->weight * fabs(dot3(from_camera, up)) * ratio * ratio * ratio / now->position.y;
    hit.pixel = (uint32_t)row * job->area->width + (uint32_t)column;
    job->batch.pixel_x[job->hits] = seen.x;
    job->batch.pixel_y[job->hits] = seen.y;
    job->batch.time_offset[job->hits] = now->time_offset;
    job->pending[job->hits++] = hit;
    if (job->hits == REFERENCE_BATCH)
        settle_hits(job);
}

/* ---- the walk over cells ---- */

static const double fair_share = 1; /* a cell is halved while it is wider than so many disks; measured */

static void push(cells_job *job, const cell *c) { job->stack[job->stacked++] = *c; }

static void push_point(cells_job *job, const cell *c)
{
    cell point = *c;
    point.key = key_of(c->key, 2);
    point.x += (2 * random_of(point.key, 0) - 1) * c->half_x;
    point.y += (2 * random_of(point.key, 1) - 1) * c->half_y;
    point.last = true;
    push(job, &point);
}

static void push_halves(cells_job *job, const cell *c, bool x)
{
    for (int side = -1; side <= 1; side += 2) {
        cell half = *c;
        half.key = key_of(c->key, side > 0);
        half.weight *= 0.5;
        half.halvings++;
        if (x) {
            half.half_x *= 0.5;
            half.x += side * half.half_x;
            half.scale_x *= 0.5;
        } else {
            half.half_y *= 0.5;
            half.y += side * half.half_y;
            half.scale_y *= 0.5;
        }
        push(job, &half);
    }
}

static void enter_lane(cells_job *job, const cell *c, const cell_plane *plane, uint32_t at)
{
    reference_cells *l = &job->lanes;
    const instant *now = &job->instants[c->instant];
    const double bulge = plane->bulge < HUGE_VAL ? plane->bulge : 0;
    l->x[at] = plane->at.x;
    l->z[at] = plane->at.z;
    l->time_offset[at] = now->time_offset;
    l->eye_x[at] = now->position.x;
    l->eye_y[at] = now->position.y;
    l->eye_z[at] = now->position.z;
    l->a_x[at] = plane->a.x * bulge;
    l->a_z[at] = plane->a.z * bulge;
    l->b_x[at] = plane->b.x * bulge;
    l->b_z[at] = plane->b.z * bulge;
    l->scale_x[at] = c->scale_x;
    l->scale_y[at] = c->scale_y;
}

/* Takes cells off the stack: as many as there is room for their halves, or a single one if there is little room. A single cell needs no more places than the
 * number of times that it can be halved. */
static uint32_t take_off(cells_job *job)
{
    const uint32_t room = STACK - MOST_HALVINGS - job->stacked, most = job->stacked + MOST_HALVINGS < STACK ? room : 1;
    uint32_t count = 0;
    while (count < REFERENCE_CELLS && count < most && job->stacked > 0) {
        const cell *c = &job->stack[--job->stacked];
        if (!lay_cell(&job->instants[c->instant], c, &job->planes[count]))
            continue;
        job->popped[count] = *c;
        enter_lane(job, c, &job->planes[count], count);
        count++;
    }
    return count;
}

/* Takes some cells off the stack, processes them, and pushes the halves that remain. */
static void work_off(cells_job *job)
{
    const uint32_t count = take_off(job);
    if (count == 0)
        return;
    job->frame->judge(job->frame, &job->lanes, count);
    job->evaluations += count;
    for (uint32_t i = 0; i < count; i++) {
        const cell *c = &job->popped[i];
        const bool known = job->bounded && job->planes[i].bulge < HUGE_VAL;
        const int64_t verdict = known ? job->lanes.verdict[i] : CELL_POINT;
        if (c->last)
            judge_point(job, c, &job->planes[i], i);
        else if (verdict == CELL_POINT || (verdict != CELL_DARK && c->halvings == MOST_HALVINGS))
            push_point(job, c);
        else if (verdict != CELL_DARK)
            push_halves(job, c, verdict == CELL_HALVE_X);
    }
}

/* ---- pixels of the plane ---- */

static const double curved_fraction =
    0.4; /* the most that second derivatives may change the slope over a cell, in standard deviations of the slope; chosen by measurements */

/* Numbers of a pixel's cells, and of the strata from which cells are taken, along each side. */
typedef struct pixel_grid {
    double cells[2], strata[2];
} pixel_grid;

static pixel_grid grid_of(double size, const double sides[2], double most)
{
    pixel_grid g = {.cells = {fmax(ceil(sides[0] / size), 1), fmax(ceil(sides[1] / size), 1)}};
    g.strata[0] = g.cells[0];
    g.strata[1] = g.cells[1];
    if (g.cells[0] * g.cells[1] <= most)
        return g;
    const int shorter = g.cells[0] <= g.cells[1] ? 0 : 1;
    g.strata[shorter] = fmax(fmin(g.cells[shorter], floor(sqrt(most))), 1);
    g.strata[!shorter] = fmax(floor(most / g.strata[shorter]), 1);
    for (int i = 0; i < 2; i++)
        g.cells[i] = ceil(g.cells[i] / g.strata[i]) * g.strata[i];
    return g;
}

/* A pixel of the picture of the mean surface. The vectors of its sides are those at the corners, times the squared fall of the ray there, divided by the least
 * squared fall. Any side within the pixel is a mean of them. */
typedef struct plane_pixel {
    int64_t x, y;
    bool bounded; /* no corner reaches the horizon */
    vec2 sides[2][4];
    double lengths[2]; /* lengths of the sides in the middle, or at the lower edge if the middle does not see the mean surface */
} plane_pixel;

static plane_pixel pixel_at(const instant *now, int64_t x, int64_t y)
{
    plane_pixel p = {.x = x, .y = y, .bounded = true};
    double least = HUGE_VAL;
    for (int i = 0; i < 5; i++) {
        const vec3 ray = i < 4 ? ray_through(now, (double)(x + i % 2), (double)(y + i / 2)) : ray_through(now, (double)x + 0.5, (double)y + 0.5);
        if (!(ray.y < -least_fall)) {
            p.bounded = false;
            continue;
        }
        const vec2 sides[2] = {plane_step(now, ray, scaled3(now->right, now->scale_x)), plane_step(now, ray, scaled3(now->up, -now->scale_y))};
        for (int k = 0; k < 2; k++) {
            if (i < 4)
                p.sides[k][i] = scaled2(sides[k], ray.y * ray.y);
            p.lengths[k] = length2(sides[k]);
        }
        least = fmin(least, ray.y * ray.y);
    }
    for (int i = 0; i < 8; i++)
        p.sides[i / 4][i % 4] = scaled2(p.sides[i / 4][i % 4], 1 / least);
    return p;
}

/* Bounds for the cells of a pixel. */
static void bound_pixel(cells_job *job, const plane_pixel *p, const pixel_grid *grid)
{
    double sides[2][4][2];
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++) {
            sides[k][i][0] = p->sides[k][i].x / grid->cells[k];
            sides[k][i][1] = p->sides[k][i].z / grid->cells[k];
        }
    job->lanes.bend =
        reference_waves_bend(job->frame->waves, job->frame->wave_count, (const double(*)[4][2])sides, grid->cells, (const double(*)[2])job->lanes.axes);
}

/* Whether a pixel of the plane, lifted by heights of a range, can be seen in the area. */
static bool can_be_seen(const cells_job *job, const instant *now, const plane_pixel *p, double lowest, double highest)
{
    double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {-HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < 8; i++) {
        const vec3 ray = ray_through(now, (double)(p->x + i % 2), (double)(p->y + i / 2 % 2));
        vec3 from_camera = scaled3(ray, now->position.y / -ray.y);
        from_camera.y += i < 4 ? lowest : highest;
        const place seen = place_of(now, from_camera);
        if (!(seen.depth > 0))
            return true;
        least[0] = fmin(least[0], seen.x);
        most[0] = fmax(most[0], seen.x);
        least[1] = fmin(least[1], seen.y);
        most[1] = fmax(most[1], seen.y);
    }
    const light_cells_area *a = job->area;
    return most[0] >= a->x0 && least[0] <= (double)a->x0 + a->width && most[1] >= a->y0 && least[1] <= (double)a->y0 + a->height;
}

/* Keeps those of the first `count` instants at which the pixel can be seen. Returns their number. */
static uint32_t keep_seen(cells_job *job, const plane_pixel *p, uint32_t count)
{
    const double range = job->lanes.bend.height;
    uint32_t kept = 0;
    for (uint32_t first = 0; first < count; first += REFERENCE_CELLS) {
        const uint32_t some = count - first < REFERENCE_CELLS ? count - first : REFERENCE_CELLS;
        for (uint32_t i = 0; i < some; i++) {
            const cell middle = {.x = (double)p->x + 0.5, .y = (double)p->y + 0.5, .instant = (uint8_t)(first + i)};
            lay_cell(&job->instants[first + i], &middle, &job->planes[i]);
            enter_lane(job, &middle, &job->planes[i], i);
        }
        job->frame->judge(job->frame, &job->lanes, some);
        job->evaluations += some;
        for (uint32_t i = 0; i < some; i++) {
            const double bound = job->frame->height_bound, height = job->lanes.height[i];
            if (can_be_seen(job, &job->instants[first + i], p, fmax(height - range, -bound), fmin(height + range, bound)))
                job->instants[kept++] = job->instants[first + i];
        }
    }
    return kept;
}

/* Takes the cells of one instant, a random one from each stratum. */
static void take_cells(cells_job *job, const plane_pixel *p, const pixel_grid *grid, uint32_t now, double weight)
{
    const uint32_t wide = (uint32_t)grid->strata[0], high = (uint32_t)grid->strata[1];
    const double choice[2] = {grid->cells[0] / grid->strata[0], grid->cells[1] / grid->strata[1]};
    for (uint32_t i = 0; i < wide * high; i++) {
        while (job->stacked >= STACK / 2)
            work_off(job);
        const uint64_t key = key_of(job->instants[now].key, i);
        const double column = floor((i % wide + random_of(key, 0)) * choice[0]), row = floor((i / wide + random_of(key, 1)) * choice[1]);
        const cell c = {.x = (double)p->x + (column + 0.5) / grid->cells[0],
                        .y = (double)p->y + (row + 0.5) / grid->cells[1],
                        .half_x = 0.5 / grid->cells[0],
                        .half_y = 0.5 / grid->cells[1],
                        .weight = weight / (grid->strata[0] * grid->strata[1]),
                        .key = key_of(key, 0),
                        .scale_x = 1,
                        .scale_y = 1,
                        .instant = (uint8_t)now};
        push(job, &c);
    }
}

/* Renders one pixel of the mean surface at `count` of all instants, beginning with `first`. */
static void look_at_pixel(cells_job *job, int64_t x, int64_t y, uint64_t key, uint32_t first, uint32_t count)
{
    const mgt_quality *quality = &job->frame->scene.quality;
    const uint32_t all = job->frame->scene.shutter > 0 ? quality->time_samples : 1;
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t own = key_of(key, first + i);
        job->instants[i] = instant_at(job->frame, (first + i + random_of(own, 0)) / all);
        job->instants[i].key = own;
    }
    const instant *now = &job->instants[0];
    const plane_pixel pixel = pixel_at(now, x, y);
    const vec3 ray = ray_through(now, (double)x + 0.5, (double)y + 0.5);
    const double flat = sqrt(ray.x * ray.x + ray.z * ray.z);
    double(*axes)[2] = job->lanes.axes;
    axes[0][0] = axes[1][1] = flat > 0 ? ray.x / flat : 0;
    axes[0][1] = flat > 0 ? ray.z / flat : 1;
    axes[1][0] = -axes[0][1];
    const pixel_grid grid = grid_of(job->size, pixel.lengths, quality->light_cells);
    job->bounded = pixel.bounded;
    if (job->bounded) {
        bound_pixel(job, &pixel, &grid);
        count = keep_seen(job, &pixel, count);
    }
    for (uint32_t i = 0; i < count; i++)
        take_cells(job, &pixel, &grid, i, 1.0 / all);
    while (job->stacked > 0)
        work_off(job);
}

typedef struct plane_area {
    double least[2], most[2];
} plane_area;

static void include(plane_area *to, double x, double y)
{
    to->least[0] = fmin(to->least[0], x);
    to->least[1] = fmin(to->least[1], y);
    to->most[0] = fmax(to->most[0], x);
    to->most[1] = fmax(to->most[1], y);
}

/* Widens an area by the part of the mean surface that lies under the waves which a place of the picture may show. */
static void include_below(const reference_frame *frame, const instant *now, double x, double y, plane_area *to)
{
    const vec3 ray = ray_through(now, x, y);
    const double bound = frame->height_bound;
    if (!(ray.y < -least_fall)) {
        include(to, x, y + ray.y / (now->up.y * now->scale_y)); /* the horizon */
        return;
    }
    for (int side = -1; side <= 1; side += 2) {
        vec3 from_camera = scaled3(ray, (now->position.y - side * bound) / -ray.y);
        from_camera.y = -now->position.y;
        const place seen = place_of(now, from_camera);
        include(to, seen.x, seen.y);
    }
}

static plane_area area_below(const reference_frame *frame, const light_cells_area *area)
{
    plane_area found = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int t = 0; t <= 4; t++) {
        const instant now = instant_at(frame, 0.25 * t);
        for (int corner = 0; corner < 4; corner++)
            include_below(frame, &now, (double)area->x0 + corner % 2 * (double)area->width, (double)area->y0 + corner / 2 * (double)area->height, &found);
    }
    return found;
}

/* ---- the whole ---- */

/* Whether all of the mean surface that the picture may show is in front of the camera. */
static bool plane_ahead(const reference_frame *frame)
{
    for (int i = 0; i < 8; i++) {
        const instant now = instant_at(frame, i / 4);
        const vec3 ray = ray_through(&now, i % 2 * 2 * now.half_width, i / 2 % 2 * 2 * now.half_height);
        vec3 from_camera = scaled3(ray, (now.position.y - frame->height_bound) / -ray.y);
        from_camera.y = -now.position.y;
        if (ray.y < -least_fall && !(dot3(from_camera, now.forward) > 0.01 * length3(from_camera)))
            return false;
    }
    return true;
}

bool light_cells_serve(const reference_frame *frame)
{
    double direction[3], radius;
    bool up = false;
    for (int i = 0; i < reference_lights_count(frame->lights); i++)
        up = up || reference_lights_disk(frame->lights, i, direction, &radius);
    const double lowest = fmin(frame->view.position[1], frame->view_open.position[1]);
    return up && frame->scene.quality.light_cells > 0 && frame->choppiness == 0 && frame->height_bound < 0.95 * lowest && plane_ahead(frame);
}

static void set_lights(cells_job *job)
{
    for (int i = 0; i < reference_lights_count(job->frame->lights); i++) {
        double direction[3], radius;
        if (reference_lights_disk(job->frame->lights, i, direction, &radius))
            job->lanes.disks[job->lanes.lights++] = (light_disk){{direction[0], direction[1], direction[2]}, sin(fmin(radius, 1.57)), 1 - cos(radius)};
    }
}

uint64_t light_cells_render(const reference_frame *frame, const light_cells_area *area, light_cells_sum *sums)
{
    cells_job job;
    job.frame = frame;
    job.area = area;
    job.sums = sums;
    job.lanes.lights = 0;
    job.lanes.bend = (reference_bend){{0}, {0}, {0}, 0};
    job.lanes.fair_share = fair_share;
    job.evaluations = 0;
    job.stacked = job.hits = 0;
    job.batch.evaluations = 0;
    job.size = reference_waves_straight(frame->waves, frame->wave_count, curved_fraction);
    set_lights(&job);
    memset(sums, 0, (size_t)area->width * area->height * sizeof *sums);
    const plane_area below = area_below(frame, area);
    const uint32_t instants = frame->scene.shutter > 0 ? frame->scene.quality.time_samples : 1;
    const uint32_t most = frame->scene.camera_moves ? 1 : MOST_INSTANTS; /* bounds are of one view */
    for (int64_t y = (int64_t)floor(below.least[1]) - 1; y <= (int64_t)ceil(below.most[1]); y++)
        for (int64_t x = (int64_t)floor(below.least[0]) - 1; x <= (int64_t)ceil(below.most[0]); x++) {
            const uint64_t key = key_of(key_of(key_of(frame->scene.quality.seed ^ 0x6c69676874u, (uint64_t)x), (uint64_t)y), 0);
            for (uint32_t first = 0; first < instants; first += most)
                look_at_pixel(&job, x, y, key, first, instants - first < most ? instants - first : most);
        }
    settle_hits(&job);
    return job.evaluations + job.batch.evaluations;
}
