/* SPDX-License-Identifier: MIT
 *
 * One triangle over everything.
 */
void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0f : -1.0f, gl_VertexID == 2 ? 3.0f : -1.0f), 0.0f, 1.0f); }
