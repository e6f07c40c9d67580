/* SPDX-License-Identifier: MIT
 *
 * A method that shades one point of the whole surface for each pixel of a band. Define point_pixel before.
 */
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D color_image;
layout(binding = 1) writeonly uniform image2D coverage_image;
layout(binding = 2) writeonly uniform image2D water_image;

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    PixelResult result = point_pixel(0, float(pixel.at.x), float(pixel.at.y), pixel_guess(pixel.at));
    if (FRAME(0).want_color != 0)
        imageStore(color_image, pixel.texel, vec4(result.color, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(result.coverage));
    imageStore(water_image, pixel.texel, vec4(result.water));
}
