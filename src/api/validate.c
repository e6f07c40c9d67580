/* SPDX-License-Identifier: MIT
 * Checks of scenes and targets. */
#include "api/validate.h"

#include <math.h>

#include "base/affine.h"
#include "frame/mesh.h"
#include "frame/targets.h"
#include "params/methods.h"
#include "params/scene_rows.h"

mgt_status validate_desc(const reporter *r, const mgt_context_desc *desc)
{
    if ((int)desc->backend < MGT_BACKEND_CPU || (int)desc->backend > MGT_BACKEND_NULL)
        return report_error(r, MGT_ERROR_ARGUMENT, "context.desc", "mgt_context_desc.backend is %d, which names no backend", (int)desc->backend);
    if ((int)desc->isa < MGT_ISA_AUTO || (int)desc->isa > MGT_ISA_NEON)
        return report_error(r, MGT_ERROR_ARGUMENT, "context.desc", "mgt_context_desc.isa is %d, which names no instruction set", (int)desc->isa);
    if (desc->threads > 1024)
        return report_error(r, MGT_ERROR_ARGUMENT, "context.desc", "mgt_context_desc.threads is %u, at most 1024 are allowed", desc->threads);
    return MGT_OK;
}

#define TRY(call)                    \
    do {                             \
        mgt_status status_ = (call); \
        if (status_ != MGT_OK)       \
            return status_;          \
    } while (0)

mgt_status validate_rows(const reporter *r, const char *path, const field_row *fields, const void *values)
{
    for (const field_row *field = fields; field->key; field++) {
        const void *value = field_at(field, values);
        const char *name = field->member ? field->member : field->key;
        char words[240];
        if (field->type == FIELD_MAPPING) {
            snprintf(words, sizeof words, "%s%s.", path, name);
            TRY(validate_rows(r, words, field->fields, value));
            continue;
        }
        if (!field_is_legal(field, value)) {
            field_allowed(field, words, sizeof words);
            return report_error(r, MGT_ERROR_SCENE, "render.scene", "%s%s is %s; allowed is %s", path, name, field_print(field, value).text, words);
        }
        if (field->when[0].key && option_is_set(field, values) && !field_applies(fields, field, values, true)) {
            field_conditions(fields, field, words, sizeof words);
            return report_error(r, MGT_ERROR_SCENE, "render.scene", "%s%s is for %s alone", path, name, words);
        }
    }
    return MGT_OK;
}

static mgt_status check_image(const reporter *r, const mgt_image *image)
{
    TRY(validate_rows(r, "image.", image_rows, image));
    const region area = image_region(image);
    if (image->crop_x >= image->width || image->crop_y >= image->height || area.width > image->width - image->crop_x ||
        area.height > image->height - image->crop_y)
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "image.crop %u,%u,%u,%u lies outside the image of %u x %u pixels", image->crop_x, image->crop_y,
                            image->crop_width, image->crop_height, image->width, image->height);
    return MGT_OK;
}

static mgt_status check_camera(const reporter *r, const char *name, const mgt_camera *camera)
{
    double f[3], length = 0, up_length = 0, cross_length = 0;
    for (int i = 0; i < 3; i++) {
        f[i] = camera->target[i] - camera->position[i];
        length += f[i] * f[i];
        up_length += camera->up[i] * camera->up[i];
    }
    if (!(length > 1e-18))
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "%s.target equals its position; it must be a point in front of the camera", name);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double c = f[j] * camera->up[k] - f[k] * camera->up[j];
        cross_length += c * c;
    }
    if (!(cross_length > 1e-12 * length * up_length) || !(up_length > 1e-18))
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "%s.up is zero or parallel to the view; it must point across it", name);
    return MGT_OK;
}

mgt_status validate_waves(const reporter *r, const mgt_water *water)
{
    if (water->wave_count > MGT_MAX_WAVES)
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "water.waves has %zu waves; at most %d are allowed", water->wave_count, MGT_MAX_WAVES);
    if (water->wave_count > 0 && !water->waves)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.scene", "water.waves is NULL although water.wave_count is %zu", water->wave_count);
    for (size_t i = 0; i < water->wave_count; i++) {
        if (wave_is_legal(&water->waves[i]))
            continue;
        char name[40];
        snprintf(name, sizeof name, "water.waves[%zu].", i);
        return validate_rows(r, name, wave_rows, &water->waves[i]);
    }
    return MGT_OK;
}

static mgt_status check_quality(const reporter *r, const mgt_quality *q)
{
    char wrong[160];
    if (quality_conflict(q, wrong, sizeof wrong))
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "quality: %s", wrong);
    for (size_t i = 0; i < sizeof q->method_option_room / sizeof q->method_option_room[0]; i++)
        if (q->method_option_room[i] != 0)
            return report_error(r, MGT_ERROR_SCENE, "render.scene", "quality.method_option_room[%zu] is %g; allowed is 0: this version has no such option", i,
                                q->method_option_room[i]);
    const bool slots = q->method == MGT_METHOD_ADAPTIVE && q->adaptive == MGT_ADAPTIVE_PODEE;
    if (slots && q->sample_slots == 0 && (q->sample_first || q->sample_count))
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "quality.sample_first and sample_count: adaptive by podee needs sample_slots for them");
    if (slots && q->sample_slots == 0)
        return MGT_OK;
    const uint64_t samples = slots ? quality_range(q) : quality_samples(q);
    if (q->sample_first >= samples || q->sample_count > samples - q->sample_first)
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "quality.sample_first %llu and sample_count %llu lie outside the %llu samples of %s",
                            (unsigned long long)q->sample_first, (unsigned long long)q->sample_count, (unsigned long long)samples,
                            slots ? "the picture" : "a pixel");
    return MGT_OK;
}

/* Checks the range of a field of objects[index]. */
static mgt_status object_range(const reporter *r, size_t index, const char *field, double value, double low, double high)
{
    if (value >= low && value <= high)
        return MGT_OK;
    return report_error(r, MGT_ERROR_SCENE, "render.scene", "objects[%zu].%s is %g; allowed is %g to %g", index, field, value, low, high);
}

static mgt_status check_material(const reporter *r, size_t index, const mgt_material *m)
{
    for (int i = 0; i < 3; i++) {
        TRY(object_range(r, index, "material.base_color", (double)m->base_color[i], 0, 1));
        TRY(object_range(r, index, "material.pattern_color", (double)m->pattern_color[i], 0, 1));
    }
    TRY(object_range(r, index, "material.roughness", (double)m->roughness, (double)0.02f, 1));
    TRY(object_range(r, index, "material.metallic", (double)m->metallic, 0, 1));
    TRY(object_range(r, index, "material.pattern", (int)m->pattern, 0, MGT_PATTERN_STRIPES));
    if (m->pattern == MGT_PATTERN_NONE)
        return MGT_OK;
    TRY(object_range(r, index, "material.pattern_joint", (double)m->pattern_joint, 0, (double)0.999f));
    return object_range(r, index, "material.pattern_size", (double)m->pattern_size, (double)1e-4f, 1e6);
}

static mgt_status check_objects(const reporter *r, const mgt_scene *scene)
{
    uint64_t triangles = 0;
    if (scene->object_count > MGT_MAX_OBJECTS)
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "the scene has %zu objects; at most %d are allowed", scene->object_count, MGT_MAX_OBJECTS);
    if (scene->object_count > 0 && !scene->objects)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.scene", "objects is NULL although object_count is %zu", scene->object_count);
    for (size_t i = 0; i < scene->object_count; i++) {
        const mgt_object *o = &scene->objects[i];
        if (!o->mesh)
            return report_error(r, MGT_ERROR_ARGUMENT, "render.scene", "objects[%zu].mesh is NULL", i);
        for (int k = 0; k < 12; k++)
            TRY(object_range(r, i, "transform", o->transform[k / 4][k % 4], -1e6, 1e6));
        const double volume = affine_volume(o->transform);
        if (!affine_keeps_volume(volume))
            return report_error(r, MGT_ERROR_SCENE, "render.scene", "objects[%zu].transform flattens the mesh; its determinant is %g", i, volume);
        TRY(check_material(r, i, &o->material));
        triangles += o->mesh->triangle_count;
    }
    if (triangles > MGT_MAX_TRIANGLES)
        return report_error(r, MGT_ERROR_SCENE, "render.scene", "the scene has %llu triangles; at most %d are allowed", (unsigned long long)triangles,
                            MGT_MAX_TRIANGLES);
    return MGT_OK;
}

mgt_status validate_scene(const reporter *r, const mgt_scene *scene)
{
    TRY(check_image(r, &scene->image));
    TRY(validate_rows(r, "", scene_rows, scene));
    TRY(check_camera(r, "camera", &scene->camera));
    if (scene->camera_moves) {
        TRY(validate_rows(r, "camera_open.", camera_rows, &scene->camera_open));
        TRY(check_camera(r, "camera_open", &scene->camera_open));
    }
    TRY(validate_waves(r, &scene->water));
    TRY(check_objects(r, scene));
    return check_quality(r, &scene->quality);
}

static bool layer_takes(mgt_layer layer, mgt_format format)
{
    switch (format) {
    case MGT_FORMAT_R32F:
        return mgt_layer_channels(layer) == 1;
    case MGT_FORMAT_RGB32F:
    case MGT_FORMAT_RGBA32F:
        return mgt_layer_channels(layer) == 3;
    case MGT_FORMAT_RGBA8_SRGB:
        return layer == MGT_LAYER_COLOR;
    }
    return false;
}

size_t stride_length(ptrdiff_t stride) { return stride < 0 ? 0 - (size_t)stride : (size_t)stride; }

/* The formats that take a layer, in words. */
static const char *formats_of(mgt_layer layer)
{
    if (mgt_layer_channels(layer) == 1)
        return "r32f";
    return layer == MGT_LAYER_COLOR ? "rgb32f, rgba32f or rgba8_srgb" : "rgb32f or rgba32f";
}

static mgt_status check_format(const reporter *r, const mgt_target *target, size_t index)
{
    if (!mgt_layer_name(target->layer))
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: layer is %d, which names no layer", index, (int)target->layer);
    if (!mgt_format_name(target->format))
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: format is %d, which names no format", index, (int)target->format);
    if (!layer_takes(target->layer, target->format))
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: layer %s cannot be written in format %s; allowed is %s", index,
                            mgt_layer_name(target->layer), mgt_format_name(target->format), formats_of(target->layer));
    return MGT_OK;
}

static mgt_status validate_target(const reporter *r, const region *area, const mgt_target *target, size_t index)
{
    TRY(check_format(r, target, index));
    if (!target->pixels)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: pixels is NULL", index);
    const size_t row = format_size(target->format) * area->width;
    const ptrdiff_t stride = target->row_stride;
    const size_t step = stride_length(stride);
    if (stride != 0 && step < row)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: row_stride %td is shorter than a row of %zu bytes", index, stride, row);
    if (step > PTRDIFF_MAX / area->height)
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: row_stride %td: no memory holds %u such rows", index, stride, area->height);
    if (target->format != MGT_FORMAT_RGBA8_SRGB && ((uintptr_t)target->pixels % sizeof(float) != 0 || stride % (ptrdiff_t)sizeof(float) != 0))
        return report_error(r, MGT_ERROR_ARGUMENT, "render.target", "target %zu: pixels and row_stride of a float format must be multiples of 4", index);
    return MGT_OK;
}

mgt_status validate_targets(const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    const region area = image_region(&scene->image);
    for (size_t i = 0; i < count; i++)
        TRY(validate_target(r, &area, &targets[i], i));
    return MGT_OK;
}
