/* SPDX-License-Identifier: MIT */
/* Frame memory and still pictures. */
#include "cli/render/render_frame.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static mgt_format layer_format(mgt_layer layer, bool displayed)
{
    if (layer == MGT_LAYER_COLOR && displayed)
        return MGT_FORMAT_RGBA8_SRGB;
    return mgt_layer_channels(layer) == 3 ? MGT_FORMAT_RGB32F : MGT_FORMAT_R32F;
}

static size_t pixel_bytes(mgt_format format) { return format == MGT_FORMAT_RGB32F ? 12 : 4; }

static bool fits_in_memory(double bytes)
{
    const double pages = (double)sysconf(_SC_PHYS_PAGES), page = (double)sysconf(_SC_PAGESIZE);
    return pages <= 0 || bytes < pages * page;
}

int frame_buffer_create(frame_buffer *buffer, const render_request *request, uint32_t width, uint32_t height)
{
    *buffer = (frame_buffer){.width = width, .height = height};
    buffer->displayed = request->format != PICTURE_EXR && request->format != PICTURE_PFM;
    double bytes = 0;
    for (size_t i = 0; i < request->layer_count; i++)
        bytes += (double)width * height * (double)pixel_bytes(layer_format(request->layers[i], buffer->displayed));
    /* Linux grants more than there is and kills later; better to say no now. */
    if (!fits_in_memory(bytes))
        goto fail;
    for (size_t i = 0; i < request->layer_count; i++) {
        mgt_target *target = &buffer->targets[buffer->count];
        const mgt_format format = layer_format(request->layers[i], buffer->displayed);
        *target = target_of(request->layers[i], format, calloc((size_t)width * height, pixel_bytes(format)));
        if (!target->pixels)
            goto fail;
        buffer->count++;
    }
    return EXIT_CODE_OK;
fail:
    frame_buffer_free(buffer);
    return console_error(EXIT_CODE_FAILED, "out of memory: %u x %u pixels need %.1f GB; --crop renders a part", width, height, bytes * 1e-9);
}

void frame_buffer_free(frame_buffer *buffer)
{
    for (size_t i = 0; i < buffer->count; i++)
        free(buffer->targets[i].pixels);
    buffer->count = 0;
}

static uint8_t to_byte(float value) { return value > 0 ? value < 1 ? (uint8_t)(value * 255 + 0.5f) : 255 : 0; }

void frame_buffer_display(frame_buffer *buffer)
{
    const mgt_target *target = &buffer->targets[0];
    if (target->format == MGT_FORMAT_RGBA8_SRGB)
        return;
    const bool normal = target->layer == MGT_LAYER_NORMAL;
    const size_t stride = pixel_bytes(target->format);
    uint8_t *bytes = target->pixels;
    /* Four bytes are written where at least four have been read. */
    for (size_t i = 0; i < (size_t)buffer->width * buffer->height; i++) {
        float value[3] = {0};
        uint8_t rgba[4] = {0, 0, 0, 255};
        memcpy(value, bytes + i * stride, stride);
        for (int k = 0; k < 3; k++)
            rgba[k] = to_byte(normal ? 0.5f + 0.5f * value[k] : value[0]);
        memcpy(bytes + 4 * i, rgba, sizeof rgba);
    }
}

file_status frame_buffer_write(const frame_buffer *buffer, const render_request *request, const char *path, const metadata_list *metadata,
                               const output_options *options, file_error *error)
{
    picture_layer layers[LAYER_COUNT] = {0};
    if (buffer->displayed)
        return picture_write_png(path, buffer->width, buffer->height, buffer->targets[0].pixels, 0, metadata, options, error);
    for (size_t i = 0; i < buffer->count; i++)
        layers[i] = (picture_layer){.name = mgt_layer_name(buffer->targets[i].layer),
                                    .channels = mgt_layer_channels(buffer->targets[i].layer),
                                    .pixels = buffer->targets[i].pixels};
    if (request->format == PICTURE_PFM)
        return picture_write_pfm(path, buffer->width, buffer->height, &layers[0], metadata, options, error);
    return picture_write_exr(path, buffer->width, buffer->height, layers, buffer->count, metadata, options, error);
}
