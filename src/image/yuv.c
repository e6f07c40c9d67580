/* SPDX-License-Identifier: MIT */
/* R'G'B' to BT.709 Y'CbCr in 16-bit fixed point. */
#include "image/yuv.h"

#include "image/picture_formats.h"

typedef struct rgb_sum {
    int32_t r, g, b;
} rgb_sum;

yuv_layout yuv_layout_of(uint32_t width, uint32_t height, bool full_chroma)
{
    yuv_layout layout = {.width = width, .height = height, .full_chroma = full_chroma};
    layout.chroma_width = full_chroma ? width : (width + 1) / 2;
    layout.chroma_height = full_chroma ? height : (height + 1) / 2;
    layout.bytes = (size_t)width * height + 2 * (size_t)layout.chroma_width * layout.chroma_height;
    return layout;
}

/* Kr .2126, Kg .7152, Kb .0722 times 219/255 · 2^16; they add up to white = 235 exactly. */
static uint8_t luma(const uint8_t *p) { return (uint8_t)(16 + ((11966 * p[0] + 40254 * p[1] + 4064 * p[2] + (1 << 15)) >> 16)); }

/* (B' − Y')/1.8556 and (R' − Y')/1.5748 times 224/255 · 2^16 of a sum over 2^shift pixels; each row adds up to 0, so that grey
 * stays grey. */
static uint8_t chroma_blue(rgb_sum s, int shift)
{
    int32_t value = -6596 * s.r - 22189 * s.g + 28785 * s.b;
    return (uint8_t)((value + (128 << (16 + shift)) + (1 << (15 + shift))) >> (16 + shift));
}

static uint8_t chroma_red(rgb_sum s, int shift)
{
    int32_t value = 28784 * s.r - 26145 * s.g - 2639 * s.b;
    return (uint8_t)((value + (128 << (16 + shift)) + (1 << (15 + shift))) >> (16 + shift));
}

static rgb_sum add_weighted(rgb_sum sum, const uint8_t *row, uint32_t x, int32_t weight)
{
    const uint8_t *p = row + 4 * (size_t)x;
    return (rgb_sum){sum.r + weight * p[0], sum.g + weight * p[1], sum.b + weight * p[2]};
}

static uint32_t at_most(uint32_t value, uint32_t limit) { return value < limit ? value : limit; }

/* Sum of weight 8 around luma column 2·x between two rows. */
static rgb_sum chroma_neighbourhood(const uint8_t *upper, const uint8_t *lower, uint32_t x, uint32_t width)
{
    uint32_t center = at_most(2 * x, width - 1);
    uint32_t left = x == 0 ? 0 : at_most(2 * x - 1, width - 1);
    uint32_t right = at_most(2 * x + 1, width - 1);
    rgb_sum sum = {0, 0, 0};
    sum = add_weighted(sum, upper, left, 1);
    sum = add_weighted(sum, upper, center, 2);
    sum = add_weighted(sum, upper, right, 1);
    sum = add_weighted(sum, lower, left, 1);
    sum = add_weighted(sum, lower, center, 2);
    return add_weighted(sum, lower, right, 1);
}

void yuv_from_rgba(uint8_t *planes, const yuv_layout *layout, const uint8_t *rgba, ptrdiff_t row_stride, uint32_t width, uint32_t height)
{
    size_t row_bytes = (size_t)width * 4;
    uint8_t *y_out = planes;
    uint8_t *blue_out = planes + (size_t)layout->width * layout->height;
    uint8_t *red_out = blue_out + (size_t)layout->chroma_width * layout->chroma_height;
    for (uint32_t y = 0; y < layout->height; y++) {
        const uint8_t *row = picture_row(rgba, row_bytes, row_stride, at_most(y, height - 1));
        for (uint32_t x = 0; x < layout->width; x++)
            *y_out++ = luma(row + 4 * (size_t)at_most(x, width - 1));
    }
    for (uint32_t y = 0; y < layout->chroma_height; y++) {
        uint32_t step = layout->full_chroma ? 1 : 2;
        const uint8_t *upper = picture_row(rgba, row_bytes, row_stride, at_most(step * y, height - 1));
        const uint8_t *lower = picture_row(rgba, row_bytes, row_stride, at_most(step * y + 1, height - 1));
        for (uint32_t x = 0; x < layout->chroma_width; x++) {
            rgb_sum sum =
                layout->full_chroma ? add_weighted((rgb_sum){0, 0, 0}, upper, at_most(x, width - 1), 1) : chroma_neighbourhood(upper, lower, x, width);
            int shift = layout->full_chroma ? 0 : 3;
            *blue_out++ = chroma_blue(sum, shift);
            *red_out++ = chroma_red(sum, shift);
        }
    }
}
