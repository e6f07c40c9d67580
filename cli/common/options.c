/* SPDX-License-Identifier: MIT */
/* The table-driven reader of command lines. */
#include "cli/common/options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/frames.h"
#include "cli/common/numbers.h"
#include "cli/common/progress.h"
#include "cli/common/quality_options.h"
#include "params/methods.h"
#include "params/options.h"
#include "scene/scene_text.h"

static const option common_options[] = {
    {"json", 0, NULL, .help = "print the result as JSON on standard output"},
    {"verbose", 'v', NULL, .help = "say more on standard error"},
    {"quiet", 'q', NULL, .help = "say nothing but errors"},
    {"help", 'h', NULL, .help = "show this help"},
};
enum { COMMON_COUNT = sizeof common_options / sizeof common_options[0] };
enum { COMMON_JSON, COMMON_VERBOSE, COMMON_QUIET, COMMON_HELP };

/* ---- functions for options ---- */

int option_wrong(const option *o, const char *value, const char *allowed)
{
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is %s", o->name, value, allowed);
}

int option_given(const option *o, void *place, const char *value)
{
    (void)o, (void)value;
    *(bool *)place = true;
    return EXIT_CODE_OK;
}

int option_text(const option *o, void *place, const char *value)
{
    (void)o;
    *(const char **)place = value;
    return EXIT_CODE_OK;
}

int option_number(const option *o, void *place, const char *value)
{
    uint64_t number;
    if (!number_parse_u64(value, o->most, &number) || number < o->least)
        return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is a number from %llu to %llu", o->name, value, (unsigned long long)o->least,
                             (unsigned long long)o->most);
    *(uint64_t *)place = number;
    return EXIT_CODE_OK;
}

int option_samples(const option *o, void *place, const char *value)
{
    char wrong[240];
    return quality_count_read(o->name, value, place, wrong, sizeof wrong) ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "%s", wrong);
}

int option_frames(const option *o, void *place, const char *value)
{
    const char *wrong = frame_list_parse(place, value);
    return wrong ? console_error(EXIT_CODE_USAGE, "--%s %s: %s", o->name, value, wrong) : EXIT_CODE_OK;
}

int option_change(const option *o, void *place, const char *value)
{
    scene_changes *changes = place;
    (void)o;
    changes->items[changes->count++] = value;
    return EXIT_CODE_OK;
}

int option_size(const option *o, void *place, const char *value)
{
    scene_changes *changes = place;
    uint64_t side[2];
    if (!number_parse_list(value, 'x', MGT_MAX_IMAGE_SIDE, 2, side) || side[0] < o->least || side[1] < o->least)
        return option_wrong(o, value, o->allowed);
    if (side[0] * side[1] > (uint64_t)SCENE_PIXELS_MOST)
        return console_error(EXIT_CODE_USAGE, "--%s %s: allowed are %u pixels in all", o->name, value, (unsigned)SCENE_PIXELS_MOST);
    changes->width = (uint32_t)side[0];
    changes->height = (uint32_t)side[1];
    return EXIT_CODE_OK;
}

int option_quality(const option *o, void *place, const char *value)
{
    char wrong[600];
    bool known;
    return quality_option_set(place, o->name, strlen(o->name), value, &known, wrong, sizeof wrong) ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "%s", wrong);
}

int option_progress(const option *o, void *place, const char *value)
{
    return progress_mode_from_name(value, place) ? EXIT_CODE_OK : option_wrong(o, value, PROGRESS_MODES);
}

int option_shard(const option *o, void *place, const char *value)
{
    work_shard *shard = place;
    uint64_t parts[2];
    if (!number_parse_list(value, '/', SHARD_LIMIT, 2, parts) || parts[0] >= parts[1])
        return option_wrong(o, value, "I/N, the shard I of 0 ... N-1, N from 1 to 1000000, such as 0/8");
    *shard = (work_shard){(uint32_t)parts[0], (uint32_t)parts[1]};
    return EXIT_CODE_OK;
}

int option_one_scene(const option *o, void *place, const char *value)
{
    const char **path = place;
    (void)o;
    if (*path)
        return console_error(EXIT_CODE_USAGE, "one scene at a time: %s and %s are given", *path, value);
    *path = value;
    return EXIT_CODE_OK;
}

void scene_changes_free(scene_changes *changes)
{
    for (size_t i = 0; i < changes->operand_count; i++)
        free(changes->operands[i]);
    free(changes->operands);
    free(changes->items);
    *changes = (scene_changes){0};
}

/* ---- the help ---- */

/* Number of the verb's own options, those of every verb, those of quality, and the aliases of the latter. */
static size_t option_total(const option_table *table) { return table->count + COMMON_COUNT + (table->quality ? 2 * QUALITY_ROWS : 0); }

/* Name in the help of the value of an option of quality. */
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

/* Option i of all options of a verb. Its name may have '_' instead of '-'. Its name is "" if it cannot be given. */
static option option_at(const option_table *table, size_t i)
{
    if (i < table->count)
        return table->options[i];
    if (i < table->count + COMMON_COUNT)
        return common_options[i - table->count];
    const size_t place = i - table->count - COMMON_COUNT;
    const field_row *field = &quality_fields[place % QUALITY_ROWS];
    const char *name = place < QUALITY_ROWS ? field->key : field->alias;
    return (option){.name = field->flags & FIELD_NO_FLAG || !name ? "" : name, .value = "VALUE"};
}

static const char *option_name_at(const void *table, size_t i) { return option_at(table, i).name; }

/* Whether the first `length` characters of `text` are `name`, with '-' for '_'. */
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

/* Writes the words of `text` to `out` in lines of at most 64 characters. */
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
        snprintf(text, sizeof text, "%s: %s (default %s%s%s)%s%s", field->doc, allowed, field->absent ? field->absent : preset.text, when[0] ? "; for " : "",
                 when, field->alias ? "; also called " : "", field->alias ? option_flag_alias(field).text : "");
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

const char *nearest_name(const char *text, const void *names, size_t count, const char *(*name_at)(const void *, size_t))
{
    const char *best = NULL;
    size_t best_distance = 3;
    for (size_t i = 0; i < count; i++) {
        const char *name = name_at(names, i);
        const size_t distance = scene_edit_distance(text, strlen(text), name);
        if (distance < best_distance && distance < strlen(name))
            best = name, best_distance = distance;
    }
    return best;
}

/* ---- the command line ---- */

typedef struct option_reader {
    const option_table *table;
    void *request;
    char **arguments;
    int count, next;
} option_reader;

static int unknown_option(const option_reader *reader, const char *text)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)least(strcspn(text, "="), sizeof name - 1), text);
    const char *dashes = strncmp(name, "--", 2) == 0 ? name + 2 : name + 1;
    const char *near = nearest_name(dashes, reader->table, option_total(reader->table), option_name_at);
    if (near)
        return console_error(EXIT_CODE_USAGE, "unknown option %s; did you mean --%s?", name, near);
    return console_error(EXIT_CODE_USAGE, "unknown option %s; see mangata %s --help", name, reader->table->verb);
}

/* Hands "--name value" as one word to the operand. */
static int take_operand(const option_reader *reader, const option *o, const char *value)
{
    const option *operand = &reader->table->operand;
    scene_changes *changes = (scene_changes *)((char *)reader->request + reader->table->changes);
    char **list = realloc(changes->operands, (changes->operand_count + 1) * sizeof *list);
    if (!list)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    changes->operands = list;
    const size_t size = strlen(o->name) + strlen(value) + 4;
    char *text = list[changes->operand_count] = malloc(size);
    if (!text)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    changes->operand_count++;
    snprintf(text, size, "--%s %s", o->name, value);
    return operand->set(operand, (char *)reader->request + operand->offset, text);
}

static int act(const option_reader *reader, size_t index, const option *o, const char *value)
{
    console *out = reader->request;
    if (index < reader->table->count && o->operand)
        return take_operand(reader, o, value);
    if (index < reader->table->count)
        return o->set(o, (char *)reader->request + o->offset, value);
    switch (index - reader->table->count) {
    case COMMON_JSON:
        out->json = true;
        return EXIT_CODE_OK;
    case COMMON_VERBOSE:
        out->verbose = true;
        return EXIT_CODE_OK;
    case COMMON_QUIET:
        out->quiet = true;
        return EXIT_CODE_OK;
    case COMMON_HELP:
        print_help(reader->table);
        return OPTIONS_HELP;
    default:
        return option_quality(o, (char *)reader->request + reader->table->quality, value);
    }
}

/* `letter`: the option was given by its letter, behind which the value may stand without a blank. */
static int take_value(option_reader *reader, const option *o, size_t index, bool letter, const char *attached)
{
    if (!o->value && attached)
        return console_error(EXIT_CODE_USAGE, "--%s takes no value", o->name);
    if (letter && o->value && attached && *attached == '=')
        return console_error(EXIT_CODE_USAGE, "-%c%s: allowed is -%c %s or --%s=%s", o->letter, attached, o->letter, o->value, o->name, o->value);
    if (o->value && !attached && reader->next >= reader->count)
        return console_error(EXIT_CODE_USAGE, "--%s needs a value: %s", o->name, o->value);
    return act(reader, index, o, !o->value || attached ? attached : reader->arguments[reader->next++]);
}

static int read_option(option_reader *reader, const char *text)
{
    const bool letter = text[1] != '-';
    const size_t length = letter ? 0 : strcspn(text + 2, "="), end = 2 + length;
    for (size_t i = 0; i < option_total(reader->table); i++) {
        const option o = option_at(reader->table, i);
        if (letter ? o.letter == text[1] : is_named(o.name, text + 2, length))
            return take_value(reader, i < reader->table->count ? &reader->table->options[i] : &o, i, letter, !text[end] ? NULL : text + end + !letter);
    }
    return unknown_option(reader, text);
}

int options_read(const option_table *table, void *request, int count, char **arguments)
{
    option_reader reader = {.table = table, .request = request, .arguments = arguments, .count = count};
    scene_changes *changes = table->changes ? (scene_changes *)((char *)request + table->changes) : NULL;
    bool operands_only = false;
    int code = EXIT_CODE_OK;
    /* Each --set takes at least one word of the command line. Two more items hold the size. */
    if (changes && !(changes->items = calloc((size_t)count + 2, sizeof *changes->items)))
        return console_error(EXIT_CODE_FAILED, "out of memory");
    while (code == EXIT_CODE_OK && reader.next < count) {
        const char *text = arguments[reader.next++];
        if (operands_only || text[0] != '-' || text[1] == 0)
            code = table->operand.set(&table->operand, (char *)request + table->operand.offset, text);
        else if (strcmp(text, "--") == 0)
            operands_only = true;
        else
            code = read_option(&reader, text);
    }
    if (changes && changes->width) {
        snprintf(changes->size[0], sizeof changes->size[0], "image.width=%u", (unsigned)changes->width);
        snprintf(changes->size[1], sizeof changes->size[1], "image.height=%u", (unsigned)changes->height);
        for (int i = 0; i < 2; i++)
            changes->items[changes->count++] = changes->size[i];
    }
    return code;
}

int options_run(const option_table *table, void *request, int count, char **arguments)
{
    int code = options_read(table, request, count, arguments);
    if (code == EXIT_CODE_OK)
        code = table->run(request);
    if (table->changes)
        scene_changes_free((scene_changes *)((char *)request + table->changes));
    return code == OPTIONS_HELP ? EXIT_CODE_OK : code;
}
