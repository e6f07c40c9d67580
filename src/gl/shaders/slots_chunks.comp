/* SPDX-License-Identifier: MIT
 *
 * Writes the sizes of the indirect dispatches of slots_trace.comp, one for each chunk of a band's slots.
 */
#include "kernels/common/prelude_glsl.k"
#include "pass_data.k"
#include "slots_data.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer CommandBlock { uvec4 commands[]; };

void main()
{
    uint slots = band_end() - band_first();
    for (uint chunk = gl_LocalInvocationID.x; chunk < uint(slots_data.chunks); chunk += 64u) {
        uint before = chunk * uint(slots_data.chunk_slots);
        uint own = before < slots ? min(slots - before, uint(slots_data.chunk_slots)) : 0u;
        uint groups = (own + uint(SLOT_GROUP) - 1u) / uint(SLOT_GROUP);
        uint across = min(groups, uint(SLOT_GROUPS));
        commands[chunk] = uvec4(across, across > 0u ? (groups + across - 1u) / across : 1u, 1u, 0u);
    }
}
