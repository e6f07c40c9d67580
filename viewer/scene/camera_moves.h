/* SPDX-License-Identifier: MIT
 * Moves a camera by hand, and edits the keyframes of its path. Angles are in radians. */
#ifndef MANGATA_VIEWER_SCENE_CAMERA_MOVES_H
#define MANGATA_VIEWER_SCENE_CAMERA_MOVES_H

#include "scene/scene_fields.h"

/* Unit axes of the view, orthogonal to each other. */
typedef struct camera_axes {
    double forward[3], right[3], up[3];
} camera_axes;

/* The axes of a camera, which must not look along its up direction. */
camera_axes camera_axes_of(const mgt_camera *camera);

/* Moves the target along the view to the point where it meets the mean water at height `level`, but not too far away to turn about. The picture stays the
 * same. */
void camera_set_pivot(mgt_camera *camera, double level);

/* Turns the camera about its target. The position keeps its distance and stays at height `lowest` or higher. */
void camera_orbit(mgt_camera *camera, double yaw, double pitch, double lowest);
void camera_look(mgt_camera *camera, double yaw, double pitch);                /* turns the camera about its position */
void camera_move(mgt_camera *camera, double forward, double right, double up); /* moves position and target, metres */
void camera_approach(mgt_camera *camera, double factor);                       /* multiplies the distance to the target by `factor` */

/* The unit direction seen at a place of the picture, fractions of its width and height from the top left; `aspect` is width / height. */
void camera_view_ray(const mgt_camera *camera, double aspect, const double at[2], double direction[3]);

/* The place at which a point is seen, in the coordinates of camera_view_ray(). Returns false if the point is behind the camera. */
bool camera_project(const mgt_camera *camera, double aspect, const double point[3], double at[2]);

/* Moves the camera horizontally until `point` is seen at a place of the picture. If the view at this place does not reach the point's height, it moves nothing
 * and returns false. */
bool camera_grab(mgt_camera *camera, double aspect, const double point[3], const double at[2]);

/* Lifts the camera and its target until the camera is at least at this height. */
void camera_keep_above(mgt_camera *camera, double height);

/* Adds a keyframe, or replaces one whose time differs by at most 1 ms. False: the path has the largest number of keyframes, or memory has run out. */
bool keyframe_record(scene_list *path, double time, const mgt_camera *camera);
void keyframe_delete(scene_list *path, size_t index);

/* Gives a keyframe another time and returns its new index. If another keyframe has about that time, nothing changes. */
size_t keyframe_move(scene_list *path, size_t index, double time);

#endif
