/* SPDX-License-Identifier: MIT */
/* Errors of files: places taken out of their lines. */
#include "io/io_error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/struct_size.h"

const char *mgt_io_version(void) { return MGT_VERSION_STRING; }

void mgt_io_error_init(mgt_io_error *error, size_t size)
{
    if (error && struct_size_fits(size, sizeof error->struct_size, sizeof *error)) {
        memset(error, 0, size);
        error->struct_size = size;
    }
}

/* "file:12:3: " at the front of `text`: its length, 0 where there is none. */
static size_t place_of(const char *text, mgt_io_error *error)
{
    for (const char *colon = strchr(text, ':'); colon; colon = strchr(colon + 1, ':')) {
        char *end;
        const unsigned long line = strtoul(colon + 1, &end, 10);
        if (end == colon + 1 || *end != ':')
            continue;
        const char *after = end + 1;
        const unsigned long column = strtoul(after, &end, 10);
        if (end == after || strncmp(end, ": ", 2) != 0)
            continue;
        error->line = (uint32_t)line;
        error->column = (uint32_t)column;
        snprintf(error->file, sizeof error->file, "%.*s", (int)(colon - text), text);
        return (size_t)(end + 2 - text);
    }
    return 0;
}

mgt_io_status io_error_take(mgt_io_error *error, mgt_io_status status, const char *text)
{
    if (!error || !struct_size_fits(error->struct_size, sizeof *error, sizeof *error))
        return status;
    mgt_io_error_init(error, error->struct_size);
    snprintf(error->text, sizeof error->text, "%s", text + place_of(text, error));
    return status;
}

mgt_io_status io_error_of_file(mgt_io_error *error, const file_error *from)
{
    mgt_io_status status = MGT_IO_BAD;
    switch (from->status) {
    case FILE_OK:
        return MGT_IO_OK;
    case FILE_MISSING:
        status = MGT_IO_MISSING;
        break;
    case FILE_ARGUMENT:
        status = MGT_IO_ARGUMENT;
        break;
    case FILE_MEMORY:
        status = MGT_IO_MEMORY;
        break;
    default:
        break;
    }
    return io_error_take(error, status, from->text);
}
