/* SPDX-License-Identifier: MIT
 *
 * Depth and normal at the instant the shutter closes.
 */
#define EXACT_FMA
#include "lattice_data.glsl"
#include "kernels/glitter/sample.k"
#include "normal.glsl"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 3) writeonly uniform image2D depth_image;

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    vec3 ray = pixel_ray_at(0, float(pixel.at.x), float(pixel.at.y));
    SampleHit hit = sample_hit(0, ray, pixel_estimate(pixel.at));
    bool water = hit.found > 0.0f;
    imageStore(depth_image, pixel.texel, vec4(water ? hit.along * sqrt(length_squared(ray)) : INFINITE));
    store_normal(pixel.texel, hit.slope, water);
}
