/* SPDX-License-Identifier: MIT
 *
 * A row describes one value: key, type, range, unit, and meaning. Tables of rows describe the options of quality, the scene format, and the viewer's settings.
 * Validation, command lines, files, hashes, the JSON Schema and the documentation read them.
 */
#ifndef MANGATA_PARAMS_FIELD_H
#define MANGATA_PARAMS_FIELD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A number as text. */
typedef struct short_number {
    char text[64];
} short_number;

/* A double with so few digits that it reads back as the same value. */
short_number double_text(double value);
/* As double_text(), for a float. */
short_number float_text(float value);

/* Reads a number of YAML's core schema: decimal, 0x or 0o. Infinities and NaN are read as NaN, which no range includes. False: the text is no number. */
bool number_read(const char *text, double *value);

typedef enum field_type {
    FIELD_COUNT,    /* uint32_t */
    FIELD_LARGE,    /* uint64_t */
    FIELD_NUMBER,   /* double */
    FIELD_FLOAT,    /* float */
    FIELD_VECTOR,   /* double[3] */
    FIELD_SCALE,    /* double[3]: one number for all components, or three */
    FIELD_COLOR,    /* float[3] */
    FIELD_CHOICE,   /* int, one of `choices` by name */
    FIELD_SWITCH,   /* bool: choices[0] names false, choices[1] true */
    FIELD_EXPOSURE, /* scene_exposure: "auto" or a number */
    FIELD_TEXT,     /* char * */
    FIELD_MAPPING,  /* a struct with the rows `fields` */
    FIELD_LIST      /* scene_list of structs with the rows `fields` */
} field_type;

typedef enum field_flags {
    FIELD_REQUIRED = 1,
    FIELD_OPEN_MIN = 2,  /* the minimum itself is not allowed */
    FIELD_OPEN_MAX = 4,  /* the maximum itself is not allowed */
    FIELD_NO_PIXELS = 8, /* the canonical text leaves the value out, because it changes no pixel by itself */
    FIELD_GIVEN = 16,    /* mapping: its struct begins with a bool that tells whether the file has the mapping */
    FIELD_OR_ZERO = 32,  /* 0 is allowed besides the range, and stands for the default in `absent` */
    FIELD_NO_FLAG = 64,  /* option: its flag on the command line, if there is one, does not take the value as such */
    FIELD_OBJECTS = 128, /* option: it is for scenes with objects */
    FIELD_SHORT = 256    /* mapping: a single value stands for its first key */
} field_flags;

/* The condition that a row applies only if another row of the same struct has one of some choices. */
typedef struct field_condition {
    const char *key;  /* key of the other row; NULL: no condition */
    uint64_t choices; /* bit i: place i in the other row's `choices` */
    bool tolerated;   /* true: if the condition fails, the API ignores the value; false: the API refuses it */
} field_condition;

/* A newer name that is read like an older one. The older name is written. Lists end with an element without names. */
typedef struct name_alias {
    const char *alias, *name;
} name_alias;

/* Other texts than its choices that a choice may be written as. They decide of its neighbours, too: field_row.decide is not called after them. */
typedef struct field_spelling {
    const char *words;   /* for messages: "ssaaN (N from 1 to 1024)" */
    const char *pattern; /* the same as a regular expression, for the schema */
    /* Reads these and the choices into the parent's struct. False, with nothing written, where the text is none of them. */
    bool (*read)(const char *text, void *parent);
} field_spelling;

typedef struct field_row field_row;

/* Another form in which a list's items may be written: a struct with rows of its own, from which an item is made. */
typedef struct field_form {
    const field_row *fields; /* rows of the struct, the last one without a key; keys of the item's own rows have the same meaning here */
    size_t size;             /* size of the struct, at most FORM_SIZE */
    void (*prepare)(void *values);
    void (*convert)(const void *values, void *item);
} field_form;

enum { FORM_SIZE = 64 };

struct field_row {
    const char *key;
    field_type type;
    size_t offset; /* offset of the value in its struct */
    unsigned flags;
    double min, max;
    const char *unit; /* NULL: none */
    const char *doc;
    const char *const *choices;  /* names in the enum's order, NULL-terminated; read by field_word() */
    size_t choice_stride;        /* bytes from name to name if they are members of structs; 0: the names are an array */
    const int *values;           /* value of each choice; NULL: its place in `choices` */
    double preset;               /* options: the default */
    const char *alias;           /* newer key that is read like `key`; a file may have one of both; NULL: none. Required rows have none */
    const name_alias *aliases;   /* newer names of choices; NULL: none */
    const field_spelling *also;  /* choices: other texts that are read; NULL: none */
    const char *absent;          /* options: text of the default for the help; NULL: it is `preset` */
    const char *member;          /* options: name in the API; NULL: the key */
    const char *label;           /* options: name of the value in the help; NULL: by type */
    field_condition when[3];     /* conditions, all of which must hold */
    int alternative;             /* options: at most one option of the same number may be set; 0: there is no such restriction */
    const field_row *fields;     /* mapping and list: rows, the last one without a key */
    size_t item_size, max_items; /* list: size of an item, and largest number of items */
    const field_form *other;     /* list: another form of its items; NULL: none */
    /* Called after a key was read: sets the values of other rows that it decides, which the file may then change. */
    void (*decide)(void *parent);
    /* Called after a user has chosen another value: sets the values of other rows that it decides, and keeps all others. */
    void (*change)(void *parent);
    /* Called before an item of a list is read: sets its defaults. `parent`: the struct that holds the list. */
    void (*prepare)(const void *parent, void *item);
};

/* The older name if `word` is a newer one, else `word`. `aliases` NULL: there are none. */
const char *name_first(const name_alias *aliases, const char *word);

/* Writes the allowed values for a message: "a number, -90 to 90 degrees", "one of sun, moon". The text is cut to `size`. */
void field_allowed(const field_row *field, char *out, size_t size);

/* As field_allowed(), for values that are read from text, where a choice may have other spellings. */
void field_allowed_text(const field_row *field, char *out, size_t size);

bool field_in_range(const field_row *field, double value);

/* Reads a single number, choice or switch. False: the value is not allowed, and nothing is written. */
bool field_parse(const field_row *field, const char *text, void *value);

/* Whether a value in memory is allowed. */
bool field_is_legal(const field_row *field, const void *value);

/* Compares structs row by row. Their rows must not be texts or lists. */
bool fields_equal(const field_row *fields, const void *a, const void *b);

/* Place of a choice or switch in `choices`; -1: it is none of them. */
int field_place(const field_row *field, const void *value);
/* Sets a choice or switch by its place. */
void field_choose(const field_row *field, int place, void *value);

/* Size of a value, bytes; 0 for texts, lists, mappings and exposures. */
size_t field_size(const field_row *field);

/* A number, choice or switch as text that reads back as the same value: "30", "sun". Three numbers are rounded, for messages: "[0, 4, 0]". */
short_number field_print(const field_row *field, const void *value);

/* Whether the conditions of a row hold. `tolerant`: tolerated conditions need not hold. `fields`: the table of the row. */
bool field_applies(const field_row *fields, const field_row *field, const void *parent, bool tolerant);

/* Writes the conditions in words: "method podee-uniform or podee-pixel". Without conditions the text is empty. */
void field_conditions(const field_row *fields, const field_row *field, char *out, size_t size);

/* Writes one line with the meaning of a row, its conditions, its default, and its alias. */
void field_meaning(const field_row *fields, const field_row *field, char *out, size_t size);

/* The row with this key or alias; NULL: there is none. */
const field_row *field_find(const field_row *fields, const char *key, size_t length);
bool field_is_alias(const field_row *field, const char *key, size_t length);

/* Newer name of the choice at a place; NULL: it has none. */
const char *field_word_alias(const field_row *field, int place);

/* Writes a number or three numbers as JSON, which is also YAML: "30", "[0, 4, 0]". False: the field has another type. */
bool field_numbers_write(FILE *stream, const field_row *field, const void *value);

/* Name of the choice at a place; NULL behind the last one. */
static inline const char *field_word(const field_row *field, int place)
{
    return *(const char *const *)(const void *)((const char *)field->choices + (size_t)place * (field->choice_stride ? field->choice_stride : sizeof(char *)));
}
int field_word_count(const field_row *field);

static inline const void *field_at(const field_row *field, const void *parent) { return (const char *)parent + field->offset; }

#endif
