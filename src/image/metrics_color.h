/* SPDX-License-Identifier: MIT */
/* Colour functions that metrics of displayed pictures share: sRGB's transfer curve and its luminance. */
#ifndef MANGATA_IMAGE_METRICS_COLOR_H
#define MANGATA_IMAGE_METRICS_COLOR_H

#include <math.h>

/* The transfer curve of IEC 61966-2-1. Values above 1 continue its curve, values below 0 its straight part. */
static inline float color_srgb_decode(float value) { return value <= 0.04045f ? value / 12.92f : powf((value + 0.055f) / 1.055f, 2.4f); }

static inline float color_srgb_encode(float value) { return value <= 0.0031308f ? value * 12.92f : 1.055f * powf(value, 1.0f / 2.4f) - 0.055f; }

/* Relative luminance Y of linear light, which is 1 for white. With one channel the value itself is the luminance. */
static inline float color_luminance(const float *pixel, unsigned channels)
{
    return channels == 1 ? pixel[0] : 0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2];
}

static inline float color_clamp(float value) { return fminf(fmaxf(value, 0.0f), 1.0f); }

#endif
