/* SPDX-License-Identifier: MIT */
/* Atomic output: temporary file, fsync, rename; see output_file.h. */
#define _GNU_SOURCE /* renameat2, O_PATH */

#include "image/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TEMPORARY_NAMES = 1000 };

struct output_file {
    int folder;
    bool folder_can_sync;
    int descriptor;
    bool synced;
    uint64_t position; /* end of what was appended */
    output_options options;
    char *path;
    const char *name;     /* last part of path */
    char *temporary_path; /* path of the folder and the temporary name */
    char temporary_name[48];
};

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The folder's path: "." for a bare name. */
static char *folder_of(const char *path)
{
    const char *name = last_part(path);
    if (name == path)
        return strdup(".");
    size_t length = (size_t)(name - path);
    while (length > 1 && path[length - 1] == '/')
        length--;
    return strndup(path, length);
}

/* Opens the folder for openat() and, where its permissions let us, for fsync(). */
static file_status open_folder(const char *path, int *folder, bool *can_sync, file_error *error)
{
    const char *name = last_part(path);
    if (*path == '\0')
        return file_error_set(error, FILE_ARGUMENT, "the name of the output file is empty");
    if (*name == '\0' || strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return file_error_set(error, FILE_WRITE, "%s: is a directory", path);
    char *folder_path = folder_of(path);
    if (!folder_path)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    *can_sync = true;
    *folder = open(folder_path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (*folder < 0 && errno == EACCES) {
        *can_sync = false;
        *folder = open(folder_path, O_PATH | O_DIRECTORY | O_CLOEXEC);
    }
    file_status status = FILE_OK;
    if (*folder < 0)
        status = file_error_set(error, FILE_WRITE, "%s: cannot write: folder %s: %s", path, folder_path, strerror(errno));
    free(folder_path);
    return status;
}

/* Only a regular file (or a link, which is replaced itself) may give way to the new one. */
static file_status check_mode(mode_t mode, const char *path, file_error *error)
{
    if (S_ISDIR(mode))
        return file_error_set(error, FILE_WRITE, "%s: is a directory", path);
    if (!S_ISREG(mode) && !S_ISLNK(mode))
        return file_error_set(error, FILE_WRITE, "%s: is not a regular file", path);
    return FILE_OK;
}

static file_status check_target(int folder, const char *path, bool overwrite, file_error *error)
{
    struct stat info;
    if (fstatat(folder, last_part(path), &info, AT_SYMLINK_NOFOLLOW) != 0)
        return errno == ENOENT ? FILE_OK : file_error_errno(error, FILE_WRITE, path, "cannot write", errno);
    const file_status status = check_mode(info.st_mode, path, error);
    if (status == FILE_OK && !overwrite)
        return file_error_set(error, FILE_EXISTS, "%s: exists already", path);
    return status;
}

file_status output_file_check_kind(const char *path, file_error *error)
{
    struct stat info;
    return lstat(path, &info) == 0 ? check_mode(info.st_mode, path, error) : FILE_OK;
}

file_status output_file_check(const char *path, const output_options *options, file_error *error)
{
    int folder = -1;
    bool can_sync = false;
    file_status status = open_folder(path, &folder, &can_sync, error);
    if (status != FILE_OK)
        return status;
    status = check_target(folder, path, options && options->overwrite, error);
    if (status == FILE_OK && faccessat(folder, ".", W_OK | X_OK, AT_EACCESS) != 0)
        status = file_error_errno(error, FILE_WRITE, path, "cannot write", errno);
    close(folder);
    return status;
}

file_status output_file_check_folder(const char *path, file_error *error)
{
    int folder = -1;
    bool can_sync = false;
    const file_status status = open_folder(path, &folder, &can_sync, error);
    if (status == FILE_OK)
        close(folder);
    return status;
}

/* The name tells its origin and does not grow with the target's, which may be as long as the file system allows. */
static file_status create_temporary(output_file *file, file_error *error)
{
    for (int i = 0; i < TEMPORARY_NAMES; i++) {
        snprintf(file->temporary_name, sizeof file->temporary_name, ".mangata-%ld-%d.tmp", (long)getpid(), i);
        file->descriptor = openat(file->folder, file->temporary_name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->descriptor >= 0)
            return FILE_OK;
        if (errno != EEXIST)
            break;
    }
    file->temporary_name[0] = '\0'; /* someone else's, not to be removed */
    return file_error_errno(error, FILE_WRITE, file->path, "cannot write", errno);
}

file_status output_file_open(output_file **result, const char *path, const output_options *options, file_error *error)
{
    *result = NULL;
    output_file *file = calloc(1, sizeof *file);
    if (!file)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    file->folder = file->descriptor = -1;
    if (options)
        file->options = *options;

    file_status status = open_folder(path, &file->folder, &file->folder_can_sync, error);
    if (status != FILE_OK)
        goto fail;
    status = check_target(file->folder, path, file->options.overwrite, error);
    if (status != FILE_OK)
        goto fail;
    file->path = strdup(path);
    if (!file->path) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    file->name = last_part(file->path);
    status = create_temporary(file, error);
    if (status != FILE_OK)
        goto fail;
    size_t prefix = (size_t)(file->name - file->path);
    file->temporary_path = malloc(prefix + sizeof file->temporary_name);
    if (!file->temporary_path) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    memcpy(file->temporary_path, file->path, prefix);
    memcpy(file->temporary_path + prefix, file->temporary_name, sizeof file->temporary_name);
    *result = file;
    return FILE_OK;

fail:
    output_file_abort(file);
    return status;
}

file_status output_file_check_cancel(const output_file *file, file_error *error)
{
    if (file->options.cancel && *file->options.cancel)
        return file_error_set(error, FILE_CANCELLED, "%s: interrupted, nothing was written", file->path);
    return FILE_OK;
}

file_status output_file_write_at(output_file *file, uint64_t offset, const void *bytes, size_t size, file_error *error)
{
    const char *from = bytes;
    file_status status = output_file_check_cancel(file, error);
    if (status != FILE_OK)
        return status;
    while (size > 0) {
        ssize_t written = pwrite(file->descriptor, from, size, (off_t)offset);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return file_error_errno(error, FILE_WRITE, file->path, "cannot write", written < 0 ? errno : EIO);
        from += written;
        size -= (size_t)written;
        offset += (uint64_t)written;
    }
    return FILE_OK;
}

file_status output_file_write(output_file *file, const void *bytes, size_t size, file_error *error)
{
    file_status status = output_file_write_at(file, file->position, bytes, size, error);
    if (status == FILE_OK)
        file->position += size;
    return status;
}

const char *output_file_temporary_path(const output_file *file) { return file->temporary_path; }

int output_file_descriptor(const output_file *file) { return file->descriptor; }

file_status output_file_sync(output_file *file, file_error *error)
{
    file_status status = output_file_check_cancel(file, error);
    if (status != FILE_OK || file->synced)
        return status;
    if (fsync(file->descriptor) != 0)
        return file_error_errno(error, FILE_WRITE, file->path, "cannot write", errno);
    file->synced = true;
    return FILE_OK;
}

/* Gives the final name; without `replace` the kernel itself refuses an existing one, so that there is no race. */
static int give_name(const output_file *file, bool replace)
{
    if (replace)
        return renameat(file->folder, file->temporary_name, file->folder, file->name);
    if (renameat2(file->folder, file->temporary_name, file->folder, file->name, RENAME_NOREPLACE) == 0)
        return 0;
    if (errno != EINVAL && errno != ENOSYS)
        return -1;
    /* A file system without that flag. */
    if (linkat(file->folder, file->temporary_name, file->folder, file->name, 0) != 0)
        return -1;
    unlinkat(file->folder, file->temporary_name, 0);
    return 0;
}

file_status output_file_publish(output_file *file, bool replace, file_error *error)
{
    const int closed = file->descriptor >= 0 ? close(file->descriptor) : 0; /* network file systems report late errors here */
    file->descriptor = -1;
    if (closed != 0 && errno != EINTR)
        return file_error_errno(error, FILE_WRITE, file->path, "cannot write", errno);
    if (give_name(file, replace) != 0)
        return errno == EEXIST ? file_error_set(error, FILE_EXISTS, "%s: exists already", file->path)
                               : file_error_errno(error, FILE_WRITE, file->path, "cannot write", errno);
    file->temporary_name[0] = '\0'; /* no longer ours to remove */
    /* Some file systems cannot sync a folder; the file is whole in any case. */
    if (file->folder_can_sync && fsync(file->folder) != 0 && errno == EIO)
        return file_error_errno(error, FILE_WRITE, file->path, "folder", EIO);
    return FILE_OK;
}

bool output_file_is_published(const output_file *file) { return file->temporary_name[0] == '\0'; }

file_status output_file_finish(output_file *file, file_error *error)
{
    file_status status = output_file_sync(file, error);
    if (status == FILE_OK)
        status = output_file_publish(file, file->options.overwrite, error);
    output_file_abort(file);
    return status;
}

file_status output_file_check_target(const output_file *file, bool overwrite, file_error *error)
{
    return check_target(file->folder, file->path, overwrite, error);
}

int output_file_open_target(const output_file *file)
{
    /* Locks of network file systems want a file that may be written. */
    const int flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, target = openat(file->folder, file->name, O_RDWR | flags);
    return target >= 0 || errno == ENOENT ? target : openat(file->folder, file->name, O_RDONLY | flags);
}

bool output_file_is_target(const output_file *file, int descriptor)
{
    struct stat target, other;
    return fstat(descriptor, &other) == 0 && fstatat(file->folder, file->name, &target, AT_SYMLINK_NOFOLLOW) == 0 && target.st_dev == other.st_dev &&
           target.st_ino == other.st_ino;
}

void output_file_remove_target(const output_file *file) { unlinkat(file->folder, file->name, 0); }

file_status output_file_write_whole(const char *path, const void *bytes, size_t size, const output_options *options, file_error *error)
{
    output_file *file = NULL;
    file_status status = output_file_open(&file, path, options, error);
    if (status != FILE_OK)
        return status;
    status = output_file_write(file, bytes, size, error);
    if (status == FILE_OK)
        return output_file_finish(file, error);
    output_file_abort(file);
    return status;
}

void output_file_abort(output_file *file)
{
    if (!file)
        return;
    if (file->descriptor >= 0)
        close(file->descriptor);
    if (file->folder >= 0) {
        if (file->temporary_name[0] != '\0')
            unlinkat(file->folder, file->temporary_name, 0);
        close(file->folder);
    }
    free(file->temporary_path);
    free(file->path);
    free(file);
}
