/* SPDX-License-Identifier: MIT
 *
 * Computes level 0 of the map of slope moments. An invocation computes ROWS rows of one column. For each wave it computes the sine and cosine of two phases,
 * and then a rotation from row to row.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/waves/sines_types.k"
#include "kernels/common/math.k"
#include "kernels/waves/lean_grid.k"

layout(std140, binding = 3) uniform LeanPassBlock { LeanPass lean_pass; };
#if defined(SOFTWARE_GL) && !defined(MANY_WAVES)
layout(std140, binding = 1) uniform LeanWaveBlock { LeanWave lean_waves[BLOCK_WAVES]; };
#else
layout(std430, binding = 6) restrict readonly buffer LeanWaveBlock { LeanWave lean_waves[]; };
#endif
layout(binding = 0) writeonly uniform image2D mean_image;

const int ROWS = 16;
layout(local_size_x = 64) in;

void main()
{
    int column = int(gl_GlobalInvocationID.x);
    int first_row = int(gl_WorkGroupID.y) * ROWS;
    vec2 slopes[ROWS];
    for (int r = 0; r < ROWS; r++)
        slopes[r] = vec2(0.0f);
    for (int i = 0; i < lean_pass.wave_count; i++) {
        LeanWave w = lean_waves[i];
        SinCos t = sincos_turns(0, grid_phase(0, w, w.turns, column, first_row));
        SinCos row = sincos_turns(0, grid_row_turns(0, w));
        for (int r = 0; r < ROWS; r++) {
            slopes[r] = grid_slopes(0, slopes[r], w, t.c);
            float sine = fma(t.s, row.c, t.c * row.s);
            t.c = grid_cosine(0, t.c, t.s, row.c, -row.s);
            t.s = sine;
        }
    }
    for (int r = 0; r < ROWS; r++)
        imageStore(mean_image, ivec2(column, first_row + r), vec4(slopes[r], 0.0f, 0.0f));
}
