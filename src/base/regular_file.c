/* SPDX-License-Identifier: MIT */
#include "base/regular_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIRST_BYTES = 64 * 1024 };

static bool fails(regular_file *file, regular_file_fault fault, const char *what)
{
    file->fault = fault;
    file->what = what;
    return false;
}

bool regular_file_open(regular_file *file, const char *path)
{
    struct stat status;
    *file = (regular_file){0};
    /* Without O_NONBLOCK a named pipe would wait for its other end. */
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0)
        return errno == ENXIO ? fails(file, REGULAR_FILE_OTHER, "is no regular file") : fails(file, REGULAR_FILE_MISSING, strerror(errno));
    if (fstat(descriptor, &status) != 0)
        fails(file, REGULAR_FILE_MISSING, strerror(errno));
    else if (S_ISDIR(status.st_mode))
        fails(file, REGULAR_FILE_FOLDER, "is a directory");
    else if (!S_ISREG(status.st_mode))
        fails(file, REGULAR_FILE_OTHER, "is no regular file");
    else if ((file->stream = fdopen(descriptor, "rb")) == NULL)
        fails(file, REGULAR_FILE_MEMORY, "memory ran out");
    if (file->stream == NULL)
        close(descriptor);
    else
        file->size = (uint64_t)status.st_size;
    return file->stream != NULL;
}

char *regular_file_read(regular_file *file, const char *path, bool or_standard_input, size_t most, const char *what, size_t *length)
{
    const bool standard_input = or_standard_input && strcmp(path, "-") == 0;
    char *text = NULL;
    size_t room = 0; /* memory for the text without its NUL, bytes */
    *length = 0;
    if (standard_input)
        *file = (regular_file){.stream = stdin};
    else if (!regular_file_open(file, path))
        return NULL;
    if (file->size > most)
        fails(file, REGULAR_FILE_LARGE, what);
    size_t next = standard_input ? FIRST_BYTES : (size_t)file->size + 1;
    while (file->fault == REGULAR_FILE_SOUND && *length == room) {
        room = next <= most ? next : most + 1;
        next = 2 * room;
        char *more = realloc(text, room + 1);
        if (more == NULL) {
            fails(file, REGULAR_FILE_MEMORY, "memory ran out");
            break;
        }
        text = more;
        *length += fread(text + *length, 1, room - *length, file->stream);
        if (ferror(file->stream))
            fails(file, REGULAR_FILE_MISSING, strerror(errno));
        else if (*length > most)
            fails(file, REGULAR_FILE_LARGE, what);
    }
    if (!standard_input)
        fclose(file->stream);
    file->stream = NULL;
    if (file->fault != REGULAR_FILE_SOUND) {
        free(text);
        return NULL;
    }
    text[*length] = '\0';
    return text;
}
