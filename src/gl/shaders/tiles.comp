/* SPDX-License-Identifier: MIT
 *
 * Sorts the frame's waves for each tile: one workgroup a tile, one invocation every 64th wave. Places in the lists come from counting
 * bits and sums are taken in one order, so that the result does not depend on which invocation is the faster.
 */
#define EXACT_FMA
#define TILE_ACCESS
#include "gl_data.glsl"

layout(std140, binding = 3) uniform ViewBlock { ViewData view_data; };
layout(std430, binding = 5) readonly buffer SortBlock { SortData sort_data[]; };
#define VIEW(cx) view_data

#include "kernels/waves/tile.k"

const int LANES = 64;
layout(local_size_x = 64) in;

const int WORDS = MAX_WAVES / 32; /* of 32 waves */
shared uint resolved_bits[WORDS];
shared uint mixed_bits[WORDS];
shared uint marched_bits[WORDS];

/* What is summed over the waves; the last two are maxima. */
const int FILTERED = 0;  /* xx, xz, zz, octave, octave_sq */
const int BOUNDS = 5;    /* of all marched waves: height, slope, bend, each with its variance */
const int COARSE = 11;   /* of the largest ones */
const int REST = 17;     /* height of the others */
const int LARGEST = 19;  /* squared frequency */
const int MOST = 20;     /* squared frequency on the screen */
const int SUMS = 21;
shared float sums[SUMS * LANES];
shared float totals[SUMS];

void clear_bits(int lane)
{
    if (lane < WORDS) {
        resolved_bits[lane] = 0u;
        mixed_bits[lane] = 0u;
        marched_bits[lane] = 0u;
    }
    for (int i = 0; i < SUMS; i++)
        sums[i * LANES + lane] = 0.0f;
}

void add_to(int sum, int lane, float value) { sums[sum * LANES + lane] += value; }

void keep_largest(int sum, int lane, float value) { sums[sum * LANES + lane] = max(sums[sum * LANES + lane], value); }

WaveClass class_of(TileView view, int wave)
{
    SortData s = sort_data[wave];
    return classify_wave(0, view, s.turns_x, s.turns_z, s.turns_low_x, s.turns_low_z, s.phase, s.lesser_variance);
}

void mark_wave(TileView view, int wave, int lane)
{
    WaveClass c = class_of(view, wave);
    uint bit = 1u << (wave & 31);
    if (c.kind == float(WAVE_RESOLVED))
        atomicOr(resolved_bits[wave >> 5], bit);
    if (c.kind == float(WAVE_MIXED))
        atomicOr(mixed_bits[wave >> 5], bit);
    WaveData w = wave_data[wave];
    if (c.marched != 0.0f) {
        atomicOr(marched_bits[wave >> 5], bit);
        if (w.amplitude > 0.0f) {
            keep_largest(LARGEST, lane, w.turns_x * w.turns_x + w.turns_z * w.turns_z);
            keep_largest(MOST, lane, c.most);
        }
    }
    if (c.kind < 2.0f) {
        float lost = c.kind > 0.0f ? c.lost : 1.0f;
        add_to(FILTERED, lane, lost * w.variance_xx);
        add_to(FILTERED + 1, lane, lost * w.variance_xz);
        add_to(FILTERED + 2, lane, lost * w.variance_zz);
        add_to(FILTERED + 3, lane, lost * w.octave_mass);
        add_to(FILTERED + 4, lane, lost * w.octave_sq_mass);
    }
}

/* Ones among the bits of waves before this one. */
#define COUNT_BEFORE(name, bits)                                         \
    int name(int wave)                                                   \
    {                                                                    \
        int count = bitCount(bits[wave >> 5] & ((1u << (wave & 31)) - 1u)); \
        for (int i = 0; i < wave >> 5; i++)                              \
            count += bitCount(bits[i]);                                  \
        return count;                                                    \
    }
COUNT_BEFORE(resolved_before, resolved_bits)
COUNT_BEFORE(mixed_before, mixed_bits)
COUNT_BEFORE(marched_before, marched_bits)

struct Counts {
    int resolved, mixed, marched, coarse;
};

Counts count_all()
{
    Counts c = Counts(0, 0, 0, 0);
    for (int i = 0; i < WORDS; i++) {
        c.resolved += bitCount(resolved_bits[i]);
        c.mixed += bitCount(mixed_bits[i]);
        c.marched += bitCount(marched_bits[i]);
    }
    c.coarse = c.marched < 32 ? c.marched : c.marched / 4; /* the march strides over the largest quarter, where they are many */
    return c;
}

bool has_bit(uint bits, int wave) { return (bits >> (wave & 31) & 1u) != 0u; }

void add_bounds(int sum, int lane, float amplitude, float k)
{
    float slope = amplitude * k, bend = slope * k;
    add_to(sum, lane, amplitude);
    add_to(sum + 1, lane, 0.5f * amplitude * amplitude);
    add_to(sum + 2, lane, slope);
    add_to(sum + 3, lane, 0.5f * slope * slope);
    add_to(sum + 4, lane, bend);
    add_to(sum + 5, lane, 0.5f * bend * bend);
}

void list_wave(TileView view, Counts counts, int wave, int lane)
{
    bool resolved = has_bit(resolved_bits[wave >> 5], wave), mixed = has_bit(mixed_bits[wave >> 5], wave);
    bool marched = has_bit(marched_bits[wave >> 5], wave);
    if (!resolved && !mixed && !marched)
        return;
    WaveClass c = class_of(view, wave);
    int base = tile_slot * pass_data.wave_stride;
    if (resolved || mixed) {
        int place = resolved ? resolved_before(wave) : counts.resolved + mixed_before(wave);
        tile_waves[base + place] = TileWave(wave, c.phase, resolved ? c.share : 1.0f, 0.0f);
    }
    if (marched) {
        WaveData w = wave_data[wave];
        int place = marched_before(wave);
        march_waves[base + place] = MarchWave(w.turns_x, w.turns_z, c.phase, w.even_height);
        float amplitude = abs(w.even_height);
        add_bounds(BOUNDS, lane, amplitude, c.along);
        if (place < counts.coarse) {
            add_bounds(COARSE, lane, amplitude, c.along);
        } else {
            add_to(REST, lane, amplitude);
            add_to(REST + 1, lane, 0.5f * amplitude * amplitude);
        }
    }
}

/* A sum of many sines of random phases exceeds four deviations once in 30,000 places; few sines never reach their sum. */
float tighter(int sum) { return min(totals[sum], 4.0f * sqrt(totals[sum + 1])); }

/* The same as lanes_sort() of src/cpu/lanes.c makes of them. */
TileData finished_tile(TileView view, Counts counts, bool meets_light)
{
    TileData t;
    float steepness = max(sqrt(view_data.right_y * view_data.right_y + view_data.down_y * view_data.down_y), 1e-10f);
    t.ray_x = view.ray.x;
    t.ray_y = view.ray.y;
    t.ray_z = view.ray.z;
    t.camera_height = view_data.camera_height;
    t.right_x = view_data.right_x;
    t.right_y = view_data.right_y;
    t.right_z = view_data.right_z;
    t.origin_x = view.origin_x;
    t.down_x = view_data.down_x;
    t.down_y = view_data.down_y;
    t.down_z = view_data.down_z;
    t.origin_z = view.origin_z;
    t.resolved_count = counts.resolved;
    t.mixed_count = counts.mixed;
    t.march_count = counts.marched;
    t.march_bound = tighter(BOUNDS);
    t.march_slope = tighter(BOUNDS + 2);
    t.march_bend = tighter(BOUNDS + 4) * (view_data.filter_waves != 0 && counts.coarse < counts.marched ? 0.5f : 1.0f);
    t.filtered_xx = totals[FILTERED];
    t.filtered_xz = totals[FILTERED + 1];
    t.filtered_zz = totals[FILTERED + 2];
    t.filtered_octave = totals[FILTERED + 3];
    t.filtered_octave_sq = totals[FILTERED + 4];
    t.far_distance = 1e5f;
    t.coarse_count = counts.coarse;
    t.coarse_rest = tighter(REST);
    t.coarse_slope = tighter(COARSE + 2);
    t.coarse_bend = tighter(COARSE + 4);
    t.march_tolerance = totals[LARGEST] > 0.0f ? (view_data.filter_waves != 0 ? 0.1f : 0.02f) / sqrt(totals[LARGEST]) : 1e-3f;
    t.march_pixels = view_data.filter_waves == 0 && totals[MOST] > 0.0625f ? 1 : 0;
    t.light_reach = meets_light ? 1 : 0;
    t.horizon_steepness = steepness;
    t.horizon_inverse = 1.0f / steepness;
    t.slope_variance = view_data.slope_deviation * view_data.slope_deviation;
    t.tile_padding_0 = 0.0f;
    t.tile_padding_1 = 0.0f;
    return t;
}

void main()
{
    int lane = int(gl_LocalInvocationIndex);
    int tile = int(gl_WorkGroupID.y) * pass_data.columns + int(gl_WorkGroupID.x);
    tile_slot = pass_data.first_slot + tile;
    float column = float((pass_data.tile_x + int(gl_WorkGroupID.x)) * TILE_WIDTH);
    float row = float((pass_data.tile_y + int(gl_WorkGroupID.y)) * TILE_HEIGHT);
    TileView view = tile_view(0, column, row, float(TILE_WIDTH), float(TILE_HEIGHT));

    clear_bits(lane);
    barrier();
    for (int wave = lane; wave < pass_data.wave_count; wave += LANES)
        mark_wave(view, wave, lane);
    barrier();
    Counts counts = count_all();
    for (int wave = lane; wave < pass_data.wave_count; wave += LANES)
        list_wave(view, counts, wave, lane);
    barrier();
    if (lane < SUMS) {
        float total = 0.0f;
        for (int i = 0; i < LANES; i++)
            total = lane < LARGEST ? total + sums[lane * LANES + i] : max(total, sums[lane * LANES + i]);
        totals[lane] = total;
    }
    barrier();
    if (lane == 0) {
        bool meets_light = view_data.filter_waves != 0 && tile_meets_light(0, column, row, float(TILE_WIDTH), float(TILE_HEIGHT)) > 0.0f;
        /* Light that slopes reach when the shutter opens is on their path when it closes, too, and the other way round. */
        int opened = tile_slot + pass_data.open_slots;
        meets_light = meets_light || (pass_data.open_slots != 0 && tile_data[opened].light_reach != 0);
        if (pass_data.open_slots != 0 && meets_light)
            tile_data[opened].light_reach = 1;
        tile_data[tile_slot] = finished_tile(view, counts, meets_light);
    }
}
