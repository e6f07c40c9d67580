/* SPDX-License-Identifier: MIT
 * What the core asks of a backend: one table of functions beside a private state.
 *
 * The core validates every argument before it calls; a backend never checks them again.
 */
#ifndef MANGATA_FRAME_BACKEND_H
#define MANGATA_FRAME_BACKEND_H

#include "base/report.h"
#include "frame/view_rays.h"
#include "mangata/gl.h"

typedef struct backend_functions {
    /* Fills `info` with what runs. `desc` has been checked. */
    mgt_status (*create)(void **state, const mgt_context_desc *desc, const reporter *r, mgt_context_info *info);
    void (*destroy)(void *state);
    /* Scene and targets have been checked. */
    mgt_status (*render)(void *state, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count);
    /* OpenGL only, else NULL. Structs and counts have been checked. */
    mgt_status (*render_textures)(void *state, const reporter *r, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count);
    mgt_status (*render_views)(void *state, const reporter *r, const checked_view *views, size_t count);
    mgt_status (*set_sources)(void *state, const reporter *r, const mgt_gl_source *sources, size_t count);
    size_t (*get_timings)(const void *state, mgt_gl_timing *timings, size_t capacity);
} backend_functions;

extern const backend_functions cpu_backend;
extern const backend_functions gl_backend; /* src/gl/missing in builds without OpenGL */
extern const backend_functions null_backend;

/* Functions that only the CPU backend has; contexts of other backends call them, too. cpu_backend has created `state`. The arguments have been checked. */
mgt_status cpu_display(void *state, const reporter *r, const mgt_scene *scene, const float *radiance, const mgt_target *target);
mgt_status cpu_exposure(void *state, const reporter *r, const mgt_scene *scene, double *stops);
mgt_status cpu_sum(void *state, const reporter *r, const mgt_scene *scene, uint64_t *sums);
mgt_status cpu_render_sums(void *state, const reporter *r, const mgt_scene *scene, const uint64_t *sums, const mgt_target *targets, size_t count);
mgt_status cpu_inspect(void *state, const reporter *r, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info);

#endif
