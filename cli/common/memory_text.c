/* SPDX-License-Identifier: MIT */
#include "cli/common/memory_text.h"

#include <stdbool.h>
#include <stdlib.h>

char *memory_text_finish(FILE *stream, char **text)
{
    const bool failed = ferror(stream) != 0;
    if (fclose(stream) == 0 && !failed)
        return *text;
    free(*text);
    *text = NULL;
    return NULL;
}

char *memory_text_read(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    FILE *memory = file ? open_memstream(&text, size) : NULL;
    char block[4096];
    for (size_t n; memory && (n = fread(block, 1, sizeof block, file)) > 0;)
        fwrite(block, 1, n, memory);
    if (file)
        fclose(file);
    return memory ? memory_text_finish(memory, &text) : NULL;
}
