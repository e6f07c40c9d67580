/* SPDX-License-Identifier: MIT
 *
 * Shades cells by the model of method `mangata` over one piece of the shutter: one invocation per cell.
 */
#define WEIGHTED_WAVES
#define CELLS_PASS
#define PARTS(cx) TILE(cx).parts
#include "lattice_data.glsl"
#include "kernels/adaptive/cells.k"
#include "kernels/adaptive/refinement.k"
#include "cells_data.glsl"
#include "cells_job.glsl"

layout(local_size_x = CELLS_GROUP) in;
layout(std430, binding = 8) readonly buffer PixelBlock { vec2 pixel_data[]; };

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

/* Height of the hit of the pixel two rows below. Infinite: there is no such pixel, the shutter has several pieces, or the sky is black. */
float height_below(Job job, ivec2 pixel)
{
    ivec2 tile = ivec2(job.tile % cells_data.columns, job.tile / cells_data.columns), below = pixel + ivec2(0, 2);
    if (cells_data.sky_black != 0 || parts_of_class(job.kind) != 1 || tile.y * TILE_HEIGHT + below.y >= cells_data.height)
        return INFINITE;
    int in_tile = below.y < TILE_HEIGHT ? job.tile : job.tile + cells_data.columns;
    return pixel_data[in_tile * TILE_PIXELS + below.y % TILE_HEIGHT * TILE_WIDTH + below.x].y;
}

/* Multiple of the cell's ray at which the search for its hit begins. The ray of the pixel two rows below has passed over all that lies before that place. */
float search_start(Job job, ivec2 pixel, vec2 place)
{
    float height = height_below(job, pixel);
    vec2 sides = vec2(ldexp(1.0f, job.halvings.x), ldexp(1.0f, job.halvings.y));
    vec2 middle = (vec2(pixel) + vec2(0.5f, 2.5f)) * sides - 0.5f; /* centre of the pixel two rows below, in cells */
    vec3 ray = pixel_ray_at(0, middle.x, middle.y);
    float along = !isinf(height) && ray.y < -1e-7f ? (TILE(0).camera_height - height) / -ray.y : 0.0f;
    vec3 above = pixel_ray_filtered(0, place.x, place.y).ray;
    return row_start(0, above, inverse_speed_of(0, above), ray, inverse_speed_of(0, ray), along).along;
}

/* First estimate of a cell's hit. `height` is that of the leaf that the cell is a part of. In grazing tiles it says nothing of the cell's hit, and the hit is
 * searched for. */
HitEstimate estimate_of(Job job, ivec2 pixel, vec2 place, float height)
{
    HitEstimate estimate;
    bool grazing = TILE(0).grazing != 0;
    estimate.height = height;
    estimate.search = grazing || CHOPPY(0) != 0 ? 1.0f : 0.0f;
    estimate.from = grazing ? search_start(job, pixel, place) : 0.0f;
    estimate.slope = vec2(0.0f);
    estimate.shift = vec2(0.0f);
    return estimate;
}

CellResult cell_result(Job job, int slot, ivec2 pixel, vec2 place, float height)
{
    tile_slot = slot;
    turn_to_set(set_of_part(job.kind));
    PixelRay p = pixel_ray_filtered(0, place.x, place.y);
    if (p.water <= 0.0f)
        return nothing_but_sky(p);
    HitEstimate estimate = estimate_of(job, pixel, place, height);
    return cell_result_of(0, p, slope_state(0, p.ray, estimate));
}

/* Adds the result of a piece of the shutter, with weight `share`, to the cell's means, of which the fraction `own` is not its leaf's. The height is that of the
 * last piece. */
void add_result(int at, uvec4 first, CellResult cell, float own, float share, bool last)
{
    vec4 color = uintBitsToFloat(leaves[at + 1]), water = uintBitsToFloat(leaves[at + 2]);
    vec2 spread = uintBitsToFloat(first.zw) + share * vec2(cell.aspect, cell.places);
    color += share * own * vec4(cell.pixel.color, cell.pixel.coverage);
    water += share * vec4(own * cell.pixel.water, 0.0f, cell.variance, cell.contrast);
    water.y = last ? cell.height : water.y;
    leaves[at] = uvec4(first.xy, floatBitsToUint(spread));
    leaves[at + 1] = floatBitsToUint(color);
    leaves[at + 2] = floatBitsToUint(water);
}

void main()
{
    int group = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x);
    if (group >= int(state[CELLS_GROUPS]))
        return;
    int entry = cells_data.groups_at + GROUP_WORDS * group, lane = int(gl_LocalInvocationIndex);
    int place = int(state[entry]), slot = place - cells_data.batch * cells_data.slots;
    if (slot < 0 || slot >= cells_data.slots || lane >= int(state[entry + 2]))
        return;
    Job job = job_at(place);
    int parts = parts_of_class(job.kind), at = LEAF_VECTORS * (int(state[entry + 1]) + lane);
    if (cells_data.part >= parts)
        return;
    frame_halvings = max(job.halvings.x, job.halvings.y);
    uvec4 first = leaves[at];
    ivec2 cell = ivec2(first.xy & ((1u << PLACE_BITS) - 1u)), pixel = ivec2(cell.x >> job.halvings.x, cell.y >> job.halvings.y);
    layer_texel = ivec2(job.tile % cells_data.columns, job.tile / cells_data.columns) * ivec2(TILE_WIDTH, TILE_HEIGHT) + pixel;
    CellResult result = cell_result(job, slot, pixel, vec2(cell), uintBitsToFloat(leaves[at + 2].y));
    float own = (first.x & KEEPS) != 0u ? 1.0f - leaf_kept(0, true, 0.0f) : 1.0f;
    add_result(at, first, result, own, 1.0f / float(parts), cells_data.part + 1 == parts);
}
