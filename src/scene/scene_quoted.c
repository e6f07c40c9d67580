/* SPDX-License-Identifier: MIT
 *
 * The texts of quoted scalars of YAML. libfyaml 0.7, which finds the scalars, misreads such texts: docs/trust.md says which.
 */
#include "scene/scene_quoted.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "scene/scene_text.h"

static bool is_blank(char c) { return c == ' ' || c == '\t'; }
static bool is_break(char c) { return c == '\n' || c == '\r'; }

static uint32_t read_hex(const char *digits, ptrdiff_t count)
{
    uint32_t code = 0;
    for (ptrdiff_t i = 0; i < count; i++)
        code = code * 16 + (uint32_t)(digits[i] <= '9' ? digits[i] - '0' : (digits[i] | 0x20) - 'a' + 10);
    return code;
}

/* The character of the escape behind a backslash (YAML 1.2.2, 5.7); *at is moved behind it. */
static uint32_t read_escape(const char **at, const char *end)
{
    static const char names[] = "0abt\tnvfreN_LP";
    static const uint16_t codes[] = {0, 7, 8, 9, 9, 10, 11, 12, 13, 27, 0x85, 0xa0, 0x2028, 0x2029};
    const char name = *(*at)++;
    const char *found = memchr(names, name, sizeof names - 1);
    const ptrdiff_t digits = name == 'x' ? 2 : name == 'u' ? 4 : name == 'U' ? 8 : 0;
    if (digits == 0 || end - *at < digits)
        return found != NULL ? codes[found - names] : (unsigned char)name;
    uint32_t code = read_hex(*at, digits);
    *at += digits;
    if (code >= 0xd800 && code < 0xdc00 && end - *at >= 6) { /* half of a pair, as in JSON; the other follows as "\u" and four digits */
        code = 0x10000 + ((code - 0xd800) << 10) + (read_hex(*at + 2, 4) - 0xdc00);
        *at += 6;
    }
    return code;
}

size_t scene_unquote(const char *source, size_t length, char quote, char *out)
{
    const char *at = source, *const end = source + length;
    const char *const start = out, *escaped = out; /* blanks before it belong to escapes */
    while (at < end) {
        const bool escape = quote == '"' && *at == '\\';
        at += escape || *at == quote; /* a backslash, or the first of two quotes */
        if (!is_break(*at)) {
            if (escape)
                escaped = out = scene_write_character(out, read_escape(&at, end));
            else
                *out++ = *at++;
            continue;
        }
        /* Blanks around line ends are dropped, but not those before an escaped one. A line end is a space, or nothing if escaped; of more, all but the first are kept. */
        size_t breaks = 0;
        while (!escape && out > escaped && is_blank(out[-1]))
            out--;
        for (; at < end && (is_blank(*at) || is_break(*at)); at++)
            breaks += *at == '\n' || (*at == '\r' && (at + 1 == end || at[1] != '\n'));
        if (breaks == 1 && !escape)
            *out++ = ' ';
        for (; breaks > 1; breaks--)
            *out++ = '\n';
    }
    return (size_t)(out - start);
}
