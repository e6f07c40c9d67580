/* SPDX-License-Identifier: MIT
 * From a scene in double precision to the uniform floats of a frame and of its tiles. */
#include "frame/frame.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/triples.h"
#include "frame/lights.h"
#include "frame/skyline.h"
#include "params/methods.h"

static const double pi = 3.14159265358979323846;

camera_rays camera_rays_of(const mgt_camera *camera, uint32_t width, uint32_t height)
{
    camera_rays rays;
    double forward[3], right[3], up[3];
    for (int i = 0; i < 3; i++) {
        rays.position[i] = camera->position[i];
        forward[i] = camera->target[i] - camera->position[i];
    }
    normalize3(forward);
    cross3(forward, camera->up, right);
    normalize3(right);
    cross3(right, forward, up);
    const double pixel = 2 * tan(camera->fov_y_deg * pi / 360) / height;
    for (int i = 0; i < 3; i++) {
        rays.right[i] = right[i] * pixel;
        rays.down[i] = -up[i] * pixel;
        rays.corner[i] = forward[i] + rays.right[i] * (0.5 - 0.5 * width) + rays.down[i] * (0.5 - 0.5 * height);
    }
    return rays;
}

camera_rays mirrored_rays(const camera_rays *rays)
{
    camera_rays m = *rays;
    m.position[1] = -m.position[1];
    m.corner[1] = -m.corner[1];
    m.right[1] = -m.right[1];
    m.down[1] = -m.down[1];
    return m;
}

camera_rays rays_above(const frame *f, const camera_rays *rays)
{
    camera_rays above = f->under ? mirrored_rays(rays) : *rays;
    above.position[1] = fmax(above.position[1], 1e-4);
    return above;
}

/* Elongation above which an ellipse falls back to Riemann sums. Podee et al. §3.6 take "the minor axis multiplied by the number of circular kernels". A single
 * circle is no mixture and Feline chooses the number of its kernels for every ellipse, so these two have no limit. */
static double elongation_limit(const mgt_quality *q)
{
    if (q->elongation_limit != 0)
        return q->elongation_limit;
    return q->kernels == MGT_MIXTURE_1 || q->kernels == MGT_MIXTURE_FELINE ? 1e6 : (double)q->kernels;
}

/* Sets the frequencies between which waves turn from resolved to unresolved: the linear ramp of Podee et al., that of Bruneton et al., or ours, which was
 * chosen by error and flicker on the standard scenes. */
static void set_method(frame *f)
{
    const mgt_quality *q = &f->scene->quality;
    const method_row *row = method_of(q->method);
    const bool podee = row->transition == TRANSITION_PODEE, keep = row->keeps_phases;
    const double width = q->transition_hard ? 0 : q->transition_width != 0 ? q->transition_width : 0.3;
    const bool bruneton = row->transition == TRANSITION_BRUNETON;
    /* Cycles per pixel. */
    const double end = podee ? 0.5 : bruneton ? 1 / (double)BRUNETON_LEAST : (double)RESOLVED_END;
    const double start = podee ? end - width : bruneton ? 1 / (double)BRUNETON_MOST : 0.1;
    FrameData *d = &f->data;
    d->ramp_start = (float)start;
    d->ramp_scale = (float)(podee ? width > 0 ? 1 / width : 1e9 : 1 / (end * end));
    d->sort_start = (float)(start * start);
    d->sort_end = keep ? 1e30f : (float)(end * end);
    d->sort_weights = podee || bruneton ? 0 : 1;
    d->grazing_fall = row->hits > 0 && !f->under ? 2.5f : 0;
    d->hit_rows = (float)(row->hits > 0 ? row->hits : 1);
    d->hit_rows_fall = 0.8f * d->grazing_fall;
    d->refined_fall = 0.3f;
    d->ndf_per_pixel = keep;
    d->ndf_mean = keep && !q->ndf_mean_drop ? 1 : 0;
    d->podee_kernels = (int)q->kernels;
    d->podee_elongation = (float)elongation_limit(q);
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) d->name = (float)q->name;
#include "mangata/method_options.h"
}

/* Sets the uniform numbers for what is seen through the surface, which are the same for all methods. A pixel sees the faces of waves that are turned towards
 * it, through which more of the waves count as resolved. The end of the ramp was chosen by error and flicker on far floors. */
static void set_through(frame *f)
{
    const double start = 0.1, end = 1.6; /* cycles per pixel */
    FrameData *d = &f->through;
    *d = f->data;
    d->ramp_start = (float)start;
    d->ramp_scale = (float)(1 / (end * end));
    d->sort_start = (float)(start * start);
    d->sort_end = (float)(end * end);
    d->sort_weights = 1;
    d->grazing_fall = 0;
    d->ndf_per_pixel = d->ndf_mean = 0;
}

static CameraRays camera_data(const camera_rays *camera)
{
    return (CameraRays){
        .corner_x = (float)camera->corner[0],
        .corner_y = (float)camera->corner[1],
        .corner_z = (float)camera->corner[2],
        .right_x = (float)camera->right[0],
        .right_y = (float)camera->right[1],
        .right_z = (float)camera->right[2],
        .down_x = (float)camera->down[0],
        .down_y = (float)camera->down[1],
        .down_z = (float)camera->down[2],
    };
}

/* Fills `out`, whose rows are x, y and z, with the matrix that takes the vectors of `from` to those of `to`; 0 where the former lie in a plane. */
static void matrix_between(const camera_rays *from, const camera_rays *to, double out[3][3])
{
    const double *a = from->corner, *b = from->right, *c = from->down;
    const double across[3][3] = {{b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]},
                                 {c[1] * a[2] - c[2] * a[1], c[2] * a[0] - c[0] * a[2], c[0] * a[1] - c[1] * a[0]},
                                 {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    const double volume = a[0] * across[0][0] + a[1] * across[0][1] + a[2] * across[0][2];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out[i][k] = volume != 0 ? (to->corner[i] * across[0][k] + to->right[i] * across[1][k] + to->down[i] * across[2][k]) / volume : 0;
}

static camera_rays middle_of(const camera_rays *open, const camera_rays *close)
{
    camera_rays m;
    for (int i = 0; i < 3; i++) {
        m.position[i] = 0.5 * (open->position[i] + close->position[i]);
        m.corner[i] = 0.5 * (open->corner[i] + close->corner[i]);
        m.right[i] = 0.5 * (open->right[i] + close->right[i]);
        m.down[i] = 0.5 * (open->down[i] + close->down[i]);
    }
    return m;
}

static CameraMotion motion_of(const camera_rays *open, const camera_rays *middle, const camera_rays *close)
{
    camera_rays change;
    double travel[3], turn[3][3];
    for (int i = 0; i < 3; i++) {
        travel[i] = close->position[i] - open->position[i];
        change.corner[i] = close->corner[i] - open->corner[i];
        change.right[i] = close->right[i] - open->right[i];
        change.down[i] = close->down[i] - open->down[i];
    }
    matrix_between(middle, &change, turn);
    return (CameraMotion){.travel_x = (float)travel[0],
                          .turn_xx = (float)turn[0][0],
                          .turn_xy = (float)turn[0][1],
                          .turn_xz = (float)turn[0][2],
                          .travel_y = (float)travel[1],
                          .turn_yx = (float)turn[1][0],
                          .turn_yy = (float)turn[1][1],
                          .turn_yz = (float)turn[1][2],
                          .travel_z = (float)travel[2],
                          .turn_zx = (float)turn[2][0],
                          .turn_zy = (float)turn[2][1],
                          .turn_zz = (float)turn[2][2]};
}

void frame_look(frame *f, const camera_rays *open, const camera_rays *close)
{
    f->open = rays_above(f, open);
    f->close = rays_above(f, close);
    FrameData *const data[] = {&f->data, &f->through};
    for (int i = 0; i < 2; i++) {
        data[i]->ends[0] = camera_data(&f->open);
        data[i]->ends[1] = camera_data(&f->close);
        data[i]->lowest_camera = (float)fmin(f->open.position[1], f->close.position[1]);
    }
    f->skyline_entries = skyline_span(&f->open, &f->close, f->scene->image.width, f->scene->image.height, data);
}

double frame_exposure(const mgt_post *post, const sky_state *sky) { return post->exposure_ev + (post->auto_exposure ? sky->exposure_ev : 0); }

void frame_make(const mgt_scene *scene, const sky_state *sky, bool want_color, frame *out)
{
    memset(out, 0, offsetof(frame, foam)); /* frame_foam_of() sets what is read of `foam` */
    out->scene = scene;
    out->under = scene->camera.position[1] < 0;
    FrameData *d = &out->data;
    lights_place(sky->lights, out->under, d);
    d->index_of_refraction = (float)(out->under ? 1 / scene->water.index_of_refraction : scene->water.index_of_refraction);
    d->camera_under = out->under;
    double body[3];
    sky_upwelling_radiance(sky, &scene->water, body);
    d->body_r = (float)body[0];
    d->body_g = (float)body[1];
    d->body_b = (float)body[2];
    d->exposure = (float)exp2(frame_exposure(&scene->post, sky));
    d->tone_map = (int)scene->post.tone_map;
    d->rod_luminance = scene->night_tint ? (float)sky->adaptation : 0;
    d->stars = scene->stars && scene->sky.model == MGT_SKY_ATMOSPHERE;
    d->slope_floor = 1e-9f;
    d->pixel_angle = (float)(2 * tan(scene->camera.fov_y_deg * pi / 360) / scene->image.height);
    d->want_color = want_color;
    d->air_rate = sky_state_has_air(scene) ? (float)sky->air_rate : 0;
    d->sky_black = scene->sky.model == MGT_SKY_BLACK && scene->object_count == 0; /* the surface mirrors objects under a black sky, too */
    set_method(out);
    set_through(out);
    sines_order(&scene->water, out->order);
    frame_foam_of(scene, sky, &out->foam);
    const camera_rays close = camera_rays_of(&scene->camera, scene->image.width, scene->image.height);
    const camera_rays open = scene->camera_moves ? camera_rays_of(&scene->camera_open, scene->image.width, scene->image.height) : close;
    frame_look(out, &open, &close);
}

void frame_by_quality(const frame *f, const mgt_scene *scene, frame *out)
{
    *out = *f;
    out->scene = scene;
    set_method(out);
    set_through(out);
}

/* ---- waves of an interval ---- */

interval frame_part(const frame *f, double from, double to)
{
    const mgt_scene *s = f->scene;
    return (interval){s->time - (1 - 0.5 * (from + to)) * s->shutter, 0.5 * (to - from) * s->shutter};
}

interval frame_shutter(const frame *f) { return f->scene->camera_moves ? (interval){f->scene->time, 0} : frame_part(f, 0, 1); }

bool frame_from_middle(const frame *f) { return f->scene->camera_moves && method_of(f->scene->quality.method)->from_middle; }

wave_meeting frame_meeting(const frame *f, const camera_rays *camera, interval time)
{
    return (wave_meeting){camera->position[0], camera->position[2], time.middle, time.half, f->under ? 0.5 : 0};
}

void wave_set_place(const frame *f, const camera_rays *camera, interval time, bool filter, wave_set *set)
{
    set->view = (ViewData){.rays = camera_data(camera), .camera_height = (float)camera->position[1]};
    sines_place(&f->scene->water, f->order, frame_meeting(f, camera, time), set);
    set->view.filter_waves = filter;
    set->view.scale_x = set->view.scale_y = 1;
    set->has_foam = f->foam.some;
    if (set->has_foam)
        foam_place(&f->foam, camera->position[0], camera->position[2], time.middle, time.half, filter, &set->foam);
}

void wave_set_sweep(const frame *f, const camera_rays *open, const camera_rays *close, double from, double to, wave_set *set)
{
    const camera_rays middle = middle_of(open, close);
    wave_set_place(f, &middle, frame_part(f, from, to), true, set);
    if (!f->scene->camera_moves)
        return;
    set->view.motion = motion_of(open, &middle, close);
    set->view.to_close = (float)((1 - 0.5 * (from + to)) / (to - from));
}

void wave_set_build(const frame *f, const camera_rays *camera, interval time, bool filter, wave_set *set)
{
    wave_set_place(f, camera, time, filter, set);
    if (filter && skyline_may_stand(f, camera))
        skyline_find(f, set);
}
