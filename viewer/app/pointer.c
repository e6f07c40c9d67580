/* SPDX-License-Identifier: MIT
 * The pointer: orbiting, looking around, grabbing the water, the divider, magnifying. */
#include <GLFW/glfw3.h>

#include <math.h>
#include <string.h>

#include "cli/common/progress.h"
#include "viewer/app/viewer.h"
#include "viewer/scene/camera_moves.h"

/* Radians per pixel of a drag, and the factor of a step of the wheel. */
static const double turn_per_pixel = 0.0035, look_per_pixel = 0.0025, zoom_step = 1.12;

static bool over_divider(const viewer *v, double x)
{
    const ui_rect *p = &v->place.place;
    return v->settings.view.compare == COMPARE_WIPE && fabs(x - ((double)p->x + v->settings.view.wipe * (double)p->width)) < 8;
}

void input_fraction(const viewer *v, double x, double y, double fraction[2])
{
    const ui_rect *p = &v->place.place;
    const view_settings *s = &v->settings.view;
    const double size = 1 / s->zoom;
    const double cx = fmin(fmax(s->center_x, 0.5 * size), 1 - 0.5 * size), cy = fmin(fmax(s->center_y, 0.5 * size), 1 - 0.5 * size);
    fraction[0] = cx + ((x - (double)p->x) / (double)p->width - 0.5) * size;
    fraction[1] = cy + ((y - (double)p->y) / (double)p->height - 0.5) * size;
}

static void inspect_at(viewer *v, double x, double y)
{
    double fraction[2];
    input_fraction(v, x, y, fraction);
    if (fraction[0] < 0 || fraction[1] < 0 || fraction[0] >= 1 || fraction[1] >= 1)
        return;
    v->settings.inspect = (inspect_settings){(uint32_t)(fraction[0] * v->place.width), (uint32_t)(fraction[1] * v->place.height)};
    v->settings.panel.inspector = 1;
}

/* ---- drags ---- */

/* The drag that a press of the button begins on the picture. */
static drag_kind drag_of(const viewer *v, int button, int modifiers)
{
    const bool left = button == GLFW_MOUSE_BUTTON_LEFT;
    if (button == GLFW_MOUSE_BUTTON_MIDDLE || (left && modifiers & GLFW_MOD_SHIFT))
        return v->settings.view.zoom > 1 ? DRAG_SHIFT : DRAG_GRAB;
    if (button == GLFW_MOUSE_BUTTON_RIGHT || (left && v->settings.move.mode == MOVE_FLY))
        return DRAG_LOOK;
    return left ? DRAG_ORBIT : DRAG_NONE;
}

/* Grabs the water at the pointer. Where there is none, the drag becomes DRAG_SLIDE. */
static void begin_grab(viewer *v)
{
    drag *d = &v->pointer.drag;
    double at[2], middle[2];
    input_fraction(v, d->x, d->y, at);
    if (!viewer_point_at(v, at, d->point, middle)) {
        d->kind = DRAG_SLIDE;
        return;
    }
    for (int i = 0; i < 2; i++)
        d->offset[i] = middle[i] - at[i];
}

static void begin_drag(viewer *v, drag_kind kind)
{
    drag *d = &v->pointer.drag;
    *d = (drag){.kind = kind, .x = v->pointer.x, .y = v->pointer.y};
    if (kind == DRAG_NONE || kind == DRAG_WIPE || kind == DRAG_SHIFT)
        return;
    mgt_camera *camera = viewer_free_camera(v);
    if (kind != DRAG_LOOK)
        camera_set_pivot(camera, v->document.values.water.level);
    d->camera = *camera;
    if (kind == DRAG_GRAB)
        begin_grab(v);
}

void input_button(viewer *v, int button, int action, int modifiers)
{
    const pointer_state *p = &v->pointer;
    if (action == GLFW_RELEASE) {
        v->pointer.drag.kind = DRAG_NONE;
        return;
    }
    if (ui_takes_pointer())
        return;
    if (over_divider(v, p->x) && button == GLFW_MOUSE_BUTTON_LEFT)
        begin_drag(v, DRAG_WIPE);
    else if (modifiers & GLFW_MOD_CONTROL)
        inspect_at(v, p->x, p->y);
    else
        begin_drag(v, drag_of(v, button, modifiers));
}

/* Least height of the camera on an orbit, metres. A camera above the water stays above it. */
static double lowest_height(const viewer *v, const mgt_camera *camera)
{
    const double level = v->document.values.water.level;
    return camera->position[1] < level ? -HUGE_VAL : level + v->settings.move.clearance;
}

/* Moves the camera so that the grabbed point stays under the pointer. */
static void pull(viewer *v)
{
    const drag *d = &v->pointer.drag;
    mgt_camera *camera = viewer_free_camera(v);
    const ui_rect *place = &v->place.place;
    double at[2];
    input_fraction(v, v->pointer.x, v->pointer.y, at);
    for (int i = 0; i < 2; i++)
        at[i] += d->offset[i];
    camera_grab(camera, (double)place->width / (double)place->height, d->point, at);
}

/* Moves the camera in its own plane, so that the pivot follows the pointer. */
static void slide(viewer *v)
{
    const drag *d = &v->pointer.drag;
    const camera_axes axes = camera_axes_of(&d->camera);
    double distance = 0;
    for (int i = 0; i < 3; i++)
        distance += (d->camera.target[i] - d->camera.position[i]) * axes.forward[i];
    const double per_pixel = 2 * distance * tan(d->camera.fov_y_deg * 3.14159265358979323846 / 360) / (double)v->place.place.height;
    mgt_camera *camera = viewer_free_camera(v);
    *camera = d->camera;
    camera_move(camera, 0, -(v->pointer.x - d->x) * per_pixel, (v->pointer.y - d->y) * per_pixel);
}

/* Turns the camera of the press by the whole way since then, so that a limit that was met on the way has no effect later. */
static void turn_camera(viewer *v)
{
    const drag *d = &v->pointer.drag;
    const double x = v->pointer.x - d->x, y = v->pointer.y - d->y;
    mgt_camera *camera = viewer_free_camera(v);
    *camera = d->camera;
    if (d->kind == DRAG_LOOK)
        camera_look(camera, -x * look_per_pixel, y * look_per_pixel);
    else
        camera_orbit(camera, -x * turn_per_pixel, y * turn_per_pixel, lowest_height(v, &d->camera));
}

void input_pointer(viewer *v, double x, double y)
{
    pointer_state *p = &v->pointer;
    view_settings *s = &v->settings.view;
    const ui_rect *place = &v->place.place;
    const double dx = x - p->x, dy = y - p->y;
    p->x = x;
    p->y = y;
    switch (p->drag.kind) {
    case DRAG_NONE:
        break;
    case DRAG_WIPE:
        s->wipe = fmin(fmax((x - (double)place->x) / (double)place->width, 0), 1);
        break;
    case DRAG_LOOK:
    case DRAG_ORBIT:
        turn_camera(v);
        break;
    case DRAG_GRAB:
        pull(v);
        break;
    case DRAG_SLIDE:
        slide(v);
        break;
    case DRAG_SHIFT:
        s->center_x = fmin(fmax(s->center_x - dx / ((double)place->width * s->zoom), 0), 1);
        s->center_y = fmin(fmax(s->center_y - dy / ((double)place->height * s->zoom), 0), 1);
        break;
    }
}

/* Changes the magnification. The point under the pointer stays there. */
static void magnify(viewer *v, double factor)
{
    view_settings *s = &v->settings.view;
    double before[2], after[2];
    input_fraction(v, v->pointer.x, v->pointer.y, before);
    s->zoom = fmin(fmax(s->zoom * factor, 1), 64);
    input_fraction(v, v->pointer.x, v->pointer.y, after);
    s->center_x = fmin(fmax(s->center_x + before[0] - after[0], 0.5 / s->zoom), 1 - 0.5 / s->zoom);
    s->center_y = fmin(fmax(s->center_y + before[1] - after[1], 0.5 / s->zoom), 1 - 0.5 / s->zoom);
}

void input_scroll(viewer *v, double amount, int modifiers)
{
    if (ui_takes_pointer() || amount == 0)
        return;
    v->pointer.scrolled_at = seconds_now();
    const double factor = pow(zoom_step, amount);
    if (modifiers & GLFW_MOD_CONTROL)
        magnify(v, factor);
    else if (v->settings.move.mode == MOVE_FLY)
        v->settings.move.speed = fmin(fmax(v->settings.move.speed * factor, 0.01), 1e5);
    else {
        mgt_camera *camera = viewer_free_camera(v);
        camera_set_pivot(camera, v->document.values.water.level);
        camera_approach(camera, 1 / factor);
    }
}
