/* SPDX-License-Identifier: MIT
 *
 * Objects drawn where they are.
 */
#include "gbuffer_corner.glsl"
#include "kernels/refraction/edges.k"

layout(location = 0) flat out int triangle;

out gl_PerVertex {
    vec4 gl_Position;
    float gl_ClipDistance[1];
};

/* Whether triangle t shows the camera its back and is left out for that. */
bool shows_inside(int t)
{
    return gbuffer_data.drop_backs != 0 &&
           shows_back(0, position_of(3 * t), position_of(3 * t + 1), position_of(3 * t + 2), vec3(0.0f, picture_data.eye_height, 0.0f));
}

void main()
{
    vec3 p = corner_position();
    triangle = gl_VertexID / 3;
    gl_Position = clip_of(straight_image(0, p));
    gl_ClipDistance[0] = shows_inside(triangle) ? -1.0f : clip_distance_of(p);
}
