/* SPDX-License-Identifier: MIT
 * Method taa (after Karis 2014): pictures of method `none`, jittered within the pixel, blended into a history that follows the camera and is
 * clamped to what the pixel's neighbours show now. The history is rendered anew for every frame, so that a frame depends on the scene alone. */
#include <math.h>
#include <string.h>

#include "base/triples.h"
#include "frame/whole_frame.h"

/* ---- one row ---- */

Reprojection reprojection_of(const camera_rays *now, const camera_rays *before)
{
    const double *right = before->right, *down = before->down;
    double normal[3];
    cross3(right, down, normal);
    const double ahead = dot3(normal, before->corner), columns = dot3(right, right), rows = dot3(down, down);
    return (Reprojection){.ray_x = (float)now->corner[0],
                          .ray_y = (float)now->corner[1],
                          .ray_z = (float)now->corner[2],
                          .right_x = (float)now->right[0],
                          .right_y = (float)now->right[1],
                          .right_z = (float)now->right[2],
                          .down_x = (float)now->down[0],
                          .down_y = (float)now->down[1],
                          .down_z = (float)now->down[2],
                          .moved_x = (float)(now->position[0] - before->position[0]),
                          .moved_y = (float)(now->position[1] - before->position[1]),
                          .moved_z = (float)(now->position[2] - before->position[2]),
                          .ahead_x = (float)(normal[0] / ahead),
                          .ahead_y = (float)(normal[1] / ahead),
                          .ahead_z = (float)(normal[2] / ahead),
                          .column_x = (float)(right[0] / columns),
                          .column_y = (float)(right[1] / columns),
                          .column_z = (float)(right[2] / columns),
                          .first_column = (float)(dot3(before->corner, right) / columns),
                          .row_x = (float)(down[0] / rows),
                          .row_y = (float)(down[1] / rows),
                          .row_z = (float)(down[2] / rows),
                          .first_row = (float)(dot3(before->corner, down) / rows)};
}

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/display/blend.k"
#include "kernels/display/reproject.k"

float taa_weight(int frames) { return fmaxf(1.0f / (float)(frames + 1), 0.1f); }

static inline BlendPixel pixel_of(const picture_planes *p, size_t i)
{
    const float *c = p->color + 3 * i;
    return (BlendPixel){{c[0], c[1], c[2]}, p->coverage[i], p->water[i]};
}

/* The history by bilinear interpolation. */
static BlendPixel history_at(const picture_planes *p, ReprojectedPixel at)
{
    const uint32_t x0 = (uint32_t)at.column, y0 = (uint32_t)at.row, x1 = x0 + 1 < p->width ? x0 + 1 : x0, y1 = y0 + 1 < p->height ? y0 + 1 : y0;
    const float u = at.column - (float)x0, v = at.row - (float)y0;
    const size_t high = (size_t)y0 * p->width, low = (size_t)y1 * p->width;
    const BlendPixel above = blend_lerp(NULL, pixel_of(p, high + x0), pixel_of(p, high + x1), u);
    return blend_lerp(NULL, above, blend_lerp(NULL, pixel_of(p, low + x0), pixel_of(p, low + x1), u), v);
}

static BlendPixel blended(const taa_step *s, const Reprojection *history, uint32_t x, uint32_t y)
{
    const picture_planes *current = s->current;
    const float width = (float)current->width, height = (float)current->height;
    const size_t pixel = (size_t)y * current->width + x;
    const BlendPixel now = pixel_of(current, pixel);
    BlendPixel past;
    if (s->still) {
        past = pixel_of(s->history, pixel);
    } else {
        /* Only the camera's motion counts: waves do not carry points of the water along. */
        const ReprojectedPixel at = reproject(NULL, *history, width, height, (float)x, (float)y, current->depth[pixel]);
        if (!at.inside)
            return now;
        past = history_at(s->history, at);
    }
    BlendPixel least = now, most = now;
    for (uint32_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < current->height; j++)
        for (uint32_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < current->width; i++) {
            const BlendPixel p = pixel_of(current, (size_t)j * current->width + i);
            least = blend_least(NULL, least, p);
            most = blend_most(NULL, most, p);
        }
    return taa_blend(NULL, now, past, least, most, taa_weight(s->frames));
}

void taa_blend_row(const taa_step *s, uint32_t y)
{
    const Reprojection history = s->still ? (Reprojection){0} : reprojection_of(&s->now, &s->before);
    for (uint32_t x = 0; x < s->current->width; x++) {
        const size_t pixel = (size_t)y * s->current->width + x;
        const BlendPixel p = blended(s, &history, x, y);
        memcpy(s->out->color + 3 * pixel, &p.color, sizeof p.color);
        s->out->coverage[pixel] = p.coverage;
        s->out->water[pixel] = p.water;
    }
}

/* ---- frames of the history ---- */

double taa_interval(const mgt_scene *s) { return s->frame_interval > 0 ? s->frame_interval : s->shutter > 0 ? s->shutter : 1.0 / 30; }

mgt_camera taa_camera(const mgt_scene *s, double share)
{
    mgt_camera c = s->camera;
    if (!s->camera_moves)
        return c;
    for (int i = 0; i < 3; i++) {
        c.position[i] += share * (s->camera_open.position[i] - s->camera.position[i]);
        c.target[i] += share * (s->camera_open.target[i] - s->camera.target[i]);
        c.up[i] += share * (s->camera_open.up[i] - s->camera.up[i]);
    }
    c.fov_y_deg = fmin(fmax(c.fov_y_deg + share * (s->camera_open.fov_y_deg - s->camera.fov_y_deg), 1), 178);
    c.position[1] = s->camera.position[1] < 0 ? fmin(c.position[1], 0.1 * s->camera.position[1]) : fmax(c.position[1], 0.1 * s->camera.position[1]);
    return c;
}

/* The i-th point of Halton's sequence in this base, i ≥ 1. */
static double halton(unsigned i, unsigned base)
{
    double value = 0, part = 1;
    for (; i > 0; i /= base) {
        part /= base;
        value += part * (i % base);
    }
    return value;
}

void taa_offset(int back, double offset[2])
{
    offset[0] = halton((unsigned)(TAA_FRAMES - back), 2) - 0.5;
    offset[1] = halton((unsigned)(TAA_FRAMES - back), 3) - 0.5;
}

typedef struct taa_history {
    const picture_maker *m;
    const mgt_scene *scene;
    double interval; /* seconds between frames */
} taa_history;

/* The rays of the frame `back` frames ago, through the pixels' centres. */
static camera_rays rays_before(const taa_history *h, int back)
{
    const double share = h->scene->shutter > 0 ? back * h->interval / h->scene->shutter : 0;
    const mgt_camera camera = taa_camera(h->scene, share);
    return camera_rays_of(&camera, h->scene->image.width, h->scene->image.height);
}

static mgt_status render_current(const taa_history *h, int back, const picture_planes *p)
{
    mgt_scene scene = *h->scene;
    scene.time -= back * h->interval;
    frame_pass pass = {rays_before(h, back), (double)(TAA_FRAMES - 1 - back) / TAA_FRAMES, 1.0 / TAA_FRAMES, false};
    double offset[2];
    taa_offset(back, offset);
    for (int i = 0; i < 3; i++)
        pass.camera.corner[i] += offset[0] * pass.camera.right[i] + offset[1] * pass.camera.down[i];
    const size_t size = sizeof(mgt_target);
    const mgt_target layers[] = {{size, MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, p->color, 0},
                                 {size, MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, p->coverage, 0},
                                 {size, MGT_LAYER_MASK, MGT_FORMAT_R32F, p->water, 0},
                                 {size, MGT_LAYER_DEPTH, MGT_FORMAT_R32F, p->depth, 0}};
    return h->m->render(h->m->user, &scene, layers, scene.camera_moves ? 4 : 3, &pass);
}

static void blend_row(void *argument, size_t y) { taa_blend_row(argument, (uint32_t)y); }

mgt_status taa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out)
{
    const taa_history h = {m, scene, taa_interval(scene)};
    picture_planes current = picture_planes_create(out->width, out->height, METHOD_PASS_TAA),
                   spare = picture_planes_create(out->width, out->height, METHOD_PASS_TAA);
    mgt_status status = MGT_ERROR_MEMORY;
    if (!current.color || !spare.color) {
        report_error(r, status, "render.memory", "out of memory for taa on %u x %u pixels", out->width, out->height);
        goto done;
    }
    picture_planes *history = &spare, *next = out;
    for (int frames = 0; frames < TAA_FRAMES; frames++) {
        const int back = TAA_FRAMES - 1 - frames;
        status = render_current(&h, back, frames == 0 ? history : &current);
        if (status != MGT_OK)
            goto done;
        if (frames == 0)
            continue;
        taa_step step = {&current, history, next, rays_before(&h, back), rays_before(&h, back + 1), !scene->camera_moves, frames};
        m->run(m->user, out->height, blend_row, &step);
        picture_planes *swap = history;
        history = next;
        next = swap;
    }
    if (history != out) /* the parity of TAA_FRAMES decides which of the two planes is written last */
        memcpy(out->color, history->color, (size_t)out->width * out->height * 5 * sizeof(float));
done:
    picture_planes_free(&current);
    picture_planes_free(&spare);
    return status;
}
