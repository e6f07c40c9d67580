/* SPDX-License-Identifier: MIT
 * Evaluates one pixel by the kernels in one lane, which gives the bits of the frame, and keeps intermediate values. */
#include "cpu/kernel_context.h"
#include "cpu/inspect.h"

#include <math.h>
#include <string.h>

#include "frame/atmosphere.h"

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "cpu/lane_access.h"
#include "kernels/glitter/foam_over.k"

typedef struct tile_pixel {
    uint32_t tile_x, tile_y;
    uint32_t column, row; /* place within the tile */
} tile_pixel;

static struct kernel_context sort_tile(const frame *f, const wave_set *set, const float *sky, tile_pixel at, tile_waves *waves, tile_estimate *estimate)
{
    lane_kernels_1.sort(&f->data, set, &set->view, at.tile_x, at.tile_y, waves);
    tile_find_estimates(&lane_kernels_1, &f->data, waves, estimate);
    struct kernel_context cx = context_for(&f->data, waves);
    cx.sky = sky;
    return cx;
}

/* The slopes at one hit. at.row counts rows of hits. */
static SlopeState slopes_of(const struct kernel_context *cx, const tile_estimate *rows, tile_pixel at)
{
    const tile_estimate *estimate = rows + at.row / TILE_HEIGHT;
    const size_t i = at.row % TILE_HEIGHT * TILE_WIDTH + at.column;
    HitEstimate from = {estimate->height[i], estimate->from[i], estimate->search[i], {0, 0}, {estimate->shift_x[i], estimate->shift_z[i]}};
    if (cx->tile->grazing != 0)
        from.slope = (vec2){estimate->slope_x[i], estimate->slope_z[i]};
    return slope_state(cx, pixel_ray_filtered(cx, (float)at.column, (float)at.row).ray, from);
}

/* Fills the position and distance of the first hit when the shutter closes, by Newton's method along the ray in double precision from the pixel's estimate. */
static void find_hit(const frame *f, const struct kernel_context *cx, tile_pixel at, const tile_estimate *estimate, mgt_pixel_info *info)
{
    const camera_rays *c = &f->close;
    const double x = at.tile_x * (double)TILE_WIDTH + at.column, y = at.tile_y * (double)TILE_HEIGHT + at.row;
    double ray[3];
    for (int i = 0; i < 3; i++)
        ray[i] = c->corner[i] + x * c->right[i] + y * c->down[i];
    const uint32_t row = at.row * (uint32_t)cx->tile->hit_rows;
    const double start = (double)estimate[row / TILE_HEIGHT].height[row % TILE_HEIGHT * TILE_WIDTH + at.column];
    const double fall = fmax(-ray[1], (double)crest_fall(cx) * hypot(ray[0], ray[2]));
    double along = cx->tile->skyline != SKYLINE_NONE ? start : fall > 0 ? (c->position[1] - start) / fall : 0;
    for (int step = 0; step < 8 && fall > 0; step++) {
        const double point[2] = {c->position[0] + along * ray[0], c->position[2] + along * ray[2]};
        double gap = c->position[1] + along * ray[1], closing = ray[1];
        sines_lower(&f->scene->water, point, f->scene->time, ray, &gap, &closing);
        const double move = gap / fmin(closing, -0.25 * fall);
        along -= fmin(fmax(move, -0.1 * along), 0.1 * along);
    }
    for (int i = 0; i < 3; i++)
        info->position[i] = c->position[i] + along * ray[i] + (i == 1 ? f->scene->water.level : 0);
    info->distance = along * sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
}

/* J S Jᵀ for a covariance S given as xx, xz, zz. */
static void map_covariance(const Mirror *m, const double s[3], double out[3])
{
    const double ex = (double)m->j.ex, ez = (double)m->j.ez, fx = (double)m->j.fx, fz = (double)m->j.fz;
    out[0] = ex * ex * s[0] + 2 * ex * ez * s[1] + ez * ez * s[2];
    out[1] = ex * fx * s[0] + (ex * fz + ez * fx) * s[1] + ez * fz * s[2];
    out[2] = fx * fx * s[0] + 2 * fx * fz * s[1] + fz * fz * s[2];
}

static void describe_mirror(const struct kernel_context *cx, SlopeState s, mgt_pixel_info *info)
{
    const Mirror m = light_map(cx, s);
    const LightPath path = light_path(cx, m, s);
    const double both[3] = {info->unresolved[0] + info->bend[0] + (double)cx->frame->slope_floor, info->unresolved[1] + info->bend[1],
                            info->unresolved[2] + info->bend[2] + (double)cx->frame->slope_floor};
    info->mirror_slope[0] = (double)s.mirror.slope.x;
    info->mirror_slope[1] = (double)s.mirror.slope.y;
    info->path[0][0] = (double)path.open.x;
    info->path[0][1] = (double)path.open.y;
    info->path[1][0] = (double)path.close.x;
    info->path[1][1] = (double)path.close.y;
    info->light_radius = (double)light_radius(cx, 0);
    map_covariance(&m, both, info->covariance);
}

/* Adds one of the pixel's `hits` hits to the means. Returns whether it is water. */
static bool add_hit(const struct kernel_context *cx, tile_pixel at, SlopeState s, uint32_t hits, mgt_pixel_info *info)
{
    const PixelRay ray = pixel_ray_filtered(cx, (float)at.column, (float)at.row);
    const float part = 1.0f / (float)hits;
    /* The light of deep water is known for whole tiles alone, so a camera under water gets black. */
    const bool dark = ray.water > 0 || cx->frame->camera_under != 0;
    const vec3 sky = dark ? (vec3){0, 0, 0} : background(cx, ray.sky_ray);
    const PixelResult result = ray.water > 0 ? over_state(cx, glitter_result(cx, ray, s), ray, s) : (PixelResult){sky, 0, 0, 0};
    info->water = (double)((float)info->water + result.water * part);
    info->coverage = (double)((float)info->coverage + result.coverage * part);
    const float color[] = {result.color.x, result.color.y, result.color.z};
    for (int c = 0; c < 3; c++)
        info->radiance[c] = (double)((float)info->radiance[c] + color[c] * part);
    return ray.water > 0;
}

/* Adds the share `part` of the means of one part of the shutter. */
static void add_part(const mgt_pixel_info *of_part, float part, mgt_pixel_info *info)
{
    info->water = (double)((float)info->water + part * (float)of_part->water);
    info->coverage = (double)((float)info->coverage + part * (float)of_part->coverage);
    for (int c = 0; c < 3; c++)
        info->radiance[c] = (double)((float)info->radiance[c] + part * (float)of_part->radiance[c]);
}

void inspect_pixel(const frame *f, const frame_waves *waves, const float *sky, uint32_t x, uint32_t y, tile_scratch *scratch, mgt_pixel_info *info)
{
    const tile_pixel pixel = {x / TILE_WIDTH, y / TILE_HEIGHT, x % TILE_WIDTH, y % TILE_HEIGHT};
    const int parts = f->scene->camera_moves ? CAMERA_PARTS : 1;
    struct kernel_context cx;
    *info = (mgt_pixel_info){.struct_size = sizeof *info};
    bool water = false;
    SlopeState state;
    for (int part = 0; part < parts; part++) {
        const wave_set *set = f->scene->camera_moves ? &waves->parts[part] : &waves->shutter;
        cx = sort_tile(f, set, sky, pixel, &scratch->close, scratch->close_estimate);
        const uint32_t hits = (uint32_t)cx.tile->hit_rows;
        mgt_pixel_info of_part = {0};
        for (uint32_t hit = 0; hit < hits; hit++) {
            const tile_pixel at = {pixel.tile_x, pixel.tile_y, pixel.column, pixel.row * hits + hit};
            state = slopes_of(&cx, scratch->close_estimate, at);
            water = add_hit(&cx, at, state, hits, &of_part);
        }
        add_part(&of_part, 1.0f / (float)parts, info);
    }
    if (!water)
        return;
    info->slope_open[0] = (double)state.open.x;
    info->slope_open[1] = (double)state.open.y;
    info->slope_close[0] = (double)state.close.x;
    info->slope_close[1] = (double)state.close.y;
    info->unresolved[0] = (double)state.variance_xx;
    info->unresolved[1] = (double)state.variance_xz;
    info->unresolved[2] = (double)state.variance_zz;
    info->bend[0] = (double)state.bend_xx;
    info->bend[1] = (double)state.bend_xz;
    info->bend[2] = (double)state.bend_zz;
    info->resolved = (uint32_t)cx.tile->resolved_count;
    info->mixed = (uint32_t)cx.tile->mixed_count;
    info->filtered = (uint32_t)f->scene->water.wave_count - info->resolved - info->mixed;
    find_hit(f, &cx, pixel, scratch->close_estimate, info);
    if (cx.tile->light_reach != 0)
        describe_mirror(&cx, state, info);
}
