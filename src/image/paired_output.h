/* SPDX-License-Identifier: MIT */
/* A picture or film and its ".json" sidecar, published together. Both are complete on the disk before either has its name. */
#ifndef MANGATA_IMAGE_PAIRED_OUTPUT_H
#define MANGATA_IMAGE_PAIRED_OUTPUT_H

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"

typedef struct paired_output {
    output_file *file;    /* written by the caller */
    output_file *sidecar; /* written except for the picture's checksum; NULL: there are no metadata */
    uint64_t check_place; /* offset of the checksum in the sidecar, bytes */
    bool overwrite;       /* existing files are replaced */
    char *stale_sidecar;  /* an older sidecar to remove before a new picture without metadata appears; NULL: none */
} paired_output;

/* Opens both files and writes the sidecar's text. On failure *output is zeroed and no file is left. FILE_EXISTS, without overwrite: the picture exists, or a
 * file that is no sidecar of this module has the sidecar's name. */
file_status paired_output_open(paired_output *output, const char *path, const metadata_list *metadata, const output_options *options, file_error *error);

/* Gives both files their names. The sidecar comes first, so that a new picture is never seen without it. Until the picture has its name, the process holds a
 * lock on the sidecar, for which other processes wait. So if several processes write the same name without overwrite, one publishes both files and the others
 * get FILE_EXISTS. A sidecar without a picture was left by a killed process and is replaced. With overwrite a killed process may leave the old picture with a
 * new sidecar, whose checksum is another one. Once the sidecar has its name, the cancel flag is ignored. *output is zeroed. */
file_status paired_output_finish(paired_output *output, file_error *error);

void paired_output_abort(paired_output *output);

#endif
