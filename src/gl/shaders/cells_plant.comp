/* SPDX-License-Identifier: MIT
 *
 * Makes the first leaves of method adaptive: the pixels of a band, shaded by method `mangata`.
 */
#define WEIGHTED_WAVES
#include "lattice_data.glsl"
#include "kernels/adaptive/cells.k"
#include "kernels/adaptive/refinement.k"
#include "cells_data.glsl"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 0, rgba32f) writeonly uniform image2D color_image;
layout(binding = 1, r32f) writeonly uniform image2D coverage_image;
layout(binding = 2, r32f) writeonly uniform image2D water_image;
layout(binding = 3, r32f) writeonly uniform image2D samples_image;
layout(binding = 4, r32f) writeonly uniform image2D importance_image;
layout(binding = 5, r32f) writeonly uniform image2D detail_image;

/* For each pixel its weight, and the height of its hit in metres, which is infinite unless the pixel is all water. */
layout(std430, binding = 8) writeonly buffer PixelBlock { vec2 pixel_data[]; };

CellResult nothing_but_sky(PixelRay p)
{
    CellResult cell;
    cell.pixel.color = background(0, p.sky_ray);
    cell.pixel.coverage = 0.0f;
    cell.pixel.water = 0.0f;
    cell.height = 0.0f;
    cell.variance = 0.0f;
    cell.contrast = 0.0f;
    cell.display_slope_squared = 0.0f;
    cell.places = 1.0f;
    cell.aspect = 1.0f;
    return cell;
}

CellResult pixel_result(ivec2 at)
{
    PixelRay p = pixel_ray_filtered(0, float(at.x), float(at.y));
    if (p.water <= 0.0f)
        return nothing_but_sky(p);
    return cell_result_of(0, p, slope_state(0, p.ray, pixel_estimate(at)));
}

/* Stores how many waves the tile's pixels evaluate, and whether the tile mirrors no light. One invocation per tile calls it. */
void tell_of_tile(int tile)
{
    bool dark = tile_dark(0, TILE(0).light_reach, cells_data.by_display != 0, cells_data.lights_dark != 0);
    state[tile_words(tile) + TILE_DARK] = dark ? 1u : 0u;
    state[tile_words(tile) + TILE_WAVES] = uint(TILE(0).resolved_count + TILE(0).mixed_count);
}

void main()
{
    TilePixel pixel = tile_pixel();
    ivec2 tile = pixel.texel / ivec2(TILE_WIDTH, TILE_HEIGHT);
    int index = tile.y * cells_data.columns + tile.x;
    int leaf = index * TILE_PIXELS + pixel.at.y * TILE_WIDTH + pixel.at.x;
    if (!pixel.inside) {
        leaves[LEAF_VECTORS * leaf] = uvec4(NO_LEAF, 0u, 0u, 0u);
        return;
    }
    if (pixel.at == ivec2(0))
        tell_of_tile(index);
    CellResult cell = pixel_result(pixel.at);
    Leaf l;
    l.place = pixel.at;
    l.halvings = ivec2(0);
    l.split = int(leaf_split(0, cell.aspect));
    l.points = 0.0f;
    l.bucket = 0;
    l.places = cell.places;
    l.color = cell.pixel.color;
    l.coverage = cell.pixel.coverage;
    l.water = cell.pixel.water;
    l.height = cell.height;
    l.variance = cell.variance;
    l.contrast = cell.contrast;
    set_leaf(leaf, l);
    pixel_data[leaf] = vec2(leaf_weight(0, cell.pixel.color, cell.display_slope_squared), cell.pixel.water >= 1.0f ? cell.height : INFINITE);
    imageStore(color_image, pixel.texel, vec4(0.0f, 0.0f, 0.0f, 1.0f));
    imageStore(coverage_image, pixel.texel, vec4(0.0f));
    imageStore(water_image, pixel.texel, vec4(0.0f));
    imageStore(samples_image, pixel.texel, vec4(0.0f));
    imageStore(importance_image, pixel.texel, vec4(sqrt(cell.variance)));
    imageStore(detail_image, pixel.texel, vec4(0.0f));
}
