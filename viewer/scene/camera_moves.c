/* SPDX-License-Identifier: MIT
 * Orbiting, flying, grabbing the water, and keyframes. */
#include "viewer/scene/camera_moves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double steepest = 1.553;    /* largest elevation of a view, radians: 89 degrees */
static const double pivot_heights = 5;   /* largest distance of the pivot, in units of the camera's height above the water */
static const double longest_grab = 500;  /* largest distance of a grabbed point, in units of the camera's height above it */
static const double keyframe_gap = 1e-3; /* seconds; keyframes that are closer are the same one */
static const double pi = 3.14159265358979323846;
enum { MOST_KEYFRAMES = 10000 };

static double length_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalize(double v[3])
{
    const double length = length_of(v);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

camera_axes camera_axes_of(const mgt_camera *camera)
{
    camera_axes axes;
    for (int i = 0; i < 3; i++)
        axes.forward[i] = camera->target[i] - camera->position[i];
    normalize(axes.forward);
    cross(axes.forward, camera->up, axes.right);
    normalize(axes.right);
    cross(axes.right, axes.forward, axes.up);
    return axes;
}

void camera_set_pivot(mgt_camera *camera, double level)
{
    const camera_axes axes = camera_axes_of(camera);
    const double above = camera->position[1] - level, height = fmax(fabs(above), 0.1), fall = above < 0 ? axes.forward[1] : -axes.forward[1];
    const double distance = fall > 0 ? fmin(height / fall, pivot_heights * height) : pivot_heights * height;
    for (int i = 0; i < 3; i++)
        camera->target[i] = camera->position[i] + distance * axes.forward[i];
}

/* Turns a vector by an azimuth and an elevation, radians. The elevation stays above `lowest`, and off straight up and down, where the view would have no
 * direction to the right. */
static void turn(double v[3], double yaw, double pitch, double lowest)
{
    const double length = length_of(v), azimuth = atan2(v[0], -v[2]) + yaw;
    const double elevation = fmin(fmax(asin(fmin(fmax(v[1] / length, -1), 1)) + pitch, fmax(lowest, -steepest)), steepest);
    v[0] = length * sin(azimuth) * cos(elevation);
    v[1] = length * sin(elevation);
    v[2] = -length * cos(azimuth) * cos(elevation);
}

void camera_orbit(mgt_camera *camera, double yaw, double pitch, double lowest)
{
    double arm[3];
    for (int i = 0; i < 3; i++)
        arm[i] = camera->position[i] - camera->target[i];
    turn(arm, yaw, pitch, asin(fmin(fmax((lowest - camera->target[1]) / length_of(arm), -1), 1)));
    for (int i = 0; i < 3; i++)
        camera->position[i] = camera->target[i] + arm[i];
}

void camera_look(mgt_camera *camera, double yaw, double pitch)
{
    double view[3];
    for (int i = 0; i < 3; i++)
        view[i] = camera->target[i] - camera->position[i];
    turn(view, yaw, pitch, -steepest);
    for (int i = 0; i < 3; i++)
        camera->target[i] = camera->position[i] + view[i];
}

void camera_move(mgt_camera *camera, double forward, double right, double up)
{
    const camera_axes axes = camera_axes_of(camera);
    for (int i = 0; i < 3; i++) {
        const double step = forward * axes.forward[i] + right * axes.right[i] + (i == 1 ? up : 0);
        camera->position[i] += step;
        camera->target[i] += step;
    }
}

void camera_approach(mgt_camera *camera, double factor)
{
    for (int i = 0; i < 3; i++)
        camera->position[i] = camera->target[i] + factor * (camera->position[i] - camera->target[i]);
}

/* ---- projection ---- */

/* Half the height of the picture at distance 1. */
static double half_height(const mgt_camera *camera) { return tan(camera->fov_y_deg * pi / 360); }

void camera_view_ray(const mgt_camera *camera, double aspect, const double at[2], double direction[3])
{
    const camera_axes axes = camera_axes_of(camera);
    const double up = (1 - 2 * at[1]) * half_height(camera), right = (2 * at[0] - 1) * half_height(camera) * aspect;
    for (int i = 0; i < 3; i++)
        direction[i] = axes.forward[i] + right * axes.right[i] + up * axes.up[i];
    normalize(direction);
}

bool camera_project(const mgt_camera *camera, double aspect, const double point[3], double at[2])
{
    const camera_axes axes = camera_axes_of(camera);
    double forward = 0, right = 0, up = 0;
    for (int i = 0; i < 3; i++) {
        const double way = point[i] - camera->position[i];
        forward += way * axes.forward[i];
        right += way * axes.right[i];
        up += way * axes.up[i];
    }
    if (!(forward > 0))
        return false;
    at[0] = 0.5 + 0.5 * right / (forward * half_height(camera) * aspect);
    at[1] = 0.5 - 0.5 * up / (forward * half_height(camera));
    return true;
}

bool camera_grab(mgt_camera *camera, double aspect, const double point[3], const double at[2])
{
    double direction[3];
    camera_view_ray(camera, aspect, at, direction);
    const double fall = point[1] - camera->position[1], distance = fall / direction[1];
    if (!(direction[1] * fall > 0) || distance > longest_grab * fabs(fall))
        return false;
    for (int i = 0; i < 3; i += 2) {
        const double step = point[i] - distance * direction[i] - camera->position[i];
        camera->position[i] += step;
        camera->target[i] += step;
    }
    return true;
}

void camera_keep_above(mgt_camera *camera, double height)
{
    const double lift = height - camera->position[1];
    if (!(lift > 0))
        return;
    camera->position[1] += lift;
    camera->target[1] += lift;
}

/* ---- keyframes ---------------------------------------------------------------------------------------------- */

static scene_keyframe *keyframes_of(const scene_list *path) { return path->items; }

bool keyframe_record(scene_list *path, double time, const mgt_camera *camera)
{
    size_t at = 0;
    while (at < path->count && keyframes_of(path)[at].time < time - keyframe_gap)
        at++;
    if (at < path->count && fabs(keyframes_of(path)[at].time - time) <= keyframe_gap) {
        keyframes_of(path)[at].camera = *camera;
        return true;
    }
    if (path->count == MOST_KEYFRAMES)
        return false;
    scene_keyframe *items = realloc(path->items, (path->count + 1) * sizeof *items);
    if (!items)
        return false;
    memmove(items + at + 1, items + at, (path->count - at) * sizeof *items);
    items[at] = (scene_keyframe){time, *camera};
    *path = (scene_list){.items = items, .count = path->count + 1};
    return true;
}

void keyframe_delete(scene_list *path, size_t index)
{
    scene_keyframe *items = keyframes_of(path);
    memmove(items + index, items + index + 1, (path->count - index - 1) * sizeof *items);
    if (--path->count == 0) {
        free(path->items);
        path->items = NULL;
    }
}

size_t keyframe_move(scene_list *path, size_t index, double time)
{
    scene_keyframe *items = keyframes_of(path);
    for (size_t i = 0; i < path->count; i++)
        if (i != index && fabs(items[i].time - time) < keyframe_gap)
            return index; /* another keyframe has that time */
    items[index].time = time;
    for (; index > 0 && items[index - 1].time > items[index].time; index--) {
        const scene_keyframe other = items[index - 1];
        items[index - 1] = items[index];
        items[index] = other;
    }
    for (; index + 1 < path->count && items[index + 1].time < items[index].time; index++) {
        const scene_keyframe other = items[index + 1];
        items[index + 1] = items[index];
        items[index] = other;
    }
    return index;
}
