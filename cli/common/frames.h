/* SPDX-License-Identifier: MIT */
/* Which frames are meant, and the file each of them goes to. */
#ifndef MANGATA_CLI_COMMON_FRAMES_H
#define MANGATA_CLI_COMMON_FRAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Increasing frame numbers, kept as ranges so that a million frames cost nothing. */
typedef struct frame_range {
    uint32_t first, last, step;
} frame_range;

enum { FRAME_RANGES = 256, FRAME_LIMIT = 99999999 };

typedef struct frame_list {
    size_t count; /* of ranges */
    frame_range ranges[FRAME_RANGES];
} frame_list;

/* "7", "0-59", "0-56:8", "0,8,16", "0-9,20-29". Returns NULL, or what is wrong (static text). */
const char *frame_list_parse(frame_list *list, const char *text);

/* The frames first … last. */
void frame_list_span(frame_list *list, uint32_t first, uint32_t last);

uint64_t frame_list_length(const frame_list *list);

/* Frame number `index` of the list; index < length. */
uint32_t frame_list_at(const frame_list *list, uint64_t index);

/* The spelling that frame_list_parse() reads; cut short with "…" when it does not fit. */
void frame_list_print(const frame_list *list, char *text, size_t size);

/* One of `count` parts of some work, one for each machine: the elements of a list whose index modulo `count` is `index`. Count 0: all elements. */
typedef struct work_shard {
    uint32_t index, count;
} work_shard;

enum { SHARD_LIMIT = 1000000 };

static inline bool shard_has(const work_shard *shard, uint64_t element) { return shard->count == 0 || element % shard->count == shard->index; }

/* Keeps the shard's frames of the list, which may be none. */
void frame_list_shard(frame_list *list, const work_shard *shard);

/* A path with the place of the frame number: "%d", "%04d" or "####" in the file's name (folders are taken as they are).
 * "%%" stands for a percent sign. */
typedef struct frame_path {
    bool numbered;
    int digits;        /* at least */
    char before[4096]; /* the whole path when not numbered */
    char after[256];
} frame_path;

/* Returns NULL, or what is wrong (static text). */
const char *frame_path_parse(frame_path *path, const char *text);

/* False when the path is too long for `size`. */
bool frame_path_print(const frame_path *path, uint32_t frame, char *text, size_t size);

#endif
