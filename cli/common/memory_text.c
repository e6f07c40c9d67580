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
