/* SPDX-License-Identifier: MIT
 *
 * The next coarser level of the map of slope moments. The textures' base level is the finer one; of level 0 the second moments are products.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/baselines/lean_moments.k"

precision highp sampler2D;
uniform sampler2D lean_mean_texture;
uniform sampler2D lean_square_texture;
uniform int level; /* that is made */
layout(location = 0) out vec4 mean;
layout(location = 1) out vec4 square;

LeanMoments moments_at(ivec2 finer)
{
    vec2 mean = texelFetch(lean_mean_texture, finer, 0).rg;
    if (level == 1)
        return point_moments(0, mean);
    return LeanMoments(mean, texelFetch(lean_square_texture, finer, 0).rgb);
}

void main()
{
    ivec2 finer = 2 * ivec2(gl_FragCoord.xy);
    LeanMoments m = coarser_moments(0, moments_at(finer), moments_at(finer + ivec2(1, 0)), moments_at(finer + ivec2(0, 1)), moments_at(finer + ivec2(1)));
    mean = vec4(m.mean, 0.0f, 0.0f);
    square = vec4(m.square, 0.0f);
}
