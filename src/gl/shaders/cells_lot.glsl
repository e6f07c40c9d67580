/* SPDX-License-Identifier: MIT
 *
 * A number in [0, 1) that is a leaf's own, for one seed; bit for bit that of leaf_lot() in src/cpu/refinement.c.
 */
#include "jitter.glsl"

double leaf_lot(int tile, Leaf l, uvec2 seed)
{
    uvec2 key = mix_64(seed ^ mix_64(uvec2(uint(tile), 0u)));
    key = mix_64(key ^ uvec2(uint(l.halvings.x) << 8 | uint(l.halvings.y), 0u));
    key = mix_64(key ^ uvec2(uint(l.place.y), uint(l.place.x)));
    uvec2 upper = uvec2(key.x >> 11 | key.y << 21, key.y >> 11);
    return (double(upper.y) * 4294967296.0lf + double(upper.x)) / 9007199254740992.0lf;
}
