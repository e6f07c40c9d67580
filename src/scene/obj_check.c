/* SPDX-License-Identifier: MIT */
#include "scene/obj_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CORNERS = 65536, MAX_PARTS = 65536, KIND_COUNT = 3 };

/* In the order in which a corner "1/2/3" names them. */
static const struct {
    const char *word, *name;
    int least, most; /* numbers on a line; colours may follow a place */
} kinds[KIND_COUNT] = {{"v", "places", 3, 8}, {"vt", "texture coordinates", 1, 3}, {"vn", "normals", 3, 3}};

/* What begins another piece of the model where its name is another one. */
enum { PART_COUNT = 3 };
static const char *const part_words[PART_COUNT] = {"o", "g", "usemtl"};

typedef struct obj_reader {
    const char *path, *bytes, *at, *end;
    model_fault *fault;
    uint64_t counts[KIND_COUNT], totals[KIND_COUNT]; /* so far, and in the whole file */
    uint64_t triangles;
    struct {
        const char *word; /* the rest of the last line of this kind */
        size_t length;
    } names[PART_COUNT];
    bool part_begins; /* since the last face */
    int parts;        /* pieces with faces, each a mesh to the importer, whose time grows as their square */
} obj_reader;

static bool refuse(const obj_reader *r, const char *at, const char *what, const char *allowed)
{
    scene_place place = {1, 1};
    for (const char *p = r->bytes; p < at; p++)
        place = *p == '\n' ? (scene_place){place.line + 1, 1} : (scene_place){place.line, place.column + (((unsigned char)*p & 0xc0) != 0x80)};
    return model_fault_set(r->fault, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: %s; allowed: %s", scene_file_name(r->path).text, place.line, place.column, what,
                           allowed);
}

/* ---- words -------------------------------------------------------------------------------------------------------- */

static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

/* The next word of the line, empty at its end. A backslash before the line's end continues it. */
static const char *next_word(obj_reader *r, size_t *length)
{
    for (;;) {
        while (r->at < r->end && is_space(*r->at))
            r->at++;
        const char *p = r->at;
        if (p == r->end || *p != '\\')
            break;
        p++;
        while (p < r->end && *p == '\r')
            p++;
        if (p == r->end || *p != '\n')
            break;
        r->at = p + 1;
    }
    const char *word = r->at;
    while (r->at < r->end && *r->at != '\n' && !is_space(*r->at) && !(*r->at == '\\' && r->at > word))
        r->at++;
    *length = (size_t)(r->at - word);
    return word;
}

static void skip_line(obj_reader *r)
{
    const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
    r->at = stop != NULL ? stop + 1 : r->end;
}

static bool is_word(const char *word, size_t length, const char *plain) { return strlen(plain) == length && memcmp(word, plain, length) == 0; }

/* ---- lines -------------------------------------------------------------------------------------------------------- */

static bool check_numbers(obj_reader *r, int kind)
{
    char text[64], *stop;
    const char *word;
    size_t length;
    int count = 0;
    for (;; count++) {
        word = next_word(r, &length);
        if (length == 0 || word[0] == '#')
            break;
        if (length >= sizeof text)
            return refuse(r, word, "a number has more than 63 characters", "a finite number");
        memcpy(text, word, length);
        text[length] = '\0';
        const double value = strtod(text, &stop);
        if (*stop != '\0' || !isfinite(value))
            return refuse(r, word, "is no finite number", "a finite number");
        if (count == kinds[kind].most)
            return refuse(r, word, "one number too many", kind == 0 ? "3 numbers, and a weight or a colour" : kind == 1 ? "1 to 3 numbers" : "3 numbers");
    }
    return count >= kinds[kind].least || refuse(r, word, "a number is missing", kind == 1 ? "1 to 3 numbers" : "3 numbers");
}

/* "1", "1/2", "1//3" or "1/2/3"; negative ones count back from here. */
static bool check_corner(obj_reader *r, const char *word, size_t length)
{
    const char *at = word, *end = word + length;
    for (int kind = 0; kind < KIND_COUNT; kind++) {
        const char *start = at;
        uint64_t index = 0;
        const bool back = at < end && *at == '-';
        for (at += back; at < end && *at >= '0' && *at <= '9'; at++)
            index = index < UINT32_MAX ? index * 10 + (uint64_t)(*at - '0') : index;
        const bool empty = at == start;
        if ((empty && kind == 0) || (at == start + 1 && back) || (at < end && *at != '/'))
            return refuse(r, word, "is no corner of a face", "numbers as 1, 1/2, 1//3 or 1/2/3");
        if (!empty && (index == 0 || index > (back ? r->counts[kind] : r->totals[kind]))) {
            char what[96];
            snprintf(what, sizeof what, "a face refers to %s that do not exist", kinds[kind].name);
            return refuse(r, start, what, "a number from 1, or from -1 backwards");
        }
        if (at == end)
            return true;
        at++;
    }
    return refuse(r, word, "is no corner of a face", "numbers as 1, 1/2, 1//3 or 1/2/3");
}

static bool check_face(obj_reader *r)
{
    int corners = 0;
    for (;;) {
        size_t length;
        const char *word = next_word(r, &length);
        if (length == 0 || word[0] == '#')
            break;
        if (!check_corner(r, word, length))
            return false;
        if (++corners > MAX_CORNERS)
            return refuse(r, word, "a face has more than 65536 corners", "3 to 65536");
    }
    r->parts += r->part_begins || r->parts == 0;
    r->part_begins = false;
    if (r->parts > MAX_PARTS)
        return refuse(r, r->at, "there are more than 65536 objects, groups and changes of material", "at most so many");
    r->triangles += corners > 2 ? (uint64_t)corners - 2 : 0;
    return r->triangles <= MGT_MAX_TRIANGLES || refuse(r, r->at, "there are more than 67108864 triangles", "at most so many");
}

static void read_part(obj_reader *r, int kind)
{
    size_t length;
    const char *word = next_word(r, &length);
    if (r->names[kind].word == NULL || r->names[kind].length != length || memcmp(r->names[kind].word, word, length) != 0)
        r->part_begins = true;
    r->names[kind].word = word;
    r->names[kind].length = length;
}

/* Two rounds, as faces may name what follows them: counting, and checking. */
static bool read_lines(obj_reader *r, bool check)
{
    for (r->at = r->bytes; r->at < r->end; skip_line(r)) {
        size_t length;
        const char *word = next_word(r, &length);
        bool good = true;
        for (int kind = 0; kind < KIND_COUNT; kind++)
            if (is_word(word, length, kinds[kind].word)) {
                r->counts[kind]++;
                good = !check || check_numbers(r, kind);
            }
        for (int kind = 0; check && kind < PART_COUNT; kind++)
            if (is_word(word, length, part_words[kind]))
                read_part(r, kind);
        if (check && is_word(word, length, "f"))
            good = check_face(r);
        if (!good)
            return false;
    }
    return true;
}

bool obj_check(const char *path, const char *bytes, size_t length, model_fault *fault)
{
    obj_reader r = {.path = path, .bytes = bytes, .end = bytes + length, .fault = fault};
    const char *zero = memchr(bytes, '\0', length);
    if (zero != NULL)
        return refuse(&r, zero, "a byte is zero: the file is not text", "a text in ASCII or UTF-8");
    if (!read_lines(&r, false))
        return false;
    memcpy(r.totals, r.counts, sizeof r.totals);
    memset(r.counts, 0, sizeof r.counts);
    if (r.totals[0] > 3u * (uint64_t)MGT_MAX_TRIANGLES)
        return refuse(&r, bytes, "there are more than 201326592 places", "at most so many");
    if (!read_lines(&r, true))
        return false;
    return r.triangles > 0 || refuse(&r, bytes + length, "the file ends without a face of three corners", "triangles or polygons");
}
