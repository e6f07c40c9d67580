/* SPDX-License-Identifier: MIT */
/* Matrices between primaries; see exr_primaries.h. */
#include "image/exr_primaries.h"

#include <math.h>
#include <stdbool.h>

typedef struct matrix {
    double m[3][3];
} matrix;

static const exr_attr_chromaticities_t srgb = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f};
static const matrix bradford = {{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};

static matrix multiply(const matrix *a, const matrix *b)
{
    matrix result = {{{0}}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                result.m[i][j] += a->m[i][k] * b->m[k][j];
    return result;
}

/* By cofactors. Values that are not finite stand for a matrix without inverse. */
static matrix inverse(const matrix *a)
{
    matrix result;
    double determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int r = (j + 1) % 3, s = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
            result.m[i][j] = a->m[r][p] * a->m[s][q] - a->m[r][q] * a->m[s][p];
        }
    for (int k = 0; k < 3; k++)
        determinant += a->m[0][k] * result.m[k][0];
    for (int i = 0; i < 9; i++)
        result.m[i / 3][i % 3] /= determinant;
    return result;
}

/* XYZ of a chromaticity with Y = 1. */
static void xyz_of(double x, double y, double out[3])
{
    out[0] = x / y;
    out[1] = 1;
    out[2] = (1 - x - y) / y;
}

static matrix scale_columns(const matrix *a, const double factors[3])
{
    matrix result = *a;
    for (int i = 0; i < 9; i++)
        result.m[i / 3][i % 3] *= factors[i % 3];
    return result;
}

static void apply(const matrix *a, const double in[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a->m[i][0] * in[0] + a->m[i][1] * in[1] + a->m[i][2] * in[2];
}

/* From linear RGB to XYZ. */
static matrix to_xyz(const exr_attr_chromaticities_t *c)
{
    const float xy[3][2] = {{c->red_x, c->red_y}, {c->green_x, c->green_y}, {c->blue_x, c->blue_y}};
    matrix primaries;
    double column[3], white[3], share[3];
    for (int k = 0; k < 3; k++) {
        xyz_of(xy[k][0], xy[k][1], column);
        for (int i = 0; i < 3; i++)
            primaries.m[i][k] = column[i];
    }
    const matrix back = inverse(&primaries);
    xyz_of(c->white_x, c->white_y, white);
    apply(&back, white, share);
    return scale_columns(&primaries, share);
}

/* Between XYZ of the two whites. */
static matrix adaptation(const exr_attr_chromaticities_t *from, const exr_attr_chromaticities_t *to)
{
    double white[3], cones[2][3], factors[3];
    const matrix back = inverse(&bradford);
    xyz_of(from->white_x, from->white_y, white);
    apply(&bradford, white, cones[0]);
    xyz_of(to->white_x, to->white_y, white);
    apply(&bradford, white, cones[1]);
    for (int i = 0; i < 3; i++)
        factors[i] = cones[1][i] / cones[0][i];
    const matrix scaled = scale_columns(&back, factors);
    return multiply(&scaled, &bradford);
}

static bool is_srgb(const exr_attr_chromaticities_t *c)
{
    const float own[] = {c->red_x, c->red_y, c->green_x, c->green_y, c->blue_x, c->blue_y, c->white_x, c->white_y};
    const float theirs[] = {srgb.red_x, srgb.red_y, srgb.green_x, srgb.green_y, srgb.blue_x, srgb.blue_y, srgb.white_x, srgb.white_y};
    bool same = true;
    for (int i = 0; i < 8; i++)
        same = same && fabsf(own[i] - theirs[i]) < 1e-3f;
    return same;
}

void exr_primaries_to_srgb(float *rgb, size_t pixels, const exr_attr_chromaticities_t *chromaticities)
{
    if (is_srgb(chromaticities))
        return;
    const matrix in = to_xyz(chromaticities), adapted = adaptation(chromaticities, &srgb), out = to_xyz(&srgb), back = inverse(&out);
    const matrix middle = multiply(&adapted, &in), whole = multiply(&back, &middle);
    for (int i = 0; i < 9; i++)
        if (!isfinite(whole.m[i / 3][i % 3]))
            return;
    for (size_t p = 0; p < pixels; p++, rgb += 3) {
        const double from[3] = {rgb[0], rgb[1], rgb[2]};
        double to[3];
        if (!isfinite(from[0]) || !isfinite(from[1]) || !isfinite(from[2]))
            continue;
        apply(&whole, from, to);
        for (int k = 0; k < 3; k++)
            rgb[k] = (float)to[k];
    }
}
