/* SPDX-License-Identifier: MIT
 *
 * Methods that shade one point of the whole surface for each pixel of a band. The text is assembled once for each method: method.k is its kernel, method_result
 * the kernel's function.
 */
#define EXACT_FMA
#define FOAM_LAYER
#include "lattice_data.glsl"
#include "method.k"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0) writeonly uniform image2D color_image;
layout(binding = 1) writeonly uniform image2D coverage_image;
layout(binding = 2) writeonly uniform image2D water_image;

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    PixelResult result = method_result(0, float(pixel.at.x), float(pixel.at.y), pixel_estimate(pixel.at));
    if (FRAME(0).want_color != 0)
        imageStore(color_image, pixel.texel, vec4(result.color, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(result.coverage));
    imageStore(water_image, pixel.texel, vec4(result.water));
    store_foam(pixel.texel, result.foam);
}
