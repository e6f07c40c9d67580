/* SPDX-License-Identifier: MIT
 *
 * Method `fxaa`, as src/frame/fxaa.c has it: finds edges in the displayed picture of method `none` and reads every pixel a little across its edge.
 */
#include "blend.glsl"

layout(binding = 4) uniform sampler2D luma_texture;

float luma_at(ivec2 texel) { return texelFetch(luma_texture, clamp(texel, ivec2(0), blend_size() - 1), 0).r; }

/* Where a pixel is read instead of at its centre: `amount` of a pixel, at most 1, towards a neighbour. */
struct Shift {
    ivec2 to;
    float amount;
};

/* The luma about a pixel, by rows. */
struct Patch {
    float at[9];
    float range;
};

Patch patch_of(ivec2 texel)
{
    Patch p;
    for (int i = 0; i < 9; i++)
        p.at[i] = luma_at(texel + ivec2(i % 3 - 1, i / 3 - 1));
    float least = min(min(min(p.at[1], p.at[3]), min(p.at[4], p.at[5])), p.at[7]);
    float most = max(max(max(p.at[1], p.at[3]), max(p.at[4], p.at[5])), p.at[7]);
    /* Contrast below an eighth of the brightest, or too dark to see, is no edge. */
    p.range = most - least < max(0.03125f, most * 0.125f) ? 0.0f : most - least;
    return p;
}

/* Of features smaller than a pixel: how far the pixel lies from the mean of its neighbours. */
float subpixel_amount(Patch p)
{
    float sides = p.at[1] + p.at[7] + p.at[3] + p.at[5];
    float corners = p.at[0] + p.at[2] + p.at[6] + p.at[8];
    float off = min(abs((2.0f * sides + corners) / 12.0f - p.at[4]) / p.range, 1.0f);
    float smooth_off = off * off * (3.0f - 2.0f * off);
    return 0.75f * smooth_off * smooth_off;
}

/* Whether the edge runs along the row: luma bends more down than across. */
bool runs_along_row(Patch p)
{
    float down = abs(p.at[0] + p.at[6] - 2.0f * p.at[3]) + 2.0f * abs(p.at[1] + p.at[7] - 2.0f * p.at[4]) + abs(p.at[2] + p.at[8] - 2.0f * p.at[5]);
    float across = abs(p.at[0] + p.at[2] - 2.0f * p.at[1]) + 2.0f * abs(p.at[3] + p.at[5] - 2.0f * p.at[4]) + abs(p.at[6] + p.at[8] - 2.0f * p.at[7]);
    return down >= across;
}

/* Where the edge ends in one direction: how many pixels off, and whether luma rises there above the edge's own. */
struct EdgeEnd {
    float distance_off;
    float luma;
};

/* Steps as FXAA's quality presets have them: near ones fine, far ones coarse. */
EdgeEnd walk_edge(ivec2 texel, ivec2 side, int direction, float edge, float limit)
{
    const int steps[11] = int[11](1, 1, 1, 1, 1, 2, 2, 2, 2, 4, 8);
    ivec2 along = side.y != 0 ? ivec2(direction, 0) : ivec2(0, direction);
    int way = 0;
    float off = 0.0f;
    for (int i = 0; i < 11; i++) {
        way += steps[i];
        off = 0.5f * (luma_at(texel + along * way) + luma_at(texel + along * way + side)) - edge;
        if (abs(off) >= limit)
            break;
    }
    return EdgeEnd(float(way), off);
}

Shift shift_of(ivec2 texel)
{
    Patch p = patch_of(texel);
    if (p.range == 0.0f)
        return Shift(ivec2(0), 0.0f);
    bool horizontal = runs_along_row(p);
    float centre = p.at[4], before = horizontal ? p.at[1] : p.at[3], after = horizontal ? p.at[7] : p.at[5];
    int direction = abs(before - centre) >= abs(after - centre) ? -1 : 1;
    ivec2 side = horizontal ? ivec2(0, direction) : ivec2(direction, 0);
    float neighbour = direction < 0 ? before : after, edge = 0.5f * (centre + neighbour);
    float limit = 0.25f * max(abs(neighbour - centre), 1e-6f);
    EdgeEnd back = walk_edge(texel, side, -1, edge, limit), ahead = walk_edge(texel, side, 1, edge, limit);
    EdgeEnd near = back;
    if (back.distance_off >= ahead.distance_off)
        near = ahead;
    /* Only where the nearer end turns to the other side of the edge does the pixel lie under the slanting line. */
    float amount = 0.0f;
    if ((near.luma < 0.0f) != (centre < edge))
        amount = 0.5f - near.distance_off / (back.distance_off + ahead.distance_off);
    return Shift(side, max(amount, subpixel_amount(p)));
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, blend_size())))
        return;
    Shift s = shift_of(texel);
    ivec2 from = texel + s.to;
    if (any(lessThan(from, ivec2(0))) || any(greaterThanEqual(from, blend_size())))
        from = texel;
    BlendPixel here = pixel_of_current(texel), there = pixel_of_current(from);
    here.color = (1.0f - s.amount) * here.color + s.amount * there.color;
    here.shares = (1.0f - s.amount) * here.shares + s.amount * there.shares;
    store_blend(texel, here);
}
