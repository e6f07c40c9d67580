/* SPDX-License-Identifier: MIT */
/* Errors of everything in src/image: a kind for the exit code and one line of text for people. */
#ifndef MANGATA_IMAGE_FILE_ERROR_H
#define MANGATA_IMAGE_FILE_ERROR_H

typedef enum file_status {
    FILE_OK = 0,
    FILE_ARGUMENT,    /* the caller asked for something meaningless (size 0, unknown extension, no such layer) */
    FILE_MISSING,     /* an input that is not there, cannot be opened, or is no regular file */
    FILE_BAD,         /* an input that is not what it should be: truncated, garbage, unsupported kind */
    FILE_EXISTS,      /* the output exists and overwriting was not asked for */
    FILE_WRITE,       /* the output cannot be written: folder missing or unwritable, disk full, … */
    FILE_UNAVAILABLE, /* ffmpeg is missing */
    FILE_MEMORY,      /* an allocation failed */
    FILE_CANCELLED    /* the caller's cancel flag was set; nothing was left behind */
} file_status;

/* Filled on failure; the text names the file and the reason in one line without a newline. */
typedef struct file_error {
    file_status status;
    char text[512];
} file_error;

/* Fills `error` (NULL is allowed), keeps the text to one line and returns `status`. */
file_status file_error_set(file_error *error, file_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The same as "path: what: strerror(code)"; ENOMEM becomes FILE_MEMORY. `what` may be NULL. */
file_status file_error_errno(file_error *error, file_status status, const char *path, const char *what, int code);

#endif
