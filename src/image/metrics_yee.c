/* SPDX-License-Identifier: MIT */
/* Running idiff on two temporary pictures and reading what it says. */
#define _GNU_SOURCE /* memfd_create, asprintf */

#include "image/metrics_yee.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "image/picture.h"

extern char **environ;

enum { TEXT_SIZE = 4096 };

int yee_parse(const char *text, uint64_t *failures)
{
    const char *end = strstr(text, " failed the perceptual test");
    if (!end) {
        *failures = 0;
        return strstr(text, "\nPASS") != NULL;
    }
    while (end > text && end[-1] != '\n')
        end--;
    char *after;
    *failures = strtoull(end, &after, 10);
    return after != end && strncmp(after, " pixels", 7) == 0;
}

/* Its output goes to the memory file `text`. 0 or an errno; *exit_status as waitpid() gives it. */
static int run_idiff(const char *idiff, char *const paths[2], int text, int *exit_status)
{
    char program[] = "idiff", perceptual[] = "-p";
    char *const arguments[] = {program, perceptual, paths[0], paths[1], NULL};
    posix_spawn_file_actions_t actions;
    pid_t pid;
    int code = posix_spawn_file_actions_init(&actions);
    if (code)
        return code;
    code = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (!code)
        code = posix_spawn_file_actions_adddup2(&actions, text, STDOUT_FILENO);
    if (!code)
        code = posix_spawn_file_actions_adddup2(&actions, text, STDERR_FILENO);
    if (!code)
        code = posix_spawnp(&pid, idiff ? idiff : program, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code)
        return code;
    while (waitpid(pid, exit_status, 0) < 0)
        if (errno != EINTR)
            return errno;
    return 0;
}

static file_status ask_idiff(uint64_t *failures, const char *idiff, char *const paths[2], file_error *error)
{
    char text[TEXT_SIZE] = "";
    int exit_status = 0;
    const int memory = memfd_create("idiff", MFD_CLOEXEC);
    if (memory < 0)
        return file_error_errno(error, FILE_UNAVAILABLE, "idiff", "cannot start", errno);
    const int code = run_idiff(idiff, paths, memory, &exit_status);
    const ssize_t length = code ? 0 : pread(memory, text, sizeof text - 1, 0);
    close(memory);
    if (code == ENOENT)
        return file_error_set(error, FILE_UNAVAILABLE, "%s, which makes Yee's test, %s (Debian: openimageio-tools)", idiff ? idiff : "idiff",
                              idiff ? "is not there" : "is not on the PATH");
    if (code)
        return file_error_errno(error, FILE_UNAVAILABLE, idiff ? idiff : "idiff", "cannot start this idiff", code);
    text[length > 0 ? length : 0] = '\0';
    if (yee_parse(text, failures))
        return FILE_OK;
    if (WIFSIGNALED(exit_status))
        return file_error_set(error, FILE_UNAVAILABLE, "idiff was ended by signal %d", WTERMSIG(exit_status));
    return file_error_set(error, FILE_UNAVAILABLE, "idiff gave no verdict (status %d): %.300s", WEXITSTATUS(exit_status), text);
}

file_status yee_failures(double *share, const float *a, const float *b, uint32_t width, uint32_t height, const char *idiff, file_error *error)
{
    const char *const parent = getenv("TMPDIR");
    const picture_layer layers[2] = {{.name = "color", .channels = 3, .pixels = a}, {.name = "color", .channels = 3, .pixels = b}};
    char *folder = NULL, *paths[2] = {NULL, NULL};
    file_status status = FILE_OK;
    uint64_t failures = 0;
    if (asprintf(&folder, "%s/mangata-idiff-XXXXXX", parent && *parent ? parent : "/tmp") < 0)
        return file_error_set(error, FILE_MEMORY, "out of memory");
    if (!mkdtemp(folder)) {
        status = file_error_errno(error, FILE_WRITE, folder, "cannot make a temporary folder", errno);
        free(folder);
        return status;
    }
    for (int i = 0; i < 2 && status == FILE_OK; i++) {
        if (asprintf(&paths[i], "%s/%c.pfm", folder, "ab"[i]) < 0) {
            paths[i] = NULL;
            status = file_error_set(error, FILE_MEMORY, "out of memory");
        } else {
            status = picture_write_pfm(paths[i], width, height, &layers[i], NULL, NULL, error);
        }
    }
    if (status == FILE_OK)
        status = ask_idiff(&failures, idiff, paths, error);
    for (int i = 0; i < 2; i++) {
        if (paths[i])
            unlink(paths[i]);
        free(paths[i]);
    }
    rmdir(folder);
    free(folder);
    if (status == FILE_OK)
        *share = (double)failures / ((double)width * height);
    return status;
}
