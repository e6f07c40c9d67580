/* SPDX-License-Identifier: MIT
 *
 * A host's matrices as the rays and depths of pixels.
 *
 * For clip coordinates (x, y, z, w) = P·e of an eye-space point e, the rows 0, 1 and 3 of a perspective P have no constant part: the eye
 * stands at their common zero. Then e = w·A⁻¹·(x/w, y/w, 1) with A the 3×3 matrix of these rows. So a pixel's ray is affine in the pixel,
 * also off-centre or jittered, and w counts along it; row 2 alone makes the depth, whatever its near and far planes. */
#include "frame/view_rays.h"

#include <math.h>

#include "base/triples.h"

static void row_of(const double matrix[16], int row, double out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = matrix[4 * i + row];
}

static bool is_finite(const double matrix[16])
{
    for (int i = 0; i < 16; i++)
        if (!(fabs(matrix[i]) <= 1e15))
            return false;
    return true;
}

/* Whether the matrix is a rotation and a translation. */
static bool is_rigid(const double matrix[16])
{
    double x[4], y[4], z[4], w[4], product[3];
    row_of(matrix, 0, x);
    row_of(matrix, 1, y);
    row_of(matrix, 2, z);
    row_of(matrix, 3, w);
    cross3(x, y, product);
    const double error = fabs(dot3(x, x) - 1) + fabs(dot3(y, y) - 1) + fabs(dot3(z, z) - 1) + fabs(dot3(x, y)) + fabs(dot3(y, z)) + fabs(dot3(z, x)) +
                         fabs(dot3(product, z) - 1) + fabs(w[0]) + fabs(w[1]) + fabs(w[2]) + fabs(w[3] - 1);
    return error < 1e-3;
}

/* Columns of the inverse of the matrix with these rows; false where it has none. */
static bool invert3(const double a[3], const double b[3], const double c[3], double columns[3][3])
{
    cross3(b, c, columns[0]);
    cross3(c, a, columns[1]);
    cross3(a, b, columns[2]);
    const double det = dot3(a, columns[0]);
    if (!(fabs(det) > 1e-12 * sqrt(dot3(a, a) * dot3(b, b) * dot3(c, c))))
        return false;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            columns[i][j] /= det;
    return true;
}

/* Rotates a direction from eye space to world space. */
static void to_world(const double matrix[16], const double eye[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = dot3(&matrix[4 * i], eye);
}

const char *view_rays_of(const mgt_gl_view *view, const double matrix[16], view_rays *out)
{
    if (!is_finite(matrix) || !is_finite(view->projection))
        return "its matrices are not finite";
    if (!is_rigid(matrix))
        return "its view matrix is not a rotation and a translation (column-major, world to eye)";
    double x[4], y[4], z[4], w[4], columns[3][3];
    row_of(view->projection, 0, x);
    row_of(view->projection, 1, y);
    row_of(view->projection, 2, z);
    row_of(view->projection, 3, w);
    const double size = sqrt(dot3(w, w));
    if (!(size > 1e-12) || fabs(w[3]) > 1e-9 * size)
        return "its projection is orthographic; a perspective one is needed (column-major, eye to clip)";
    if (fabs(x[3]) > 1e-9 * sqrt(dot3(x, x)) || fabs(y[3]) > 1e-9 * sqrt(dot3(y, y)) || !invert3(x, y, w, columns))
        return "its projection is no perspective from the eye's origin (column-major, eye to clip)";

    const double step_x = 2.0 / view->width, step_y = -2.0 / view->height;
    double corner[3], right[3], down[3];
    for (int i = 0; i < 3; i++) {
        corner[i] = columns[0][i] * (0.5 * step_x - 1) + columns[1][i] * (1 + 0.5 * step_y) + columns[2][i];
        right[i] = columns[0][i] * step_x;
        down[i] = columns[1][i] * step_y;
    }
    to_world(matrix, corner, out->rays.corner);
    to_world(matrix, right, out->rays.right);
    to_world(matrix, down, out->rays.down);
    double place[3];
    to_world(matrix, &matrix[12], place);
    for (int i = 0; i < 3; i++)
        out->rays.position[i] = -place[i];
    out->clip_depth[0] = dot3(z, corner);
    out->clip_depth[1] = dot3(z, right);
    out->clip_depth[2] = dot3(z, down);
    out->clip_offset = z[3];
    return NULL;
}

static void middle_of(const camera_rays *rays, uint32_t width, uint32_t height, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = rays->corner[i] + 0.5 * (width - 1.0) * rays->right[i] + 0.5 * (height - 1.0) * rays->down[i];
}

mgt_camera view_camera(const camera_rays *rays, uint32_t width, uint32_t height)
{
    mgt_camera camera = {.fov_y_deg = 60};
    double middle[3];
    middle_of(rays, width, height, middle);
    for (int i = 0; i < 3; i++) {
        camera.position[i] = rays->position[i];
        camera.target[i] = rays->position[i] + middle[i];
        camera.up[i] = -rays->down[i];
    }
    return camera;
}

double view_pixel_angle(const camera_rays *rays)
{
    double normal[3];
    cross3(rays->right, rays->down, normal);
    const double distance = fabs(dot3(rays->corner, normal)) / sqrt(dot3(normal, normal));
    return sqrt(dot3(rays->down, rays->down)) / distance;
}
