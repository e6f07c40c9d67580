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

bool shows_back(int t)
{
    vec3 p = position_of(3 * t);
    return dot(cross(position_of(3 * t + 1) - p, position_of(3 * t + 2) - p), vec3(0.0f, picture_data.eye_height, 0.0f) - p) < 0.0f;
}

void main()
{
    vec3 p = corner_position();
    triangle = gl_VertexID / 3;
    gl_Position = clip_of(straight_image(0, p));
    gl_ClipDistance[0] = gbuffer_data.drop_backs != 0 && shows_back(triangle) ? -1.0f : clip_distance_of(p);
}
