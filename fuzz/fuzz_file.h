/* SPDX-License-Identifier: MIT
 *
 * Inputs of readers that open files by their path. Define _GNU_SOURCE before the first #include.
 */
#ifndef MANGATA_FUZZ_FUZZ_FILE_H
#define MANGATA_FUZZ_FUZZ_FILE_H

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz.h"
#include "image/file_whole.h"
#include "image/metadata.h"

typedef struct fuzz_file {
    int descriptor;
    char path[64];
} fuzz_file;

/* The input as a file in memory. */
static inline fuzz_file fuzz_file_open(const uint8_t *bytes, size_t size)
{
    fuzz_file file = {.descriptor = memfd_create("fuzz", MFD_CLOEXEC)};
    fuzz_require(file.descriptor >= 0 && write(file.descriptor, bytes, size) == (ssize_t)size, "no memory file");
    snprintf(file.path, sizeof file.path, "/proc/self/fd/%d", file.descriptor);
    return file;
}

/* Reads what --skip-existing reads of any output, and closes the file. */
static inline void fuzz_file_close(const fuzz_file *file)
{
    file_error error = {0};
    char *value = NULL;
    file_state state;
    if (metadata_read(file->path, "render_hash", &value, &error) != FILE_OK)
        fuzz_require_message(error.text);
    free(value);
    file_state_read(file->path, "render_hash", "abc", true, &state, &error);
    close(file->descriptor);
}

#endif
