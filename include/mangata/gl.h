/* SPDX-License-Identifier: MIT
 *
 * Mangata inside a program's own OpenGL context (4.5 core or later).
 *
 * Create a context with MGT_BACKEND_GL and mgt_context_desc.gl_get_proc while your OpenGL context is current; call everything, also
 * mgt_context_destroy(), with the same one current. Then, each frame, either
 *   mgt_gl_render_views()     draws the water into your framebuffer, clipped by what stands in front of it, or
 *   mgt_gl_render_textures()  writes layers into your textures.
 * mgt_render() works too and reads back into host memory.
 *
 *   State       what these calls change is put back before they return: program, buffer and texture bindings they use, vertex array,
 *               framebuffers, viewport, depth, blend, colour mask, cull, scissor and stencil tests, sRGB writes, pixel store. Objects
 *               are made with direct state access. Your debug groups are untouched; where they fill their stack, passes have none.
 *               glGetError() stays clean: an error that you left pending is logged and cleared; mgt_context_create() clears it, too.
 *   Waiting     only mgt_render() waits for the GPU. Parameters change from frame to frame without building a shader anew; a
 *               method's first frame builds its programs.
 *   Memory      buffers grow with the largest frame and the number of waves seen; a steady loop allocates nothing.
 *   Threads     as your OpenGL context: one at a time.
 */
#ifndef MANGATA_GL_H
#define MANGATA_GL_H

#include "mangata/render.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mgt_gl_color {
    MGT_GL_COLOR_RADIANCE = 0, /* kcd/m², linear sRGB: your engine exposes and tone-maps */
    MGT_GL_COLOR_EXPOSED,      /* the same times the exposure of scene.post */
    MGT_GL_COLOR_DISPLAY       /* exposed and tone-mapped by scene.post and encoded for sRGB displays, unless the attachment encodes itself
                                  (an sRGB format with GL_FRAMEBUFFER_SRGB enabled); without glare */
} mgt_gl_color;

MGT_API const char *mgt_gl_color_name(mgt_gl_color color);
MGT_API bool mgt_gl_color_from_name(const char *name, mgt_gl_color *color);

/* A view of a frame: a camera by its matrices, and where it is drawn. scene.camera and scene.image are not read. */
typedef struct mgt_gl_view {
    size_t struct_size;
    double view[16];       /* world to eye, column-major as in OpenGL: a rotation and a translation, in metres, y of the world up */
    double projection[16]; /* eye to clip, column-major: any perspective one (off-centre, jittered, infinite, reversed) */
    double view_open[16];  /* where the shutter opens; used when scene.camera_moves */
    int32_t x, y;          /* viewport in the framebuffer, pixels from its lower left corner */
    uint32_t width, height;
    uint32_t framebuffer; /* name of yours with a depth attachment and a colour one as its first draw buffer, multisampled or not; 0: the default one */
    mgt_gl_color color;
    bool reversed_depth; /* nearer is greater: tested with GL_GEQUAL instead of GL_LEQUAL. Clip depth mode and depth range are yours. What projection and
                            depth range contradict is an MGT_ERROR_ARGUMENT */
    bool draw_sky;       /* fills what lies behind the far plane with the scene's sky and light; else only water is drawn */
    uint8_t reserved[6]; /* 0 */
} mgt_gl_view;

/* Identity matrices, the default framebuffer, radiance; viewport empty. */
MGT_API void mgt_gl_view_init(mgt_gl_view *view, size_t size);

/* Draws the water of `scene` into `count` views (1 … 16). Water is tested against your depth buffer and writes its own depth, that of the waves
 * which a pixel resolves; the pixels of the horizon blend into what your framebuffer holds. A scene that OpenGL does not render itself,
 * see mgt_supports(), is MGT_ERROR_UNSUPPORTED. fxaa looks for edges in the water of the view alone; taa renders the seven
 * frames before it anew, its camera on the line from view_open to view. */
MGT_API mgt_status mgt_gl_render_views(mgt_context *context, const mgt_scene *scene, const mgt_gl_view *views, size_t count);

/* A texture of yours that receives a layer of scene.image's size (the crop's), top row first: texel (0, 0) is the top left pixel. GL_TEXTURE_2D with immutable
 * storage, in the format GL_R32F or GL_R16F (coverage, mask, depth, samples, importance, detail, foam), GL_RGBA32F or GL_RGBA16F (color, normal; alpha 1),
 * or GL_RGBA8 (displayed color, encoded for sRGB, with glare). */
typedef struct mgt_gl_texture {
    size_t struct_size;
    mgt_layer layer;
    uint32_t texture;
    int32_t level;     /* of mipmaps */
    uint32_t reserved; /* 0 */
} mgt_gl_texture;

/* The layer color, level 0; no texture yet. */
MGT_API void mgt_gl_texture_init(mgt_gl_texture *texture, size_t size);

/* Renders one frame into `count` textures (1 … 16) without waiting for it. Refuses the same scenes as mgt_gl_render_views(). */
MGT_API mgt_status mgt_gl_render_textures(mgt_context *context, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count);

/* GPU time of a pass, of the latest frame whose timer has been read; a few frames late, since nothing waits. */
typedef struct mgt_gl_timing {
    const char *name; /* of the pass, as in its debug group; static */
    double seconds;
} mgt_gl_timing;

/* Fills up to `capacity` timings and returns how many there are. 0 on contexts without OpenGL. */
MGT_API size_t mgt_gl_get_timings(const mgt_context *context, mgt_gl_timing *timings, size_t capacity);

/* Texts that replace kernel files of the same name ("glitter.k"), to try changes live; they are copied. All programs are built anew at once: on an error
 * the ones in use stay, and mgt_last_error() says "glitter.k:12: …". count 0 goes back to the built-in files. */
typedef struct mgt_gl_source {
    const char *name;
    const char *text; /* NUL-terminated */
} mgt_gl_source;

MGT_API mgt_status mgt_gl_set_sources(mgt_context *context, const mgt_gl_source *sources, size_t count);

/* The names of all texts that mgt_gl_set_sources() can replace, by number from 0; NULL behind the last. */
MGT_API const char *mgt_gl_source_name(size_t index);

#ifdef __cplusplus
}
#endif
#endif
