/* SPDX-License-Identifier: MIT
 * State of a context of the CPU backend, and functions that render by any method. */
#ifndef MANGATA_CPU_CPU_STATE_H
#define MANGATA_CPU_CPU_STATE_H

#include "base/thread_pool.h"
#include "cpu/adaptive.h"
#include "cpu/lean_map.h"
#include "cpu/tile_job.h"
#include "frame/backend.h"
#include "frame/frame.h"
#include "frame/whole_frame.h"

typedef struct cpu_state {
    thread_pool *pool;
    const lane_kernels *kernels;
    mgt_isa isa;
    sky_state *sky;       /* sky of the last frame */
    podee_tables podee;   /* empty until a frame needs them */
    lean_map *lean;       /* NULL until a frame needs it */
    refinement *adaptive; /* NULL until a frame needs it */
    refraction *objects;  /* NULL until a frame has objects */
    frame frame;          /* the frame that is rendered; it is too large for the stacks of some callers */
    frame_waves *waves;
    tile_scratch **scratch; /* one per worker */
    mgt_progress_function progress;
    void *progress_user;
} cpu_state;

/* Updates the sky's tables to this scene. */
mgt_status cpu_prepare_sky(cpu_state *s, const reporter *r, const mgt_scene *scene);

/* Renders by a method that needs no other picture: any way but METHOD_PASS. `pass` NULL: the picture is the whole frame. */
mgt_status cpu_render_picture(cpu_state *s, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count, const frame_pass *pass,
                              picture_sums sums);

/* Whether the frame needs the state of refraction. Under water it does without objects, too, because every pixel shows water from within. */
static inline bool cpu_shows_objects(const frame *f) { return f->scene->object_count > 0 || f->under; }

/* Renders by any method, with or without sums. */
mgt_status cpu_render_summed(cpu_state *s, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count, picture_sums sums);

/* backend_functions.render. */
mgt_status cpu_render(void *state, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count);

#endif
