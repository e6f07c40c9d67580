/* SPDX-License-Identifier: MIT */
/* Messages of one line and their exit codes. */
#include "cli/common/console.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "scene/scene_text.h"

void console_begin(void)
{
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; descriptor++)
        if (fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
            /* The lowest free number is this one. Where there is no /dev/null it stays closed. */
            const int opened = open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
            (void)opened;
        }
}

/* Prints a message as one line without characters that control a terminal, because names of files may contain anything. */
static void print_line(const char *prefix, const char *format, va_list arguments)
{
    char text[2048], line[2048];
    vsnprintf(text, sizeof text, format, arguments);
    scene_copy_line(line, sizeof line, text, strlen(text));
    fprintf(stderr, "%s%s\n", prefix, line);
}

/* Prints the message as {"event": "note", "text": …}. */
static void print_json_line(const char *format, va_list arguments)
{
    char text[2048];
    vsnprintf(text, sizeof text, format, arguments);
    char *line = NULL;
    json_t *note = json_pack("{s:s, s:o}", "event", "note", "text", console_json_text(text));
    if (note)
        line = json_dumps(note, JSON_COMPACT);
    if (line)
        fprintf(stderr, "%s\n", line);
    free(line);
    json_decref(note);
}

static void print_note(const console *out, const char *format, va_list arguments)
{
    if (out->json_notes)
        print_json_line(format, arguments);
    else
        print_line("", format, arguments);
}

int console_error(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line("mangata: ", format, arguments);
    va_end(arguments);
    return code;
}

void console_note(const console *out, const char *format, ...)
{
    if (out->quiet)
        return;
    va_list arguments;
    va_start(arguments, format);
    print_note(out, format, arguments);
    va_end(arguments);
}

void console_detail(const console *out, const char *format, ...)
{
    if (!out->verbose || out->quiet)
        return;
    va_list arguments;
    va_start(arguments, format);
    print_note(out, format, arguments);
    va_end(arguments);
}

int console_file_error(const file_error *error)
{
    int code = EXIT_CODE_FAILED;
    switch (error->status) {
    case FILE_ARGUMENT:
        code = EXIT_CODE_USAGE;
        break;
    case FILE_MISSING:
        code = EXIT_CODE_NO_INPUT;
        break;
    case FILE_BAD:
        code = EXIT_CODE_BAD_INPUT;
        break;
    case FILE_EXISTS:
    case FILE_WRITE:
        code = EXIT_CODE_CANNOT_WRITE;
        break;
    case FILE_UNAVAILABLE:
        code = EXIT_CODE_UNAVAILABLE;
        break;
    case FILE_OK:
    case FILE_MEMORY:
    case FILE_CANCELLED:
        break;
    }
    return console_error(code, "%s%s", error->text, error->status == FILE_EXISTS ? "; --overwrite replaces it" : "");
}

int exit_code_of_scene_error(scene_error_kind kind)
{
    switch (kind) {
    case SCENE_ERROR_NONE:
        return EXIT_CODE_OK;
    case SCENE_ERROR_MISSING_INPUT:
        return EXIT_CODE_NO_INPUT;
    case SCENE_ERROR_BAD_SCENE:
        return EXIT_CODE_BAD_INPUT;
    case SCENE_ERROR_BAD_OVERRIDE:
        return EXIT_CODE_USAGE;
    case SCENE_ERROR_MEMORY:
        break;
    }
    return EXIT_CODE_FAILED;
}

int console_scene_error(const scene_error *error)
{
    const int code = exit_code_of_scene_error(error->kind);
    if (error->kind != SCENE_ERROR_BAD_SCENE)
        return console_error(code, "%s", error->text);
    /* Editors jump to lines that begin with "file:line:column:". */
    static const console loud = {0};
    console_note(&loud, "%s", error->text);
    return code;
}

int exit_code_of_status(mgt_status status)
{
    switch (status) {
    case MGT_OK:
        return EXIT_CODE_OK;
    case MGT_ERROR_SCENE:
        return EXIT_CODE_BAD_INPUT;
    case MGT_ERROR_UNAVAILABLE:
    case MGT_ERROR_UNSUPPORTED:
        return EXIT_CODE_UNAVAILABLE;
    case MGT_ERROR_LOST:
    case MGT_ERROR_THREAD:
        return EXIT_CODE_TRY_AGAIN;
    case MGT_ERROR_ARGUMENT:
    case MGT_ERROR_MEMORY:
    case MGT_CANCELLED:
        break;
    }
    return EXIT_CODE_FAILED;
}

int console_library_error(const mgt_context *context, mgt_status status)
{
    const char *detail = mgt_last_error(context);
    return console_error(exit_code_of_status(status), "%s", detail[0] ? detail : mgt_status_text(status));
}

void console_log(void *user, mgt_log_level level, const char *id, const char *text)
{
    const console *out = user;
    if (level == MGT_LOG_WARNING)
        console_note(out, "mangata: warning: %s [%s]", text, id);
    else if (level != MGT_LOG_ERROR)
        console_detail(out, "mangata: %s [%s]", text, id);
}

json_t *console_json_text(const char *text)
{
    json_t *string = json_string(text);
    char *copy = string ? NULL : strdup(text);
    if (!copy)
        return string;
    for (char *p = copy; *p; p++)
        if ((unsigned char)*p >= 0x80)
            *p = '?';
    string = json_string(copy);
    free(copy);
    return string;
}

int console_print_json(json_t *value)
{
    if (!value)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    const int failed = json_dumpf(value, stdout, JSON_INDENT(2) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(12));
    json_decref(value);
    putchar('\n');
    return failed ? EXIT_CODE_CANNOT_WRITE : EXIT_CODE_OK;
}

int console_finish(int code)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    const int error = errno;
    console_error(0, "standard output: %s", error ? strerror(error) : "write error");
    return code == EXIT_CODE_OK ? EXIT_CODE_CANNOT_WRITE : code;
}
