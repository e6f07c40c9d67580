/* SPDX-License-Identifier: MIT */
/* Whether a file is as it was written. PNG has checksums of its own. The others record the file's CRC-32 (ISO 3309, as in PNG and zip) as 8 hexadecimal digits
 * under FILE_CHECK_KEY: EXR inside the file, whose digits there count as zeros; PFM, y4m, mp4 and mov in the sidecar. */
#ifndef MANGATA_IMAGE_FILE_WHOLE_H
#define MANGATA_IMAGE_FILE_WHOLE_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/output_file.h"

#define FILE_CHECK_KEY "file_crc32"
/* Placeholder of a checksum while a file is written; as long as one. */
#define FILE_CHECK_NONE "00000000"

/* An existing file compared with the one that would be written. */
typedef enum file_state {
    FILE_STATE_OTHER,   /* it records another value, or nothing */
    FILE_STATE_SAME,    /* it records this value and is as it was written */
    FILE_STATE_DAMAGED, /* it is empty, or begins as its format does and is cut short or changed */
} file_state;

/* The state of the file at `path`, which should record `value` for `key`. With `whole` all its bytes are read. FILE_MISSING, FILE_MEMORY, or FILE_OK. */
file_status file_state_read(const char *path, const char *key, const char *value, bool whole, file_state *state, file_error *error);

/* The checksum, as text, of the first `size` bytes of a file that has been written. FILE_WRITE: it cannot be read back. */
file_status file_check_of(int descriptor, uint64_t size, const char *path, char digits[9], file_error *error);

/* Writes a finished EXR's own checksum into its header, where FILE_CHECK_NONE stands. Nothing happens where it has none. */
file_status file_check_seal_exr(output_file *file, const char *path, file_error *error);

#endif
