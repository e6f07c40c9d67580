/* SPDX-License-Identifier: MIT
 *
 * The stars that the naked eye sees.
 */
#include "frame/stars.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/hash.h"

#define PI 3.14159265358979323846

enum { CELLS = STAR_CELLS * STAR_CELLS };

/* Number of stars in the whole sky that are brighter than the visual magnitudes −1, 0, 1, … */
static const double counts[] = {1, 4, 15, 48, 171, 513, 1602, 4800, 14000};
enum { LAST = sizeof counts / sizeof *counts - 1 };

double stars_magnitude_of(double rank)
{
    int i = 0;
    while (i < LAST - 1 && counts[i + 1] < rank)
        i++;
    return i - 1 + log(rank / counts[i]) / log(counts[i + 1] / counts[i]);
}

double stars_illuminance(double magnitude) { return 2.54e-9 * pow(10, -0.4 * magnitude); }

/* Illuminance of the i-th brightest star of the upper hemisphere, which has every second star of the whole sky. */
static double illuminance_of(int i) { return stars_illuminance(stars_magnitude_of(2 * i + 1)); }

double stars_mean_radiance(void)
{
    double sum = 0;
    for (int i = 0; i < STAR_COUNT; i++)
        sum += illuminance_of(i);
    return sum / (2 * PI);
}

/* A random number in [0, 1). */
static double chance(uint64_t *state) { return hash_fraction(hash_next(state)); }

static int cell_of(const float star[3])
{
    const double x = fmod((double)star[0], 4), z = (double)star[1];
    return (int)(z * (0.5 * STAR_CELLS)) * STAR_CELLS + (int)(x * (0.5 * STAR_CELLS));
}

/* Places a star evenly over the disk, an equal-area map of the hemisphere. No cell gets more stars than the kernel reads. */
static void place_star(uint64_t *state, int count[CELLS], float star[3])
{
    for (;;) {
        const double x = 2 * chance(state) - 1, z = 2 * chance(state) - 1, color = floor(8 * chance(state));
        star[0] = (float)(4 * color + 1 + x);
        star[1] = (float)(1 + z);
        if (x * x + z * z < 0.9999 && count[cell_of(star)] < STARS_A_CELL)
            return;
    }
}

static void fill_places(float *cells, float *list)
{
    int count[CELLS] = {0}, first[CELLS];
    float stars[STAR_COUNT][3];
    uint64_t state = 1;
    for (int i = 0; i < STAR_COUNT; i++) {
        place_star(&state, count, stars[i]);
        stars[i][2] = (float)illuminance_of(i);
        count[cell_of(stars[i])]++;
    }
    for (int cell = 0, next = 0; cell < CELLS; next += count[cell++]) {
        first[cell] = next;
        cells[3 * cell] = (float)next;
        cells[3 * cell + 1] = (float)count[cell];
    }
    for (int i = 0; i < STAR_COUNT; i++)
        memcpy(list + 3 * first[cell_of(stars[i])]++, stars[i], sizeof stars[i]);
}

static void add_cell(const float *table, int cell_x, int cell_z, const double direction[3], double radius, double rgb[3])
{
    const float *cell = table + 3 * (SKY_COLUMNS * STAR_CELL_ROW + cell_z * STAR_CELLS + cell_x);
    const float *star = table + 3 * (SKY_COLUMNS * STAR_ROW + (int)cell[0]);
    for (int i = 0; i < (int)cell[1]; i++, star += 3) {
        const double color = floor(0.25 * (double)star[0]), x = (double)star[0] - 4 * color - 1, z = (double)star[1] - 1, squared = x * x + z * z;
        const double across = sqrt(2 - squared);
        const double away[3] = {x * across - direction[0], 1 - squared - direction[1], z * across - direction[2]};
        const double fall = fmax(1 - (away[0] * away[0] + away[1] * away[1] + away[2] * away[2]) / (radius * radius), 0);
        const double redder = 2 * color / 7 - 1, light = (double)star[2] * fall * fall * fall;
        rgb[0] += light * (1 + 0.25 * redder);
        rgb[1] += light * (1 - 0.026 * redder);
        rgb[2] += light * (1 - 0.479 * redder);
    }
}

void stars_lookup(const float *table, const double direction[3], double pixel_angle, double rgb[3])
{
    const double reach = 1.0 / STAR_CELLS, radius = fmin(STAR_SPOT * pixel_angle, reach);
    const double shown = fmin(fmax(2 - STAR_SPOT * pixel_angle / reach, 0), 1), across = sqrt(1 + direction[1]);
    const int cell_x = (int)fmin(fmax(floor((direction[0] / across + 1) * 0.5 * STAR_CELLS - 0.5), 0), STAR_CELLS - 2);
    const int cell_z = (int)fmin(fmax(floor((direction[2] / across + 1) * 0.5 * STAR_CELLS - 0.5), 0), STAR_CELLS - 2);
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int i = 0; i < 4; i++)
        add_cell(table, cell_x + i % 2, cell_z + i / 2, direction, radius, rgb);
    const double v = sqrt(direction[1]) * (SKY_ROWS - 1), row = fmin(floor(v), SKY_ROWS - 2);
    const float *clear = table + 3 * SKY_COLUMNS * STAR_CLEAR_ROW, *low = clear + 3 * (int)row, *mean = clear + 3 * SKY_ROWS;
    for (int c = 0; c < 3; c++)
        rgb[c] = shown * (rgb[c] * 4 / (PI * radius * radius) - (double)mean[c]) * ((double)low[c] + ((double)low[c + 3] - (double)low[c]) * (v - row));
}

void stars_fill(const scattering *air, const spectrum_weights *weights, const float night[3], float *table)
{
    static const double white[3] = {1, 1, 1};
    float *clear = table + 3 * SKY_COLUMNS * STAR_CLEAR_ROW;
    for (int row = 0; row < SKY_ROWS; row++) {
        const double v = (double)row / (SKY_ROWS - 1);
        double through[SPECTRUM_BANDS], rgb[3];
        scattering_transmittance(air, v * v, through);
        spectrum_to_rgb(weights, through, white, rgb);
        for (int c = 0; c < 3; c++)
            clear[3 * row + c] = (float)rgb[c];
    }
    const float mean = (float)stars_mean_radiance();
    for (int c = 0; c < 3; c++)
        clear[3 * SKY_ROWS + c] = fminf(mean, night[c]);
    fill_places(table + 3 * SKY_COLUMNS * STAR_CELL_ROW, table + 3 * SKY_COLUMNS * STAR_ROW);
}
