/* SPDX-License-Identifier: MIT */
/* The pixels of a frame: memory for the requested layers, and how they are written to a file. */
#ifndef MANGATA_CLI_RENDER_RENDER_FRAME_H
#define MANGATA_CLI_RENDER_RENDER_FRAME_H

#include "cli/render/render_crypto.h"
#include "cli/render/render_request.h"

/* Memory for each layer. It is used again for every frame. */
typedef struct frame_buffer {
    uint32_t width, height; /* of the crop, pixels */
    bool displayed;         /* true: there is one layer, which becomes 8-bit RGBA */
    size_t count;           /* number of targets: the requested layers, then those that alpha and planar depth are made of */
    mgt_target targets[LAYER_COUNT];
    float *planar;         /* planar depth; NULL: not requested */
    render_crypto *crypto; /* mattes, borrowed; NULL: not requested */
} frame_buffer;

/* Whether the machine has that much memory in all. True if it does not tell. */
bool frame_buffer_fits(double bytes);

/* Allocates the layers of the request at width × height pixels. Returns an exit code; errors are printed. */
int frame_buffer_create(frame_buffer *buffer, const render_request *request, uint32_t width, uint32_t height);
void frame_buffer_free(frame_buffer *buffer);

/* Converts a float layer to 8-bit RGBA in place, for PNG files and films: numbers to grey, normals to colours. A displayed color layer stays as it is. */
void frame_buffer_display(frame_buffer *buffer);

/* Writes a still picture in the request's format. `scene` and `fps`, the frames per second, give the attributes of an EXR file; scene NULL: it gets none. With
 * --exr acescg the buffer's colours are converted in place. */
file_status frame_buffer_write(frame_buffer *buffer, const render_request *request, const mgt_scene *scene, double fps, const char *path,
                               const metadata_list *metadata, const output_options *options, file_error *error);

#endif
