/* SPDX-License-Identifier: MIT
 *
 * Cells of the water in lanes: sums of waves in their middles, and whether the cells can mirror a light.
 */
#ifndef MANGATA_REFERENCE_LIGHT_LANES_H
#define MANGATA_REFERENCE_LIGHT_LANES_H

#include "reference/reference_frame.h"

enum { REFERENCE_CELLS = 64 }; /* a multiple of every lane count */

typedef enum cell_verdict {
    CELL_DARK,    /* no slope in the cell mirrors a light */
    CELL_POINT,   /* a random point of the cell must be evaluated */
    CELL_HALVE_X, /* the cell must be halved along its first side */
    CELL_HALVE_Y  /* the cell must be halved along its second side */
} cell_verdict;

typedef struct light_disk {
    double direction[3];
    double sine, sagitta; /* sin R and 1 − cos R of its angular radius */
} light_disk;

/* Cells of one pixel of the plane. A cell lies within the parallelogram whose half sides are a and b. */
typedef struct reference_cells {
    /* The input, for each cell. */
    _Alignas(64) double x[REFERENCE_CELLS], z[REFERENCE_CELLS], time_offset[REFERENCE_CELLS];
    double eye_x[REFERENCE_CELLS], eye_y[REFERENCE_CELLS], eye_z[REFERENCE_CELLS]; /* the camera's position at the cell's time */
    double a_x[REFERENCE_CELLS], a_z[REFERENCE_CELLS], b_x[REFERENCE_CELLS], b_z[REFERENCE_CELLS];
    double scale_x[REFERENCE_CELLS], scale_y[REFERENCE_CELLS]; /* lengths of the cell's sides, divided by those that `bend` is for */

    /* The input, for all. */
    double axes[2][2];   /* unit axes of slope space, along the view and across */
    reference_bend bend; /* bounds along these axes, for sides of scale 1 */
    double fair_share;   /* a cell is halved while it is wider than this many disks */
    int lights;
    light_disk disks[REFERENCE_LIGHTS];

    /* The output: height and slope in the cell's middle, and a cell_verdict. */
    _Alignas(64) double height[REFERENCE_CELLS], slope_x[REFERENCE_CELLS], slope_z[REFERENCE_CELLS];
    int64_t verdict[REFERENCE_CELLS];
} reference_cells;

#endif
