/* SPDX-License-Identifier: MIT
 * What lean_rows() of a baseline_kernels reads, made from the waves of a map of slope moments. */
#ifndef MANGATA_CPU_LEAN_ROWS_H
#define MANGATA_CPU_LEAN_ROWS_H

#include <math.h>

#include "cpu/lean_map.h"

/* After all other headers. */
#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/baselines/lean_moments.k"
#include "kernels/waves/lean_grid.k"

/* Of LEAN_SIZE equal parts of a turn. */
static inline void lean_fill_cosines(float *cosines)
{
    for (int i = 0; i < LEAN_SIZE; i++)
        cosines[i] = (float)cos(6.28318530717958647692 * i / LEAN_SIZE);
}

/* The part of `columns`, which become lean_waves.columns, that belongs to a block of LEAN_BLOCK columns. */
static inline void lean_fill_block(const lean_waves *waves, const float *cosines, size_t block, float *columns)
{
    float *out = columns + block * waves->count * 2 * LEAN_BLOCK;
    for (size_t i = 0; i < waves->count; i++, out += 2 * LEAN_BLOCK)
        for (int x = 0; x < LEAN_BLOCK; x++) {
            const int parts = (int)lean_column_part(waves, i, block * LEAN_BLOCK + (size_t)x);
            out[x] = cosines[grid_parts(NULL, parts)];
            out[LEAN_BLOCK + x] = cosines[grid_parts(NULL, parts + 3 * LEAN_SIZE / 4)];
        }
}

/* A phase per wave for LEAN_ROWS rows from `row` on. */
static inline void lean_fill_phases(const lean_waves *waves, size_t row, lean_phase *phases)
{
    for (size_t i = 0; i < waves->count; i++)
        for (int r = 0; r < LEAN_ROWS; r++) {
            const double angle = lean_row_angle(waves, i, row + (size_t)r);
            phases[i].cosine[r] = (float)cos(angle);
            phases[i].minus_sine[r] = (float)-sin(angle);
        }
}

#endif
