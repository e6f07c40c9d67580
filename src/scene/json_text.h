/* SPDX-License-Identifier: MIT
 *
 * A JSON document (RFC 8259) as a tree of values that know where they stand in its text.
 */
#ifndef MANGATA_SCENE_JSON_TEXT_H
#define MANGATA_SCENE_JSON_TEXT_H

#include "scene/scene_text.h"

/* Limits on one document; what lies beyond is refused. */
enum { JSON_MAX_DEPTH = 64, JSON_MAX_VALUES = 2000000, JSON_MAX_BYTES = 1 << 30 };

typedef enum json_kind { JSON_NULL, JSON_FALSE, JSON_TRUE, JSON_NUMBER, JSON_STRING, JSON_LIST, JSON_OBJECT } json_kind;

/* Offsets are bytes in the text; a string's leave out its quotes. */
typedef struct json_value json_value;
struct json_value {
    json_kind kind;
    uint32_t at, length;
    uint32_t key_at, key_length; /* the key as written, for a member of an object */
    uint32_t first, next;        /* indices of a child and a sibling; 0: none */
    uint32_t count;              /* children */
    double number;
};

typedef struct json_text {
    const char *text; /* borrowed */
    size_t length;
    json_value *values; /* owned; the first is the document's own */
    size_t count, room;
    scene_place fault_place; /* where the document is wrong */
    const char *fault_what;  /* what is wrong there; NULL: memory ran out */
} json_text;

/* Reads a document; false with the fault filled. To be freed with json_text_free() in any case. `text` must outlive it. */
bool json_text_parse(json_text *json, const char *text, size_t length);
void json_text_free(json_text *json);

/* The member of an object, the first where there are several; NULL where there is none or `object` is no object. */
const json_value *json_text_get(const json_text *json, const json_value *object, const char *key);
/* Children in their order; NULL: none (more). */
const json_value *json_text_first(const json_text *json, const json_value *parent);
const json_value *json_text_next(const json_text *json, const json_value *child);

/* Line and column of a byte of the text. */
scene_place json_text_place(const json_text *json, size_t at);

/* Whether it is a string and its text is `plain`. NULL is allowed. */
bool json_text_is(const json_text *json, const json_value *value, const char *plain);

/* A string with its escapes resolved; the caller frees it. NULL when memory runs out. */
char *json_text_string(const json_text *json, const json_value *value);

#endif
