/* SPDX-License-Identifier: MIT
 * The texts of kernels and passes, and how they become one GLSL source. */
#include "gl/gl_sources.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- texts ---- */

/* The name in gl_texts that equals the `length` characters at `name`. NULL: no such text is embedded. */
static const char *embedded(const char *name, size_t length)
{
    for (size_t i = 0; i < gl_text_count; i++)
        if (strlen(gl_texts[i].name) == length && memcmp(gl_texts[i].name, name, length) == 0)
            return gl_texts[i].name;
    return NULL;
}

const char *mgt_gl_source_name(size_t index) { return index < gl_text_count ? gl_texts[index].name : NULL; }

bool gl_text_exists(const char *name) { return embedded(name, strlen(name)) != NULL; }

/* The text of that name: the replacement, if there is one. NULL: there is no such text. */
static const char *text_of(const gl_replacements *replaced, const char *name)
{
    for (size_t i = 0; i < replaced->count; i++)
        if (strcmp(replaced->texts[i].name, name) == 0)
            return replaced->texts[i].text;
    for (size_t i = 0; i < gl_text_count; i++)
        if (strcmp(gl_texts[i].name, name) == 0)
            return gl_texts[i].text;
    return NULL;
}

bool gl_replacements_copy(gl_replacements *out, const mgt_gl_source *sources, size_t count)
{
    *out = (gl_replacements){0};
    size_t size = count * sizeof *out->texts;
    for (size_t i = 0; i < count; i++)
        size += strlen(sources[i].text) + 1;
    if (count == 0)
        return true;
    out->texts = malloc(size);
    if (!out->texts)
        return false;
    char *at = (char *)(out->texts + count);
    for (size_t i = 0; i < count; i++) {
        const size_t bytes = strlen(sources[i].text) + 1;
        out->texts[i] = (gl_text){embedded(sources[i].name, strlen(sources[i].name)), at};
        memcpy(at, sources[i].text, bytes);
        at += bytes;
    }
    out->count = count;
    return true;
}

void gl_replacements_free(gl_replacements *r)
{
    free(r->texts);
    *r = (gl_replacements){0};
}

/* ---- assembly ---- */

/* Appends `length` characters, unless memory has run out. */
static void append(gl_source *s, const char *text, size_t length)
{
    if (s->out_of_memory)
        return;
    if (s->length + length + 1 > s->capacity) {
        const size_t capacity = 2 * (s->capacity + length) + 4096;
        char *grown = realloc(s->text, capacity);
        if (!grown) {
            s->out_of_memory = true;
            return;
        }
        s->text = grown;
        s->capacity = capacity;
    }
    memcpy(s->text + s->length, text, length);
    s->length += length;
    s->text[s->length] = 0;
}

/* Appends a #line directive: the next line is number `line` of file number `file`. */
static void append_line_mark(gl_source *s, int line, int file)
{
    char mark[48];
    append(s, mark, (size_t)snprintf(mark, sizeof mark, "#line %d %d\n", line, file));
}

/* The file's name in an #include line, without its folders. NULL: the line is another one. */
static const char *included(const char *line, size_t length, size_t *name_length)
{
    static const char word[] = "#include \"";
    if (length < sizeof word || memcmp(line, word, sizeof word - 1) != 0)
        return NULL;
    const char *name = line + sizeof word - 1, *end = memchr(name, '"', (size_t)(line + length - name));
    for (const char *at = name; end && at < end; at++)
        if (*at == '/')
            name = at + 1;
    *name_length = end ? (size_t)(end - name) : 0;
    return end ? name : NULL;
}

/* Appends a text, with the texts that it includes in place of its #include lines. Does nothing if the text has been appended before. */
static void append_file(gl_source *s, const gl_replacements *replaced, const char *name)
{
    for (int i = 1; i < s->file_count; i++)
        if (strcmp(s->files[i], name) == 0)
            return;
    const char *at = text_of(replaced, name);
    if (!at || s->file_count == MAX_FILES) {
        s->missing = name;
        return;
    }
    const int id = s->file_count++;
    s->files[id] = name;
    append_line_mark(s, 1, id);
    for (int line = 1; *at && !s->missing; line++) {
        const char *end = strchr(at, '\n');
        const size_t length = end ? (size_t)(end - at) : strlen(at);
        size_t name_length = 0;
        const char *inner = included(at, length, &name_length);
        if (inner) {
            static const char method[] = "method.k";
            const bool is_method = s->kernel && name_length == sizeof method - 1 && memcmp(inner, method, name_length) == 0;
            const char *known = is_method ? embedded(s->kernel, strlen(s->kernel)) : embedded(inner, name_length);
            if (known) {
                append_file(s, replaced, known);
                append_line_mark(s, line + 1, id);
            } else {
                s->missing = name;
            }
        } else {
            if (length < 12 || memcmp(at, "#pragma once", 12) != 0)
                append(s, at, length);
            append(s, "\n", 1);
        }
        at = end ? end + 1 : at + length;
    }
}

bool gl_source_assemble(gl_source *out, const gl_replacements *replaced, const char *main, const char *kernel, const char *defines)
{
    static const char version[] = "#version 450 core\n";
    *out = (gl_source){.file_count = 1, .files = {"defines"}, .kernel = kernel};
    append(out, version, sizeof version - 1);
    append(out, defines, strlen(defines));
    append_file(out, replaced, main);
    return !out->missing && !out->out_of_memory;
}

void gl_source_free(gl_source *s)
{
    free(s->text);
    *s = (gl_source){0};
}

uint64_t gl_source_hash(const gl_source *s)
{
    uint64_t hash = 0xcbf29ce484222325u; /* FNV-1a */
    for (size_t i = 0; i < s->length; i++)
        hash = (hash ^ (unsigned char)s->text[i]) * 0x100000001b3u;
    return hash;
}

/* ---- messages ---- */

/* Reads the file number, the line number and the message `rest` of a line in one of the forms that gl_source_explain() knows. False: it has another form. */
static bool parse_place(const char *line, int *file, int *number, const char **rest)
{
    static const char *const starts[] = {"ERROR: ", "error: "};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++)
        if (strncmp(line, starts[i], strlen(starts[i])) == 0)
            line += strlen(starts[i]);
    int used = 0;
    if (sscanf(line, "%d(%d)%n", file, number, &used) != 2) {
        used = 0;
        if (sscanf(line, "%d:%d%n", file, number, &used) != 2)
            return false;
        int column = 0, more = 0;
        if (sscanf(line + used, "(%d)%n", &column, &more) == 1)
            used += more;
    }
    line += used;
    line += strspn(line, " :");
    *rest = line;
    return true;
}

void gl_source_explain(const gl_source *s, const char *log, char *out, size_t size)
{
    const char *chosen = log;
    for (const char *line = log; *line;) {
        const size_t length = strcspn(line, "\n");
        int file, number;
        const char *rest;
        if (parse_place(line, &file, &number, &rest) && !strstr(rest, "warning") && file >= 0 && file < s->file_count) {
            const size_t left = (size_t)(line + length - rest);
            snprintf(out, size, "%s:%d: %.*s", s->files[file], number, (int)left, rest);
            return;
        }
        line += length + (line[length] != 0);
    }
    snprintf(out, size, "%.*s", (int)strcspn(chosen, "\n"), chosen);
}
