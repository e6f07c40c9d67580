/* SPDX-License-Identifier: MIT
 *
 * The camera at a time on a path of keyframes, and checks of cameras.
 */
#ifndef MANGATA_SCENE_SCENE_PATH_H
#define MANGATA_SCENE_SCENE_PATH_H

#include "scene/scene_fields.h"

/* The camera at a time. A path passes through every keyframe with a continuous velocity: its pieces are cubic Hermite curves with the tangents of Catmull-Rom
 * for uneven times. Height and field of view stay within the range of the two nearest keyframes (Fritsch-Carlson), so that no path dips under water. Before the
 * first and after the last keyframe the camera rests. */
mgt_camera scene_camera_at(const scene_camera *camera, double time);

bool scene_camera_equal(const mgt_camera *left, const mgt_camera *right);

typedef enum camera_fault {
    CAMERA_LEGAL,
    CAMERA_NO_VIEW, /* position and target are one point */
    CAMERA_NO_UP,   /* up is zero or parallel to the view */
    CAMERA_FAR_AWAY /* a coordinate is beyond 1e9 m, because the interpolation has overshot */
} camera_fault;

camera_fault scene_camera_fault(const mgt_camera *camera);

#endif
