/* SPDX-License-Identifier: MIT
 * Shows the pictures of sides A and B, which are textures: with a wipe between them, as their difference, in false colours, magnified. */
#ifndef MANGATA_VIEWER_PICTURE_DISPLAY_H
#define MANGATA_VIEWER_PICTURE_DISPLAY_H

#include "viewer/picture/gl_functions.h"

enum { SIDE_A = 0, SIDE_B = 1, SIDE_COUNT = 2 };

typedef struct display display;

typedef enum compare_mode { COMPARE_OFF = 0, COMPARE_WIPE, COMPARE_DIFFERENCE } compare_mode;

typedef struct display_view {
    int x, y, width, height; /* of the picture in the framebuffer, pixels from its lower left corner */
    compare_mode compare;
    float wipe; /* A is left of this fraction of the width */
    float difference_scale;
    float low, high;                /* values of a layer of numbers at the ends of the palette */
    bool logarithmic;               /* true: the palette is even in the value's logarithm; false: in the value */
    float zoom, center_x, center_y; /* 1/zoom of the picture's width and height is shown around this place, whose coordinates are in [0, 1] with y down */
} display_view;

/* Creates a display in the current OpenGL context, which the caller destroys. Returns NULL on failure, with a line of text in `error`. */
display *display_create(const gl_functions *gl, char *error, size_t error_size);
void display_destroy(display *d);

/* Largest side of a picture, pixels. */
uint32_t display_most_side(const display *d);

/* Copies a picture from memory into a side's texture. `pixels` are 4 bytes of displayed colour per pixel for MGT_LAYER_COLOR; for other layers 1 or 3 floats per
 * pixel. */
void display_upload(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height, const void *pixels);

/* Returns a side's texture, into which mgt_gl_render_textures() can write the layer. Needs OpenGL 4.2. */
GLuint display_texture(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height);

/* Draws the view. A side without a picture is left out, as is one whose layer is not side A's. */
void display_draw(const display *d, const display_view *view);

#endif
