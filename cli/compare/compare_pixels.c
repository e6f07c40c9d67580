/* SPDX-License-Identifier: MIT */
/* Packing of pixels: half floats, differences, zlib. */
#include "cli/compare/compare_pixels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "cli/common/markup.h"

/* `value` as an IEEE half float, rounded to nearest. Values beyond its range become its largest number. NaN becomes 0. */
static uint16_t half_from_float(float value)
{
    const float most = 65504, least_normal = 0x1p-14f, magnitude = fabsf(value);
    const uint16_t sign = value < 0 ? 0x8000 : 0;
    if (!(magnitude > 0))
        return 0;
    if (magnitude >= most)
        return sign | 0x7bff;
    if (magnitude < least_normal)
        return sign | (uint16_t)lrintf(magnitude * 0x1p24f);
    int exponent;
    const float fraction = frexpf(magnitude, &exponent); /* magnitude = fraction · 2^exponent, fraction in [½, 1) */
    /* A mantissa that rounds up to 2048 correctly carries into the exponent. */
    return sign | (uint16_t)(((exponent + 14) << 10) + (int)lrintf(fraction * 2048) - 1024);
}

/* The bits of a pixel in channel number `channel` of the packed order: G, R − G, B − G. */
static uint16_t channel_bits(const float_image *image, float scale, size_t pixel, uint32_t channel)
{
    const float *value = image->pixels + pixel * image->channels;
    if (image->channels < 3)
        return half_from_float(value[channel] * scale);
    const uint16_t green = half_from_float(value[1] * scale);
    return channel == 0 ? green : (uint16_t)(half_from_float(value[channel == 1 ? 0 : 2] * scale) - green);
}

char *pixels_pack(const float_image *image, float scale, size_t *length)
{
    const size_t pixels = (size_t)image->width * image->height, values = pixels * image->channels;
    uint8_t *planes = malloc(2 * values);
    uLongf packed_size = compressBound(2 * values);
    uint8_t *packed = malloc(packed_size);
    char *text = NULL;
    *length = 0;
    if (!planes || !packed)
        goto done;
    for (uint32_t c = 0; c < image->channels; c++) {
        uint16_t left = 0, first_above = 0;
        for (size_t i = 0; i < pixels; i++) {
            const bool first = i % image->width == 0;
            const uint16_t bits = channel_bits(image, scale, i, c), difference = (uint16_t)(bits - (first ? first_above : left));
            if (first)
                first_above = bits;
            left = bits;
            planes[c * pixels + i] = (uint8_t)(difference >> 8);
            planes[values + c * pixels + i] = (uint8_t)difference;
        }
    }
    if (compress2(packed, &packed_size, planes, 2 * values, Z_BEST_COMPRESSION) == Z_OK)
        text = base64_text(packed, packed_size, length);
done:
    free(planes);
    free(packed);
    return text;
}
