/* SPDX-License-Identifier: MIT */
/* Publishing a picture and its sidecar in the right order. */
#define _POSIX_C_SOURCE 200809L

#include "image/paired_output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/file_whole.h"
#include "image/metadata_json.h"

/* The list's text with the picture's checksum last, and where that stands. NULL: out of memory. */
static char *sidecar_text(const metadata_list *metadata, uint64_t *check_place)
{
    metadata_entry *entries = malloc((metadata->count + 1) * sizeof *entries);
    if (!entries)
        return NULL;
    if (metadata->count > 0)
        memcpy(entries, metadata->entries, metadata->count * sizeof *entries);
    entries[metadata->count] = (metadata_entry){FILE_CHECK_KEY, FILE_CHECK_NONE};
    char *text = metadata_json_text(&(metadata_list){entries, metadata->count + 1});
    free(entries);
    /* Behind it a quote, a line's end, a bracket and a line's end. */
    *check_place = text ? strlen(text) - (sizeof FILE_CHECK_NONE - 1) - 4 : 0;
    return text;
}

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
        json = sidecar_text(metadata, &output->check_place);
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

static file_status write_check(const paired_output *output, file_error *error)
{
    const int descriptor = output_file_descriptor(output->file);
    const char *path = output_file_temporary_path(output->file);
    struct stat info;
    char digits[sizeof FILE_CHECK_NONE];
    if (fstat(descriptor, &info) != 0)
        return file_error_errno(error, FILE_WRITE, path, "cannot write", errno);
    const file_status status = file_check_of(descriptor, (uint64_t)info.st_size, path, digits, error);
    return status == FILE_OK ? output_file_write_at(output->sidecar, output->check_place, digits, sizeof digits - 1, error) : status;
}

file_status paired_output_finish(paired_output *output, file_error *error)
{
    file_status status = output_file_sync(output->file, error);
    if (status == FILE_OK && output->sidecar)
        status = write_check(output, error);
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
