/* SPDX-License-Identifier: MIT
 *
 * Takes over leaves that have been rendered: one workgroup per tile. It computes what a split of each leaf is worth, settles leaves of little worth, which adds
 * them to their pixels, and sums what the tile has spent.
 *
 * Leaves are processed in groups of one size and in a fixed order, so that the sums of pixels have a fixed order, too. Leaves that stay open move up to the
 * tile's first place.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_of_halvings[LEAF_SIDES]; };
#define FRAME(cx) frame_of_halvings[0]
#include "kernels/adaptive/refinement.k"
#include "word64.glsl"
#include "kernels/adaptive/rounds.k"
#include "cells_data.glsl"

layout(local_size_x = CELLS_GROUP) in;
layout(binding = 0, rgba32f) coherent uniform image2D color_image;
layout(binding = 1, r32f) coherent uniform image2D coverage_image;
layout(binding = 2, r32f) coherent uniform image2D water_image;
layout(binding = 3, r32f) coherent uniform image2D samples_image;
layout(binding = 5, r32f) coherent uniform image2D detail_image;
layout(std430, binding = 8) readonly buffer PixelBlock { vec2 pixel_data[]; };

int tile, words, lane, least;
int first_place; /* of the tile's leaves in the pool */
bool dark;

/* ---- what cells cost ---- */

shared double level_cost[LEAF_LEVELS]; /* evaluations of a cell; 0: unknown */
shared double level_below[LEAF_LEVELS];
shared float level_worth[LEAF_LEVELS];

int parts_of_level(int level) { return parts_of_class(leaf_class(0, level, dark, cells_data.moves != 0)); }

/* Computes the cost and the worth of splits on all levels, after the cost of a level became known. The cost of a level that is not known follows from that of
 * the nearest coarser level. */
void appraise()
{
    double cost = level_cost[0];
    for (int level = 0; level < LEAF_LEVELS; level++) {
        cost = next_cost(0, level + 1 < LEAF_LEVELS ? level_cost[level + 1] : 0.0lf, cost, parts_of_level(level), parts_of_level(level + 1));
        level_below[level] = 4.0lf * cost;
        level_worth[level] = split_worth_of(0, leaf_area(level), level_below[level]);
    }
}

/* Sets the cost of a level whose cells evaluate `waves` waves in each piece of the shutter. */
void price(int level, int waves)
{
    level_cost[level] = cell_cost(0, parts_of_level(level), waves, cells_data.waves);
    appraise();
}

/* ---- sums of a tile ---- */

double spent, settled_variance, settled_shown, water; /* sums over the leaves of this invocation */
shared double lane_sums[CELLS_GROUP];

/* The sum over all invocations in a fixed order, which invocation 0 returns. The others return 0. */
double sum_of_lanes(double value)
{
    barrier();
    lane_sums[lane] = value;
    barrier();
    double sum = 0.0lf;
    if (lane == 0)
        for (int i = 0; i < CELLS_GROUP; i++)
            sum += lane_sums[i];
    return sum;
}

/* Adds the sum of `value` over all invocations to a double of the tile's words. */
void add_to_tile(int word, double value)
{
    double sum = sum_of_lanes(value);
    if (lane == 0)
        set_state_double(words + word, state_double(words + word) + sum);
}

/* ---- a group of leaves ---- */

shared uint group_pixels[2 * TILE_PIXELS]; /* for each pixel the bits of the group's leaves in it; zero between groups */
shared vec4 group_color[CELLS_GROUP];      /* what leaves add to pixels: colour and coverage */
shared vec4 group_water[CELLS_GROUP];      /* the same for water, detail and samples */
shared uint group_kept[2];                 /* bits of the group's leaves that stay */
shared int kept; /* number of the tile's leaves that stay, so far */

/* Adds all the group's leaves in a pixel to the layers, in order. `low` and `high` are their bits. The invocation of the first of them calls it. */
void add_to_pixel(ivec2 pixel, uint low, uint high)
{
    ivec2 texel = ivec2(tile % cells_data.columns, tile / cells_data.columns) * ivec2(TILE_WIDTH, TILE_HEIGHT) + pixel;
    vec3 color = imageLoad(color_image, texel).rgb;
    float coverage = imageLoad(coverage_image, texel).r, of_water = imageLoad(water_image, texel).r;
    float detail = imageLoad(detail_image, texel).r, samples = imageLoad(samples_image, texel).r;
    while (low != 0u || high != 0u) {
        int i = low != 0u ? findLSB(low) : 32 + findLSB(high);
        high = low != 0u ? high : high & (high - 1u);
        low = low != 0u ? low & (low - 1u) : 0u;
        color += group_color[i].rgb;
        coverage += group_color[i].a;
        of_water += group_water[i].x;
        detail += group_water[i].y;
        samples += group_water[i].z;
    }
    imageStore(color_image, texel, vec4(color, 1.0f));
    imageStore(coverage_image, texel, vec4(coverage));
    imageStore(water_image, texel, vec4(of_water));
    imageStore(detail_image, texel, vec4(detail));
    imageStore(samples_image, texel, vec4(samples));
}

float pixel_weight(ivec2 pixel) { return pixel_data[tile * TILE_PIXELS + pixel.y * TILE_WIDTH + pixel.x].x; }

/* Settles a leaf: writes what it adds to its pixel, and adds its errors. */
void settle(Leaf l, ivec2 pixel)
{
    int level = leaf_level(l);
    float area = leaf_area(level);
    group_color[lane] = vec4(l.color, l.coverage) * area;
    group_water[lane].x = area * l.water;
    group_water[lane].y = level > 0 || l.points > 0.0f ? area * l.coverage : 0.0f;
    settled_variance += double(area * area * l.variance);
    settled_shown += double(area * area * l.contrast * pixel_weight(pixel));
}

/* Settles or keeps one leaf for each invocation. `there`: the invocation has a leaf. `samples`: evaluations that the leaf has just cost. */
void take_group(bool there, Leaf l, bool settles, float samples)
{
    ivec2 pixel = there ? leaf_pixel(l) : ivec2(0);
    int index = 2 * (pixel.y * TILE_WIDTH + pixel.x);
    bool adds = there && (settles || samples > 0.0f), keeps = there && !settles;
    group_color[lane] = vec4(0.0f);
    group_water[lane] = vec4(0.0f, 0.0f, samples, 0.0f);
    if (there && settles)
        settle(l, pixel);
    if (adds)
        atomicOr(group_pixels[index + (lane >> 5)], 1u << (lane & 31));
    if (keeps)
        atomicOr(group_kept[lane >> 5], 1u << (lane & 31));
    barrier();
    uint low = group_pixels[index], high = group_pixels[index + 1];
    bool first = adds && (low != 0u ? findLSB(low) : 32 + findLSB(high)) == lane;
    if (first)
        add_to_pixel(pixel, low, high);
    uvec2 keepers = uvec2(group_kept[0], group_kept[1]);
    if (keeps) {
        int before = bitCount(lane < 32 ? keepers.x & ((1u << lane) - 1u) : keepers.y & ((1u << (lane - 32)) - 1u)) + (lane < 32 ? 0 : bitCount(keepers.x));
        set_leaf(first_place + kept + before, l);
    }
    memoryBarrierImage();
    barrier();
    if (first) {
        group_pixels[index] = 0u;
        group_pixels[index + 1] = 0u;
    }
    if (lane == 0) {
        kept += bitCount(keepers.x) + bitCount(keepers.y);
        group_kept[0] = 0u;
        group_kept[1] = 0u;
    }
    barrier();
}

/* The leaf with its next step and its bucket, as refinement_add() of the CPU sets them. */
Leaf judged(Leaf l)
{
    int level = leaf_level(l);
    float off = cells_data.by_coverage != 0 ? l.variance : l.contrast * pixel_weight(leaf_pixel(l));
    if (leaf_takes_points(0, l.points, l.places, level) > 0.0f)
        l.split = SPLIT_POINTS;
    bool points = l.split == SPLIT_POINTS;
    float next = leaf_next_points(0, l.points, l.places, l.coverage);
    bool ends = points ? next > float(LEAF_MOST_POINTS) : level + 1 == LEAF_LEVELS;
    l.bucket = 0;
    if (!(off > 0.0f) || ends)
        return l;
    float worth = leaf_split_worth(0, cells_data.by_display != 0, l.places, level_worth[level]);
    if (points)
        worth = leaf_points_worth(0, l.points, l.places, l.coverage, leaf_area(level), (next - l.points) * float(POINT_COST));
    l.bucket = int(leaf_bucket(0, off * worth));
    return l;
}

Leaf no_leaf()
{
    Leaf l;
    l.place = ivec2(0);
    l.halvings = ivec2(0);
    l.split = 0;
    l.points = 0.0f;
    l.bucket = 0;
    l.places = 1.0f;
    l.color = vec3(0.0f);
    l.coverage = 0.0f;
    l.water = 0.0f;
    l.height = 0.0f;
    l.variance = 0.0f;
    l.contrast = 0.0f;
    return l;
}

/* ---- kinds of leaves ---- */

/* Takes the leaves that the round did not choose. `all`: settles every leaf. */
void take_old(int from, int count, bool all)
{
    for (int i = 0; i < count; i += CELLS_GROUP) {
        bool there = i + lane < count;
        Leaf l = no_leaf();
        if (there)
            l = leaf_at(from + i + lane);
        take_group(there, l, all || l.bucket <= least, 0.0f);
    }
}

/* Takes the tile's pixels, the first leaves. */
void take_pixels(int from)
{
    if (lane == 0)
        price(0, int(state[words + TILE_WAVES]));
    barrier();
    for (int i = 0; i < TILE_PIXELS; i += CELLS_GROUP) {
        bool there = leaves[LEAF_VECTORS * (from + i + lane)].x != NO_LEAF;
        Leaf l = no_leaf();
        if (there)
            l = judged(leaf_at(from + i + lane));
        float samples = there && l.water > 0.0f ? float(level_cost[0]) : 0.0f;
        spent += double(samples);
        water += double(l.water);
        take_group(there, l, l.bucket <= least, samples);
    }
}

float contrast_at(int i) { return uintBitsToFloat(leaves[LEAF_VECTORS * i + 2].w); }

/* The cell at place i after all pieces of the shutter. `first` is the place of the first of the four parts of the same leaf, which lie one after the other. */
Leaf new_cell(int i, int first)
{
    Leaf l = leaf_at(i);
    if (cells_data.sky_black == 0)
        l.contrast = parts_contrast(0, l.contrast, contrast_at(first), contrast_at(first + 1), contrast_at(first + 2), contrast_at(first + 3));
    l.split = int(leaf_split(0, uintBitsToFloat(leaves[LEAF_VECTORS * i].z)));
    l.points = 0.0f;
    return judged(l);
}

/* Takes the tile's new cells of one size. `from` is the place of the first one. */
void take_cells(int from, int count, int level)
{
    for (int i = 0; i < count; i += CELLS_GROUP) {
        bool there = i + lane < count;
        Leaf l = no_leaf();
        if (there)
            l = new_cell(from + i + lane, from + i + (lane & ~3));
        if (there)
            spent += level_cost[level];
        take_group(there, l, l.bucket <= least, there ? float(level_cost[level]) : 0.0f);
    }
}

/* Takes all new cells of the tile, in the order in which cells_list.comp has listed them. */
void take_all_cells(int from)
{
    int job = int(state[words + TILE_JOB_FIRST]);
    for (int across = 0; across < LEAF_SIDES; across++)
        for (int down = across & 1; down < LEAF_SIDES - across; down += 2) {
            if (across + down == 0)
                continue;
            int count = 4 * int(state[words + TILE_SIZES + cell_size(across, down)]), level = (across + down) / 2;
            if (count == 0)
                continue;
            barrier();
            if (lane == 0)
                price(level, int(state[cells_data.jobs_at + JOB_WORDS * job + 2]));
            barrier();
            take_cells(from, count, level);
            from += count;
            job++;
        }
}

/* The leaf's values become the mean of all its points, old and new. */
Leaf with_points(Leaf l, PointSums sums)
{
    int end = int(leaf_next_points(0, l.points, l.places, l.coverage));
    LeafValues v = LeafValues(l.color.r, l.color.g, l.color.b, l.coverage, l.water, l.variance, l.contrast, l.places);
    v = values_with_points(0, v, sums, int(l.points), end, cells_data.sky_black != 0);
    l.color = vec3(v.red, v.green, v.blue);
    l.coverage = v.coverage;
    l.water = v.water;
    l.variance = v.variance;
    l.contrast = v.contrast;
    l.places = v.places;
    l.points = float(end);
    return l;
}

/* The leaf with its new points. On entry its `height` is the number of its first group of points, as bits. */
Leaf new_points(Leaf l)
{
    int group = int(floatBitsToUint(l.height)), end = int(leaf_next_points(0, l.points, l.places, l.coverage));
    int groups = (end - int(l.points)) / (POINT_GROUP * LEAF_INSTANTS);
    double sums[POINT_SUMS];
    for (int k = 0; k < POINT_SUMS; k++) {
        sums[k] = 0.0lf;
        for (int i = 0; i < groups; i++)
            sums[k] += state_double(cells_data.point_groups_at + POINT_GROUP_WORDS * (group + i) + POINT_SUMS_AT + 2 * k);
    }
    return judged(with_points(l, PointSums(sums[0], sums[1], sums[2], sums[3], sums[4], sums[5])));
}

/* Takes the leaves that have got points. */
void take_points(int from, int count)
{
    for (int i = 0; i < count; i += CELLS_GROUP) {
        bool there = i + lane < count;
        Leaf l = no_leaf();
        float cost = 0.0f;
        if (there) {
            l = leaf_at(from + i + lane);
            cost = (leaf_next_points(0, l.points, l.places, l.coverage) - l.points) * float(POINT_COST);
            l = new_points(l);
        }
        spent += double(cost);
        take_group(there, l, l.bucket <= least, cost);
    }
}

/* ---- a tile ---- */

void read_costs()
{
    if (lane < LEAF_LEVELS) {
        level_cost[lane] = cells_data.mode == GROW_PIXELS ? 0.0lf : state_double(words + TILE_COST + 2 * lane);
        level_worth[lane] = uintBitsToFloat(state[words + TILE_WORTH + lane]);
        level_below[lane] = double(state[words + TILE_BELOW + lane]) / double(COST_UNIT);
    }
    for (int i = lane; i < 2 * TILE_PIXELS; i += CELLS_GROUP)
        group_pixels[i] = 0u;
    if (lane == 0) {
        kept = 0;
        group_kept[0] = 0u;
        group_kept[1] = 0u;
        if (cells_data.mode == GROW_PIXELS) {
            for (int i = TILE_SPENT; i < TILE_COST; i++)
                state[words + i] = 0u;
        }
    }
    barrier();
}

void write_costs()
{
    barrier();
    if (lane < LEAF_LEVELS) {
        set_state_double(words + TILE_COST + 2 * lane, level_cost[lane]);
        state[words + TILE_WORTH + lane] = floatBitsToUint(level_worth[lane]);
        state[words + TILE_BELOW + lane] = uint(level_below[lane] * double(COST_UNIT));
    }
    add_to_tile(TILE_SPENT, spent);
    add_to_tile(TILE_VARIANCE, settled_variance);
    add_to_tile(TILE_SHOWN, settled_shown);
    add_to_tile(TILE_WATER, water);
    if (lane == 0) {
        state[words + TILE_FIRST] = uint(first_place);
        state[words + TILE_LEAVES] = uint(kept);
    }
}

void main()
{
    tile = int(gl_WorkGroupID.y) * cells_data.columns + int(gl_WorkGroupID.x);
    words = tile_words(tile);
    lane = int(gl_LocalInvocationIndex);
    least = int(state[CELLS_LEAST]);
    dark = state[words + TILE_DARK] != 0u;
    spent = 0.0lf;
    settled_variance = 0.0lf;
    settled_shown = 0.0lf;
    water = 0.0lf;
    read_costs();
    if (cells_data.mode == GROW_PIXELS) {
        first_place = tile * TILE_PIXELS;
        take_pixels(first_place);
    } else if (cells_data.mode == GROW_END) {
        first_place = int(state[words + TILE_FIRST]);
        take_old(first_place, int(state[words + TILE_LEAVES]), true);
    } else {
        int old = int(state[words + TILE_KEPT]), cells = int(state[words + TILE_CHILDREN]);
        first_place = int(state[words + TILE_NEXT]);
        take_old(first_place, old, false);
        take_all_cells(first_place + old);
        take_points(first_place + old + cells, int(state[words + TILE_POINT_LEAVES]));
    }
    write_costs();
}
