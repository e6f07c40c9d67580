/* SPDX-License-Identifier: MIT
 *
 * Where lean.k finds the map of slope moments. Of level 0 only slopes are kept: its moments are their products.
 */
#include "kernels/baselines/lean_types.k"
#include "kernels/baselines/lean_moments.k"

layout(std140) uniform LeanBlock { LeanData lean_data; };
uniform sampler2D lean_mean_texture;
uniform sampler2D lean_square_texture; /* from level 1 on */
#define LEAN(cx) lean_data

vec2 LEAN_MEAN(int cx, float level, float column, float row) { return texelFetch(lean_mean_texture, ivec2(int(column), int(row)), int(level)).rg; }

vec3 LEAN_SQUARE(int cx, float level, float column, float row)
{
    if (level < 0.5f)
        return point_moments(0, LEAN_MEAN(0, level, column, row)).square;
    return texelFetch(lean_square_texture, ivec2(int(column), int(row)), int(level) - 1).rgb;
}
