/* SPDX-License-Identifier: MIT */
/* Files of exact sums of samples (.sums). They are parts of a picture that several machines render, and checkpoints of a picture.
 *
 * Numbers are little endian. A file has these parts, one after the other:
 * - "mangata sums 1" and a newline;
 * - the length of the JSON object that follows, in 4 bytes. Its strings are the metadata, among them `pixels`, the size of the crop ("64x36"), and `ranges`,
 *   each a first sample and a count ("0,128 256,64");
 * - for each row of pixels and each word of a pixel: one byte, and then a range of the word's bytes for all pixels of the row. Bytes outside of the range are 0
 *   in all these pixels. The low half of the one byte is the number of bytes in the range, the high half the number of its first byte, where 0 is the lowest
 *   one;
 * - the CRC-32 of all these parts. */
#ifndef MANGATA_IMAGE_SUMS_FILE_H
#define MANGATA_IMAGE_SUMS_FILE_H

#include <jansson.h>

#include "image/metadata.h"
#include "image/output_file.h"
#include "image/picture_formats.h"

enum { SUMS_WORDS = 12, SUMS_RANGES_MOST = 1024 };

typedef struct sums_range {
    uint64_t first, count;
} sums_range;

/* Ranges of samples in increasing order. They neither overlap nor touch. */
typedef struct sums_ranges {
    size_t count;
    sums_range items[SUMS_RANGES_MOST];
} sums_ranges;

typedef enum sums_joined { SUMS_JOINED = 0, SUMS_OVERLAP, SUMS_TOO_MANY } sums_joined;

/* Adds a range to the list. SUMS_OVERLAP: it has samples of the list; *overlap becomes the first range that both have, and the list does not change. */
sums_joined sums_ranges_join(sums_ranges *list, sums_range more, sums_range *overlap);

/* The first range within `all` that the list lacks; count 0: there is none. */
sums_range sums_ranges_gap(const sums_ranges *list, sums_range all);

/* Writes a file. `sums`: SUMS_WORDS words per pixel, tightly packed. `ranges`: the samples in the sums. */
file_status sums_write(const char *path, uint32_t width, uint32_t height, const uint64_t *sums, const sums_ranges *ranges, const metadata_list *metadata,
                       const output_options *options, file_error *error);

typedef struct sums_file {
    input_file input; /* the file, at its first row */
    json_t *metadata;
    uint32_t width, height;
    sums_ranges ranges;
    uint32_t crc; /* checksum of the bytes read so far */
} sums_file;

/* Opens a file and reads all before the first row. On failure returns FILE_MISSING, FILE_BAD or FILE_MEMORY, and *file is zeroed. */
file_status sums_open(sums_file *file, const char *path, file_error *error);
void sums_close(sums_file *file);

/* Whether a file that gives FILE_BAD in sums_open() is a damaged or truncated file of sums, not one of another kind: it is empty or begins like a file of
 * sums. */
bool sums_are_begun(const char *path);

/* The value that the file records for `key`; NULL: there is none. It is valid while the file is open. */
const char *sums_metadata(const sums_file *file, const char *key);

/* Adds the file's sums to those of width × height pixels. FILE_BAD: the file has another size or is damaged, and `sums` are undefined. */
file_status sums_add(sums_file *file, uint32_t width, uint32_t height, uint64_t *sums, file_error *error);

/* Whether the checksum of an open file of sums is that of its bytes. The stream is at its start. */
bool sums_are_whole(const input_file *input);
/* Reads the value that an open file of sums records for `key`. The stream is at its start. The caller frees *value. */
file_status sums_metadata_read(const input_file *input, const char *key, char **value, file_error *error);

#endif
