/* SPDX-License-Identifier: MIT
 *
 * Lights that the water mirrors, by an integral over the surface instead of rays.
 *
 * Only one mirrored ray in many thousands meets a small light. The light's mirror images are where the surface's slope lies within a small ellipse. Sums of
 * waves tell where this is, without a search for hits. So the integral over a pixel and the shutter is taken over the mean surface. A place q of the mean
 * surface is lifted to the point P(q, t) of the waves, which the camera may see in another pixel. The factor between areas of the picture is
 *
 *     |(P − C)·N| c_y² / (k³ |w_y|³)    for each area of the picture that the plane's place covers,
 *
 * with N = (−∂h/∂x, 1, −∂h/∂z), C the camera, c_y its height, k the depth of P, and w the ray of depth 1 through q.
 *
 * The picture of the mean surface is divided into pixels, and each pixel into cells. The slope in a cell's middle, its derivatives there and a bound of the
 * second derivatives' contribution tell whether any slope in the cell can mirror a light. If none can, the cell adds exactly nothing. Otherwise it is halved,
 * until the light fills a fair share of it. Then a random point of the cell is evaluated like a ray's hit. A point that mirrors a light counts if the ray to
 * it meets no water before. If a pixel has more cells than were asked for, it takes cells at random, one from each of equal strata. The estimate is unbiased:
 * no cell that may mirror a light is left out, and the weight of a point is the area that it stands for.
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

/* Whether the frame uses cells: the scene asks for them, a light is above the horizon, the camera is above all waves (within
 * reference_options.bound_deviations), and the mean surface that it shows is in front of it. */
bool light_cells_serve(const reference_frame *frame);

/* Fills sums[y · width + x] for an area of the picture. A pixel's sum does not depend on the area. Returns the number of evaluated sums of waves. */
uint64_t light_cells_render(const reference_frame *frame, const light_cells_area *area, light_cells_sum *sums);

#endif
