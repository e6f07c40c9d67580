/* SPDX-License-Identifier: MIT
 *
 * Texts for messages: safe quoting, checks of UTF-8, and the nearest known word.
 */
#include "scene/scene_text.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUOTE_BYTES = 60, LONGEST_WORD = 63 };

/* Length of the well-formed UTF-8 character at the start of `text`, 0 where there is none (RFC 3629). */
static size_t character_length(const unsigned char *text, size_t length)
{
    if (length == 0)
        return 0;
    unsigned char lead = text[0];
    if (lead < 0x80)
        return 1;
    size_t count = lead >= 0xc2 && lead < 0xe0 ? 2 : lead >= 0xe0 && lead < 0xf0 ? 3 : lead >= 0xf0 && lead < 0xf5 ? 4 : 0;
    if (count == 0 || count > length)
        return 0;
    for (size_t i = 1; i < count; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (lead == 0xe0 && text[1] < 0xa0) || (lead == 0xf0 && text[1] < 0x90);
    bool surrogate = lead == 0xed && text[1] >= 0xa0;
    bool beyond = lead == 0xf4 && text[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : count;
}

/* Controls of three bytes that reorder what a terminal shows (U+200E, U+200F, U+202A … U+202E, U+2066 … U+2069), or end a line (U+2028, U+2029). */
static bool is_hidden(const unsigned char *text)
{
    if (text[0] != 0xe2 || (text[1] != 0x80 && text[1] != 0x81))
        return false;
    return text[1] == 0x80 ? (text[2] >= 0x8e && text[2] <= 0x8f) || (text[2] >= 0xa8 && text[2] <= 0xae) : text[2] >= 0xa6 && text[2] <= 0xa9;
}

size_t scene_copy_line(char *out, size_t size, const char *text, size_t length)
{
    size_t used = 0, at = 0;
    while (at < length) {
        size_t count = character_length((const unsigned char *)text + at, length - at);
        bool bad = count == 0 || (count == 1 && ((unsigned char)text[at] < 0x20 || text[at] == 0x7f));
        /* U+0080 … U+009F are control characters too */
        bad |= count == 2 && (unsigned char)text[at] == 0xc2 && (unsigned char)text[at + 1] < 0xa0;
        bad |= count == 3 && is_hidden((const unsigned char *)text + at);
        size_t written = bad ? 1 : count;
        if (used + written >= size)
            break;
        if (bad)
            out[used] = '?';
        else
            memcpy(out + used, text + at, count);
        used += written;
        at += count == 0 ? 1 : count;
    }
    out[used] = '\0';
    return at;
}

bool scene_error_set(scene_error *error, scene_error_kind kind, const char *format, ...)
{
    if (error == NULL)
        return false;
    char line[2 * sizeof error->text];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    error->kind = kind;
    scene_copy_line(error->text, sizeof error->text, line, length < 0 ? 0 : strlen(line));
    return false;
}

bool scene_error_memory(scene_error *error) { return scene_error_set(error, SCENE_ERROR_MEMORY, "out of memory while reading the scene"); }

scene_error_kind scene_error_of_fault(regular_file_fault fault)
{
    switch (fault) {
    case REGULAR_FILE_MEMORY:
        return SCENE_ERROR_MEMORY;
    case REGULAR_FILE_LARGE:
        return SCENE_ERROR_BAD_SCENE;
    default:
        return SCENE_ERROR_MISSING_INPUT;
    }
}

scene_quote scene_quote_text(const char *text, size_t length)
{
    scene_quote quote;
    size_t taken = scene_copy_line(quote.text, QUOTE_BYTES + 1, text, length);
    if (taken < length)
        strcat(quote.text, "...");
    return quote;
}

scene_name scene_file_name(const char *path)
{
    scene_name name = {""};
    const size_t room = sizeof name.text - 4;
    size_t length = strlen(path);
    if (length > room) {
        path += length - room;
        while (((unsigned char)*path & 0xc0) == 0x80) /* to the start of a character */
            path++;
        strcpy(name.text, "...");
    }
    size_t used = strlen(name.text);
    scene_copy_line(name.text + used, sizeof name.text - used, path, strlen(path));
    return name;
}

bool scene_text_is_clean(const char *text, size_t length, scene_place *place)
{
    scene_place here = {1, 1};
    size_t at = 0;
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        at = 3;
    while (at < length) {
        unsigned char lead = (unsigned char)text[at];
        size_t count = character_length((const unsigned char *)text + at, length - at);
        bool space = lead == '\t' || lead == '\n' || lead == '\r';
        if (count == 0 || lead == 0x7f || (lead < 0x20 && !space)) {
            *place = here;
            return false;
        }
        at += count;
        here.column++;
        if (lead == '\n' || (lead == '\r' && (at == length || text[at] != '\n')))
            here = (scene_place){here.line + 1, 1};
    }
    *place = here;
    return true;
}

char *scene_write_character(char *out, uint32_t code)
{
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3; /* bytes behind the first */
    static const uint8_t leads[] = {0, 0xc0, 0xe0, 0xf0};
    *out++ = (char)(leads[more] | code >> 6 * more);
    for (int i = more - 1; i >= 0; i--)
        *out++ = (char)(0x80 | (code >> 6 * i & 0x3f));
    return out;
}

size_t scene_edit_distance(const char *word, size_t word_length, const char *known)
{
    size_t known_length = strlen(known);
    if (word_length > LONGEST_WORD || known_length > LONGEST_WORD)
        return SIZE_MAX;
    size_t rows[3][LONGEST_WORD + 1];
    for (size_t j = 0; j <= known_length; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= word_length; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        row[0] = i;
        for (size_t j = 1; j <= known_length; j++) {
            size_t best = above[j - 1] + (word[i - 1] != known[j - 1]);
            best = above[j] + 1 < best ? above[j] + 1 : best;
            best = row[j - 1] + 1 < best ? row[j - 1] + 1 : best;
            bool swapped = i > 1 && j > 1 && word[i - 1] == known[j - 2] && word[i - 2] == known[j - 1];
            if (swapped && two_above[j - 2] + 1 < best)
                best = two_above[j - 2] + 1;
            row[j] = best;
        }
    }
    return rows[word_length % 3][known_length];
}
