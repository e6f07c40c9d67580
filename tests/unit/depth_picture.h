/* SPDX-License-Identifier: MIT
 * The layer of depth, drawn by the CPU. */
#ifndef MANGATA_TESTS_UNIT_DEPTH_PICTURE_H
#define MANGATA_TESTS_UNIT_DEPTH_PICTURE_H

#include "mangata/mangata.h"

/* `depth`: a float for each of the scene's pixels. */
static inline void render_depth(const mgt_scene *scene, float *depth)
{
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, NULL), MGT_OK);
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.layer = MGT_LAYER_DEPTH;
    target.format = MGT_FORMAT_R32F;
    target.pixels = depth;
    assert_int_equal(mgt_render(context, scene, &target, 1), MGT_OK);
    mgt_context_destroy(context);
}

#endif
