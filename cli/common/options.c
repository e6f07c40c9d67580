/* SPDX-License-Identifier: MIT */
/* The table-driven reader of command lines. */
#include "cli/common/options.h"

#include <stdio.h>
#include <string.h>

#include "params/methods.h"
#include "params/options.h"

static const option common_options[] = {
    {"json", 0, NULL, "print the result as JSON on standard output"},
    {"verbose", 'v', NULL, "say more on standard error"},
    {"quiet", 'q', NULL, "say nothing but errors"},
    {"help", 'h', NULL, "show this help"},
};
enum { COMMON_COUNT = sizeof common_options / sizeof common_options[0] };
enum { COMMON_JSON, COMMON_VERBOSE, COMMON_QUIET, COMMON_HELP };

option_reader option_reader_start(const option_table *table, console *out, int count, char **arguments)
{
    return (option_reader){.table = table, .out = out, .arguments = arguments, .count = count};
}

/* The verb's own options, those of every verb, and those of quality. */
static size_t option_total(const option_table *table) { return table->count + COMMON_COUNT + (table->quality ? QUALITY_ROWS : 0); }

/* What the help calls a value of an option. */
static const char *value_word(const field_row *field, char *room, size_t size)
{
    if (field->label)
        return field->label;
    if (field->choices && field_word_count(field) == 2) {
        snprintf(room, size, "%s|%s", field_word(field, 0), field_word(field, 1));
        return room;
    }
    return field->choices ? "NAME" : field->type == FIELD_COUNT || field->type == FIELD_LARGE ? "N" : "X";
}

/* Its name may hold '_' in place of '-'. */
static option option_at(const option_table *table, size_t i)
{
    if (i < table->count)
        return table->options[i];
    if (i < table->count + COMMON_COUNT)
        return common_options[i - table->count];
    const field_row *field = &quality_fields[i - table->count - COMMON_COUNT];
    return (option){.name = field->flags & FIELD_NO_FLAG ? "" : field->key, .value = "VALUE"};
}

static const char *option_name_at(const void *table, size_t i) { return option_at(table, i).name; }

static bool is_named(const char *name, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (text[i] != name[i] && !(text[i] == '-' && name[i] == '_'))
            return false;
    return length > 0 && name[length] == 0;
}

static void print_option(const option *o)
{
    char left[80];
    char letter[8] = "    ";
    if (o->letter)
        snprintf(letter, sizeof letter, "-%c, ", o->letter);
    snprintf(left, sizeof left, "  %s--%s%s%s", letter, o->name, o->value ? " " : "", o->value ? o->value : "");
    enum { COLUMN = 32 };
    printf("%-*s", COLUMN, left);
    if (strlen(left) >= COLUMN)
        printf("\n%*s", COLUMN, "");
    for (const char *p = o->help; *p; p++) {
        putchar(*p);
        if (*p == '\n')
            printf("%*s", COLUMN, "");
    }
    putchar('\n');
}

/* The words of `text` in lines of at most 64 characters. */
static void wrap(const char *text, char *out)
{
    enum { WIDTH = 64 };
    size_t column = 0;
    while (*text) {
        const size_t length = strcspn(text, " ");
        if (column > 0)
            *out++ = column + 1 + length > WIDTH ? '\n' : ' ';
        column = column + 1 + length > WIDTH ? length : column + (column > 0) + length;
        memcpy(out, text, length);
        out += length;
        text += length + strspn(text + length, " ");
    }
    *out = 0;
}

static void print_quality(void)
{
    printf("\noptions of quality, which are also keys of a scene's quality:\n");
    for (const field_row *field = quality_fields; field->key; field++) {
        char room[64], allowed[160], when[160], text[640], lines[640];
        if (field->flags & FIELD_NO_FLAG)
            continue;
        field_allowed(field, allowed, sizeof allowed);
        field_conditions(quality_fields, field, when, sizeof when);
        const mgt_quality defaults = quality_defaults();
        const short_number preset = field_print(field, field_at(field, &defaults));
        snprintf(text, sizeof text, "%s: %s (default %s%s%s)", field->doc, allowed, field->absent ? field->absent : preset.text, when[0] ? "; for " : "", when);
        wrap(text, lines);
        print_option(&(option){.name = option_flag_of(field).text + 2, .value = value_word(field, room, sizeof room), .help = lines});
    }
}

static void print_methods(void)
{
    printf("\nmethods:\n");
    for (size_t i = 0; i < method_count; i++) {
        const method_row *row = method_of((mgt_method)i);
        char name[32];
        snprintf(name, sizeof name, "%s%s", row->properties.name, row->numbered ? "N" : "");
        printf("  %-15s %s\n", name, row->properties.description);
    }
}

static void print_help(const option_table *table)
{
    printf("usage: mangata %s %s\n\n%s\n\noptions:\n", table->verb, table->usage, table->summary);
    for (size_t i = 0; i < table->count + COMMON_COUNT; i++) {
        const option o = option_at(table, i);
        print_option(&o);
    }
    if (table->quality)
        print_quality();
    for (size_t i = 0; i < table->count; i++)
        if (table->options[i].value && strcmp(table->options[i].value, OPTION_VALUE_METHOD) == 0)
            print_methods();
    if (table->notes)
        printf("\n%s\n", table->notes);
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Levenshtein's distance; long names count as far. */
static size_t edit_distance(const char *a, const char *b)
{
    enum { LIMIT = 32 };
    const size_t length = strlen(b);
    size_t row[LIMIT + 1];
    if (length > LIMIT || strlen(a) > LIMIT)
        return LIMIT;
    for (size_t j = 0; j <= length; j++)
        row[j] = j;
    for (size_t i = 1; a[i - 1]; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= length; j++) {
            const size_t above = row[j];
            row[j] = least(least(above, row[j - 1]) + 1, diagonal + (a[i - 1] != b[j - 1]));
            diagonal = above;
        }
    }
    return row[length];
}

const char *nearest_name(const char *text, const void *names, size_t count, const char *(*name_at)(const void *, size_t))
{
    const char *best = NULL;
    size_t best_distance = 3;
    for (size_t i = 0; i < count; i++) {
        const char *name = name_at(names, i);
        const size_t distance = edit_distance(text, name);
        if (distance < best_distance && distance < strlen(name))
            best = name, best_distance = distance;
    }
    return best;
}

static int unknown_option(const option_reader *reader, const char *text)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)least(strcspn(text, "="), sizeof name - 1), text);
    const char *dashes = strncmp(name, "--", 2) == 0 ? name + 2 : name + 1;
    const char *near = nearest_name(dashes, reader->table, option_total(reader->table), option_name_at);
    if (near)
        console_error(0, "unknown option %s; did you mean --%s?", name, near);
    else
        console_error(0, "unknown option %s; see mangata %s --help", name, reader->table->verb);
    return OPTION_ERROR;
}

/* Common options act here and read on. */
static int found(option_reader *reader, size_t index, const char **value)
{
    if (index < reader->table->count)
        return (int)index;
    if (index >= reader->table->count + COMMON_COUNT)
        return OPTION_QUALITY + (int)(index - reader->table->count - COMMON_COUNT);
    switch (index - reader->table->count) {
    case COMMON_JSON:
        reader->out->json = true;
        break;
    case COMMON_VERBOSE:
        reader->out->verbose = true;
        break;
    case COMMON_QUIET:
        reader->out->quiet = true;
        break;
    default:
        print_help(reader->table);
        return OPTION_HELP;
    }
    return option_reader_next(reader, value);
}

static int take_value(option_reader *reader, const option *o, size_t index, const char *attached, const char **value)
{
    if (!o->value && attached) {
        console_error(0, "--%s takes no value", o->name);
        return OPTION_ERROR;
    }
    if (o->value && !attached && reader->next >= reader->count) {
        console_error(0, "--%s needs a value: %s", o->name, o->value);
        return OPTION_ERROR;
    }
    *value = !o->value ? NULL : attached ? attached : reader->arguments[reader->next++];
    return found(reader, index, value);
}

int option_reader_next(option_reader *reader, const char **value)
{
    if (reader->next >= reader->count)
        return OPTION_END;
    const char *text = reader->arguments[reader->next++];
    const size_t total = option_total(reader->table);
    if (reader->operands_only || text[0] != '-' || text[1] == 0) {
        *value = text;
        return OPTION_OPERAND;
    }
    if (strcmp(text, "--") == 0) {
        reader->operands_only = true;
        return option_reader_next(reader, value);
    }
    if (text[1] != '-') {
        for (size_t i = 0; i < total; i++) {
            const option o = option_at(reader->table, i);
            if (o.letter && o.letter == text[1])
                return take_value(reader, &o, i, text[2] ? text + 2 : NULL, value);
        }
        return unknown_option(reader, text);
    }
    const size_t length = strcspn(text + 2, "=");
    for (size_t i = 0; i < total; i++) {
        const option o = option_at(reader->table, i);
        if (is_named(o.name, text + 2, length))
            return take_value(reader, &o, i, text[2 + length] ? text + 3 + length : NULL, value);
    }
    return unknown_option(reader, text);
}
