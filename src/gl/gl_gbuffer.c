/* SPDX-License-Identifier: MIT
 * What a camera sees of the objects, drawn by the GPU. */
#include "gl/gl_gbuffer.h"

#include <math.h>

#include "gl/gl_renderer.h"

/* ---- the picture ---- */

typedef struct gbuffer_view {
    uint32_t width, height, left, top;
    RefractData refract;
    PictureData picture;
} gbuffer_view;

static RefractData refract_data(double height, double index, gbuffer_map map)
{
    const double n2 = index * index, k = n2 - 1, critical = k > 0 ? 1 / sqrt(k) : 0;
    return (RefractData){
        .side = height >= 0 ? 1.0f : -1.0f, .distance = (float)fabs(height), .index = (float)index, .index_inverse = (float)(1 / index),
        .index_squared = (float)n2, .excess = (float)k, .excess_root = (float)sqrt(k), .critical = (float)critical,
        .critical_low = (float)(critical - (double)(float)critical), .map = (int)map,
    };
}

static gbuffer_view gbuffer_view_of(const gbuffer_job *job)
{
    const camera_rays *c = &job->camera;
    gbuffer_view v = {.refract = refract_data(c->position[1], job->index, job->map)};
    v.left = (uint32_t)fmax(16, ceil(0.05 * job->width));
    v.top = (uint32_t)fmax(16, ceil(0.05 * job->height));
    v.width = (job->width + 2 * v.left + 15) / 16 * 16;
    v.height = job->height + 2 * v.top;
    const double *r = c->right, *d = c->down, *m = c->corner;
    double inverse[3][3];
    const double *rows[3][2] = {{d, m}, {m, r}, {r, d}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            inverse[i][k] = rows[i][0][(k + 1) % 3] * rows[i][1][(k + 2) % 3] - rows[i][0][(k + 2) % 3] * rows[i][1][(k + 1) % 3];
    const double det = r[0] * inverse[0][0] + r[1] * inverse[0][1] + r[2] * inverse[0][2];
    for (int i = 0; i < 9; i++)
        inverse[i / 3][i % 3] /= det;
    const double middle_x = job->width / 2, middle_y = job->height / 2;
    PictureData *p = &v.picture;
    *p = (PictureData){
        .x_x = (float)(inverse[0][0] - middle_x * inverse[2][0]), .x_y = (float)(inverse[0][1] - middle_x * inverse[2][1]),
        .x_z = (float)(inverse[0][2] - middle_x * inverse[2][2]),
        .y_x = (float)(inverse[1][0] - middle_y * inverse[2][0]), .y_y = (float)(inverse[1][1] - middle_y * inverse[2][1]),
        .y_z = (float)(inverse[1][2] - middle_y * inverse[2][2]),
        .z_x = (float)inverse[2][0], .z_y = (float)inverse[2][1], .z_z = (float)inverse[2][2],
        .eye_height = (float)c->position[1],
        .focal = (float)(1 / sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2])),
        .cosine_squared = 0.25f,
        .left = (float)(-middle_x - v.left - 0.5), .top = (float)(-middle_y - v.top - 0.5),
        .least_depth = 1e-3f,
        .error_squared = (float)(job->error > 0 ? job->error * job->error : 0.0625),
        .short_squared = 1, .long_squared = 64 * 64,
    };
    p->right = p->left + (float)v.width;
    p->bottom = p->top + (float)v.height;
    return v;
}

/* ---- memory ---- */

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
        return report_error(r, MGT_ERROR_UNAVAILABLE, "gl.error", "OpenGL cannot draw into a framebuffer of formats R32I and DEPTH_COMPONENT32F (status 0x%04x)",
                            state);
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
    free_layer(gl, &b->near);
    free_layer(gl, &b->far);
}

/* ---- drawing ---- */

static void begin_drawing(const gl_renderer *g, const gl_gbuffers *b)
{
    const gl_api *gl = &g->gl;
    if (g->host)
        gl_host_state_neutral(gl, g->host);
    gl->BindVertexArray(g->vertex_array);
    const GLuint tables[] = {g->objects.vertices.texture, g->objects.indices.texture};
    for (GLuint i = 0; i < 2; i++) {
        gl->BindTextureUnit(UNIT_VERTICES + i, tables[i]);
        gl->BindSampler(UNIT_VERTICES + i, 0);
    }
    gl->ViewportIndexedf(0, 0, 0, (float)b->width, (float)b->height);
    gl->DepthRangeIndexed(0, 0, 1);
    gl->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl->Enable(GL_DEPTH_TEST);
    gl->Enable(GL_CLIP_DISTANCE0);
    gl->DepthFunc(GL_GREATER);
    gl->DepthMask(GL_TRUE);
    gl->PatchParameteri(GL_PATCH_VERTICES, 3);
}

/* What later passes of a context of our own would trip over; a host gets all of its state back. */
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

static mgt_status draw_layer(gl_renderer *g, const gl_gbuffer *layer, bool bent, const GbufferData *data, const reporter *r)
{
    const gl_api *gl = &g->gl;
    const mgt_status status = gl_use(g, bent ? PROGRAM_GBUFFER_BENT : PROGRAM_GBUFFER, r);
    if (status != MGT_OK)
        return status;
    static const GLint nothing[4] = {-1, -1, -1, -1};
    static const GLfloat farthest = 0;
    gl_uniform(g, BIND_EXTRA, data, sizeof *data);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, layer->framebuffer);
    gl->ClearNamedFramebufferiv(layer->framebuffer, GL_COLOR, 0, nothing);
    gl->ClearNamedFramebufferfv(layer->framebuffer, GL_DEPTH, 0, &farthest);
    const size_t count = 3 * g->objects.world->triangle_count;
    if (count > 0)
        gl->DrawArrays(bent ? GL_PATCHES : GL_TRIANGLES, 0, (GLsizei)count);
    return MGT_OK;
}

mgt_status gl_gbuffers_draw(gl_renderer *g, const gbuffer_job *job, const reporter *r)
{
    const gl_api *gl = &g->gl;
    gl_gbuffers *b = &g->gbuffers;
    const world *w = g->objects.world;
    const gbuffer_view view = gbuffer_view_of(job);
    b->width = view.width;
    b->height = view.height;
    b->left = view.left;
    b->top = view.top;
    b->refract = view.refract;
    b->picture = view.picture;
    mgt_status status = reserve_layer(gl, &b->near, b->width, b->height, r);
    if (status == MGT_OK)
        status = reserve_layer(gl, &b->far, b->width, b->height, r);
    if (status == MGT_OK)
        status = gl_ring_begin(gl, &g->ring, sizeof b->refract + sizeof b->picture + 2 * sizeof(GbufferData), 4, r);
    if (status != MGT_OK)
        return status;
    const double *at = job->camera.position;
    GbufferData data = {(float)(w->origin[0] - at[0]), (float)(w->origin[1] - at[2]), b->refract.side, 0};
    gl_pass_begin(g, "objects");
    gl_uniform(g, BIND_FRAME, &b->refract, sizeof b->refract);
    gl_uniform(g, BIND_WAVES, &b->picture, sizeof b->picture);
    begin_drawing(g, b);
    status = draw_layer(g, &b->near, false, &data, r);
    data.side = -data.side;
    data.crest = (float)job->crest;
    if (status == MGT_OK)
        status = draw_layer(g, &b->far, b->refract.map != 0, &data, r);
    end_drawing(g);
    gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}
