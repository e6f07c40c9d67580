/* SPDX-License-Identifier: MIT
 * The part of an image that a scene asks for, and the pixels of its targets. */
#include "frame/targets.h"

#include "params/methods.h"

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
    if (!method_is_sampled(q->method))
        return (float)quality_pixel_samples(q);
    const uint64_t all = quality_samples(q) - q->sample_first;
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

void scene_to_sea_level(mgt_scene *own)
{
    own->camera.position[1] -= own->water.level;
    own->camera.target[1] -= own->water.level;
    own->camera_open.position[1] -= own->water.level;
    own->camera_open.target[1] -= own->water.level;
}
