/* SPDX-License-Identifier: MIT
 * A frame taken apart: its tiles rendered one by one, by any build of the kernels, on the caller's thread. */
#include "tile_frame.h"

#include <stdlib.h>

tile_frame *tile_frame_create(const mgt_scene *scene)
{
    tile_frame *f = calloc(1, sizeof *f);
    if (!f)
        return NULL;
    f->sky = sky_state_create();
    f->waves = calloc(1, sizeof *f->waves);
    if (!f->sky || !f->waves || sky_state_build(f->sky, &scene->sky, &scene->light) != MGT_OK) {
        tile_frame_free(f);
        return NULL;
    }
    frame_make(scene, f->sky, true, &f->frame);
    frame_waves_build(&f->frame, f->waves);
    f->columns = (scene->image.width + TILE_WIDTH - 1) / TILE_WIDTH;
    f->rows = (scene->image.height + TILE_HEIGHT - 1) / TILE_HEIGHT;
    return f;
}

void tile_frame_free(tile_frame *f)
{
    if (!f)
        return;
    sky_state_destroy(f->sky);
    free(f->waves);
    free(f);
}

void tile_frame_render(const tile_frame *f, const lane_kernels *kernels, tile_scratch *scratch)
{
    const tile_job job = {.frame = &f->frame, .waves = f->waves, .kernels = kernels, .sky = f->sky->table, .wants = {.pixels = true}};
    for (uint32_t y = 0; y < f->rows; y++)
        for (uint32_t x = 0; x < f->columns; x++)
            tile_render(&job, x, y, scratch);
}
