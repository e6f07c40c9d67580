/* SPDX-License-Identifier: MIT */
/* Output that appears whole or not at all: a hidden temporary file in the target's folder, renamed when it is complete.
 * A process that is killed leaves at most that hidden file (.mangata-PID-N.tmp), never a part of a file under a final name.
 * Clean SIGINT: the handler sets the flag that `cancel` points at; whoever writes then removes the file and says FILE_CANCELLED. */
#ifndef MANGATA_IMAGE_OUTPUT_FILE_H
#define MANGATA_IMAGE_OUTPUT_FILE_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"

/* How every writer of src/image treats its target. NULL for a pointer to this means all zero. */
typedef struct output_options {
    bool overwrite;                      /* replace an existing file; else FILE_EXISTS */
    const volatile sig_atomic_t *cancel; /* NULL, or a flag that a signal handler sets: once it is not zero a writer removes
                                            its temporary file and returns FILE_CANCELLED */
} output_options;

typedef struct output_file output_file;

/* Whether `path` can be written as things stand: its folder exists and is writable, the name is free (or overwrite), no
 * directory or device is in the way. For an early message before hours of rendering; writers check again, without a race. */
file_status output_file_check(const char *path, const output_options *options, file_error *error);

/* The same of its folder alone: whether it exists. */
file_status output_file_check_folder(const char *path, file_error *error);

/* FILE_WRITE where a directory, a device or a named pipe has this name, else FILE_OK: to be asked before a name is judged by its extension. */
file_status output_file_check_kind(const char *path, file_error *error);

/* Opens the temporary file. On failure *file is NULL and nothing is left behind. */
file_status output_file_open(output_file **file, const char *path, const output_options *options, file_error *error);

/* Appends; or writes at `offset` without moving the end of the appended part. */
file_status output_file_write(output_file *file, const void *bytes, size_t size, file_error *error);
file_status output_file_write_at(output_file *file, uint64_t offset, const void *bytes, size_t size, file_error *error);

/* Path of the temporary file, for a subprocess that writes it itself, and its descriptor (still owned by `file`). */
const char *output_file_temporary_path(const output_file *file);
int output_file_descriptor(const output_file *file);

/* FILE_CANCELLED when the cancel flag is set. */
file_status output_file_check_cancel(const output_file *file, file_error *error);

/* Flushes to the disk without giving the final name yet: for files that must appear together. */
file_status output_file_sync(output_file *file, file_error *error);

/* Flushes, then gives the file its final name and flushes the folder. Frees `file` in every case; on failure the temporary file
 * is removed. */
file_status output_file_finish(output_file *file, file_error *error);

/* Gives the final name to a file that output_file_sync() has flushed, whatever the cancel flag says. Without `replace` FILE_EXISTS where the name is taken; then
 * the call may be made again. Does not free `file`. */
file_status output_file_publish(output_file *file, bool replace, file_error *error);

bool output_file_is_published(const output_file *file);

/* What stands under the final name now. Check: FILE_OK where `file` may have the name, FILE_EXISTS, FILE_WRITE. Open: a descriptor of the caller's, not through a
 * link; -1 and errno. Is: whether that is the open file `descriptor`. */
file_status output_file_check_target(const output_file *file, bool overwrite, file_error *error);
int output_file_open_target(const output_file *file);
bool output_file_is_target(const output_file *file, int descriptor);
void output_file_remove_target(const output_file *file);

/* A whole file at once. */
file_status output_file_write_whole(const char *path, const void *bytes, size_t size, const output_options *options, file_error *error);

/* Removes the temporary file and frees `file`. NULL is allowed. */
void output_file_abort(output_file *file);

#endif
