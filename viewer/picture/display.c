/* SPDX-License-Identifier: MIT
 * The textures of the sides, and the program that shows them. */
#include "viewer/picture/display.h"

#include <stdio.h>
#include <stdlib.h>

#include "viewer/picture/palette.h"

/* The texture of a side. */
typedef struct side_picture {
    GLuint texture;
    mgt_layer layer;
    uint32_t width, height;
    bool immutable, filled; /* immutable storage is what mgt_gl_render_textures() needs; filled: it holds a picture */
} side_picture;

typedef struct display_uniforms {
    GLint has_b, layer, compare, wipe, scale, range, logarithmic, window, pixels;
} display_uniforms;

struct display {
    const gl_functions *gl;
    GLuint program, vertices, palettes;
    GLint most_side; /* largest side of a texture, pixels */
    display_uniforms uniforms;
    side_picture sides[SIDE_COUNT];
};

/* ---- the program ---- */

static const char vertex_text[] = "#version 330 core\n"
                                  "out vec2 place;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);\n"
                                  "    place = vec2(corner.x, 1.0 - corner.y);\n" /* y down, as in pictures */
                                  "    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);\n"
                                  "}\n";

static const char fragment_text[] = "#version 330 core\n"
                                    "uniform sampler2D side_a, side_b, palettes;\n"
                                    "uniform int has_b, layer, compare, logarithmic;\n"
                                    "uniform float wipe, scale;\n"
                                    "uniform vec2 range;\n"
                                    "uniform vec4 window;\n" /* corner and size of the part that is shown, fractions of the picture */
                                    "uniform vec2 pixels;\n" /* size of the picture in pixels if it is magnified; otherwise 0 */
                                    "in vec2 place;\n"
                                    "out vec4 color;\n"
                                    "const int COLOR = 0, DEPTH = 3, NORMAL = 4;\n"
                                    "const int WIPE = 1, DIFFERENCE = 2;\n"
                                    "vec3 palette(float fraction, float kind)\n"
                                    "{\n"
                                    "    return texture(palettes, vec2((clamp(fraction, 0.0, 1.0) * 255.0 + 0.5) / 256.0, (kind + 0.5) / 2.0)).rgb;\n"
                                    "}\n"
                                    "vec3 lean(vec3 normal)\n" /* the same as palette_lean() */
                                    "{\n"
                                    "    float turn = atan(normal.x, -normal.z) / 6.2831853;\n"
                                    "    vec3 hue = 0.55 + 0.45 * cos(6.2831853 * (turn + vec3(0.0, 0.33333333, 0.66666667)));\n"
                                    "    return mix(vec3(0.06, 0.07, 0.09), hue, sqrt(min(length(normal.xz) / range.y, 1.0)));\n"
                                    "}\n"
                                    "vec3 shown(vec3 value)\n"
                                    "{\n"
                                    "    if (layer == COLOR)\n"
                                    "        return value;\n"
                                    "    if (layer == NORMAL)\n"
                                    "        return dot(value, value) > 0.0 ? lean(value) : vec3(0.03);\n"
                                    "    if (isinf(value.x))\n"
                                    "        return vec3(0.03);\n"
                                    "    if (logarithmic != 0)\n"
                                    "        return palette(log(max(value.x, 1e-9) / range.x) / log(range.y / range.x), 0.0);\n"
                                    "    return palette((value.x - range.x) / (range.y - range.x), 0.0);\n"
                                    "}\n"
                                    "vec3 difference(vec3 a, vec3 b)\n"
                                    "{\n"
                                    "    if (layer == COLOR || layer == NORMAL)\n"
                                    "        return 0.5 + 0.5 * scale * (a - b);\n"
                                    "    if (isinf(a.x) || isinf(b.x))\n"
                                    "        return isinf(a.x) && isinf(b.x) ? vec3(0.03) : vec3(1.0);\n"
                                    "    return palette(0.5 + 0.5 * scale * (a.x - b.x), 1.0);\n"
                                    "}\n"
                                    "void main()\n"
                                    "{\n"
                                    "    vec2 at = window.xy + place * window.zw;\n"
                                    "    if (pixels.x > 0.0)\n"
                                    "        at = (floor(at * pixels) + 0.5) / pixels;\n"
                                    "    vec3 a = texture(side_a, at).rgb;\n"
                                    "    vec3 b = has_b != 0 ? texture(side_b, at).rgb : a;\n"
                                    "    if (compare == DIFFERENCE && has_b != 0)\n"
                                    "        color = vec4(difference(a, b), 1.0);\n"
                                    "    else\n"
                                    "        color = vec4(shown(compare == WIPE && place.x >= wipe ? b : a), 1.0);\n"
                                    "}\n";

static GLuint compile(const gl_functions *gl, GLenum kind, const char *text, char *error, size_t size)
{
    const GLuint shader = gl->CreateShader(kind);
    GLint good = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good)
        return shader;
    gl->GetShaderInfoLog(shader, (GLsizei)size, NULL, error);
    gl->DeleteShader(shader);
    return 0;
}

static bool build_program(display *d, char *error, size_t size)
{
    const gl_functions *gl = d->gl;
    GLint good = 0;
    const GLuint vertex = compile(gl, GL_VERTEX_SHADER, vertex_text, error, size);
    const GLuint fragment = vertex ? compile(gl, GL_FRAGMENT_SHADER, fragment_text, error, size) : 0;
    if (fragment) {
        d->program = gl->CreateProgram();
        gl->AttachShader(d->program, vertex);
        gl->AttachShader(d->program, fragment);
        gl->LinkProgram(d->program);
        gl->GetProgramiv(d->program, GL_LINK_STATUS, &good);
        if (!good)
            gl->GetProgramInfoLog(d->program, (GLsizei)size, NULL, error);
    }
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    return good != 0;
}

static void find_uniforms(display *d)
{
    const gl_functions *gl = d->gl;
    const GLuint p = d->program;
    gl->UseProgram(p);
    gl->Uniform1i(gl->GetUniformLocation(p, "side_a"), 0);
    gl->Uniform1i(gl->GetUniformLocation(p, "side_b"), 1);
    gl->Uniform1i(gl->GetUniformLocation(p, "palettes"), 2);
    gl->UseProgram(0);
    d->uniforms = (display_uniforms){
        .has_b = gl->GetUniformLocation(p, "has_b"),
        .layer = gl->GetUniformLocation(p, "layer"),
        .compare = gl->GetUniformLocation(p, "compare"),
        .wipe = gl->GetUniformLocation(p, "wipe"),
        .scale = gl->GetUniformLocation(p, "scale"),
        .range = gl->GetUniformLocation(p, "range"),
        .logarithmic = gl->GetUniformLocation(p, "logarithmic"),
        .window = gl->GetUniformLocation(p, "window"),
        .pixels = gl->GetUniformLocation(p, "pixels"),
    };
}

static void set_filter(const gl_functions *gl, GLint filter)
{
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

static void make_palettes(display *d)
{
    uint8_t bytes[PALETTE_KINDS][PALETTE_STEPS][4];
    for (int k = 0; k < PALETTE_KINDS; k++)
        for (int i = 0; i < PALETTE_STEPS; i++) {
            const uint32_t color = palette_color((palette_kind)k, i / (double)(PALETTE_STEPS - 1));
            for (int c = 0; c < 4; c++)
                bytes[k][i][c] = (uint8_t)(color >> (24 - 8 * c));
        }
    d->gl->GenTextures(1, &d->palettes);
    d->gl->BindTexture(GL_TEXTURE_2D, d->palettes);
    d->gl->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, PALETTE_STEPS, PALETTE_KINDS, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes);
    set_filter(d->gl, GL_NEAREST);
}

display *display_create(const gl_functions *gl, char *error, size_t error_size)
{
    display *d = calloc(1, sizeof *d);
    if (!d) {
        snprintf(error, error_size, "out of memory");
        return NULL;
    }
    d->gl = gl;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &d->most_side);
    gl->GenVertexArrays(1, &d->vertices);
    if (!build_program(d, error, error_size)) {
        display_destroy(d);
        return NULL;
    }
    find_uniforms(d);
    make_palettes(d);
    return d;
}

void display_destroy(display *d)
{
    if (!d)
        return;
    const gl_functions *gl = d->gl;
    for (int i = 0; i < SIDE_COUNT; i++)
        gl->DeleteTextures(1, &d->sides[i].texture);
    gl->DeleteTextures(1, &d->palettes);
    gl->DeleteVertexArrays(1, &d->vertices);
    gl->DeleteProgram(d->program);
    free(d);
}

/* ---- textures ---- */

uint32_t display_most_side(const display *d) { return (uint32_t)d->most_side; }

/* Whether a side's texture is of this layer, size and kind of storage. */
static bool fits(const side_picture *s, mgt_layer layer, uint32_t width, uint32_t height, bool immutable)
{
    return s->texture && s->layer == layer && s->width == width && s->height == height && s->immutable == immutable;
}

/* Replaces a side's texture by one without storage, and binds it. */
static void renew(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height, bool immutable)
{
    side_picture *s = &d->sides[side];
    d->gl->DeleteTextures(1, &s->texture);
    *s = (side_picture){.layer = layer, .width = width, .height = height, .immutable = immutable};
    d->gl->GenTextures(1, &s->texture);
    d->gl->BindTexture(GL_TEXTURE_2D, s->texture);
    set_filter(d->gl, layer == MGT_LAYER_COLOR ? GL_LINEAR : GL_NEAREST);
}

void display_upload(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height, const void *pixels)
{
    const gl_functions *gl = d->gl;
    const bool color = layer == MGT_LAYER_COLOR, normal = layer == MGT_LAYER_NORMAL;
    const GLenum format = color ? GL_RGBA : normal ? GL_RGB : GL_RED, type = color ? GL_UNSIGNED_BYTE : GL_FLOAT;
    side_picture *s = &d->sides[side];
    gl->ActiveTexture(GL_TEXTURE0);
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    if (!fits(s, layer, width, height, false)) {
        renew(d, side, layer, width, height, false);
        gl->TexImage2D(GL_TEXTURE_2D, 0, color ? GL_RGBA8 : normal ? GL_RGB32F : GL_R32F, (GLsizei)width, (GLsizei)height, 0, format, type, pixels);
    } else {
        gl->BindTexture(GL_TEXTURE_2D, s->texture);
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, (GLsizei)width, (GLsizei)height, format, type, pixels);
    }
    s->filled = true;
}

GLuint display_texture(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height)
{
    const gl_functions *gl = d->gl;
    side_picture *s = &d->sides[side];
    gl->ActiveTexture(GL_TEXTURE0);
    if (!fits(s, layer, width, height, true)) {
        renew(d, side, layer, width, height, true);
        gl->TexStorage2D(GL_TEXTURE_2D, 1,
                         layer == MGT_LAYER_COLOR    ? GL_RGBA8
                         : layer == MGT_LAYER_NORMAL ? GL_RGBA32F
                                                     : GL_R32F,
                         (GLsizei)width, (GLsizei)height);
    }
    s->filled = true;
    return s->texture;
}

/* ---- drawing ---- */

void display_draw(const display *d, const display_view *view)
{
    const gl_functions *gl = d->gl;
    const side_picture *a = &d->sides[SIDE_A], *b = &d->sides[SIDE_B];
    if (!a->filled || view->width <= 0 || view->height <= 0)
        return;
    const bool has_b = view->compare != COMPARE_OFF && b->filled && b->layer == a->layer;
    const float size = 1 / view->zoom;
    gl->Viewport(view->x, view->y, view->width, view->height);
    gl->Disable(GL_BLEND);
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_SCISSOR_TEST);
    gl->UseProgram(d->program);
    gl->Uniform1i(d->uniforms.has_b, has_b);
    gl->Uniform1i(d->uniforms.layer, (int)a->layer);
    gl->Uniform1i(d->uniforms.compare, (int)view->compare);
    gl->Uniform1i(d->uniforms.logarithmic, view->logarithmic);
    gl->Uniform1f(d->uniforms.wipe, view->wipe);
    gl->Uniform1f(d->uniforms.scale, view->difference_scale);
    gl->Uniform2f(d->uniforms.range, view->low, view->high);
    gl->Uniform4f(d->uniforms.window, view->center_x - 0.5f * size, view->center_y - 0.5f * size, size, size);
    gl->Uniform2f(d->uniforms.pixels, view->zoom > 1 ? (float)a->width : 0, view->zoom > 1 ? (float)a->height : 0);
    gl->ActiveTexture(GL_TEXTURE2);
    gl->BindTexture(GL_TEXTURE_2D, d->palettes);
    gl->ActiveTexture(GL_TEXTURE1);
    gl->BindTexture(GL_TEXTURE_2D, has_b ? b->texture : a->texture);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, a->texture);
    gl->BindVertexArray(d->vertices);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->BindVertexArray(0);
    gl->UseProgram(0);
}
