/* SPDX-License-Identifier: MIT */
/* Frames per second as the fraction that films and pictures record. */
#ifndef MANGATA_IMAGE_FRAME_RATE_H
#define MANGATA_IMAGE_FRAME_RATE_H

#include <stdint.h>

typedef struct frame_rate {
    uint32_t numerator, denominator;
} frame_rate;

/* The fraction of a rate from 0.01 to 1000: 30 → 30/1, 29.97 → 30000/1001, otherwise the nearest number of thousandths. */
frame_rate frame_rate_of(double frames_per_second);

#endif
