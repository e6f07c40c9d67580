/* SPDX-License-Identifier: MIT
 * The steps that frames on the GPU are made of: bands of tiles, and passes over each. */
#ifndef MANGATA_GL_GL_FRAME_H
#define MANGATA_GL_GL_FRAME_H

#include "gl/gl_renderer.h"

/* Rows of tiles that the buffers of the renderer hold at a time. */
typedef struct gl_band {
    PassData pass;
    uint32_t tiles; /* of one set of waves */
} gl_band;

/* One picture of a frame. */
typedef struct gl_run {
    gl_renderer *g;
    const gl_job *job;
    const reporter *r;
    const method_row *method;
    mgt_method_waves waves;
    gl_program program;
    uint32_t first_row, end_row, first_column, columns; /* of tiles */
    uint32_t band_rows;
    int wave_stride;
    bool objects;    /* the scene has some, or the camera is under water */
    float crests[2]; /* view.skyline_top when the shutter closes and when it opens, whose skylines are in the renderer's texture; 0: there is none */
    GLsync behind;   /* of the last step but one told */
    double done, steps;
} gl_run;

/* Fills the run, and reserves the band's lists of waves: each tile has a place in each of `sets`. */
mgt_status gl_run_begin(gl_run *run, gl_renderer *g, const gl_job *job, size_t sets, const reporter *r);
void gl_run_end(gl_run *run);

/* The band that begins with a row of tiles. */
gl_band gl_band_at(const gl_run *run, uint32_t row);

/* The frame's waves before a camera, into g->waves; `opens`: they have the skyline of the shutter's opening, else of its end. */
void gl_place_waves(const gl_run *run, const camera_rays *camera, interval time, bool opens);

/* Sorts the waves that g->waves holds into the band's tiles from `first_slot` on. `open_slots`: where the same tiles stand as they were when the
 * shutter opened, as in PassData. */
mgt_status gl_sort_tiles(const FrameData *data, const gl_run *run, const gl_band *b, uint32_t first_slot, uint32_t open_slots);

/* Lattices of first hits in the first `tiles` tiles. */
mgt_status gl_search_nodes(const gl_run *run, uint32_t tiles);

/* Binds the tiles' buffers, the layers as images and the sky. Layers that do not exist are not written: a store to no image has no effect. */
void gl_bind_tiles(const gl_renderer *g);
void gl_bind_layers(const gl_renderer *g);

/* Of scenes with objects: their layers and what else their passes need; where the camera moves, what all pixels see of them when the shutter opens. */
mgt_status gl_prepare_objects(const gl_run *run);

/* What the band's pixels see of objects; nothing where there are none. */
mgt_status gl_see_band(const gl_run *run, const gl_band *b);

/* Objects in front of the water over the band's layers. */
mgt_status gl_put_objects_in_front(const gl_run *run, const gl_band *b);

/* Tells that a step has been sent, and waits until the one before has run, so that the caller hears where the GPU is. */
mgt_status gl_step_done(gl_run *run, double steps);

#endif
