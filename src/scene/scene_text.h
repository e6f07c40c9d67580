/* SPDX-License-Identifier: MIT
 *
 * Text for messages: safe quoting, shortest numbers, UTF-8 checks, the nearest known word.
 */
#ifndef MANGATA_SCENE_SCENE_TEXT_H
#define MANGATA_SCENE_SCENE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/regular_file.h"
#include "scene/scene_file.h"

#define SCENE_FORMAT(string, first) __attribute__((format(printf, string, first)))

/* A piece of the user's text made fit for a one-line message. */
typedef struct scene_quote {
    char text[96];
} scene_quote;

/* A file's name for a message: its end where it is very long. */
typedef struct scene_name {
    char text[192];
} scene_name;

/* Where in a file: from 1, columns in characters. */
typedef struct scene_place {
    int line, column;
} scene_place;

/* Fills *error (NULL is allowed) with one line: control characters become '?', what is too long is cut at a whole
 * character. Always returns false, so that callers can `return scene_error_set(…)`. */
bool scene_error_set(scene_error *error, scene_error_kind kind, const char *format, ...) SCENE_FORMAT(3, 4);
bool scene_error_memory(scene_error *error);

/* Of a file that cannot be read. */
scene_error_kind scene_error_of_fault(regular_file_fault fault);

/* Copies text to `out` of `size` bytes as one line of whole UTF-8 characters: what is none, and what controls a terminal, becomes '?'. Returns how many bytes of the
 * text went in. */
size_t scene_copy_line(char *out, size_t size, const char *text, size_t length);

/* Control characters replaced, cut to about 60 characters with "..." where longer. */
scene_quote scene_quote_text(const char *text, size_t length);

scene_name scene_file_name(const char *path);

/* Whether the bytes are UTF-8 without control characters other than tab and line ends; *place is the
 * first bad one, or the end of the text. */
bool scene_text_is_clean(const char *text, size_t length, scene_place *place);

/* Writes a character in UTF-8, at most four bytes; returns the place behind it. */
char *scene_write_character(char *out, uint32_t code);

/* Number of single-character edits (insert, delete, replace, swap of neighbours) between two short words; words over
 * 63 bytes are infinitely far apart (SIZE_MAX). */
size_t scene_edit_distance(const char *word, size_t word_length, const char *known);

#endif
