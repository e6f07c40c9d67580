/* SPDX-License-Identifier: MIT
 *
 * Cameras: the one of a moment on a path of keyframes, and which cameras are legal.
 */
#include "scene/scene_path.h"

#include <math.h>

enum { CHANNELS = 10, HEIGHT = 1, FIELD_OF_VIEW = 9 };

static double channel(const scene_keyframe *keyframe, int index)
{
    const mgt_camera *camera = &keyframe->camera;
    return index < 3 ? camera->position[index] : index < 6 ? camera->target[index - 3] : index < 9 ? camera->up[index - 6] : camera->fov_y_deg;
}

static void set_channel(mgt_camera *camera, int index, double value)
{
    if (index < 3)
        camera->position[index] = value;
    else if (index < 6)
        camera->target[index - 3] = value;
    else if (index < 9)
        camera->up[index - 6] = value;
    else
        camera->fov_y_deg = value;
}

static double secant(const scene_keyframe *keyframes, size_t i, int index)
{
    return (channel(&keyframes[i + 1], index) - channel(&keyframes[i], index)) / (keyframes[i + 1].time - keyframes[i].time);
}

/* Slope of a channel at keyframe i of `count` ≥ 2: of the parabola through its neighbours. */
static double tangent(const scene_keyframe *keyframes, size_t count, size_t i, int index)
{
    if (i == 0)
        return secant(keyframes, 0, index);
    if (i == count - 1)
        return secant(keyframes, count - 2, index);
    double before = secant(keyframes, i - 1, index), after = secant(keyframes, i, index);
    double span_before = keyframes[i].time - keyframes[i - 1].time, span_after = keyframes[i + 1].time - keyframes[i].time;
    double slope = (span_after * before + span_before * after) / (span_before + span_after);
    if (index != HEIGHT && index != FIELD_OF_VIEW)
        return slope;
    if (before * after <= 0)
        return 0;
    return copysign(fmin(fabs(slope), 3 * fmin(fabs(before), fabs(after))), slope);
}

/* Index of the keyframe at or before `time`, which lies within the path. */
static size_t find_keyframe(const scene_keyframe *keyframes, size_t count, double time)
{
    size_t low = 0, high = count - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (keyframes[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

mgt_camera scene_camera_at(const scene_camera *camera, double time)
{
    const scene_keyframe *keyframes = camera->path.items;
    const size_t count = camera->path.count;
    if (count == 0)
        return camera->still;
    if (!(time > keyframes[0].time))
        return keyframes[0].camera;
    if (time >= keyframes[count - 1].time)
        return keyframes[count - 1].camera;

    size_t i = find_keyframe(keyframes, count, time);
    double span = keyframes[i + 1].time - keyframes[i].time, s = (time - keyframes[i].time) / span;
    mgt_camera result = keyframes[i].camera;
    for (int index = 0; index < CHANNELS; index++) {
        double from = channel(&keyframes[i], index), to = channel(&keyframes[i + 1], index);
        double out = span * tangent(keyframes, count, i, index), in = span * tangent(keyframes, count, i + 1, index);
        double cubic = out + in - 2 * (to - from), square = 3 * (to - from) - 2 * out - in;
        double value = from + s * (out + s * (square + s * cubic));
        if (index == HEIGHT || index == FIELD_OF_VIEW) /* rounding may still leave the range */
            value = fmin(fmax(value, fmin(from, to)), fmax(from, to));
        set_channel(&result, index, value);
    }
    return result;
}

bool scene_camera_equal(const mgt_camera *left, const mgt_camera *right)
{
    bool equal = left->fov_y_deg == right->fov_y_deg;
    for (int i = 0; i < 3; i++)
        equal &= left->position[i] == right->position[i] && left->target[i] == right->target[i] && left->up[i] == right->up[i];
    return equal;
}

camera_fault scene_camera_fault(const mgt_camera *camera)
{
    double view[3], view_length = 0, up_length = 0, cross_length = 0;
    for (int i = 0; i < 3; i++) {
        if (!(fabs(camera->position[i]) <= 1e9 && fabs(camera->target[i]) <= 1e9 && fabs(camera->up[i]) <= 1e9))
            return CAMERA_FAR_AWAY;
        view[i] = camera->target[i] - camera->position[i];
        view_length += view[i] * view[i];
        up_length += camera->up[i] * camera->up[i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        double cross = view[j] * camera->up[k] - view[k] * camera->up[j];
        cross_length += cross * cross;
    }
    /* the library's own bounds */
    if (!(view_length > 1e-18))
        return CAMERA_NO_VIEW;
    if (!(up_length > 1e-18) || !(cross_length > 1e-12 * view_length * up_length))
        return CAMERA_NO_UP;
    return CAMERA_LEGAL;
}
