/* SPDX-License-Identifier: MIT
 * Opens files that a user names. Only regular files are opened, because a named pipe or a device could block the reader. */
#ifndef MANGATA_BASE_REGULAR_FILE_H
#define MANGATA_BASE_REGULAR_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum regular_file_fault {
    REGULAR_FILE_SOUND = 0,
    REGULAR_FILE_MISSING, /* it does not exist or cannot be read */
    REGULAR_FILE_FOLDER,
    REGULAR_FILE_OTHER, /* it is a named pipe, a device or a socket */
    REGULAR_FILE_LARGE, /* it is larger than the reader allows */
    REGULAR_FILE_MEMORY /* out of memory */
} regular_file_fault;

typedef struct regular_file {
    FILE *stream; /* at the file's beginning; the caller closes it */
    uint64_t size;
    regular_file_fault fault;
    const char *what; /* text of the fault, such as "is a directory"; valid until the thread's next system call that fails */
} regular_file;

/* Opens a file for reading. True: `file->stream` is open. False: `file` holds the fault. */
bool regular_file_open(regular_file *file, const char *path);

/* Reads a whole file of at most `most` bytes, and appends a NUL. If `or_standard_input` is true, `path` "-" is standard input. `what`: text of the fault of a
 * file that is larger, such as "is larger than 16 MiB". The caller frees the result. Returns NULL on failure, and `file` holds the fault. `file->stream` is
 * always closed. */
char *regular_file_read(regular_file *file, const char *path, bool or_standard_input, size_t most, const char *what, size_t *length);

#endif
