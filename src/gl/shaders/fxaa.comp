/* SPDX-License-Identifier: MIT
 *
 * Method `fxaa`: finds edges in the displayed picture of method `none` and reads every pixel a little across its edge.
 */
#include "blend.glsl"

layout(binding = 4) uniform sampler2D luma_texture;

float LUMA(int cx, float column, float row)
{
    return texelFetch(luma_texture, clamp(ivec2(int(column), int(row)), ivec2(0), blend_size() - 1), 0).r;
}

#include "kernels/display/fxaa.k"

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, blend_size())))
        return;
    FxaaShift s = shift_across_edge(0, float(texel.x), float(texel.y));
    ivec2 from = texel + ivec2(int(s.dx), int(s.dy));
    if (any(lessThan(from, ivec2(0))) || any(greaterThanEqual(from, blend_size())))
        from = texel;
    store_blend(texel, blend_lerp(0, pixel_of_current(texel), pixel_of_current(from), s.amount));
}
