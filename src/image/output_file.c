/* SPDX-License-Identifier: MIT */
/* Atomic output: temporary file, fsync, rename; see output_file.h. */
#define _GNU_SOURCE /* renameat2, O_PATH */

#include "image/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TEMPORARY_NAMES = 1000, MOST_LINKS = 40 };

/* Where the file itself lies: behind the links that a path may lead through. */
typedef struct output_place {
    int folder; /* open; -1: none */
    bool folder_can_sync;
    char *path;
} output_place;

struct output_file {
    output_place place;
    int descriptor;
    bool synced;
    mode_t replaced_mode; /* of the file that it replaces; 0: none */
    uint64_t position;    /* end of what was appended */
    output_options options;
    char *path;           /* as it was given, for messages */
    const char *name;     /* last part of the place's path */
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

/* Opens the folder of the place's path for openat() and, where its permissions let us, for fsync(). */
static file_status open_folder(output_place *place, const char *given, file_error *error)
{
    const char *name = last_part(place->path);
    if (*place->path == '\0')
        return file_error_set(error, FILE_ARGUMENT, "the name of the output file is empty");
    if (*name == '\0' || strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
        return file_error_set(error, FILE_WRITE, "%s: is a directory", given);
    char *folder_path = folder_of(place->path);
    if (!folder_path)
        return file_error_errno(error, FILE_MEMORY, given, NULL, ENOMEM);
    place->folder_can_sync = true;
    place->folder = open(folder_path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (place->folder < 0 && errno == EACCES) {
        place->folder_can_sync = false;
        place->folder = open(folder_path, O_PATH | O_DIRECTORY | O_CLOEXEC);
    }
    file_status status = FILE_OK;
    if (place->folder < 0)
        status = file_error_set(error, FILE_WRITE, "%s: cannot write: folder %s: %s", given, folder_path, strerror(errno));
    free(folder_path);
    return status;
}

static void close_place(output_place *place)
{
    if (place->folder >= 0)
        close(place->folder);
    free(place->path);
    *place = (output_place){.folder = -1};
}

/* Whether a link may be followed. In a folder where all users may make files, such as /tmp, another user's link could lead to any file of ours. */
static bool may_follow(const struct stat *link, int folder)
{
    struct stat info;
    return fstat(folder, &info) == 0 &&
           ((info.st_mode & (S_ISVTX | S_IWOTH)) != (S_ISVTX | S_IWOTH) || link->st_uid == geteuid() || link->st_uid == info.st_uid);
}

/* Where the place is a link: the path that it names, which the caller frees. *next is NULL where it is none. */
static file_status read_link(const output_place *place, const char *given, char **next, file_error *error)
{
    file_status status = FILE_OK;
    struct stat info;
    *next = NULL;
    const int link = openat(place->folder, last_part(place->path), O_PATH | O_NOFOLLOW | O_CLOEXEC);
    if (link < 0 || fstat(link, &info) != 0 || !S_ISLNK(info.st_mode))
        goto done;
    if (!may_follow(&info, place->folder)) {
        status = file_error_set(error, FILE_WRITE, "%s: is another user's link in a folder that all may write to; allowed: links of one's own there", given);
        goto done;
    }
    char text[PATH_MAX];
    const ssize_t length = readlinkat(link, "", text, sizeof text);
    if (length < 0 || length == (ssize_t)sizeof text) {
        status = file_error_errno(error, FILE_WRITE, given, "cannot write", length < 0 ? errno : ENAMETOOLONG);
        goto done;
    }
    const size_t prefix = length > 0 && text[0] == '/' ? 0 : (size_t)(last_part(place->path) - place->path);
    *next = malloc(prefix + (size_t)length + 1);
    if (!*next) {
        status = file_error_errno(error, FILE_MEMORY, given, NULL, ENOMEM);
        goto done;
    }
    memcpy(*next, place->path, prefix);
    memcpy(*next + prefix, text, (size_t)length);
    (*next)[prefix + (size_t)length] = '\0';
done:
    if (link >= 0)
        close(link);
    return status;
}

/* Follows links to the file that is to be written, which need not exist. On failure the place is closed. */
static file_status open_place(output_place *place, const char *given, file_error *error)
{
    *place = (output_place){.folder = -1, .path = strdup(given)};
    file_status status = place->path ? open_folder(place, given, error) : file_error_errno(error, FILE_MEMORY, given, NULL, ENOMEM);
    for (int links = 0; status == FILE_OK; links++) {
        char *next;
        status = read_link(place, given, &next, error);
        if (!next)
            break;
        close_place(place);
        place->path = next;
        status = links < MOST_LINKS ? open_folder(place, given, error) : file_error_errno(error, FILE_WRITE, given, "cannot write", ELOOP);
    }
    if (status != FILE_OK)
        close_place(place);
    return status;
}

/* Only a regular file may give way to the new one. */
static file_status check_mode(mode_t mode, const char *path, file_error *error)
{
    if (S_ISDIR(mode))
        return file_error_set(error, FILE_WRITE, "%s: is a directory", path);
    if (!S_ISREG(mode))
        return file_error_set(error, FILE_WRITE, "%s: is not a regular file", path);
    return FILE_OK;
}

/* *mode is that of the file that stands there; 0: there is none. */
static file_status check_target(const output_place *place, const char *given, bool overwrite, mode_t *mode, file_error *error)
{
    struct stat info;
    *mode = 0;
    if (fstatat(place->folder, last_part(place->path), &info, AT_SYMLINK_NOFOLLOW) != 0)
        return errno == ENOENT ? FILE_OK : file_error_errno(error, FILE_WRITE, given, "cannot write", errno);
    *mode = info.st_mode;
    const file_status status = check_mode(info.st_mode, given, error);
    if (status == FILE_OK && !overwrite)
        return file_error_set(error, FILE_EXISTS, "%s: exists already", given);
    return status;
}

file_status output_file_check_kind(const char *path, file_error *error)
{
    struct stat info;
    return stat(path, &info) == 0 ? check_mode(info.st_mode, path, error) : FILE_OK;
}

file_status output_file_check(const char *path, const output_options *options, file_error *error)
{
    output_place place;
    mode_t mode;
    file_status status = open_place(&place, path, error);
    if (status != FILE_OK)
        return status;
    status = check_target(&place, path, options && options->overwrite, &mode, error);
    if (status == FILE_OK && faccessat(place.folder, ".", W_OK | X_OK, AT_EACCESS) != 0)
        status = file_error_errno(error, FILE_WRITE, path, "cannot write", errno);
    close_place(&place);
    return status;
}

file_status output_file_check_folder(const char *path, file_error *error)
{
    output_place place;
    const file_status status = open_place(&place, path, error);
    if (status == FILE_OK)
        close_place(&place);
    return status;
}

/* Permissions of the file that is replaced. Some file systems have none, so that a failure is none. */
static void take_mode(const output_file *file, mode_t more)
{
    if (file->replaced_mode != 0)
        (void)!fchmod(file->descriptor, (file->replaced_mode & 0777) | more);
}

/* The name tells its origin and does not grow with the target's, which may be as long as the file system allows. */
static file_status create_temporary(output_file *file, file_error *error)
{
    for (int i = 0; i < TEMPORARY_NAMES; i++) {
        snprintf(file->temporary_name, sizeof file->temporary_name, ".mangata-%ld-%d.tmp", (long)getpid(), i);
        file->descriptor = openat(file->place.folder, file->temporary_name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->descriptor >= 0) {
            take_mode(file, S_IRUSR | S_IWUSR); /* an encoder may open it by its name */
            return FILE_OK;
        }
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
    file->place.folder = file->descriptor = -1;
    if (options)
        file->options = *options;

    file_status status = open_place(&file->place, path, error);
    if (status != FILE_OK)
        goto fail;
    status = check_target(&file->place, path, file->options.overwrite, &file->replaced_mode, error);
    if (status != FILE_OK)
        goto fail;
    file->path = strdup(path);
    if (!file->path) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    file->name = last_part(file->place.path);
    status = create_temporary(file, error);
    if (status != FILE_OK)
        goto fail;
    size_t prefix = (size_t)(file->name - file->place.path);
    file->temporary_path = malloc(prefix + sizeof file->temporary_name);
    if (!file->temporary_path) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    memcpy(file->temporary_path, file->place.path, prefix);
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
    take_mode(file, 0);
    if (fsync(file->descriptor) != 0)
        return file_error_errno(error, FILE_WRITE, file->path, "cannot write", errno);
    file->synced = true;
    return FILE_OK;
}

/* Gives the final name; without `replace` the kernel itself refuses an existing one, so that there is no race. */
static int give_name(const output_file *file, bool replace)
{
    if (replace)
        return renameat(file->place.folder, file->temporary_name, file->place.folder, file->name);
    if (renameat2(file->place.folder, file->temporary_name, file->place.folder, file->name, RENAME_NOREPLACE) == 0)
        return 0;
    if (errno != EINVAL && errno != ENOSYS)
        return -1;
    /* A file system without that flag. */
    if (linkat(file->place.folder, file->temporary_name, file->place.folder, file->name, 0) != 0)
        return -1;
    unlinkat(file->place.folder, file->temporary_name, 0);
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
    if (file->place.folder_can_sync && fsync(file->place.folder) != 0 && errno == EIO)
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
    mode_t unused;
    return check_target(&file->place, file->path, overwrite, &unused, error);
}

int output_file_open_target(const output_file *file)
{
    /* Locks of network file systems want a file that may be written. */
    const int flags = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, target = openat(file->place.folder, file->name, O_RDWR | flags);
    return target >= 0 || errno == ENOENT ? target : openat(file->place.folder, file->name, O_RDONLY | flags);
}

bool output_file_is_target(const output_file *file, int descriptor)
{
    struct stat target, other;
    return fstat(descriptor, &other) == 0 && fstatat(file->place.folder, file->name, &target, AT_SYMLINK_NOFOLLOW) == 0 && target.st_dev == other.st_dev &&
           target.st_ino == other.st_ino;
}

void output_file_remove_target(const output_file *file) { unlinkat(file->place.folder, file->name, 0); }

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
    if (file->place.folder >= 0 && file->temporary_name[0] != '\0')
        unlinkat(file->place.folder, file->temporary_name, 0);
    close_place(&file->place);
    free(file->temporary_path);
    free(file->path);
    free(file);
}
