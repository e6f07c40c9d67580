/* SPDX-License-Identifier: MIT */
/* Lists of frames, shards of work, and paths with a frame number. */
#ifndef MANGATA_CLI_COMMON_FRAMES_H
#define MANGATA_CLI_COMMON_FRAMES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Frames first, first + step … last. */
typedef struct frame_range {
    uint32_t first, last, step;
} frame_range;

enum { FRAME_RANGES = 256, FRAME_LIMIT = 99999999, FRAME_LIST_TEXT = FRAME_RANGES * sizeof("99999999-99999999:99999999,") + 8 };
#define FRAME_LIMIT_TEXT "99999999" /* the same as text */

/* Increasing frame numbers as ranges. */
typedef struct frame_list {
    size_t count; /* number of ranges */
    frame_range ranges[FRAME_RANGES];
} frame_list;

/* Reads a list such as "7", "0-59", "0-56:8", "0,8,16" or "0-9,20-29". Returns NULL, or a static text that says what is wrong. */
const char *frame_list_parse(frame_list *list, const char *text);

/* Sets the list to the frames first … last. */
void frame_list_span(frame_list *list, uint32_t first, uint32_t last);

/* Number of frames of the list. */
uint64_t frame_list_length(const frame_list *list);

/* The frame at place `index` of the list, which must be below its length. */
uint32_t frame_list_at(const frame_list *list, uint64_t index);

/* Prints the list as frame_list_parse() reads it. If it does not fit, it ends with "…"; FRAME_LIST_TEXT characters hold any. */
void frame_list_print(const frame_list *list, char *text, size_t size);

/* One of `count` shards of some work, such as that of one machine. It has the elements of a list whose index modulo `count` is `index`. count 0: all
 * elements. */
typedef struct work_shard {
    uint32_t index, count;
} work_shard;

enum { SHARD_LIMIT = 1000000 };

static inline bool shard_has(const work_shard *shard, uint64_t element) { return shard->count == 0 || element % shard->count == shard->index; }

/* Removes all frames from the list that the shard does not have. It may become empty. */
void frame_list_shard(frame_list *list, const work_shard *shard);

/* A path that may hold the frame number: "%d", "%04d" or "####" in the file's name. "%%" there stands for a percent sign. Names of folders are taken
 * literally. */
typedef struct frame_path {
    bool numbered;     /* it holds the frame number */
    int digits;        /* least number of digits */
    char before[4096]; /* text before the number; the whole path if there is none */
    char after[256];   /* text after the number */
} frame_path;

/* Reads a path. Returns NULL, or a static text that says what is wrong. */
const char *frame_path_parse(frame_path *path, const char *text);

/* Whether a folder's name, which is taken literally, holds what would be a frame number in the file's name. */
bool frame_path_folder_is_marked(const frame_path *path);

/* Prints the path of a frame. False: it is longer than `size` − 1 bytes. */
bool frame_path_print(const frame_path *path, uint32_t frame, char *text, size_t size);

#endif
