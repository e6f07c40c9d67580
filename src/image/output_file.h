/* SPDX-License-Identifier: MIT */
/* Output files that appear whole or not at all. A file is written under a hidden temporary name in the target's folder and renamed when it is complete. A
 * process that is killed leaves at most that hidden file (.mangata-PID-N.tmp), never a part of a file under its final name. A symbolic link is followed: it
 * stays, and the file that it names is written. In a sticky folder that all may write to, only links of the user and of the folder's owner are followed. A
 * file that replaces another one takes its permission bits. To end cleanly on SIGINT, the
 * handler sets the flag `cancel`; the writer then removes the file and returns FILE_CANCELLED. */
#ifndef MANGATA_IMAGE_OUTPUT_FILE_H
#define MANGATA_IMAGE_OUTPUT_FILE_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"

/* Options that all writers of src/image have. A NULL pointer to it means all zero. */
typedef struct output_options {
    bool overwrite;                      /* an existing file is replaced; false: it gives FILE_EXISTS */
    const volatile sig_atomic_t *cancel; /* NULL, or a flag that a signal handler sets: once it is not zero a writer removes
                                            its temporary file and returns FILE_CANCELLED */
} output_options;

typedef struct output_file output_file;

/* Checks that `path` can be written now: its folder exists and is writable, the name is free or may be overwritten, and it is no directory or device. It serves
 * to report errors before a long rendering. Writers check again without a race. */
file_status output_file_check(const char *path, const output_options *options, file_error *error);

/* Checks only that the folder of `path` exists. */
file_status output_file_check_folder(const char *path, file_error *error);

/* FILE_WRITE if a directory, a device or a named pipe has this name, else FILE_OK. Call it before checks of the extension, so that its message comes first. */
file_status output_file_check_kind(const char *path, file_error *error);

/* Opens the temporary file. On failure *file is NULL and no file is left. */
file_status output_file_open(output_file **file, const char *path, const output_options *options, file_error *error);

/* Appends bytes. */
file_status output_file_write(output_file *file, const void *bytes, size_t size, file_error *error);
/* Writes bytes at `offset`. The place at which output_file_write() appends stays. */
file_status output_file_write_at(output_file *file, uint64_t offset, const void *bytes, size_t size, file_error *error);

/* Path of the temporary file, for a subprocess that writes it. */
const char *output_file_temporary_path(const output_file *file);
/* Descriptor of the temporary file, which `file` owns. */
int output_file_descriptor(const output_file *file);

/* FILE_CANCELLED if the cancel flag is set, else FILE_OK. */
file_status output_file_check_cancel(const output_file *file, file_error *error);

/* Flushes the file to the disk, without its final name yet. For files that must appear together. */
file_status output_file_sync(output_file *file, file_error *error);

/* Flushes the file, gives it its final name and flushes the folder. Frees `file` in every case. On failure the temporary file is removed. */
file_status output_file_finish(output_file *file, file_error *error);

/* Gives the final name to a file that output_file_sync() has flushed, even if the cancel flag is set. FILE_EXISTS: `replace` is false and the name is taken;
 * the call may be repeated. Does not free `file`. */
file_status output_file_publish(output_file *file, bool replace, file_error *error);

bool output_file_is_published(const output_file *file);

/* Whether the final name may be taken now: FILE_OK, FILE_EXISTS or FILE_WRITE. */
file_status output_file_check_target(const output_file *file, bool overwrite, file_error *error);
/* A descriptor of the file that has the final name. The caller closes it. -1: errno tells why. */
int output_file_open_target(const output_file *file);
/* Whether `descriptor` is the file that has the final name. */
bool output_file_is_target(const output_file *file, int descriptor);
/* Removes the file that has the final name. */
void output_file_remove_target(const output_file *file);

/* Writes a whole file. */
file_status output_file_write_whole(const char *path, const void *bytes, size_t size, const output_options *options, file_error *error);

/* Removes the temporary file and frees `file`. NULL is allowed. */
void output_file_abort(output_file *file);

#endif
