/* SPDX-License-Identifier: MIT */
/* Errors of files as the public header has them. Private to src/io. */
#ifndef MANGATA_IO_IO_ERROR_H
#define MANGATA_IO_IO_ERROR_H

#include "image/file_error.h"
#include "mangata/io.h"

/* An error of no file. `error` may be NULL, as below. Returns `status`. */
mgt_io_status io_error_take(mgt_io_error *error, mgt_io_status status, const char *text);

/* Takes a line apart that may begin with the name of the file `path`, "path: what is wrong" or "path:line:column: what is wrong". `shown`: the name as such
 * lines have it. Returns `status`. */
mgt_io_status io_error_take_file(mgt_io_error *error, mgt_io_status status, const char *text, const char *path, const char *shown);

/* The same of a file error; `path` NULL: it is of no file. */
mgt_io_status io_error_of_file(mgt_io_error *error, const file_error *from, const char *path);

/* Copies a text of src/scene in the words of the library: what the command has as "--set key=value" and "--sea words" is "change key=value" and "sea words"
 * here. `size` is at least 1; what does not fit is left out. */
void io_copy_words(char *out, size_t size, const char *text);

#endif
