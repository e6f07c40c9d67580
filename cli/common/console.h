/* SPDX-License-Identifier: MIT */
/* Exit codes and output of every verb: errors of one line on stderr, JSON on stdout. */
#ifndef MANGATA_CLI_COMMON_CONSOLE_H
#define MANGATA_CLI_COMMON_CONSOLE_H

#include <jansson.h>
#include <stdbool.h>

#include "image/file_error.h"
#include "mangata/mangata.h"
#include "scene/scene_file.h"

/* docs/command.md describes them. Codes from 64 on follow sysexits.h. A process that signal n has ended returns 128 + n. */
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

/* The options that every verb has. */
typedef struct console {
    bool json, verbose, quiet;
    bool json_notes; /* notes and details are printed as lines of JSON, like those of --progress json */
} console;

/* Prints "mangata: …" as one line on stderr and returns `code`. Characters that a terminal would interpret are replaced. */
int console_error(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Print a line on stderr: notes unless --quiet is given, details only with -v and without --quiet. */
void console_note(const console *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
void console_detail(const console *out, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Print an error of a file, a scene or the library; each returns its exit code. */
int console_file_error(const file_error *error);
int console_scene_error(const scene_error *error);
int console_library_error(const mgt_context *context, mgt_status status);

/* Exit codes of errors of scenes and of the library. */
int exit_code_of_scene_error(scene_error_kind kind);
int exit_code_of_status(mgt_status status);

/* An mgt_log_function; `user` is a const console *. It prints warnings as notes and other messages as details. It leaves out errors, which
 * console_library_error() prints. */
void console_log(void *user, mgt_log_level level, const char *id, const char *text);

/* A JSON string of any bytes. If they are not UTF-8, every byte from 0x80 on becomes "?". NULL: out of memory. */
json_t *console_json_text(const char *text);

/* Writes `value` to stdout and releases it. Returns an exit code. `value` may be NULL if memory has run out, which is then printed as an error. */
int console_print_json(json_t *value);

/* To be called before anything else. Standard streams that the parent has closed are opened on /dev/null, so that no file of this process takes their numbers
 * and messages and pictures do not mix. Reading and writing them still fails, as with a closed one. */
void console_begin(void);

/* Flushes stdout at the end of the program. Returns `code`. If writing has failed, it prints that and returns EXIT_CODE_CANNOT_WRITE instead of
 * EXIT_CODE_OK. */
int console_finish(int code);

#endif
