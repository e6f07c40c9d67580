/* SPDX-License-Identifier: MIT
 * Scenes with objects: prepares a frame before its tiles.
 *
 * A frame draws three layers of the objects: front has the objects on the camera's side of the water, refracted those beyond it where the flat surface shows
 * them, and reflected those on the camera's side where the flat surface mirrors them. The reflected layer is the refracted layer of the mirrored camera. Tiles
 * search in these layers for the points that rays bent by the waves meet, and shade these points. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/refraction_state.h"
#include "frame/refraction_data.h"

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
    path_traced_free(r->truth);
    path_dry_free(r->dry);
    free(r->planes);
    free(r->surface);
    free(r);
}

static void fill_surface(const world *w, size_t triangle, const float plane[4], surface_triangle *s)
{
    for (size_t c = 0; c < 3; c++)
        memcpy(s->corners[c], w->positions + 3 * (size_t)w->indices[3 * triangle + c], sizeof s->corners[c]);
    memcpy(s->neighbours, w->neighbours + 3 * triangle, sizeof s->neighbours);
    memcpy(s->normal, plane, sizeof s->normal);
    s->padding = 0;
}

static bool make_plane_room(refraction *r, size_t triangles)
{
    const size_t room = triangles > 0 ? triangles : 1;
    float *planes = malloc(room * 4 * sizeof *planes);
    surface_triangle *surface = aligned_alloc(sizeof *surface, room * sizeof *surface);
    if (!planes || !surface) {
        free(planes);
        free(surface);
        return false;
    }
    free(r->planes);
    free(r->surface);
    r->planes = planes;
    r->surface = surface;
    r->plane_room = room;
    return true;
}

static bool build_planes(refraction *r)
{
    const world *w = r->world;
    if (r->plane_version == w->version && r->planes)
        return true;
    if ((w->triangle_count > r->plane_room || !r->planes) && !make_plane_room(r, w->triangle_count))
        return false;
    for (size_t t = 0; t < w->triangle_count; t++) {
        refraction_plane(w, t, r->planes + 4 * t);
        fill_surface(w, t, r->planes + 4 * t, &r->surface[t]);
    }
    r->plane_version = w->version;
    return true;
}

static mgt_status draw_layers(refraction *r, thread_pool *pool)
{
    const gbuffer_job job = refraction_job(r->frame), mirrored = refraction_mirrored_job(r->frame);
    const mgt_status status = gbuffers_draw(&r->direct, r->world, &job, r->kernels->raster, pool);
    r->mirrors = refraction_mirrors(r->frame, r->world);
    if (status != MGT_OK || !r->mirrors)
        return status;
    return gbuffers_draw(&r->mirrored, r->world, &mirrored, r->kernels->raster, pool);
}

static bool traces(mgt_refraction method) { return method == MGT_REFRACTION_HYBRID || method == MGT_REFRACTION_PATH_TRACED; }

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
    path_traced_free(r->truth);
    r->truth = NULL;
    if (r->frame->scene->quality.refraction != MGT_REFRACTION_PATH_TRACED)
        return MGT_OK;
    mgt_status status = path_dry_update(&r->dry, r->world, threads, report);
    if (status != MGT_OK)
        return status;
    const path_traced_job job = {
        .scene = r->frame->scene,
        .camera = r->camera,
        .world = r->world,
        .trace = r->trace,
        .dry = r->dry,
        .shade = r->kernels->shade->points,
        .user = r->shade,
        .isa = isa,
        .workers = threads,
    };
    status = path_traced_create(&r->truth, &job);
    return status == MGT_OK ? MGT_OK : report_error(report, status, "render.truth", "the ground truth of refraction: %s", mgt_status_text(status));
}

static front_scene front_scene_of(const refraction *r)
{
    const camera_rays *c = &r->camera;
    front_scene n = {
        .layer = &r->direct.front,
        .edges = r->edges.bytes,
        .planes = r->planes,
        .dry = r->frame->under ? NULL : r->world->dry,
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

/* Draws the layers of the frame's camera and sets the data of searches in them. */
static mgt_status set_camera(refraction *r, thread_pool *pool)
{
    const frame *f = r->frame;
    r->camera = f->under ? mirrored_rays(&f->close) : f->close;
    const mgt_status status = draw_layers(r, pool);
    if (status != MGT_OK || !refraction_mark(r, pool)) {
        refraction_marks_free(r);
        return MGT_ERROR_MEMORY;
    }
    r->narrow = (narrow_scene){.data = refraction_narrow_data(f, r->world, &r->direct.refracted),
                               .refract = r->direct.refract,
                               .layers = {&r->direct.refracted, r->mirrors ? &r->mirrored.refracted : &r->direct.refracted},
                               .drawn = {&r->direct, r->mirrors ? &r->mirrored : &r->direct},
                               .planes = r->planes,
                               .breaks = {r->breaks[0].bytes, f->under ? r->breaks[1].bytes : r->breaks[0].bytes}};
    if (r->narrow.data.waves > 0)
        refraction_wave_list(f, r->world, r->narrow.waves);
    r->front = front_scene_of(r);
    return MGT_OK;
}

static bool prepare_opened(refraction *r, thread_pool *pool)
{
    if (!r->opened && !(r->opened = calloc(1, sizeof *r->opened)))
        return false;
    refraction *o = r->opened;
    o->world = r->world;
    o->planes = r->planes;
    o->surface = r->surface;
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
        shade_update(&r->shade, r->world, f, sky) != MGT_OK || !shade_list_triangles(r->shade))
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

void refraction_report(const refraction *r, const reporter *log)
{
    const size_t pixels = atomic_load(&r->pixels), traced = atomic_load(&r->traced);
    report(log, MGT_LOG_DEBUG, "render.refraction",
           "%zu triangles; drawn: %zu front, %zu refracted, %zu reflected; %zu pixels of water, %zu of them traced (%.2f%%)", r->world->triangle_count,
           r->direct.counts.front_triangles, r->direct.counts.far_triangles, r->mirrors ? r->mirrored.counts.far_triangles : (size_t)0, pixels, traced,
           pixels > 0 ? 100.0 * (double)traced / (double)pixels : 0.0);
}
