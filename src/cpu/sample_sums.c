/* SPDX-License-Identifier: MIT
 * Exact sums of the point samples of a tile. */
#include "cpu/sample_sums.h"

void sample_sums_clear(sample_sums *sums) { memset(sums, 0, sizeof *sums); }

void sample_sums_settle(sample_sums *sums)
{
    for (size_t plane = 0; plane < EXACT_COUNT; plane++) {
        sample_terms *t = &sums->planes[plane];
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            const exact_sum high = (exact_sum)(int64_t)(t->high[i] * 0x1p8) << (EXACT_SUM_BITS - 8), low = (exact_sum)(int64_t)(t->low[i] * 0x1p56);
            exact_add(sums->words + SAMPLE_SUM_WORDS * i + 2 * plane, high + low);
        }
    }
    memset(sums->planes, 0, sizeof sums->planes);
    sums->terms = 0;
}

void sample_sums_add(sample_sums *sums, const lane_kernels *kernels, const tile_pixels *pixels, bool color, bool foam)
{
    const float *const values[EXACT_COUNT] = {pixels->red, pixels->green, pixels->blue, pixels->coverage, pixels->water, pixels->foam};
    for (size_t plane = color ? EXACT_RED : EXACT_COVERAGE; plane < (foam ? EXACT_COUNT : EXACT_FOAM); plane++)
        kernels->sum(values[plane], &sums->planes[plane]);
    if (++sums->terms == SAMPLE_TERMS_MOST)
        sample_sums_settle(sums);
}

void sample_sums_exchange(sample_sums *sums, const picture_sums *picture, uint32_t tile_x, uint32_t tile_y)
{
    const region *crop = &picture->crop;
    for (uint32_t i = 0; i < TILE_PIXELS && (picture->add || picture->show); i++) {
        const uint32_t x = tile_x * TILE_WIDTH + i % TILE_WIDTH, y = tile_y * TILE_HEIGHT + i / TILE_WIDTH;
        if (x < crop->x || y < crop->y || x - crop->x >= crop->width || y - crop->y >= crop->height)
            continue;
        const size_t at = ((size_t)(y - crop->y) * crop->width + x - crop->x) * SAMPLE_SUM_WORDS;
        uint64_t *own = sums->words + (size_t)i * SAMPLE_SUM_WORDS;
        if (picture->show)
            memcpy(own, picture->show + at, SAMPLE_SUM_WORDS * sizeof *own);
        for (size_t k = 0; picture->add && k < SAMPLE_SUM_WORDS; k += 2)
            exact_add(picture->add + at + k, exact_load(own + k));
    }
}

void sample_sums_mean(const sample_sums *sums, uint64_t count, tile_pixels *out)
{
    float *const values[EXACT_COUNT] = {out->red, out->green, out->blue, out->coverage, out->water, out->foam};
    for (size_t plane = 0; plane < EXACT_COUNT; plane++)
        for (size_t i = 0; i < TILE_PIXELS; i++)
            values[plane][i] = (float)exact_mean(exact_load(sums->words + SAMPLE_SUM_WORDS * i + 2 * plane), (double)count);
}
