/* SPDX-License-Identifier: MIT */
/* Whether a file is as it was written: PNG has checksums of its own, the others record the CRC-32 of the file (ISO 3309, as in PNG and zip) beside their
 * metadata: FILE_CHECK_KEY, 8 hexadecimal digits; EXR inside the file, of which those digits count as zeros, PFM, y4m and mp4 in the sidecar. */
#ifndef MANGATA_IMAGE_FILE_WHOLE_H
#define MANGATA_IMAGE_FILE_WHOLE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/output_file.h"

#define FILE_CHECK_KEY "file_crc32"
/* As long as a checksum; what stands in its place while a file is written. */
#define FILE_CHECK_NONE "00000000"

/* What a file is to somebody who would write it. */
typedef enum file_state {
    FILE_STATE_OTHER,   /* it records another value, or nothing */
    FILE_STATE_SAME,    /* it records this value and is as it was written */
    FILE_STATE_DAMAGED, /* it is empty, or begins as its format does and is cut short or changed */
} file_state;

/* What the file at `path` is where it should record `value` for `key`. With `whole` all its bytes are read. FILE_MISSING, FILE_MEMORY, or FILE_OK. */
file_status file_state_read(const char *path, const char *key, const char *value, bool whole, file_state *state, file_error *error);

/* The checksum of a file that is written, as text; `size` bytes of it. FILE_WRITE where it cannot be read. */
file_status file_check_of(int descriptor, uint64_t size, const char *path, char digits[9], file_error *error);

/* Writes a finished EXR's own checksum into its header, where FILE_CHECK_NONE stands. Nothing happens where it has none. */
file_status file_check_seal_exr(output_file *file, const char *path, file_error *error);

#endif
