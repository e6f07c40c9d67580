/* SPDX-License-Identifier: MIT
 * Film export by the command mangata as a child process. The scene is its standard input. Its standard error gives lines of JSON. */
#define _GNU_SOURCE
#include "viewer/picture/film_export.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <jansson.h>

#include "base/child_process.h"

enum { PATH_SIZE = 4096, LINE_SIZE = 4096, WORDS_MOST = 48 };

struct film_export {
    pid_t pid;  /* 0: it has ended */
    int output; /* read end of its standard error, which never blocks */
    char line[LINE_SIZE];
    size_t used;     /* characters of `line`, the line that is not complete yet */
    double fraction; /* of the film that is done */
    char text[512];  /* its last line that is not JSON: the reason of a failure */
};

/* Opens a file without a name that holds the text, at its start. Returns the descriptor; -1: it cannot be written. */
static int file_of_text(const char *text, size_t size)
{
    FILE *stream = tmpfile();
    if (!stream)
        return -1;
    const bool good = fwrite(text, 1, size, stream) == size && fflush(stream) == 0;
    const int copy = good ? fcntl(fileno(stream), F_DUPFD_CLOEXEC, 3) : -1;
    fclose(stream);
    if (copy >= 0)
        lseek(copy, 0, SEEK_SET);
    return copy;
}

film_export *film_export_start(const char *scene, size_t scene_size, const char *const *words, char *error, size_t error_size)
{
    char beside[PATH_SIZE], *arguments[WORDS_MOST + 8];
    int pipe_ends[2] = {-1, -1}, input = -1, code = ENOMEM;
    size_t count = 0;
    film_export *f = calloc(1, sizeof *f);
    const bool found = program_beside("mangata", beside, sizeof beside);
    static char env[] = "env", command[] = "mangata", render[] = "render", standard_input[] = "-", progress[] = "--progress", json[] = "json";
    if (!found)
        arguments[count++] = env;
    arguments[count++] = command;
    arguments[count++] = render;
    arguments[count++] = standard_input;
    arguments[count++] = progress;
    arguments[count++] = json;
    for (size_t i = 0; words[i] && i < WORDS_MOST; i++)
        arguments[count++] = (char *)words[i];
    arguments[count] = NULL;
    if (f && pipe2(pipe_ends, O_CLOEXEC) == 0 && (input = file_of_text(scene, scene_size)) >= 0) {
        const child_descriptors descriptors = {.standard = {input, -1, pipe_ends[1]}, .extra = -1};
        code = child_process_start(&f->pid, found ? beside : "/usr/bin/env", arguments, &descriptors, true);
    }
    if (input >= 0)
        close(input);
    if (pipe_ends[1] >= 0)
        close(pipe_ends[1]);
    if (code == 0) {
        f->output = pipe_ends[0];
        fcntl(f->output, F_SETFL, O_NONBLOCK);
        return f;
    }
    snprintf(error, error_size, "the command mangata cannot be started: %s", strerror(code));
    if (pipe_ends[0] >= 0)
        close(pipe_ends[0]);
    free(f);
    return NULL;
}

void film_export_destroy(film_export *f)
{
    if (!f)
        return;
    if (f->pid > 0) {
        kill(f->pid, SIGTERM);
        while (waitpid(f->pid, NULL, 0) < 0 && errno == EINTR) {
        }
    }
    close(f->output);
    free(f);
}

/* Takes the progress from a line, or keeps the line if it is not JSON. */
static void take_line(film_export *f)
{
    json_t *line = json_loads(f->line, 0, NULL);
    const json_t *fraction = json_object_get(line, "fraction");
    if (fraction)
        f->fraction = json_number_value(fraction);
    if (!line && f->line[0])
        snprintf(f->text, sizeof f->text, "%.500s", f->line);
    json_decref(line);
}

/* Reads all that the command has written so far. */
static void read_lines(film_export *f)
{
    char block[1024];
    for (ssize_t got; (got = read(f->output, block, sizeof block)) > 0;)
        for (ssize_t i = 0; i < got; i++) {
            if (block[i] != '\n') {
                if (f->used + 1 < sizeof f->line)
                    f->line[f->used++] = block[i];
                continue;
            }
            f->line[f->used] = 0;
            f->used = 0;
            take_line(f);
        }
}

film_state film_export_poll(film_export *f, double *fraction, char *error, size_t error_size)
{
    int status = 0;
    const pid_t ended = f->pid > 0 ? waitpid(f->pid, &status, WNOHANG) : 0;
    read_lines(f); /* after waitpid(), so that all lines of a command that has ended are read */
    *fraction = f->fraction;
    if (ended == 0)
        return FILM_BUSY;
    f->pid = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return FILM_SAVED;
    const char *text = strncmp(f->text, "mangata: ", 9) == 0 ? f->text + 9 : f->text;
    snprintf(error, error_size, "%s", text[0] ? text : "the command mangata ended early");
    return FILM_FAILED;
}
