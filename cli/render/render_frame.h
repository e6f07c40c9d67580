/* SPDX-License-Identifier: MIT */
/* The pixels of one frame: memory for the layers asked for, and the way from there into a file. */
#ifndef MANGATA_CLI_RENDER_RENDER_FRAME_H
#define MANGATA_CLI_RENDER_RENDER_FRAME_H

#include "cli/render/render_crypto.h"
#include "cli/render/render_request.h"

/* One buffer a layer, used again for every frame. */
typedef struct frame_buffer {
    uint32_t width, height; /* of the crop */
    bool displayed;         /* one layer that becomes 8-bit RGBA */
    size_t count;           /* layers asked for, then those from which alpha and planar depth are made */
    mgt_target targets[LAYER_COUNT];
    float *planar;         /* planar depth; NULL: not asked for */
    render_crypto *crypto; /* mattes, borrowed; NULL: not asked for */
} frame_buffer;

/* Whether the machine has so much memory at all. */
bool frame_buffer_fits(double bytes);

/* Allocates what the request needs; prints the error and returns the exit code. */
int frame_buffer_create(frame_buffer *buffer, const render_request *request, uint32_t width, uint32_t height);
void frame_buffer_free(frame_buffer *buffer);

/* After rendering for PNG and films: turns a float layer into grey or normal colours, in place. Color is left alone. */
void frame_buffer_display(frame_buffer *buffer);

/* Writes a still picture of the request's kind. `scene` and `fps`, frames a second, fill an EXR's attributes; scene NULL: none. With --exr acescg the colours
 * of the buffer are converted in place. */
file_status frame_buffer_write(frame_buffer *buffer, const render_request *request, const mgt_scene *scene, double fps, const char *path,
                               const metadata_list *metadata, const output_options *options, file_error *error);

#endif
