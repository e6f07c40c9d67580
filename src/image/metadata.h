/* SPDX-License-Identifier: MIT */
/* Metadata that a file records: an ordered list of keys and values, in PNG and EXR themselves and in a ".json" sidecar of other files. */
#ifndef MANGATA_IMAGE_METADATA_H
#define MANGATA_IMAGE_METADATA_H

#include <stdbool.h>
#include <stddef.h>

#include "image/file_error.h"
#include "image/output_file.h"

/* `key`: 1 to 79 characters of [A-Za-z0-9_.-]; a list has each key at most once. `value`: UTF-8, at most 1 MiB. In EXR the attribute is named "mangata.KEY", so
 * that keys differ from the format's own attributes. */
typedef struct metadata_entry {
    const char *key;
    const char *value;
} metadata_entry;

/* The caller's entries, in the order in which they are written. All zero: there are none. */
typedef struct metadata_list {
    const metadata_entry *entries;
    size_t count;
} metadata_list;

/* Checks keys and values. Every writer calls it before it opens a file. NULL: an empty list. */
file_status metadata_check(const metadata_list *metadata, file_error *error);

/* Path of the sidecar of the picture at `path`: "road.pfm.json" for "road.pfm". The caller frees it. NULL: out of memory. */
char *metadata_sidecar_path(const char *path);

/* Reads the value that the file at `path` records for `key`. PNG, EXR and sums hold metadata themselves, other files have a sidecar. The caller frees *value.
 * *value is NULL if the file exists but records no such key or an empty value, or has no sidecar. FILE_MISSING: the file does not exist. */
file_status metadata_read(const char *path, const char *key, char **value, file_error *error);

#endif
