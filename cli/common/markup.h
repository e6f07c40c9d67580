/* SPDX-License-Identifier: MIT */
/* Text and bytes in the forms that HTML, SVG and a shell need. */
#ifndef MANGATA_CLI_COMMON_MARKUP_H
#define MANGATA_CLI_COMMON_MARKUP_H

#include <stdint.h>
#include <stdio.h>

/* Writes text for use between tags and in double-quoted attributes of HTML and SVG. */
void markup_escape(FILE *stream, const char *text);

/* Writes a blank, then the word, quoted for a POSIX shell if necessary. */
void shell_word(FILE *stream, const char *word);

/* The same for a scene: the path of its file, or "--sea" and its words. */
void shell_scene(FILE *stream, const char *path);

/* The bytes in base64, 0-terminated. `length` gets the length without the 0. The caller frees the text. NULL: out of memory. */
char *base64_text(const uint8_t *bytes, size_t size, size_t *length);

#endif
