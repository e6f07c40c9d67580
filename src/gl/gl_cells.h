/* SPDX-License-Identifier: MIT
 * Memory for the refinement cells of method adaptive on the GPU. */
#ifndef MANGATA_GL_GL_CELLS_H
#define MANGATA_GL_GL_CELLS_H

#include "gl/gl_memory.h"

/* Kept between frames, see cells_layout.h. */
typedef struct gl_cells {
    gl_buffer leaves; /* the pool of leaves: two sides, of which each round reads one and writes the other */
    gl_buffer state;  /* words of the frame, words of its tiles, and lists */
    gl_buffer pixels; /* weight and height of the hit for each pixel */
    gl_buffer sets;   /* sets of waves */
    gl_buffer foam;   /* a foam_set for each set of waves, if there is foam */
    gl_buffer frames; /* a FrameData for each size of cells */
} gl_cells;

void gl_cells_free(const gl_api *gl, gl_cells *c);

#endif
