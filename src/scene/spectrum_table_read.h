/* SPDX-License-Identifier: MIT
 *
 * Reads measured directional wave spectra from a plain table of frequency, direction and density.
 *
 * Each line has a frequency in Hz, the direction in degrees that the waves come from, clockwise from north (-z), and a density in m²/(Hz·degree), separated by
 * blanks, tabs or commas. `#` begins a comment. A first line of words may name the columns: `frequency direction density`; the name `density_rad` means
 * m²/(Hz·radian). Frequencies rise, and all lines of a frequency are consecutive. Each frequency may have its own directions, in any order. spectrum_table.h
 * tells how the density is interpolated.
 */
#ifndef MANGATA_SCENE_SPECTRUM_TABLE_READ_H
#define MANGATA_SCENE_SPECTRUM_TABLE_READ_H

#include "scene/scene_text.h"
#include "sea/spectrum_table.h"

enum { SPECTRUM_TABLE_POINTS = 500000 };

/* Reads a table from `text`. `name` is for errors. False: *error is filled with "name:line:column: what is wrong; allowed: …", and *out is empty. */
bool spectrum_table_parse(spectrum_table *out, const char *text, size_t length, const char *name, scene_error *error);

/* Reads a table from a file, which may also have one of the formats of buoy_files.h. */
bool spectrum_table_load(spectrum_table *out, const char *path, scene_error *error);

#endif
