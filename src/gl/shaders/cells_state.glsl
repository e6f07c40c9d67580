/* SPDX-License-Identifier: MIT
 *
 * The state of method adaptive's cells between passes: words of the frame, words of each tile, and lists. See cells_layout.h.
 */
#include "pass_data.k"

layout(std140, binding = 3) uniform CellsBlock { CellsData cells_data; };
layout(std430, binding = 5) buffer StateBlock { uint state[]; };

double state_double(int at) { return packDouble2x32(uvec2(state[at], state[at + 1])); }

void set_state_double(int at, double value)
{
    uvec2 words = unpackDouble2x32(value);
    state[at] = words.x;
    state[at + 1] = words.y;
}

int tile_words(int tile) { return CELLS_TILES + tile * CELLS_TILE_WORDS; }

/* Number of a size of cells, in order of level, then of halvings across. Level 0 has no number. */
int cell_size(int across, int down)
{
    int level = (across + down) / 2;
    return level * level - 1 + across;
}

/* Number of pieces of the shutter that leaves of a class see, see leaf_class(). */
int parts_of_class(int kind) { return kind == CELLS_WHOLE ? 1 : kind == CELLS_PARTS ? cells_data.parts_1 : cells_data.parts_2; }

int halvings_across(int split) { return split == SPLIT_EVEN ? 1 : split == SPLIT_ROWS ? 0 : 2; }
int halvings_down(int split) { return 2 - halvings_across(split); }
