/* SPDX-License-Identifier: MIT
 * See gl_state.h. */
#include "gl_state.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <stdio.h>

enum { UNITS = 16, BINDINGS = 8, DRAW_BUFFERS = 8 };

typedef struct named_value {
    GLenum value;
    const char *name;
    int count;
} named_value;

#define NAMED(value, count)  \
    {                        \
        value, #value, count \
    }

static const named_value values[] = {
    NAMED(GL_ACTIVE_TEXTURE, 1),
    NAMED(GL_ARRAY_BUFFER_BINDING, 1),
    NAMED(GL_BLEND_COLOR, 4),
    NAMED(GL_CLIP_DEPTH_MODE, 1),
    NAMED(GL_CLIP_ORIGIN, 1),
    NAMED(GL_COLOR_CLEAR_VALUE, 4),
    NAMED(GL_COPY_READ_BUFFER_BINDING, 1),
    NAMED(GL_COPY_WRITE_BUFFER_BINDING, 1),
    NAMED(GL_CULL_FACE_MODE, 1),
    NAMED(GL_CURRENT_PROGRAM, 1),
    NAMED(GL_DEPTH_CLEAR_VALUE, 1),
    NAMED(GL_DEPTH_FUNC, 1),
    NAMED(GL_DEPTH_RANGE, 2),
    NAMED(GL_DEPTH_WRITEMASK, 1),
    NAMED(GL_DISPATCH_INDIRECT_BUFFER_BINDING, 1),
    NAMED(GL_DRAW_BUFFER, 1),
    NAMED(GL_DRAW_FRAMEBUFFER_BINDING, 1),
    NAMED(GL_DRAW_INDIRECT_BUFFER_BINDING, 1),
    NAMED(GL_ELEMENT_ARRAY_BUFFER_BINDING, 1),
    NAMED(GL_FRONT_FACE, 1),
    NAMED(GL_LINE_WIDTH, 1),
    NAMED(GL_LOGIC_OP_MODE, 1),
    NAMED(GL_MIN_SAMPLE_SHADING_VALUE, 1),
    NAMED(GL_PACK_ALIGNMENT, 1),
    NAMED(GL_PACK_IMAGE_HEIGHT, 1),
    NAMED(GL_PACK_LSB_FIRST, 1),
    NAMED(GL_PACK_ROW_LENGTH, 1),
    NAMED(GL_PACK_SKIP_IMAGES, 1),
    NAMED(GL_PACK_SKIP_PIXELS, 1),
    NAMED(GL_PACK_SKIP_ROWS, 1),
    NAMED(GL_PACK_SWAP_BYTES, 1),
    NAMED(GL_PATCH_VERTICES, 1),
    NAMED(GL_PIXEL_PACK_BUFFER_BINDING, 1),
    NAMED(GL_PIXEL_UNPACK_BUFFER_BINDING, 1),
    NAMED(GL_POINT_SIZE, 1),
    NAMED(GL_POLYGON_MODE, 1),
    NAMED(GL_POLYGON_OFFSET_FACTOR, 1),
    NAMED(GL_POLYGON_OFFSET_UNITS, 1),
    NAMED(GL_PRIMITIVE_RESTART_INDEX, 1),
    NAMED(GL_PROGRAM_PIPELINE_BINDING, 1),
    NAMED(GL_PROVOKING_VERTEX, 1),
    NAMED(GL_QUERY_BUFFER_BINDING, 1),
    NAMED(GL_READ_BUFFER, 1),
    NAMED(GL_READ_FRAMEBUFFER_BINDING, 1),
    NAMED(GL_RENDERBUFFER_BINDING, 1),
    NAMED(GL_SAMPLE_COVERAGE_INVERT, 1),
    NAMED(GL_SAMPLE_COVERAGE_VALUE, 1),
    NAMED(GL_STENCIL_BACK_FAIL, 1),
    NAMED(GL_STENCIL_BACK_FUNC, 1),
    NAMED(GL_STENCIL_BACK_PASS_DEPTH_FAIL, 1),
    NAMED(GL_STENCIL_BACK_PASS_DEPTH_PASS, 1),
    NAMED(GL_STENCIL_BACK_REF, 1),
    NAMED(GL_STENCIL_BACK_VALUE_MASK, 1),
    NAMED(GL_STENCIL_BACK_WRITEMASK, 1),
    NAMED(GL_STENCIL_CLEAR_VALUE, 1),
    NAMED(GL_STENCIL_FAIL, 1),
    NAMED(GL_STENCIL_FUNC, 1),
    NAMED(GL_STENCIL_PASS_DEPTH_FAIL, 1),
    NAMED(GL_STENCIL_PASS_DEPTH_PASS, 1),
    NAMED(GL_STENCIL_REF, 1),
    NAMED(GL_STENCIL_VALUE_MASK, 1),
    NAMED(GL_STENCIL_WRITEMASK, 1),
    NAMED(GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, 1),
    NAMED(GL_UNIFORM_BUFFER_BINDING, 1),
    NAMED(GL_SHADER_STORAGE_BUFFER_BINDING, 1),
    NAMED(GL_ATOMIC_COUNTER_BUFFER_BINDING, 1),
    NAMED(GL_UNPACK_ALIGNMENT, 1),
    NAMED(GL_UNPACK_IMAGE_HEIGHT, 1),
    NAMED(GL_UNPACK_LSB_FIRST, 1),
    NAMED(GL_UNPACK_ROW_LENGTH, 1),
    NAMED(GL_UNPACK_SKIP_IMAGES, 1),
    NAMED(GL_UNPACK_SKIP_PIXELS, 1),
    NAMED(GL_UNPACK_SKIP_ROWS, 1),
    NAMED(GL_UNPACK_SWAP_BYTES, 1),
    NAMED(GL_VERTEX_ARRAY_BINDING, 1),
    NAMED(GL_DEBUG_GROUP_STACK_DEPTH, 1),
};

static const named_value switches[] = {
    NAMED(GL_CLIP_DISTANCE0, 1),
    NAMED(GL_CLIP_DISTANCE1, 1),
    NAMED(GL_COLOR_LOGIC_OP, 1),
    NAMED(GL_CULL_FACE, 1),
    NAMED(GL_DEBUG_OUTPUT, 1),
    NAMED(GL_DEBUG_OUTPUT_SYNCHRONOUS, 1),
    NAMED(GL_DEPTH_CLAMP, 1),
    NAMED(GL_DEPTH_TEST, 1),
    NAMED(GL_DITHER, 1),
    NAMED(GL_FRAMEBUFFER_SRGB, 1),
    NAMED(GL_LINE_SMOOTH, 1),
    NAMED(GL_MULTISAMPLE, 1),
    NAMED(GL_POLYGON_OFFSET_FILL, 1),
    NAMED(GL_POLYGON_OFFSET_LINE, 1),
    NAMED(GL_POLYGON_SMOOTH, 1),
    NAMED(GL_PRIMITIVE_RESTART, 1),
    NAMED(GL_PRIMITIVE_RESTART_FIXED_INDEX, 1),
    NAMED(GL_PROGRAM_POINT_SIZE, 1),
    NAMED(GL_RASTERIZER_DISCARD, 1),
    NAMED(GL_SAMPLE_ALPHA_TO_COVERAGE, 1),
    NAMED(GL_SAMPLE_ALPHA_TO_ONE, 1),
    NAMED(GL_SAMPLE_COVERAGE, 1),
    NAMED(GL_SAMPLE_MASK, 1),
    NAMED(GL_SAMPLE_SHADING, 1),
    NAMED(GL_STENCIL_TEST, 1),
    NAMED(GL_TEXTURE_CUBE_MAP_SEAMLESS, 1),
};

/* Of each draw buffer, binding point or image unit. */
static const named_value indexed[] = {
    NAMED(GL_BLEND_DST_ALPHA, DRAW_BUFFERS),
    NAMED(GL_BLEND_DST_RGB, DRAW_BUFFERS),
    NAMED(GL_BLEND_EQUATION_ALPHA, DRAW_BUFFERS),
    NAMED(GL_BLEND_EQUATION_RGB, DRAW_BUFFERS),
    NAMED(GL_BLEND_SRC_ALPHA, DRAW_BUFFERS),
    NAMED(GL_BLEND_SRC_RGB, DRAW_BUFFERS),
    NAMED(GL_UNIFORM_BUFFER_BINDING, BINDINGS),
    NAMED(GL_UNIFORM_BUFFER_START, BINDINGS),
    NAMED(GL_UNIFORM_BUFFER_SIZE, BINDINGS),
    NAMED(GL_SHADER_STORAGE_BUFFER_BINDING, BINDINGS),
    NAMED(GL_SHADER_STORAGE_BUFFER_START, BINDINGS),
    NAMED(GL_SHADER_STORAGE_BUFFER_SIZE, BINDINGS),
    NAMED(GL_IMAGE_BINDING_NAME, BINDINGS),
    NAMED(GL_IMAGE_BINDING_LEVEL, BINDINGS),
    NAMED(GL_IMAGE_BINDING_LAYERED, BINDINGS),
    NAMED(GL_IMAGE_BINDING_LAYER, BINDINGS),
    NAMED(GL_IMAGE_BINDING_ACCESS, BINDINGS),
    NAMED(GL_IMAGE_BINDING_FORMAT, BINDINGS),
    NAMED(GL_SAMPLE_MASK_VALUE, 1),
};

static const named_value textures[] = {
    NAMED(GL_TEXTURE_BINDING_1D, 1),        NAMED(GL_TEXTURE_BINDING_2D, 1),
    NAMED(GL_TEXTURE_BINDING_3D, 1),        NAMED(GL_TEXTURE_BINDING_2D_ARRAY, 1),
    NAMED(GL_TEXTURE_BINDING_BUFFER, 1),    NAMED(GL_TEXTURE_BINDING_CUBE_MAP, 1),
    NAMED(GL_TEXTURE_BINDING_RECTANGLE, 1), NAMED(GL_TEXTURE_BINDING_2D_MULTISAMPLE, 1),
    NAMED(GL_SAMPLER_BINDING, 1),
};

#define LENGTH(array) (sizeof(array) / sizeof(array)[0])

static void put(gl_state *state, const char *name, int index, double value)
{
    if (state->count < STATE_VALUES) {
        state->values[state->count].name = name;
        state->values[state->count].index = index;
        state->values[state->count].value = value;
    }
    state->count++;
}

void gl_state_read(gl_state *state)
{
    state->count = 0;
    for (size_t i = 0; i < LENGTH(values); i++) {
        GLdouble got[4] = {0};
        glGetDoublev(values[i].value, got);
        for (int component = 0; component < values[i].count; component++)
            put(state, values[i].name, component, got[component]);
    }
    for (size_t i = 0; i < LENGTH(switches); i++)
        put(state, switches[i].name, 0, glIsEnabled(switches[i].value));
    for (size_t i = 0; i < LENGTH(indexed); i++)
        for (int index = 0; index < indexed[i].count; index++) {
            GLint64 got = 0;
            glGetInteger64i_v(indexed[i].value, (GLuint)index, &got);
            put(state, indexed[i].name, index, (double)got);
        }
    for (int buffer = 0; buffer < DRAW_BUFFERS; buffer++) {
        GLboolean mask[4];
        glGetBooleani_v(GL_COLOR_WRITEMASK, (GLuint)buffer, mask);
        put(state, "GL_COLOR_WRITEMASK", buffer, mask[0] + 2 * mask[1] + 4 * mask[2] + 8 * mask[3]);
        put(state, "GL_BLEND", buffer, glIsEnabledi(GL_BLEND, (GLuint)buffer));
    }
    for (GLuint viewport = 0; viewport < 2; viewport++) {
        GLdouble got[12];
        glGetDoublei_v(GL_VIEWPORT, viewport, got);
        glGetDoublei_v(GL_SCISSOR_BOX, viewport, got + 4);
        glGetDoublei_v(GL_DEPTH_RANGE, viewport, got + 8);
        for (int component = 0; component < 10; component++)
            put(state, component < 4 ? "GL_VIEWPORT" : component < 8 ? "GL_SCISSOR_BOX" : "GL_DEPTH_RANGE", 10 * (int)viewport + component, got[component]);
        put(state, "GL_SCISSOR_TEST", (int)viewport, glIsEnabledi(GL_SCISSOR_TEST, viewport));
    }
    GLint active;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (int unit = 0; unit < UNITS; unit++) {
        glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
        for (size_t i = 0; i < LENGTH(textures); i++) {
            GLint name = 0;
            glGetIntegerv(textures[i].value, &name);
            put(state, textures[i].name, unit, name);
        }
    }
    glActiveTexture((GLenum)active);
}

size_t gl_state_compare(const gl_state *before, const gl_state *after)
{
    size_t different = before->count != after->count || after->count > STATE_VALUES;
    for (size_t i = 0; i < before->count && i < STATE_VALUES; i++)
        if (before->values[i].value != after->values[i].value) {
            fprintf(stderr, "  %s[%d] was %.17g and is now %.17g\n", before->values[i].name, before->values[i].index, before->values[i].value,
                    after->values[i].value);
            different++;
        }
    return different;
}

/* ---- hostile --------------------------------------------------------------------------------------------- */

static const GLenum hostile_switches[] =
    {GL_CLIP_DISTANCE0, GL_COLOR_LOGIC_OP, GL_CULL_FACE, GL_DEPTH_CLAMP,      GL_POLYGON_OFFSET_FILL, GL_RASTERIZER_DISCARD, GL_SAMPLE_MASK,
     GL_SCISSOR_TEST,   GL_STENCIL_TEST,   GL_BLEND,     GL_FRAMEBUFFER_SRGB, GL_SAMPLE_COVERAGE,     GL_PRIMITIVE_RESTART,  GL_SAMPLE_ALPHA_TO_COVERAGE};
static const GLenum buffer_targets[] = {GL_ARRAY_BUFFER,         GL_COPY_READ_BUFFER,  GL_COPY_WRITE_BUFFER,   GL_DISPATCH_INDIRECT_BUFFER,
                                        GL_DRAW_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER, GL_ATOMIC_COUNTER_BUFFER,
                                        GL_QUERY_BUFFER};

/* Values of glPixelStorei, those of a new context last. */
static const struct {
    GLenum name;
    GLint hostile, friendly;
} pixel_store[] = {{GL_PACK_ALIGNMENT, 8, 4},   {GL_PACK_ROW_LENGTH, 7, 0},   {GL_PACK_SKIP_PIXELS, 3, 0},   {GL_PACK_SKIP_ROWS, 5, 0},
                   {GL_PACK_SWAP_BYTES, 1, 0},  {GL_UNPACK_ALIGNMENT, 8, 4},  {GL_UNPACK_ROW_LENGTH, 7, 0},  {GL_UNPACK_SKIP_PIXELS, 3, 0},
                   {GL_UNPACK_SKIP_ROWS, 5, 0}, {GL_UNPACK_SWAP_BYTES, 1, 0}, {GL_UNPACK_IMAGE_HEIGHT, 9, 0}};

/* What is bound everywhere. */
typedef struct hostile_objects {
    GLuint buffer, texture, cube, sampler, array, pipeline, framebuffer, renderbuffer, query;
} hostile_objects;

static hostile_objects made;

void gl_state_make_hostile(void)
{
    hostile_objects *const o = &made;
    glCreateBuffers(1, &o->buffer);
    glNamedBufferStorage(o->buffer, 1 << 16, NULL, 0);
    glCreateTextures(GL_TEXTURE_2D, 1, &o->texture);
    glTextureStorage2D(o->texture, 1, GL_RGBA32F, 4, 4);
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &o->cube);
    glTextureStorage2D(o->cube, 1, GL_RGBA8, 4, 4);
    glCreateSamplers(1, &o->sampler);
    glSamplerParameteri(o->sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glCreateVertexArrays(1, &o->array);
    glCreateProgramPipelines(1, &o->pipeline);
    glCreateFramebuffers(1, &o->framebuffer);
    glCreateRenderbuffers(1, &o->renderbuffer);
    glCreateQueries(GL_TIME_ELAPSED, 1, &o->query);

    for (size_t i = 0; i < LENGTH(hostile_switches); i++)
        glEnable(hostile_switches[i]);
    for (size_t i = 0; i < LENGTH(buffer_targets); i++)
        glBindBuffer(buffer_targets[i], o->buffer);
    for (size_t i = 0; i < LENGTH(pixel_store); i++)
        glPixelStorei(pixel_store[i].name, pixel_store[i].hostile);
    for (GLuint i = 0; i < BINDINGS; i++) {
        glBindBufferRange(GL_UNIFORM_BUFFER, i, o->buffer, 256 * (GLintptr)(i + 1), 512);
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, o->buffer, 256 * (GLintptr)(i + 2), 1024);
        glBindImageTexture(i, o->texture, 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    }
    for (GLuint unit = 0; unit < UNITS; unit++) {
        glBindTextureUnit(unit, o->texture);
        glBindTextureUnit(unit, o->cube);
        glBindSampler(unit, o->sampler);
    }
    glActiveTexture(GL_TEXTURE5);
    glUseProgram(0);
    glBindProgramPipeline(o->pipeline);
    glBindVertexArray(o->array);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, o->framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glBindRenderbuffer(GL_RENDERBUFFER, o->renderbuffer);
    glViewport(3, 5, 17, 19);
    glScissor(1, 2, 3, 4);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_NEVER);
    glStencilFunc(GL_NEVER, 7, 0x55);
    glStencilOp(GL_INCR, GL_DECR, GL_INVERT);
    glStencilMask(0x33);
    glBlendFuncSeparate(GL_DST_COLOR, GL_ONE, GL_ZERO, GL_CONSTANT_ALPHA);
    glBlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
    glBlendColor(0.1f, 0.2f, 0.3f, 0.4f);
    glLogicOp(GL_XOR);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glPolygonOffset(5, 50);
    glSampleMaski(0, 0);
    glSampleCoverage(0.25f, GL_TRUE);
    glPrimitiveRestartIndex(1);
    glBeginQuery(GL_TIME_ELAPSED, o->query);
}

void gl_state_make_friendly(void)
{
    const hostile_objects *const o = &made;
    glEndQuery(GL_TIME_ELAPSED);
    for (size_t i = 0; i < LENGTH(hostile_switches); i++)
        glDisable(hostile_switches[i]);
    for (size_t i = 0; i < LENGTH(buffer_targets); i++)
        glBindBuffer(buffer_targets[i], 0);
    for (size_t i = 0; i < LENGTH(pixel_store); i++)
        glPixelStorei(pixel_store[i].name, pixel_store[i].friendly);
    for (GLuint i = 0; i < BINDINGS; i++) {
        glBindBufferBase(GL_UNIFORM_BUFFER, i, 0);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, 0);
        glBindImageTexture(i, 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8);
    }
    for (GLuint unit = 0; unit < UNITS; unit++) {
        glBindTextureUnit(unit, 0);
        glBindSampler(unit, 0);
    }
    glActiveTexture(GL_TEXTURE0);
    glBindProgramPipeline(0);
    glBindVertexArray(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilMask(~0u);
    glBlendFunc(GL_ONE, GL_ZERO);
    glBlendEquation(GL_FUNC_ADD);
    glBlendColor(0, 0, 0, 0);
    glLogicOp(GL_COPY);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPolygonOffset(0, 0);
    glSampleMaski(0, ~0u);
    glSampleCoverage(1, GL_FALSE);
    glPrimitiveRestartIndex(0);
    glDeleteBuffers(1, &o->buffer);
    glDeleteTextures(1, &o->texture);
    glDeleteTextures(1, &o->cube);
    glDeleteSamplers(1, &o->sampler);
    glDeleteVertexArrays(1, &o->array);
    glDeleteProgramPipelines(1, &o->pipeline);
    glDeleteFramebuffers(1, &o->framebuffer);
    glDeleteRenderbuffers(1, &o->renderbuffer);
    glDeleteQueries(1, &o->query);
}
