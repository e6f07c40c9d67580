/* SPDX-License-Identifier: MIT
 * Methods over whole pictures, on the GPU: fxaa filters one picture of method `none`, taa blends several of them, adaptive renders its own pictures. */
#include "gl/gl_whole_frame.h"

#include "frame/targets.h"

/* ---- pictures of other methods ---- */

void gl_plain_frame_of(const frame *f, mgt_method method, gl_plain_frame *out)
{
    out->scene = *f->scene;
    out->scene.quality = plain_quality(&f->scene->quality, method);
    frame_by_quality(f, &out->scene, &out->frame);
}

/* The same frame by the method that the frame's method is based on. */
static void base_frame_of(const frame *f, gl_plain_frame *out) { gl_plain_frame_of(f, method_of(f->scene->quality.method)->base, out); }

gl_progress_part gl_progress_part_of(const gl_job *job, double first, double share)
{
    return (gl_progress_part){job->progress, job->progress_user, first, share};
}

static bool report_part(void *user, double fraction)
{
    const gl_progress_part *p = user;
    return p->tell(p->user, p->first + p->share * fraction);
}

gl_job gl_job_of_part(const gl_job *job, const frame *f, gl_progress_part *part)
{
    gl_job own = *job;
    own.frame = f;
    own.shaded_depth = false;
    if (job->progress) {
        own.progress = report_part;
        own.progress_user = part;
    }
    return own;
}

/* ---- passes ---- */

static void bind_textures(const gl_renderer *g, GLuint first, const gl_layers *l)
{
    const gl_image *const images[] = {&l->color, &l->coverage, &l->water};
    for (GLuint i = 0; i < sizeof images / sizeof *images; i++)
        gl_bind_texture(g, first + i, images[i]->name);
}

static mgt_status reserve(gl_renderer *g, gl_layers *l, const region *area, bool color, const reporter *r)
{
    mgt_status status = MGT_OK;
    if (color)
        status = gl_image_reserve(&g->gl, &l->color, GL_RGBA32F, area->width, area->height, r);
    if (status == MGT_OK)
        status = gl_image_reserve(&g->gl, &l->coverage, GL_R32F, area->width, area->height, r);
    if (status == MGT_OK)
        status = gl_image_reserve(&g->gl, &l->water, GL_R32F, area->width, area->height, r);
    return status;
}

/* Runs a program that reads the color, coverage and mask of g->layers and what the caller has bound, and writes those layers of `out`. */
static mgt_status blend(gl_renderer *g, gl_program program, const BlendData *data, const gl_layers *out, const reporter *r)
{
    const gl_api *gl = &g->gl;
    mgt_status status = gl_ring_begin(gl, &g->ring, sizeof *data, 1, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "blend");
    status = gl_use(g, program, r);
    if (status == MGT_OK) {
        gl_uniform(g, BIND_EXTRA, data, sizeof *data);
        bind_textures(g, UNIT_CURRENT, &g->layers);
        gl->BindImageTexture(IMAGE_COLOR, out->color.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
        gl->BindImageTexture(IMAGE_COVERAGE, out->coverage.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
        gl->BindImageTexture(IMAGE_WATER, out->water.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
        gl->DispatchCompute((GLuint)(data->width + GROUP_SIDE - 1) / GROUP_SIDE, (GLuint)(data->height + GROUP_SIDE - 1) / GROUP_SIDE, 1);
        gl->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

static void swap_images(gl_image *a, gl_image *b)
{
    const gl_image c = *a;
    *a = *b;
    *b = c;
}

static void swap_pictures(gl_layers *a, gl_layers *b)
{
    swap_images(&a->color, &b->color);
    swap_images(&a->coverage, &b->coverage);
    swap_images(&a->water, &b->water);
}

/* ---- fxaa ---- */

/* Computes the luma of the displayed picture in layers.color. */
static mgt_status make_luma(gl_renderer *g, const frame *f, const region *area, const reporter *r)
{
    const gl_api *gl = &g->gl;
    const GlareData size = {.fine_width = (int)area->width, .fine_height = (int)area->height};
    mgt_status status = gl_image_reserve(gl, &g->luma, GL_R32F, area->width, area->height, r);
    if (status == MGT_OK)
        status = gl_ring_begin(gl, &g->ring, sizeof size + sizeof f->data, 2, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "blend");
    status = gl_use(g, PROGRAM_LUMA, r);
    if (status == MGT_OK) {
        gl_uniform(g, BIND_FRAME, &f->data, sizeof f->data);
        gl_uniform(g, BIND_EXTRA, &size, sizeof size);
        gl_bind_texture(g, UNIT_FINE, g->layers.color.name);
        gl->BindImageTexture(0, g->luma.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_R32F);
        gl->DispatchCompute((area->width + GROUP_SIDE - 1) / GROUP_SIDE, (area->height + GROUP_SIDE - 1) / GROUP_SIDE, 1);
        gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

static mgt_status render_fxaa(gl_renderer *g, const gl_job *job, const reporter *r)
{
    gl_plain_frame *const none = &g->plain;
    base_frame_of(job->frame, none);
    none->frame.data.want_color = 1;
    gl_progress_part part = gl_progress_part_of(job, 0, 1);
    const gl_job own = gl_job_of_part(job, &none->frame, &part);
    mgt_status status = gl_frame_render(g, &own, r);
    if (status == MGT_OK)
        status = reserve(g, &g->history[0], &job->area, true, r);
    if (status == MGT_OK)
        status = make_luma(g, &none->frame, &job->area, r);
    if (status != MGT_OK)
        return status;
    const BlendData data = {.width = (int)job->area.width, .height = (int)job->area.height};
    gl_bind_texture(g, UNIT_LUMA, g->luma.name);
    status = blend(g, PROGRAM_FXAA, &data, &g->history[0], r);
    swap_pictures(&g->layers, &g->history[0]);
    return status;
}

/* ---- taa ---- */

/* The rays of the frame `back` frames ago, through the pixels' centres. */
static camera_rays rays_before(const gl_job *job, int back)
{
    const mgt_scene *s = job->frame->scene;
    if (!s->camera_moves || s->shutter <= 0)
        return job->frame->close;
    return job->camera_at(job->camera_user, 1 - back * taa_interval(s) / s->shutter);
}

/* Renders the picture of the frame `back` frames ago into g->layers, with that frame's subpixel offset. */
static mgt_status render_current(gl_renderer *g, const gl_job *job, int back, const reporter *r)
{
    gl_plain_frame *const none = &g->plain;
    base_frame_of(job->frame, none);
    none->scene.time -= back * taa_interval(job->frame->scene);
    double offset[2];
    taa_offset(back, offset);
    camera_rays *c = &none->frame.close;
    *c = rays_before(job, back);
    for (int i = 0; i < 3; i++)
        c->corner[i] += offset[0] * c->right[i] + offset[1] * c->down[i];
    gl_progress_part part = gl_progress_part_of(job, (double)(TAA_FRAMES - 1 - back) / TAA_FRAMES, 1.0 / TAA_FRAMES);
    gl_job own = gl_job_of_part(job, &none->frame, &part);
    own.wants_depth = none->scene.camera_moves;
    own.wants_normal = false;
    return gl_frame_render(g, &own, r);
}

/* Blends the picture in g->layers into the history. It reads the history from g->history[0] and writes the new one to g->history[1]. */
static mgt_status add_to_history(gl_renderer *g, const gl_job *job, int back, const reporter *r)
{
    const int frames = TAA_FRAMES - 1 - back;
    BlendData data = {
        .width = (int)job->area.width,
        .height = (int)job->area.height,
        .still = !job->frame->scene->camera_moves,
        .share = taa_weight(frames),
    };
    const camera_rays now = rays_before(job, back), before = rays_before(job, back + 1);
    data.history = reprojection_of(&now, &before);
    bind_textures(g, UNIT_HISTORY, &g->history[0]);
    gl_bind_texture(g, UNIT_DEPTH, g->layers.depth.name);
    return blend(g, PROGRAM_TAA, &data, &g->history[1], r);
}

static mgt_status render_taa(gl_renderer *g, const gl_job *job, const reporter *r)
{
    const bool color = job->frame->data.want_color != 0;
    mgt_status status = reserve(g, &g->history[1], &job->area, color, r);
    for (int back = TAA_FRAMES - 1; back >= 0 && status == MGT_OK; back--) {
        status = render_current(g, job, back, r);
        if (back == TAA_FRAMES - 1) {
            swap_pictures(&g->layers, &g->history[0]);
            continue;
        }
        if (status == MGT_OK)
            status = add_to_history(g, job, back, r);
        swap_pictures(&g->history[0], &g->history[1]);
    }
    swap_pictures(&g->layers, &g->history[0]);
    return status;
}

/* ---- all ---- */

/* Renders depth, normal and foam by the base method. */
static mgt_status render_surface(gl_renderer *g, const gl_job *job, gl_progress_part part, const reporter *r)
{
    gl_plain_frame *const base = &g->plain;
    base_frame_of(job->frame, base);
    base->frame.data.want_color = 0;
    gl_job own = gl_job_of_part(job, &base->frame, &part);
    own.wants_pixels = false;
    return gl_frame_render(g, &own, r);
}

mgt_status gl_whole_frame_render(gl_renderer *g, const gl_job *job, const reporter *r)
{
    if (!job->wants_pixels)
        return render_surface(g, job, gl_progress_part_of(job, 0, 1), r);
    const method_pass pass = method_of(job->frame->scene->quality.method)->pass;
    if (pass == METHOD_PASS_FXAA)
        return render_fxaa(g, job, r);
    /* Foam is rendered before the picture, because shading it overwrites the picture's layers. Depth and normal are rendered after it, because the picture's
     * passes may overwrite them. */
    gl_job foam = *job, picture = *job, surface = *job;
    foam.wants_depth = foam.wants_normal = false;
    picture.wants_foam = surface.wants_foam = false;
    mgt_status status = job->wants_foam ? render_surface(g, &foam, gl_progress_part_of(job, 0, 0), r) : MGT_OK;
    if (status == MGT_OK)
        status = pass == METHOD_PASS_TAA ? render_taa(g, &picture, r) : gl_adaptive_render(g, &picture, r);
    if (status == MGT_OK && (job->wants_depth || job->wants_normal))
        status = render_surface(g, &surface, gl_progress_part_of(job, 1, 0), r);
    return status;
}
