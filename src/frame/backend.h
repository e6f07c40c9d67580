/* SPDX-License-Identifier: MIT
 * What the core asks of a backend: one table of functions beside a private state.
 *
 * The core validates every argument before it calls; a backend never checks them again.
 */
#ifndef MANGATA_FRAME_BACKEND_H
#define MANGATA_FRAME_BACKEND_H

#include "mangata/gl.h"

/* Where a backend reports: the log of the context and the text of mgt_last_error(). */
typedef struct reporter {
    mgt_log_function log;
    void *log_user;
    char *error; /* REPORTER_TEXT bytes */
} reporter;

#define REPORTER_TEXT 512

/* Writes the detail of a failure, logs it and returns `status`, so that callers can `return report_error(…)`. */
mgt_status report_error(const reporter *r, mgt_status status, const char *id, const char *format, ...) __attribute__((format(printf, 4, 5)));
void report(const reporter *r, mgt_log_level level, const char *id, const char *format, ...) __attribute__((format(printf, 4, 5)));

typedef struct backend_functions {
    /* Fills `info` with what runs. `desc` has been checked. */
    mgt_status (*create)(void **state, const mgt_context_desc *desc, const reporter *r, mgt_context_info *info);
    void (*destroy)(void *state);
    /* Scene and targets have been checked. */
    mgt_status (*render)(void *state, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count);
    /* OpenGL only, else NULL. Structs and counts have been checked; the scene of render_views has neither been checked nor put at sea level. */
    mgt_status (*render_textures)(void *state, const reporter *r, const mgt_scene *scene, const mgt_gl_texture *textures, size_t count);
    mgt_status (*render_views)(void *state, const reporter *r, const mgt_scene *scene, const mgt_gl_view *views, size_t count);
    mgt_status (*set_sources)(void *state, const reporter *r, const mgt_gl_source *sources, size_t count);
    size_t (*get_timings)(const void *state, mgt_gl_timing *timings, size_t capacity);
} backend_functions;

extern const backend_functions cpu_backend;
extern const backend_functions gl_backend; /* src/gl/missing in builds without OpenGL */
extern const backend_functions null_backend;

/* What only the CPU does, whatever a context renders with. `state` is one that cpu_backend has created; arguments have been checked. */
mgt_status cpu_display(void *state, const reporter *r, const mgt_scene *scene, const float *radiance, const mgt_target *target);
mgt_status cpu_inspect(void *state, const reporter *r, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info);

/* The rectangle of the image that a scene asks for. */
typedef struct region {
    uint32_t x, y, width, height;
} region;

region image_region(const mgt_image *image);

/* What the layer `samples` holds for methods that give every pixel the same. */
float samples_per_pixel(const mgt_quality *quality);

/* Bytes of one pixel of a format. */
size_t format_size(mgt_format format);

/* Address of the first pixel of a row of the region, tight stride resolved. */
void *target_row(const mgt_target *target, const region *area, uint32_t row);

#endif
