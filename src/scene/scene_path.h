/* SPDX-License-Identifier: MIT
 *
 * Cameras: the one of a moment on a path of keyframes, and which cameras are legal.
 */
#ifndef MANGATA_SCENE_SCENE_PATH_H
#define MANGATA_SCENE_SCENE_PATH_H

#include "scene/scene_fields.h"

/* The camera at a time. On a path it passes through every keyframe with a continuous velocity (cubic Hermite pieces whose
 * tangents are those of Catmull-Rom for uneven times); height and field of view never leave the range of the two
 * keyframes around (Fritsch-Carlson), so that no path dips under water. Before the first and after the last keyframe it rests. */
mgt_camera scene_camera_at(const scene_camera *camera, double time);

bool scene_camera_equal(const mgt_camera *left, const mgt_camera *right);

typedef enum camera_fault {
    CAMERA_LEGAL,
    CAMERA_NO_VIEW, /* position and target are one point */
    CAMERA_NO_UP,   /* up is zero or parallel to the view */
    CAMERA_FAR_AWAY /* a coordinate beyond 1e9 m, where interpolation overshot */
} camera_fault;

camera_fault scene_camera_fault(const mgt_camera *camera);

#endif
