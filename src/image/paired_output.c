/* SPDX-License-Identifier: MIT */
/* Publishing a picture and its sidecar in the right order, one process after another. */
#define _POSIX_C_SOURCE 200809L

#include "image/paired_output.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "image/file_whole.h"
#include "image/metadata_json.h"

enum { SIDECAR_MOST = 16 << 20, LOCK_TRIES = 500, LOCK_PAUSE_MS = 10 };

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

/* Whether the open file is a sidecar as this module writes them. */
static bool is_sidecar(int descriptor)
{
    struct stat info;
    json_error_t unused;
    if (fstat(descriptor, &info) != 0 || !S_ISREG(info.st_mode) || info.st_size > SIDECAR_MOST)
        return false;
    json_t *object = json_loadfd(descriptor, 0, &unused);
    const bool is = json_is_string(json_object_get(object, FILE_CHECK_KEY));
    json_decref(object);
    return is;
}

/* Without overwrite only a sidecar that was left alone may be replaced. */
static file_status check_sidecar(const paired_output *output, file_error *error)
{
    const int standing = output->overwrite ? -1 : output_file_open_target(output->sidecar);
    if (output->overwrite || (standing < 0 && errno == ENOENT))
        return FILE_OK;
    const bool is = standing >= 0 && is_sidecar(standing);
    if (standing >= 0)
        close(standing);
    return is ? FILE_OK : output_file_check_target(output->sidecar, false, error);
}

file_status paired_output_open(paired_output *output, const char *path, const metadata_list *metadata, const output_options *options, file_error *error)
{
    *output = (paired_output){0};
    output_options replacing = options ? *options : (output_options){0};
    replacing.overwrite = true;
    char *sidecar_path = NULL;
    char *json = NULL;
    file_status status = metadata_check(metadata, error);
    if (status != FILE_OK)
        return status;

    output->overwrite = options && options->overwrite;
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
        status = output_file_open(&output->sidecar, sidecar_path, &replacing, error);
        if (status == FILE_OK)
            status = check_sidecar(output, error);
        if (status == FILE_OK)
            status = output_file_write(output->sidecar, json, strlen(json), error);
        if (status != FILE_OK)
            goto fail;
    }
    if (output->overwrite && !metadata)
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

/* Replaces the sidecar that is open as `standing`; -1: it cannot be opened. */
static file_status replace_sidecar(const paired_output *output, int standing, file_error *error)
{
    file_status status = output_file_check_target(output->file, output->overwrite, error);
    if (status == FILE_OK && !output->overwrite && (standing < 0 || !is_sidecar(standing)))
        status = output_file_check_target(output->sidecar, false, error);
    return status == FILE_OK ? output_file_publish(output->sidecar, true, error) : status;
}

/* Gives the sidecar its name, while no other process is between its sidecar and its picture. *own is the sidecar, open and locked; -1: it has no name.
 * Who stops for longer than the tries take, or whose file system has no locks, is not waited for. */
static file_status publish_sidecar(const paired_output *output, int *own, file_error *error)
{
    *own = fcntl(output_file_descriptor(output->sidecar), F_DUPFD_CLOEXEC, 0);
    if (*own < 0)
        return file_error_errno(error, FILE_WRITE, output_file_temporary_path(output->sidecar), "cannot write", errno);
    flock(*own, LOCK_EX | LOCK_NB);
    for (int tries = 0;; tries++) {
        file_status status = output_file_check_cancel(output->sidecar, error);
        if (status == FILE_OK)
            status = output_file_check_target(output->file, output->overwrite, error);
        if (status != FILE_OK)
            return status;
        status = output_file_publish(output->sidecar, false, error);
        if (status != FILE_EXISTS)
            return status;
        const int standing = output_file_open_target(output->sidecar);
        bool ours = standing < 0 && errno != ENOENT;
        if (standing >= 0)
            ours = (flock(standing, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) && output_file_is_target(output->sidecar, standing);
        ours = ours || tries == LOCK_TRIES;
        if (ours)
            status = replace_sidecar(output, standing, error);
        if (standing >= 0)
            close(standing);
        if (ours)
            return status;
        nanosleep(&(struct timespec){.tv_nsec = LOCK_PAUSE_MS * 1000000L}, NULL);
    }
}

/* After a failure: takes the sidecar away, unless it now belongs to a picture. */
static void withdraw_sidecar(const paired_output *output, int own)
{
    const bool replaces = output->overwrite && output_file_check_target(output->file, false, NULL) != FILE_OK;
    if (output_file_is_published(output->sidecar) && !output_file_is_published(output->file) && !replaces && output_file_is_target(output->sidecar, own))
        output_file_remove_target(output->sidecar);
}

file_status paired_output_finish(paired_output *output, file_error *error)
{
    int own = -1;
    file_status status = output_file_sync(output->file, error);
    if (status == FILE_OK && output->sidecar)
        status = write_check(output, error);
    if (status == FILE_OK && output->sidecar)
        status = output_file_sync(output->sidecar, error);
    if (status == FILE_OK && output->sidecar)
        status = publish_sidecar(output, &own, error);
    if (status == FILE_OK && output->stale_sidecar && unlink(output->stale_sidecar) != 0 && errno != ENOENT)
        status = file_error_errno(error, FILE_WRITE, output->stale_sidecar, "cannot replace", errno);
    if (status == FILE_OK)
        status = output_file_publish(output->file, output->overwrite, error);
    if (own >= 0) {
        if (status != FILE_OK)
            withdraw_sidecar(output, own);
        close(own);
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
