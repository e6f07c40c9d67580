/* SPDX-License-Identifier: MIT
 * Files that are named by a user: opened only where they are regular, so that a named pipe or a device never makes a reader wait. */
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
    REGULAR_FILE_OTHER, /* a named pipe, a device or a socket */
    REGULAR_FILE_LARGE, /* larger than the reader allows */
    REGULAR_FILE_MEMORY /* an allocation failed */
} regular_file_fault;

typedef struct regular_file {
    FILE *stream; /* at the file's beginning; the caller closes it */
    uint64_t size;
    regular_file_fault fault;
    const char *what; /* where there is a fault: "is a directory"; valid until the thread's next system call that fails */
} regular_file;

/* Opens a file for reading. Returns true where `file->stream` is open; else `file` holds the fault. */
bool regular_file_open(regular_file *file, const char *path);

/* The whole file, and a NUL behind it; `most` is the largest number of bytes allowed. `path` "-" is standard input where `or_standard_input` says so.
 * `what` names `most` where the file is larger: "is larger than 16 MiB". Returns NULL on failure, with `file` holding the fault; the caller frees the
 * result. `file->stream` is closed in any case. */
char *regular_file_read(regular_file *file, const char *path, bool or_standard_input, size_t most, const char *what, size_t *length);

#endif
