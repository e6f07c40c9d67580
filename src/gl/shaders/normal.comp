/* SPDX-License-Identifier: MIT
 *
 * The mean shading normal of the filtered methods.
 */
#define WEIGHTED_WAVES
#include "lattice_data.glsl"
#include "kernels/glitter/glitter.k"
#include "normal.glsl"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    vec2 slope = vec2(0.0f);
    float water = 0.0f;
    for (int hit = 0; hit < int(TILE(0).hit_rows); hit++) { /* the mean over all hits */
        ivec2 at = ivec2(pixel.at.x, first_row(pixel.at.y) + hit);
        PixelRay p = pixel_ray_filtered(0, float(at.x), float(at.y));
        SlopeState state = slope_state(0, p.ray, pixel_estimate(at));
        if (p.water > 0.0f) {
            slope = add(slope, state.close);
            water += 1.0f;
        }
    }
    store_normal(pixel.texel, scale(slope, 1.0f / max(water, 1.0f)), water > 0.0f);
}
