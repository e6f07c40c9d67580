/* SPDX-License-Identifier: MIT
 *
 * Glare by a blur pyramid.
 *
 * U takes a level to the next finer one by quadratic B-spline subdivision with the weights 3/4 and 1/4 (Chaikin 1974). Repeated, it gives a C¹ surface without
 * blocks. D takes a level to the next coarser one: D = m⁻¹·Uᵀ·m', where m' are the masses of the finer pixels and m = Uᵀ·m' those of the coarser ones. Then
 * Σ m·value is the same on all levels, also if an odd size leaves half a pixel over. So the picture's sum is kept exactly, and the whole spread is a symmetric
 * operator.
 *
 * Each level spreads light over an octave of angles. CIE's glare function falls as θ⁻³ near the source and as θ⁻² far from it. With θ^−2.5 an octave has 1/√2
 * of the light of the octave below it.
 */
#include "cpu/glare.h"
#include "kernels/common/constants.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/display/glare.k"

#define ROWS_PER_TASK 8
#define BLOCK 128 /* coarse pixels in a part of a row, so that scratch memory fits the first cache */

typedef float lanes __attribute__((vector_size(16)));

static lanes load(const float *from)
{
    lanes v;
    memcpy(&v, from, sizeof v);
    return v;
}

static void store(float *to, lanes v) { memcpy(to, &v, sizeof v); }

/* A level. Rows end with room for the fourth lane of the last pixel. */
typedef struct level {
    size_t width, height, stride;
    float *rgb;
    float *across, *down; /* four weights per column and per row, of the finer pixels 2i − 1 … 2i + 2 */
    float weight;
} level;

typedef struct pyramid {
    size_t count;
    level levels[GLARE_MAX_LEVELS];
    float kept; /* fraction of the image's light that is not spread */
    void *memory;
} pyramid;

/* ---- memory --------------------------------------------------------------------------------------------- */

static void size_levels(pyramid *p, const glare_plan *plan)
{
    p->count = plan->count;
    for (size_t k = 0; k < p->count; ++k) {
        p->levels[k].width = plan->sizes[k].width;
        p->levels[k].height = plan->sizes[k].height;
        p->levels[k].stride = 3 * plan->sizes[k].width + 4;
    }
}

static bool allocate_levels(pyramid *p, size_t width, size_t height)
{
    size_t total = 0;
    for (size_t k = 0; k < p->count; ++k) {
        const level *l = &p->levels[k];
        if (l->stride > SIZE_MAX / 64 / l->height) {
            return false;
        }
        total += l->stride * l->height + 5 * (l->width + l->height);
    }
    float *next = malloc(total * sizeof(float));
    if (!next) {
        return false;
    }
    p->memory = next;
    const float *mass_x = NULL, *mass_y = NULL;
    for (size_t k = 0; k < p->count; ++k) {
        level *l = &p->levels[k];
        l->rgb = next;
        next += l->stride * l->height;
        l->across = next;
        l->down = l->across + 4 * l->width;
        float *coarse_x = l->down + 4 * l->height, *coarse_y = coarse_x + l->width;
        next = coarse_y + l->height;
        glare_weigh_axis(k ? p->levels[k - 1].width : width, mass_x, l->width, l->across, coarse_x);
        glare_weigh_axis(k ? p->levels[k - 1].height : height, mass_y, l->height, l->down, coarse_y);
        mass_x = coarse_x;
        mass_y = coarse_y;
    }
    return true;
}

/* ---- down: D ---------------------------------------------------------------------------------------------- */

typedef struct down_job {
    const float *fine;
    size_t fine_width, fine_height, fine_stride;
    level *coarse;
} down_job;

static void down_row(const down_job *job, size_t row)
{
    const level *coarse = job->coarse;
    const float *weight = &coarse->down[4 * row];
    const float *source[4];
    for (int t = 0; t < 4; ++t) {
        source[t] = job->fine + (size_t)glare_finer(NULL, (int)row, t, (int)job->fine_height) * job->fine_stride;
    }
    float *out = coarse->rgb + row * coarse->stride;
    for (size_t from = 0; from < coarse->width; from += BLOCK) {
        size_t count = coarse->width - from < BLOCK ? coarse->width - from : BLOCK;
        float mixed[3 * (2 * BLOCK + 2) + 4];                                  /* fine pixels 2·from − 1 …, zero beyond the edges */
        size_t first = from ? 2 * from - 1 : 0, last = 2 * (from + count) + 1; /* one past */
        if (last > job->fine_width) {
            last = job->fine_width;
        }
        size_t offset = from ? 0 : 3, length = 3 * (last - first), i = 0;
        memset(mixed, 0, 3 * sizeof(float));
        const float *s0 = source[0] + 3 * first, *s1 = source[1] + 3 * first, *s2 = source[2] + 3 * first, *s3 = source[3] + 3 * first;
        for (; i + 4 <= length; i += 4) {
            store(mixed + offset + i, (weight[0] * load(s0 + i) + weight[1] * load(s1 + i)) + (weight[2] * load(s2 + i) + weight[3] * load(s3 + i)));
        }
        for (; i < length; ++i) {
            mixed[offset + i] = (weight[0] * s0[i] + weight[1] * s1[i]) + (weight[2] * s2[i] + weight[3] * s3[i]);
        }
        memset(mixed + offset + length, 0, sizeof mixed - (offset + length) * sizeof(float));
        for (size_t x = 0; x < count; ++x) {
            const float *w = &coarse->across[4 * (from + x)], *m = &mixed[6 * x];
            store(out + 3 * (from + x), (w[0] * load(m) + w[1] * load(m + 3)) + (w[2] * load(m + 6) + w[3] * load(m + 9)));
        }
    }
}

static void down_task(void *arg, size_t index)
{
    const down_job *job = arg;
    size_t end = (index + 1) * ROWS_PER_TASK;
    for (size_t row = index * ROWS_PER_TASK; row < end && row < job->coarse->height; ++row) {
        down_row(job, row);
    }
}

/* ---- up: fine := keep·fine + gain·U·coarse ---------------------------------------------------------------- */

typedef struct up_job {
    float *fine;
    size_t fine_width, fine_height, fine_stride;
    const level *coarse;
    float keep, gain;
} up_job;

static void up_row(const up_job *job, size_t row)
{
    const level *coarse = job->coarse;
    const size_t about = row / 2, beside = (size_t)glare_beside(NULL, (int)row, (int)coarse->height);
    const size_t even = 3 * (size_t)(1 + glare_side(NULL, 0)), odd = 3 * (size_t)(1 + glare_side(NULL, 1)); /* floats from the texel before */
    const float *a = coarse->rgb + about * coarse->stride, *b = coarse->rgb + beside * coarse->stride;
    float *fine = job->fine + row * job->fine_stride;
    float near_gain = GLARE_NEAR * job->gain, far_gain = GLARE_FAR * job->gain, keep = job->keep;
    for (size_t from = 0; from < coarse->width; from += BLOCK) {
        size_t count = coarse->width - from < BLOCK ? coarse->width - from : BLOCK;
        float mixed[3 * (BLOCK + 2) + 4], spread[6 * BLOCK + 4]; /* coarse pixels from − 1 … from + count, fine ones from 2·from */
        size_t first = from ? from - 1 : 0, last = from + count < coarse->width ? from + count + 1 : coarse->width;
        size_t offset = from ? 0 : 3, length = 3 * (last - first);
        for (size_t i = 0; i < length; i += 4) { /* the last vector reaches into the room at the rows' end */
            store(mixed + offset + i, near_gain * load(a + 3 * first + i) + far_gain * load(b + 3 * first + i));
        }
        const size_t left = (size_t)glare_beside(NULL, (int)(2 * from), (int)coarse->width) + 1 - from;
        const size_t right = (size_t)glare_beside(NULL, (int)(2 * (from + count) - 1), (int)coarse->width) + 1 - from;
        memmove(mixed, mixed + 3 * left, 3 * sizeof(float));
        memmove(mixed + 3 * (count + 1), mixed + 3 * right, 3 * sizeof(float));
        mixed[3 * (count + 2)] = 0.0f; /* the last pixel's fourth lane reads it, and its result is dropped */
        for (size_t x = 0; x < count; ++x) {
            const float *m = &mixed[3 * x];
            lanes centre = GLARE_NEAR * load(m + 3);
            store(spread + 6 * x, centre + GLARE_FAR * load(m + even));
            store(spread + 6 * x + 3, centre + GLARE_FAR * load(m + odd));
        }
        size_t end = 2 * (from + count) < job->fine_width ? 2 * (from + count) : job->fine_width;
        float *out = fine + 6 * from;
        size_t floats = 3 * end - 6 * from, i = 0;
        for (; i + 4 <= floats; i += 4) {
            store(out + i, keep * load(out + i) + load(spread + i));
        }
        for (; i < floats; ++i) {
            out[i] = keep * out[i] + spread[i];
        }
    }
}

static void up_task(void *arg, size_t index)
{
    const up_job *job = arg;
    size_t end = (index + 1) * ROWS_PER_TASK;
    for (size_t row = index * ROWS_PER_TASK; row < end && row < job->fine_height; ++row) {
        up_row(job, row);
    }
}

/* ---- interface ------------------------------------------------------------------------------------------ */

static void serial_for(void *user, size_t count, void (*body)(void *arg, size_t index), void *arg)
{
    (void)user;
    for (size_t i = 0; i < count; ++i) {
        body(arg, i);
    }
}

static size_t tasks(size_t rows) { return (rows + ROWS_PER_TASK - 1) / ROWS_PER_TASK; }

mgt_status glare_apply(float *rgb, size_t width, size_t height, size_t row_stride, float glare, glare_parallel_for parallel_for, void *user)
{
    pyramid p;
    memset(&p, 0, sizeof p);
    const glare_plan plan = glare_plan_of(width, height);
    if (glare > 0.0f) {
        size_levels(&p, &plan);
    }
    if (p.count == 0) {
        return MGT_OK;
    }
    if (!allocate_levels(&p, width, height)) {
        return MGT_ERROR_MEMORY;
    }
    glare_parallel_for run = parallel_for ? parallel_for : serial_for;
    float shares[GLARE_MAX_LEVELS];
    p.kept = glare_plan_fractions(&plan, glare, shares);
    for (size_t k = 0; k < p.count; ++k) {
        p.levels[k].weight = shares[k];
    }
    for (size_t k = 0; k < p.count; ++k) {
        const level *finer = k ? &p.levels[k - 1] : NULL;
        down_job job = {rgb, width, height, row_stride, &p.levels[k]};
        if (finer) {
            job = (down_job){finer->rgb, finer->width, finer->height, finer->stride, &p.levels[k]};
        }
        run(user, tasks(p.levels[k].height), down_task, &job);
    }
    float gain = p.levels[p.count - 1].weight;
    for (size_t k = p.count; k-- > 0; gain = 1.0f) {
        level *finer = k ? &p.levels[k - 1] : NULL;
        up_job job = {rgb, width, height, row_stride, &p.levels[k], p.kept, gain};
        if (finer) {
            job = (up_job){finer->rgb, finer->width, finer->height, finer->stride, &p.levels[k], finer->weight, gain};
        }
        run(user, tasks(job.fine_height), up_task, &job);
    }
    free(p.memory);
    return MGT_OK;
}
