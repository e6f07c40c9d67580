/* SPDX-License-Identifier: MIT
 *
 * One row a value: key, type, range, unit, meaning. Tables of such rows describe the options of quality, the scene format and the viewer's
 * settings; validation, command lines, files, hashes, the JSON Schema and the documentation walk them.
 */
#ifndef MANGATA_PARAMS_FIELD_H
#define MANGATA_PARAMS_FIELD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A number as a person would write it. */
typedef struct short_number {
    char text[64];
} short_number;

/* The fewest digits that read back as the same double (or the same float). */
short_number double_text(double value);
short_number float_text(float value);

/* A number of YAML's core schema and nothing beside it: decimal, 0x and 0o; infinities and NaN come out as NaN, which fails every range. */
bool number_read(const char *text, double *value);

typedef enum field_type {
    FIELD_COUNT,    /* uint32_t */
    FIELD_LARGE,    /* uint64_t */
    FIELD_NUMBER,   /* double */
    FIELD_FLOAT,    /* float */
    FIELD_VECTOR,   /* double[3] */
    FIELD_SCALE,    /* double[3]: one number for all, or three */
    FIELD_COLOR,    /* float[3] */
    FIELD_CHOICE,   /* int, one of `choices` by name */
    FIELD_SWITCH,   /* bool: false by the name choices[0], true by choices[1] */
    FIELD_EXPOSURE, /* scene_exposure: "auto" or a number */
    FIELD_TEXT,     /* char * */
    FIELD_MAPPING,  /* `fields` inside */
    FIELD_LIST      /* scene_list of mappings with `fields` inside */
} field_type;

typedef enum field_flags {
    FIELD_REQUIRED = 1,
    FIELD_OPEN_MIN = 2,  /* the minimum itself is not allowed */
    FIELD_OPEN_MAX = 4,  /* nor the maximum */
    FIELD_NO_PIXELS = 8, /* changes no pixel, or not as it stands: left out of the canonical text */
    FIELD_GIVEN = 16,    /* mapping: its struct begins with a bool, whether it stands in the file */
    FIELD_OR_ZERO = 32,  /* besides the range 0 is allowed, which stands for the default in `absent` */
    FIELD_NO_FLAG = 64,  /* an option whose flag on the command line, if there is one, is no plain value */
    FIELD_OBJECTS = 128, /* an option of scenes with objects */
    FIELD_SHORT = 256    /* mapping: a single value stands for its first key */
} field_flags;

/* A row counts only while another choice of the same struct is one of some. */
typedef struct field_condition {
    const char *key;  /* of the row of that choice; NULL: no condition */
    uint64_t choices; /* one bit each, by place in its `choices` */
    bool tolerated;   /* elsewhere the API ignores the row; else it refuses it */
} field_condition;

/* A newer name that is read as an older one; the older one is what is written. A list is ended by one without. */
typedef struct name_alias {
    const char *alias, *name;
} name_alias;

typedef struct field_row field_row;

/* Another form in which a list's items may be written: rows of a struct of its own, from which an item is made. */
typedef struct field_form {
    const field_row *fields; /* ended by one without a key; what has the key of one of the item's own rows means the same */
    size_t size;             /* of the struct, at most FORM_SIZE */
    void (*prepare)(void *values);
    void (*convert)(const void *values, void *item);
} field_form;

enum { FORM_SIZE = 64 };

struct field_row {
    const char *key;
    field_type type;
    size_t offset; /* in the parent's struct */
    unsigned flags;
    double min, max;
    const char *unit; /* NULL: none */
    const char *doc;
    const char *const *choices;  /* in the enum's order, NULL-terminated; read them by field_word() */
    size_t choice_stride;        /* bytes from one to the next, where they are members of rows; 0: none lie between */
    const int *values;           /* what each choice stands for; NULL: its place in `choices` */
    double preset;               /* options: the default */
    const char *alias;           /* newer key that is read like `key`, never with it; NULL: none. Not of required rows */
    const name_alias *aliases;   /* newer names of choices; NULL: none */
    const char *absent;          /* options: what 0 or nothing stands for, for the help; NULL: the preset says it */
    const char *member;          /* options: name in the API; NULL: the key */
    const char *label;           /* options: what help calls the value; NULL: by type */
    field_condition when[3];     /* all must hold */
    int alternative;             /* options: at most one of those with the same number is set; 0: none */
    const field_row *fields;     /* ended by one without a key */
    size_t item_size, max_items; /* list */
    const field_form *other;     /* list: another form of its items; NULL: none */
    /* After a key was read: sets what it decides of its neighbours, which are read later. */
    void (*decide)(void *parent);
    /* After a person chose another value: sets what it decides of its neighbours, and keeps the others. */
    void (*change)(void *parent);
    /* Before a list item is read: its defaults, from the struct that holds the list. */
    void (*prepare)(const void *parent, void *item);
};

/* The name that `word` is a newer one of; else `word`. NULL `aliases`: there are none. */
const char *name_first(const name_alias *aliases, const char *word);

/* "-90 to 90 degrees", "above 0 and below 179 degrees", "one of sun, moon", …: what a message allows. `out` is cut to size. */
void field_allowed(const field_row *field, char *out, size_t size);

bool field_in_range(const field_row *field, double value);

/* Reads a single number, choice or switch. False, with nothing written, where it is not allowed. */
bool field_parse(const field_row *field, const char *text, void *value);

/* Whether a value in memory is allowed. */
bool field_is_legal(const field_row *field, const void *value);

/* Compares structs row by row. They hold neither text nor lists. */
bool fields_equal(const field_row *fields, const void *a, const void *b);

/* The place of a choice or switch in `choices`; -1: it is none of them. */
int field_place(const field_row *field, const void *value);
void field_choose(const field_row *field, int place, void *value);

/* Bytes of a value that holds no other; 0 for the rest: text, lists, mappings, exposures. */
size_t field_size(const field_row *field);

/* A number, choice or switch as text that reads back as the same value: "30", "sun". Three numbers for a message: "[0, 4, 0]". */
short_number field_print(const field_row *field, const void *value);

/* Whether the conditions of a row hold; `tolerant`: those that are not tolerated. `fields`: the table that it belongs to. */
bool field_applies(const field_row *fields, const field_row *field, const void *parent, bool tolerant);

/* The conditions in words: "method podee-uniform or podee-pixel". Empty where there are none. */
void field_conditions(const field_row *fields, const field_row *field, char *out, size_t size);

/* What a row means, what stands in its place where it is not given, and its conditions, as one line. */
void field_meaning(const field_row *fields, const field_row *field, char *out, size_t size);

/* By key or alias; NULL: there is none. */
const field_row *field_find(const field_row *fields, const char *key, size_t length);
bool field_is_alias(const field_row *field, const char *key, size_t length);

/* The newer name of a choice by its place; NULL: it has none. */
const char *field_word_alias(const field_row *field, int place);

/* Writes the value of a field of numbers as JSON, which is YAML too: "30", "[0, 4, 0]". False for fields of other types. */
bool field_numbers_write(FILE *stream, const field_row *field, const void *value);

/* A choice's name by its place; NULL behind the last. */
static inline const char *field_word(const field_row *field, int place)
{
    return *(const char *const *)(const void *)((const char *)field->choices + (size_t)place * (field->choice_stride ? field->choice_stride : sizeof(char *)));
}
int field_word_count(const field_row *field);

static inline const void *field_at(const field_row *field, const void *parent) { return (const char *)parent + field->offset; }

#endif
