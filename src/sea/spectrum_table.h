/* SPDX-License-Identifier: MIT
 *
 * A directional spectrum as it was measured: densities at frequencies and directions. Between the points the density is linear in frequency and in direction
 * around the circle, so that integrals are sums of trapezia; a gap of more than 90° between neighbouring directions was not measured and counts as empty.
 */
#ifndef MANGATA_SEA_SPECTRUM_TABLE_H
#define MANGATA_SEA_SPECTRUM_TABLE_H

#include <stddef.h>

typedef struct spectrum_row {
    double frequency; /* rad/s */
    double density;   /* m²·s/rad, over all directions */
    size_t first, count;
} spectrum_row;

typedef struct spectrum_point {
    double azimuth;   /* radians in [0, 2π), where the waves travel to, clockwise from -z; rising within a row */
    double density;   /* m²·s/rad² */
    int line, column; /* of the file that it was read from, from 1 */
} spectrum_point;

typedef struct spectrum_table {
    spectrum_row *rows; /* owned, as is `points` */
    size_t row_count;
    spectrum_point *points;
    size_t point_count;
} spectrum_table;

/* Radians from point i of a row to the next around the circle, and the widest that is no hole. */
double spectrum_row_gap(const spectrum_point *points, size_t count, size_t i);
#define SPECTRUM_WIDEST_GAP (SPECTRUM_PI / 2 * (1 + 1e-9))

void spectrum_table_free(spectrum_table *table);

/* Density over all directions, m²·s/rad; 0 beyond the table's frequencies. */
double spectrum_table_density(const spectrum_table *table, double frequency);

/* Density at a direction of travel in radians, m²·s/rad²; beyond the table's frequencies that of the nearest row. */
double spectrum_table_at(const spectrum_table *table, double frequency, double azimuth);

/* Where the measured waves travel to on the whole, radians (the mean vector of their energy). */
double spectrum_table_mean_azimuth(const spectrum_table *table);

#endif
