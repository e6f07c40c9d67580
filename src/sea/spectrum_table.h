/* SPDX-License-Identifier: MIT
 *
 * A measured directional spectrum: densities at frequencies and directions. Between its points the density is linear in frequency and in direction around the
 * circle, so that integrals are sums of trapezia. A gap of more than 90° between neighbouring directions counts as not measured and has no density.
 */
#ifndef MANGATA_SEA_SPECTRUM_TABLE_H
#define MANGATA_SEA_SPECTRUM_TABLE_H

#include <stddef.h>

typedef struct spectrum_row {
    double frequency;    /* rad/s */
    double density;      /* density over all directions, m²·s/rad */
    size_t first, count; /* the row's points in spectrum_table.points */
} spectrum_row;

typedef struct spectrum_point {
    double azimuth;   /* where the waves travel to, radians in [0, 2π) clockwise from -z; rising within a row */
    double density;   /* m²·s/rad² */
    int line, column; /* place in the file that it was read from; both start at 1 */
} spectrum_point;

typedef struct spectrum_table {
    spectrum_row *rows; /* the table owns `rows` and `points` */
    size_t row_count;
    spectrum_point *points;
    size_t point_count;
} spectrum_table;

/* Angle from point i of a row to the next point around the circle, radians. */
double spectrum_row_gap(const spectrum_point *points, size_t count, size_t i);
/* Wider gaps count as not measured. */
#define SPECTRUM_WIDEST_GAP (SPECTRUM_PI / 2 * (1 + 1e-9))

void spectrum_table_free(spectrum_table *table);

/* Density over all directions, m²·s/rad; 0 outside of the table's frequencies. */
double spectrum_table_density(const spectrum_table *table, double frequency);

/* Density at an azimuth of travel, m²·s/rad². Outside of the table's frequencies it is that of the nearest row. */
double spectrum_table_at(const spectrum_table *table, double frequency, double azimuth);

/* Azimuth of the mean vector of the measured energy, radians. */
double spectrum_table_mean_azimuth(const spectrum_table *table);

#endif
