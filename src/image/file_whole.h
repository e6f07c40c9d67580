/* SPDX-License-Identifier: MIT */
/* Checks that a file is as it was written. PNG has checksums of its own. The other formats record the file's CRC-32 (ISO 3309, as in PNG and zip) as 8
 * hexadecimal digits under FILE_CHECK_KEY: EXR in the file itself, where these digits count as zeros; PFM, y4m, mp4 and mov in the sidecar. */
#ifndef MANGATA_IMAGE_FILE_WHOLE_H
#define MANGATA_IMAGE_FILE_WHOLE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/output_file.h"

#define FILE_CHECK_KEY "file_crc32"
/* Placeholder of the same length as a checksum, while a file is written. */
#define FILE_CHECK_NONE "00000000"

/* State of an existing file, compared with the one that would be written. */
typedef enum file_state {
    FILE_STATE_OTHER,   /* it records another value, or nothing */
    FILE_STATE_SAME,    /* it records this value and is as it was written */
    FILE_STATE_DAMAGED, /* it is empty, or it begins like its format and is truncated or changed */
} file_state;

/* Finds the state of the file at `path`, which should record `value` for `key`. `whole`: all its bytes are read and checked. Returns FILE_OK, FILE_MISSING or
 * FILE_MEMORY. */
file_status file_state_read(const char *path, const char *key, const char *value, bool whole, file_state *state, file_error *error);

/* Writes the checksum of the first `size` bytes of a finished file as text. FILE_WRITE: the file cannot be read. */
file_status file_check_of(int descriptor, uint64_t size, const char *path, char digits[9], file_error *error);

/* Replaces FILE_CHECK_NONE in the header of a finished EXR by its checksum. Does nothing if the header has no placeholder. */
file_status file_check_seal_exr(output_file *file, const char *path, file_error *error);

#endif
