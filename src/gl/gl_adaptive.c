/* SPDX-License-Identifier: MIT
 * Method adaptive on the GPU: the choice of its scheme, and the layers samples, importance and detail. */
#include "gl/gl_renderer.h"

mgt_status gl_spent_reserve(gl_renderer *g, const region *area, const reporter *r)
{
    gl_image *const images[] = {&g->layers.samples, &g->layers.importance, &g->layers.detail};
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < sizeof images / sizeof *images && status == MGT_OK; i++)
        status = gl_image_reserve(&g->gl, images[i], GL_R32F, area->width, area->height, r);
    return status;
}

mgt_status gl_spent_fill(gl_renderer *g, const region *area, const mgt_quality *quality, const reporter *r)
{
    const gl_image *const images[] = {&g->layers.samples, &g->layers.importance, &g->layers.detail};
    const mgt_status status = gl_spent_reserve(g, area, r);
    if (status != MGT_OK)
        return status;
    for (int i = 0; i < 3; i++) {
        const float value = i == 0 ? samples_per_pixel(quality) : 0;
        g->gl.ClearTexImage(images[i]->name, 0, GL_RED, GL_FLOAT, &value);
    }
    return gl_check(&g->gl, "fill", r);
}

mgt_status gl_adaptive_render(gl_renderer *g, const gl_job *job, const reporter *r)
{
    const mgt_status status = gl_spent_reserve(g, &job->area, r);
    if (status != MGT_OK)
        return status;
    return job->frame->scene->quality.adaptive == MGT_ADAPTIVE_PODEE ? gl_adaptive_podee_render(g, job, r) : gl_cells_render(g, job, r);
}
