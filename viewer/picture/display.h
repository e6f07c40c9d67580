/* SPDX-License-Identifier: MIT
 * Pictures of sides A and B as textures, and how they are shown: wiped, subtracted, false-coloured, magnified. */
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
    float low, high;                /* what the palette's ends stand for, where the layer is a number */
    bool logarithmic;               /* steps of equal ratio in between */
    float zoom, center_x, center_y; /* what is shown is 1/zoom of the picture around this place, both from 0 to 1, y down */
} display_view;

/* On the current context; NULL with a line of text in error. */
display *display_create(const gl_functions *gl, char *error, size_t error_size);
void display_destroy(display *d);

/* Takes over a picture from memory: bytes of displayed colour (4 a pixel) for MGT_LAYER_COLOR, else floats (1 or 3 a pixel). */
void display_upload(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height, const void *pixels);

/* A texture for mgt_gl_render_textures() to write the layer into; needs OpenGL 4.2. */
GLuint display_texture(display *d, int side, mgt_layer layer, uint32_t width, uint32_t height);

/* Draws. A side without a picture, or with one of another layer than side A's, is left out. */
void display_draw(const display *d, const display_view *view);

#endif
