/* SPDX-License-Identifier: MIT
 * Methods that work on whole pictures: fxaa on one of method `none`, taa on several, adaptive on its own. */
#ifndef MANGATA_FRAME_WHOLE_FRAME_H
#define MANGATA_FRAME_WHOLE_FRAME_H

#include "frame/backend.h"
#include "frame/frame.h"
#include "params/methods.h"

/* One picture of several that a frame is made of. */
typedef struct frame_pass {
    camera_rays camera;  /* used instead of the scene's camera */
    double first, share; /* fractions of the frame's progress: before this picture, and by this picture */
    bool behind;         /* objects in front of the water are left out */
} frame_pass;

/* A whole picture; members point into one allocation. */
typedef struct picture_planes {
    uint32_t width, height;
    float *color; /* linear sRGB, 3 floats a pixel, kcd/m² */
    float *coverage, *water;
    float *depth;                         /* metres along the ray; NULL except for taa */
    float *samples, *importance, *detail; /* NULL except for adaptive */
} picture_planes;

/* Creates zeroed planes. `color` is NULL when out of memory. */
picture_planes picture_planes_create(uint32_t width, uint32_t height, method_pass pass);
void picture_planes_free(picture_planes *p);

/* Functions of the backend. */
typedef struct picture_maker {
    void *user;
    mgt_status (*render)(void *user, const mgt_scene *scene, const mgt_target *targets, size_t count, const frame_pass *pass);
    mgt_status (*display)(void *user, const mgt_scene *scene, const float *radiance, const mgt_target *target);
    /* Fills `luma`, in [0, 1], from the displayed picture without glare. */
    mgt_status (*luma)(void *user, const mgt_scene *scene, const float *radiance, float *luma);
    /* Calls body(argument, i) for every i below count, on all threads. */
    void (*run)(void *user, size_t count, void (*body)(void *, size_t), void *argument);
    /* Method adaptive: fills the planes. */
    mgt_status (*adapt)(void *user, const mgt_scene *scene, const picture_planes *out);
} picture_maker;

/* Default quality of a method, with the seed, the refraction and the caustics of `q`. */
mgt_quality plain_quality(const mgt_quality *q, mgt_method method);

/* Renders a scene whose method is a METHOD_PASS. */
mgt_status whole_frame_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count);

/* ---- the methods fxaa and taa; the method of `scene` is `none`, and it has no crop ---- */

mgt_status fxaa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out);
mgt_status taa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out);

/* ---- parts of fxaa and taa ---- */

/* The place at which a pixel is read: its centre, moved by `amount` pixels, at most 1, towards the neighbour at (dx, dy). */
typedef struct fxaa_shift {
    int dx, dy;
    float amount;
} fxaa_shift;

/* The shift of pixel (x, y); `luma` is that of the displayed picture, in [0, 1]. */
fxaa_shift fxaa_shift_of(const float *luma, uint32_t width, uint32_t height, uint32_t x, uint32_t y);

/* Number of frames that taa blends. */
enum { TAA_FRAMES = 8 };

/* Time between taa's frames, seconds. */
double taa_interval(const mgt_scene *scene);

/* The camera at the time `share` shutters before the shutter closes; `share` may exceed 1. The camera moves on as it does while the shutter is open, but never
 * to the other side of the water. */
mgt_camera taa_camera(const mgt_scene *scene, double share);

/* Jitter of the frame `back` frames ago: columns and rows from the pixel's centre. */
void taa_offset(int back, double offset[2]);

/* Weight of the newest frame after a history of `frames` frames: 1/(frames + 1), but at least a tenth. */
float taa_weight(int frames);

/* One step of the history: blends the current picture into the history so far. */
typedef struct taa_step {
    const picture_planes *current, *history;
    picture_planes *out;
    camera_rays now, before; /* cameras of `current` and of `history` */
    bool still;              /* the cameras are the same, so that pixels need no reprojection */
    int frames;              /* number of frames in the history */
} taa_step;

/* Fills row `y` of step->out. */
void taa_blend_row(const taa_step *step, uint32_t y);

/* The reprojection of points that the camera `now` sees into the picture of the camera `before`. */
Reprojection reprojection_of(const camera_rays *now, const camera_rays *before);

#endif
