/* SPDX-License-Identifier: MIT */
/* Publishing a picture and its sidecar in the right order. */
#define _POSIX_C_SOURCE 200809L

#include "image/paired_output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/metadata_json.h"

file_status paired_output_open(paired_output *output, const char *path, const metadata_list *metadata, const output_options *options, file_error *error)
{
    *output = (paired_output){0};
    char *sidecar_path = NULL;
    char *json = NULL;
    file_status status = metadata_check(metadata, error);
    if (status != FILE_OK)
        return status;

    sidecar_path = metadata_sidecar_path(path);
    if (!sidecar_path) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    status = output_file_open(&output->file, path, options, error);
    if (status != FILE_OK)
        goto fail;
    if (metadata) {
        json = metadata_json_text(metadata);
        if (!json) {
            status = file_error_errno(error, FILE_MEMORY, sidecar_path, NULL, ENOMEM);
            goto fail;
        }
        status = output_file_open(&output->sidecar, sidecar_path, options, error);
        if (status == FILE_OK)
            status = output_file_write(output->sidecar, json, strlen(json), error);
        if (status != FILE_OK)
            goto fail;
    }
    if (options && options->overwrite)
        output->stale_sidecar = sidecar_path;
    else
        free(sidecar_path);
    free(json);
    return FILE_OK;

fail:
    free(json);
    free(sidecar_path);
    paired_output_abort(output);
    return status;
}

file_status paired_output_finish(paired_output *output, file_error *error)
{
    file_status status = output_file_sync(output->file, error);
    if (status == FILE_OK && output->sidecar)
        status = output_file_sync(output->sidecar, error);
    if (status == FILE_OK && output->stale_sidecar && unlink(output->stale_sidecar) != 0 && errno != ENOENT)
        status = file_error_errno(error, FILE_WRITE, output->stale_sidecar, "cannot replace", errno);
    if (status == FILE_OK) {
        status = output_file_finish(output->file, error);
        output->file = NULL;
    }
    if (status == FILE_OK && output->sidecar) {
        status = output_file_finish(output->sidecar, error);
        output->sidecar = NULL;
    }
    paired_output_abort(output);
    return status;
}

void paired_output_abort(paired_output *output)
{
    output_file_abort(output->file);
    output_file_abort(output->sidecar);
    free(output->stale_sidecar);
    *output = (paired_output){0};
}
