/* SPDX-License-Identifier: MIT
 * The waves of a frame at the instants and over the intervals that its methods ask for. */
#include "frame/frame_waves.h"

#include "base/hash.h"
#include "frame/skyline.h"

void frame_waves_build(const frame *f, frame_waves *waves)
{
    const mgt_scene *s = f->scene;
    const interval now = {s->time, 0};
    wave_set_build(f, &f->close, now, false, &waves->samples);
    wave_set_build(f, &f->close, frame_shutter(f), true, &waves->shutter);
    wave_set_place(f, &f->close, now, true, &waves->now);
    skyline_copy(&waves->shutter, &waves->now);
    if (!s->camera_moves)
        return;
    wave_set_build(f, &f->open, (interval){s->time - s->shutter, 0}, true, &waves->open);
    for (int i = 0; i < CAMERA_PARTS; i++) {
        const double from = (double)i / CAMERA_PARTS, to = (i + 1.0) / CAMERA_PARTS;
        const camera_rays open = camera_at(f, from), close = camera_at(f, to);
        wave_set_sweep(f, &open, &close, from, to, &waves->parts[i]);
        skyline_copy(&waves->shutter, &waves->parts[i]);
    }
}

double shutter_fraction(const mgt_quality *q, uint64_t m)
{
    return q->time_samples == 1 ? 1 : ((double)m + (double)hash_unit(hash_of(q->seed ^ hash_of(~m)))) / q->time_samples;
}

camera_rays camera_at(const frame *f, double share)
{
    const mgt_scene *s = f->scene;
    if (!s->camera_moves)
        return f->close;
    mgt_camera camera = s->camera;
    for (int i = 0; i < 3; i++) {
        camera.position[i] = s->camera_open.position[i] + share * (s->camera.position[i] - s->camera_open.position[i]);
        camera.target[i] = s->camera_open.target[i] + share * (s->camera.target[i] - s->camera_open.target[i]);
        camera.up[i] = s->camera_open.up[i] + share * (s->camera.up[i] - s->camera_open.up[i]);
    }
    camera.fov_y_deg = s->camera_open.fov_y_deg + share * (s->camera.fov_y_deg - s->camera_open.fov_y_deg);
    const camera_rays rays = camera_rays_of(&camera, s->image.width, s->image.height);
    return rays_above(f, &rays);
}
