/* SPDX-License-Identifier: MIT
 * Jobs and uniform numbers of the refraction passes, shared by both backends. */
#include "frame/refraction_data.h"

#include <math.h>

static int map_of(mgt_refraction method)
{
    switch (method) {
    case MGT_REFRACTION_TWO_PHASE:
    case MGT_REFRACTION_HYBRID:
    case MGT_REFRACTION_BROAD:
        return MAP_SAGITTAL;
    case MGT_REFRACTION_LIU:
        return MAP_PATH;
    default:
        return MAP_STRAIGHT;
    }
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

/* Inverts the matrix with these three columns. */
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

/* Whether a method reads a layer at whole pixels, even if a pixel has several rays. */
static bool looks_up(mgt_refraction method)
{
    return method == MGT_REFRACTION_LIU || method == MGT_REFRACTION_BROAD || method == MGT_REFRACTION_NARROW || method == MGT_REFRACTION_SCREEN_SPACE ||
           method == MGT_REFRACTION_OFF;
}

/* Greatest factor by which choppiness makes slopes steeper. */
static double steeper(const frame *f)
{
    const double pressed = sines_pressed(&f->scene->water);
    return 1 / sqrt(1 - pressed * pressed);
}

/* Number of the waves that rays behind the surface may meet again, 0: they meet none. Seen from above, this needs slopes above √(n² − 1). */
static int waves_met_again(const frame *f)
{
    const double n = f->scene->water.index_of_refraction, steepest = steeper(f) * sines_steepest(&f->scene->water);
    return steepest > 0 && (f->under || steepest > sqrt(n * n - 1)) ? (int)f->scene->water.wave_count : 0;
}

void refraction_wave_list(const frame *f, const world *w, SearchWave *out)
{
    const mgt_scene *s = f->scene;
    const double half = s->camera_moves ? 0 : 0.5 * s->shutter;
    sines_searched(&s->water, (wave_meeting){.x = w->origin[0], .z = w->origin[1], .middle = s->time - half}, out);
}

/* Whether edges get extra rays: with method two-phase, unless the scene asks for a number of rays. */
static bool smooths_edges(const mgt_quality *q) { return q->refraction == MGT_REFRACTION_TWO_PHASE && q->refraction_samples == 0; }

/* Height and depth, metres, up to which both layers show objects. It is never 0: layers are rounded to parts of pixels, so they must overlap at the waterline.
 * The water decides which of them a pixel shows. */
static double reach_of(const frame *f) { return fmax(sines_crest(&f->scene->water), 0.002); }

typedef struct box {
    float low[3], high[3];
} box;

/* A box in the coordinates of narrow.k, made a little larger. */
static box box_from_camera(const frame *f, const world *w, box b)
{
    const double foot[3] = {f->close.position[0] - w->origin[0], 0, f->close.position[2] - w->origin[1]};
    box c;
    for (int k = 0; k < 3; k++) {
        const bool turned = f->under && k == 1;
        c.low[k] = (float)((double)(turned ? -b.high[k] : b.low[k]) - foot[k]) - 1e-3f;
        c.high[k] = (float)((double)(turned ? -b.low[k] : b.high[k]) - foot[k]) + 1e-3f;
    }
    return c;
}

/* Bounds of the objects that reach to the camera's side of the surface. */
static box near_box(const frame *f, const world *w)
{
    const float reach = (float)reach_of(f);
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < w->object_count; i++) {
        const world_object *o = &w->objects[i];
        if (f->under ? o->low[1] > reach : o->high[1] < -reach)
            continue;
        for (int k = 0; k < 3; k++)
            b.low[k] = fminf(b.low[k], o->low[k]), b.high[k] = fmaxf(b.high[k], o->high[k]);
    }
    return b;
}

NarrowData refraction_narrow_data(const frame *f, const world *w, const gbuffer *layer)
{
    const camera_rays *c = &f->close;
    const double n = f->scene->water.index_of_refraction;
    const float ray_side = 1.0f / (float)(f->scene->quality.refraction_samples ? f->scene->quality.refraction_samples : 1);
    double rows[3][3];
    invert(c->right, c->down, c->corner, rows);
    const box all = box_from_camera(f, w, (box){{w->low[0], w->low[1], w->low[2]}, {w->high[0], w->high[1], w->high[2]}});
    const box near = box_from_camera(f, w, near_box(f, w));
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
        .gain = (float)(f->under ? n * n : 1 / (n * n)),
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
        .ray_side = ray_side,
        .lookup_side = looks_up(f->scene->quality.refraction) ? 1 : ray_side,
        .low_x = all.low[0],
        .low_y = all.low[1],
        .low_z = all.low[2],
        .high_x = all.high[0],
        .high_y = all.high[1],
        .high_z = all.high[2],
        .near_low_x = near.low[0],
        .near_low_y = near.low[1],
        .near_low_z = near.low[2],
        .near_high_x = near.high[0],
        .near_high_y = near.high[1],
        .near_high_z = near.high[2],
        .wave_height = (float)sines_crest(&f->scene->water),
        .waves = waves_met_again(f),
        .wave_slope = (float)(steeper(f) * sines_steepest(&f->scene->water)),
        .edge_rays = smooths_edges(&f->scene->quality) ? EDGE_RAYS : 0,
        .wave_bend = (float)(steeper(f) * sines_sharpest(&f->scene->water)),
        .choppy = f->scene->water.choppiness > 0,
    };
}

gbuffer_job refraction_job(const frame *f)
{
    const mgt_scene *scene = f->scene;
    const double reach = reach_of(f);
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
    job.map = MAP_STRAIGHT;
    job.trough = 0;
    job.mirrored = true;
    job.crest *= 0.5; /* crests this high are rare; deeper down the surface would hide most of what the layer shows */
    return job;
}

bool refraction_mirrors(const frame *f, const world *w) { return f->under || (w->triangle_count > 0 && w->high[1] > 0); }
