/* SPDX-License-Identifier: MIT
 * Moving a camera by hand, and the keyframes of its path. Angles in radians. */
#ifndef MANGATA_VIEWER_SCENE_CAMERA_MOVES_H
#define MANGATA_VIEWER_SCENE_CAMERA_MOVES_H

#include "scene/scene_fields.h"

/* The view's unit axes; up is across the view. */
typedef struct camera_axes {
    double forward[3], right[3], up[3];
} camera_axes;

camera_axes camera_axes_of(const mgt_camera *camera);

/* Sets the target to where the view meets the mean water at `level`, near enough to turn about. The picture stays the same. */
void camera_set_pivot(mgt_camera *camera, double level);

/* Turns about the target; the position stays at `lowest` or higher and keeps its distance. */
void camera_orbit(mgt_camera *camera, double yaw, double pitch, double lowest);
void camera_look(mgt_camera *camera, double yaw, double pitch);                /* about the position */
void camera_move(mgt_camera *camera, double forward, double right, double up); /* metres */
void camera_approach(mgt_camera *camera, double factor);                       /* distance to the target times this */

/* The unit direction seen at a place of the picture, fractions of its width and height from the top left; `aspect` is width / height. */
void camera_view_ray(const mgt_camera *camera, double aspect, const double at[2], double direction[3]);

/* Where a point is seen, as camera_view_ray() takes it. False behind the camera. */
bool camera_project(const mgt_camera *camera, double aspect, const double point[3], double at[2]);

/* Moves the camera level until `point` is seen at a place of the picture. False, and nothing moves, where the view there does not reach the point's height. */
bool camera_grab(mgt_camera *camera, double aspect, const double point[3], const double at[2]);

/* Lifts the camera, target and all, to at least this height. */
void camera_keep_above(mgt_camera *camera, double height);

/* Adds a keyframe, or replaces the one of about the same time. False when memory runs out. */
bool keyframe_record(scene_list *path, double time, const mgt_camera *camera);
void keyframe_delete(scene_list *path, size_t index);

/* Gives a keyframe another time and returns its new index; it stays apart from its neighbours. */
size_t keyframe_move(scene_list *path, size_t index, double time);

#endif
