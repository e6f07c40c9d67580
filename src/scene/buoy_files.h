/* SPDX-License-Identifier: MIT
 *
 * Spectra as buoys' owners publish them, turned into the plain table of spectrum_table_read.h.
 *
 * NDBC: STATION.data_spec with .swdir, .swdir2, .swr1 and .swr2 beside it, as of its real-time service, or STATIONwYEAR.txt with the letters d, i, j and k in
 * place of w, as of its archive. The first record of the density's file is taken, the others are looked for at its time. Datawell: .spt files.
 */
#ifndef MANGATA_SCENE_BUOY_FILES_H
#define MANGATA_SCENE_BUOY_FILES_H

#include "scene/scene_text.h"

typedef enum buoy_format { BUOY_TABLE, BUOY_NDBC, BUOY_DATAWELL } buoy_format;

/* A line of a converted table: the lines after it come from this line and column of the file. */
#define BUOY_PLACE "# %d %d"

/* By how a file begins. Texts end with a NUL here and below, as buoy_file_read() leaves them. */
buoy_format buoy_format_of(const char *text);

/* A whole file of at most 16 MiB with a NUL behind; the caller frees it. NULL with *error filled. */
char *buoy_file_read(const char *path, size_t *length, scene_error *error);

/* The plain table of a file of one of the other formats, NUL-terminated; the caller frees it. NULL with *error filled: "path:line:column: …". */
char *buoy_file_convert(buoy_format format, const char *path, const char *text, scene_error *error);

#endif
