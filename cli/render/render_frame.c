/* SPDX-License-Identifier: MIT */
/* Memory for frames, and writing of still pictures. */
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

bool frame_buffer_fits(double bytes)
{
    const double pages = (double)sysconf(_SC_PHYS_PAGES), page = (double)sysconf(_SC_PAGESIZE);
    return pages <= 0 || bytes < pages * page;
}

static const mgt_target *target_of_layer(const frame_buffer *buffer, mgt_layer layer)
{
    for (size_t i = 0; i < buffer->count; i++)
        if (buffer->targets[i].layer == layer)
            return &buffer->targets[i];
    return NULL;
}

/* Lists the layers of the request, then those that alpha and planar depth need. */
static size_t list_layers(const render_request *request, mgt_layer layers[LAYER_COUNT])
{
    size_t count = request->layer_count;
    bool mask = false, depth = false;
    for (size_t i = 0; i < count; i++) {
        layers[i] = request->layers[i];
        mask = mask || layers[i] == MGT_LAYER_MASK;
        depth = depth || layers[i] == MGT_LAYER_DEPTH;
    }
    if (request->exr.alpha && !mask)
        layers[count++] = MGT_LAYER_MASK;
    if (request->exr.z && !depth)
        layers[count++] = MGT_LAYER_DEPTH;
    return count;
}

int frame_buffer_create(frame_buffer *buffer, const render_request *request, uint32_t width, uint32_t height)
{
    mgt_layer layers[LAYER_COUNT];
    const size_t count = list_layers(request, layers), pixels = (size_t)width * height;
    *buffer = (frame_buffer){.width = width, .height = height};
    buffer->displayed = request->format != PICTURE_EXR && request->format != PICTURE_PFM && request->format != PICTURE_SUMS;
    double bytes = request->exr.z ? 4.0 * (double)pixels : 0;
    for (size_t i = 0; i < count; i++)
        bytes += (double)pixels * (double)pixel_bytes(layer_format(layers[i], buffer->displayed));
    /* Linux may grant more memory than there is and kill the process later, so this is checked first. */
    if (!frame_buffer_fits(bytes))
        goto fail;
    if (request->exr.z && !(buffer->planar = calloc(pixels, sizeof *buffer->planar)))
        goto fail;
    for (size_t i = 0; i < count; i++) {
        mgt_target *target = &buffer->targets[buffer->count];
        const mgt_format format = layer_format(layers[i], buffer->displayed);
        *target = target_of(layers[i], format, calloc(pixels, pixel_bytes(format)));
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
    free(buffer->planar);
    buffer->planar = NULL;
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
    /* Pixel i is read at or behind the place where it is written, so nothing is overwritten before it is read. */
    for (size_t i = 0; i < (size_t)buffer->width * buffer->height; i++) {
        float value[3] = {0};
        uint8_t rgba[4] = {0, 0, 0, 255};
        memcpy(value, bytes + i * stride, stride);
        for (int k = 0; k < 3; k++)
            rgba[k] = to_byte(normal ? 0.5f + 0.5f * value[k] : value[0]);
        memcpy(bytes + 4 * i, rgba, sizeof rgba);
    }
}

/* Whether 16-bit floats are not precise enough for a layer. */
static bool is_exact(mgt_layer layer) { return layer == MGT_LAYER_DEPTH || layer == MGT_LAYER_SAMPLES || layer == MGT_LAYER_REFRACTION_ERROR; }

static picture_layer layer_of(const mgt_target *target)
{
    return (picture_layer){.name = mgt_layer_name(target->layer),
                           .channels = mgt_layer_channels(target->layer),
                           .pixels = target->pixels,
                           .exact = is_exact(target->layer)};
}

static file_status write_exr(frame_buffer *buffer, const render_request *request, const mgt_scene *scene, double fps, const char *path,
                             const metadata_list *metadata, const output_options *options, file_error *error)
{
    picture_layer layers[LAYER_COUNT + 2 + CRYPTO_CHANNELS];
    size_t count = 0;
    const size_t pixels = (size_t)buffer->width * buffer->height;
    exr_desc desc = scene ? exr_desc_of(&request->exr, scene, fps) : (exr_desc){0};
    for (; count < request->layer_count; count++) {
        const mgt_target *target = &buffer->targets[count];
        layers[count] = layer_of(target);
        if (desc.acescg && (target->layer == MGT_LAYER_COLOR || target->layer == MGT_LAYER_REFRACTION))
            exr_to_acescg(target->pixels, pixels);
    }
    if (request->exr.alpha) {
        layers[count] = layer_of(target_of_layer(buffer, MGT_LAYER_MASK));
        layers[count].part = "color";
        layers[count++].channel = "A";
    }
    if (buffer->planar && scene) {
        layers[count] = layer_of(target_of_layer(buffer, MGT_LAYER_DEPTH));
        memcpy(buffer->planar, layers[count].pixels, pixels * sizeof *buffer->planar);
        exr_planar_depth(buffer->planar, scene);
        layers[count].pixels = buffer->planar;
        layers[count].part = "color";
        layers[count++].channel = "Z";
    }
    if (buffer->crypto && scene) {
        const file_status status = render_crypto_draw(buffer->crypto, scene, error);
        if (status != FILE_OK)
            return status;
        render_crypto_layers(buffer->crypto, layers + count, &desc);
        count += CRYPTO_CHANNELS;
    }
    return picture_write_exr_described(path, buffer->width, buffer->height, layers, count, &desc, metadata, options, error);
}

file_status frame_buffer_write(frame_buffer *buffer, const render_request *request, const mgt_scene *scene, double fps, const char *path,
                               const metadata_list *metadata, const output_options *options, file_error *error)
{
    if (buffer->displayed)
        return picture_write_png(path, buffer->width, buffer->height, buffer->targets[0].pixels, 0, metadata, options, error);
    if (request->format == PICTURE_EXR)
        return write_exr(buffer, request, scene, fps, path, metadata, options, error);
    const picture_layer layer = layer_of(&buffer->targets[0]);
    return picture_write_pfm(path, buffer->width, buffer->height, &layer, metadata, options, error);
}
