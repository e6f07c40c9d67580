/* SPDX-License-Identifier: MIT
 * Scenes with objects: everything that a frame needs before its tiles.
 *
 * A frame draws three pictures of the objects: those on the camera's side of the water where they stand (near), those beyond it where the flat
 * surface shows them (far), and those on the camera's side where it mirrors them. The mirrored picture is the far one of a camera that is itself
 * mirrored. Tiles then look points up in them for the waves as they are, and shade these. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/refraction_data.h"
#include "cpu/refraction_state.h"
#include "cpu/shade_lanes.h"

void refraction_free(refraction *r)
{
    if (!r)
        return;
    if (r->opened) {
        gbuffers_free(&r->opened->direct);
        gbuffers_free(&r->opened->mirrored);
        refraction_marks_free(r->opened);
        free(r->opened);
    }
    gbuffers_free(&r->direct);
    gbuffers_free(&r->mirrored);
    refraction_marks_free(r);
    shade_free(r->shade);
    world_free(r->world);
    trace_scene_free(r->trace);
    distance_field_free(r->field);
    refraction_truth_free(r->truth);
    free(r->planes);
    free(r);
}

static gbuffer_map map_of(mgt_refraction method)
{
    switch (method) {
    case MGT_REFRACTION_TWO_PHASE:
    case MGT_REFRACTION_HYBRID:
    case MGT_REFRACTION_BROAD:
        return GBUFFER_SAGITTAL;
    case MGT_REFRACTION_LIU:
        return GBUFFER_PATH;
    default:
        return GBUFFER_STRAIGHT;
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

void refraction_plane(const world *w, size_t triangle, float plane[4])
{
    const float *p[3];
    double a[3], b[3], n[3];
    for (size_t c = 0; c < 3; c++)
        p[c] = w->positions + 3 * (size_t)w->indices[3 * triangle + c];
    for (int k = 0; k < 3; k++) {
        a[k] = (double)p[1][k] - (double)p[0][k];
        b[k] = (double)p[2][k] - (double)p[0][k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    const double length = fmax(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1e-30);
    double level = 0;
    for (int k = 0; k < 3; k++) {
        plane[k] = (float)(n[k] / length);
        level += n[k] / length * (double)p[0][k];
    }
    plane[3] = (float)level;
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
    for (size_t t = 0; t < w->triangle_count; t++)
        refraction_plane(w, t, r->planes + 4 * t);
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

NarrowData refraction_narrow_data(const frame *f, const world *w, const gbuffer *layer)
{
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
        .foot_x = (float)(c->position[0] - w->origin[0]),
        .foot_z = (float)(c->position[2] - w->origin[1]),
        .method = (int)f->scene->quality.refraction,
        .thickness = 0.5f,
        .stride = 2,
        .place = 1.0f / (float)(f->scene->quality.refraction_samples ? f->scene->quality.refraction_samples : 1),
        .low_x = (float)(w->low[0] + w->origin[0] - c->position[0]) - 1e-3f,
        .low_y = (f->under ? -w->high[1] : w->low[1]) - 1e-3f,
        .low_z = (float)(w->low[2] + w->origin[1] - c->position[2]) - 1e-3f,
        .high_x = (float)(w->high[0] + w->origin[0] - c->position[0]) + 1e-3f,
        .high_y = (f->under ? -w->low[1] : w->high[1]) + 1e-3f,
        .high_z = (float)(w->high[2] + w->origin[1] - c->position[2]) + 1e-3f,
    };
}

gbuffer_job refraction_job(const frame *f)
{
    const mgt_scene *scene = f->scene;
    /* Pictures are rounded to parts of pixels: they overlap at the waterline, and the water itself says what is in front. */
    const double reach = fmax(crest_of(&scene->water), 0.002);
    return (gbuffer_job){
        .camera = f->under ? mirrored_rays(&f->close) : f->close,
        .width = scene->image.width,
        .height = scene->image.height,
        .index = scene->water.index_of_refraction,
        .map = map_of(scene->quality.refraction),
        .error = scene->quality.tess_error,
        .trough = reach,
        .crest = reach,
    };
}

gbuffer_job refraction_mirrored_job(const frame *f)
{
    gbuffer_job job = refraction_job(f);
    job.camera = mirrored_rays(&job.camera);
    job.map = GBUFFER_STRAIGHT;
    job.trough = 0;
    job.mirrored = true;
    job.crest *= 0.5; /* few waves reach as far as all of them together could: below, the surface would mostly hide what is shown */
    return job;
}

bool refraction_mirrors(const frame *f, const world *w) { return f->under || (w->triangle_count > 0 && w->high[1] > 0); }

static mgt_status draw_layers(refraction *r, thread_pool *pool)
{
    const gbuffer_job job = refraction_job(r->frame), mirrored = refraction_mirrored_job(r->frame);
    const mgt_status status = gbuffers_draw(&r->direct, r->world, &job, r->kernels->raster, pool);
    r->mirrors = refraction_mirrors(r->frame, r->world);
    if (status != MGT_OK || !r->mirrors)
        return status;
    return gbuffers_draw(&r->mirrored, r->world, &mirrored, r->kernels->raster, pool);
}

static bool traces(mgt_refraction method) { return method == MGT_REFRACTION_HYBRID || method == MGT_REFRACTION_TRUTH; }

static mgt_status prepare_trace(refraction *r, const reporter *report, thread_pool *pool)
{
    const world *w = r->world;
    if (r->frame->scene->quality.refraction == MGT_REFRACTION_DISTANCE_FIELD)
        return distance_field_update(&r->field, w, pool, report);
    if (!traces(r->frame->scene->quality.refraction))
        return MGT_OK;
    const trace_triangles triangles = {w->triangle_count, w->vertex_count, w->positions, w->indices, w->version};
    return trace_scene_update(&r->trace, &triangles, thread_pool_size(pool), report);
}

static mgt_status prepare_truth(refraction *r, const reporter *report, mgt_isa isa, uint32_t threads)
{
    refraction_truth_free(r->truth);
    r->truth = NULL;
    if (r->frame->scene->quality.refraction != MGT_REFRACTION_TRUTH)
        return MGT_OK;
    const truth_job job = {
        .scene = r->frame->scene,
        .camera = r->camera,
        .world = r->world,
        .trace = r->trace,
        .shade = shade_points,
        .user = r->shade,
        .isa = isa,
        .workers = threads,
    };
    const mgt_status status = refraction_truth_create(&r->truth, &job);
    return status == MGT_OK ? MGT_OK : report_error(report, status, "render.truth", "the ground truth of refraction: %s", mgt_status_text(status));
}

static near_scene near_scene_of(const refraction *r)
{
    const camera_rays *c = &r->camera;
    near_scene n = {
        .layer = &r->direct.near,
        .edges = r->edges.bytes,
        .planes = r->planes,
        .foot = {r->narrow.data.foot_x, (float)c->position[1], r->narrow.data.foot_z},
        .pixel_angle = r->frame->data.pixel_angle,
        .under = r->frame->under,
        .columns = r->frame->scene->image.width,
        .rows = r->frame->scene->image.height,
    };
    for (int k = 0; k < 3; k++)
        n.corner[k] = (float)c->corner[k], n.right[k] = (float)c->right[k], n.down[k] = (float)c->down[k];
    return n;
}

/* Layers of the frame's camera, and what looks points up in them. */
static mgt_status set_camera(refraction *r, thread_pool *pool)
{
    const frame *f = r->frame;
    r->camera = f->under ? mirrored_rays(&f->close) : f->close;
    const mgt_status status = draw_layers(r, pool);
    if (status != MGT_OK || !refraction_mark(r, pool)) {
        refraction_marks_free(r);
        return MGT_ERROR_MEMORY;
    }
    r->narrow = (narrow_scene){.data = refraction_narrow_data(f, r->world, &r->direct.far),
                               .refract = r->direct.refract,
                               .layers = {&r->direct.far, r->mirrors ? &r->mirrored.far : &r->direct.far},
                               .planes = r->planes,
                               .breaks = {r->breaks[0].bytes, r->breaks[1].bytes}};
    r->near = near_scene_of(r);
    return MGT_OK;
}

static bool prepare_opened(refraction *r, thread_pool *pool)
{
    if (!r->opened && !(r->opened = calloc(1, sizeof *r->opened)))
        return false;
    refraction *o = r->opened;
    o->world = r->world;
    o->planes = r->planes;
    o->shade = r->shade;
    o->trace = r->trace;
    o->field = r->field;
    o->kernels = r->kernels;
    o->moved = *r->frame;
    o->moved.close = r->frame->open;
    o->frame = &o->moved;
    return set_camera(o, pool) == MGT_OK;
}

refraction *refraction_opened(const refraction *r) { return r->frame->scene->camera_moves && !r->truth ? r->opened : NULL; }

mgt_status refraction_prepare(refraction **state, const reporter *report, const frame *f, const sky_state *sky, const lane_kernels *kernels, mgt_isa isa,
                              thread_pool *pool)
{
    if (!*state && !(*state = calloc(1, sizeof **state)))
        goto out_of_memory;
    refraction *r = *state;
    r->kernels = kernels;
    r->frame = f;
    if (world_update(&r->world, f->scene, pool) != MGT_OK || !build_planes(r) || set_camera(r, pool) != MGT_OK ||
        shade_update(&r->shade, r->world, f, sky, kernels->shade) != MGT_OK)
        goto out_of_memory;
    atomic_store(&r->pixels, 0);
    atomic_store(&r->traced, 0);
    const mgt_status status = prepare_trace(r, report, pool);
    if (status != MGT_OK)
        return status;
    if (f->scene->camera_moves && !prepare_opened(r, pool))
        goto out_of_memory;
    return prepare_truth(r, report, isa, thread_pool_size(pool));
out_of_memory:
    return report_error(report, MGT_ERROR_MEMORY, "render.memory", "out of memory for the scene's objects");
}

void refraction_tell(const refraction *r, const reporter *log)
{
    const size_t pixels = atomic_load(&r->pixels), traced = atomic_load(&r->traced);
    report(log, MGT_LOG_DEBUG, "render.refraction", "%zu triangles; drawn: %zu near, %zu far, %zu mirrored; %zu pixels of water, %zu of them traced (%.2f%%)",
           r->world->triangle_count, r->direct.counts.near_triangles, r->direct.counts.far_triangles, r->mirrors ? r->mirrored.counts.far_triangles : (size_t)0,
           pixels, traced, pixels > 0 ? 100.0 * (double)traced / (double)pixels : 0.0);
}
