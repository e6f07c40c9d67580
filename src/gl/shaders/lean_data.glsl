/* SPDX-License-Identifier: MIT
 *
 * Accessors of the map of slope moments. Level 0 stores slopes alone, and its second moments are their products.
 */
#include "kernels/baselines/lean_types.k"
#include "kernels/baselines/lean_moments.k"

layout(std140, binding = 3) uniform LeanBlock { LeanData lean_data; };
layout(binding = 1) uniform sampler2D mean_texture;
layout(binding = 2) uniform sampler2D square_texture; /* from level 1 on */
#define LEAN(cx) lean_data

vec2 LEAN_MEAN(int cx, float level, float column, float row)
{
    return texelFetch(mean_texture, ivec2(int(column), int(row)), int(level)).rg;
}

vec3 LEAN_SQUARE(int cx, float level, float column, float row)
{
    if (level < 0.5f)
        return point_moments(0, LEAN_MEAN(0, level, column, row)).square;
    return texelFetch(square_texture, ivec2(int(column), int(row)), int(level) - 1).rgb;
}
