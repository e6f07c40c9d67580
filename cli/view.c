/* SPDX-License-Identifier: MIT */
/* `mangata view`: hands over to the viewer, a program of its own, so that this one links no window system. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/verbs.h"
#include "cli/view_request.h"

enum { PATH_SIZE = 4096 };

/* The viewer beside this program; false where there is none. */
static bool find_beside(char path[PATH_SIZE])
{
    const ssize_t length = readlink("/proc/self/exe", path, PATH_SIZE - 1);
    if (length <= 0)
        return false;
    path[length] = 0;
    char *name = strrchr(path, '/');
    const size_t room = name ? PATH_SIZE - (size_t)(name + 1 - path) : 0;
    if (!name || (size_t)snprintf(name + 1, room, "mangata-viewer") >= room)
        return false;
    return access(path, X_OK) == 0;
}

int verb_view(int count, char **arguments)
{
    view_request request;
    const int code = view_request_read(&request, count, arguments);
    view_request_free(&request);
    if (code != EXIT_CODE_OK)
        return code < 0 ? EXIT_CODE_OK : code;
    char program[] = "mangata-viewer", beside[PATH_SIZE];
    char **words = calloc((size_t)count + 2, sizeof *words);
    if (!words)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    words[0] = program;
    memcpy(words + 1, arguments, (size_t)count * sizeof *words);
    if (find_beside(beside))
        execv(beside, words);
    else
        execvp(program, words);
    free(words);
    return console_error(EXIT_CODE_UNAVAILABLE, errno == ENOENT ? "the viewer is not installed: no %s on the PATH" : "%s cannot be started", program);
}
