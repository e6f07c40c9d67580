/* SPDX-License-Identifier: MIT
 *
 * Methods `podee-uniform` and `podee-pixel` with circular kernels instead of the ellipse in closed form (`--kernels`).
 */
#define CACHES_TILE
#define FOAM_LAYER
#include "lattice_data.glsl"

/* The tables of src/frame/podee_tables.h. The slices of the sweep lie side by side. */
layout(binding = 1) uniform sampler2D sweep_texture;
layout(binding = 2) uniform sampler2D fraction_texture;

float SWEEP_TEXEL(int cx, float v, float u, float slice)
{
    int s = int(slice);
    return texelFetch(sweep_texture, ivec2(int(v), int(u)) + ivec2(PODEE_COLUMNS, PODEE_ROWS) * ivec2(s % PODEE_SLICES_ACROSS, s / PODEE_SLICES_ACROSS), 0).r;
}

float FRACTION_TEXEL(int cx, float r, float slice) { return texelFetch(fraction_texture, ivec2(int(r), int(slice)), 0).r; }

#include "kernels/baselines/podee_mixture.k"
#define METHOD_STATE PodeeState
#define method_result(cx, p, open, close) podee_result_of(cx, p, open, close, podee_mixture_coverage(cx, open, close))
#include "shade_podee.glsl"
#include "shade.glsl"
