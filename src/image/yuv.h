/* SPDX-License-Identifier: MIT */
/* Conversion of displayed 8-bit R'G'B' to the Y'CbCr of video: BT.709, limited range (Y 16–235, C 16–240). Private to src/image. */
#ifndef MANGATA_IMAGE_YUV_H
#define MANGATA_IMAGE_YUV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Layout of three planes, one after the other and tightly packed. */
typedef struct yuv_layout {
    uint32_t width, height;               /* size of Y */
    uint32_t chroma_width, chroma_height; /* size of Cb and Cr; in 4:2:0 half of that of Y, rounded up */
    bool full_chroma;                     /* 4:4:4 */
    size_t bytes;
} yuv_layout;

yuv_layout yuv_layout_of(uint32_t width, uint32_t height, bool full_chroma);

/* Converts width × height RGBA pixels to the planes of `layout`. `row_stride`: as in picture_layer. If the layout is larger than the picture, the last column
 * and row are repeated. Chroma of 4:2:0 is sited at the left, between two rows, as in MPEG-2 and H.264: its weights are 1 2 1 along the row and 1 1 down. All
 * numbers are integers, so that the bytes are the same on every machine. */
void yuv_from_rgba(uint8_t *planes, const yuv_layout *layout, const uint8_t *rgba, ptrdiff_t row_stride, uint32_t width, uint32_t height);

#endif
