/* SPDX-License-Identifier: MIT
 * Method taa (after Karis 2014): pictures of method `none`, jittered within the pixel, blended into a history that follows the camera and is
 * clamped to what the pixel's neighbours show now. The history is rendered anew for every frame, so that a frame depends on the scene alone. */
#include <math.h>
#include <string.h>

#include "frame/whole_frame.h"

/* ---- one row ---- */

/* Where a point of the world is seen by a camera, in pixels; false behind it. */
static bool project(const camera_rays *c, const double point[3], double at[2])
{
    const double *r = c->right, *d = c->down;
    const double n[3] = {r[1] * d[2] - r[2] * d[1], r[2] * d[0] - r[0] * d[2], r[0] * d[1] - r[1] * d[0]};
    double ahead = 0, corner = 0, rr = 0, dd = 0, across = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        ahead += n[i] * (point[i] - c->position[i]);
        corner += n[i] * c->corner[i];
    }
    if (!(ahead * corner > 0))
        return false;
    for (int i = 0; i < 3; i++) {
        const double off = (point[i] - c->position[i]) * (corner / ahead) - c->corner[i];
        across += off * r[i], rr += r[i] * r[i];
        along += off * d[i], dd += d[i] * d[i];
    }
    at[0] = across / rr;
    at[1] = along / dd;
    return true;
}

/* Where the history shows what pixel (x, y) shows now; false where it does not. Waves carry no point along: water stays where it is. */
static bool history_place(const taa_step *s, uint32_t x, uint32_t y, double at[2])
{
    at[0] = x, at[1] = y;
    if (s->still)
        return true;
    const float depth = s->current->depth[(size_t)y * s->current->width + x];
    const double far = isfinite(depth) ? (double)depth : 1e9;
    double ray[3], length = 0, point[3];
    for (int i = 0; i < 3; i++) {
        ray[i] = s->now.corner[i] + x * s->now.right[i] + y * s->now.down[i];
        length += ray[i] * ray[i];
    }
    for (int i = 0; i < 3; i++)
        point[i] = s->now.position[i] + ray[i] * (far / sqrt(length));
    return project(&s->before, point, at) && at[0] >= 0 && at[1] >= 0 && at[0] <= s->current->width - 1 && at[1] <= s->current->height - 1;
}

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/display/blend.k"

float taa_weight(int frames) { return fmaxf(1.0f / (float)(frames + 1), 0.1f); }

static inline BlendPixel pixel_of(const picture_planes *p, size_t i)
{
    const float *c = p->color + 3 * i;
    return (BlendPixel){{c[0], c[1], c[2]}, p->coverage[i], p->water[i]};
}

/* Bilinear. */
static BlendPixel history_at(const picture_planes *p, const double at[2])
{
    const uint32_t x0 = (uint32_t)at[0], y0 = (uint32_t)at[1], x1 = x0 + 1 < p->width ? x0 + 1 : x0, y1 = y0 + 1 < p->height ? y0 + 1 : y0;
    const float u = (float)(at[0] - x0), v = (float)(at[1] - y0);
    const size_t high = (size_t)y0 * p->width, low = (size_t)y1 * p->width;
    const BlendPixel above = blend_mixed(NULL, pixel_of(p, high + x0), pixel_of(p, high + x1), u);
    return blend_mixed(NULL, above, blend_mixed(NULL, pixel_of(p, low + x0), pixel_of(p, low + x1), u), v);
}

static BlendPixel blended(const taa_step *s, uint32_t x, uint32_t y)
{
    const picture_planes *current = s->current;
    const size_t pixel = (size_t)y * current->width + x;
    const BlendPixel now = pixel_of(current, pixel);
    double at[2];
    if (!history_place(s, x, y, at))
        return now;
    BlendPixel least = now, most = now;
    for (uint32_t j = y > 0 ? y - 1 : 0; j <= y + 1 && j < current->height; j++)
        for (uint32_t i = x > 0 ? x - 1 : 0; i <= x + 1 && i < current->width; i++) {
            const BlendPixel p = pixel_of(current, (size_t)j * current->width + i);
            least = blend_least(NULL, least, p);
            most = blend_most(NULL, most, p);
        }
    return taa_blend(NULL, now, s->still ? pixel_of(s->history, pixel) : history_at(s->history, at), least, most, taa_weight(s->frames));
}

void taa_blend_row(const taa_step *s, uint32_t y)
{
    for (uint32_t x = 0; x < s->current->width; x++) {
        const size_t pixel = (size_t)y * s->current->width + x;
        const BlendPixel p = blended(s, x, y);
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
    if (history != out) /* the first is never `out`, and TAA_FRAMES decides which is last */
        memcpy(out->color, history->color, (size_t)out->width * out->height * 5 * sizeof(float));
done:
    picture_planes_free(&current);
    picture_planes_free(&spare);
    return status;
}
