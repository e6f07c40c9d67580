/* SPDX-License-Identifier: MIT */
/* Errors of files as an mgt_io_error. Private to src/io. */
#ifndef MANGATA_IO_IO_ERROR_H
#define MANGATA_IO_IO_ERROR_H

#include "image/file_error.h"
#include "mangata/io.h"

/* Fills `error` with a text that concerns no file. NULL is allowed, as below. Returns `status`. */
mgt_io_status io_error_take(mgt_io_error *error, mgt_io_status status, const char *text);

/* Fills `error` from a line that may begin with the name of the file `path`, "path: what is wrong" or "path:line:column: what is wrong". `shown`: the name as
 * such lines have it. Returns `status`. */
mgt_io_status io_error_take_file(mgt_io_error *error, mgt_io_status status, const char *text, const char *path, const char *shown);

/* Fills `error` from a file_error. `path`: the file, or NULL if it concerns none. Returns the status for it. */
mgt_io_status io_error_of_file(mgt_io_error *error, const file_error *from, const char *path);

/* Copies a text of src/scene in the words of the library. "--set key=value" and "--sea words" of the command become "change key=value" and "sea words". What
 * does not fit into `size`, at least 1, is left out. */
void io_copy_words(char *out, size_t size, const char *text);

#endif
