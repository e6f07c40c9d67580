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
    FrameData data;    /* for the reflections on the surface */
    FrameData through; /* for what is seen through the surface, which has another limit between resolved and unresolved waves; for scenes with objects */
    const mgt_scene *scene;
    camera_rays close, open;       /* cameras when the shutter closes and opens; position[1] > 0, for which a camera under water is mirrored, see `under` */
    bool under;                    /* the camera is under water: cameras, lights and waves are mirrored at the mean surface */
    uint16_t order[MGT_MAX_WAVES]; /* indices of the scene's waves by falling amplitude */
    int skyline_entries;           /* entries of a skyline of this frame; 0: the picture does not show the horizon */
    frame_foam foam;
} frame;

camera_rays camera_rays_of(const mgt_camera *camera, uint32_t width, uint32_t height);

/* Rays mirrored at the mean surface y = 0. */
camera_rays mirrored_rays(const camera_rays *rays);

/* Rays of a camera above the mean surface, as frame.close has them: mirrored if f->under, and raised to a height of at least 0.1 mm. */
camera_rays rays_above(const frame *f, const camera_rays *rays);

/* Sets the frame's cameras at both ends of the shutter. */
void frame_look(frame *f, const camera_rays *open, const camera_rays *close);

/* Stops that radiance is displayed with: the picture is radiance · 2^stops before the tone map. */
double frame_exposure(const mgt_post *post, const sky_state *sky);

/* Prepares a frame, which is too large for the stack of a program's thread. `sky` must have been built from the scene, and the scene must outlive the frame. */
void frame_make(const mgt_scene *scene, const sky_state *sky, bool want_color, frame *out);

/* The frame of a scene that differs from f->scene by its quality alone. */
void frame_by_quality(const frame *f, const mgt_scene *scene, frame *out);

/* The middle of an interval of time and half of its length. */
typedef struct interval {
    double middle, half;
} interval;

/* The interval during which the shutter is open. For methods that see both ends of it, if the camera moves: the instant t, because the shutter's opening then
 * has a camera of its own. */
interval frame_shutter(const frame *f);

/* The interval during which the shutter is open, between two fractions of it. */
interval frame_part(const frame *f, double from, double to);

/* Parts of the shutter in each of which pixels see a moving camera from the middle of its way. */
enum { CAMERA_PARTS = 2 };

/* Whether the frame's camera moves and its method sees it from the middle of its way, not from both ends. */
bool frame_from_middle(const frame *f);

/* Where and when a camera meets the frame's waves. For a camera under water the waves are turned upside down. */
wave_meeting frame_meeting(const frame *f, const camera_rays *camera, interval time);

/* Fills a set with the frame's waves relative to a camera, without a skyline. `filter` false: every wave is resolved, as point samples see them. */
void wave_set_place(const frame *f, const camera_rays *camera, interval time, bool filter, wave_set *set);

/* Fills a set as wave_set_place() does, with the filtered waves of the part of the shutter between its fractions `from` and `to`. The camera stands in the
 * middle of its way from `open` to `close`. Its place and its rays change evenly. */
void wave_set_sweep(const frame *f, const camera_rays *open, const camera_rays *close, double from, double to, wave_set *set);

/* Fills a set as wave_set_place() does, with the skyline if `filter` is true. */
void wave_set_build(const frame *f, const camera_rays *camera, interval time, bool filter, wave_set *set);

#endif
