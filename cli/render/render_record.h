/* SPDX-License-Identifier: MIT */
/* What a rendered file says about itself: the render hash and its metadata. */
#ifndef MANGATA_CLI_RENDER_RENDER_RECORD_H
#define MANGATA_CLI_RENDER_RENDER_RECORD_H

#include "image/metadata.h"
#include "cli/render/render_request.h"
#include "cli/common/sha256.h"

#define RENDER_HASH_KEY "render_hash"

/* Hash of everything that changes pixels: version, scene, size, crop, method, samples, seed, layers, kind of file, frame.
 * Left out: threads, and instruction sets and backends that agree to the bit. `canonical` is the scene's canonical text,
 * `frames` the frame number or a film's frames. False when memory runs out. */
bool render_hash(const render_request *request, const char *canonical, const mgt_image *image, const mgt_context_info *info, const char *frames,
                 sha256_text *hash);

#define SUMS_HASH_KEY "sums_hash"

/* Hash of everything that changes a sample of a frame: not of ranges, layers and kind of file. False when memory runs out. */
bool sums_hash(const render_request *request, const char *canonical, const mgt_image *image, const mgt_context_info *info, const char *frame,
               sha256_text *hash);

enum { RECORD_ENTRIES = 22, RECORD_TEXT = 256 };

/* Metadata with the memory of its values. Not to be copied: the entries point into it. */
typedef struct render_record {
    metadata_entry entries[RECORD_ENTRIES];
    char values[RECORD_ENTRIES][RECORD_TEXT];
    metadata_list list;
} render_record;

/* `seconds` below 0: not known. */
void render_record_fill(render_record *record, const render_request *request, const mgt_context_info *info, const sha256_text *hash, const char *frames,
                        double time, double seconds);

/* What files of sums record besides, and by which they know each other: the hash last. */
void render_record_fill_sums(render_record *record, const render_request *request, const mgt_image *image, const mgt_context_info *info,
                             const sha256_text *sums_hash, const char *frame);

/* Adds these entries to those of render_record_fill(). */
void render_record_add_sums(render_record *record, const render_record *sums);

#endif
