/* SPDX-License-Identifier: MIT
 * Rendering into textures and framebuffers of the host. */
#include <math.h>

#include "gl/gl_backend.h"
#include "frame/targets.h"

/* ---- textures ---- */

/* Whether a texture of that format can hold the layer. */
static bool takes_layer(GLenum format, mgt_layer layer)
{
    switch (layer) {
    case MGT_LAYER_COVERAGE:
    case MGT_LAYER_MASK:
    case MGT_LAYER_DEPTH:
    case MGT_LAYER_SAMPLES:
    case MGT_LAYER_IMPORTANCE:
    case MGT_LAYER_DETAIL:
    case MGT_LAYER_FOAM:
        return format == GL_R32F || format == GL_R16F;
    case MGT_LAYER_NORMAL:
        return format == GL_RGBA32F || format == GL_RGBA16F;
    case MGT_LAYER_COLOR:
    default:
        break;
    }
    return format == GL_RGBA32F || format == GL_RGBA16F || format == GL_RGBA8;
}

/* Checks a texture of the host. `index` is its number in messages. `format` gets its internal format. */
static mgt_status check_texture(const gl_backend_state *s, const mgt_gl_texture *t, size_t index, const region *crop, GLenum *format, const reporter *r)
{
    const gl_api *gl = &s->renderer->gl;
    static const char *const layers[] = {
        [MGT_LAYER_COLOR] = "color (GL_RGBA32F, GL_RGBA16F or GL_RGBA8)",
        [MGT_LAYER_COVERAGE] = "coverage (GL_R32F or GL_R16F)",
        [MGT_LAYER_MASK] = "mask (GL_R32F or GL_R16F)",
        [MGT_LAYER_DEPTH] = "depth (GL_R32F or GL_R16F)",
        [MGT_LAYER_NORMAL] = "normal (GL_RGBA32F or GL_RGBA16F)",
        [MGT_LAYER_SAMPLES] = "samples (GL_R32F or GL_R16F)",
        [MGT_LAYER_IMPORTANCE] = "importance (GL_R32F or GL_R16F)",
        [MGT_LAYER_DETAIL] = "detail (GL_R32F or GL_R16F)",
        [MGT_LAYER_FOAM] = "foam (GL_R32F or GL_R16F)",
    };
    if (!gl->IsTexture(t->texture))
        return report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: %u is no texture of this context", index, t->texture);
    GLint target = 0, immutable = 0, levels = 0, width = 0, height = 0, internal = 0;
    gl->GetTextureParameteriv(t->texture, GL_TEXTURE_TARGET, &target);
    gl->GetTextureParameteriv(t->texture, GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    if (target != GL_TEXTURE_2D || !immutable)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: %u is not a GL_TEXTURE_2D with immutable storage (glTextureStorage2D)",
                            index, t->texture);
    gl->GetTextureParameteriv(t->texture, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    if (t->level < 0 || t->level >= levels)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: level %d does not exist; %u has %d", index, (int)t->level, t->texture,
                            levels);
    gl->GetTextureLevelParameteriv(t->texture, t->level, GL_TEXTURE_WIDTH, &width);
    gl->GetTextureLevelParameteriv(t->texture, t->level, GL_TEXTURE_HEIGHT, &height);
    gl->GetTextureLevelParameteriv(t->texture, t->level, GL_TEXTURE_INTERNAL_FORMAT, &internal);
    if ((uint32_t)width != crop->width || (uint32_t)height != crop->height)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: it has %d x %d texels, the scene's picture %u x %u", index, width, height,
                            crop->width, crop->height);
    *format = (GLenum)internal;
    if (takes_layer(*format, t->layer))
        return MGT_OK;
    return report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "texture %zu: its format 0x%04x cannot hold layer %s", index, *format, layers[t->layer]);
}

/* The image that is copied to a texture of that format: the displayed colour for GL_RGBA8. */
static const gl_image *image_of(const gl_layers *l, mgt_layer layer, GLenum format)
{
    switch (layer) {
    case MGT_LAYER_COVERAGE:
        return &l->coverage;
    case MGT_LAYER_MASK:
        return &l->water;
    case MGT_LAYER_DEPTH:
        return &l->depth;
    case MGT_LAYER_NORMAL:
        return &l->normal;
    case MGT_LAYER_SAMPLES:
        return &l->samples;
    case MGT_LAYER_IMPORTANCE:
        return &l->importance;
    case MGT_LAYER_DETAIL:
        return &l->detail;
    case MGT_LAYER_FOAM:
        return &l->foam;
    case MGT_LAYER_COLOR:
    default:
        break;
    }
    return format == GL_RGBA8 ? &l->display : &l->color;
}

/* Copies the part `crop` of a layer, which holds the part `area` of the image, to a texture of the host. */
static mgt_status copy_layer(gl_backend_state *s, const mgt_gl_texture *t, GLenum format, const region *area, const region *crop, const reporter *r)
{
    gl_renderer *g = s->renderer;
    const GlareData data = {.fine_width = (int)crop->width,
                            .fine_height = (int)crop->height,
                            .across = (int)(crop->x - area->x),
                            .down = (int)(crop->y - area->y)};
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, sizeof data, 1, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "copy");
    status = gl_use(g, PROGRAM_COPY, r);
    if (status == MGT_OK) {
        gl_uniform(g, BIND_EXTRA, &data, sizeof data);
        gl_bind_texture(g, UNIT_FINE, image_of(&g->layers, t->layer, format)->name);
        g->gl.BindImageTexture(0, t->texture, t->level, GL_FALSE, 0, GL_WRITE_ONLY, format);
        g->gl.DispatchCompute((crop->width + GROUP_SIDE - 1) / GROUP_SIDE, (crop->height + GROUP_SIDE - 1) / GROUP_SIDE, 1);
    }
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

static mgt_status render_textures(gl_backend_state *s, const reporter *r, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count)
{
    const region crop = image_region(&scene->image);
    GLenum formats[16];
    layer_wants wants = {0};
    mgt_status status = MGT_OK;
    for (size_t i = 0; i < count && status == MGT_OK; i++) {
        status = check_texture(s, &textures[i], i, &crop, &formats[i], r);
        layer_wants_add(&wants, textures[i].layer, status == MGT_OK && formats[i] == GL_RGBA8);
    }
    region area;
    if (status == MGT_OK)
        status = gl_layers_render(s, r, scene, &wants, false, &area);
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        status = copy_layer(s, &textures[i], formats[i], &area, &crop, r);
    if (status == MGT_OK)
        s->renderer->gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                                      GL_FRAMEBUFFER_BARRIER_BIT);
    return status;
}

mgt_status gl_render_textures(void *state, const reporter *r, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count)
{
    gl_backend_state *s = state;
    if (s->egl)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.texture", "this context has no host: create it with mgt_context_desc.gl_get_proc");
    gl_scope scope;
    mgt_status status = gl_enter(s, &scope, r);
    if (status != MGT_OK)
        return status;
    status = render_textures(s, r, scene, textures, count);
    return gl_leave(s, &scope, status, r);
}

/* ---- framebuffers ---- */

/* What the draw buffer `buffer` of a framebuffer is called where attachments are asked for: those of the default one have sides. */
static GLenum attachment_of(GLenum buffer)
{
    switch (buffer) {
    case GL_BACK:
        return GL_BACK_LEFT;
    case GL_FRONT:
    case GL_LEFT:
    case GL_FRONT_AND_BACK:
        return GL_FRONT_LEFT;
    case GL_RIGHT:
        return GL_FRONT_RIGHT;
    default:
        return buffer;
    }
}

/* Checks a framebuffer of the host; 0 is the default one. `index` is the number of its view in messages. `encodes` gets whether the framebuffer encodes linear
 * colours as sRGB. Binds it, since its draw buffers can be asked for in no other way. */
static mgt_status check_framebuffer(const gl_api *gl, GLuint name, size_t index, bool *encodes, const reporter *r)
{
    if (name != 0 && !gl->IsFramebuffer(name))
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: %u is no framebuffer of this context", index, name);
    const GLenum state = gl->CheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
    if (state != GL_FRAMEBUFFER_COMPLETE)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: framebuffer %u is not complete (status 0x%04x)", index, name, state);
    GLint buffer = GL_NONE, depth = GL_NONE, color = GL_NONE, type = GL_NONE, encoding = GL_LINEAR;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, name);
    gl->GetIntegerv(GL_DRAW_BUFFER0, &buffer);
    if (buffer == GL_NONE)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: the first draw buffer of framebuffer %u is GL_NONE; a colour attachment is needed",
                            index, name);
    const GLenum depth_name = name ? GL_DEPTH_ATTACHMENT : GL_DEPTH, color_name = attachment_of((GLenum)buffer);
    gl->GetNamedFramebufferAttachmentParameteriv(name, depth_name, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &depth);
    gl->GetNamedFramebufferAttachmentParameteriv(name, color_name, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &color);
    if (depth == GL_NONE)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "view %zu: framebuffer %u has no depth attachment", index, name);
    if (color == GL_NONE)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view",
                            "view %zu: nothing is attached to framebuffer %u where its first draw buffer is, 0x%04x; a colour attachment is needed", index,
                            name, (unsigned)buffer);
    gl->GetNamedFramebufferAttachmentParameteriv(name, color_name, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, &type);
    if (type == GL_INT || type == GL_UNSIGNED_INT)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view",
                            "view %zu: framebuffer %u has an integer colour attachment; a float or normalised one is needed", index, name);
    gl->GetNamedFramebufferAttachmentParameteriv(name, color_name, GL_FRAMEBUFFER_ATTACHMENT_COLOR_ENCODING, &encoding);
    *encodes = encoding == GL_SRGB && gl->IsEnabled(GL_FRAMEBUFFER_SRGB);
    return MGT_OK;
}

/* Checks that reversed_depth agrees with the view's projection and the host's depth range. Otherwise the water would fail the depth test nearly everywhere. */
static mgt_status check_depth_order(const gl_api *gl, const checked_view *v, size_t index, const reporter *r)
{
    GLfloat range[2] = {0, 1};
    gl->GetFloati_v(GL_DEPTH_RANGE, 0, range);
    const double nearer = v->close.clip_offset * (double)(range[1] - range[0]); /* above 0: nearer points have greater depths */
    if (!(v->view->reversed_depth ? nearer < 0 : nearer > 0))
        return MGT_OK;
    return report_error(r, MGT_ERROR_ARGUMENT, "render.view",
                        "view %zu: reversed_depth is %s, but its projection and glDepthRange give nearer things a %s depth", index,
                        v->view->reversed_depth ? "true" : "false", nearer > 0 ? "greater" : "smaller");
}

/* The camera of a view's job: see gl_camera_at. `user` is its frame. Position and rays are linear in time, also before the shutter opens. The camera stays
 * above a tenth of its last height, so it never crosses the surface. */
static camera_rays view_camera_at(const void *user, double share)
{
    const frame *f = user;
    camera_rays c = f->close;
    if (!f->scene->camera_moves)
        return c;
    const camera_rays *open = &f->open;
    for (int i = 0; i < 3; i++) {
        c.position[i] = open->position[i] + share * (c.position[i] - open->position[i]);
        c.corner[i] = open->corner[i] + share * (c.corner[i] - open->corner[i]);
        c.right[i] = open->right[i] + share * (c.right[i] - open->right[i]);
        c.down[i] = open->down[i] + share * (c.down[i] - open->down[i]);
    }
    c.position[1] = fmax(c.position[1], 0.1 * f->close.position[1]);
    return c;
}

/* Uniform data of the pass that draws a view, with the depth range and the clip mode of the host. */
static WindowData window_data(const gl_api *gl, const checked_view *v, bool encodes)
{
    const mgt_gl_view *view = v->view;
    const camera_rays *c = &v->close.rays;
    GLint mode = GL_NEGATIVE_ONE_TO_ONE;
    GLfloat range[2] = {0, 1};
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &mode);
    gl->GetFloati_v(GL_DEPTH_RANGE, 0, range);
    const bool whole = mode == GL_ZERO_TO_ONE;
    return (WindowData){
        .ray_x = (float)c->corner[0],
        .ray_y = (float)c->corner[1],
        .ray_z = (float)c->corner[2],
        .width = (int)view->width,
        .right_x = (float)c->right[0],
        .right_y = (float)c->right[1],
        .right_z = (float)c->right[2],
        .height = (int)view->height,
        .down_x = (float)c->down[0],
        .down_y = (float)c->down[1],
        .down_z = (float)c->down[2],
        .clip_depth = (float)v->close.clip_depth[0],
        .clip_depth_x = (float)v->close.clip_depth[1],
        .clip_depth_y = (float)v->close.clip_depth[2],
        .clip_offset = (float)v->close.clip_offset,
        .depth_scale = whole ? range[1] - range[0] : 0.5f * (range[1] - range[0]),
        .depth_offset = whole ? range[0] : 0.5f * (range[0] + range[1]),
        .depth_low = range[0] < range[1] ? range[0] : range[1],
        .depth_high = range[0] < range[1] ? range[1] : range[0],
        .draw_sky = view->draw_sky,
        .color = (int)view->color,
        .encodes = encodes,
    };
}

/* Sets the state for drawing a view: premultiplied blending, and a depth test in the view's order. */
static void set_drawing(const gl_backend_state *s, const mgt_gl_view *view, const gl_host_state *host)
{
    const gl_api *gl = &s->renderer->gl;
    gl_host_state_neutral(gl, host);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, view->framebuffer);
    gl->BindVertexArray(s->renderer->vertex_array);
    gl->ViewportIndexedf(0, (float)view->x, (float)view->y, (float)view->width, (float)view->height);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(view->reversed_depth ? GL_GEQUAL : GL_LEQUAL);
    gl->DepthMask(GL_TRUE);
    gl->Enablei(GL_BLEND, 0);
    gl->BlendFuncSeparatei(0, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->BlendEquationSeparatei(0, GL_FUNC_ADD, GL_FUNC_ADD);
}

/* Draws the layers of a view into the host's framebuffer. */
static mgt_status draw_layers(gl_backend_state *s, const checked_view *v, bool encodes, const frame *f, const gl_host_state *host, const reporter *r)
{
    gl_renderer *g = s->renderer;
    const gl_api *gl = &g->gl;
    const WindowData window = window_data(gl, v, encodes);
    mgt_status status = gl_ring_begin(gl, &g->ring, sizeof window + sizeof f->data, 2, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "draw");
    status = gl_use(g, PROGRAM_VIEW, r);
    if (status == MGT_OK) {
        const GLuint textures[] = {g->layers.color.name, g->layers.water.name, g->layers.depth.name};
        for (GLuint i = 0; i < sizeof textures / sizeof *textures; i++)
            gl_bind_texture(g, UNIT_FINE + i, textures[i]);
        gl_uniform(g, BIND_FRAME, &f->data, sizeof f->data);
        gl_uniform(g, BIND_EXTRA, &window, sizeof window);
        set_drawing(s, v->view, host);
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
    }
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

static mgt_status render_view(gl_backend_state *s, const checked_view *v, size_t index, const gl_host_state *host, const reporter *r)
{
    const mgt_gl_view *view = v->view;
    bool encodes = false;
    mgt_status status = check_framebuffer(&s->renderer->gl, view->framebuffer, index, &encodes, r);
    if (status == MGT_OK)
        status = check_depth_order(&s->renderer->gl, v, index, r);
    if (status == MGT_OK)
        status = gl_frame_begin(s->renderer, &v->scene, r);
    if (status != MGT_OK)
        return status;
    frame *const f = &s->renderer->frame;
    frame_make(&v->scene, s->renderer->sky, true, f);
    frame_look(f, v->scene.camera_moves ? &v->open.rays : &v->close.rays, &v->close.rays);
    f->data.pixel_angle = f->through.pixel_angle = (float)view_pixel_angle(&f->close);
    const gl_job job = {
        .frame = f,
        .camera_at = view_camera_at,
        .camera_user = f,
        .area = {0, 0, view->width, view->height},
        .wants_pixels = true,
        .wants_depth = true,
        .shaded_depth = true,
        .background = view->draw_sky,
    };
    status = gl_frame_render(s->renderer, &job, r);
    return status == MGT_OK ? draw_layers(s, v, encodes, f, host, r) : status;
}

mgt_status gl_render_views(void *state, const reporter *r, const checked_view *views, size_t count)
{
    gl_backend_state *s = state;
    if (s->egl)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.view", "this context has no host: create it with mgt_context_desc.gl_get_proc");
    gl_scope scope;
    mgt_status status = gl_enter(s, &scope, r);
    if (status != MGT_OK)
        return status;
    for (size_t i = 0; i < count && status == MGT_OK; i++)
        status = render_view(s, &views[i], i, &scope.host, r);
    return gl_leave(s, &scope, status, r);
}
