/* SPDX-License-Identifier: MIT */
/* A picture or film and its ".json" sidecar, published together: both are complete on the disk before either has its name. */
#ifndef MANGATA_IMAGE_PAIRED_OUTPUT_H
#define MANGATA_IMAGE_PAIRED_OUTPUT_H

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"

typedef struct paired_output {
    output_file *file;    /* written by the caller */
    output_file *sidecar; /* already written but for the picture's checksum; NULL without metadata */
    uint64_t check_place; /* offset of the checksum in the sidecar, bytes */
    bool overwrite;       /* replaces what exists */
    char *stale_sidecar;  /* with overwrite and without metadata: an older sidecar to remove before the new picture appears */
} paired_output;

/* Opens both and writes the sidecar's text. On failure *output is all zero and nothing is left behind.
 * Without overwrite FILE_EXISTS: the picture exists, or a file that is no sidecar of this module has the sidecar's name. */
file_status paired_output_open(paired_output *output, const char *path, const metadata_list *metadata, const output_options *options, file_error *error);

/* Gives both their names, the sidecar first, so that a new picture is never seen without it. Until the picture has its name the process holds a lock of the
 * sidecar, for which others wait: of several that write the same name without overwrite one publishes both files, the others get FILE_EXISTS. A sidecar without
 * a picture was left by a process that was killed, and is replaced. With overwrite such a process leaves the old picture, whose checksum is not the one in the
 * new sidecar. Once the sidecar has its name the cancel flag no longer counts. *output is all zero afterwards. */
file_status paired_output_finish(paired_output *output, file_error *error);

void paired_output_abort(paired_output *output);

#endif
