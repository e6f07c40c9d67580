/* SPDX-License-Identifier: MIT */
/* Text and bytes as they stand in HTML, SVG and a shell. */
#ifndef MANGATA_CLI_COMMON_MARKUP_H
#define MANGATA_CLI_COMMON_MARKUP_H

#include <stdint.h>
#include <stdio.h>

/* Writes text as it may stand between tags and in attributes. */
void markup_escape(FILE *stream, const char *text);

/* Writes a blank, then the word as a POSIX shell reads it. */
void shell_word(FILE *stream, const char *word);

/* The same for a scene: its file's name, or --sea and its words. */
void shell_scene(FILE *stream, const char *path);

/* The bytes in base64; the caller frees it, NULL when memory runs out. */
char *base64_text(const uint8_t *bytes, size_t size, size_t *length);

#endif
