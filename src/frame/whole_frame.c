/* SPDX-License-Identifier: MIT
 * Methods that work on whole pictures: fxaa on one of method `none`, taa on several, adaptive on its own. */
#include "frame/whole_frame.h"
#include "frame/targets.h"

#include <stdlib.h>
#include <string.h>

picture_planes picture_planes_create(uint32_t width, uint32_t height, method_pass pass)
{
    const size_t pixels = (size_t)width * height, extra = pass == METHOD_PASS_TAA ? 1 : pass == METHOD_PASS_ADAPTIVE ? 3 : 0;
    picture_planes p = {.width = width, .height = height, .color = calloc(pixels * (5 + extra), sizeof(float))};
    if (!p.color)
        return p;
    p.coverage = p.color + 3 * pixels;
    p.water = p.coverage + pixels;
    if (pass == METHOD_PASS_TAA)
        p.depth = p.water + pixels;
    if (pass == METHOD_PASS_ADAPTIVE) {
        p.samples = p.water + pixels;
        p.importance = p.samples + pixels;
        p.detail = p.importance + pixels;
    }
    return p;
}

void picture_planes_free(picture_planes *p) { free(p->color); }

/* ---- targets ---- */

static const float *plane_of(const picture_planes *p, mgt_layer layer)
{
    switch (layer) {
    case MGT_LAYER_COLOR:
        return p->color;
    case MGT_LAYER_COVERAGE:
        return p->coverage;
    case MGT_LAYER_SAMPLES:
        return p->samples;
    case MGT_LAYER_IMPORTANCE:
        return p->importance;
    case MGT_LAYER_DETAIL:
        return p->detail;
    default:
        return p->water;
    }
}

static void fill_row(float *out, uint32_t count, float value)
{
    for (uint32_t x = 0; x < count; x++)
        out[x] = value;
}

static void copy_layer(const mgt_target *t, const region *crop, const picture_planes *p, float samples)
{
    const size_t channels = t->layer == MGT_LAYER_COLOR ? 3 : 1;
    const float *plane = plane_of(p, t->layer);
    for (uint32_t y = 0; y < crop->height; y++) {
        float *out = target_row(t, crop, y);
        if (!plane) {
            fill_row(out, crop->width, t->layer == MGT_LAYER_SAMPLES ? samples : 0);
            continue;
        }
        const float *in = plane + ((size_t)(crop->y + y) * p->width + crop->x) * channels;
        if (t->format != MGT_FORMAT_RGBA32F) {
            memcpy(out, in, crop->width * channels * sizeof *out);
            continue;
        }
        for (uint32_t x = 0; x < crop->width; x++, in += 3, out += 4) {
            memcpy(out, in, 3 * sizeof *out);
            out[3] = 1;
        }
    }
}

static bool shows_surface(const mgt_target *t)
{
    return t->layer == MGT_LAYER_DEPTH || t->layer == MGT_LAYER_NORMAL || t->layer == MGT_LAYER_REFRACTION || t->layer == MGT_LAYER_REFRACTION_ERROR ||
           t->layer == MGT_LAYER_FOAM;
}

static mgt_status write_targets(const picture_maker *m, const mgt_scene *scene, const mgt_target *targets, size_t count, const picture_planes *p)
{
    const region crop = image_region(&scene->image);
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        if (targets[i].format == MGT_FORMAT_RGBA8_SRGB)
            status = m->display(m->user, scene, p->color, &targets[i]);
        else if (!shows_surface(&targets[i]))
            copy_layer(&targets[i], &crop, p, samples_per_pixel(&scene->quality));
    return status;
}

mgt_quality plain_quality(const mgt_quality *q, mgt_method method)
{
    return (mgt_quality){.method = method,
                         .spatial_samples = 1,
                         .time_samples = 1,
                         .seed = q->seed,
                         .refraction = q->refraction,
                         .tess_error = q->tess_error,
                         .refraction_samples = q->refraction_samples,
                         .caustics = q->caustics};
}

/* The scene with another method and without a crop. */
static mgt_scene plain_scene(const mgt_scene *scene, mgt_method method)
{
    mgt_scene plain = *scene;
    plain.quality = plain_quality(&scene->quality, method);
    plain.image = (mgt_image){.width = scene->image.width, .height = scene->image.height};
    return plain;
}

/* Renders the layers depth, normal, refraction and foam by the base of the method. `share` is their fraction of the progress. */
static mgt_status render_surface(const picture_maker *m, const mgt_scene *scene, const mgt_target *targets, size_t count, double share)
{
    const frame_pass pass = {camera_rays_of(&scene->camera, scene->image.width, scene->image.height), 0, share, false};
    mgt_scene plain = plain_scene(scene, method_of(scene->quality.method)->base);
    plain.image = scene->image;
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        if (shows_surface(&targets[i]))
            status = m->render(m->user, &plain, &targets[i], 1, &pass);
    return status;
}

mgt_status whole_frame_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    size_t pixels = 0;
    for (size_t i = 0; i < count; i++)
        pixels += !shows_surface(&targets[i]);
    const mgt_status status = render_surface(m, scene, targets, count, pixels ? 0 : 1);
    if (status != MGT_OK || pixels == 0)
        return status;
    const method_row *row = method_of(scene->quality.method);
    mgt_scene whole = plain_scene(scene, row->base);
    picture_planes p = picture_planes_create(whole.image.width, whole.image.height, row->pass);
    mgt_status done = MGT_OK;
    if (!p.color)
        done = report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for %u x %u pixels", whole.image.width, whole.image.height);
    else if (row->pass == METHOD_PASS_ADAPTIVE) {
        whole.quality = scene->quality;
        done = m->adapt(m->user, &whole, &p);
    } else {
        done = row->pass == METHOD_PASS_FXAA ? fxaa_render(m, r, &whole, &p) : taa_render(m, r, &whole, &p);
    }
    if (done == MGT_OK)
        done = write_targets(m, scene, targets, count, &p);
    picture_planes_free(&p);
    return done;
}
