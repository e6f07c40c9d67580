/* SPDX-License-Identifier: MIT
 * The renderer of the OpenGL backend: its state between frames, and the passes of a frame. */
#ifndef MANGATA_GL_GL_RENDERER_H
#define MANGATA_GL_GL_RENDERER_H

#include "frame/frame.h"
#include "frame/sines.h"
#include "gl/gl_cells.h"
#include "gl/gl_gbuffer.h"
#include "gl/gl_host_state.h"
#include "gl/gl_memory.h"
#include "gl/gl_objects.h"
#include "gl/gl_pass_data.h"
#include "gl/gl_programs.h"
#include "gl/gl_refraction.h"
#include "gl/gl_timers.h"
#include "frame/targets.h"

/* The layers of the picture on the GPU. Texel (0, 0) is the top left pixel of the rendered part. */
typedef struct gl_layers {
    gl_image color;                  /* RGBA32F, alpha 1 */
    gl_image coverage, water, depth; /* R32F */
    gl_image normal;                 /* RGBA32F, alpha 1 */
    gl_image foam;                   /* R32F */
    gl_image display;                /* RGBA8 */
    gl_image samples;                /* R32F: samples per pixel; methods other than adaptive have the same number everywhere */
    gl_image importance, detail;     /* R32F: the layers MGT_LAYER_IMPORTANCE and MGT_LAYER_DETAIL */
} gl_layers;

enum { GLARE_LEVELS = 16 };

/* The blur pyramid of glare for pictures of one size. */
typedef struct gl_glare {
    uint32_t width, height;
    size_t count;
    gl_image levels[GLARE_LEVELS];
    GlareData sizes[GLARE_LEVELS]; /* without keep and gain */
    gl_buffer weights;
} gl_glare;

/* Tables of podee-* with kernels: see gl_podee.c. */
typedef struct gl_podee {
    gl_image sweep, share; /* R32F */
    bool filled;
} gl_podee;

/* Buffers of scheme podee of method adaptive, for a picture and for a band: see slots_data.glsl. */
typedef struct gl_slots {
    gl_buffer plan, tasks, values, commands;
} gl_slots;

/* The map of methods lean and leadr: see gl_lean.c. */
typedef struct gl_lean {
    LeanData data;
    GLuint mean, square; /* RG32F; RGBA32F, from level 1 on */
    lean_waves waves;    /* the waves that fill the map */
    bool filled;
} gl_lean;

typedef struct gl_limits {
    uint32_t texture_side;
    bool software;        /* the driver renders on the CPU, as llvmpipe does */
    size_t storage_bytes; /* largest size of a buffer that shaders write */
    size_t table_texels;  /* largest number of elements of a buffer that shaders fetch */
} gl_limits;

/* A frame that another method draws as a part of the whole frame, and its scene. */
typedef struct gl_plain_frame {
    mgt_scene scene;
    frame frame;
} gl_plain_frame;

typedef struct gl_renderer {
    gl_api gl;
    gl_limits limits;
    gl_programs programs;
    gl_ring ring;
    gl_timers timers;
    gl_buffer tiles, tile_waves, search_waves, nodes; /* lists of a band of tiles */
    gl_layers layers;
    gl_layers history[2]; /* for fxaa and taa; these have color, coverage and mask alone */
    gl_image luma;        /* R32F, for fxaa */
    gl_glare glare;
    gl_podee podee;
    gl_lean lean;
    gl_slots slots;
    gl_cells cells;
    gl_objects objects;
    gl_gbuffers gbuffers;
    gl_refraction refraction;
    const gl_host_state *host; /* the saved state of the host's context during a call in it, else NULL */
    uint32_t threads;          /* threads for tables that the CPU makes; 0: as many as this process may use */
    GLuint sky_texture;
    GLuint skyline_texture; /* two rows: the skylines when the shutter closes and when it opens */
    GLuint sampler;         /* the sampler of all textures, which takes the nearest texel */
    bool samplers_set;      /* see gl_frame_begin() */
    GLuint vertex_array;    /* a vertex array without attributes */
    sky_state *sky;         /* the sky of the last frame */
    wave_set *waves;        /* the waves of the pass that is being prepared */
    bool waves_in_block;    /* true: the frame's waves stand in a uniform block; false: in a storage buffer */
    const char *pass;       /* name of the current pass */
    /* Frames that are being drawn; here, as callers may have little stack. */
    frame frame;
    frame opened;         /* the same where the shutter opens, for objects */
    frame colored;        /* the same with colour, for cells */
    gl_plain_frame plain; /* the same by another method */
} gl_renderer;

/* Creates a renderer in the current OpenGL context, which `get_proc` belongs to. The same context must be current during every other call below. */
mgt_status gl_renderer_create(gl_renderer **out, mgt_gl_get_proc get_proc, const reporter *r);
void gl_renderer_destroy(gl_renderer *g);

/* Begin and end a pass with its debug group and its timer. gl_pass_end() reports errors of OpenGL. */
void gl_pass_begin(gl_renderer *g, const char *name);
mgt_status gl_pass_end(gl_renderer *g, const reporter *r);

/* Makes program `which` current. Builds it first if it has not been built. */
mgt_status gl_use(gl_renderer *g, gl_program which, const reporter *r);

/* Number of waves that a block for `count` waves has room for. In a uniform block that is the number that shaders declare; elsewhere it is at least one. */
size_t gl_wave_room(const gl_renderer *g, size_t count);

/* Binds a texture to a unit. 0 stands for any texture, for a unit that is not read. */
void gl_bind_texture(const gl_renderer *g, GLuint unit, GLuint texture);

/* Binds an image to a unit. An image that was never reserved unbinds the unit. */
void gl_bind_image(const gl_renderer *g, GLuint unit, const gl_image *image, GLenum access);

/* Copies `data` into the ring and binds the copy as a uniform block. */
void gl_uniform(gl_renderer *g, GLuint binding, const void *data, size_t size);

/* The camera's rays at the fraction `share` of the shutter, from its opening (0) to its closing (1). A negative `share` is a time before the shutter opens. */
typedef camera_rays (*gl_camera_at)(const void *user, double share);

/* A frame to draw. */
typedef struct gl_job {
    const frame *frame;
    gl_camera_at camera_at;  /* cameras of samples, of parts of the shutter and of earlier frames */
    const void *camera_user; /* first argument of camera_at */
    region area;             /* part of the image that the layers hold; the whole image for methods that work on whole pictures */
    bool wants_pixels;       /* color, coverage or mask is asked for */
    bool wants_depth, wants_normal;
    bool wants_foam;                /* true: pixels are shaded even if wants_pixels is false */
    bool shaded_depth;              /* true: the depth of the method's own hit will do, so filtered methods need no search for point samples */
    bool background;                /* false: the sky behind the water is left out */
    bool behind;                    /* true: objects in front of the water are left out */
    mgt_progress_function progress; /* NULL: progress is not reported, and the CPU does not wait for the GPU */
    void *progress_user;
} gl_job;

/* Draws the layers of a frame. */
mgt_status gl_frame_render(gl_renderer *g, const gl_job *job, const reporter *r);

/* The same for methods that work on whole pictures. */
mgt_status gl_whole_frame_render(gl_renderer *g, const gl_job *job, const reporter *r);

/* The layers samples, importance and detail, which only method adaptive computes. gl_spent_reserve() reserves their memory. gl_spent_fill() fills them with the
 * constants of another method. */
mgt_status gl_spent_reserve(gl_renderer *g, const region *area, const reporter *r);
mgt_status gl_spent_fill(gl_renderer *g, const region *area, const mgt_quality *quality, const reporter *r);

/* Method adaptive: draw color, coverage, mask, samples, importance and detail. gl_adaptive_podee_render() is scheme podee. */
mgt_status gl_adaptive_render(gl_renderer *g, const gl_job *job, const reporter *r);
mgt_status gl_adaptive_podee_render(gl_renderer *g, const gl_job *job, const reporter *r);
void gl_adaptive_podee_free(gl_renderer *g);

/* The same by refinement cells; see gl_cells.c. */
mgt_status gl_cells_render(gl_renderer *g, const gl_job *job, const reporter *r);

/* Tables of podee-* and the map of lean and leadr. The functions …_prepare fill them if they are not up to date, …_bind bind them for the next dispatch. */
mgt_status gl_podee_prepare(gl_renderer *g, const mgt_scene *scene, const reporter *r);
void gl_podee_bind(const gl_renderer *g);
void gl_podee_free(gl_renderer *g);
mgt_status gl_lean_prepare(gl_renderer *g, const frame *f, const reporter *r);
void gl_lean_bind(gl_renderer *g);
void gl_lean_free(gl_renderer *g);

/* Makes layers.display from layers.color. */
mgt_status gl_display_render(gl_renderer *g, const frame *f, const region *area, const reporter *r);

/* Frees the pyramid. */
void gl_glare_free(gl_renderer *g);

/* Prepares a frame: chooses the programs for its kind of water, binds something to every unit that they may read, and updates the sky's texture. */
mgt_status gl_frame_begin(gl_renderer *g, const mgt_scene *scene, const reporter *r);

#endif
