/* SPDX-License-Identifier: MIT
 *
 * One triangle over the whole viewport.
 */
layout(location = 0) out vec2 place; /* in the viewport, (0, 0) top left, (1, 1) bottom right */

void main()
{
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0f : -1.0f, gl_VertexID == 2 ? 3.0f : -1.0f);
    gl_Position = vec4(corner, 0.0f, 1.0f);
    place = vec2(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
}
