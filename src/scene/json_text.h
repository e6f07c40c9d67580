/* SPDX-License-Identifier: MIT
 *
 * A JSON document (RFC 8259) as a tree of values with their places in the text.
 */
#ifndef MANGATA_SCENE_JSON_TEXT_H
#define MANGATA_SCENE_JSON_TEXT_H

#include "scene/scene_text.h"

/* Limits of a document. Larger documents are refused. */
enum { JSON_MAX_DEPTH = 64, JSON_MAX_VALUES = 2000000, JSON_MAX_BYTES = 1 << 30 };

typedef enum json_kind { JSON_NULL, JSON_FALSE, JSON_TRUE, JSON_NUMBER, JSON_STRING, JSON_LIST, JSON_OBJECT } json_kind;

/* A value. Offsets are bytes in the text. Those of a string exclude its quotes. */
typedef struct json_value json_value;
struct json_value {
    json_kind kind;
    uint32_t at, length;
    uint32_t key_at, key_length; /* member of an object: its key as it is written */
    uint32_t first, next;        /* indices of the first child and the next sibling; 0: there is none */
    uint32_t count;              /* number of children */
    double number;
};

typedef struct json_text {
    const char *text; /* borrowed */
    size_t length;
    json_value *values; /* owned; the first one is the root */
    size_t count, room;
    scene_place fault_place; /* place of the fault */
    const char *fault_what;  /* text of the fault; NULL: out of memory */
} json_text;

/* Reads a document. `text` must outlive it. False: the fault is filled. Call json_text_free() in any case. */
bool json_text_parse(json_text *json, const char *text, size_t length);
void json_text_free(json_text *json);

/* The first member of an object with this key; NULL: there is none, or `object` is no object. */
const json_value *json_text_get(const json_text *json, const json_value *object, const char *key);
/* The first child; NULL: there is none. */
const json_value *json_text_first(const json_text *json, const json_value *parent);
/* The next sibling; NULL: there is none. */
const json_value *json_text_next(const json_text *json, const json_value *child);

/* Line and column of a byte of the text. */
scene_place json_text_place(const json_text *json, size_t at);

/* Whether a value is a string with the text `plain`. `value` may be NULL. */
bool json_text_is(const json_text *json, const json_value *value, const char *plain);

/* A string with its escapes resolved. The caller frees it. NULL: out of memory. */
char *json_text_string(const json_text *json, const json_value *value);

#endif
