/* SPDX-License-Identifier: MIT */
#include "scene/json_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct json_reader {
    json_text *json;
    size_t at;
} json_reader;

static bool fails(json_reader *r, const char *what)
{
    if (r->json->fault_what == NULL) {
        r->json->fault_place = json_text_place(r->json, r->at);
        r->json->fault_what = what;
    }
    return false;
}

/* ---- characters --------------------------------------------------------------------------------------------------- */

static int peek(const json_reader *r) { return r->at < r->json->length ? (unsigned char)r->json->text[r->at] : -1; }

static void skip_space(json_reader *r)
{
    for (int c = peek(r); c == ' ' || c == '\t' || c == '\n' || c == '\r'; c = peek(r))
        r->at++;
}

static int hex_digit(char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1; }

/* The character of an escape behind its backslash, and how many bytes it takes; -1 where it is none. */
static long escaped(const char *at, size_t room, size_t *taken)
{
    static const char names[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    *taken = 1;
    if (room == 0)
        return -1;
    const char *found = at[0] != '\0' ? strchr(names, at[0]) : NULL;
    if (found != NULL)
        return meanings[found - names];
    if (at[0] != 'u' || room < 5)
        return -1;
    long code = 0;
    for (int i = 1; i < 5; i++) {
        const int digit = hex_digit(at[i]);
        if (digit < 0)
            return -1;
        code = code * 16 + digit;
    }
    *taken = 5;
    return code;
}

/* From behind the opening quote to behind the closing one. */
static bool read_string(json_reader *r, uint32_t *at, uint32_t *length)
{
    *at = (uint32_t)r->at;
    for (;;) {
        const int c = peek(r);
        size_t taken;
        if (c < 0)
            return fails(r, "a string has no end");
        if (c == '"')
            break;
        if (c < 0x20)
            return fails(r, "a string has a control character, which must be escaped");
        if (c == '\\') {
            if (escaped(r->json->text + r->at + 1, r->json->length - r->at - 1, &taken) < 0)
                return fails(r, "an escape in a string is not valid in JSON");
            r->at += taken;
        }
        r->at++;
    }
    *length = (uint32_t)r->at - *at;
    r->at++;
    return true;
}

static bool read_digits(json_reader *r)
{
    const size_t start = r->at;
    while (peek(r) >= '0' && peek(r) <= '9')
        r->at++;
    return r->at > start || fails(r, "a digit is missing");
}

static bool read_number(json_reader *r, json_value *value)
{
    const size_t start = r->at;
    char word[64];
    r->at += peek(r) == '-';
    if (peek(r) == '0')
        r->at++;
    else if (!read_digits(r))
        return false;
    if (peek(r) == '.') {
        r->at++;
        if (!read_digits(r))
            return false;
    }
    if (peek(r) == 'e' || peek(r) == 'E') {
        r->at++;
        r->at += peek(r) == '-' || peek(r) == '+';
        if (!read_digits(r))
            return false;
    }
    value->length = (uint32_t)(r->at - start);
    r->at = r->at - start < sizeof word ? r->at : start;
    if (r->at == start)
        return fails(r, "a number has more than 63 characters");
    memcpy(word, r->json->text + start, r->at - start);
    word[r->at - start] = '\0';
    value->number = strtod(word, NULL);
    if (isfinite(value->number))
        return true;
    r->at = start;
    return fails(r, "a number is too large");
}

/* ---- values ------------------------------------------------------------------------------------------------------- */

static uint32_t add_value(json_reader *r, json_value value)
{
    json_text *json = r->json;
    if (json->count == JSON_MAX_VALUES) {
        fails(r, "the document has more than 2000000 values");
        return UINT32_MAX;
    }
    if (json->count == json->room) {
        const size_t room = 2 * json->room + 64;
        json_value *values = realloc(json->values, room * sizeof *values);
        if (values == NULL)
            return UINT32_MAX;
        json->values = values;
        json->room = room;
    }
    json->values[json->count] = value;
    return (uint32_t)json->count++;
}

static bool read_value(json_reader *r, json_value value, int depth, uint32_t *index);

/* What stands between brackets, behind the first. */
static bool read_children(json_reader *r, uint32_t parent, json_kind kind, int depth)
{
    const int close = kind == JSON_LIST ? ']' : '}';
    uint32_t last = 0;
    skip_space(r);
    if (peek(r) == close) {
        r->at++;
        return true;
    }
    for (;;) {
        json_value child = {0};
        uint32_t index;
        skip_space(r);
        if (kind == JSON_OBJECT) {
            if (peek(r) != '"')
                return fails(r, "a name in quotes is missing");
            r->at++;
            if (!read_string(r, &child.key_at, &child.key_length))
                return false;
            skip_space(r);
            if (peek(r) != ':')
                return fails(r, "a colon is missing");
            r->at++;
        }
        if (!read_value(r, child, depth, &index))
            return false;
        *(last != 0 ? &r->json->values[last].next : &r->json->values[parent].first) = index;
        r->json->values[parent].count++;
        last = index;
        skip_space(r);
        const int c = peek(r);
        if (c != close && c != ',')
            return fails(r, "a comma or a closing bracket is missing");
        r->at++;
        if (c == close)
            return true;
    }
}

static bool read_word(json_reader *r, const char *word)
{
    const size_t length = strlen(word);
    if (r->json->length - r->at < length || memcmp(r->json->text + r->at, word, length) != 0)
        return fails(r, "a value is not valid in JSON");
    r->at += length;
    return true;
}

/* `value` holds the key already. */
static bool read_value(json_reader *r, json_value value, int depth, uint32_t *index)
{
    skip_space(r);
    const int c = peek(r);
    value.at = (uint32_t)r->at;
    value.kind = c == '{' ? JSON_OBJECT : c == '[' ? JSON_LIST : c == '"' ? JSON_STRING : c == 't' ? JSON_TRUE : c == 'f' ? JSON_FALSE : JSON_NULL;
    if (c == '-' || (c >= '0' && c <= '9'))
        value.kind = JSON_NUMBER;
    const bool nests = value.kind == JSON_OBJECT || value.kind == JSON_LIST;
    if (nests && depth == JSON_MAX_DEPTH)
        return fails(r, "nested deeper than 64 levels");
    if (c == '"' || nests)
        r->at++;
    const bool good = nests                       ? true
                      : value.kind == JSON_STRING ? read_string(r, &value.at, &value.length)
                      : value.kind == JSON_NUMBER ? read_number(r, &value)
                      : value.kind == JSON_TRUE   ? read_word(r, "true")
                      : value.kind == JSON_FALSE  ? read_word(r, "false")
                                                  : read_word(r, "null");
    if (!good)
        return false;
    *index = add_value(r, value);
    return *index != UINT32_MAX && (!nests || read_children(r, *index, value.kind, depth + 1));
}

bool json_text_parse(json_text *json, const char *text, size_t length)
{
    json_reader r = {.json = json};
    uint32_t root;
    *json = (json_text){.text = text, .length = length};
    if (length > JSON_MAX_BYTES)
        return fails(&r, "the document is larger than 1 GiB");
    if (!scene_text_is_clean(text, length, &json->fault_place)) {
        json->fault_what = "a byte is not printable UTF-8";
        return false;
    }
    if (!read_value(&r, (json_value){0}, 0, &root))
        return false;
    skip_space(&r);
    return r.at == length || fails(&r, "text follows the document");
}

void json_text_free(json_text *json)
{
    free(json->values);
    json->values = NULL;
}

/* ---- questions ---------------------------------------------------------------------------------------------------- */

const json_value *json_text_first(const json_text *json, const json_value *parent)
{
    return parent != NULL && parent->first != 0 ? &json->values[parent->first] : NULL;
}

const json_value *json_text_next(const json_text *json, const json_value *child) { return child->next != 0 ? &json->values[child->next] : NULL; }

static bool equals(const json_text *json, uint32_t at, uint32_t length, const char *plain)
{
    const char *text = json->text + at;
    size_t i = 0;
    for (; i < length; plain++) {
        size_t taken = 0;
        const long c = text[i] == '\\' ? escaped(text + i + 1, length - i - 1, &taken) : (long)text[i];
        if (*plain == '\0' || c != (long)*plain)
            return false;
        i += 1 + taken;
    }
    return *plain == '\0';
}

bool json_text_is(const json_text *json, const json_value *value, const char *plain)
{
    return value != NULL && value->kind == JSON_STRING && equals(json, value->at, value->length, plain);
}

const json_value *json_text_get(const json_text *json, const json_value *object, const char *key)
{
    if (object == NULL || object->kind != JSON_OBJECT)
        return NULL;
    for (const json_value *child = json_text_first(json, object); child != NULL; child = json_text_next(json, child))
        if (equals(json, child->key_at, child->key_length, key))
            return child;
    return NULL;
}

scene_place json_text_place(const json_text *json, size_t at)
{
    scene_place place = {1, 1};
    for (size_t i = 0; i < at && i < json->length; i++) {
        const unsigned char c = (unsigned char)json->text[i];
        if (c == '\n')
            place = (scene_place){place.line + 1, 1};
        else if ((c & 0xc0) != 0x80)
            place.column++;
    }
    return place;
}

char *json_text_string(const json_text *json, const json_value *value)
{
    const char *text = json->text + value->at;
    char *out = malloc((size_t)value->length + 1), *to = out;
    if (out == NULL)
        return NULL;
    for (size_t i = 0; i < value->length; i++) {
        size_t taken;
        if (text[i] != '\\') {
            *to++ = text[i];
            continue;
        }
        const long c = escaped(text + i + 1, value->length - i - 1, &taken);
        i += taken;
        /* Six bytes of "\u" become three at most; halves of a pair stay apart, and no file has such a name. */
        to = scene_write_character(to, c != 0 ? (uint32_t)c : '?');
    }
    *to = '\0';
    return out;
}
