/* SPDX-License-Identifier: MIT */
/* Errors of files: places taken out of their lines. */
#include "io/io_error.h"

#include <ctype.h>
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

void io_copy_words(char *out, size_t size, const char *text)
{
    static const struct {
        const char *command, *library;
    } words[] = {{"--set ", "change "}, {"--sea ", "sea "}};
    enum { COUNT = sizeof words / sizeof *words };
    size_t used = 0;
    while (*text && used + 1 < size) {
        size_t i = 0;
        while (i < COUNT && strncmp(text, words[i].command, strlen(words[i].command)) != 0)
            i++;
        if (i == COUNT) {
            out[used++] = *text++;
            continue;
        }
        const size_t length = (size_t)snprintf(out + used, size - used, "%s", words[i].library);
        used = used + length < size ? used + length : size - 1;
        text += strlen(words[i].command);
    }
    out[used] = 0;
}

/* A number from 1 at *text, with a colon behind it: 0 where there is none, else *text is behind the colon. */
static uint32_t number_before_colon(const char **text)
{
    char *end;
    if (!isdigit((unsigned char)**text))
        return 0;
    const unsigned long number = strtoul(*text, &end, 10);
    if (*end != ':' || number > UINT32_MAX)
        return 0;
    *text = end + 1;
    return (uint32_t)number;
}

/* Takes the place in the file that `shown` names from the front of `text`. Returns what is behind it. */
static const char *take_place(mgt_io_error *error, const char *text, const char *path, const char *shown)
{
    const size_t length = strlen(shown);
    if (strncmp(text, shown, length) != 0 || text[length] != ':')
        return text;
    const char *at = text + length + 1;
    const uint32_t line = number_before_colon(&at), column = line > 0 ? number_before_colon(&at) : 0;
    if (*at != ' ' || (line > 0 && column == 0))
        return text;
    snprintf(error->file, sizeof error->file, "%s", path);
    error->line = line;
    error->column = column;
    return at + 1;
}

static bool fits(const mgt_io_error *error) { return error && struct_size_fits(error->struct_size, sizeof *error, sizeof *error); }

mgt_io_status io_error_take_file(mgt_io_error *error, mgt_io_status status, const char *text, const char *path, const char *shown)
{
    if (!fits(error))
        return status;
    mgt_io_error_init(error, error->struct_size);
    io_copy_words(error->text, sizeof error->text, path ? take_place(error, text, path, shown) : text);
    return status;
}

mgt_io_status io_error_take(mgt_io_error *error, mgt_io_status status, const char *text) { return io_error_take_file(error, status, text, NULL, NULL); }

/* A name as lines of file_error_set() have it: without what would end the line. */
static void show_name(char *out, size_t size, const char *path)
{
    snprintf(out, size, "%s", path);
    for (char *c = out; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = ' ';
}

mgt_io_status io_error_of_file(mgt_io_error *error, const file_error *from, const char *path)
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
    char shown[sizeof from->text] = "";
    if (path)
        show_name(shown, sizeof shown, path);
    return io_error_take_file(error, status, from->text, path, shown);
}
