/* SPDX-License-Identifier: MIT
 * The null backend: takes every checked call and fills the targets with zero, so that a host can test its own side of the API. */
#include <string.h>

#include "frame/backend.h"
#include "frame/targets.h"

static mgt_status null_create(void **state, const mgt_context_desc *desc, const reporter *r, mgt_context_info *info)
{
    (void)desc, (void)r;
    *state = NULL;
    info->backend = MGT_BACKEND_NULL;
    info->isa = MGT_ISA_SCALAR;
    info->lanes = 1;
    info->threads = 1;
    return MGT_OK;
}

static void null_destroy(void *state) { (void)state; }

static mgt_status null_render(void *state, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    (void)state, (void)r;
    const region area = image_region(&scene->image);
    for (size_t i = 0; i < count; i++)
        for (uint32_t y = 0; y < area.height; y++)
            memset(target_row(&targets[i], &area, y), 0, format_size(targets[i].format) * area.width);
    return MGT_OK;
}

const backend_functions null_backend = {.create = null_create, .destroy = null_destroy, .render = null_render};
