/* SPDX-License-Identifier: MIT
 * Method fxaa (after Lottes 2009): finds edges in the displayed picture of method `none` and reads every pixel a little across its edge.
 *
 * Luma has twelve bits (display_luma() of tone.k). With eight bits a rounding difference of one step would change the blend so much that the pictures of two
 * machines would not agree. Without quantisation rounding would decide ties. */
#include <stdlib.h>
#include <string.h>

#include "frame/whole_frame.h"

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

struct kernel_context {
    const float *luma;
    int width, height;
};

static float LUMA(CTX cx, real x, real y)
{
    const int column = (int)clamp(x, 0.0f, (real)(cx->width - 1)), row = (int)clamp(y, 0.0f, (real)(cx->height - 1));
    return cx->luma[(size_t)row * (size_t)cx->width + (size_t)column];
}

#include "kernels/display/blend.k"
#include "kernels/display/fxaa.k"

fxaa_shift fxaa_shift_of(const float *luma, uint32_t width, uint32_t height, uint32_t column, uint32_t row)
{
    const struct kernel_context cx = {luma, (int)width, (int)height};
    const FxaaShift s = shift_across_edge(&cx, (float)column, (float)row);
    return (fxaa_shift){(int)s.dx, (int)s.dy, s.amount};
}

/* ---- a picture ---- */

typedef struct fxaa_job {
    const picture_planes *in;
    picture_planes *out;
    float *luma;
} fxaa_job;

static inline BlendPixel pixel_of(const picture_planes *p, size_t i)
{
    const float *c = p->color + 3 * i;
    return (BlendPixel){{c[0], c[1], c[2]}, p->coverage[i], p->water[i]};
}

static void fxaa_row(void *argument, size_t y)
{
    const fxaa_job *job = argument;
    const picture_planes *in = job->in, *out = job->out;
    const int width = (int)in->width, height = (int)in->height;
    for (int x = 0; x < width; x++) {
        const fxaa_shift s = fxaa_shift_of(job->luma, in->width, in->height, (uint32_t)x, (uint32_t)y);
        const int column = x + s.dx, row = (int)y + s.dy;
        const bool inside = column >= 0 && row >= 0 && column < width && row < height;
        const size_t to = y * in->width + (size_t)x, from = inside ? (size_t)row * in->width + (size_t)column : to;
        const BlendPixel p = blend_lerp(NULL, pixel_of(in, to), pixel_of(in, from), s.amount);
        memcpy(out->color + 3 * to, &p.color, sizeof p.color);
        out->coverage[to] = p.coverage;
        out->water[to] = p.water;
    }
}

mgt_status fxaa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out)
{
    const size_t pixels = (size_t)out->width * out->height;
    picture_planes in = picture_planes_create(out->width, out->height, METHOD_PASS_FXAA);
    fxaa_job job = {&in, out, malloc(pixels * sizeof(float))};
    mgt_status status = MGT_ERROR_MEMORY;
    if (!in.color || !job.luma) {
        report_error(r, status, "render.memory", "out of memory for fxaa on %u x %u pixels", out->width, out->height);
        goto done;
    }
    const size_t size = sizeof(mgt_target);
    const mgt_target layers[] = {{size, MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, in.color, 0},
                                 {size, MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, in.coverage, 0},
                                 {size, MGT_LAYER_MASK, MGT_FORMAT_R32F, in.water, 0}};
    status = m->render(m->user, scene, layers, 3, NULL);
    if (status != MGT_OK)
        goto done;
    status = m->luma(m->user, scene, in.color, job.luma); /* edges are found in the tone-mapped picture before glare */
    if (status != MGT_OK)
        goto done;
    m->run(m->user, out->height, fxaa_row, &job);
done:
    free(job.luma);
    picture_planes_free(&in);
    return status;
}
