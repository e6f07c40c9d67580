/* SPDX-License-Identifier: MIT
 * Methods that work on whole pictures of method `none`: fxaa on one, taa on several. */
#include "cpu/whole_frame.h"

#include <stdlib.h>
#include <string.h>

picture_planes picture_planes_create(uint32_t width, uint32_t height, bool depth)
{
    const size_t pixels = (size_t)width * height;
    picture_planes p = {width, height, calloc(pixels * (depth ? 6 : 5), sizeof(float)), NULL, NULL, NULL};
    if (!p.color)
        return p;
    p.coverage = p.color + 3 * pixels;
    p.water = p.coverage + pixels;
    p.depth = depth ? p.water + pixels : NULL;
    return p;
}

void picture_planes_free(picture_planes *p)
{
    free(p->color);
}

bool is_whole_frame_method(mgt_method method)
{
    return method == MGT_METHOD_FXAA || method == MGT_METHOD_TAA;
}

/* ---- targets ---- */

static void copy_layer(const mgt_target *t, const region *crop, const picture_planes *p)
{
    const size_t channels = t->layer == MGT_LAYER_COLOR ? 3 : 1;
    const float *plane = t->layer == MGT_LAYER_COLOR ? p->color : t->layer == MGT_LAYER_COVERAGE ? p->coverage : p->water;
    for (uint32_t y = 0; y < crop->height; y++) {
        const float *in = plane + ((size_t)(crop->y + y) * p->width + crop->x) * channels;
        float *out = target_row(t, crop, y);
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
    return t->layer == MGT_LAYER_DEPTH || t->layer == MGT_LAYER_NORMAL;
}

static mgt_status write_targets(const picture_maker *m, const mgt_scene *scene, const mgt_target *targets, size_t count, const picture_planes *p)
{
    const region crop = image_region(&scene->image);
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        if (targets[i].format == MGT_FORMAT_RGBA8_SRGB)
            status = m->display(m->user, scene, p->color, &targets[i]);
        else if (!shows_surface(&targets[i]))
            copy_layer(&targets[i], &crop, p);
    return status;
}

/* Depth and normal are those of `none`; `share` of the progress is theirs. */
static mgt_status render_surface(const picture_maker *m, const mgt_scene *scene, const mgt_target *targets, size_t count, double share)
{
    const frame_pass pass = {camera_rays_of(&scene->camera, scene->image.width, scene->image.height), 0, share};
    mgt_scene none = *scene;
    none.quality.method = MGT_METHOD_NONE;
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        if (shows_surface(&targets[i]))
            status = m->render(m->user, &none, &targets[i], 1, &pass);
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
    mgt_scene none = *scene;
    none.quality.method = MGT_METHOD_NONE;
    none.image = (mgt_image){.width = scene->image.width, .height = scene->image.height};
    picture_planes p = picture_planes_create(none.image.width, none.image.height, scene->quality.method == MGT_METHOD_TAA);
    mgt_status done = MGT_OK;
    if (!p.color)
        done = report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for %u x %u pixels", none.image.width, none.image.height);
    else
        done = scene->quality.method == MGT_METHOD_FXAA ? fxaa_render(m, r, &none, &p) : taa_render(m, r, &none, &p);
    if (done == MGT_OK)
        done = write_targets(m, scene, targets, count, &p);
    picture_planes_free(&p);
    return done;
}
