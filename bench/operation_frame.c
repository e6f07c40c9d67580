/* SPDX-License-Identifier: MIT
 * Floating-point operations of a `mangata` frame, counted by the instrumented kernels at one lane. */
#include "operation_frame.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tile_frame.h"

extern const lane_kernels counting_lane_kernels;

double flops(const operation_count *n) { return (double)n->add + (double)n->multiply + 2.0 * (double)n->fused + (double)n->divide + (double)n->square_root; }

/* Whether the instrumented kernels give the plain ones' pixels, to the bit. */
static bool same_pixels(const tile_job *job, uint32_t x, uint32_t y, const tile_pixels *counted, tile_scratch *scratch)
{
    tile_job plain = *job;
    plain.kernels = &lane_kernels_1;
    tile_render(&plain, x, y, scratch);
    return memcmp(counted, &scratch->pixels, sizeof *counted) == 0;
}

bool count_frame(const mgt_scene *scene, stage_count *out)
{
    *out = (stage_count){0};
    tile_frame *f = tile_frame_create(scene);
    tile_scratch *s = calloc(2, sizeof *s);
    bool done = f && s;
    if (done) {
        operations_done = (operation_count){0};
        for (uint32_t i = 0; i < f->rows * f->columns; i++) {
            counting_lane_kernels.sort(&f->frame.data, &f->waves->shutter, &f->waves->shutter.view, i % f->columns, i / f->columns, &s->close);
            if (tile_sees_water(&s->close))
                counting_lane_kernels.estimate(&f->frame.data, &s->close, s->close_estimate);
        }
        out->lattice = operations_done;
        operations_done = (operation_count){0};
        const tile_job job = {.frame = &f->frame, .waves = f->waves, .kernels = &counting_lane_kernels, .sky = f->sky->table, .wants = {.pixels = true}};
        for (uint32_t i = 0; i < f->rows * f->columns; i++) {
            tile_render(&job, i % f->columns, i / f->columns, s);
            if (i % 37 == 0 && !same_pixels(&job, i % f->columns, i / f->columns, &s->pixels, s + 1)) {
                fprintf(stderr, "bench: the instrumented kernels give other pixels in tile %u\n", (unsigned)i);
                done = false;
            }
            for (uint32_t p = 0; p < TILE_PIXELS; p++)
                if (i % f->columns * TILE_WIDTH + p % TILE_WIDTH < scene->image.width && i / f->columns * TILE_HEIGHT + p / TILE_WIDTH < scene->image.height)
                    out->water += s->pixels.water[p];
        }
        out->all = operations_done;
    }
    free(s);
    tile_frame_free(f);
    return done;
}
