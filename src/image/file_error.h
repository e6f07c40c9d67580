/* SPDX-License-Identifier: MIT */
/* Errors of src/image: a kind, which gives the exit code, and one line of text. */
#ifndef MANGATA_IMAGE_FILE_ERROR_H
#define MANGATA_IMAGE_FILE_ERROR_H

typedef enum file_status {
    FILE_OK = 0,
    FILE_ARGUMENT,    /* an argument has no meaning: size 0, unknown extension, no such layer */
    FILE_MISSING,     /* an input does not exist, cannot be opened, or is no regular file */
    FILE_BAD,         /* an input is truncated, damaged, or of an unsupported kind */
    FILE_EXISTS,      /* the output exists, and it may not be overwritten */
    FILE_WRITE,       /* the output cannot be written: its folder is missing or not writable, or the disk is full */
    FILE_UNAVAILABLE, /* a program, such as ffmpeg, is missing */
    FILE_MEMORY,      /* out of memory */
    FILE_CANCELLED    /* the caller's cancel flag was set; the output is removed */
} file_status;

/* A failure. The text names the file and the reason in one line without a newline. */
typedef struct file_error {
    file_status status;
    char text[512];
} file_error;

/* Fills `error` with one line. NULL is allowed. Returns `status`. */
file_status file_error_set(file_error *error, file_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Fills `error` with "path: what: strerror(code)". `what` may be NULL. Returns `status`, or FILE_MEMORY for ENOMEM. */
file_status file_error_errno(file_error *error, file_status status, const char *path, const char *what, int code);

#endif
