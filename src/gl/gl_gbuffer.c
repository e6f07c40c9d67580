/* SPDX-License-Identifier: MIT
 * Draws the layers of the objects that a camera sees. */
#include "gl/gl_gbuffer.h"

#include "gl/gl_renderer.h"

/* ---- memory ---- */

/* Reserves the images of a layer and attaches them to its framebuffer. */
static mgt_status reserve_layer(const gl_api *gl, gl_gbuffer *b, uint32_t width, uint32_t height, const reporter *r)
{
    const GLuint depth = b->depth.name, triangle = b->triangle.name;
    mgt_status status = gl_image_reserve(gl, &b->depth, GL_DEPTH_COMPONENT32F, width, height, r);
    if (status == MGT_OK)
        status = gl_image_reserve(gl, &b->triangle, GL_R32I, width, height, r);
    if (status != MGT_OK || (b->framebuffer && b->depth.name == depth && b->triangle.name == triangle))
        return status;
    if (!b->framebuffer)
        gl->CreateFramebuffers(1, &b->framebuffer);
    gl->NamedFramebufferTexture(b->framebuffer, GL_DEPTH_ATTACHMENT, b->depth.name, 0);
    gl->NamedFramebufferTexture(b->framebuffer, GL_COLOR_ATTACHMENT0, b->triangle.name, 0);
    gl->NamedFramebufferDrawBuffer(b->framebuffer, GL_COLOR_ATTACHMENT0);
    const GLenum state = gl->CheckNamedFramebufferStatus(b->framebuffer, GL_DRAW_FRAMEBUFFER);
    if (state != GL_FRAMEBUFFER_COMPLETE)
        return report_error(r, MGT_ERROR_UNAVAILABLE, "gl.error",
                            "OpenGL cannot draw into a framebuffer of formats R32I and DEPTH_COMPONENT32F (status 0x%04x)", state);
    return gl_check(gl, "objects", r);
}

static void free_layer(const gl_api *gl, gl_gbuffer *b)
{
    if (b->framebuffer)
        gl->DeleteFramebuffers(1, &b->framebuffer);
    b->framebuffer = 0;
    gl_image_free(gl, &b->depth);
    gl_image_free(gl, &b->triangle);
}

void gl_gbuffers_free(const gl_api *gl, gl_gbuffers *b)
{
    free_layer(gl, &b->front);
    free_layer(gl, &b->refracted);
    free_layer(gl, &b->mirrored);
}

/* ---- drawing ---- */

/* Sets the state that drawing a layer needs. */
static void begin_drawing(const gl_renderer *g, const gl_gbuffers *b)
{
    const gl_api *gl = &g->gl;
    if (g->host)
        gl_host_state_neutral(gl, g->host);
    gl->BindVertexArray(g->vertex_array);
    const GLuint tables[] = {g->objects.vertices.texture, g->objects.indices.texture};
    for (GLuint i = 0; i < 2; i++)
        gl_bind_texture(g, UNIT_VERTICES + i, tables[i]);
    gl->ViewportIndexedf(0, 0, 0, (float)b->width, (float)b->height);
    gl->DepthRangeIndexed(0, 0, 1);
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_CLIP_DISTANCE0);
    gl->DepthFunc(GL_GREATER);
    gl->DepthMask(GL_TRUE);
    gl->PatchParameteri(GL_PATCH_VERTICES, 3);
}

/* Restores the drawing state of a host. A context of our own resets only what would disturb later passes. */
static void end_drawing(const gl_renderer *g)
{
    if (g->host) {
        gl_host_state_restore_drawing(&g->gl, g->host);
        return;
    }
    g->gl.Disable(GL_DEPTH_TEST);
    g->gl.Disable(GL_CLIP_DISTANCE0);
    g->gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    g->gl.BindVertexArray(0);
}

static bool is_cut(const world_object *o) { return o->cut; }

static bool is_in_dry(const world_object *o) { return o->in_dry; }

/* Draws the triangles of all objects for which is() returns `so`. */
static void draw_objects(const gl_api *gl, const world *w, bool (*is)(const world_object *o), bool so)
{
    for (size_t i = 0; i < w->object_count; i++) {
        const size_t first = i;
        size_t count = 0;
        for (; i < w->object_count && is(&w->objects[i]) == so; i++)
            count += w->objects[i].triangle_count;
        if (count > 0)
            gl->DrawArrays(GL_TRIANGLES, (GLint)(3 * w->objects[first].first_triangle), (GLsizei)(3 * count));
    }
}

/* Draws one layer: the objects on the camera's side of the surface, or those beyond it. */
static mgt_status draw_layer(gl_renderer *g, const gl_gbuffer *layer, const gbuffer_job *job, bool beyond, const reporter *r)
{
    const gl_api *gl = &g->gl;
    const world *w = g->objects.world;
    const double *at = job->camera.position;
    const RefractData refract = refract_data_of(at[1], job->index, job->map);
    const PictureData picture = gbuffer_picture(job);
    GbufferData data = {
        .move_x = (float)(w->origin[0] - at[0]),
        .move_z = (float)(w->origin[1] - at[2]),
        .side = beyond ? -refract.side : refract.side,
        .crest = (float)(!beyond                ? job->trough
                         : job->map == MAP_PATH ? 0
                                                : job->crest),
    };
    const bool bent = beyond && job->map != MAP_STRAIGHT;
    mgt_status status = gl_ring_begin(gl, &g->ring, sizeof refract + sizeof picture + 2 * sizeof data, 4, r);
    if (status == MGT_OK)
        status = gl_use(g, bent ? PROGRAM_GBUFFER_BENT : PROGRAM_GBUFFER, r);
    if (status != MGT_OK)
        return status;
    static const GLint nothing[4] = {-1, -1, -1, -1};
    static const GLfloat farthest = 0;
    gl_uniform(g, BIND_FRAME, &refract, sizeof refract);
    gl_uniform(g, BIND_PICTURE, &picture, sizeof picture);
    gl_uniform(g, BIND_EXTRA, &data, sizeof data);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, layer->framebuffer);
    gl->ClearBufferiv(GL_COLOR, 0, nothing);
    gl->ClearBufferfv(GL_DEPTH, 0, &farthest);
    if (w->triangle_count == 0)
        return MGT_OK;
    if (w->dry && !job->mirrored && !beyond && refract.side > 0) {
        draw_objects(gl, w, is_in_dry, false);
        data.crest = 1e30f; /* no water hides the inside of a dry hull, however deep it is */
        gl_uniform(g, BIND_EXTRA, &data, sizeof data);
        draw_objects(gl, w, is_in_dry, true);
        return MGT_OK;
    }
    if (!job->mirrored) {
        gl->DrawArrays(bent ? GL_PATCHES : GL_TRIANGLES, 0, (GLsizei)(3 * w->triangle_count));
        return MGT_OK;
    }
    draw_objects(gl, w, is_cut, false);
    data.drop_backs = 1;
    gl_uniform(g, BIND_EXTRA, &data, sizeof data);
    draw_objects(gl, w, is_cut, true);
    return MGT_OK;
}

static mgt_status draw_layers(gl_renderer *g, const gbuffer_job *job, const gbuffer_job *mirrored, const reporter *r)
{
    gl_gbuffers *b = &g->gbuffers;
    mgt_status status = draw_layer(g, &b->front, job, false, r);
    if (status == MGT_OK)
        status = draw_layer(g, &b->refracted, job, true, r);
    return status == MGT_OK && mirrored ? draw_layer(g, &b->mirrored, mirrored, true, r) : status;
}

mgt_status gl_gbuffers_draw(gl_renderer *g, const gbuffer_job *job, const gbuffer_job *mirrored, const reporter *r)
{
    gl_gbuffers *b = &g->gbuffers;
    const gbuffer shape = gbuffer_shape(job);
    if (shape.width > g->limits.texture_side || shape.height > g->limits.texture_side)
        return report_error(r, MGT_ERROR_UNSUPPORTED, "render.size",
                            "%u x %u pixels with a band around them are more than this OpenGL's textures hold: %u a side; use the CPU", job->width, job->height,
                            g->limits.texture_side);
    b->width = shape.width;
    b->height = shape.height;
    b->left = shape.left;
    b->top = shape.top;
    b->least_depth = gbuffer_picture(job).least_depth;
    gl_gbuffer *const layers[] = {&b->front, &b->refracted, &b->mirrored};
    mgt_status status = MGT_OK;
    for (int i = 0; i < (mirrored ? 3 : 2) && status == MGT_OK; i++)
        status = reserve_layer(&g->gl, layers[i], b->width, b->height, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "objects");
    begin_drawing(g, b);
    status = draw_layers(g, job, mirrored, r);
    end_drawing(g);
    g->gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}
