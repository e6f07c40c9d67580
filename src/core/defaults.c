/* SPDX-License-Identifier: MIT
 * Defaults of every public struct, texts, and small facts about images and formats. */
#include <stddef.h>

#include "core/backend.h"
#include "params/methods.h"

const char *mgt_version(void) { return MGT_VERSION_STRING; }

const char *mgt_status_text(mgt_status status)
{
    switch (status) {
    case MGT_OK:
        return "ok";
    case MGT_ERROR_ARGUMENT:
        return "invalid argument";
    case MGT_ERROR_SCENE:
        return "invalid scene";
    case MGT_ERROR_MEMORY:
        return "out of memory";
    case MGT_ERROR_UNAVAILABLE:
        return "not available here";
    case MGT_ERROR_UNSUPPORTED:
        return "not supported yet";
    case MGT_ERROR_THREAD:
        return "a thread could not be started";
    case MGT_CANCELLED:
        return "cancelled";
    }
    return "unknown status";
}

mgt_context_desc mgt_context_desc_defaults(void) { return (mgt_context_desc){.struct_size = sizeof(mgt_context_desc)}; }

mgt_target mgt_target_defaults(void) { return (mgt_target){.struct_size = sizeof(mgt_target), .layer = MGT_LAYER_COLOR, .format = MGT_FORMAT_RGBA8_SRGB}; }

mgt_light mgt_light_defaults(mgt_body body)
{
    mgt_light light = {.body = body, .elevation_deg = 30};
    if (body == MGT_BODY_MOON) {
        light.angular_radius_deg = 0.2590;
        light.radiance[0] = 3.75f, light.radiance[1] = 3.45f, light.radiance[2] = 3.0f;
    } else {
        light.angular_radius_deg = 0.2665;
        light.radiance[0] = 1.98e6f, light.radiance[1] = 1.88e6f, light.radiance[2] = 1.80e6f;
    }
    return light;
}

mgt_scene mgt_scene_defaults(void)
{
    return (mgt_scene){
        .struct_size = sizeof(mgt_scene),
        .image = {.width = 1280, .height = 720},
        .camera = {.position = {0, 4, 0}, .target = {0, 3.84, -0.987}, .up = {0, 1, 0}, .fov_y_deg = 50},
        .camera_open = {.position = {0, 4, 0}, .target = {0, 3.84, -0.987}, .up = {0, 1, 0}, .fov_y_deg = 50},
        .shutter = 1.0 / 30,
        .light = mgt_light_defaults(MGT_BODY_SUN),
        .sky =
            {.model = MGT_SKY_ATMOSPHERE, .turbidity = 1.8f, .zenith = {1.6f, 2.6f, 4.6f}, .horizon = {6.0f, 7.0f, 8.0f}, .night = {1.6e-7f, 1.8e-7f, 2.4e-7f}},
        .water = {.index_of_refraction = 1.333,
                  .absorption = {0.264f, 0.0565f, 0.0101f},
                  .scattering = {0.0012f, 0.0019f, 0.0039f},
                  .body_albedo = {0.006f, 0.022f, 0.030f}},
        .post = {.auto_exposure = true, .tone_map = MGT_TONE_AGX, .glare = 0.03f},
        .quality = {.method = MGT_METHOD_MANGATA, .spatial_samples = 4, .time_samples = 1},
    };
}

region image_region(const mgt_image *image)
{
    region area = {image->crop_x, image->crop_y, image->crop_width, image->crop_height};
    if (area.width == 0)
        area.width = image->width > area.x ? image->width - area.x : 0;
    if (area.height == 0)
        area.height = image->height > area.y ? image->height - area.y : 0;
    return area;
}

float samples_per_pixel(const mgt_quality *quality)
{
    const mgt_quality *q = quality;
    if (!method_takes(q->method, METHOD_TAKES_TIMES)) {
        const uint32_t samples = method_of(q->method)->samples;
        return samples ? (float)samples : 1;
    }
    const uint64_t all = (uint64_t)q->spatial_samples * q->spatial_samples * q->time_samples - q->sample_first;
    return (float)(q->sample_count ? q->sample_count : all);
}

size_t format_size(mgt_format format)
{
    static const size_t sizes[] = {[MGT_FORMAT_R32F] = 4, [MGT_FORMAT_RGB32F] = 12, [MGT_FORMAT_RGBA32F] = 16, [MGT_FORMAT_RGBA8_SRGB] = 4};
    return sizes[format];
}

void *target_row(const mgt_target *target, const region *area, uint32_t row)
{
    const ptrdiff_t stride = target->row_stride ? target->row_stride : (ptrdiff_t)(format_size(target->format) * area->width);
    return (char *)target->pixels + stride * (ptrdiff_t)row;
}
