/* SPDX-License-Identifier: MIT
 *
 * Renders a chunk of a band's slots, one per invocation: finds the slot's task and traces a ray through a random place of the task's pixel.
 */
#define EXACT_FMA
#include "lattice_data.glsl"
#include "kernels/adaptive/temporal_ray.k"
#include "word64.glsl"
#include "kernels/common/strata.k"

#define SLOT_ACCESS writeonly
#include "slots_data.glsl"

layout(local_size_x = SLOT_GROUP) in;

/* The last tile of the band whose first slot is at most this one. */
int tile_of(uint slot)
{
    int low = 0, count = slots_data.band_tiles;
    while (count > 1) {
        int half_count = count / 2;
        low = plan_tiles[slots_data.first_tile + low + half_count].z <= slot ? low + half_count : low;
        count -= half_count;
    }
    return low;
}

/* Eq. 2: the last task of the tile whose first slot is at most this one. */
int task_of(int band_tile, uint slot)
{
    int low = 0, count = int(plan_tiles[slots_data.first_tile + band_tile].w);
    while (count > 1) {
        int half_count = count / 2;
        low = tasks[task_place(band_tile, low + half_count)].x <= slot ? low + half_count : low;
        count -= half_count;
    }
    return low;
}

/* Place of sample `number` of a pixel, in pixels from the pixel's centre. */
vec2 random_place(ivec2 pixel, uint number)
{
    uvec2 key = hash_of_sample(word_of(uint(slots_data.seed_high), uint(slots_data.seed_low)), word_of(0u, number));
    uvec2 bits = hash_of_pixel(key, uint(pixel.x), uint(pixel.y));
    return vec2(stratum_place(0, 0, hash_unit(bits), 1), stratum_place(0, 0, hash_unit(hash_of(bits)), 1));
}

PixelResult trace(int band_tile, int pixel, uint number)
{
    ivec2 at = ivec2(pixel % TILE_WIDTH, pixel / TILE_WIDTH);
    layer_texel = task_texel(slots_data.first_tile + band_tile, pixel);
    precise vec2 place = vec2(at) + random_place(layer_texel, number);
    ivec2 hit = ivec2(at.x, first_row(at.y));
    TemporalEnd before;
    if (slots_data.two_ends != 0) {
        tile_slot = slots_data.band_tiles + band_tile;
        before = temporal_end(0, pixel_ray_at(0, place.x, place.y), pixel_estimate(hit));
    }
    tile_slot = band_tile;
    vec3 ray = pixel_ray_at(0, place.x, place.y);
    TemporalEnd close = temporal_end(0, ray, pixel_estimate(hit));
    if (slots_data.two_ends == 0)
        before = close;
    return temporal_result(0, ray, before, close);
}

void main()
{
    uint own = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * uint(SLOT_GROUP) + gl_LocalInvocationID.x;
    uint slot = chunk_first() + own;
    if (own >= uint(slots_data.chunk_slots) || slot >= band_end())
        return;
    int band_tile = tile_of(slot);
    uvec2 task = tasks[task_place(band_tile, task_of(band_tile, slot))];
    PixelResult p = trace(band_tile, int(task.y), slot - task.x);
    int to = SLOT_FLOATS * result_place(int(own));
    slot_values[to] = p.color.x;
    slot_values[to + 1] = p.color.y;
    slot_values[to + 2] = p.color.z;
    slot_values[to + 3] = p.coverage;
    slot_values[to + 4] = p.water;
}
