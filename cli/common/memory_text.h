/* SPDX-License-Identifier: MIT */
/* Texts in memory: streams of open_memstream(), and whole files. */
#ifndef MANGATA_CLI_COMMON_MEMORY_TEXT_H
#define MANGATA_CLI_COMMON_MEMORY_TEXT_H

#include <stdio.h>

/* Closes a stream of open_memstream() and returns its text, which the caller frees. NULL: a write or the close has failed; there is nothing to free. */
char *memory_text_finish(FILE *stream, char **text);

/* The bytes of a file, followed by a 0. `size` gets their number without the 0. The caller frees them. NULL: the file cannot be read, or memory has run out. */
char *memory_text_read(const char *path, size_t *size);

#endif
