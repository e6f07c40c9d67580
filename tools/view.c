/* SPDX-License-Identifier: MIT */
/* `mangata view`: hands over to the viewer, a program of its own, so that this one links no window system. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "options.h"
#include "verbs.h"

static const option_table view_table = {
    "view", "SCENE", "Opens a scene in the interactive viewer, the program mangata-viewer.", NULL, 0, "exit codes: 64 usage, 69 the viewer is not installed"};

int verb_view(int count, char **arguments)
{
    console out = {0};
    option_reader reader = option_reader_start(&view_table, &out, count, arguments);
    char program[] = "mangata-viewer";
    const char *value = NULL, *scene = NULL;
    int id;
    while ((id = option_reader_next(&reader, &value)) != OPTION_END) {
        if (id == OPTION_HELP)
            return EXIT_CODE_OK;
        if (id == OPTION_ERROR)
            return EXIT_CODE_USAGE;
        if (scene)
            return console_error(EXIT_CODE_USAGE, "one scene at a time: %s and %s are given", scene, value);
        scene = value;
    }
    if (!scene)
        return console_error(EXIT_CODE_USAGE, "no scene given: mangata view SCENE");
    char *path = strdup(scene);
    if (!path)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    char *words[] = {program, path, NULL};
    execvp(program, words);
    free(path);
    return console_error(EXIT_CODE_UNAVAILABLE, errno == ENOENT ? "the viewer is not installed: no %s on the PATH" : "%s cannot be started", program);
}
