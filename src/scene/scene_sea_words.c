/* SPDX-License-Identifier: MIT
 *
 * A sea in a few words, "wind=12,direction=30", in place of a scene's file.
 */
#define _GNU_SOURCE
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_edit.h"
#include "scene/scene_sea.h"

static const char PREFIX[] = "--sea ";

/* ---- the words ---------------------------------------------------------------------------------------------- */

/* A row of water.wind by its name in words: the first one is the wind itself, and units are left out. */
static short_number word_of(const field_row *rows, const field_row *row)
{
    short_number word;
    const char *unit = strstr(row->key, "_deg");
    snprintf(word.text, sizeof word.text, "%.*s", (int)(unit != NULL ? (size_t)(unit - row->key) : strlen(row->key)), row == rows ? "wind" : row->key);
    return word;
}

static const field_row *wind_rows(void)
{
    const field_row *water = field_find(scene_root_field()->fields, "water", 5);
    return field_find(water->fields, "wind", 4)->fields;
}

static const field_row *row_of(const field_row *rows, const char *word, size_t length)
{
    for (const field_row *row = rows; row->key != NULL; row++) {
        const short_number name = word_of(rows, row);
        if (strlen(name.text) == length && memcmp(name.text, word, length) == 0)
            return row;
    }
    return NULL;
}

scene_sea_names scene_sea_word_names(void)
{
    scene_sea_names names;
    size_t used = 0;
    const field_row *rows = wind_rows();
    for (const field_row *row = rows; row->key != NULL && used < sizeof names.text; row++)
        used += (size_t)snprintf(names.text + used, sizeof names.text - used, "%s%s", row == rows ? "" : ", ", word_of(rows, row).text);
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

/* One word, name=value, into *wind. */
static bool read_word(const char *all, const char *word, size_t length, uint32_t *seen, scene_wind *wind, scene_error *error)
{
    const field_row *rows = wind_rows();
    const char *equals = memchr(word, '=', length);
    if (equals == NULL)
        return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "\"%s\" is not of the form key=value; allowed: such as wind=12,direction=30",
                      scene_quote_text(word, length).text);
    const size_t name = (size_t)(equals - word), size = length - name - 1;
    const field_row *row = row_of(rows, word, name);
    if (row == NULL)
        return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "unknown key \"%s\"; allowed: %s", scene_quote_text(word, name).text, scene_sea_word_names().text);
    if (*seen >> (row - rows) & 1)
        return refuse(error, SCENE_ERROR_BAD_OVERRIDE, all, "key \"%s\" stands twice; allowed: once", word_of(rows, row).text);
    *seen |= 1u << (row - rows);
    char value[64] = "", allowed[160];
    if (size < sizeof value)
        memcpy(value, equals + 1, size);
    if (field_parse(row, value, (char *)wind + row->offset))
        return true;
    field_allowed(row, allowed, sizeof allowed);
    return refuse(error, SCENE_ERROR_BAD_SCENE, all, "%s is \"%s\"; allowed: %s", word_of(rows, row).text, scene_quote_text(equals + 1, size).text, allowed);
}

static bool read_words(const char *words, scene_wind *wind, scene_error *error)
{
    uint32_t seen = 0;
    for (const char *at = words;; at++) {
        const size_t length = strcspn(at, ",");
        if (!read_word(words, at, length, &seen, wind, error))
            return false;
        at += length;
        if (*at == '\0')
            break;
    }
    return wind->speed > 0 || refuse(error, SCENE_ERROR_BAD_SCENE, words, "there is no wind; allowed: such as wind=12,direction=30");
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

static bool measure(scene_values *values, const char *words, scene_error *error)
{
    scene_sea_fault fault;
    if (!scene_sea_fill(&values->water, "", &fault)) {
        if (fault.setting.key == NULL)
            return scene_error_memory(error);
        scene_wind_fault(&fault.setting);
        const field_row *rows = wind_rows();
        return refuse(error, SCENE_ERROR_BAD_SCENE, words, "%s %s", word_of(rows, field_find(rows, fault.setting.key, strlen(fault.setting.key))).text,
                      fault.setting.text);
    }
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
    if (read_words(words, &values.water.wind, error) && measure(&values, words, error)) {
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
