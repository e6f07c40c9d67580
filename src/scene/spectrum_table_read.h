/* SPDX-License-Identifier: MIT
 *
 * Directional wave spectra as buoys report them: a plain table of frequency, direction, density.
 *
 * Each line holds a frequency in Hz, the direction in degrees that the waves come from, clockwise from north (-z), and a density in
 * m²/(Hz·degree), apart by blanks, tabs or commas. `#` begins a comment. A first line of words may name the columns: `frequency direction
 * density`, where `density_rad` instead of `density` says m²/(Hz·radian). Lines of one frequency stand together, frequencies rise; each may
 * have directions of its own, in any order. Between the points the density is linear in frequency and in direction around the circle, so that
 * integrals are sums of trapezia; a gap of more than 90° between neighbouring directions was not measured and counts as empty.
 */
#ifndef MANGATA_SCENE_SPECTRUM_TABLE_READ_H
#define MANGATA_SCENE_SPECTRUM_TABLE_READ_H

#include "scene/scene_text.h"
#include "sea/spectrum_table.h"

enum { SPECTRUM_TABLE_POINTS = 500000 };

/* Reads `text`, called `name` in errors, which are "name:line:column: what is wrong; allowed: …". False with *error filled and *out empty. */
bool spectrum_table_parse(spectrum_table *out, const char *text, size_t length, const char *name, scene_error *error);

/* The same from a file, or from one of the formats of buoy_files.h. */
bool spectrum_table_load(spectrum_table *out, const char *path, scene_error *error);

#endif
