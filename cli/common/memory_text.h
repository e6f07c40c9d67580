/* SPDX-License-Identifier: MIT */
#ifndef MANGATA_CLI_COMMON_MEMORY_TEXT_H
#define MANGATA_CLI_COMMON_MEMORY_TEXT_H

#include <stdio.h>

/* Closes a stream of open_memstream() and returns its text, which the caller frees. NULL, and nothing left to free, where a write or the close failed. */
char *memory_text_finish(FILE *stream, char **text);

#endif
