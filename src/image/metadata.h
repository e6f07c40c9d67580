/* SPDX-License-Identifier: MIT */
/* What a file records about itself: ordered key/value strings inside PNG and EXR, a ".json" sidecar beside the others. */
#ifndef MANGATA_IMAGE_METADATA_H
#define MANGATA_IMAGE_METADATA_H

#include <stdbool.h>
#include <stddef.h>

#include "image/file_error.h"
#include "image/output_file.h"

/* `key`: 1 to 79 characters of [A-Za-z0-9_.-], each once. `value`: UTF-8, at most 1 MiB. In EXR the attribute is named
 * "mangata.KEY", so that no key meets a name of the format's own ("version", "channels"). */
typedef struct metadata_entry {
    const char *key;
    const char *value;
} metadata_entry;

/* The caller's entries, in the order in which they are written. All zero means none. */
typedef struct metadata_list {
    const metadata_entry *entries;
    size_t count;
} metadata_list;

/* Checks keys and values; every writer calls it before it opens anything. NULL is an empty list. */
file_status metadata_check(const metadata_list *metadata, file_error *error);

/* "PATH.json" for the picture at `path` ("road.pfm" has "road.pfm.json"); the caller frees it. NULL: out of memory. */
char *metadata_sidecar_path(const char *path);

/* Reads what the file at `path` (.png, .exr, .sums by their own content; others by their sidecar) records for `key`.
 * FILE_OK with *value NULL: the file is there but records no such key, or an empty value, or has no sidecar. FILE_MISSING: no such file.
 * The caller frees *value. */
file_status metadata_read(const char *path, const char *key, char **value, file_error *error);

#endif
