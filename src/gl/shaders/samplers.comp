/* SPDX-License-Identifier: MIT
 *
 * Reads textures of all units: see set_samplers() of gl_renderer.c.
 */
layout(local_size_x = 1) in;
layout(binding = 0) uniform sampler2D textures[16];
layout(binding = 0) writeonly uniform image2D sum_image;

void main()
{
    float sum = 0.0f;
    for (int i = 0; i < 16; i++)
        sum += texelFetch(textures[i], ivec2(0), 0).r;
    imageStore(sum_image, ivec2(0), vec4(sum));
}
