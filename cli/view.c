/* SPDX-License-Identifier: MIT */
/* `mangata view`: runs the viewer, which is another program, so that this one links no window system. */
#define _GNU_SOURCE
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/child_process.h"
#include "cli/common/verbs.h"
#include "cli/view_request.h"

enum { PATH_SIZE = 4096 };

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
    if (program_beside(program, beside, sizeof beside))
        execv(beside, words);
    else
        execvp(program, words);
    free(words);
    return console_error(EXIT_CODE_UNAVAILABLE, errno == ENOENT ? "the viewer is not installed: no %s on the PATH" : "%s cannot be started", program);
}
