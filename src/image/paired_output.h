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
    char *stale_sidecar;  /* with overwrite: an older sidecar to remove before the new picture appears */
} paired_output;

/* Opens both and writes the sidecar's text. On failure *output is all zero and nothing is left behind. */
file_status paired_output_open(paired_output *output, const char *path, const metadata_list *metadata, const output_options *options, file_error *error);

/* Gives both their names, the picture first: at no moment does a sidecar stand beside a picture that it does not describe.
 * *output is all zero afterwards. */
file_status paired_output_finish(paired_output *output, file_error *error);

void paired_output_abort(paired_output *output);

#endif
