/* SPDX-License-Identifier: MIT */
/* Checking metadata, JSON sidecars, and reading one key back from any file. */
#define _POSIX_C_SOURCE 200809L

#include "image/metadata.h"

#include <errno.h>
#include <jansson.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "image/metadata_json.h"
#include "image/picture_formats.h"
#include "image/sums_file.h"

enum { KEY_LENGTH_MAX = 79, VALUE_LENGTH_MAX = 1 << 20, SIDECAR_SIZE_MAX = 16 << 20 };

static bool key_is_valid(const char *key)
{
    size_t length = key ? strlen(key) : 0;
    if (length < 1 || length > KEY_LENGTH_MAX)
        return false;
    return strspn(key, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-") == length;
}

/* Length of the UTF-8 sequence at `s`, 0 where it is none (overlong, surrogate, beyond U+10FFFF). */
static size_t utf8_sequence(const unsigned char *s)
{
    if (s[0] < 0x80)
        return 1;
    size_t length = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : s[0] >= 0xc0 ? 2 : 0;
    if (length == 0 || s[0] > 0xf4)
        return 0;
    uint32_t code = s[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (s[i] & 0x3fu);
    }
    static const uint32_t smallest[5] = {0, 0, 0x80, 0x800, 0x10000};
    bool legal = code >= smallest[length] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    return legal ? length : 0;
}

static bool value_is_valid(const char *value)
{
    if (!value || strlen(value) > VALUE_LENGTH_MAX)
        return false;
    for (const unsigned char *s = (const unsigned char *)value; *s;) {
        size_t length = utf8_sequence(s);
        if (length == 0)
            return false;
        s += length;
    }
    return true;
}

file_status metadata_check(const metadata_list *metadata, file_error *error)
{
    size_t count = metadata ? metadata->count : 0;
    for (size_t i = 0; i < count; i++) {
        const metadata_entry *entry = &metadata->entries[i];
        if (!key_is_valid(entry->key))
            return file_error_set(error, FILE_ARGUMENT, "metadata: key %zu must be 1 to %d characters of A-Z a-z 0-9 _ . -", i, (int)KEY_LENGTH_MAX);
        if (!value_is_valid(entry->value))
            return file_error_set(error, FILE_ARGUMENT, "metadata: the value of %s must be UTF-8 of at most 1 MiB", entry->key);
        for (size_t j = 0; j < i; j++)
            if (strcmp(metadata->entries[j].key, entry->key) == 0)
                return file_error_set(error, FILE_ARGUMENT, "metadata: key %s is given twice", entry->key);
    }
    return FILE_OK;
}

char *metadata_sidecar_path(const char *path)
{
    size_t length = strlen(path);
    char *sidecar = malloc(length + sizeof ".json");
    if (sidecar) {
        memcpy(sidecar, path, length);
        memcpy(sidecar + length, ".json", sizeof ".json");
    }
    return sidecar;
}

char *metadata_json_text(const metadata_list *metadata)
{
    char *text = NULL;
    json_t *object = json_object();
    if (!object)
        return NULL;
    for (size_t i = 0; i < metadata->count; i++)
        if (json_object_set_new(object, metadata->entries[i].key, json_string(metadata->entries[i].value)) != 0)
            goto fail;
    text = json_dumps(object, JSON_INDENT(2) | JSON_PRESERVE_ORDER);
    if (text) {
        size_t length = strlen(text);
        char *longer = realloc(text, length + 2);
        if (longer) {
            longer[length] = '\n';
            longer[length + 1] = '\0';
        } else {
            free(text);
        }
        text = longer;
    }
fail:
    json_decref(object);
    return text;
}

static file_status sidecar_read(const char *path, const char *key, char **value, file_error *error)
{
    input_file input = {0};
    char *text = NULL;
    json_t *object = NULL;
    file_status status = input_file_open(&input, path, error);
    if (status != FILE_OK)
        return status;
    if (input.size > SIDECAR_SIZE_MAX) {
        status = file_error_set(error, FILE_BAD, "%s: too long for a sidecar", path);
        goto fail;
    }
    text = malloc((size_t)input.size + 1);
    if (!text) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    size_t length = fread(text, 1, (size_t)input.size, input.stream);
    json_error_t json_error;
    object = json_loadb(text, length, JSON_REJECT_DUPLICATES, &json_error);
    if (!json_is_object(object)) {
        status = file_error_set(error, FILE_BAD, "%s: is not a JSON object", path);
        goto fail;
    }
    const char *found = json_string_value(json_object_get(object, key));
    if (found && !(*value = strdup(found)))
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
fail:
    json_decref(object);
    free(text);
    input_file_close(&input);
    return status;
}

/* A PNG cannot hold an empty text, so that the others do not tell it from none either. */
static file_status none_if_empty(char **value)
{
    if (*value && **value == '\0') {
        free(*value);
        *value = NULL;
    }
    return FILE_OK;
}

file_status metadata_read(const char *path, const char *key, char **value, file_error *error)
{
    *value = NULL;
    input_file input = {0};
    file_status status = input_file_open(&input, path, error);
    if (status != FILE_OK)
        return status;
    picture_format format = input_file_format(&input);
    if (format == PICTURE_PNG)
        status = png_metadata_read(&input, key, value, error);
    else if (format == PICTURE_EXR)
        status = exr_metadata_read(&input, key, value, error);
    else if (format == PICTURE_SUMS)
        status = sums_metadata_read(&input, key, value, error);
    input_file_close(&input);
    if (format == PICTURE_PNG || format == PICTURE_EXR || format == PICTURE_SUMS)
        return status == FILE_OK ? none_if_empty(value) : status;

    char *sidecar = metadata_sidecar_path(path);
    if (!sidecar)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    file_error unused;
    status = sidecar_read(sidecar, key, value, error ? error : &unused);
    if (status == FILE_MISSING)
        status = FILE_OK; /* it records nothing */
    free(sidecar);
    return status == FILE_OK ? none_if_empty(value) : status;
}
