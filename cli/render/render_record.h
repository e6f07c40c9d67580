/* SPDX-License-Identifier: MIT */
/* The render hash and the metadata of a rendered file. */
#ifndef MANGATA_CLI_RENDER_RENDER_RECORD_H
#define MANGATA_CLI_RENDER_RENDER_RECORD_H

#include "image/metadata.h"
#include "cli/render/render_request.h"
#include "cli/common/sha256.h"

#define RENDER_HASH_KEY "render_hash"

/* Hash of everything that changes pixels: version, scene, size, crop, method, samples, seed, layers, file format, frame. It leaves out threads, and instruction
 * sets and backends that agree to the bit. `canonical` is the scene's canonical text. `frames` is the frame number or the list of a film's frames. False: out
 * of memory. */
bool render_hash(const render_request *request, const char *canonical, const mgt_image *image, const mgt_context_info *info, const char *frames,
                 sha256_text *hash);

#define SUMS_HASH_KEY "sums_hash"

/* Hash of everything that changes a sample of a frame. It leaves out the range of samples, the layers and the file format. False: out of memory. */
bool sums_hash(const render_request *request, const char *canonical, const mgt_image *image, const mgt_context_info *info, const char *frame,
               sha256_text *hash);

enum { RECORD_ENTRIES = 22, RECORD_TEXT = 256 };

/* Metadata with the memory of its values. It must not be copied, because the entries point into it. */
typedef struct render_record {
    metadata_entry entries[RECORD_ENTRIES];
    char values[RECORD_ENTRIES][RECORD_TEXT];
    metadata_list list;
} render_record;

/* Fills the metadata of a file. `time` is the scene's time in seconds. `seconds` is the rendering time; below 0: it is not known. */
void render_record_fill(render_record *record, const render_request *request, const mgt_context_info *info, const sha256_text *hash, const char *frames,
                        double time, double seconds);

/* Adds the exposure of displayed colour, stops. `post.exposure` of this value gives the same pixels. */
void render_record_add_exposure(render_record *record, double stops);

/* Fills the metadata by which files of sums of one frame recognise each other. The last entry is the hash. */
void render_record_fill_sums(render_record *record, const render_request *request, const mgt_image *image, const mgt_context_info *info,
                             const sha256_text *sums_hash, const char *frame);

/* Adds those entries to the ones of render_record_fill(). Keys that `record` has already are left out. */
void render_record_add_sums(render_record *record, const render_record *sums);

#endif
