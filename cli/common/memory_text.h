/* SPDX-License-Identifier: MIT */
#ifndef MANGATA_CLI_COMMON_MEMORY_TEXT_H
#define MANGATA_CLI_COMMON_MEMORY_TEXT_H

#include <stdio.h>

/* Closes a stream of open_memstream() and returns its text, which the caller frees. NULL, and nothing left to free, where a write or the close failed. */
char *memory_text_finish(FILE *stream, char **text);

/* A file's bytes and a 0 behind them, which the caller frees. NULL where it cannot be opened or memory runs out. */
char *memory_text_read(const char *path, size_t *size);

#endif
