/* SPDX-License-Identifier: MIT
 * Marks the pixels of layers whose neighbours do not continue their surface, once per drawing. */
#include <stdlib.h>
#include <string.h>

#include "cpu/refraction_state.h"

/* gather_bytes() reads up to three bytes behind a table. */
enum { BYTES_BEYOND = 3 };

typedef struct mark_job {
    const refraction *r;
    const gbuffer *layer;
    uint8_t *marks;
    bool front;
} mark_job;

static void mark_row(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const mark_job *job = argument;
    const front_kernels *kernels = job->r->kernels->front;
    const uint32_t row = (uint32_t)index;
    uint8_t *out = job->marks + index * job->layer->width;
    if (!job->front)
        kernels->breaks(job->layer, job->r->planes, 1 / job->r->frame->data.pixel_angle, row, out);
    else if (row > 0 && row + 1 < job->layer->height)
        kernels->edges(job->layer, job->r->planes, job->r->world->object, row, out);
    else
        memset(out, 1, job->layer->width);
}

static bool mark(const refraction *r, const gbuffers *g, bool front, layer_marks *m, thread_pool *pool)
{
    if (m->bytes && m->drawn == g->drawn)
        return true;
    const gbuffer *layer = front ? &g->front : &g->refracted;
    const size_t size = (size_t)layer->width * layer->height + BYTES_BEYOND;
    if (size != m->size) {
        free(m->bytes);
        m->bytes = calloc(size, 1);
        m->size = m->bytes ? size : 0;
    }
    if (!m->bytes)
        return false;
    mark_job job = {r, layer, m->bytes, front};
    const thread_loop rows = {layer->height, mark_row, &job, NULL};
    thread_pool_run(pool, &rows);
    m->drawn = g->drawn;
    return true;
}

bool refraction_mark(refraction *r, thread_pool *pool)
{
    const bool certifies = r->frame->scene->quality.refraction <= MGT_REFRACTION_HYBRID;
    return mark(r, &r->direct, true, &r->edges, pool) && (!certifies || mark(r, &r->direct, false, &r->breaks[0], pool)) &&
           (!certifies || !r->frame->under || mark(r, &r->mirrored, false, &r->breaks[1], pool));
}

void refraction_marks_free(refraction *r)
{
    free(r->edges.bytes);
    free(r->breaks[0].bytes);
    free(r->breaks[1].bytes);
    r->edges = r->breaks[0] = r->breaks[1] = (layer_marks){0};
}
