/* SPDX-License-Identifier: MIT */
/* Pixels against their neighbourhood in the truth; see metrics_specks.h. */
#include "image/metrics_specks.h"

#include <math.h>
#include <stddef.h>

static bool counts(const specks_input *input, size_t pixel) { return !input->counted || input->counted[pixel]; }

static bool is_speck(const specks_input *input, uint32_t x, uint32_t y)
{
    const uint32_t left = x > 0 ? x - 1 : 0, right = x + 1 < input->width ? x + 1 : x;
    const uint32_t top = y > 0 ? y - 1 : 0, bottom = y + 1 < input->height ? y + 1 : y;
    const float value = input->picture[(size_t)y * input->width + x];
    float least = INFINITY, greatest = -INFINITY;
    for (uint32_t row = top; row <= bottom; row++)
        for (uint32_t column = left; column <= right; column++) {
            const size_t pixel = (size_t)row * input->width + column;
            if (!counts(input, pixel))
                continue;
            least = fminf(least, input->truth[pixel]);
            greatest = fmaxf(greatest, input->truth[pixel]);
        }
    return least - value > SPECKS_DISTANCE || value - greatest > SPECKS_DISTANCE;
}

uint64_t specks_count(const specks_input *input)
{
    uint64_t count = 0;
    for (uint32_t y = 0; y < input->height; y++)
        for (uint32_t x = 0; x < input->width; x++)
            count += counts(input, (size_t)y * input->width + x) && is_speck(input, x, y);
    return count;
}
