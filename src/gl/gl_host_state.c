/* SPDX-License-Identifier: MIT
 * The state of a host's OpenGL context that the backend touches: saved before a call and put back after it. */
#include "gl/gl_host_state.h"

/* The capabilities that are saved. The depth test is the first one, which gl_host_state_neutral() leaves as it is. */
static const GLenum capabilities[CAPABILITIES] = {
    GL_DEPTH_TEST,
    GL_CULL_FACE,
    GL_STENCIL_TEST,
    GL_RASTERIZER_DISCARD,
    GL_POLYGON_OFFSET_FILL,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_MASK,
    GL_SAMPLE_SHADING,
    GL_COLOR_LOGIC_OP,
    GL_DEPTH_CLAMP,
    GL_DITHER,
    GL_PRIMITIVE_RESTART,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE1,
    GL_CLIP_DISTANCE2,
    GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE4,
    GL_CLIP_DISTANCE5,
    GL_CLIP_DISTANCE6,
    GL_CLIP_DISTANCE7,
};

/* The pixel-store parameters that are saved, and the values that transfers of the backend rely on. */
static const struct {
    GLenum name;
    GLint value;
} pixel_stores[PIXEL_STORES] = {
    {GL_PACK_SWAP_BYTES, 0},    {GL_PACK_LSB_FIRST, 0},   {GL_PACK_ROW_LENGTH, 0},    {GL_PACK_IMAGE_HEIGHT, 0},
    {GL_PACK_SKIP_PIXELS, 0},   {GL_PACK_SKIP_ROWS, 0},   {GL_PACK_SKIP_IMAGES, 0},   {GL_PACK_ALIGNMENT, 4},
    {GL_UNPACK_SWAP_BYTES, 0},  {GL_UNPACK_LSB_FIRST, 0}, {GL_UNPACK_ROW_LENGTH, 0},  {GL_UNPACK_IMAGE_HEIGHT, 0},
    {GL_UNPACK_SKIP_PIXELS, 0}, {GL_UNPACK_SKIP_ROWS, 0}, {GL_UNPACK_SKIP_IMAGES, 0}, {GL_UNPACK_ALIGNMENT, 4},
};

/* ---- bindings ---- */

static void save_ranges(const gl_api *gl, GLenum binding, GLenum start, GLenum size, buffer_range *ranges, GLuint count)
{
    for (GLuint i = 0; i < count; i++) {
        gl->GetIntegeri_v(binding, i, &ranges[i].name);
        gl->GetInteger64i_v(start, i, &ranges[i].start);
        gl->GetInteger64i_v(size, i, &ranges[i].size);
    }
}

static void restore_ranges(const gl_api *gl, GLenum target, const buffer_range *ranges, GLuint count)
{
    for (GLuint i = 0; i < count; i++)
        if (ranges[i].size > 0)
            gl->BindBufferRange(target, i, (GLuint)ranges[i].name, (GLintptr)ranges[i].start, (GLsizeiptr)ranges[i].size);
        else
            gl->BindBufferBase(target, i, (GLuint)ranges[i].name);
}

static void save_textures(const gl_api *gl, gl_host_state *s)
{
    gl->GetIntegerv(GL_ACTIVE_TEXTURE, &s->active_texture);
    for (GLuint i = 0; i < TEXTURE_UNITS; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->texture[i]);
        gl->GetIntegerv(GL_TEXTURE_BINDING_BUFFER, &s->table[i]);
        gl->GetIntegerv(GL_SAMPLER_BINDING, &s->sampler[i]);
    }
    gl->ActiveTexture((GLenum)s->active_texture);
}

static void restore_textures(const gl_api *gl, const gl_host_state *s)
{
    for (GLuint i = 0; i < TEXTURE_UNITS; i++) {
        gl->ActiveTexture(GL_TEXTURE0 + i);
        gl->BindTexture(GL_TEXTURE_2D, (GLuint)s->texture[i]);
        gl->BindTexture(GL_TEXTURE_BUFFER, (GLuint)s->table[i]);
        gl->BindSampler(i, (GLuint)s->sampler[i]);
    }
    gl->ActiveTexture((GLenum)s->active_texture);
}

static void save_images(const gl_api *gl, gl_host_state *s)
{
    for (GLuint i = 0; i < IMAGE_UNITS; i++) {
        image_binding *b = &s->images[i];
        gl->GetIntegeri_v(GL_IMAGE_BINDING_NAME, i, &b->name);
        gl->GetIntegeri_v(GL_IMAGE_BINDING_LEVEL, i, &b->level);
        gl->GetIntegeri_v(GL_IMAGE_BINDING_LAYERED, i, &b->layered);
        gl->GetIntegeri_v(GL_IMAGE_BINDING_LAYER, i, &b->layer);
        gl->GetIntegeri_v(GL_IMAGE_BINDING_ACCESS, i, &b->access);
        gl->GetIntegeri_v(GL_IMAGE_BINDING_FORMAT, i, &b->format);
    }
}

static void restore_images(const gl_api *gl, const gl_host_state *s)
{
    for (GLuint i = 0; i < IMAGE_UNITS; i++) {
        const image_binding *b = &s->images[i];
        gl->BindImageTexture(i, (GLuint)b->name, b->level, b->layered != 0, b->layer, (GLenum)b->access, (GLenum)b->format);
    }
}

/* ---- drawing ---- */

static void set_capability(const gl_api *gl, GLenum name, bool on)
{
    if (on)
        gl->Enable(name);
    else
        gl->Disable(name);
}

static void save_drawing(const gl_api *gl, gl_host_state *s)
{
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_framebuffer);
    gl->GetFloati_v(GL_VIEWPORT, 0, s->viewport);
    gl->GetFloati_v(GL_DEPTH_RANGE, 0, s->depth_range);
    gl->GetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
    gl->GetIntegerv(GL_PATCH_VERTICES, &s->patch_vertices);
    for (int i = 0; i < CAPABILITIES; i++)
        s->capabilities[i] = gl->IsEnabled(capabilities[i]);
    s->blend = gl->IsEnabledi(GL_BLEND, 0);
    gl->GetIntegerv(GL_MAX_VIEWPORTS, &s->viewports);
    if (s->viewports > VIEWPORTS)
        s->viewports = VIEWPORTS;
    for (GLuint i = 0; i < (GLuint)s->viewports; i++)
        s->scissor[i] = gl->IsEnabledi(GL_SCISSOR_TEST, i);
    gl->GetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
    gl->GetIntegerv(GL_DEPTH_FUNC, &s->depth_func);
    gl->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    gl->GetIntegerv(GL_MAX_DRAW_BUFFERS, &s->draw_buffers);
    if (s->draw_buffers > DRAW_BUFFERS)
        s->draw_buffers = DRAW_BUFFERS;
    for (GLuint i = 0; i < (GLuint)s->draw_buffers; i++)
        gl->GetBooleani_v(GL_COLOR_WRITEMASK, i, s->color_mask[i]);
    gl->GetIntegeri_v(GL_BLEND_SRC_RGB, 0, &s->blend_source_rgb);
    gl->GetIntegeri_v(GL_BLEND_DST_RGB, 0, &s->blend_destination_rgb);
    gl->GetIntegeri_v(GL_BLEND_SRC_ALPHA, 0, &s->blend_source_alpha);
    gl->GetIntegeri_v(GL_BLEND_DST_ALPHA, 0, &s->blend_destination_alpha);
    gl->GetIntegeri_v(GL_BLEND_EQUATION_RGB, 0, &s->blend_equation_rgb);
    gl->GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, 0, &s->blend_equation_alpha);
}

void gl_host_state_restore_drawing(const gl_api *gl, const gl_host_state *s)
{
    gl->BindVertexArray((GLuint)s->vertex_array);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)s->draw_framebuffer);
    gl->ViewportIndexedf(0, s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    gl->DepthRangeIndexed(0, (GLdouble)s->depth_range[0], (GLdouble)s->depth_range[1]);
    gl->ClipControl((GLenum)s->clip_origin, (GLenum)s->clip_depth);
    gl->PatchParameteri(GL_PATCH_VERTICES, s->patch_vertices);
    for (int i = 0; i < CAPABILITIES; i++)
        set_capability(gl, capabilities[i], s->capabilities[i]);
    (s->blend ? gl->Enablei : gl->Disablei)(GL_BLEND, 0);
    for (GLuint i = 0; i < (GLuint)s->viewports; i++)
        (s->scissor[i] ? gl->Enablei : gl->Disablei)(GL_SCISSOR_TEST, i);
    gl->DepthMask(s->depth_mask);
    gl->DepthFunc((GLenum)s->depth_func);
    gl->PolygonMode(GL_FRONT_AND_BACK, (GLenum)s->polygon_mode[0]);
    for (GLuint i = 0; i < (GLuint)s->draw_buffers; i++)
        gl->ColorMaski(i, s->color_mask[i][0], s->color_mask[i][1], s->color_mask[i][2], s->color_mask[i][3]);
    gl->BlendFuncSeparatei(0, (GLenum)s->blend_source_rgb, (GLenum)s->blend_destination_rgb, (GLenum)s->blend_source_alpha, (GLenum)s->blend_destination_alpha);
    gl->BlendEquationSeparatei(0, (GLenum)s->blend_equation_rgb, (GLenum)s->blend_equation_alpha);
}

void gl_host_state_neutral(const gl_api *gl, const gl_host_state *s)
{
    for (int i = 1; i < CAPABILITIES; i++)
        if (s->capabilities[i])
            gl->Disable(capabilities[i]);
    gl->Disable(GL_SCISSOR_TEST); /* of all viewports: Mesa clips what is first drawn into a framebuffer by any of them */
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    for (GLuint i = 0; i < (GLuint)s->draw_buffers; i++) {
        const GLboolean first = i == 0;
        gl->ColorMaski(i, first, first, first, first);
    }
}

/* ---- all ---- */

void gl_host_state_save(const gl_api *gl, gl_host_state *s)
{
    gl->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
    GLint deleted = 0;
    if (s->program)
        gl->GetProgramiv((GLuint)s->program, GL_DELETE_STATUS, &deleted);
    if (deleted) /* OpenGL deletes it as soon as another program is made current */
        s->program = 0;
    gl->GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &s->uniform_buffer);
    gl->GetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, &s->storage_buffer);
    gl->GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &s->pack_buffer);
    gl->GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &s->unpack_buffer);
    gl->GetIntegerv(GL_DISPATCH_INDIRECT_BUFFER_BINDING, &s->indirect_buffer);
    gl->GetIntegerv(GL_QUERY_BUFFER_BINDING, &s->query_buffer);
    GLint groups = 0, most_groups = 0;
    gl->GetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &groups);
    gl->GetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &most_groups);
    s->group_fits = groups < most_groups;
    save_ranges(gl, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, s->uniform, UNIFORM_BINDINGS);
    save_ranges(gl, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE, s->storage, STORAGE_BINDINGS);
    save_textures(gl, s);
    save_images(gl, s);
    save_drawing(gl, s);
    for (int i = 0; i < PIXEL_STORES; i++) {
        gl->GetIntegerv(pixel_stores[i].name, &s->pixel_store[i]);
        gl->PixelStorei(pixel_stores[i].name, pixel_stores[i].value);
    }
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl->BindBuffer(GL_QUERY_BUFFER, 0);
}

void gl_host_state_restore(const gl_api *gl, const gl_host_state *s)
{
    /* A program that the host deleted while it was current no longer exists. */
    gl->UseProgram(gl->IsProgram((GLuint)s->program) ? (GLuint)s->program : 0);
    restore_ranges(gl, GL_UNIFORM_BUFFER, s->uniform, UNIFORM_BINDINGS);
    restore_ranges(gl, GL_SHADER_STORAGE_BUFFER, s->storage, STORAGE_BINDINGS);
    gl->BindBuffer(GL_UNIFORM_BUFFER, (GLuint)s->uniform_buffer);
    gl->BindBuffer(GL_SHADER_STORAGE_BUFFER, (GLuint)s->storage_buffer);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, (GLuint)s->pack_buffer);
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, (GLuint)s->unpack_buffer);
    gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, (GLuint)s->indirect_buffer);
    gl->BindBuffer(GL_QUERY_BUFFER, (GLuint)s->query_buffer);
    restore_textures(gl, s);
    restore_images(gl, s);
    gl_host_state_restore_drawing(gl, s);
    for (int i = 0; i < PIXEL_STORES; i++)
        gl->PixelStorei(pixel_stores[i].name, s->pixel_store[i]);
}
