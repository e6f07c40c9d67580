/* SPDX-License-Identifier: MIT */
/* Files of exact sums of samples (.sums): parts of a picture that several machines share, and checkpoints of one.
 *
 * Numbers are little endian. A file holds, one after the other:
 * - "mangata sums 1" and a newline;
 * - 4 bytes, the length of the JSON object that follows: strings, the metadata, and among them `pixels` ("64x36", of the crop) and `ranges`
 *   ("0,128 256,64", each a first sample and a count);
 * - for each row of pixels, for each word of a pixel: one byte, then the bytes of that word of all the row's pixels that may be other than zero. The
 *   byte's low half is how many those are of each pixel, its high half which of the word's eight is the first, 0 being the lowest;
 * - the CRC-32 of all before. */
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

/* Ranges of samples in increasing order, which do not touch each other. */
typedef struct sums_ranges {
    size_t count;
    sums_range items[SUMS_RANGES_MOST];
} sums_ranges;

typedef enum sums_joined { SUMS_JOINED = 0, SUMS_OVERLAP, SUMS_TOO_MANY } sums_joined;

/* Adds samples that are not among those of the list. `overlap` becomes the first range of both where there is one; the list then stays as it is. */
sums_joined sums_ranges_join(sums_ranges *list, sums_range more, sums_range *overlap);

/* The first samples within `all` that the list lacks; count 0: none. */
sums_range sums_ranges_gap(const sums_ranges *list, sums_range all);

/* `sums`: SUMS_WORDS words a pixel, tightly packed, of samples that `ranges` names. */
file_status sums_write(const char *path, uint32_t width, uint32_t height, const uint64_t *sums, const sums_ranges *ranges, const metadata_list *metadata,
                       const output_options *options, file_error *error);

typedef struct sums_file {
    input_file input; /* at its first row */
    json_t *metadata;
    uint32_t width, height;
    sums_ranges ranges;
    uint32_t crc; /* of what has been read */
} sums_file;

/* Opens a file and reads all before the first row. FILE_MISSING, FILE_BAD or FILE_MEMORY; *file is then all zero. */
file_status sums_open(sums_file *file, const char *path, file_error *error);
void sums_close(sums_file *file);

/* Whether a file that sums_open() calls FILE_BAD begins like a file of sums, as far as it goes: it is damaged or was cut short, perhaps to nothing, and is not of
 * another kind. */
bool sums_are_begun(const char *path);

/* What it records for `key`; NULL: nothing. Lives as long as the file is open. */
const char *sums_metadata(const sums_file *file, const char *key);

/* Adds the file's sums to those of width × height pixels. FILE_BAD where it has others, or is not as it was written: `sums` are then useless. */
file_status sums_add(sums_file *file, uint32_t width, uint32_t height, uint64_t *sums, file_error *error);

/* Of an open file of this format, at its start: whether its checksum is that of its bytes, and what it records for `key`, which the caller frees. */
bool sums_are_whole(const input_file *input);
file_status sums_metadata_read(const input_file *input, const char *key, char **value, file_error *error);

#endif
