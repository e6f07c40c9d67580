/* SPDX-License-Identifier: MIT
 * What a picture of the objects is drawn from, and its shape. */
#ifndef MANGATA_FRAME_GBUFFER_JOB_H
#define MANGATA_FRAME_GBUFFER_JOB_H

#include "frame/frame.h"

/*
 * What is seen first through every pixel's centre. Pixel (x, y) of the image is element (top + y) · width + left + x; both layers of a picture
 * have the same shape. The virtual image of what is seen stands at camera + depth · ray, where ray = corner + x · right + y · down of camera_rays
 * (not normalised: depth counts along the view). Its true position is true_point() of kernels/refraction/refract_point.k, from that alone; the triangle
 * gives the rest.
 */
typedef struct gbuffer {
    uint32_t width, height; /* guard band included; the width is a multiple of 16 */
    uint32_t left, top;
    float *depth;      /* metres along the view; +inf: nothing */
    int32_t *triangle; /* of the world; −1: nothing */
} gbuffer;

/* What the layers depend on, beside the world. */
typedef struct gbuffer_job {
    camera_rays camera;     /* position[1] is its height above the mean surface; 0 counts as above */
    uint32_t width, height; /* of the image */
    double index;           /* of refraction of the water in air */
    int map;                /* where far triangles are drawn: MAP_… of constants.h */
    double error;           /* pixels that a triangle bent by the map may be off by; 0: 0.1 */
    double trough;          /* metres beyond the mean surface that the front layer goes on for: as far as the waves may uncover it */
    double crest;           /* metres over the mean surface that the refracted layer goes on for on the camera's side: as far as the waves may reach */
    bool mirrored;          /* the refracted layer alone, without the insides of closed objects that the surface cuts open: of a camera that mirrors see */
} gbuffer_job;

/* Triangles are cut off nearer to the camera than this, metres along the view. */
#define GBUFFER_LEAST_DEPTH 1e-3

/* A layer's shape without its memory, and the uniform numbers of the map and of the picture. */
gbuffer gbuffer_shape(const gbuffer_job *job);
RefractData refract_data_of(double camera_height, double index, int map);
PictureData gbuffer_picture(const gbuffer_job *job);

#endif
