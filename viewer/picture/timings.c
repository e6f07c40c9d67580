/* SPDX-License-Identifier: MIT
 * Rings of the times of the last frames. */
#include "viewer/picture/timings.h"

#include <stdlib.h>
#include <string.h>

void timing_add(timing_ring *ring, double seconds)
{
    ring->ms[ring->next] = (float)(1e3 * seconds);
    ring->next = (ring->next + 1) % TIMING_FRAMES;
    ring->count += ring->count < TIMING_FRAMES;
}

float timing_at(const timing_ring *ring, int i) { return ring->ms[(ring->next - ring->count + i + TIMING_FRAMES) % TIMING_FRAMES]; }

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

float timing_median(const timing_ring *ring)
{
    float sorted[TIMING_FRAMES];
    if (ring->count == 0)
        return 0;
    memcpy(sorted, ring->ms, (size_t)ring->count * sizeof *sorted);
    qsort(sorted, (size_t)ring->count, sizeof *sorted, compare_floats);
    return sorted[ring->count / 2];
}
