/* SPDX-License-Identifier: MIT
 *
 * Light that the water mirrors, found on the surface instead of along rays.
 *
 * A small light is met by one ray in many thousands. Its mirror images stand where the surface's slope lies within a small ellipse, and
 * where that is can be told from sums of waves alone, without a search for hits. So the integral over a pixel and the open shutter is taken over the
 * mean surface: a place q of it lifts to the point P(q, t), which the camera sees at a pixel of its own, and area there is
 *
 *     |(P − C)·N| c_y² / (k³ |w_y|³)    for each area of the picture that the plane's place covers,
 *
 * with N = (−∂h/∂x, 1, −∂h/∂z), C the camera, c_y its height, k the depth of P, and w the ray of depth 1 through q.
 *
 * The picture of the plane is cut into pixels, those into cells. Of each cell, the slope at the middle, its derivatives there and a bound of
 * what second derivatives add tell whether any slope of the cell can mirror a light. If none can it adds exactly nothing. Else it is halved, until
 * the light fills a fair share of it; there one point, placed at random, is evaluated as a ray's hit would be. Points that mirror a light are kept if the ray
 * to them meets no water before. Where a pixel has more cells than are asked for, it takes cells at random, one from each of equal strata.
 * The estimate is unbiased: no cell that the light can fill is left out, and each point weighs what it stands for.
 */
#ifndef MANGATA_REFERENCE_LIGHT_CELLS_H
#define MANGATA_REFERENCE_LIGHT_CELLS_H

#include "reference/reference.h"

typedef struct light_cells_area {
    uint32_t x0, y0, width, height; /* width · height ≤ LIGHT_CELLS_PIXELS */
} light_cells_area;

enum { LIGHT_CELLS_PIXELS = 1024 };

typedef struct light_cells_sum {
    double rgb[3], coverage;
} light_cells_sum;

/* Whether cells can serve: a light is up, they are asked for, and the camera stands above all waves (reference_options.bound_deviations) and looks so that
 * the mean surface under what it shows lies before it. */
bool light_cells_serve(const reference_frame *frame);

/* Fills sums[y · width + x] for an area of the picture. What a pixel gets does not depend on the area. Returns how often a sum of waves was evaluated. */
uint64_t light_cells_render(const reference_frame *frame, const light_cells_area *area, light_cells_sum *sums);

#endif
