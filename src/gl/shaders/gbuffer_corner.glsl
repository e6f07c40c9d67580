/* SPDX-License-Identifier: MIT
 *
 * Corners of triangles, fetched by gl_VertexID. The number of a triangle follows from it, because Mesa's llvmpipe divides draws and starts gl_PrimitiveID again
 * in every part.
 */
#include "gbuffer.glsl"

layout(binding = 1) uniform samplerBuffer vertex_table;
layout(binding = 2) uniform usamplerBuffer index_table;

vec3 position_of(int corner)
{
    vec3 position = texelFetch(vertex_table, 2 * int(texelFetch(index_table, corner).r)).xyz;
    return vec3(position.x + gbuffer_data.move_x, position.y, position.z + gbuffer_data.move_z);
}

vec3 corner_position() { return position_of(gl_VertexID); }
