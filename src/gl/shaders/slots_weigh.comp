/* SPDX-License-Identifier: MIT
 *
 * Computes the importance of each pixel (Eq. 1) and its sum over each tile: one workgroup per tile, four pixels per invocation.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "kernels/common/math.k"
#include "kernels/adaptive/slots.k"

#define PLAN_ACCESS
#include "slots_data.glsl"

layout(local_size_x = TASK_LANES) in;
layout(binding = 1, r32f) readonly uniform image2D coverage_image;
layout(binding = 2, r32f) readonly uniform image2D water_image;
layout(binding = 3, r32f) writeonly uniform image2D samples_image;
layout(binding = 4, r32f) writeonly uniform image2D importance_image;
layout(binding = 5, r32f) writeonly uniform image2D detail_image;

const int LANE_PIXELS = TILE_PIXELS / TASK_LANES;
shared double importances[TASK_LANES];
shared double waters[TASK_LANES];

float importance_of(float coverage, float water)
{
    float value = slot_importance(0, coverage, slots_data.center, slots_data.center_low, slots_data.center_width);
    return task_importance(0, value, water, slots_data.threshold);
}

void main()
{
    int lane = int(gl_LocalInvocationID.x);
    int tile = int(gl_WorkGroupID.y) * slots_data.columns + int(gl_WorkGroupID.x);
    double importance = 0.0LF, water = 0.0LF;
    for (int i = 0; i < LANE_PIXELS; i++) {
        ivec2 texel = task_texel(tile, lane * LANE_PIXELS + i);
        if (!is_inside(texel))
            continue;
        float share = imageLoad(water_image, texel).r;
        float own = importance_of(imageLoad(coverage_image, texel).r, share);
        imageStore(samples_image, texel, vec4(0.0f));
        imageStore(importance_image, texel, vec4(own));
        imageStore(detail_image, texel, vec4(0.0f));
        importance += double(own);
        water += double(share);
    }
    importances[lane] = importance;
    waters[lane] = water;
    barrier();
    if (lane == 0) {
        for (int i = 1; i < TASK_LANES; i++) {
            importance += importances[i];
            water += waters[i];
        }
        plan_tiles[tile] = uvec4(unpackDouble2x32(importance), unpackDouble2x32(water));
    }
}
