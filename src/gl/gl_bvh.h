/* SPDX-License-Identifier: MIT
 * A tree of boxes over a world's triangles, as shaders walk it: see bvh.glsl. */
#ifndef MANGATA_GL_GL_BVH_H
#define MANGATA_GL_GL_BVH_H

#include "frame/backend.h"
#include "frame/world.h"
#include "kernels/common/constants.h"

/*
 * One list of texels of four numbers: nodes of four texels, the root first, then leaves of one. A node:
 *     left low x, y, z, left child      left high x, y, z, right child      right low x, y, z, 0      right high x, y, z, 0
 * with floats by their bits; a box is wider than its triangles by what rounding may be off by. A child is the texel where a node begins, or
 * BVH_LEAF + the texel of a leaf: up to four triangles in rising order, then BVH_NOTHING. There is a root always, if need be of empty leaves.
 * No path from the root passes through more than BVH_LEVELS nodes, so that a walk that puts off one child a node needs room for as many.
 */

typedef struct gl_bvh {
    size_t node_count, leaf_count, texel_count;
    uint32_t (*texels)[4];
} gl_bvh;

/* The same tree whatever the pool's threads. Beside the tree it takes 28 bytes a triangle and as much again as the tree while it is built. */
mgt_status gl_bvh_build(gl_bvh *out, const world *w, thread_pool *pool);
void gl_bvh_free(gl_bvh *b);

#endif
