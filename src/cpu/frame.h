/* SPDX-License-Identifier: MIT
 * From a scene in double precision to the uniform floats of a frame and of its tiles. */
#ifndef MANGATA_CPU_FRAME_H
#define MANGATA_CPU_FRAME_H

#include "cpu/lanes.h"
#include "precompute/atmosphere.h"

/* A camera as rays: the ray of pixel (x, y) is corner + x·right + y·down for pixel centres at whole numbers. */
typedef struct camera_rays {
    double position[3];
    double corner[3], right[3], down[3];
} camera_rays;

typedef struct frame {
    FrameData data;
    const mgt_scene *scene;
    camera_rays close, open;       /* cameras when the shutter closes and opens */
    double ramp_start, ramp_end;   /* cycles per pixel below which a wave is resolved and above which it is not */
    bool podee;                    /* resolved and unresolved as published */
    bool keep_filtered;            /* unresolved waves stay in the mixed list: their phase matters (podee-pixel) */
    float lesser_variance[MGT_MAX_WAVES]; /* metres², of the heights of a wave and of all with smaller amplitudes */
} frame;

camera_rays camera_rays_of(const mgt_camera *camera, uint32_t width, uint32_t height);

/* `sky` must have been built from the scene; the scene must outlive the frame. */
frame frame_of(const mgt_scene *scene, const sky_state *sky, bool want_color);

/* The middle of an interval of time and half of its length. */
typedef struct interval {
    double middle, half;
} interval;

/* The waves over an interval as a camera meets them: what is the same for every tile. */
typedef struct wave_set {
    size_t count;
    double height_deviation; /* metres, RMS of the surface */
    double slope_deviation;  /* RMS of its slope */
    WaveData data[MGT_MAX_WAVES]; /* phase left open */
    double turns_x[MGT_MAX_WAVES], turns_z[MGT_MAX_WAVES];
    double phase[MGT_MAX_WAVES]; /* turns under the camera at the interval's middle, reduced */
} wave_set;

void wave_set_build(const mgt_water *water, const camera_rays *camera, interval time, wave_set *set);

/* Sorts the waves for the tile (tile_x, tile_y) of the lattice. `filter` false: every wave is resolved (point samples). */
void tile_build(const frame *f, const camera_rays *camera, const wave_set *set, bool filter, uint32_t tile_x, uint32_t tile_y, tile_waves *out);

/* Whether any pixel of the tile can see water. */
bool tile_sees_water(const tile_waves *tile);

#endif
