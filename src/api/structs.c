/* SPDX-License-Identifier: MIT
 * Public structs: kinds and defaults, and how those of callers are initialised, read and filled. */
#include "api/structs.h"

#include <assert.h>
#include <string.h>

#include "api/validate.h"
#include "base/struct_size.h"
#include "params/scene_rows.h"
#include "sea/sea.h"

/* ---- kinds ---- */

#define END(type, member) (offsetof(type, member) + sizeof(((type *)0)->member))
#define KIND(type, id, most, last_of_first_version, ...)                                                                            \
    {                                                                                                                               \
#type, id, most, END(type, last_of_first_version), sizeof(type), &(const type) { .struct_size = sizeof(type), __VA_ARGS__ } \
    }

/* A new member must not lie in the padding of an earlier version, because callers leave that uninitialised. There is no earlier version for 32-bit pointers. */
#define UNPADDED(type, last) static_assert(sizeof(void *) != 8 || sizeof(type) == END(type, last), #type " ends with padding")
UNPADDED(mgt_context_desc, gl_get_proc);
UNPADDED(mgt_mesh_desc, reserved);
UNPADDED(mgt_texture_desc, row_stride);
UNPADDED(mgt_quality, target_displayed);
static_assert(sizeof(mgt_scene) == END(mgt_scene, quality), "mgt_quality grows with the scene only while it is the last in it");
UNPADDED(mgt_target, row_stride);
UNPADDED(mgt_water_answers, foam_persistence);
UNPADDED(mgt_sea, swells);
UNPADDED(mgt_gl_view, reserved);
UNPADDED(mgt_gl_texture, reserved);

/* Structs within other structs or arrays never change, because a new member would move what follows. */
#define FIXED(type, size) static_assert(sizeof(void *) != 8 || sizeof(type) == (size), #type " has changed: callers have it inside other structs")
FIXED(mgt_wave, 40);
FIXED(mgt_image, 24);
FIXED(mgt_camera, 80);
FIXED(mgt_light, 48);
FIXED(mgt_sky, 44);
FIXED(mgt_water, 72);
FIXED(mgt_material, 56);
FIXED(mgt_object, 160);
FIXED(mgt_post, 24);
FIXED(mgt_swell, 40);
FIXED(mgt_gl_timing, 16);
FIXED(mgt_gl_source, 16);

#define CAMERA                                                                               \
    {                                                                                        \
        .position = {0, 4, 0}, .target = {0, 3.84, -0.987}, .up = {0, 1, 0}, .fov_y_deg = 50 \
    }
#define IDENTITY                                       \
    {                                                  \
        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 \
    }

const struct_kind context_desc_kind = KIND(mgt_context_desc, "context.desc", 1, gl_get_proc);
const struct_kind context_info_kind = KIND(mgt_context_info, "context.info", 1, software);
const struct_kind method_properties_kind = KIND(mgt_method_properties, "method.info", 1, layers);
const struct_kind mesh_desc_kind = KIND(mgt_mesh_desc, "mesh.desc", 1, indices);
const struct_kind texture_desc_kind = KIND(mgt_texture_desc, "texture.desc", 1, row_stride);
const struct_kind target_kind = KIND(mgt_target, "render.target", MOST_TARGETS, row_stride, .layer = MGT_LAYER_COLOR, .format = MGT_FORMAT_RGBA8_SRGB);
const struct_kind pixel_info_kind = KIND(mgt_pixel_info, "inspect.info", 1, filtered);
const struct_kind gl_view_kind = KIND(mgt_gl_view, "render.view", MOST_TARGETS, reserved, .view = IDENTITY, .projection = IDENTITY, .view_open = IDENTITY);
const struct_kind gl_texture_kind = KIND(mgt_gl_texture, "render.texture", MOST_TARGETS, reserved);
const struct_kind water_answers_kind = KIND(mgt_water_answers, "query.answers", 1, covariance, .foam_persistence = 3);
const struct_kind sea_kind = KIND(mgt_sea, "waves.sea", 1, swells, .spreading = MGT_SPREADING_HASSELMANN, .wind = 10, .gamma = SEA_PEAKEDNESS, .spread = 10,
                                  .count = SEA_COUNT, .seed = 1, .cox_munk = 1, .choppiness = SEA_CHOPPINESS, .foam = 1);
const struct_kind scene_kind = KIND(mgt_scene, "render.scene", 1, quality.sample_slots, .image = {.width = 1280, .height = 720}, .camera = CAMERA,
                                    .camera_open = CAMERA, .shutter = 1.0 / 30,
                                    .sky = {.model = MGT_SKY_ATMOSPHERE,
                                            .turbidity = 1.8f,
                                            .zenith = {1.6f, 2.6f, 4.6f},
                                            .horizon = {6.0f, 7.0f, 8.0f},
                                            .night = {1.6e-7f, 1.8e-7f, 2.4e-7f}},
                                    .water = {.index_of_refraction = 1.333,
                                              .absorption = {0.264f, 0.0565f, 0.0101f},
                                              .scattering = {0.0012f, 0.0019f, 0.0039f},
                                              .body_albedo = {0.006f, 0.022f, 0.030f}},
                                    .foam_persistence = 3, .post = {.auto_exposure = true, .tone_map = MGT_TONE_AGX, .glare = 0.03f});

/* ---- initialising ---- */

static void fill(void *to, size_t size, const void *from, size_t known)
{
    memcpy(to, from, size < known ? size : known);
    if (size > known)
        memset((char *)to + known, 0, size - known);
}

static void init(const struct_kind *kind, void *theirs, size_t size)
{
    if (!theirs || !struct_size_fits(size, sizeof size, kind->size))
        return;
    fill(theirs, size, kind->defaults, kind->size);
    memcpy(theirs, &size, sizeof size);
}

void mgt_context_desc_init(mgt_context_desc *desc, size_t size) { init(&context_desc_kind, desc, size); }
void mgt_mesh_desc_init(mgt_mesh_desc *desc, size_t size) { init(&mesh_desc_kind, desc, size); }
void mgt_texture_desc_init(mgt_texture_desc *desc, size_t size) { init(&texture_desc_kind, desc, size); }

void mgt_scene_init(mgt_scene *scene, size_t size)
{
    init(&scene_kind, scene, size);
    if (!scene || !struct_size_fits(size, offsetof(mgt_scene, quality), sizeof *scene))
        return;
    const mgt_quality quality = quality_defaults();
    scene->light = light_defaults[MGT_SOURCE_SUN];
    fill(&scene->quality, size - offsetof(mgt_scene, quality), &quality, sizeof quality);
}

void mgt_target_init(mgt_target *target, size_t size) { init(&target_kind, target, size); }
void mgt_water_answers_init(mgt_water_answers *answers, size_t size) { init(&water_answers_kind, answers, size); }
void mgt_sea_init(mgt_sea *sea, size_t size) { init(&sea_kind, sea, size); }
void mgt_gl_view_init(mgt_gl_view *view, size_t size) { init(&gl_view_kind, view, size); }
void mgt_gl_texture_init(mgt_gl_texture *texture, size_t size) { init(&gl_texture_kind, texture, size); }

void mgt_quality_init(mgt_quality *quality, size_t size)
{
    const mgt_quality defaults = quality_defaults();
    if (quality && struct_size_fits(size, 0, sizeof *quality))
        fill(quality, size, &defaults, sizeof defaults);
}

void mgt_light_init(mgt_light *light, mgt_source body)
{
    if (light)
        *light = light_defaults[body == MGT_SOURCE_MOON];
}

/* ---- reading and filling ---- */

static mgt_status check_size(const reporter *r, const struct_kind *kind, size_t index, size_t size)
{
    if (struct_size_fits(size, kind->least, kind->size) && size % _Alignof(size_t) == 0)
        return MGT_OK;
    return report_error(r, MGT_ERROR_ARGUMENT, kind->id, "%s %zu: struct_size is %zu; this library knows %zu to %zu", kind->name, index, size, kind->least,
                        kind->size);
}

mgt_status struct_take(const reporter *r, const struct_kind *kind, void *own, const void *theirs, size_t count)
{
    if (!theirs)
        return report_error(r, MGT_ERROR_ARGUMENT, kind->id, "the pointer to %s is NULL", kind->name);
    if (count < 1 || count > kind->most)
        return report_error(r, MGT_ERROR_ARGUMENT, kind->id, "%zu of %s; allowed is 1 to %zu", count, kind->name, kind->most);
    const size_t size = *(const size_t *)theirs;
    for (size_t i = 0; i < count; i++) {
        const char *from = (const char *)theirs + i * size;
        char *to = (char *)own + i * kind->size;
        const mgt_status status = check_size(r, kind, i, *(const size_t *)(const void *)from);
        if (status != MGT_OK)
            return status;
        if (*(const size_t *)(const void *)from != size)
            return report_error(r, MGT_ERROR_ARGUMENT, kind->id, "%s %zu: struct_size is not that of the first, %zu", kind->name, i, size);
        for (size_t k = kind->size; k < size; k++)
            if (from[k])
                return report_error(r, MGT_ERROR_ARGUMENT, kind->id, "%s %zu: struct_size is %zu, and a member that this library does not know is set",
                                    kind->name, i, size);
        memcpy(to, kind->defaults, kind->size);
        memcpy(to, from, size < kind->size ? size : kind->size);
        memcpy(to, &kind->size, sizeof kind->size);
    }
    return MGT_OK;
}

mgt_status struct_give(const reporter *r, const struct_kind *kind, const void *own, void *theirs)
{
    return struct_give_sized(r, kind, own, theirs, theirs ? *(const size_t *)theirs : 0);
}

mgt_status struct_give_sized(const reporter *r, const struct_kind *kind, const void *own, void *theirs, size_t size)
{
    if (!theirs)
        return report_error(r, MGT_ERROR_ARGUMENT, kind->id, "the %s to fill is NULL", kind->name);
    const mgt_status status = check_size(r, kind, 0, size);
    if (status == MGT_OK) {
        fill(theirs, size, own, kind->size);
        memcpy(theirs, &size, sizeof size);
    }
    return status;
}

mgt_status scene_take(const reporter *r, mgt_scene *own, const mgt_scene *theirs)
{
    const mgt_status status = struct_take(r, &scene_kind, own, theirs, 1);
    return status == MGT_OK ? validate_scene(r, own) : status;
}

mgt_status targets_take(const reporter *r, const mgt_scene *scene, mgt_target *own, const mgt_target *theirs, size_t count)
{
    const mgt_status status = struct_take(r, &target_kind, own, theirs, count);
    return status == MGT_OK ? validate_targets(r, scene, own, count) : status;
}
