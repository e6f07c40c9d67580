/* SPDX-License-Identifier: MIT
 *
 * The pool of leaves of method adaptive. The leaves of a tile lie one after the other. A round moves them from one side of the pool to the other.
 *
 * A leaf is three vectors. The first one holds column and row, in cells of the leaf's size from the tile's corner, with the halvings in their upper bits, then
 * how the leaf goes on, then `places`. The second one holds colour and coverage. The third one holds water, height, variance and contrast.
 */
#include "cells_state.glsl"

layout(std430, binding = 4) buffer LeafBlock { uvec4 leaves[]; };

const uint NO_LEAF = 0xffffffffu; /* in place of the column: the pixel lies outside of the picture */
const int PLACE_BITS = 22, HALVINGS_BITS = 5;
const uint KEEPS = 1u << 31; /* in the column's word: the new cell keeps something of its leaf, see leaf_kept() */
const uint SPLIT_MASK = 3u; /* how the leaf goes on: SPLIT_… in these bits, then the step of its points, CHOSEN and the bucket */
const int POINTS_SHIFT = 2;
const uint CHOSEN = 16u;
const int BUCKET_SHIFT = 8;

struct Leaf {
    ivec2 place;    /* column and row */
    ivec2 halvings; /* across and down */
    int split;
    float points; /* 0, 256, 1024 or 4096 */
    int bucket;
    float places;
    vec3 color;
    float coverage;
    float water, height, variance, contrast;
};

int leaf_level(Leaf l) { return (l.halvings.x + l.halvings.y) / 2; }
float leaf_area(int level) { return ldexp(1.0f, -2 * level); }

/* The leaf's pixel in the tile. */
ivec2 leaf_pixel(Leaf l) { return ivec2(l.place.x >> l.halvings.x, l.place.y >> l.halvings.y); }

uvec2 packed_place(ivec2 place, ivec2 halvings) { return uvec2(place) | uvec2(halvings) << PLACE_BITS; }

float points_of(uint how)
{
    uint step = how >> POINTS_SHIFT & 3u;
    return step == 0u ? 0.0f : float(LEAF_LEAST_POINTS << int(2u * (step - 1u)));
}

uint points_step(float points) { return points == 0.0f ? 0u : points < float(LEAF_LEAST_POINTS * 4) ? 1u : points < float(LEAF_MOST_POINTS) ? 2u : 3u; }

Leaf leaf_from(uvec4 first, uvec4 second, uvec4 third)
{
    Leaf l;
    l.halvings = ivec2(first.xy >> PLACE_BITS & ((1u << HALVINGS_BITS) - 1u));
    l.place = ivec2(first.xy & ((1u << PLACE_BITS) - 1u));
    l.split = int(first.z & SPLIT_MASK);
    l.points = points_of(first.z);
    l.bucket = int(first.z >> BUCKET_SHIFT);
    l.places = uintBitsToFloat(first.w);
    vec4 b = uintBitsToFloat(second), c = uintBitsToFloat(third);
    l.color = b.xyz;
    l.coverage = b.w;
    l.water = c.x;
    l.height = c.y;
    l.variance = c.z;
    l.contrast = c.w;
    return l;
}

Leaf leaf_at(int i) { return leaf_from(leaves[LEAF_VECTORS * i], leaves[LEAF_VECTORS * i + 1], leaves[LEAF_VECTORS * i + 2]); }

void set_leaf(int i, Leaf l)
{
    uint how = uint(l.split) | points_step(l.points) << POINTS_SHIFT | uint(l.bucket) << BUCKET_SHIFT;
    leaves[LEAF_VECTORS * i] = uvec4(packed_place(l.place, l.halvings), how, floatBitsToUint(l.places));
    leaves[LEAF_VECTORS * i + 1] = floatBitsToUint(vec4(l.color, l.coverage));
    leaves[LEAF_VECTORS * i + 2] = floatBitsToUint(vec4(l.water, l.height, l.variance, l.contrast));
}
