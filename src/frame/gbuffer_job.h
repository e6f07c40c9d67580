/* SPDX-License-Identifier: MIT
 * The rasterised layers of objects: what they depend on, and their shape. */
#ifndef MANGATA_FRAME_GBUFFER_JOB_H
#define MANGATA_FRAME_GBUFFER_JOB_H

#include "frame/frame.h"

/*
 * A layer: the first object seen through the centre of every pixel. Pixel (x, y) of the image is element (top + y) · width + left + x. All layers of a picture
 * have the same shape. The virtual image of the point that is seen lies at camera + depth · ray, where ray = corner + x · right + y · down of camera_rays.
 * The ray is not normalised: depth counts along the view direction. true_point() of kernels/refraction/refract_point.k gives the true position of a virtual
 * image. Normal, material and texture coordinates follow from the triangle.
 */
typedef struct gbuffer {
    uint32_t width, height; /* pixels, guard band included; the width is a multiple of 16 */
    uint32_t left, top;     /* width of the guard band at these sides, pixels */
    float *depth;           /* metres along the view direction; +inf: nothing is seen */
    int32_t *triangle;      /* index into the world's triangles; −1: nothing is seen */
} gbuffer;

/* What the layers depend on, beside the world. */
typedef struct gbuffer_job {
    camera_rays camera;     /* position[1] is its height above the mean surface; 0 counts as above */
    uint32_t width, height; /* of the image, pixels */
    double index;           /* index of refraction of the water relative to air */
    int map;                /* map from true positions beyond the surface to virtual images: MAP_… of constants.h */
    double error;           /* greatest error of a triangle that the map bends, pixels; 0: 0.1 */
    double trough;          /* depth beyond the mean surface to which the front layer shows objects, metres: waves may uncover them down to there */
    double crest;           /* height on the camera's side up to which the refracted layer shows objects, metres: waves may cover them up to there */
    bool mirrored;          /* the layer is for mirrored rays: only the refracted layer, without the insides of closed objects that the surface cuts */
} gbuffer_job;

/* Near plane: triangles are clipped at this distance from the camera, metres along the view direction. */
#define GBUFFER_LEAST_DEPTH 1e-3

/* The shape of a job's layers; `depth` and `triangle` are NULL. */
gbuffer gbuffer_shape(const gbuffer_job *job);

/* Uniform numbers of a map. */
RefractData refract_data_of(double camera_height, double index, int map);

/* Uniform numbers of a picture. */
PictureData gbuffer_picture(const gbuffer_job *job);

#endif
