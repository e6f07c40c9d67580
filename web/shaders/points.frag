/* SPDX-License-Identifier: MIT
 *
 * One point sample a pixel: methods `none` and `taa`, whose rays are moved where the tiles are made.
 */
#include "web_data.glsl"
#include "kernels/glitter/sample.k"

layout(location = 0) out vec4 shown;

void main()
{
    ivec2 pixel = enter_pixel();
    PixelResult result = sample_pixel(0, float(pixel.x), float(pixel.y), pixel_estimate(pixel));
    shown = vec4(result.color, result.coverage);
}
