/* SPDX-License-Identifier: MIT
 * Level 0 of the map of slope moments of method leadr, by bands of rows, in half precision. Shaders make its other levels. */
#include "page.h"

#include <stdlib.h>
#include <string.h>

#include "cpu/baseline_lanes.h"
#include "cpu/lean_rows.h"

enum { BAND_ROWS = 64 };

static lean_waves waves;
static float *columns; /* as lean_waves.columns; of the waves' periods alone */
static float rows[2][LEAN_ROWS * LEAN_SIZE];
static uint16_t band[BAND_ROWS * LEAN_SIZE][2];

static void make_columns(void)
{
    static float cosines[LEAN_SIZE];
    lean_fill_cosines(cosines);
    columns = realloc(columns, waves.count * LEAN_SIZE * 2 * sizeof *columns);
    if (waves.count > 0 && !columns)
        abort();
    for (size_t block = 0; block < LEAN_SIZE / LEAN_BLOCK; block++)
        lean_fill_block(&waves, cosines, block, columns);
}

void page_lean_begin(const lean_waves *of)
{
    bool same = columns && of->count == waves.count;
    for (size_t i = 0; same && i < of->count; i++)
        same = lean_column_part(of, i, 1) == lean_column_part(&waves, i, 1);
    waves = *of;
    if (!same)
        make_columns();
    waves.columns = columns;
}

/* Rounded to nearest; slopes are far from the largest half, and the smallest become 0. */
static uint16_t half_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000, size = (bits & 0x7fffffff) + 0x1000;
    return (uint16_t)(size < 0x38800000 ? sign : sign | (size - 0x38000000) >> 13);
}

EXPORT(lean_band_rows) int page_lean_band_rows(void) { return BAND_ROWS; }

/* Slopes x, z of the texels of a band of the prepared picture's map. */
EXPORT(lean_band) const uint16_t *page_lean_band(int index)
{
    static lean_phase phases[MGT_MAX_WAVES];
    for (size_t row = 0; row < BAND_ROWS; row += LEAN_ROWS) {
        lean_fill_phases(&waves, (size_t)index * BAND_ROWS + row, phases);
        baseline_kernels_4.lean_rows(&waves, phases, rows[0], rows[1]);
        for (size_t i = 0; i < LEAN_ROWS * LEAN_SIZE; i++)
            for (int c = 0; c < 2; c++)
                band[row * LEAN_SIZE + i][c] = half_of(rows[c][i]);
    }
    return &band[0][0];
}
