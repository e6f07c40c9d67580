/* SPDX-License-Identifier: MIT
 * A host's matrices as the rays and depths of pixels. */
#ifndef MANGATA_FRAME_VIEW_RAYS_H
#define MANGATA_FRAME_VIEW_RAYS_H

#include "frame/frame.h"
#include "mangata/gl.h"

/* A view's rays; 1 of their `along` is 1 of clip space's w. */
typedef struct view_rays {
    camera_rays rays;
    double clip_depth[3]; /* clip z of the ray of pixel (0, 0), and its changes per pixel to the right and down, for 1 of w */
    double clip_offset;   /* added to clip z whatever w is */
} view_rays;

/* `matrix` is the view's or its view_open. NULL, or what is wrong with the matrices. */
const char *view_rays_of(const mgt_gl_view *view, const double matrix[16], view_rays *out);

/* A legal camera at the same place, for checks that want one. */
mgt_camera view_camera(const camera_rays *rays, uint32_t width, uint32_t height);

/* Radians that a pixel spans where the view meets the plane of its pixels at right angles: the same for all parts of a view. */
double view_pixel_angle(const camera_rays *rays);

/* A view that has been checked. */
typedef struct checked_view {
    const mgt_gl_view *view;
    view_rays close, open; /* when the shutter closes and opens; the mean surface is at y = 0 */
    mgt_scene scene;       /* with the view's size and camera, at sea level */
} checked_view;

#endif
