/* SPDX-License-Identifier: MIT
 *
 * Objects drawn where they are.
 */
#include "gbuffer_corner.glsl"

layout(location = 0) flat out int triangle;

out gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[1];
};

void main()
{
    vec3 p = corner_position();
    triangle = gl_VertexID / 3;
    gl_Position = clip_of(straight_image(0, p));
    gl_ClipDistance[0] = clip_distance_of(p);
}
