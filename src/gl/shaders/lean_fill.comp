/* SPDX-License-Identifier: MIT
 *
 * Level 0 of the map of slope moments: a workgroup makes 64 columns of eight rows. By angle addition a wave costs a sine and cosine for each column and
 * for each row.
 */
#include "prelude_glsl.k"
#include "pass_data.k"
#include "math.k"

layout(std140, binding = 3) uniform LeanPassBlock { LeanPass lean_pass; };
layout(std430, binding = 4) readonly buffer LeanWaveBlock { LeanWave lean_waves[]; };
layout(binding = 0) writeonly uniform image2D mean_image;

const int SIZE = 4096; /* LEAN_SIZE */
const int ROWS = 8;
const int LANES = 64;
layout(local_size_x = 64) in;
shared vec2 row_phases[LANES * ROWS]; /* cosine and sine of 64 waves */

/* Turns of so many periods across the map at a texel; whole ones are left out. */
float turns_at(int periods, int texel) { return float(periods * texel & (SIZE - 1)) * (1.0f / float(SIZE)); }

void main()
{
    int lane = int(gl_LocalInvocationID.x);
    int column = int(gl_GlobalInvocationID.x);
    int first_row = int(gl_WorkGroupID.y) * ROWS;
    float x[ROWS];
    float z[ROWS];
    for (int r = 0; r < ROWS; r++) {
        x[r] = 0.0f;
        z[r] = 0.0f;
    }
    for (int first = 0; first < lean_pass.wave_count; first += LANES) {
        barrier();
        int own = min(first + lane, lean_pass.wave_count - 1);
        for (int r = 0; r < ROWS; r++) {
            SinCos t = sincos_turns(0, lean_waves[own].turns + turns_at(lean_waves[own].down, first_row + r));
            row_phases[lane * ROWS + r] = vec2(t.c, t.s);
        }
        barrier();
        int count = min(LANES, lean_pass.wave_count - first);
        for (int i = 0; i < count; i++) {
            LeanWave w = lean_waves[first + i];
            SinCos t = sincos_turns(0, turns_at(w.across, column));
            for (int r = 0; r < ROWS; r++) {
                vec2 phase = row_phases[i * ROWS + r];
                float steep = fma(t.c, phase.x, -t.s * phase.y);
                x[r] = fma(steep, w.slope_x, x[r]);
                z[r] = fma(steep, w.slope_z, z[r]);
            }
        }
    }
    for (int r = 0; r < ROWS; r++)
        imageStore(mean_image, ivec2(column, first_row + r), vec4(x[r], z[r], 0.0f, 0.0f));
}
