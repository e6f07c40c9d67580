/* SPDX-License-Identifier: MIT
 * Scenes with objects: what the pixels of a tile see of them.
 *
 * A frame draws three pictures of the objects: those on the camera's side of the water where they stand (near), those beyond it where the flat
 * surface shows them (far), and those on the camera's side where it mirrors them. The mirrored picture is the far one of a camera that is itself
 * mirrored. Tiles then look points up in them for the waves as they are, and shade these. */
#include "cpu/refraction.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/shade_lanes.h"

struct refraction {
    world *world;
    gbuffers direct, mirrored; /* the camera's layers, and those of its mirror image */
    float *planes;             /* 4 a triangle */
    size_t plane_room;         /* triangles */
    uint64_t plane_version;    /* of the world that they are of */
    shade_scene *shade;
    narrow_scene narrow;
    const lane_kernels *kernels;
    const frame *frame;
    camera_rays camera;        /* as it is, not mirrored */
    bool mirrors;              /* something stands on the camera's side */
    bool needs_far;
};

void refraction_free(refraction *r)
{
    if (!r)
        return;
    gbuffers_free(&r->direct);
    gbuffers_free(&r->mirrored);
    shade_free(r->shade);
    world_free(r->world);
    free(r->planes);
    free(r);
}

/* ---- a frame ---- */

static gbuffer_map map_of(mgt_refraction method)
{
    switch (method) {
    case MGT_REFRACTION_TWO_PHASE:
    case MGT_REFRACTION_HYBRID:
    case MGT_REFRACTION_BROAD: return GBUFFER_SAGITTAL;
    case MGT_REFRACTION_LIU: return GBUFFER_PATH;
    default: return GBUFFER_STRAIGHT;
    }
}

/* What the waves seldom rise above the mean surface by: four deviations, or their sum where that is less. */
static double crest_of(const mgt_water *water)
{
    double sum = 0, variance = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        sum += water->waves[i].amplitude;
        variance += water->waves[i].amplitude * water->waves[i].amplitude / 2;
    }
    return fmin(sum, 4 * sqrt(variance));
}

static bool build_planes(refraction *r)
{
    const world *w = r->world;
    if (r->plane_version == w->version && r->planes)
        return true;
    if (w->triangle_count > r->plane_room || !r->planes) {
        const size_t room = w->triangle_count > 0 ? w->triangle_count : 1;
        float *more = realloc(r->planes, room * 4 * sizeof *more);
        if (!more)
            return false;
        r->planes = more;
        r->plane_room = room;
    }
    for (size_t t = 0; t < w->triangle_count; t++) {
        const float *p[3];
        double a[3], b[3], n[3];
        for (size_t c = 0; c < 3; c++)
            p[c] = w->positions + 3 * (size_t)w->indices[3 * t + c];
        for (int k = 0; k < 3; k++) {
            a[k] = (double)p[1][k] - (double)p[0][k];
            b[k] = (double)p[2][k] - (double)p[0][k];
        }
        for (int k = 0; k < 3; k++)
            n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
        const double length = fmax(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1e-30);
        double level = 0;
        for (int k = 0; k < 3; k++) {
            r->planes[4 * t + (size_t)k] = (float)(n[k] / length);
            level += n[k] / length * (double)p[0][k];
        }
        r->planes[4 * t + 3] = (float)level;
    }
    r->plane_version = w->version;
    return true;
}

/* The matrix whose columns are three vectors, inverted. */
static void invert(const double right[3], const double down[3], const double corner[3], double rows[3][3])
{
    const double *columns[3] = {right, down, corner};
    double det = 0;
    for (int i = 0; i < 3; i++) {
        const double *a = columns[(i + 1) % 3], *b = columns[(i + 2) % 3];
        for (int k = 0; k < 3; k++)
            rows[i][k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    for (int k = 0; k < 3; k++)
        det += rows[0][k] * right[k];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            rows[i][k] /= det;
}

static NarrowData narrow_data(const refraction *r, const gbuffer *layer)
{
    const frame *f = r->frame;
    const camera_rays *c = &f->close;
    const double n = f->scene->water.index_of_refraction;
    double rows[3][3];
    invert(c->right, c->down, c->corner, rows);
    return (NarrowData){
        .column_x = (float)rows[0][0],
        .column_y = (float)rows[0][1],
        .column_z = (float)rows[0][2],
        .distance = (float)c->position[1],
        .row_x = (float)rows[1][0],
        .row_y = (float)rows[1][1],
        .row_z = (float)rows[1][2],
        .side = f->under ? -1 : 1,
        .depth_x = (float)rows[2][0],
        .depth_y = (float)rows[2][1],
        .depth_z = (float)rows[2][2],
        .ratio = (float)(f->under ? n : 1 / n),
        .corner_x = (float)c->corner[0],
        .corner_y = (float)c->corner[1],
        .corner_z = (float)c->corner[2],
        .focal = 1 / f->data.pixel_angle,
        .right_x = (float)c->right[0],
        .right_y = (float)c->right[1],
        .right_z = (float)c->right[2],
        .left = (float)layer->left,
        .down_x = (float)c->down[0],
        .down_y = (float)c->down[1],
        .down_z = (float)c->down[2],
        .top = (float)layer->top,
        .columns = (float)layer->width,
        .rows = (float)layer->height,
        .foot_x = (float)(c->position[0] - r->world->origin[0]),
        .foot_z = (float)(c->position[2] - r->world->origin[1]),
        .method = (int)f->scene->quality.refraction,
        .thickness = 0.5f,
        .stride = 2,
        .slack = (float)crest_of(&f->scene->water),
    };
}

static mgt_status draw_layers(refraction *r, thread_pool *pool)
{
    const mgt_scene *scene = r->frame->scene;
    const mgt_quality *q = &scene->quality;
    gbuffer_job job = {
        .camera = r->camera,
        .width = scene->image.width,
        .height = scene->image.height,
        .index = scene->water.index_of_refraction,
        .map = map_of(q->refraction),
        .error = q->tess_error,
        .crest = crest_of(&scene->water),
    };
    mgt_status status = gbuffers_draw(&r->direct, r->world, &job, r->kernels->raster, pool);
    r->mirrors = r->world->triangle_count > 0 && (r->frame->under ? r->world->low[1] < 0 : r->world->high[1] > 0);
    if (status == MGT_OK && r->mirrors) {
        job.camera = mirrored_rays(&job.camera);
        job.map = GBUFFER_STRAIGHT;
        status = gbuffers_draw(&r->mirrored, r->world, &job, r->kernels->raster, pool);
    }
    return status;
}

mgt_status refraction_prepare(refraction **state, const reporter *report, const frame *f, const sky_state *sky, const lane_kernels *kernels,
                              thread_pool *pool)
{
    if (!*state && !(*state = calloc(1, sizeof **state)))
        goto out_of_memory;
    refraction *r = *state;
    r->kernels = kernels;
    r->frame = f;
    r->camera = f->under ? mirrored_rays(&f->close) : f->close;
    if (world_update(&r->world, f->scene, pool) != MGT_OK || !build_planes(r) || draw_layers(r, pool) != MGT_OK ||
        shade_update(&r->shade, r->world, f, sky, kernels->shade) != MGT_OK)
        goto out_of_memory;
    r->narrow = (narrow_scene){.data = narrow_data(r, &r->direct.far),
                               .refract = r->direct.refract,
                               .layers = {&r->direct.far, r->mirrors ? &r->mirrored.far : &r->direct.far},
                               .planes = r->planes};
    return MGT_OK;
out_of_memory:
    return report_error(report, MGT_ERROR_MEMORY, "render.memory", "out of memory for the scene's objects");
}

/* ---- light of lists of ends ---- */

static void take(float *plane, const uint16_t *list, size_t count)
{
    for (size_t i = 0; i < count; i++)
        plane[i] = plane[list[i]];
}

/* Radiance of the listed pixels' ends, 3 floats each, in the list's order; the ends move together. The list rises. */
static void shade_listed(const refraction *r, tile_objects *o, size_t count)
{
    tile_ends *e = &o->ends;
    if (count < TILE_PIXELS) {
        for (size_t i = 0; i < count; i++)
            e->triangle[i] = e->triangle[o->list[i]];
        for (int k = 0; k < 3; k++) {
            take(e->position[k], o->list, count);
            take(e->direction[k], o->list, count);
            take(e->slopes[k], o->list, count);
        }
        take(e->before, o->list, count);
        take(e->after, o->list, count);
        take(e->water, o->list, count);
    }
    const shade_hits hits = {
        .count = count,
        .triangle = e->triangle,
        .position = {e->position[0], e->position[1], e->position[2]},
        .direction = {e->direction[0], e->direction[1], e->direction[2]},
        .before = e->before,
        .after = e->after,
        .water = e->water,
        .slopes = {e->slopes[0], e->slopes[1], e->slopes[2]},
    };
    shade_points(r->shade, &hits, o->rgb);
}

static void spread_light(const tile_objects *o, size_t count, float (*planes)[TILE_PIXELS])
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            planes[k][o->list[i]] = o->rgb[3 * i + (size_t)k];
}

/* ---- in front of the water ---- */

/* The near layer's element at a pixel of the tile, SIZE_MAX outside of the image. */
static size_t near_element(const refraction *r, uint32_t column, uint32_t row)
{
    const gbuffer *g = &r->direct.near;
    const mgt_image *image = &r->frame->scene->image;
    if (column >= image->width || row >= image->height)
        return SIZE_MAX;
    return (size_t)(g->top + row) * g->width + g->left + column;
}

static void see_near_pixel(const refraction *r, uint32_t column, uint32_t row, size_t element, size_t i, size_t at, tile_objects *o)
{
    const gbuffer *g = &r->direct.near;
    const camera_rays *c = &r->camera;
    tile_ends *e = &o->ends;
    double ray[3], squared = 0;
    for (int k = 0; k < 3; k++) {
        ray[k] = c->corner[k] + column * c->right[k] + row * c->down[k];
        squared += ray[k] * ray[k];
    }
    const double depth = (double)g->depth[element], length = sqrt(squared);
    const double foot[3] = {c->position[0] - r->world->origin[0], c->position[1], c->position[2] - r->world->origin[1]};
    const float *plane = r->planes + 4 * (size_t)g->triangle[element];
    const double facing = (double)plane[0] * ray[0] + (double)plane[1] * ray[1] + (double)plane[2] * ray[2];
    e->triangle[at] = g->triangle[element];
    for (int k = 0; k < 3; k++) {
        e->position[k][at] = (float)(foot[k] + depth * ray[k]);
        e->direction[k][at] = (float)(ray[k] / length);
        e->slopes[k][at] = 0;
        o->normal[k][i] = facing > 0 ? -plane[k] : plane[k];
    }
    e->before[at] = (float)(depth * length);
    e->after[at] = 0;
    e->water[at] = r->frame->under ? e->before[at] : 0;
    o->along[i] = e->before[at];
}

static void see_near(const refraction *r, uint32_t column, uint32_t row, tile_objects *o)
{
    size_t count = 0;
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint32_t x = column + i % TILE_WIDTH, y = row + i / TILE_WIDTH;
        const size_t element = near_element(r, x, y);
        o->share[i] = 0;
        o->along[i] = INFINITY;
        if (element == SIZE_MAX || r->direct.near.triangle[element] < 0)
            continue;
        see_near_pixel(r, x, y, element, i, count, o);
        if (o->water.share[i] > 0 && o->along[i] >= o->water.along[i]) {
            o->along[i] = INFINITY;
            continue;
        }
        o->share[i] = 1;
        o->list[count++] = (uint16_t)i;
    }
    if (count == 0)
        return;
    uint16_t kept[TILE_PIXELS];
    memcpy(kept, o->list, count * sizeof *kept);
    for (size_t i = 0; i < count; i++)
        o->list[i] = (uint16_t)i;
    shade_listed(r, o, count);
    memcpy(o->list, kept, count * sizeof *kept);
    spread_light(o, count, o->color);
}

/* ---- through the surface ---- */

static size_t list_water(tile_objects *o)
{
    size_t count = 0;
    for (uint32_t i = 0; i < TILE_PIXELS; i++)
        if (o->water.share[i] > 0)
            o->list[count++] = (uint16_t)i;
    return count;
}

static void keep_layers(tile_objects *o)
{
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const bool seen = o->water.share[i] > 0 && o->share[i] < 0.5f;
        for (int k = 0; k < 3; k++)
            o->refraction[k][i] = seen ? o->light.body[k][i] : 0;
        o->error[i] = seen ? o->error[i] : 0;
    }
}

static void see_mirrored(const refraction *r, const tile_offset *at, size_t count, tile_objects *o)
{
    memset(o->light.mirrored, 0, sizeof o->light.mirrored);
    memset(o->light.share, 0, sizeof o->light.share);
    if (!r->mirrors || count == 0)
        return;
    r->kernels->narrow->mirrored(&r->narrow, at, &o->water, &o->ends);
    for (size_t i = 0; i < count; i++)
        o->light.share[o->list[i]] = r->frame->under || o->ends.triangle[o->list[i]] >= 0 ? 1 : 0;
    shade_listed(r, o, count);
    spread_light(o, count, o->light.mirrored);
    for (size_t i = 0; i < TILE_PIXELS; i++)
        for (int k = 0; k < 3; k++)
            o->light.mirrored[k][i] *= o->light.share[i];
}

void refraction_tile(const refraction *r, const tile_waves *waves, const tile_guess *guess, uint32_t tile_x, uint32_t tile_y, tile_objects *o)
{
    const tile_offset at = {tile_x * TILE_WIDTH, tile_y * TILE_HEIGHT, 0, 0};
    r->kernels->narrow->water(&r->frame->data, waves, guess, &at, &o->water);
    size_t count = list_water(o);
    memset(o->light.body, 0, sizeof o->light.body);
    if (count > 0) {
        r->kernels->narrow->refracted(&r->narrow, &at, &o->water, &o->ends);
        memcpy(o->error, o->ends.error, sizeof o->error);
        shade_listed(r, o, count);
        spread_light(o, count, o->light.body);
    }
    see_mirrored(r, &at, count, o);
    see_near(r, at.column, at.row, o);
    keep_layers(o);
}

/* ---- over the water ---- */

static void put_before(float *below, const float *above, const float *share)
{
    for (size_t i = 0; i < TILE_PIXELS; i++)
        below[i] = share[i] > 0 ? below[i] + share[i] * (above[i] - below[i]) : below[i];
}

void refraction_compose(const tile_objects *o, tile_pixels *pixels, tile_surface *surface)
{
    if (pixels) {
        put_before(pixels->red, o->color[0], o->share);
        put_before(pixels->green, o->color[1], o->share);
        put_before(pixels->blue, o->color[2], o->share);
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            pixels->coverage[i] *= 1 - o->share[i];
            pixels->water[i] *= 1 - o->share[i];
        }
    }
    if (!surface)
        return;
    for (size_t i = 0; i < TILE_PIXELS; i++)
        if (o->share[i] >= 0.5f) {
            surface->along[i] = o->along[i];
            surface->normal_x[i] = o->normal[0][i];
            surface->normal_y[i] = o->normal[1][i];
            surface->normal_z[i] = o->normal[2][i];
        }
}
