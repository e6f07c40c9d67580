/* SPDX-License-Identifier: MIT
 * Method adaptive's cells on the GPU: the memory of its rounds. */
#ifndef MANGATA_GL_GL_CELLS_H
#define MANGATA_GL_GL_CELLS_H

#include "gl/gl_memory.h"

/* Kept between frames, see cells_layout.h. */
typedef struct gl_cells {
    gl_buffer leaves; /* two sides, which rounds take in turns */
    gl_buffer state;  /* numbers of the frame and its tiles, and lists */
    gl_buffer pixels; /* weights, and heights of hits */
    gl_buffer sets;   /* waves */
    gl_buffer foam;   /* a foam_set for each of these, where there is foam */
    gl_buffer frames; /* FrameData for cells of each size */
} gl_cells;

void gl_cells_free(const gl_api *gl, gl_cells *c);

#endif
