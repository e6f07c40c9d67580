/* SPDX-License-Identifier: MIT
 * The part of an image that a scene asks for, and the pixels of its targets. */
#ifndef MANGATA_FRAME_TARGETS_H
#define MANGATA_FRAME_TARGETS_H

#include <stddef.h>
#include <stdint.h>

#include "mangata/mangata.h"

/* The rectangle of the image that a scene asks for. */
typedef struct region {
    uint32_t x, y, width, height;
} region;

region image_region(const mgt_image *image);

/* The value of the layer `samples` for methods that take the same number of samples in every pixel. */
float samples_per_pixel(const mgt_quality *quality);

/* Bytes of one pixel of a format. */
size_t format_size(mgt_format format);

/* Address of the first pixel of a row of the region. A stride of 0 means rows without gaps. */
void *target_row(const mgt_target *target, const region *area, uint32_t row);

/* Moves a scene's cameras so that the mean surface is at y = 0, as backends expect it. Objects are not moved: their readers subtract water.level. */
void scene_to_sea_level(mgt_scene *own);

#endif
