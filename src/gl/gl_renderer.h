/* SPDX-License-Identifier: MIT
 * What the OpenGL backend keeps between frames, and the passes that make a frame of it. */
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

/* The layers of the picture on the GPU. Texel (0, 0) is the top left pixel of what is rendered. */
typedef struct gl_layers {
    gl_image color;                  /* RGBA32F, alpha 1 */
    gl_image coverage, water, depth; /* R32F */
    gl_image normal;                 /* RGBA32F, alpha 1 */
    gl_image display;                /* RGBA8 */
    gl_image samples;                /* R32F: what method adaptive has spent; of other methods one number everywhere */
    gl_image importance, detail;     /* R32F: what samples were spent for, and what came of them; likewise */
} gl_layers;

enum { GLARE_LEVELS = 16 };

/* The pyramid for pictures of one size. */
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

/* What scheme podee of method adaptive keeps of a picture and of a band: see slots_data.glsl. */
typedef struct gl_slots {
    gl_buffer plan, tasks, values, commands;
} gl_slots;

/* The map of methods lean and leadr: see gl_lean.c. */
typedef struct gl_lean {
    LeanData data;
    GLuint mean, square; /* RG32F; RGBA32F, from level 1 on */
    lean_waves waves;    /* that fill it */
    bool filled;
} gl_lean;

typedef struct gl_limits {
    uint32_t texture_side;
    bool software;        /* llvmpipe and its like */
    size_t storage_bytes; /* of a buffer that shaders write */
    size_t table_texels;  /* elements of a buffer that shaders fetch */
} gl_limits;

typedef struct gl_renderer {
    gl_api gl;
    gl_limits limits;
    gl_programs programs;
    gl_ring ring;
    gl_timers timers;
    gl_buffer tiles, tile_waves, search_waves, nodes; /* of a band */
    gl_layers layers;
    gl_layers history[2]; /* color, coverage and mask alone: for fxaa and taa */
    gl_image luma;        /* R32F, for fxaa */
    gl_glare glare;
    gl_podee podee;
    gl_lean lean;
    gl_slots slots;
    gl_cells cells;
    gl_objects objects;
    gl_gbuffers gbuffers;
    gl_refraction refraction;
    const gl_host_state *host; /* during a call in a host's context, else NULL */
    uint32_t threads;          /* for tables that the CPU makes; 0: as many as this process may use */
    GLuint sky_texture;
    GLuint skyline_texture; /* a row when the shutter closes, a row when it opens */
    GLuint sampler;         /* of all textures: the nearest texel */
    bool samplers_set;      /* see gl_frame_begin() */
    GLuint vertex_array;    /* empty */
    sky_state *sky;         /* of the last frame */
    wave_set *waves;        /* of the pass being prepared */
    bool waves_in_block;    /* the frame's stand in a uniform block, else in a storage buffer */
    const char *pass;       /* the current one's name */
} gl_renderer;

/* The current context must be the one that the functions of r->gl belong to, here and below. */
mgt_status gl_renderer_create(gl_renderer **out, mgt_gl_get_proc get_proc, const reporter *r);
void gl_renderer_destroy(gl_renderer *g);

/* A pass: its debug group and its timer. The end looks for errors. */
void gl_pass_begin(gl_renderer *g, const char *name);
mgt_status gl_pass_end(gl_renderer *g, const reporter *r);

/* Program `which` in use, built if need be. */
mgt_status gl_use(gl_renderer *g, gl_program which, const reporter *r);

/* Waves that a block of `count` has room for: as many as shaders declare, or at least one. */
size_t gl_wave_room(const gl_renderer *g, size_t count);

/* A texture for the next dispatch. */
void gl_bind_texture(const gl_renderer *g, GLuint unit, GLuint texture);

/* An image for the next dispatch; nothing where it was never reserved. */
void gl_bind_image(const gl_renderer *g, GLuint unit, const gl_image *image, GLenum access);

/* A uniform block for the next dispatch, copied into the ring. */
void gl_uniform(gl_renderer *g, GLuint binding, const void *data, size_t size);

/* Where a camera is from the shutter's opening (0) to its closing (1); below 0, where it was before. */
typedef camera_rays (*gl_camera_at)(const void *user, double share);

/* What to draw. */
typedef struct gl_job {
    const frame *frame;
    gl_camera_at camera_at; /* for samples and parts of the shutter, and frames before */
    const void *camera_user;
    region area;       /* of the image: what the layers get; all of it for methods that work on whole pictures */
    bool wants_pixels; /* color, coverage or mask */
    bool wants_depth, wants_normal;
    bool shaded_depth;              /* the depth that the method itself finds will do: filtered ones are spared another look for point samples */
    bool background;                /* sky behind the water */
    bool behind;                    /* objects in front of the water are left out */
    mgt_progress_function progress; /* NULL: none, and nothing waits */
    void *progress_user;
} gl_job;

/* Draws the layers of a frame. */
mgt_status gl_frame_render(gl_renderer *g, const gl_job *job, const reporter *r);

/* The same for methods that work on whole pictures. */
mgt_status gl_whole_frame_render(gl_renderer *g, const gl_job *job, const reporter *r);

/* The layers that only method adaptive makes a picture of: memory for them, and what they hold for other methods. */
mgt_status gl_spent_reserve(gl_renderer *g, const region *area, const reporter *r);
mgt_status gl_spent_fill(gl_renderer *g, const region *area, const mgt_quality *quality, const reporter *r);

/* Method adaptive: colour, coverage, mask and those layers. */
mgt_status gl_adaptive_render(gl_renderer *g, const gl_job *job, const reporter *r);
mgt_status gl_adaptive_podee_render(gl_renderer *g, const gl_job *job, const reporter *r);
void gl_adaptive_podee_free(gl_renderer *g);

/* The same for the cells of method adaptive; gl_cells.c. */
mgt_status gl_cells_render(gl_renderer *g, const gl_job *job, const reporter *r);

/* What single methods read beside: filled where they are not yet, bound for the next dispatch, freed. */
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

/* Before a frame: programs for its kind of water, something in every place that they may read, and the sky's texture up to date. */
mgt_status gl_frame_begin(gl_renderer *g, const mgt_scene *scene, const reporter *r);

#endif
