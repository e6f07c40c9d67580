/* SPDX-License-Identifier: MIT
 *
 * Waves, camera, mirror and light in double precision.
 */
#include "reference/equations.h"

#include <math.h>

#include "reference/quadrature.h"

static const double pi = 3.14159265358979323846;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double a[3], const double b[3], double result[3])
{
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    result[0] = x;
    result[1] = y;
    result[2] = z;
}

static void normalize(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

/* ---- water ---- */

/* Means over the pixel of sin, cos, sin² and cos², one panel every half radian. */
filtered_sine box_filter_sine(double phase, const double gradient[2])
{
    static const double node[3] = {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781};
    static const double weight[3] = {0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504};
    int panels[2];
    for (int axis = 0; axis < 2; axis++)
        panels[axis] = 1 + (int)fmin(2 * fabs(gradient[axis]), 4096);
    double sine = 0, cosine = 0, sine_square = 0;
    for (int row = 0; row < 6 * panels[1]; row++) {
        for (int column = 0; column < 6 * panels[0]; column++) {
            double u[2], w = 1;
            for (int axis = 0; axis < 2; axis++) {
                const int at = axis ? row : column, i = at % 6;
                const double offset = (i < 3 ? -node[2 - i] : node[i - 3]);
                u[axis] = (at / 6 + 0.5 + 0.5 * offset) / panels[axis] - 0.5;
                w *= 0.5 * weight[i < 3 ? 2 - i : i - 3] / panels[axis];
            }
            const double angle = phase + gradient[0] * u[0] + gradient[1] * u[1];
            sine += w * sin(angle);
            cosine += w * cos(angle);
            sine_square += w * sin(angle) * sin(angle);
        }
    }
    const filtered_sine result = {sine, sine_square - sine * sine, cosine, 1 - sine_square - cosine * cosine};
    return result;
}

/* ---- camera ---- */

static double blend(double from, double to, double weight) { return from + (to - from) * weight; }

static mgt_camera camera_at(const mgt_scene *scene, double time)
{
    mgt_camera camera = scene->camera;
    if (!scene->camera_moves || !(scene->shutter > 0))
        return camera;
    const double weight = (scene->time - time) / scene->shutter;
    const mgt_camera *open = &scene->camera_open;
    for (int i = 0; i < 3; i++) {
        camera.position[i] = blend(camera.position[i], open->position[i], weight);
        camera.target[i] = blend(camera.target[i], open->target[i], weight);
        camera.up[i] = blend(camera.up[i], open->up[i], weight);
    }
    camera.fov_y_deg = blend(camera.fov_y_deg, open->fov_y_deg, weight);
    return camera;
}

void camera_ray(const mgt_scene *scene, double pixel_x, double pixel_y, double time, double origin[3], double direction[3])
{
    const mgt_camera camera = camera_at(scene, time);
    double forward[3], right[3], up[3];
    for (int i = 0; i < 3; i++)
        forward[i] = camera.target[i] - camera.position[i];
    normalize(forward);
    cross(forward, camera.up, right);
    normalize(right);
    cross(right, forward, up);
    const double extent = tan(camera.fov_y_deg * pi / 360);
    const double width = scene->image.width, height = scene->image.height;
    const double x = (2 * pixel_x / width - 1) * extent * width / height, y = (1 - 2 * pixel_y / height) * extent;
    for (int i = 0; i < 3; i++) {
        origin[i] = camera.position[i];
        direction[i] = forward[i] + x * right[i] + y * up[i];
    }
    normalize(direction);
}

bool pixel_on_plane(const mgt_scene *scene, double pixel_x, double pixel_y, double height, double xz[2])
{
    double origin[3], direction[3];
    camera_ray(scene, pixel_x, pixel_y, scene->time, origin, direction);
    const double distance = (height - origin[1]) / direction[1];
    if (!(distance > 0 && distance < HUGE_VAL))
        return false;
    xz[0] = origin[0] + distance * direction[0];
    xz[1] = origin[2] + distance * direction[2];
    return true;
}

bool pixel_footprint(const mgt_scene *scene, double pixel_x, double pixel_y, double height, double footprint[2][2])
{
    const double step = 1e-4; /* pixels */
    for (int axis = 0; axis < 2; axis++) {
        const double dx = axis == 0 ? step : 0, dy = axis == 1 ? step : 0;
        double before[2], after[2];
        if (!pixel_on_plane(scene, pixel_x - dx, pixel_y - dy, height, before) || !pixel_on_plane(scene, pixel_x + dx, pixel_y + dy, height, after))
            return false;
        for (int row = 0; row < 2; row++)
            footprint[row][axis] = (after[row] - before[row]) / (2 * step);
    }
    return true;
}

/* ---- mirror and light ---- */

void light_plane_axes(const double light[3], double first[3], double second[3])
{
    const double up[3] = {0, 1, 0};
    cross(up, light, first);
    if (dot(first, first) < 1e-24) {
        first[0] = -1;
        first[1] = first[2] = 0;
    }
    normalize(first);
    cross(light, first, second);
}

void mirror_direction(const double to_eye[3], const double slope[2], double mirrored[3])
{
    double normal[3] = {-slope[0], 1, -slope[1]};
    normalize(normal);
    const double cosine = dot(to_eye, normal);
    for (int i = 0; i < 3; i++)
        mirrored[i] = 2 * cosine * normal[i] - to_eye[i];
}

bool mirror_map(const double to_eye[3], const double light[3], const double slope[2], double point[2])
{
    double mirrored[3], first[3], second[3];
    mirror_direction(to_eye, slope, mirrored);
    const double along = dot(mirrored, light);
    if (!(along > 0))
        return false;
    light_plane_axes(light, first, second);
    point[0] = dot(mirrored, first) / along;
    point[1] = dot(mirrored, second) / along;
    return true;
}

bool mirror_map_jacobian(const double to_eye[3], const double light[3], const double slope[2], double jacobian[2][2])
{
    const double step = 1e-5;
    for (int axis = 0; axis < 2; axis++) {
        double before[2], after[2];
        const double low[2] = {slope[0] - (axis == 0 ? step : 0), slope[1] - (axis == 1 ? step : 0)};
        const double high[2] = {slope[0] + (axis == 0 ? step : 0), slope[1] + (axis == 1 ? step : 0)};
        if (!mirror_map(to_eye, light, low, before) || !mirror_map(to_eye, light, high, after))
            return false;
        for (int row = 0; row < 2; row++)
            jacobian[row][axis] = (after[row] - before[row]) / (2 * step);
    }
    return true;
}

void mirror_slope(const double to_eye[3], const double light[3], double slope[2])
{
    const double h[3] = {to_eye[0] + light[0], to_eye[1] + light[1], to_eye[2] + light[2]};
    slope[0] = -h[0] / h[1];
    slope[1] = -h[2] / h[1];
}

double fresnel_dielectric(double cosine, double index_of_refraction)
{
    const double c = fmin(fabs(cosine), 1), n = index_of_refraction;
    const double sine_inside = sqrt(1 - c * c) / n;
    if (sine_inside >= 1)
        return 1;
    const double c_inside = sqrt(1 - sine_inside * sine_inside);
    const double perpendicular = (c - n * c_inside) / (c + n * c_inside);
    const double parallel = (n * c - c_inside) / (n * c + c_inside);
    return 0.5 * (perpendicular * perpendicular + parallel * parallel);
}

typedef struct normal_law {
    double mean, deviation;
} normal_law;

static double weighted_density(double w, const void *user)
{
    const normal_law *law = user;
    const double t = (w - law->mean) / law->deviation;
    return w * exp(-0.5 * t * t) / (law->deviation * sqrt(2 * pi));
}

double mean_visible_weight(double mean, double deviation)
{
    if (!(deviation > 0))
        return fmax(mean, 0);
    const normal_law law = {mean, deviation};
    const double from = fmax(mean - 12 * deviation, 0), to = fmax(mean + 12 * deviation, 0);
    return integrate_pieces(weighted_density, &law, from, to, &mean, 1, 1e-13 * (fabs(mean) + deviation));
}
