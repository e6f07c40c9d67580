/* SPDX-License-Identifier: MIT
 *
 * Point samples: methods `none` and `ssaaN`. A dispatch adds some samples of one instant to the layers.
 */
#define EXACT_FMA
#define FOAM_LAYER
#include "lattice_data.glsl"
#include "kernels/glitter/sample.k"
#include "word64.glsl"
#include "kernels/common/strata.k"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0, rgba32f) uniform image2D color_image;
layout(binding = 1, r32f) uniform image2D coverage_image;
layout(binding = 2, r32f) uniform image2D water_image;

/* Place of sample `index` of the dispatch in its stratum, in pixels from the pixel's centre. */
vec2 jitter(ivec2 pixel, int index)
{
    uvec2 number = word_sum(word_of(uint(pass_data.sample_first_high), uint(pass_data.sample_first_low)), word_of(0u, uint(index)));
    uvec2 key = hash_of_sample(word_of(uint(pass_data.seed_high), uint(pass_data.seed_low)), number);
    uvec2 bits = hash_of_pixel(key, uint(pixel.x), uint(pixel.y));
    int stratum = pass_data.stratum_first + index;
    return vec2(stratum_place(0, stratum % pass_data.strata, hash_unit(bits), pass_data.strata),
                stratum_place(0, stratum / pass_data.strata, hash_unit(hash_of(bits)), pass_data.strata));
}

void main()
{
    TilePixel pixel = tile_pixel();
    if (!pixel.inside)
        return;
    vec3 color = vec3(0.0f);
    float coverage = 0.0f, water = 0.0f, foam = 0.0f;
    if (pass_data.clear == 0) {
        if (FRAME(0).want_color != 0)
            color = imageLoad(color_image, pixel.texel).rgb;
        coverage = imageLoad(coverage_image, pixel.texel).r;
        water = imageLoad(water_image, pixel.texel).r;
        foam = stored_foam(pixel.texel);
    }
    HitEstimate estimate = pixel_estimate(pixel.at);
    ivec2 image = pixel.texel + ivec2(pass_data.area_x, pass_data.area_y);
    for (int i = 0; i < max(pass_data.sample_count, 1); i++) {
        /* `precise`, because along the horizon the last bit of the place moves the hit by metres. */
        precise vec2 place = vec2(pixel.at);
        if (pass_data.sample_count > 0)
            place += jitter(image, i);
        PixelResult p = sample_pixel(0, place.x, place.y, estimate);
        color += p.color * pass_data.weight;
        coverage += p.coverage * pass_data.weight;
        water += p.water * pass_data.weight;
        foam += p.foam * pass_data.weight;
    }
    if (FRAME(0).want_color != 0)
        imageStore(color_image, pixel.texel, vec4(color, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(coverage));
    imageStore(water_image, pixel.texel, vec4(water));
    store_foam(pixel.texel, foam);
}
