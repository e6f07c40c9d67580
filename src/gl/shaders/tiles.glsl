/* SPDX-License-Identifier: MIT
 *
 * Sorts waves for a tile: one workgroup per tile. Each invocation takes every 64th wave. Places in the lists come from counting bits, and sums are taken in a
 * fixed order, so that the result does not depend on the order in which invocations run.
 *
 * Before including this file, define VIEW(cx), and SET_SORT(i) as wave i in the form of SortData.
 */
#include "kernels/waves/light_reach.k"
#include "kernels/waves/tile.k"

const int LANES = 64;
layout(local_size_x = 64) in;

const int WORDS = MAX_WAVES / 32; /* words of the bits of 32 waves; at most one for each invocation */
shared uint resolved_bits[WORDS];
shared uint mixed_bits[WORDS];
shared uint searched_bits[WORDS];

TileSums own; /* sums over the waves of this invocation */
shared float sums[TILE_SUMS * LANES];
shared float totals[TILE_SUMS];

void clear_bits(int lane)
{
    if (lane < WORDS) {
        resolved_bits[lane] = 0u;
        mixed_bits[lane] = 0u;
        searched_bits[lane] = 0u;
    }
    own = no_sums(0);
}

WaveClass class_of(TileView view, int wave) { return classify_wave(0, view, sort_wave_of(0, SET_SORT(wave))); }

void mark_wave(TileView view, int wave)
{
    WaveClass c = class_of(view, wave);
    uint bit = 1u << (wave & 31);
    if (c.kind == float(WAVE_RESOLVED))
        atomicOr(resolved_bits[wave >> 5], bit);
    if (c.kind == float(WAVE_MIXED))
        atomicOr(mixed_bits[wave >> 5], bit);
    if (c.searched != 0.0f)
        atomicOr(searched_bits[wave >> 5], bit);
    own = sums_with_wave(0, own, SET_WAVE(wave), c.lost, c.searched, c.most);
}

/* Defines a function that counts the set bits of the waves before a wave. */
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
COUNT_BEFORE(searched_before, searched_bits)

struct Counts {
    int resolved, mixed, searched;
};

Counts count_all()
{
    Counts c = Counts(0, 0, 0);
    for (int i = 0; i < (pass_data.wave_count + 31) / 32; i++) {
        c.resolved += bitCount(resolved_bits[i]);
        c.mixed += bitCount(mixed_bits[i]);
        c.searched += bitCount(searched_bits[i]);
    }
    return c;
}

bool has_bit(uint bits, int wave) { return (bits >> (wave & 31) & 1u) != 0u; }

void list_wave(TileView view, Counts counts, int wave)
{
    bool resolved = has_bit(resolved_bits[wave >> 5], wave), mixed = has_bit(mixed_bits[wave >> 5], wave);
    bool searched = has_bit(searched_bits[wave >> 5], wave);
    if (!resolved && !mixed && !searched)
        return;
    WaveClass c = class_of(view, wave);
    int base = tile_slot * pass_data.wave_stride;
    if (resolved || mixed) {
        int place = resolved ? resolved_before(wave) : counts.resolved + mixed_before(wave);
        tile_waves[base + place] = vector_of_tile_wave(wave, c.turns, c.share);
    }
    if (searched) {
        WaveData w = SET_WAVE(wave);
        int place = searched_before(wave);
        vec4 v[SEARCH_VECTORS];
        search_wave_to_vectors(search_wave_of(0, w, c.turns), v);
        for (int k = 0; k < SEARCH_VECTORS; k++)
            search_waves[SEARCH_VECTORS * (base + place) + k] = v[k];
        own = sums_with_search(0, own, w, c.along, place, coarse_waves(0, counts.searched));
    }
}

TileData finished_tile(TileView view, Counts counts)
{
    TileSums all;
    for (int i = 0; i < TILE_SUMS; i++)
        all.value[i] = totals[i];
    TileData t = sorted_tile(0, all, counts.resolved, counts.mixed, counts.searched, view.rows);
    t.ray_x = view.ray.x;
    t.ray_y = view.ray.y;
    t.ray_z = view.ray.z;
    t.origin_x = view.origin_x;
    t.origin_z = view.origin_z;
    t.grazing = view.grazing > 0.0f ? 1 : 0;
    t.refined = view.refined > 0.0f ? 1 : 0;
    t.skyline = int(view.skyline);
    t.whole_waves = view.whole;
    t.search_pixels = max(t.search_pixels, t.grazing);
    return t;
}

/* light_reach of the tile and of the same tile when the shutter opens, joined. The latter tile gets the result, too. `open_slots` is PassData.open_slots. */
int joined_reach(int closed, int open_slots)
{
    if (open_slots == 0)
        return closed;
    int opened = tile_slot + open_slots;
    int reach = reach_of_both(0, closed, tile_data[opened].light_reach);
    tile_data[opened].light_reach = reach;
    return reach;
}

/* Sorts the waves for the tile (tile_x, tile_y) of the view, and stores them at tile_slot. `open_slots` is PassData.open_slots, `parts` is TileData.parts. */
void sort_tile(int tile_x, int tile_y, int open_slots, int parts)
{
    int lane = int(gl_LocalInvocationIndex);
    float width = float(TILE_WIDTH) * VIEW(0).scale_x, height = float(TILE_HEIGHT) * VIEW(0).scale_y;
    float column = float(tile_x) * width, row = float(tile_y) * height;
    TileView view = tile_view(0, column, row, width, height);

    clear_bits(lane);
    barrier();
    for (int wave = lane; wave < pass_data.wave_count; wave += LANES)
        mark_wave(view, wave);
    barrier();
    Counts counts = count_all();
    for (int wave = lane; wave < pass_data.wave_count; wave += LANES)
        list_wave(view, counts, wave);
    for (int i = 0; i < TILE_SUMS; i++)
        sums[i * LANES + lane] = own.value[i];
    barrier();
    if (lane < TILE_SUMS) {
        float total = 0.0f;
        for (int i = 0; i < LANES; i++)
            total = lane < TILE_SUM_LARGEST ? total + sums[lane * LANES + i] : max(total, sums[lane * LANES + i]);
        totals[lane] = total;
    }
    barrier();
    if (lane == 0) {
        TileData tile = finished_tile(view, counts);
        tile.light_reach = joined_reach(tile_meets_light(0, column, row, width, height) > 0.0f ? 1 : 0, open_slots);
        tile.parts = parts;
        tile_data[tile_slot] = tile;
    }
}
