/* SPDX-License-Identifier: MIT
 * The steps of a frame on the GPU: bands of tiles, and passes over each band. */
#ifndef MANGATA_GL_GL_FRAME_H
#define MANGATA_GL_GL_FRAME_H

#include "gl/gl_renderer.h"

/* Rows of tiles that the renderer's buffers hold at one time. */
typedef struct gl_band {
    PassData pass;
    uint32_t tiles; /* number of the band's tiles */
} gl_band;

/* The drawing of one picture of a frame. */
typedef struct gl_run {
    gl_renderer *g;
    const gl_job *job;
    const reporter *r;
    const method_row *method;
    mgt_method_waves waves;
    gl_program program;
    uint32_t first_row, end_row, first_column, columns; /* the picture's tiles: rows first_row … end_row − 1, and columns from first_column on */
    uint32_t band_rows;                                 /* rows of tiles of a band */
    int wave_stride;                                    /* PassData.wave_stride */
    bool objects;                                       /* the scene has objects, or the camera is under water */
    float crests[2];                                    /* skyline_top of the views when the shutter closes and when it opens; 0: there is no skyline */
    GLsync behind;                                      /* fence behind the last step that was submitted; NULL: none, as long as nothing reports progress */
    double done, steps;                                 /* progress: steps that are done, steps in all */
} gl_run;

/* Fills the run, and reserves the band's lists of waves: each tile has a place in each of `sets`. */
mgt_status gl_run_begin(gl_run *run, gl_renderer *g, const gl_job *job, size_t sets, const reporter *r);
void gl_run_end(gl_run *run);

/* The band that begins with a row of tiles. */
gl_band gl_band_at(const gl_run *run, uint32_t row);

/* Places the frame's waves before a camera, in g->waves. `opens`: their skyline is that of the shutter's opening; otherwise that of its closing. */
void gl_place_waves(const gl_run *run, const camera_rays *camera, interval time, bool opens);

/* Places the waves of the part of the shutter between two fractions of it by wave_set_sweep(), in g->waves. */
void gl_place_sweep(const gl_run *run, double from, double to);

/* Sorts the waves of g->waves for the band's tiles, which are stored from `first_slot` on. `open_slots` is PassData.open_slots. */
mgt_status gl_sort_tiles(const FrameData *data, const gl_run *run, const gl_band *b, uint32_t first_slot, uint32_t open_slots);

/* Searches the lattices of first hits of the first `tiles` tiles. */
mgt_status gl_search_nodes(const gl_run *run, uint32_t tiles);

/* Binds the tiles' buffers, the layers as images and the sky. Layers that do not exist are not written: a store to no image has no effect. */
void gl_bind_tiles(const gl_renderer *g);

/* Prepares the passes over objects in a scene that has some: draws the objects' layers and makes their tables. If the camera moves, it also finds what all
 * pixels see of the objects when the shutter opens. */
mgt_status gl_prepare_objects(const gl_run *run);

/* Finds what the band's pixels see of objects. Does nothing without objects. */
mgt_status gl_see_band(const gl_run *run, const gl_band *b);

/* Draws the objects in front of the water over the band's layers. */
mgt_status gl_put_objects_in_front(const gl_run *run, const gl_band *b);

/* Reports that a step has been submitted. Waits until the step before it has run, so that reported progress is that of the GPU. */
mgt_status gl_step_done(gl_run *run, double steps);

#endif
