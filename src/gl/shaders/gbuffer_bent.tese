/* SPDX-License-Identifier: MIT
 *
 * Places the points of a split triangle where they are seen.
 */
#include "gbuffer.glsl"

layout(triangles, equal_spacing, ccw) in;

layout(location = 0) in vec3 patch_corner[];
layout(location = 1) patch in int patch_triangle;

layout(location = 0) flat out int triangle;

out gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[1];
};

void main()
{
    triangle = patch_triangle;
    /* On an edge, both its triangles sum the same two products, so that they have the same points. */
    precise vec3 p = (gl_TessCoord.x * patch_corner[0] + gl_TessCoord.y * patch_corner[1]) + gl_TessCoord.z * patch_corner[2];
    gl_Position = clip_of(far_image(0, p));
    gl_ClipDistance[0] = clip_distance_of(p);
}
