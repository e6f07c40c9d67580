/* SPDX-License-Identifier: MIT
 *
 * Cells of the water in lanes: sums of waves in their middles, and what these say of lights.
 */
#ifndef MANGATA_REFERENCE_LIGHT_LANES_H
#define MANGATA_REFERENCE_LIGHT_LANES_H

#include "reference/reference_frame.h"

enum { REFERENCE_CELLS = 64 }; /* a multiple of every lane count */

typedef enum cell_verdict {
    CELL_DARK,    /* no slope in it mirrors a light */
    CELL_POINT,   /* a point of it may say what it mirrors */
    CELL_HALVE_X, /* to be halved along its first side */
    CELL_HALVE_Y  /* along its second */
} cell_verdict;

typedef struct light_disk {
    double direction[3];
    double sine, sagitta; /* sin R and 1 − cos R of its angular radius */
} light_disk;

/* Cells of one pixel of the plane. A cell lies within the parallelogram whose half sides are a and b. */
typedef struct reference_cells {
    /* The input, for each cell. */
    _Alignas(64) double x[REFERENCE_CELLS], z[REFERENCE_CELLS], time_offset[REFERENCE_CELLS];
    double eye_x[REFERENCE_CELLS], eye_y[REFERENCE_CELLS], eye_z[REFERENCE_CELLS]; /* where the camera stands */
    double a_x[REFERENCE_CELLS], a_z[REFERENCE_CELLS], b_x[REFERENCE_CELLS], b_z[REFERENCE_CELLS];
    double scale_x[REFERENCE_CELLS], scale_y[REFERENCE_CELLS]; /* of the sides, of those that the bounds below are for */

    /* The input, for all. */
    double axes[2][2];   /* of slopes: unit vectors, along the view and across */
    reference_bend bend; /* along these, for sides of scale 1 */
    double fair_share;   /* a cell is halved while it is wider than so many disks */
    int lights;
    light_disk disks[REFERENCE_LIGHTS];

    /* The output: the water in the middle, and a cell_verdict. */
    _Alignas(64) double height[REFERENCE_CELLS], slope_x[REFERENCE_CELLS], slope_z[REFERENCE_CELLS];
    int64_t verdict[REFERENCE_CELLS];
} reference_cells;

#endif
