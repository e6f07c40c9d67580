/* SPDX-License-Identifier: MIT
 *
 * The path-traced reference around the lanes: it prepares frames, places samples, and shades a sample's first hit.
 */
#include "reference/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/exact_sum.h"
#include "reference/equations.h"
#include "reference/light_cells.h"
#include "reference/reference_frame.h"

/* ---- preparing a frame ---- */

static reference_view relative_view(const mgt_camera *camera, const mgt_camera *anchor)
{
    reference_view view;
    for (int i = 0; i < 3; i++) {
        const double offset = i == 1 ? 0 : anchor->position[i];
        view.position[i] = camera->position[i] - offset;
        view.target[i] = camera->target[i] - offset;
        view.up[i] = camera->up[i];
    }
    view.fov_half_turns = camera->fov_y_deg / 360;
    return view;
}

static void set_sample_range(reference_frame *frame, const mgt_quality *quality)
{
    const uint64_t total = (uint64_t)quality->spatial_samples * quality->spatial_samples * quality->time_samples;
    frame->sample_first = quality->sample_first < total ? quality->sample_first : total;
    const uint64_t remaining = total - frame->sample_first;
    frame->sample_count = quality->sample_count && quality->sample_count < remaining ? quality->sample_count : remaining;
    frame->most = EXACT_SUM_MOST / (double)total;
}

typedef struct lane_build {
    reference_trace *trace, *search, *bend;
    reference_judge *judge;
} lane_build;

/* The functions for an instruction set, all NULL if this processor lacks it. */
static lane_build pick_build(mgt_isa isa)
{
    const lane_build scalar = {reference_trace_1, reference_search_1, reference_bend_1, reference_judge_1}, missing = {0};
#if defined(__x86_64__)
    const bool avx512 =
        __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (isa == MGT_ISA_AVX512 || (isa == MGT_ISA_AUTO && avx512))
        return avx512 ? (lane_build){reference_trace_8, reference_search_8, reference_bend_8, reference_judge_8} : missing;
    if (isa == MGT_ISA_AVX2 || (isa == MGT_ISA_AUTO && avx2))
        return avx2 ? (lane_build){reference_trace_4, reference_search_4, reference_bend_4, reference_judge_4} : missing;
#else
    if (isa == MGT_ISA_AVX512 || isa == MGT_ISA_AVX2)
        return missing;
#endif
    return scalar;
}

/* Prepares the frame's foam. Returns false when out of memory. */
static bool set_foam(reference_frame *frame, const mgt_scene *scene)
{
    if (!foam_draws(scene))
        return true;
    frame->foam = malloc(sizeof *frame->foam);
    if (frame->foam && !foam_sea_of(scene, frame->foam)) {
        free(frame->foam);
        frame->foam = NULL;
        return true;
    }
    for (int i = 0; i < reference_lights_count(frame->lights); i++)
        reference_lights_toward(frame->lights, i, frame->foam_toward[i]);
    return frame->foam != NULL;
}

mgt_status reference_frame_create(reference_frame **result, const mgt_scene *scene, const reference_sky *sky, const reference_options *options)
{
    *result = NULL;
    const reference_options defaults = {0};
    if (!options)
        options = &defaults;
    const lane_build build = pick_build(options->isa);
    if (!build.trace)
        return MGT_ERROR_UNAVAILABLE;
    const size_t count = scene->water.wave_count;
    if (count > (SIZE_MAX - sizeof(reference_frame)) / sizeof(reference_wave) || count > UINT32_MAX)
        return MGT_ERROR_MEMORY;
    const size_t bytes = (sizeof(reference_frame) + count * sizeof(reference_wave) + 63) / 64 * 64;
    reference_frame *frame = aligned_alloc(64, bytes);
    if (frame)
        memset(frame, 0, bytes);
    if (!frame || !(frame->lights = reference_lights_of(scene))) {
        free(frame);
        return MGT_ERROR_MEMORY;
    }
    frame->scene = *scene;
    frame->scene.water.waves = NULL;
    if (sky)
        frame->sky = *sky;
    frame->trace = build.trace;
    frame->search = build.search;
    frame->bend = build.bend;
    frame->judge = build.judge;
    frame->bound_deviations = options->bound_deviations > 0 ? options->bound_deviations : REFERENCE_BOUND_DEVIATIONS;
    frame->view = relative_view(&scene->camera, &scene->camera);
    frame->view_open = scene->camera_moves ? relative_view(&scene->camera_open, &scene->camera) : frame->view;
    frame->view_scale_x = (double)scene->image.width / scene->image.height;
    frame->wave_count = (uint32_t)count;
    reference_waves_of(scene, frame->waves);
    frame->height_bound = reference_waves_bound(frame->waves, count, frame->bound_deviations);
    reference_columns_of(frame->waves, frame->wave_count, &frame->columns);
    frame->level_count = reference_levels_of(frame->waves, frame->wave_count, frame->bound_deviations, frame->levels);
    frame->choppiness = frame->wave_count > 0 ? (double)scene->water.choppiness : 0;
    reference_columns_shift(frame->waves, frame->wave_count, frame->choppiness, &frame->columns);
    choppy_levels_of(frame->waves, frame->choppiness, frame->bound_deviations, frame->levels, frame->level_count, frame->choppy);
    set_sample_range(frame, &scene->quality);
    if (!set_foam(frame, scene)) {
        reference_frame_destroy(frame);
        return MGT_ERROR_MEMORY;
    }
    frame->light_cells = light_cells_serve(frame);
    *result = frame;
    return MGT_OK;
}

void reference_frame_destroy(reference_frame *frame)
{
    if (frame) {
        free(frame->lights);
        free(frame->foam);
    }
    free(frame);
}

void reference_frame_mirror(reference_frame *frame)
{
    reference_waves_mirror(frame->waves, frame->wave_count);
    reference_columns_of(frame->waves, frame->wave_count, &frame->columns);
    frame->choppiness = -frame->choppiness;
    reference_columns_shift(frame->waves, frame->wave_count, frame->choppiness, &frame->columns);
}

/* ---- samples ---- */

/* The finaliser of SplitMix64. */
static uint64_t mix_bits(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

static const uint64_t golden_step = 0x9e3779b97f4a7c15u;

static uint64_t pixel_key(uint64_t seed, uint32_t x, uint32_t y)
{
    return mix_bits(mix_bits(seed + golden_step) ^ mix_bits(((uint64_t)y << 32 | x) + golden_step));
}

/* Three numbers in (0, 1) from 21 bits each. */
static void jitter(uint64_t key, uint64_t index, double offset[3])
{
    const uint64_t bits = mix_bits(key + (index + 1) * golden_step);
    for (int i = 0; i < 3; i++)
        offset[i] = ((double)(bits >> (21 * i) & 0x1fffff) + 0.5) * 0x1p-21;
}

static void place_sample(const reference_frame *frame, uint32_t x, uint32_t y, uint64_t key, uint64_t index, reference_batch *batch, uint32_t slot)
{
    const uint64_t n = frame->scene.quality.spatial_samples, m = frame->scene.quality.time_samples;
    const uint64_t cell = index % (n * n), instant = (index / (n * n) + cell) % m;
    double offset[3];
    jitter(key, index, offset);
    batch->pixel_x[slot] = x + ((double)(cell % n) + offset[0]) / (double)n;
    batch->pixel_y[slot] = y + ((double)(cell / n) + offset[1]) / (double)n;
    batch->time_offset[slot] = -frame->scene.shutter * ((double)instant + offset[2]) / (double)m;
}

/* ---- what a sample sees ---- */

typedef enum seen_lights { LIGHTS_NONE, LIGHTS_RISEN, LIGHTS_ALL } seen_lights;

/* Adds the disks that are seen directly. What stands above the horizon has all of a disk's light; the water hides the rest. */
static void add_disks_above(const reference_frame *frame, const double direction[3], double rgb[3])
{
    double above[REFERENCE_LIGHTS][3];
    for (int i = 0; i < REFERENCE_LIGHTS; i++)
        for (int c = 0; c < 3; c++)
            above[i][c] = frame->sky.disks[i][c] / fmax(1 - frame->sky.hidden[i], 0.02);
    reference_lights_add(frame->lights, above, direction, false, rgb);
}

/* Radiance of sky and lights in a direction. LIGHTS_RISEN: only lights whose centre is above the horizon. A direction below the horizon gets the sky of the
 * horizon. */
static void radiance_of_sky(const reference_frame *frame, const double direction[3], seen_lights lights, double rgb[3])
{
    const reference_sky *sky = &frame->sky;
    rgb[0] = rgb[1] = rgb[2] = 0;
    if (sky->lookup) {
        double d[3] = {direction[0], direction[1], direction[2]};
        if (d[1] < 0) {
            const double length = sqrt(d[0] * d[0] + d[2] * d[2]);
            d[0] = length > 0 ? d[0] / length : 1;
            d[1] = 0;
            d[2] = length > 0 ? d[2] / length : 0;
        }
        sky->lookup(sky->user, d, rgb);
    }
    if (lights == LIGHTS_RISEN)
        reference_lights_add(frame->lights, sky->disks, direction, true, rgb);
    if (lights == LIGHTS_ALL)
        add_disks_above(frame, direction, rgb);
}

/* Returns whether a sample's mirrored ray meets a light. `rgb`, if not NULL, becomes the sample's radiance. */
static bool shade_hit(const reference_frame *frame, const double view[3], double slope_x, double slope_z, double rgb[3])
{
    const double length = sqrt(slope_x * slope_x + 1 + slope_z * slope_z);
    const double normal[3] = {-slope_x / length, 1 / length, -slope_z / length};
    const double cosine = -(view[0] * normal[0] + view[1] * normal[1] + view[2] * normal[2]);
    double mirrored[3];
    for (int i = 0; i < 3; i++)
        mirrored[i] = view[i] + 2 * cosine * normal[i];
    if (rgb) {
        const double reflectance = fresnel_dielectric(cosine, frame->scene.water.index_of_refraction);
        radiance_of_sky(frame, mirrored, frame->light_cells ? LIGHTS_NONE : LIGHTS_RISEN, rgb);
        for (int i = 0; i < 3; i++)
            rgb[i] = reflectance * rgb[i] + (1 - reflectance) * frame->sky.body_radiance[i];
    }
    return reference_lights_met(frame->lights, mirrored);
}

_Static_assert((int)REFERENCE_SUM_WORDS == 2 * EXACT_COUNT, "two words a sum");

/* Sums of a pixel, the same in whatever order and parts samples are added. */
typedef struct pixel_sums {
    uint64_t hits, covered;
    exact_sum foam, hidden; /* area of foam, and coverage that foam hides */
    exact_sum rgb[3];
} pixel_sums;

/* Blends foam over the water of a hit. Returns the fraction that foam covers. */
static double cover_with_foam(const reference_frame *frame, const reference_batch *batch, uint32_t i, double rgb[3])
{
    const double *eye = frame->scene.camera.position;
    const foam_point foam = reference_foam_at(frame->foam, batch->rest_x[i] + eye[0], batch->rest_z[i] + eye[2], frame->scene.time + batch->time_offset[i]);
    const double x = batch->slope_x[i], z = batch->slope_z[i];
    for (int c = 0; c < 3; c++) {
        double lit = frame->sky.foam_sky[c];
        for (int l = 0; l < reference_lights_count(frame->lights); l++) {
            const double *toward = frame->foam_toward[l];
            lit += frame->sky.foam_beams[l][c] * fmax(toward[1] - x * toward[0] - z * toward[2], 0) / sqrt(1 + x * x + z * z);
        }
        rgb[c] = (1 - foam.share) * rgb[c] + foam.white * lit;
    }
    return foam.share;
}

static void look_through_air(const reference_frame *frame, const double view[3], double distance, double rgb[3])
{
    double leaves[3], light[3];
    frame->sky.air(frame->sky.user, view, distance, leaves, light);
    for (int c = 0; c < 3; c++)
        rgb[c] = leaves[c] * rgb[c] + light[c];
}

static void add_stars(const reference_frame *frame, const reference_batch *batch, uint32_t i, const double view[3], double rgb[3])
{
    const double pixel = 2 * tan(frame->scene.camera.fov_y_deg * 3.14159265358979323846 / 360) / frame->scene.image.height;
    const double x = (batch->pixel_x[i] - 0.5 * frame->scene.image.width) * pixel, y = (batch->pixel_y[i] - 0.5 * frame->scene.image.height) * pixel;
    const double direction[3] = {view[0], fmax(view[1], 0), view[2]};
    double stars[3];
    frame->sky.stars(frame->sky.user, direction, pixel * pow(1 + x * x + y * y, -0.75), stars);
    for (int c = 0; c < 3; c++)
        rgb[c] += stars[c];
}

static void add_sample(const reference_frame *frame, const reference_batch *batch, uint32_t i, bool with_color, pixel_sums *sums)
{
    const double view[3] = {batch->direction_x[i], batch->direction_y[i], batch->direction_z[i]};
    double rgb[3] = {0};
    if (!(batch->distance[i] < HUGE_VAL)) {
        if (with_color)
            radiance_of_sky(frame, view, LIGHTS_ALL, rgb);
        if (with_color && frame->sky.stars)
            add_stars(frame, batch, i, view, rgb);
    } else if (batch->distance[i] > 0) {
        sums->hits++;
        const bool covered = shade_hit(frame, view, batch->slope_x[i], batch->slope_z[i], with_color ? rgb : NULL);
        sums->covered += covered;
        if (frame->foam) {
            const double share = cover_with_foam(frame, batch, i, rgb);
            const exact_sum hidden = exact_term(share, frame->most);
            sums->foam += hidden;
            sums->hidden += covered ? hidden : 0;
        }
        if (frame->sky.air && with_color)
            look_through_air(frame, view, batch->distance[i], rgb);
    } else { /* the camera is under a crest and sees nothing but water */
        sums->hits++;
        memcpy(rgb, frame->sky.body_radiance, sizeof rgb);
    }
    for (int c = 0; c < 3; c++)
        sums->rgb[c] += exact_term(rgb[c], frame->most);
}

static void add_pixel(uint64_t words[REFERENCE_SUM_WORDS], const pixel_sums *sums)
{
    for (size_t c = 0; c < 3; c++)
        exact_add(words + 2 * (EXACT_RED + c), sums->rgb[c]);
    exact_add(words + 2 * EXACT_COVERAGE, exact_count(sums->covered) - sums->hidden);
    exact_add(words + 2 * EXACT_WATER, exact_count(sums->hits));
    exact_add(words + 2 * EXACT_FOAM, sums->foam);
}

static void store_pixel(const reference_result *result, size_t at, const uint64_t words[REFERENCE_SUM_WORDS], uint64_t count)
{
    const double n = count ? (double)count : 1;
    if (result->coverage)
        result->coverage[at] = (float)exact_mean(exact_load(words + 2 * EXACT_COVERAGE), n);
    if (result->foam)
        result->foam[at] = (float)exact_mean(exact_load(words + 2 * EXACT_FOAM), n);
    if (result->mask)
        result->mask[at] = (float)exact_mean(exact_load(words + 2 * EXACT_WATER), n);
    if (result->color)
        for (size_t c = 0; c < 3; c++)
            result->color[3 * at + c] = (float)exact_mean(exact_load(words + 2 * (EXACT_RED + c)), n);
}

/* ---- blocks ---- */

typedef struct block {
    uint32_t x0, y0, width, height;
    size_t stride;
} block;

static size_t block_offset(const block *area, uint64_t pixel) { return (size_t)(pixel / area->width) * area->stride + (size_t)(pixel % area->width); }

/* The target of a block's samples: sums, or pixels. */
typedef struct sample_sink {
    uint64_t *sums; /* of the block's top left pixel; NULL: into pixels */
    const reference_result *result;
} sample_sink;

static void finish_pixel(const sample_sink *sink, size_t at, const pixel_sums *sums, uint64_t count)
{
    uint64_t own[REFERENCE_SUM_WORDS] = {0};
    add_pixel(sink->sums ? sink->sums + at * REFERENCE_SUM_WORDS : own, sums);
    if (!sink->sums)
        store_pixel(sink->result, at, own, count);
}

/* Renders a block's samples. A batch holds samples of several pixels, so that a few samples per pixel still fill the lanes. */
static void render_samples(const reference_frame *frame, const block *area, const sample_sink *sink, bool with_color, reference_batch *batch)
{
    const uint64_t pixels = (uint64_t)area->width * area->height, count = frame->sample_count;
    pixel_sums sums = {0};
    if (count == 0) {
        for (uint64_t pixel = 0; pixel < pixels; pixel++)
            finish_pixel(sink, block_offset(area, pixel), &sums, 0);
        return;
    }
    uint64_t pixel_in = 0, sample_in = 0;   /* the next sample to place */
    uint64_t pixel_out = 0, sample_out = 0; /* the next sample to add */
    uint64_t key = pixel_key(frame->scene.quality.seed, area->x0, area->y0);
    while (pixel_in < pixels) {
        uint32_t filled = 0;
        while (filled < REFERENCE_BATCH && pixel_in < pixels) {
            const uint32_t x = area->x0 + (uint32_t)(pixel_in % area->width), y = area->y0 + (uint32_t)(pixel_in / area->width);
            if (sample_in == 0)
                key = pixel_key(frame->scene.quality.seed, x, y);
            place_sample(frame, x, y, key, frame->sample_first + sample_in, batch, filled++);
            if (++sample_in == count) {
                sample_in = 0;
                pixel_in++;
            }
        }
        frame->trace(frame, batch, filled);
        for (uint32_t i = 0; i < filled; i++) {
            add_sample(frame, batch, i, with_color, &sums);
            if (++sample_out == count) {
                finish_pixel(sink, block_offset(area, pixel_out++), &sums, count);
                memset(&sums, 0, sizeof sums);
                sample_out = 0;
            }
        }
    }
}

static void store_means(const reference_frame *frame, const block *area, const reference_result *result)
{
    const size_t stride = result->sums_stride ? result->sums_stride : area->width;
    for (uint32_t y = 0; y < area->height; y++)
        for (uint32_t x = 0; x < area->width; x++)
            store_pixel(result, (size_t)y * area->stride + x, result->sums + ((size_t)y * stride + x) * REFERENCE_SUM_WORDS, frame->sample_count);
}

static void store_geometry(const reference_result *result, size_t at, const reference_batch *batch, uint32_t i)
{
    const bool hit = batch->distance[i] < HUGE_VAL;
    if (result->depth)
        result->depth[at] = (float)batch->distance[i];
    if (result->normal) {
        const double x = -batch->slope_x[i], z = -batch->slope_z[i], length = sqrt(x * x + 1 + z * z);
        result->normal[3 * at] = hit ? (float)(x / length) : 0;
        result->normal[3 * at + 1] = hit ? (float)(1 / length) : 0;
        result->normal[3 * at + 2] = hit ? (float)(z / length) : 0;
    }
}

/* Renders depth and normal by one ray through each pixel's centre, at the time at which the shutter closes. */
static void render_geometry(const reference_frame *frame, const block *area, const reference_result *result, reference_batch *batch)
{
    const uint64_t pixels = (uint64_t)area->width * area->height;
    for (uint64_t first = 0; first < pixels; first += REFERENCE_BATCH) {
        const uint32_t count = (uint32_t)(pixels - first < REFERENCE_BATCH ? pixels - first : REFERENCE_BATCH);
        for (uint32_t i = 0; i < count; i++) {
            batch->pixel_x[i] = area->x0 + (double)((first + i) % area->width) + 0.5;
            batch->pixel_y[i] = area->y0 + (double)((first + i) / area->width) + 0.5;
            batch->time_offset[i] = 0;
        }
        frame->trace(frame, batch, count);
        for (uint32_t i = 0; i < count; i++)
            store_geometry(result, block_offset(area, first + i), batch, i);
    }
}

/* Adds the lights by light_cells.h to the colour of samples, which do not see lights, and replaces their coverage. */
static void add_light_cells(const reference_frame *frame, const block *area, const reference_result *result)
{
    light_cells_sum sums[LIGHT_CELLS_PIXELS];
    const uint32_t wide = area->width < LIGHT_CELLS_PIXELS ? area->width : LIGHT_CELLS_PIXELS, high = LIGHT_CELLS_PIXELS / wide;
    for (uint32_t y = 0; y < area->height; y += high)
        for (uint32_t x = 0; x < area->width; x += wide) {
            const light_cells_area part = {area->x0 + x, area->y0 + y, area->width - x < wide ? area->width - x : wide,
                                           area->height - y < high ? area->height - y : high};
            const uint64_t evaluations = light_cells_render(frame, &part, sums);
            if (result->evaluations)
                *result->evaluations += evaluations;
            for (uint32_t i = 0; i < part.width * part.height; i++) {
                const size_t at = (size_t)(y + i / part.width) * area->stride + x + i % part.width;
                if (result->coverage)
                    result->coverage[at] = (float)sums[i].coverage;
                for (size_t c = 0; c < 3 && result->color; c++)
                    result->color[3 * at + c] += (float)sums[i].rgb[c];
            }
        }
}

void reference_render_block(const reference_frame *frame, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, const reference_result *result)
{
    if (width == 0 || height == 0)
        return;
    const block area = {x0, y0, width, height, result->row_stride ? result->row_stride : width};
    reference_batch batch;
    batch.evaluations = 0;
    const bool pixels = result->color || result->coverage || result->mask || result->foam;
    if (pixels && result->sums)
        store_means(frame, &area, result);
    else if (pixels)
        render_samples(frame, &area, &(sample_sink){NULL, result}, result->color != NULL, &batch);
    if (frame->light_cells && (result->color || result->coverage))
        add_light_cells(frame, &area, result);
    if (result->depth || result->normal)
        render_geometry(frame, &area, result, &batch);
    if (result->evaluations)
        *result->evaluations += batch.evaluations;
}

void reference_sum_block(const reference_frame *frame, uint32_t x0, uint32_t y0, uint32_t width, uint32_t height, uint64_t *sums, size_t row_stride)
{
    const block area = {x0, y0, width, height, row_stride};
    reference_batch batch;
    if (width > 0 && height > 0 && frame->sample_count > 0)
        render_samples(frame, &area, &(sample_sink){sums, NULL}, true, &batch);
}
