/* SPDX-License-Identifier: MIT
 *
 * Corners of objects that are drawn where refraction by the flat mean surface shows them: where each corner is, and where it is seen.
 */
#include "gbuffer_corner.glsl"

layout(location = 0) out vec3 corner;
layout(location = 1) out vec3 corner_image;
layout(location = 2) flat out int corner_triangle;

void main()
{
    corner = corner_position();
    corner_image = far_image(0, corner);
    corner_triangle = gl_VertexID / 3;
}
