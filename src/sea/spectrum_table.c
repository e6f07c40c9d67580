/* SPDX-License-Identifier: MIT
 *
 * Interpolation and means of a measured spectrum.
 */
#include "sea/spectrum_table.h"

#include <math.h>
#include <stdlib.h>

#include "sea/spectrum_math.h"

static const double TURN = 2 * SPECTRUM_PI, WIDEST_GAP = SPECTRUM_WIDEST_GAP;

double spectrum_row_gap(const spectrum_point *points, size_t count, size_t i)
{
    return i + 1 < count ? points[i + 1].azimuth - points[i].azimuth : points[0].azimuth + TURN - points[i].azimuth;
}

void spectrum_table_free(spectrum_table *table)
{
    free(table->rows);
    free(table->points);
    *table = (spectrum_table){0};
}

/* The last row at or before a frequency within the table, but at most the last but one. */
static size_t find_row(const spectrum_table *table, double frequency)
{
    size_t low = 0, high = table->row_count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (table->rows[middle].frequency <= frequency)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double spectrum_table_density(const spectrum_table *table, double frequency)
{
    const spectrum_row *rows = table->rows;
    if (frequency < rows[0].frequency || frequency > rows[table->row_count - 1].frequency)
        return 0;
    const size_t i = find_row(table, frequency);
    const double t = (frequency - rows[i].frequency) / (rows[i + 1].frequency - rows[i].frequency);
    return (1 - t) * rows[i].density + t * rows[i + 1].density;
}

static double row_at(const spectrum_table *table, const spectrum_row *row, double azimuth)
{
    const spectrum_point *points = table->points + row->first;
    size_t low = 0, high = row->count;
    while (low < high) { /* `low` becomes the number of points at or before the azimuth */
        const size_t middle = low + (high - low) / 2;
        if (points[middle].azimuth <= azimuth)
            low = middle + 1;
        else
            high = middle;
    }
    const size_t i = low > 0 ? low - 1 : row->count - 1;
    const double gap = spectrum_row_gap(points, row->count, i), past = azimuth - points[i].azimuth + (low > 0 ? 0 : TURN);
    if (gap > WIDEST_GAP)
        return 0;
    return points[i].density + (points[(i + 1) % row->count].density - points[i].density) * past / gap;
}

double spectrum_table_at(const spectrum_table *table, double frequency, double azimuth)
{
    const spectrum_row *rows = table->rows, *last = &rows[table->row_count - 1];
    azimuth -= TURN * floor(azimuth / TURN);
    if (frequency <= rows[0].frequency)
        return row_at(table, rows, azimuth);
    if (frequency >= last->frequency)
        return row_at(table, last, azimuth);
    const size_t i = find_row(table, frequency);
    const double t = (frequency - rows[i].frequency) / (rows[i + 1].frequency - rows[i].frequency);
    return (1 - t) * row_at(table, &rows[i], azimuth) + t * row_at(table, &rows[i + 1], azimuth);
}

double spectrum_table_mean_azimuth(const spectrum_table *table)
{
    double east = 0, north = 0;
    for (size_t i = 0; i < table->row_count; i++) {
        const spectrum_row *row = &table->rows[i];
        const double before = i > 0 ? row->frequency - row[-1].frequency : 0;
        const double after = i + 1 < table->row_count ? row[1].frequency - row->frequency : 0;
        const spectrum_point *points = table->points + row->first;
        for (size_t j = 0; j < row->count; j++) {
            const double behind = spectrum_row_gap(points, row->count, (j + row->count - 1) % row->count), ahead = spectrum_row_gap(points, row->count, j);
            const double width = (behind <= WIDEST_GAP ? behind : 0) + (ahead <= WIDEST_GAP ? ahead : 0);
            const double energy = (before + after) * width * points[j].density;
            east += energy * portable_sin(points[j].azimuth);
            north += energy * portable_cos(points[j].azimuth);
        }
    }
    if (!(east * east + north * north > 0))
        return 0;
    /* Bisection gives the same bits on every machine. */
    const double length = sqrt(east * east + north * north);
    double low = 0, high = SPECTRUM_PI;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        if (portable_cos(middle) > north / length)
            low = middle;
        else
            high = middle;
    }
    return east >= 0 ? low : TURN - low;
}
