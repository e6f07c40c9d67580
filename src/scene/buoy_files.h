/* SPDX-License-Identifier: MIT
 *
 * Converts published spectra of buoys to the plain table of spectrum_table_read.h.
 *
 * NDBC: STATION.data_spec of its real-time service, with .swdir, .swdir2, .swr1 and .swr2 beside it, or STATIONwYEAR.txt of its archive, with the letters d, i,
 * j and k in place of w. The first record of the density's file is taken, and the other files must have a record of the same time. Datawell: .spt files.
 */
#ifndef MANGATA_SCENE_BUOY_FILES_H
#define MANGATA_SCENE_BUOY_FILES_H

#include "scene/scene_text.h"

typedef enum buoy_format { BUOY_TABLE, BUOY_NDBC, BUOY_DATAWELL } buoy_format;

/* Format of a comment line in a converted table. The lines behind it come from this line and column of the file. */
#define BUOY_PLACE "# %d %d"

/* The format by the beginning of a file. Here and below texts are NUL-terminated, as buoy_file_read() returns them. */
buoy_format buoy_format_of(const char *text);

/* Reads a whole file of at most 16 MiB without its byte order mark, and appends a NUL. The caller frees the text. NULL: *error is filled. */
char *buoy_file_read(const char *path, size_t *length, scene_error *error);

/* The plain table of a file of another format than BUOY_TABLE, NUL-terminated. The caller frees it. NULL: *error is filled with "path:line:column: …". */
char *buoy_file_convert(buoy_format format, const char *path, const char *text, scene_error *error);

#endif
