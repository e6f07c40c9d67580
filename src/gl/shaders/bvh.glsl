/* SPDX-License-Identifier: MIT
 *
 * The nearest triangle that a ray meets, by the tree of boxes that gl_bvh.h describes.
 */

layout(binding = 14) uniform usamplerBuffer tree_table;

struct TreeHit {
    int triangle; /* −1: nothing */
    float along;  /* multiple of the ray's direction; +inf: nothing */
};

/* A ray, prepared for tests against boxes. The tests widen each box by the rounding error that the ray's origin may have. */
struct TreeRay {
    vec3 low;     /* origin, for the sides of boxes with the lower coordinates */
    vec3 high;    /* origin, for the sides with the higher coordinates */
    vec3 inverse; /* of the direction; no component is infinite */
};

TreeRay tree_ray(vec3 from, vec3 direction)
{
    vec3 least = vec3(direction.x < 0.0f ? -1e-18f : 1e-18f, direction.y < 0.0f ? -1e-18f : 1e-18f, direction.z < 0.0f ? -1e-18f : 1e-18f);
    vec3 slack = 2.4e-7f * abs(from);
    return TreeRay(from + slack, from - slack, 1.0f / mix(direction, least, lessThan(abs(direction), vec3(1e-18f))));
}

/* Multiple of the direction at which a ray enters a box; +inf: it misses the box or enters it beyond `most`. */
float enter_box(vec3 low, vec3 high, TreeRay r, float most)
{
    vec3 a = (low - r.low) * r.inverse, b = (high - r.high) * r.inverse;
    vec3 first = min(a, b), last = max(a, b);
    float begin = max(max(first.x, first.y), max(first.z, 0.0f));
    float end = min(min(last.x, last.y), min(last.z, most));
    return begin <= end * 1.0000005f ? begin : INFINITE;
}

/* The side of the line from p to q on which a ray from the origin passes, as the signed volume that both span. Its rounding error is below 6e-7 times the
 * product of |q − p|, |q + p| and the ray's length. With p and q exchanged, the result is exactly the negative. */
float side_of_edge(vec3 p, vec3 q, vec3 direction)
{
    vec3 along = q - p, sum = q + p;
    precise float x = along.y * sum.z - along.z * sum.y;
    precise float y = along.z * sum.x - along.x * sum.z;
    precise float z = along.x * sum.y - along.y * sum.x;
    precise float side = x * direction.x + y * direction.y + z * direction.z;
    return side;
}

/* Multiple of the direction at which a ray meets a triangle; +inf: it does not. */
float cross_triangle(int triangle, vec3 from, vec3 direction)
{
    ivec3 corner = triangle_corners(triangle);
    vec3 a = texelFetch(vertex_table, 2 * corner.x).xyz - from;
    vec3 b = texelFetch(vertex_table, 2 * corner.y).xyz - from;
    vec3 c = texelFetch(vertex_table, 2 * corner.z).xyz - from;
    float u = side_of_edge(a, b, direction), v = side_of_edge(b, c, direction), w = side_of_edge(c, a, direction);
    /* Rounding errors are allowed for, so that no ray slips through where triangles meet. */
    vec3 e = b - a, f = c - a;
    float longest = 4.0f * max(dot(e, e), dot(f, f)), farthest = 4.0f * max(dot(a, a), max(dot(b, b), dot(c, c)));
    float slack = 6e-7f * sqrt(longest * farthest * dot(direction, direction));
    if (min(min(u, v), w) < -slack && max(max(u, v), w) > slack)
        return INFINITE;
    vec3 normal = cross(e, f);
    float closing = dot(normal, direction);
    float along = dot(normal, a) / (closing != 0.0f ? closing : 1.0f);
    return closing != 0.0f && along >= 0.0f ? along : INFINITE;
}

/* The nearer of `best` and the hits of a leaf. Of triangles at the same distance the one of the lowest index counts, so that the order of the traversal does
 * not matter. */
TreeHit nearer_of_leaf(TreeHit best, uint texel, vec3 from, vec3 direction)
{
    uvec4 triangles = texelFetch(tree_table, int(texel));
    for (int i = 0; i < BVH_LEAF_TRIANGLES; i++) {
        int triangle = int(triangles[i]);
        float along = triangle >= 0 ? cross_triangle(triangle, from, direction) : INFINITE;
        if (along < best.along || (along == best.along && triangle >= 0 && triangle < best.triangle))
            best = TreeHit(triangle, along);
    }
    return best;
}

/* The nearest triangle of the tree that the ray meets. */
TreeHit trace_nearest(vec3 from, vec3 direction)
{
    uint waiting[BVH_LEVELS]; /* each node of a path postpones at most one child */
    int depth = 0;
    uint at = 0u;
    TreeRay ray = tree_ray(from, direction);
    TreeHit best = TreeHit(-1, INFINITE);
    do {
        while ((at & BVH_LEAF) == 0u) {
            uvec4 a = texelFetch(tree_table, int(at)), b = texelFetch(tree_table, int(at) + 1);
            uvec4 c = texelFetch(tree_table, int(at) + 2), d = texelFetch(tree_table, int(at) + 3);
            float left = enter_box(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), ray, best.along);
            float right = enter_box(uintBitsToFloat(c.xyz), uintBitsToFloat(d.xyz), ray, best.along);
            bool both = max(left, right) < INFINITE;
            if (both)
                waiting[depth++] = left <= right ? b.w : a.w;
            if (both || min(left, right) < INFINITE)
                at = left <= right ? a.w : b.w;
            else
                at = depth > 0 ? waiting[--depth] : BVH_NOTHING;
        }
        if (at != BVH_NOTHING) {
            best = nearer_of_leaf(best, at & ~BVH_LEAF, from, direction);
            at = depth > 0 ? waiting[--depth] : BVH_NOTHING;
        }
    } while (at != BVH_NOTHING);
    return best;
}
