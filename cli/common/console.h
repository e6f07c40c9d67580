/* SPDX-License-Identifier: MIT */
/* What every verb shares: exit codes, one-line errors on stderr, JSON on stdout. */
#ifndef MANGATA_CLI_COMMON_CONSOLE_H
#define MANGATA_CLI_COMMON_CONSOLE_H

#include <jansson.h>
#include <stdbool.h>

#include "image/file_error.h"
#include "mangata/mangata.h"
#include "scene/scene_file.h"

/* Documented in docs/command.md; 64 and above follow sysexits.h, 128 + n a signal. */
typedef enum exit_code {
    EXIT_CODE_OK = 0,
    EXIT_CODE_FAILED = 1,
    EXIT_CODE_DIFFERENT = 2,
    EXIT_CODE_USAGE = 64,
    EXIT_CODE_BAD_INPUT = 65,
    EXIT_CODE_NO_INPUT = 66,
    EXIT_CODE_UNAVAILABLE = 69,
    EXIT_CODE_CANNOT_WRITE = 73,
    EXIT_CODE_TRY_AGAIN = 75
} exit_code;

/* The options that every verb knows. */
typedef struct console {
    bool json, verbose, quiet;
    bool json_notes; /* notes and details are JSON lines, as those of --progress json beside them */
} console;

/* Prints "mangata: …" as one line on stderr and returns `code`. */
int console_error(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* A line for people on stderr: notes unless --quiet, details with -v only. */
void console_note(const console *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void console_detail(const console *out, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Print an error of a file, a scene or the library; each returns its exit code. */
int console_file_error(const file_error *error);
int console_scene_error(const scene_error *error);
int console_library_error(const mgt_context *context, mgt_status status);

int exit_code_of_scene_error(scene_error_kind kind);
int exit_code_of_status(mgt_status status);

/* An mgt_log_function; `user` is a const console. Errors are left to console_library_error. */
void console_log(void *user, mgt_log_level level, const char *id, const char *text);

/* A JSON string of any bytes: what is not UTF-8 becomes "?". */
json_t *console_json_text(const char *text);

/* Writes `value` to stdout and releases it. NULL means that memory ran out. */
int console_print_json(json_t *value);

/* Flushes stdout and says so when that failed, for the end of the program: returns `code`, or why output was lost. */
int console_finish(int code);

#endif
