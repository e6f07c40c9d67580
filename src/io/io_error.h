/* SPDX-License-Identifier: MIT */
/* Errors of files as the public header has them. Private to src/io. */
#ifndef MANGATA_IO_IO_ERROR_H
#define MANGATA_IO_IO_ERROR_H

#include "image/file_error.h"
#include "mangata/io.h"

/* Takes a line "file:line:column: what is wrong" apart; `error` may be NULL. Returns `status`. */
mgt_io_status io_error_take(mgt_io_error *error, mgt_io_status status, const char *text);

/* The same of a file error. */
mgt_io_status io_error_of_file(mgt_io_error *error, const file_error *from);

#endif
