/* SPDX-License-Identifier: MIT
 * The rasterised layers of objects: what they depend on, and their shape. */
#include "frame/gbuffer_job.h"

#include <math.h>

#include "base/triples.h"

enum {
    GUARD_LEAST = 16,    /* least width of the guard band on each side, pixels */
    GUARD_FRACTION = 20, /* the guard band on each side is at least the image's size divided by this */
};

RefractData refract_data_of(double camera_height, double index, int map)
{
    const double n = fmax(index, 1), excess = n * n - 1, critical = excess > 0 ? 1 / sqrt(excess) : 0;
    return (RefractData){
        .side = camera_height < 0 ? -1.0f : 1.0f,
        .distance = (float)fabs(camera_height),
        .index = (float)n,
        .index_inverse = (float)(1 / n),
        .index_squared = (float)(n * n),
        .excess = (float)excess,
        .excess_root = (float)sqrt(excess),
        .critical = (float)critical,
        .critical_low = (float)(critical - (double)(float)critical),
        .map = map,
    };
}

static uint32_t guard_of(uint32_t size)
{
    const uint32_t share = (size + GUARD_FRACTION - 1) / GUARD_FRACTION;
    return ((share > GUARD_LEAST ? share : GUARD_LEAST) + 15) / 16 * 16;
}

gbuffer gbuffer_shape(const gbuffer_job *job)
{
    const uint32_t left = guard_of(job->width), top = guard_of(job->height);
    return (gbuffer){.width = (job->width + 2 * left + 15) / 16 * 16, .height = job->height + 2 * top, .left = left, .top = top};
}

/* The inverse of the rays: it gives x, y and depth with p = depth · corner + x · right + y · down, where x and y are pixel coordinates times depth. */
PictureData gbuffer_picture(const gbuffer_job *job)
{
    const gbuffer layer = gbuffer_shape(job);
    const double middle_x = layer.left + job->width / 2, middle_y = layer.top + job->height / 2;
    const camera_rays *c = &job->camera;
    const double tau = job->error > 0 ? job->error : 0.1, edge = 0.8 * tau; /* the error in a triangle's middle may be a little greater than at its edges */
    double depth[3], x[3], y[3];
    cross3(c->right, c->down, depth);
    cross3(c->down, c->corner, x);
    cross3(c->corner, c->right, y);
    const double volume = dot3(c->corner, depth), shift_x = middle_x - (double)layer.left, shift_y = middle_y - (double)layer.top;
    for (int i = 0; i < 3; i++) {
        depth[i] /= volume;
        x[i] = x[i] / volume - shift_x * depth[i];
        y[i] = y[i] / volume - shift_y * depth[i];
    }
    const double focal = 1 / sqrt(dot3(c->right, c->right));
    const double wide = layer.width - middle_x, high = layer.height - middle_y;
    return (PictureData){
        .x_x = (float)x[0],
        .x_y = (float)x[1],
        .x_z = (float)x[2],
        .eye_height = (float)c->position[1],
        .y_x = (float)y[0],
        .y_y = (float)y[1],
        .y_z = (float)y[2],
        .focal = (float)focal,
        .z_x = (float)depth[0],
        .z_y = (float)depth[1],
        .z_z = (float)depth[2],
        .cosine_squared = (float)(focal * focal / (focal * focal + wide * wide + high * high)),
        .left = -(float)(middle_x + 1),
        .right = (float)(layer.width - middle_x),
        .top = -(float)(middle_y + 1),
        .bottom = (float)(layer.height - middle_y),
        .least_depth = (float)GBUFFER_LEAST_DEPTH,
        .error_squared = (float)(edge * edge),
        .short_squared = (float)(16 * tau * tau),
        .long_squared = 32 * 32,
    };
}
