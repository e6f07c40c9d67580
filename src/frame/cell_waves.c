/* SPDX-License-Identifier: MIT
 * Times, rays and uniform numbers for the refinement cells of method adaptive. */
#include "frame/cell_waves.h"

#include <math.h>

#include "frame/lights.h"

/* ---- the shutter ---- */

/* RMS distance of the slopes' path during one of `parts` pieces of the shutter from a straight path, divided by the light's radius in slope space. */
static double path_bend(const frame *f, int parts)
{
    const mgt_scene *s = f->scene;
    return sines_path_bend(&s->water, s->shutter / 2 / parts) / (0.5 * lights_disk_radius(&f->data));
}

/* Number of pieces at least if the camera moves. While it moves by some pixels a path over the water is far from straight. */
enum { LEAST_MOVING_PARTS = 4 };

void cell_part_counts(const frame *f, int counts[CELL_CLASSES])
{
    static const double allowed[CELL_CLASSES] = {[CELLS_WHOLE] = 1e9, [CELLS_PARTS] = 0.5, [CELLS_SHARP] = 0.02};
    for (int k = 0; k < CELL_CLASSES; k++) {
        counts[k] = k != CELLS_WHOLE && f->scene->camera_moves ? LEAST_MOVING_PARTS : 1;
        while (counts[k] < LEAF_PARTS && path_bend(f, counts[k]) > allowed[k])
            counts[k] *= 2;
    }
}

double cell_instant(int i) { return (i + 0.5) / LEAF_INSTANTS; }

/* ---- cells ---- */

ViewData cell_view(const ViewData *view, int across, int down)
{
    ViewData v = *view;
    v.scale_x = ldexpf(1, across);
    v.scale_y = ldexpf(1, down);
    v.rays.right_x /= v.scale_x, v.rays.right_y /= v.scale_x, v.rays.right_z /= v.scale_x;
    v.rays.down_x /= v.scale_y, v.rays.down_y /= v.scale_y, v.rays.down_z /= v.scale_y;
    const float x = 0.5f - 0.5f * v.scale_x, y = 0.5f - 0.5f * v.scale_y;
    v.rays.corner_x += x * v.rays.right_x + y * v.rays.down_x;
    v.rays.corner_y += x * v.rays.right_y + y * v.rays.down_y;
    v.rays.corner_z += x * v.rays.right_z + y * v.rays.down_z;
    return v;
}

FrameData cell_frame(const FrameData *data, int across, int down)
{
    FrameData d = *data;
    d.pixel_angle = ldexpf(d.pixel_angle, across > down ? -across : -down);
    if (across + down > 0) {
        /* Glints in small cells are sharp: a wave's weight must be that of the cell, not the mean of its tile. */
        d.sort_weights = 0;
        d.sort_start = 1e-3f;
    }
    return d;
}
