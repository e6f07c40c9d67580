/* SPDX-License-Identifier: MIT
 *
 * A sea in a few words, "wind=12,direction=30", in place of a scene's file.
 */
#define _GNU_SOURCE
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_edit.h"
#include "scene/scene_sea.h"

static const char PREFIX[] = "--sea ";

/* ---- the words ---------------------------------------------------------------------------------------------- */

/* What the words say. */
typedef struct sea_words {
    scene_wind wind;
    scene_swell swell; /* of height 0: none */
    uint32_t seen;     /* one bit a word */
} sea_words;

/* Where a word belongs. */
typedef struct sea_word {
    const field_row *row; /* NULL: there is no such word */
    size_t offset;        /* in sea_words */
    char name[32];
    unsigned index;
} sea_word;

/* The word of a place: the rows of water.wind and of water.swell, the first one of each called after its mapping, units left out, and those of the
 * swell with "swell_" in front. */
static sea_word word_at(unsigned index)
{
    static const struct {
        const char *key, *prefix;
        size_t offset;
    } parts[] = {{"wind", "", offsetof(sea_words, wind)}, {"swell", "swell_", offsetof(sea_words, swell)}};
    const field_row *water = field_find(scene_root_field()->fields, "water", 5);
    unsigned left = index;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const field_row *rows = field_find(water->fields, parts[i].key, strlen(parts[i].key))->fields;
        for (const field_row *row = rows; row->key != NULL; row++, left--)
            if (left == 0) {
                sea_word word = {.row = row, .offset = parts[i].offset + row->offset, .index = index};
                const char *unit = strstr(row->key, "_deg");
                const int length = unit != NULL ? (int)(unit - row->key) : (int)strlen(row->key);
                if (row == rows)
                    snprintf(word.name, sizeof word.name, "%s", parts[i].key);
                else
                    snprintf(word.name, sizeof word.name, "%s%.*s", parts[i].prefix, length, row->key);
                return word;
            }
    }
    return (sea_word){0};
}

static sea_word find_word(const char *name, size_t length)
{
    for (unsigned i = 0;; i++) {
        const sea_word word = word_at(i);
        if (word.row == NULL || (strlen(word.name) == length && memcmp(word.name, name, length) == 0))
            return word;
    }
}

scene_sea_names scene_sea_word_names(void)
{
    scene_sea_names names;
    size_t used = 0;
    for (unsigned i = 0; word_at(i).row != NULL && used < sizeof names.text; i++)
        used += (size_t)snprintf(names.text + used, sizeof names.text - used, "%s%s", i == 0 ? "" : ", ", word_at(i).name);
    return names;
}

static bool refuse(scene_error *error, scene_error_kind kind, const char *words, const char *format, ...) SCENE_FORMAT(4, 5);

/* "--sea words: what is wrong". */
static bool refuse(scene_error *error, scene_error_kind kind, const char *words, const char *format, ...)
{
    char wrong[320];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(wrong, sizeof wrong, format, arguments);
    va_end(arguments);
    return scene_error_set(error, kind, "%s%s: %s", PREFIX, scene_quote_text(words, strlen(words)).text, wrong);
}

/* One word, name=value. */
static bool read_word(const char *all, const char *text, size_t length, sea_words *words, scene_error *error)
{
    const char *equals = memchr(text, '=', length);
    if (equals == NULL)
        return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "\"%s\" is not of the form key=value; allowed: such as wind=12,direction=30",
                      scene_quote_text(text, length).text);
    const size_t name = (size_t)(equals - text), size = length - name - 1;
    const sea_word word = find_word(text, name);
    if (word.row == NULL)
        return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "unknown key \"%s\"; allowed: %s", scene_quote_text(text, name).text, scene_sea_word_names().text);
    if (words->seen >> word.index & 1)
        return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "key \"%s\" stands twice; allowed: once", word.name);
    words->seen |= 1u << word.index;
    char value[64] = "", allowed[160];
    if (size < sizeof value)
        memcpy(value, equals + 1, size);
    if (field_parse(word.row, value, (char *)words + word.offset))
        return true;
    field_allowed(word.row, allowed, sizeof allowed);
    return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "%s is \"%s\"; allowed: %s", word.name, scene_quote_text(equals + 1, size).text, allowed);
}

static bool read_words(const char *text, sea_words *words, scene_error *error)
{
    for (const char *at = text;; at++) {
        const size_t length = strcspn(at, ",");
        if (!read_word(text, at, length, words, error))
            return false;
        at += length;
        if (*at == '\0')
            break;
    }
    for (unsigned i = 0; !(words->swell.height > 0) && word_at(i).row != NULL; i++)
        if (words->seen >> i & 1 && word_at(i).offset >= offsetof(sea_words, swell))
            return refuse(error, SCENE_ERROR_BAD_OVERRIDE, text, "%s is given, but no swell; allowed: beside swell, its height, such as swell=2,swell_period=9",
                          word_at(i).name);
    return words->wind.speed > 0 || words->swell.height > 0 ||
           refuse(error, SCENE_ERROR_BAD_OVERRIDE, text, "there is no wind and no swell; allowed: such as wind=12,direction=30");
}

/* ---- the scene ---------------------------------------------------------------------------------------------- */

scene_values scene_sea_values(void)
{
    static const char *const settings[][2] = {{"time.frames", "60"}, {"light.elevation_deg", "12"}};
    scene_values values = scene_values_defaults();
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++) {
        const void *place = NULL;
        const field_row *field = scene_values_find(&values, settings[i][0], &place);
        field_parse(field, settings[i][1], (char *)&values + ((const char *)place - (const char *)&values));
    }
    return values;
}

void scene_sea_place_camera(mgt_camera *camera, double wave_height)
{
    const double height = fmax(3, ceil(2 * (1 + 1.5 * wave_height)) / 2);
    camera->position[1] = height;
    camera->target[1] = height - 0.123;
    camera->target[2] = -1;
}

scene_file *scene_values_parse(const scene_values *values, const char *name, const char *const *overrides, size_t override_count, scene_error *error)
{
    scene_file *file = NULL;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    bool good = stream != NULL && scene_values_write(stream, values);
    if (stream != NULL)
        good = fclose(stream) == 0 && good;
    if (good)
        file = scene_file_parse(text, size, name, overrides, override_count, error);
    else
        scene_error_memory(error);
    free(text);
    return file;
}

/* What the sea of these words cannot be, by a word. */
static bool refuse_sea(scene_error *error, const char *text, scene_sea_fault *fault)
{
    if (fault->setting.key == NULL)
        return scene_error_memory(error);
    scene_wind_fault(&fault->setting);
    sea_word word = word_at(0);
    for (unsigned i = 0; word_at(i).row != NULL; i++)
        if (strcmp(word_at(i).row->key, fault->setting.key) == 0) {
            word = word_at(i);
            break;
        }
    return refuse(error, SCENE_ERROR_BAD_OVERRIDE, text, "%s %s", word.name, fault->setting.text);
}

/* Values with the sea of the words, and a camera over it. */
static bool make_values(scene_values *values, const char *text, scene_error *error)
{
    sea_words words = {.wind = values->water.wind, .swell = scene_swell_defaults()};
    scene_sea_fault fault;
    if (!read_words(text, &words, error))
        return false;
    const field_row *wind = field_find(field_find(scene_root_field()->fields, "water", 5)->fields, "wind", 4);
    values->water.wind = words.wind;
    wind->decide(&values->water);
    if (words.swell.height > 0) {
        scene_swell *swell = malloc(sizeof *swell);
        if (swell == NULL)
            return scene_error_memory(error);
        *swell = words.swell;
        values->water.swell = (scene_list){.items = swell, .count = 1};
    }
    if (!scene_sea_fill(&values->water, "", &fault))
        return refuse_sea(error, text, &fault);
    const scene_list waves = scene_water_all(&values->water);
    scene_sea_place_camera(&values->camera.still, waves_statistics(waves.items, waves.count, 0).height);
    return true;
}

scene_file *scene_file_sea(const char *words, const char *const *overrides, size_t override_count, scene_error *error)
{
    scene_values values = scene_sea_values();
    scene_file *file = NULL;
    char *name = NULL;
    if (error != NULL)
        *error = (scene_error){0};
    if (make_values(&values, words, error)) {
        if (asprintf(&name, "%s%s", PREFIX, words) < 0)
            scene_error_memory(error);
        else
            file = scene_values_parse(&values, name, overrides, override_count, error);
    }
    free(name);
    scene_values_free(&values);
    return file;
}

scene_file *scene_file_open(const char *path, const char *const *overrides, size_t override_count, scene_error *error)
{
    const size_t length = sizeof PREFIX - 1;
    if (path != NULL && strncmp(path, PREFIX, length) == 0)
        return scene_file_sea(path + length, overrides, override_count, error);
    return scene_file_load(path, overrides, override_count, error);
}
