/* SPDX-License-Identifier: MIT
 * The bounding volume hierarchy over a world's triangles, in the form that shaders read: see bvh.glsl. */
#ifndef MANGATA_GL_GL_BVH_H
#define MANGATA_GL_GL_BVH_H

#include "frame/backend.h"
#include "frame/world.h"
#include "kernels/common/constants.h"

/*
 * One list of texels of four numbers. It holds the nodes, of four texels each and the root first, then the leaves, of one texel each. A node is
 *     left low x, y, z, left child      left high x, y, z, right child      right low x, y, z, 0      right high x, y, z, 0
 * with floats stored by their bits. A box is wider than its triangles by the error that rounding may have. A child is the first texel of a node, or BVH_LEAF +
 * the texel of a leaf. A leaf holds up to BVH_LEAF_TRIANGLES triangles in rising order; BVH_NOTHING fills the rest. There always is a root, with empty leaves if
 * there are no triangles. A path from the root passes at most BVH_LEVELS nodes, so a traversal that postpones one child per node needs room for so many.
 */

typedef struct gl_bvh {
    size_t node_count, leaf_count, texel_count;
    uint32_t (*texels)[4];
} gl_bvh;

/* Builds the tree of `w` into `out`, which the caller frees with gl_bvh_free(). The tree does not depend on the number of the pool's threads. Besides the tree
 * the build temporarily needs 28 bytes per triangle and as much memory as the tree. Returns MGT_OK or MGT_ERROR_MEMORY. */
mgt_status gl_bvh_build(gl_bvh *out, const world *w, thread_pool *pool);
void gl_bvh_free(gl_bvh *b);

#endif
