/* SPDX-License-Identifier: MIT
 *
 * The sets of waves that cells and points see, and the frame's numbers for cells of each size.
 */

layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
layout(std430, binding = 6) readonly buffer SetBlock { uvec4 wave_sets[]; };

int frame_halvings = 0; /* halvings of the pixel across or down, whichever are more */
int set_at = 0;         /* where the set begins */
int foam_place = 0;        /* number of the set */

#define FRAME(cx) frame_of_halvings[frame_halvings]

int set_vectors() { return pass_data.wave_count * (SET_WAVE_VECTORS + SET_SORT_VECTORS) + SET_VIEWS * SET_VIEW_VECTORS; }

void turn_to_set(int index)
{
    set_at = index * set_vectors();
    foam_place = index;
}

WaveData SET_WAVE(int i)
{
    int at = set_at + i * SET_WAVE_VECTORS;
    vec4 a = uintBitsToFloat(wave_sets[at]), b = uintBitsToFloat(wave_sets[at + 1]), c = uintBitsToFloat(wave_sets[at + 2]);
    vec4 d = uintBitsToFloat(wave_sets[at + 3]), e = uintBitsToFloat(wave_sets[at + 4]), f = uintBitsToFloat(wave_sets[at + 5]);
    return WaveData(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w, d.x, d.y, d.z, d.w, e.x, e.y, e.z, e.w, f.x, f.y, f.z, f.w);
}

SortData SET_SORT(int i)
{
    int at = set_at + pass_data.wave_count * SET_WAVE_VECTORS + i * SET_SORT_VECTORS;
    vec4 a = uintBitsToFloat(wave_sets[at]), b = uintBitsToFloat(wave_sets[at + 1]);
    return SortData(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
}

/* A view of the current set. `size` is 0 for pixels, and 1 + cell_size() for cells. */
ViewData set_view(int size)
{
    int at = set_at + pass_data.wave_count * (SET_WAVE_VECTORS + SET_SORT_VECTORS) + size * SET_VIEW_VECTORS;
    vec4 a = uintBitsToFloat(wave_sets[at]), b = uintBitsToFloat(wave_sets[at + 1]), c = uintBitsToFloat(wave_sets[at + 2]);
    vec4 d = uintBitsToFloat(wave_sets[at + 3]), f = uintBitsToFloat(wave_sets[at + 4]);
    uvec4 e = wave_sets[at + 4], g = wave_sets[at + 5];
    CameraRays rays = CameraRays(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w);
    vec4 h = uintBitsToFloat(g), x = uintBitsToFloat(wave_sets[at + 6]), y = uintBitsToFloat(wave_sets[at + 7]), z = uintBitsToFloat(wave_sets[at + 8]);
    CameraMotion motion = CameraMotion(x.x, x.y, x.z, x.w, y.x, y.y, y.z, y.w, z.x, z.y, z.z, z.w);
    float to_close = uintBitsToFloat(wave_sets[at + 9].x);
    return ViewData(rays, d.x, d.y, d.z, d.w, int(e.x), int(e.y), f.z, f.w, int(g.x), h.y, h.z, h.w, motion, to_close, 0.0f, 0.0f, 0.0f);
}
