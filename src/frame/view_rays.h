/* SPDX-License-Identifier: MIT
 * A host's matrices as the rays and depths of pixels. */
#ifndef MANGATA_FRAME_VIEW_RAYS_H
#define MANGATA_FRAME_VIEW_RAYS_H

#include "frame/frame.h"
#include "mangata/gl.h"

/* A view's rays. A point at position + d · ray has w = d in clip space. */
typedef struct view_rays {
    camera_rays rays;
    double clip_depth[3]; /* clip z for w = 1 on the ray of pixel (0, 0), and its changes per pixel to the right and down; without clip_offset */
    double clip_offset;   /* constant that is added to clip z for every w */
} view_rays;

/* Fills `out` from the view's projection and `matrix`, its world-to-eye matrix when the shutter closes or opens. Returns NULL, or a text that says what is
 * wrong with the matrices. */
const char *view_rays_of(const mgt_gl_view *view, const double matrix[16], view_rays *out);

/* A valid camera at the same place that looks the same way, for checks of scenes. */
mgt_camera view_camera(const camera_rays *rays, uint32_t width, uint32_t height);

/* Angle of a pixel where the view direction is perpendicular to the image plane, radians. It is the same for all parts of a split view. */
double view_pixel_angle(const camera_rays *rays);

/* A view that has been checked. */
typedef struct checked_view {
    const mgt_gl_view *view;
    view_rays close, open; /* when the shutter closes and opens; the mean surface is at y = 0 */
    mgt_scene scene;       /* with the view's size and camera, at sea level */
} checked_view;

#endif
