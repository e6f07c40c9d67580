/* SPDX-License-Identifier: MIT */
/* One-line error texts. */
#define _POSIX_C_SOURCE 200809L

#include "image/file_error.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

file_status file_error_set(file_error *error, file_status status, const char *format, ...)
{
    if (!error)
        return status;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    /* A file name may hold a newline; the message must not. */
    for (char *c = error->text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = ' ';
    error->status = status;
    return status;
}

file_status file_error_errno(file_error *error, file_status status, const char *path, const char *what, int code)
{
    char reason[128];
    /* strerror_r in its POSIX form; strerror itself may share a buffer between threads. */
    if (strerror_r(code, reason, sizeof reason) != 0)
        snprintf(reason, sizeof reason, "error %d", code);
    if (code == ENOMEM)
        status = FILE_MEMORY;
    if (what)
        return file_error_set(error, status, "%s: %s: %s", path, what, reason);
    return file_error_set(error, status, "%s: %s", path, reason);
}
