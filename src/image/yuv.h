/* SPDX-License-Identifier: MIT */
/* Displayed 8-bit R'G'B' to Y'CbCr as video wants it: BT.709, limited range (Y 16–235, C 16–240). Private to src/image. */
#ifndef MANGATA_IMAGE_YUV_H
#define MANGATA_IMAGE_YUV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Three planes one after the other, tightly packed. */
typedef struct yuv_layout {
    uint32_t width, height;               /* of Y */
    uint32_t chroma_width, chroma_height; /* of Cb and Cr: half, rounded up, in 4:2:0 */
    bool full_chroma;                     /* 4:4:4 */
    size_t bytes;
} yuv_layout;

yuv_layout yuv_layout_of(uint32_t width, uint32_t height, bool full_chroma);

/* Converts a picture of width × height RGBA pixels (row_stride as in picture.h) into planes of `layout`; a layout larger than the
 * picture repeats its last column and row. 4:2:0 chroma is sited at the left, between two rows, as MPEG-2 and H.264 have
 * it: weights 1 2 1 along the row, 1 1 down. Integers only: the same bytes everywhere. */
void yuv_from_rgba(uint8_t *planes, const yuv_layout *layout, const uint8_t *rgba, ptrdiff_t row_stride, uint32_t width, uint32_t height);

#endif
