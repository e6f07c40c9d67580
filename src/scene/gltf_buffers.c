/* SPDX-License-Identifier: MIT */
#include "scene/gltf_buffers.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_sea.h"

static const double MAX_BUFFER_BYTES = 8589934592.0;

static bool refuse_va(gltf_reader *g, const scene_place *place, const char *format, va_list arguments)
{
    char what[sizeof g->fault->text];
    vsnprintf(what, sizeof what, format, arguments);
    if (place == NULL)
        return model_fault_set(g->fault, SCENE_ERROR_BAD_SCENE, "%s: %s", scene_file_name(g->path).text, what);
    if (g->binary)
        return model_fault_set(g->fault, SCENE_ERROR_BAD_SCENE, "%s: JSON chunk, line %d, column %d: %s", scene_file_name(g->path).text, place->line,
                               place->column, what);
    return model_fault_set(g->fault, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: %s", scene_file_name(g->path).text, place->line, place->column, what);
}

bool gltf_refuse(gltf_reader *g, const json_value *at, const char *format, ...)
{
    const scene_place place = at != NULL ? json_text_place(&g->json, at->at) : (scene_place){0};
    va_list arguments;
    va_start(arguments, format);
    refuse_va(g, at != NULL ? &place : NULL, format, arguments);
    va_end(arguments);
    return false;
}

bool gltf_refuse_at(gltf_reader *g, scene_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    refuse_va(g, &place, format, arguments);
    va_end(arguments);
    return false;
}

/* A whole number between limits; `otherwise` where it is left out, unless that is negative. */
static bool take_bytes(gltf_reader *g, const json_value *object, const char *where, const char *key, double low, double high, double otherwise, double *out)
{
    const json_value *value = json_text_get(&g->json, object, key);
    *out = value != NULL && value->kind == JSON_NUMBER ? value->number : value != NULL ? -1 : otherwise;
    return (*out >= low && *out <= high && *out == floor(*out)) || (value == NULL && otherwise >= 0) ||
           gltf_refuse(g, value != NULL ? value : object, "%s.%s is %s; allowed: a whole number of bytes, %.17g to %.17g", where, key,
                       value == NULL ? "missing" : "out of range", low, high);
}

/* ---- data: URIs --------------------------------------------------------------------------------------------------- */

static int base64_digit(char c)
{
    return c >= 'A' && c <= 'Z' ? c - 'A' : c >= 'a' && c <= 'z' ? c - 'a' + 26 : c >= '0' && c <= '9' ? c - '0' + 52 : c == '+' ? 62 : c == '/' ? 63 : -1;
}

/* The text behind "base64,", NULL where the string is no such URI; its end leaves out what fills it up. */
static const char *base64_of(const gltf_reader *g, const json_value *uri, size_t *length)
{
    const char *text = g->json.text + uri->at, *comma = memchr(text, ',', uri->length);
    if (uri->length < 5 || memcmp(text, "data:", 5) != 0 || comma == NULL || comma - text < 7 || memcmp(comma - 7, ";base64", 7) != 0)
        return NULL;
    *length = uri->length - (size_t)(comma + 1 - text);
    while (*length > 0 && comma[*length] == '=')
        (*length)--;
    return comma + 1;
}

static char *decode_base64(const char *text, size_t length)
{
    char *out = malloc(length / 4 * 3 + 3), *to = out;
    uint32_t bits = 0;
    int count = 0;
    for (size_t i = 0; out != NULL && i < length; i++) {
        bits = bits << 6 | (uint32_t)(base64_digit(text[i]) & 63);
        count += 6;
        if (count >= 8) {
            count -= 8;
            *to++ = (char)(bits >> count & 0xff);
        }
    }
    return out;
}

/* ---- buffers ------------------------------------------------------------------------------------------------------ */

/* How many bytes there are behind a URI. */
static bool room_of(gltf_reader *g, gltf_buffer *buffer, const char *where, uint64_t *room)
{
    size_t length;
    const char *base64 = base64_of(g, buffer->uri, &length);
    if (base64 != NULL) {
        for (size_t i = 0; i < length; i++)
            if (base64_digit(base64[i]) < 0)
                return gltf_refuse_at(g, json_text_place(&g->json, (size_t)(base64 + i - g->json.text)),
                                      "%s.uri has a character that is none of base64's; allowed: "
                                      "A-Z, a-z, 0-9, + and /",
                                      where);
        *room = length / 4 * 3 + (length % 4 > 1 ? length % 4 - 1 : 0);
        return true;
    }
    if (buffer->uri->length >= 5 && memcmp(g->json.text + buffer->uri->at, "data:", 5) == 0)
        return gltf_refuse(g, buffer->uri, "%s.uri is a data: URI that is not in base64; allowed: base64, or a file", where);
    char *name = json_text_string(&g->json, buffer->uri);
    buffer->path = name != NULL ? scene_file_beside(g->path, name) : NULL;
    free(name);
    if (buffer->path == NULL)
        return model_fault_memory(g->fault);
    regular_file file;
    if (!regular_file_open(&file, buffer->path))
        return gltf_refuse(g, buffer->uri, "%s.uri refers to %s, which cannot be read; allowed: a file beside this one", where,
                           scene_file_name(buffer->path).text);
    *room = file.size;
    fclose(file.stream);
    return true;
}

bool gltf_check_buffer(gltf_reader *g, const json_value *value, size_t index)
{
    gltf_buffer *buffer = &g->buffers[index];
    char where[48];
    double length;
    uint64_t room = g->chunk_length;
    snprintf(where, sizeof where, "buffers[%zu]", index);
    if (!take_bytes(g, value, where, "byteLength", 1, MAX_BUFFER_BYTES, -1, &length))
        return false;
    buffer->length = (uint64_t)length;
    buffer->uri = json_text_get(&g->json, value, "uri");
    if (buffer->uri != NULL && buffer->uri->kind != JSON_STRING)
        return gltf_refuse(g, buffer->uri, "%s.uri is not a string; allowed: a string", where);
    if (buffer->uri == NULL && (index != 0 || g->chunk == NULL))
        return gltf_refuse(g, value, "%s.uri is missing; allowed: a file's name or a data: URI", where);
    if (buffer->uri != NULL && !room_of(g, buffer, where, &room))
        return false;
    if (buffer->length > room)
        return gltf_refuse(g, json_text_get(&g->json, value, "byteLength"), "%s.byteLength is %.17g; allowed: at most the %llu bytes that there are", where,
                           length, (unsigned long long)room);
    if (buffer->path != NULL) {
        g->weight += room;
        if ((double)g->weight > MAX_BUFFER_BYTES)
            return gltf_refuse(g, value, "with %s the file and its buffers are larger than 8 GiB; allowed: at most 8 GiB", where);
    }
    return true;
}

bool gltf_check_view(gltf_reader *g, const json_value *value, size_t index)
{
    const json_value *buffer = json_text_get(&g->json, value, "buffer");
    gltf_view *view = &g->views[index];
    const size_t buffers = g->lists[GLTF_BUFFERS].count;
    char where[48];
    double offset, length;
    snprintf(where, sizeof where, "bufferViews[%zu]", index);
    if (buffer == NULL || buffer->kind != JSON_NUMBER || !(buffer->number >= 0 && buffer->number < (double)buffers && buffer->number == floor(buffer->number)))
        return gltf_refuse(g, buffer != NULL ? buffer : value, "%s.buffer is none of the %zu buffers; allowed: their number, from 0", where, buffers);
    view->buffer = (size_t)buffer->number;
    if (!take_bytes(g, value, where, "byteOffset", 0, MAX_BUFFER_BYTES, 0, &offset) ||
        !take_bytes(g, value, where, "byteLength", 1, MAX_BUFFER_BYTES, -1, &length) || !take_bytes(g, value, where, "byteStride", 4, 252, 0, &view->stride))
        return false;
    view->offset = (uint64_t)offset;
    view->length = (uint64_t)length;
    return view->offset + view->length <= g->buffers[view->buffer].length ||
           gltf_refuse(g, value, "%s ends %llu bytes behind the start of buffers[%zu], which has %llu; allowed: bytes inside it", where,
                       (unsigned long long)(view->offset + view->length), view->buffer, (unsigned long long)g->buffers[view->buffer].length);
}

/* The bytes of a buffer, read once. NULL with the fault filled. */
static const char *bytes_of(gltf_reader *g, gltf_buffer *buffer)
{
    size_t length = 0;
    regular_file file;
    if (buffer->uri == NULL)
        return g->chunk;
    if (buffer->bytes == NULL && buffer->path == NULL) {
        const char *text = base64_of(g, buffer->uri, &length);
        buffer->bytes = decode_base64(text, length);
        if (buffer->bytes == NULL)
            model_fault_memory(g->fault);
    } else if (buffer->bytes == NULL) {
        buffer->bytes = regular_file_read(&file, buffer->path, false, (size_t)MAX_BUFFER_BYTES, "is larger than 8 GiB", &length);
        if (buffer->bytes != NULL && length < buffer->length) { /* it has changed */
            free(buffer->bytes);
            buffer->bytes = NULL;
        }
        if (buffer->bytes == NULL)
            gltf_refuse(g, buffer->uri, "refers to %s, which cannot be read; allowed: a file beside this one", scene_file_name(buffer->path).text);
    }
    return buffer->bytes;
}

bool gltf_check_indices(gltf_reader *g, const json_value *at, const char *where, long view, uint64_t offset, uint64_t count, unsigned size, double limit)
{
    const char *bytes = bytes_of(g, &g->buffers[g->views[view].buffer]);
    double before = -1;
    if (bytes == NULL)
        return false;
    bytes += g->views[view].offset + offset;
    for (uint64_t i = 0; i < count; i++, bytes += size) {
        uint32_t index = 0;
        for (unsigned k = 0; k < size; k++)
            index |= (uint32_t)(unsigned char)bytes[k] << 8 * k;
        if (!((double)index > before && (double)index < limit))
            return gltf_refuse(g, at, "%s[%llu] is %u; allowed: more than the one before, below %.17g", where, (unsigned long long)i, index, limit);
        before = (double)index;
    }
    return true;
}

void gltf_buffers_free(gltf_reader *g)
{
    for (size_t i = 0; g->buffers != NULL && i < g->lists[GLTF_BUFFERS].count; i++) {
        free(g->buffers[i].path);
        free(g->buffers[i].bytes);
    }
    free(g->buffers);
}
