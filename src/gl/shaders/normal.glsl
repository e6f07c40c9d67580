/* SPDX-License-Identifier: MIT
 *
 * Access to the layer of normals.
 */
layout(binding = 4) writeonly uniform image2D normal_image;

/* Stores the unit normal of a slope; 0 if there is no water. */
void store_normal(ivec2 texel, vec2 slope, bool water)
{
    vec3 normal = normalize(vec3(-slope.x, 1.0f, -slope.y));
    imageStore(normal_image, texel, vec4(water ? normal : vec3(0.0f), 1.0f));
}
