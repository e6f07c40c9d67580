/* SPDX-License-Identifier: MIT
 *
 * Texts for messages: safe quoting, checks of UTF-8, and the nearest known word.
 */
#ifndef MANGATA_SCENE_SCENE_TEXT_H
#define MANGATA_SCENE_SCENE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/regular_file.h"
#include "scene/scene_file.h"

#define SCENE_FORMAT(string, first) __attribute__((format(printf, string, first)))

/* A piece of the user's text, for a message of one line. */
typedef struct scene_quote {
    char text[96];
} scene_quote;

/* A file's name for a message. Of a very long name it is the end. */
typedef struct scene_name {
    char text[192];
} scene_name;

/* A place in a file. Both start at 1, and columns count characters. */
typedef struct scene_place {
    int line, column;
} scene_place;

/* Fills *error with one line. NULL is allowed. Control characters become '?', and a long text is cut behind a whole character. Returns false. */
bool scene_error_set(scene_error *error, scene_error_kind kind, const char *format, ...) SCENE_FORMAT(3, 4);
bool scene_error_memory(scene_error *error);

/* The kind of error for a file that cannot be read. */
scene_error_kind scene_error_of_fault(regular_file_fault fault);

/* Copies text to `out`, which has `size` bytes, as one line of whole UTF-8 characters. Bytes that are not UTF-8 and characters that control a terminal become
 * '?'. Returns the number of bytes of the text that were copied. */
size_t scene_copy_line(char *out, size_t size, const char *text, size_t length);

/* The text with control characters replaced, and cut to about 60 characters with "..." if it is longer. */
scene_quote scene_quote_text(const char *text, size_t length);

scene_name scene_file_name(const char *path);

/* Whether the bytes are UTF-8 without control characters other than tab and line ends. *place becomes the place of the first bad one, or the end of the
 * text. */
bool scene_text_is_clean(const char *text, size_t length, scene_place *place);

/* Writes a character in UTF-8, at most four bytes. Returns the pointer behind it. */
char *scene_write_character(char *out, uint32_t code);

/* Number of single-character edits (insert, delete, replace, swap of neighbours) between two words; SIZE_MAX: a word has more than 63 bytes. */
size_t scene_edit_distance(const char *word, size_t word_length, const char *known);

#endif
