/* SPDX-License-Identifier: MIT
 * Tables that baseline_kernels.lean_rows() reads, made from the waves of a lean_map. */
#ifndef MANGATA_CPU_LEAN_ROWS_H
#define MANGATA_CPU_LEAN_ROWS_H

#include <math.h>

#include "cpu/lean_map.h"

/* The prelude redefines names of other headers, so it comes last. */
#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/baselines/lean_moments.k"
#include "kernels/waves/lean_grid.k"

/* Fills the cosines of LEAN_SIZE equal parts of a turn. */
static inline void lean_fill_cosines(float *cosines)
{
    for (int i = 0; i < LEAN_SIZE; i++)
        cosines[i] = (float)cos(6.28318530717958647692 * i / LEAN_SIZE);
}

/* Fills one block of LEAN_BLOCK columns of what becomes lean_waves.columns. */
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

/* Fills one phase per wave for LEAN_ROWS rows from `row` on. */
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
