/* SPDX-License-Identifier: MIT
 *
 * Blends the mean of each task's slots into the layers with the weight of Eq. 3 (Eq. 4): one workgroup per tile of the band, one invocation per task. A task
 * without slots keeps its approximate pixel.
 */
#include "lattice_data.glsl"
#include "kernels/adaptive/slots.k"
#include "slots_data.glsl"

layout(local_size_x = TASK_LANES) in;
layout(binding = 0, rgba32f) uniform image2D color_image;
layout(binding = 1, r32f) uniform image2D coverage_image;
layout(binding = 2, r32f) uniform image2D water_image;
layout(binding = 3, r32f) writeonly uniform image2D samples_image;
layout(binding = 4, r32f) readonly uniform image2D importance_image;
layout(binding = 5, r32f) writeonly uniform image2D detail_image;

float finest_frequency(ivec2 at)
{
    PixelRay p = pixel_ray_filtered(0, float(at.x), float(at.y));
    Footprint f = mean_footprint(0, p);
    float squared = 0.0f;
    for (int w = 0; w < slots_data.moving_waves; w++)
        squared = max(squared, wave_frequency(0, f, SET_WAVE(w)));
    return p.water > 0.0f ? sqrt(squared) : 0.0f;
}

void blend_task(ivec2 texel, ivec2 at, int place, float slots)
{
    int from = SLOT_FLOATS * place;
    float per_importance = float(double(plan_slots) / packDouble2x32(plan_sum));
    float weight = slot_weight(0, per_importance * imageLoad(importance_image, texel).r, finest_frequency(at));
    vec3 color = vec3(slot_values[from], slot_values[from + 1], slot_values[from + 2]) / slots;
    float coverage = slot_values[from + 3] / slots, water = slot_values[from + 4] / slots;
    if (FRAME(0).want_color != 0)
        imageStore(color_image, texel, vec4(mix(imageLoad(color_image, texel).rgb, color, weight), 1.0f));
    imageStore(coverage_image, texel, vec4(mix(imageLoad(coverage_image, texel).r, coverage, weight)));
    imageStore(water_image, texel, vec4(mix(imageLoad(water_image, texel).r, water, weight)));
    imageStore(detail_image, texel, vec4(coverage));
}

void main()
{
    int band_tile = int(gl_WorkGroupID.x), tile = slots_data.first_tile + band_tile;
    tile_slot = band_tile;
    int count = int(plan_tiles[tile].w);
    for (int i = int(gl_LocalInvocationID.x); i < count; i += TASK_LANES) {
        int place = task_place(band_tile, i), pixel = int(tasks[place].y);
        uint end = i + 1 < count ? tasks[place + 1].x : plan_tiles[tile + 1].z;
        uint slots = end - tasks[place].x;
        ivec2 texel = task_texel(tile, pixel);
        imageStore(samples_image, texel, vec4(float(slots)));
        if (slots > 0u)
            blend_task(texel, ivec2(pixel % TILE_WIDTH, pixel / TILE_WIDTH), place, float(slots));
    }
}
