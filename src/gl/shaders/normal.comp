/* SPDX-License-Identifier: MIT
 *
 * The mean shading normal of the filtered methods.
 */
#define SHARED_WAVES
#include "lattice_data.glsl"
#include "kernels/glitter/glitter.k"
#include "normal.glsl"

layout(local_size_x = GROUP_SIDE, local_size_y = GROUP_SIDE) in;

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    PixelRay p = pixel_ray_filtered(0, float(pixel.at.x), float(pixel.at.y));
    SlopeState state = slope_state(0, p.ray, pixel_estimate(pixel.at));
    store_normal(pixel.texel, state.close, p.water > 0.0f);
}
