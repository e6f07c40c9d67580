/* SPDX-License-Identifier: MIT
 *
 * The next coarser level of the map of slope moments. The textures' base level is the finer one; of level 0 the second moments are products.
 */
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D lean_mean_texture;
uniform sampler2D lean_square_texture;
uniform int level; /* that is made */
layout(location = 0) out vec4 mean;
layout(location = 1) out vec4 square;

void main()
{
    mean = vec4(0.0f);
    square = vec4(0.0f);
    for (int i = 0; i < 4; i++) {
        ivec2 finer = 2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1);
        vec2 slope = texelFetch(lean_mean_texture, finer, 0).rg;
        mean.xy += 0.25f * slope;
        if (level == 1)
            square.xyz += 0.25f * vec3(slope.x * slope.x, slope.x * slope.y, slope.y * slope.y);
        else
            square += 0.25f * texelFetch(lean_square_texture, finer, 0);
    }
}
