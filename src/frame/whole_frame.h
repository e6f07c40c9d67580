/* SPDX-License-Identifier: MIT
 * Methods that work on whole pictures: fxaa on one of method `none`, taa on several, adaptive on its own. */
#ifndef MANGATA_FRAME_WHOLE_FRAME_H
#define MANGATA_FRAME_WHOLE_FRAME_H

#include "frame/backend.h"
#include "frame/frame.h"
#include "params/methods.h"

/* One picture of several that a frame is made of. */
typedef struct frame_pass {
    camera_rays camera;  /* instead of the scene's */
    double first, share; /* of the frame's progress: what is done already, and what this picture adds */
    bool behind;         /* objects in front of the water are left out */
} frame_pass;

/* A whole picture; members point into one allocation. */
typedef struct picture_planes {
    uint32_t width, height;
    float *color; /* 3 floats a pixel, kcd/m² */
    float *coverage, *water;
    float *depth;                         /* metres along the ray; only for taa */
    float *samples, *importance, *detail; /* only for adaptive */
} picture_planes;

/* Zeroed; color NULL where memory is short. */
picture_planes picture_planes_create(uint32_t width, uint32_t height, method_pass pass);
void picture_planes_free(picture_planes *p);

/* What the backend offers. */
typedef struct picture_maker {
    void *user;
    mgt_status (*render)(void *user, const mgt_scene *scene, const mgt_target *targets, size_t count, const frame_pass *pass);
    mgt_status (*display)(void *user, const mgt_scene *scene, const float *radiance, const mgt_target *target);
    /* Luma, [0, 1], of the displayed picture without glare. */
    mgt_status (*luma)(void *user, const mgt_scene *scene, const float *radiance, float *luma);
    /* body(argument, i) for every i below count, on all threads. */
    void (*run)(void *user, size_t count, void (*body)(void *, size_t), void *argument);
    /* Method adaptive: fills the planes. */
    mgt_status (*adapt)(void *user, const mgt_scene *scene, const picture_planes *out);
} picture_maker;

/* Defaults of a method, with the seed and the refraction of `q`. */
mgt_quality plain_quality(const mgt_quality *q, mgt_method method);

/* Renders a scene whose method is a METHOD_PASS. */
mgt_status whole_frame_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count);

/* ---- its two methods: `scene` asks for `none` and for no crop ---- */

mgt_status fxaa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out);
mgt_status taa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out);

/* ---- their parts ---- */

/* Where a pixel is read instead of at its centre: `amount` of a pixel, at most 1, towards the neighbour at (dx, dy). */
typedef struct fxaa_shift {
    int dx, dy;
    float amount;
} fxaa_shift;

/* `luma`: of the displayed picture, [0, 1]. */
fxaa_shift fxaa_shift_of(const float *luma, uint32_t width, uint32_t height, uint32_t x, uint32_t y);

enum { TAA_FRAMES = 8 };

/* Seconds between its frames. */
double taa_interval(const mgt_scene *scene);

/* The camera `share` of the shutter before it closes, on the line that it takes while the shutter is open; never on the other side of the water. */
mgt_camera taa_camera(const mgt_scene *scene, double share);

/* Where in the pixel the frame `back` frames ago looks, in pixels from the centre: columns and rows. */
void taa_offset(int back, double offset[2]);

/* What the newest of so many frames and one counts: a mean over all frames until a tenth is reached. */
float taa_weight(int frames);

/* One frame of the history: row `y` of `out` from the current picture and the history so far, of `frames` frames. Pixels' hits are
 * sought at `before`, the history's camera, unless `still`. */
typedef struct taa_step {
    const picture_planes *current, *history;
    picture_planes *out;
    camera_rays now, before;
    bool still;
    int frames;
} taa_step;

void taa_blend_row(const taa_step *step, uint32_t y);

/* From what the camera `now` sees to the picture of the camera `before`. */
Reprojection reprojection_of(const camera_rays *now, const camera_rays *before);

#endif
