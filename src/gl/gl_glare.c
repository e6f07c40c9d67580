/* SPDX-License-Identifier: MIT
 * Glare and display on the GPU. The pyramid has the sizes and weights of src/cpu/glare.c. */
#include "frame/glare_plan.h"
#include "gl/gl_renderer.h"
#include "frame/targets.h"

#include <stdlib.h>

void gl_glare_free(gl_renderer *g)
{
    for (size_t i = 0; i < GLARE_LEVELS; i++)
        gl_image_free(&g->gl, &g->glare.levels[i]);
    gl_buffer_free(&g->gl, &g->glare.weights);
    g->glare = (gl_glare){0};
}

/* Sets the sizes of the levels and the places of their weights. Returns the number of weights in all. Places and number count groups of four floats. */
static int place_levels(gl_glare *p, const glare_plan *plan)
{
    int next = 0;
    for (size_t k = 0; k < plan->count; k++) {
        const glare_size *fine = k ? &plan->sizes[k - 1] : &plan->image, *coarse = &plan->sizes[k];
        p->sizes[k] = (GlareData){.fine_width = (int)fine->width,
                                  .fine_height = (int)fine->height,
                                  .coarse_width = (int)coarse->width,
                                  .coarse_height = (int)coarse->height,
                                  .across = next,
                                  .down = next + (int)coarse->width};
        next += (int)(coarse->width + coarse->height);
    }
    return next;
}

/* Reserves the pyramid for pictures of this size and uploads its weights, unless it has that size already. */
static mgt_status prepare_pyramid(gl_renderer *g, uint32_t width, uint32_t height, const reporter *r)
{
    gl_glare *p = &g->glare;
    if (p->width == width && p->height == height)
        return MGT_OK;
    gl_buffer_free(&g->gl, &p->weights);
    p->width = p->height = 0;
    const glare_plan plan = glare_plan_of(width, height);
    const int groups = place_levels(p, &plan);
    p->count = plan.count;
    mgt_status status = MGT_OK;
    for (size_t k = 0; k < plan.count && status == MGT_OK; k++)
        status = gl_image_reserve(&g->gl, &p->levels[k], GL_RGBA32F, (uint32_t)plan.sizes[k].width, (uint32_t)plan.sizes[k].height, r);
    float *weights = groups > 0 ? malloc(4 * (size_t)groups * sizeof *weights) : NULL;
    if (status == MGT_OK && groups > 0 && (!weights || !glare_plan_weights(&plan, weights)))
        status = report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the glare of %u x %u pixels", width, height);
    if (status == MGT_OK && groups > 0) {
        const size_t size = 4 * (size_t)groups * sizeof *weights;
        g->gl.CreateBuffers(1, &p->weights.name);
        g->gl.NamedBufferStorage(p->weights.name, (GLsizeiptr)size, weights, 0);
        p->weights.size = size;
        status = gl_check(&g->gl, "glare", r);
    }
    free(weights);
    if (status == MGT_OK) {
        p->width = width;
        p->height = height;
    }
    return status;
}

/* Runs a program of the pyramid over width × height pixels. */
static mgt_status dispatch(gl_renderer *g, gl_program program, const GlareData *data, int width, int height, const reporter *r)
{
    const mgt_status status = gl_use(g, program, r);
    if (status != MGT_OK)
        return status;
    gl_uniform(g, BIND_EXTRA, data, sizeof *data);
    g->gl.DispatchCompute((GLuint)(width + GROUP_SIDE - 1) / GROUP_SIDE, (GLuint)(height + GROUP_SIDE - 1) / GROUP_SIDE, 1);
    g->gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    return MGT_OK;
}

/* Computes the levels from the picture to the coarsest one, then adds each level to the next finer one, up to the first. `shares` are the fractions of the
 * light that the levels spread. */
static mgt_status spread(gl_renderer *g, const float *shares, const reporter *r)
{
    gl_glare *p = &g->glare;
    const gl_api *gl = &g->gl;
    mgt_status status = MGT_OK;
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_GLARE_WEIGHTS, p->weights.name);
    for (size_t k = 0; k < p->count && status == MGT_OK; k++) {
        gl_bind_texture(g, UNIT_FINE, k ? p->levels[k - 1].name : g->layers.color.name);
        gl->BindImageTexture(0, p->levels[k].name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
        status = dispatch(g, PROGRAM_GLARE_DOWN, &p->sizes[k], p->sizes[k].coarse_width, p->sizes[k].coarse_height, r);
    }
    for (size_t k = p->count; --k > 0 && status == MGT_OK;) {
        GlareData data = p->sizes[k];
        data.keep = shares[k - 1];
        data.gain = k + 1 == p->count ? shares[k] : 1;
        gl_bind_texture(g, UNIT_COARSE, p->levels[k].name);
        gl->BindImageTexture(0, p->levels[k - 1].name, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
        status = dispatch(g, PROGRAM_GLARE_UP, &data, data.fine_width, data.fine_height, r);
    }
    return status;
}

/* Computes the pyramid of layers.color. `shown` gets the first level's size and factors for display.comp, or stays unchanged if the picture is too small for a
 * pyramid. */
static mgt_status apply_glare(gl_renderer *g, float glare, const region *area, GlareData *shown, const reporter *r)
{
    mgt_status status = prepare_pyramid(g, area->width, area->height, r);
    if (status != MGT_OK || g->glare.count == 0)
        return status;
    float shares[GLARE_LEVELS];
    const glare_plan plan = glare_plan_of(area->width, area->height);
    const float kept = glare_plan_fractions(&plan, glare, shares);
    *shown = g->glare.sizes[0];
    shown->keep = kept;
    shown->gain = g->glare.count == 1 ? shares[0] : 1;
    gl_pass_begin(g, "glare");
    status = spread(g, shares, r);
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

mgt_status gl_display_render(gl_renderer *g, const frame *f, const region *area, const reporter *r)
{
    const float glare = f->scene->post.glare;
    GlareData shown = {.fine_width = (int)area->width, .fine_height = (int)area->height};
    mgt_status status = gl_image_reserve(&g->gl, &g->layers.display, GL_RGBA8, area->width, area->height, r);
    const size_t parts = 2 * GLARE_LEVELS + 2;
    if (status == MGT_OK)
        status = gl_ring_begin(&g->gl, &g->ring, parts * sizeof shown + sizeof(FrameData), parts + 1, r);
    if (status == MGT_OK && glare > 0)
        status = apply_glare(g, glare, area, &shown, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "display");
    gl_uniform(g, BIND_FRAME, &f->data, sizeof f->data);
    gl_bind_texture(g, UNIT_FINE, g->layers.color.name);
    if (shown.coarse_width > 0)
        gl_bind_texture(g, UNIT_COARSE, g->glare.levels[0].name);
    g->gl.BindImageTexture(0, g->layers.display.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
    status = dispatch(g, PROGRAM_DISPLAY, &shown, shown.fine_width, shown.fine_height, r);
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}
