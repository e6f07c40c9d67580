/* SPDX-License-Identifier: MIT
 * From a scene in double precision to the uniform floats of a frame and of its tiles. */
#ifndef MANGATA_FRAME_FRAME_H
#define MANGATA_FRAME_FRAME_H

#include "frame/atmosphere.h"
#include "frame/tiles.h"

/* A camera as rays: the ray of pixel (x, y) is corner + x·right + y·down for pixel centres at whole numbers. */
typedef struct camera_rays {
    double position[3];
    double corner[3], right[3], down[3];
} camera_rays;

typedef struct frame {
    FrameData data;    /* of the methods that draw what the surface mirrors */
    FrameData through; /* in scenes with objects, of what is seen through the surface: other waves count as resolved there */
    const mgt_scene *scene;
    camera_rays close, open;       /* cameras when the shutter closes and opens, on the upper side of what is called the water; see `under` */
    bool under;                    /* the camera is under water: cameras, light and waves are mirrored at the mean surface */
    uint16_t order[MGT_MAX_WAVES]; /* of the scene's waves by falling amplitude */
    int skyline_entries;           /* 0: the picture does not show the horizon */
    frame_foam foam;
} frame;

camera_rays camera_rays_of(const mgt_camera *camera, uint32_t width, uint32_t height);

/* The same, mirrored at the mean surface y = 0. */
camera_rays mirrored_rays(const camera_rays *rays);

/* A camera as a frame takes it: above the surface, if need be mirrored or moved off it. */
camera_rays rays_above(const frame *f, const camera_rays *rays);

/* Takes the rays of both ends of the shutter. */
void frame_look(frame *f, const camera_rays *open, const camera_rays *close);

/* `sky` must have been built from the scene; the scene must outlive the frame. */
frame frame_of(const mgt_scene *scene, const sky_state *sky, bool want_color);

/* The same frame of another scene, which differs by its quality alone. */
frame frame_by_quality(const frame *f, const mgt_scene *scene);

/* The middle of an interval of time and half of its length. */
typedef struct interval {
    double middle, half;
} interval;

/* While the shutter is open, or the instant t where the camera moves: its other end is a camera of its own then. */
interval frame_shutter(const frame *f);

/* The frame's waves as a camera meets them: those of a camera under water are turned over. */
wave_meeting frame_meeting(const frame *f, const camera_rays *camera, interval time);

/* Places the frame's waves before a camera, but for the skyline. `filter` false: every wave is resolved (point samples). */
void wave_set_place(const frame *f, const camera_rays *camera, interval time, bool filter, wave_set *set);

/* The same with the skyline of filtered waves. */
void wave_set_build(const frame *f, const camera_rays *camera, interval time, bool filter, wave_set *set);

#endif
