/* SPDX-License-Identifier: MIT
 *
 * Scenes that a program changes: the field of a path, and the way back to text.
 */
#define _GNU_SOURCE
#include "scene/scene_edit.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "scene/scene_sea.h"

enum { PATH_SIZE = 96 };

/* ---- for a program that goes on with the values -------------------------------------------------------------- */

void scene_values_write_out_auto(scene_values *values)
{
    if (scene_values_aerial(values))
        values->sky.aerial = WHEN_ON;
    if (scene_values_by_night(values, values->sky.stars))
        values->sky.stars = WHEN_ON;
    if (scene_values_by_night(values, values->post.night_tint))
        values->post.night_tint = WHEN_ON;
}

void scene_values_write_out_sea(scene_values *values)
{
    scene_water *water = &values->water;
    if (!scene_water_has_sea(water))
        return;
    free(water->waves.items);
    water->waves = water->sea;
    water->sea = (scene_list){0};
    free(water->spectrum.file);
    const scene_values defaults = scene_values_defaults();
    scene_values_write_out_auto(values); /* the wind goes */
    water->foam.share = scene_water_foam(water);
    water->foam.amount = 0;
    water->spectrum = defaults.water.spectrum;
    water->wind = defaults.water.wind;
    free(water->swell.items);
    water->swell = (scene_list){0};
    water->height = 1;
}

static bool fix_file(char **file, const char *scene_path)
{
    if (*file == NULL || **file == '\0' || **file == '/')
        return true;
    char *beside = scene_file_beside(scene_path, *file), *folder = beside != NULL && beside[0] != '/' ? getcwd(NULL, 0) : NULL;
    char *whole = NULL;
    if (folder != NULL && asprintf(&whole, "%s/%s", folder, beside) < 0)
        whole = NULL;
    if (folder != NULL) {
        free(beside);
        beside = whole;
    }
    free(folder);
    if (beside == NULL)
        return false;
    free(*file);
    *file = beside;
    return true;
}

bool scene_values_fix_files(scene_values *values, const char *scene_path)
{
    scene_object *objects = values->objects.items;
    bool good = fix_file(&values->water.spectrum.file, scene_path);
    for (size_t i = 0; i < values->objects.count; i++)
        good &= fix_file(&objects[i].mesh, scene_path) && fix_file(&objects[i].heights, scene_path) && fix_file(&objects[i].material.texture, scene_path);
    return good;
}

/* The path with its folder resolved, which the caller frees; a link in the last part stays. NULL: there is no such folder, or memory has run out. */
static char *resolved(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path;
    char *folder = slash == NULL ? strdup(".") : slash == path ? strdup("/") : strndup(path, (size_t)(slash - path));
    char *whole = folder != NULL ? realpath(folder, NULL) : NULL, *text = NULL;
    if (whole != NULL && asprintf(&text, "%s/%s", strcmp(whole, "/") == 0 ? "" : whole, name) < 0)
        text = NULL;
    free(whole);
    free(folder);
    return text;
}

/* `folder` ends in a slash, and so does the length `beside` of the folder above it; 0: that is the root, of which every file is a part. */
static bool relative_file(char **file, const char *folder, size_t beside)
{
    const size_t length = strlen(folder);
    char *whole = *file != NULL && **file == '/' ? resolved(*file) : NULL, *text = NULL;
    bool good = true;
    if (whole != NULL && strncmp(whole, folder, length) == 0)
        good = (text = strdup(whole + length)) != NULL;
    else if (whole != NULL && beside > 0 && strncmp(whole, folder, beside) == 0)
        good = asprintf(&text, "../%s", whole + beside) >= 0;
    free(whole);
    if (!good || text == NULL)
        return good;
    free(*file);
    *file = text;
    return true;
}

bool scene_values_relative_files(scene_values *values, const char *scene_path)
{
    scene_object *objects = values->objects.items;
    char *folder = resolved(scene_path);
    if (folder == NULL)
        return true;
    strrchr(folder, '/')[1] = '\0';
    size_t beside = strlen(folder) - 1;
    while (beside > 0 && folder[beside - 1] != '/')
        beside--;
    beside = beside > 1 ? beside : 0;
    bool good = relative_file(&values->water.spectrum.file, folder, beside);
    for (size_t i = 0; i < values->objects.count; i++)
        good &= relative_file(&objects[i].mesh, folder, beside) && relative_file(&objects[i].heights, folder, beside) &&
                relative_file(&objects[i].material.texture, folder, beside);
    free(folder);
    return good;
}

/* ---- paths ------------------------------------------------------------------------------------------------- */

static const field_row *child_field(const field_row *field, const char *word, size_t length) { return field_find(field->fields, word, length); }

const field_row *scene_values_find(const scene_values *values, const char *path, const void **value)
{
    const field_row *field = scene_root_field();
    const void *at = values;
    for (const char *p = path;;) {
        const size_t length = strcspn(p, ".[");
        field = child_field(field, p, length);
        if (field == NULL)
            return NULL;
        at = field_at(field, at);
        p += length;
        if (*p == '[' && field->type == FIELD_LIST) {
            char *end;
            const scene_list *list = at;
            const unsigned long index = strtoul(p + 1, &end, 10);
            if (end == p + 1 || end[0] != ']' || end[1] != '.' || index >= list->count)
                return NULL;
            at = (const char *)list->items + index * field->item_size;
            p = end + 2;
            continue;
        }
        if (*p == '\0') {
            *value = at;
            return field;
        }
        if (*p++ != '.' || field->type != FIELD_MAPPING)
            return NULL;
    }
}

/* ---- values as text ---------------------------------------------------------------------------------------- */

static bool mappings_equal(const field_row *mapping, const void *left, const void *right);

static bool lists_equal(const field_row *field, const scene_list *left, const scene_list *right)
{
    bool equal = left->count == right->count;
    for (size_t i = 0; equal && i < left->count; i++)
        equal = mappings_equal(field, (const char *)left->items + i * field->item_size, (const char *)right->items + i * field->item_size);
    return equal;
}

/* Of the same field in two parents. */
static bool values_equal(const field_row *field, const void *left_parent, const void *right_parent)
{
    const void *left = field_at(field, left_parent), *right = field_at(field, right_parent);
    if (field->type == FIELD_MAPPING)
        return !(field->flags & FIELD_GIVEN && *(const bool *)left != *(const bool *)right) && mappings_equal(field, left, right);
    if (field->type == FIELD_LIST)
        return lists_equal(field, left, right);
    if (field->type == FIELD_TEXT) {
        const char *a = *(char *const *)left, *b = *(char *const *)right;
        return strcmp(a != NULL ? a : "", b != NULL ? b : "") == 0;
    }
    if (field->type == FIELD_EXPOSURE) {
        const scene_exposure *a = left, *b = right;
        return a->automatic == b->automatic && (a->automatic || a->stops == b->stops);
    }
    return memcmp(left, right, field_size(field)) == 0;
}

static bool mappings_equal(const field_row *mapping, const void *left, const void *right)
{
    bool equal = true;
    for (const field_row *field = mapping->fields; equal && field->key != NULL; field++)
        equal = values_equal(field, left, right);
    return equal;
}

bool scene_values_equal(const scene_values *left, const scene_values *right) { return mappings_equal(scene_root_field(), left, right); }

/* As a double-quoted scalar of JSON, which YAML reads too. */
static void write_text(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (const char *p = text != NULL ? text : ""; *p != '\0'; p++) {
        if (*p == '"' || *p == '\\')
            fprintf(stream, "\\%c", *p);
        else if ((unsigned char)*p < 0x20)
            fprintf(stream, "\\u%04x", (unsigned)*p);
        else
            fputc(*p, stream);
    }
    fputc('"', stream);
}

/* Keys that another one excludes are not written: position and target beside a path, the offset beside an exposure that is a number, what a
 * spectrum or a wind that is none is like. */
static bool is_excluded(const field_row *mapping, const field_row *field, const void *parent)
{
    if (strcmp(mapping->key, "camera") == 0) {
        const scene_camera *camera = parent;
        return camera->path.count > 0 && (strcmp(field->key, "position") == 0 || strcmp(field->key, "target") == 0);
    }
    if (strcmp(mapping->key, "spectrum") == 0)
        return strcmp(field->key, "model") != 0 && ((const scene_spectrum *)parent)->settings.kind == SPECTRUM_NONE;
    if (strcmp(mapping->key, "wind") == 0)
        return strcmp(field->key, "speed") != 0 && !(((const scene_wind *)parent)->speed > 0);
    return strcmp(mapping->key, "post") == 0 && strcmp(field->key, "exposure_offset") == 0 && !((const scene_post *)parent)->exposure.automatic;
}

/* Room for the defaults of any mapping. */
typedef union any_mapping {
    scene_values values;
    scene_camera camera;
    scene_keyframe keyframe;
    scene_swell swell;
    mgt_wave wave;
    mgt_light light;
    scene_object object;
    mgt_quality quality;
} any_mapping;

static size_t mapping_size(const field_row *field)
{
    size_t size = 0;
    for (const field_row *child = field->fields; child->key != NULL; child++) {
        size_t end = child->offset;
        switch (child->type) {
        case FIELD_EXPOSURE:
            end += sizeof(scene_exposure);
            break;
        case FIELD_TEXT:
            end += sizeof(char *);
            break;
        case FIELD_LIST:
            end += sizeof(scene_list);
            break;
        case FIELD_MAPPING:
            end += mapping_size(child);
            break;
        default:
            end += field_size(child);
            break;
        }
        size = end > size ? end : size;
    }
    return size;
}

/* `defaults`: the struct that holds the default, as `parent` holds the value. */
typedef void (*member_writer)(FILE *stream, const field_row *field, const void *parent, const void *defaults, bool first);

static void write_value(FILE *stream, const field_row *field, const void *parent, const void *defaults);

/* Calls `write` for each member of the mapping at `at` that is not at its default; `defaults` are those of the mapping. */
static void write_members(FILE *stream, const field_row *mapping, const void *at, const void *defaults, member_writer write)
{
    any_mapping expected;
    memcpy(&expected, defaults, mapping_size(mapping));
    bool first = true;
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        if (is_excluded(mapping, field, at))
            continue;
        if ((field->flags & FIELD_REQUIRED) || !values_equal(field, at, &expected)) {
            write(stream, field, at, &expected, first);
            first = false;
        }
        if (field->decide != NULL) {
            memcpy((char *)&expected + field->offset, field_at(field, at), field->type == FIELD_MAPPING ? mapping_size(field) : field_size(field));
            field->decide(&expected);
        }
    }
}

static void write_flow_member(FILE *stream, const field_row *field, const void *parent, const void *defaults, bool first)
{
    fprintf(stream, "%s%s: ", first ? "" : ", ", field->key);
    write_value(stream, field, parent, defaults);
}

static void write_list(FILE *stream, const field_row *field, const void *parent)
{
    const scene_list *list = field_at(field, parent);
    fputc('[', stream);
    for (size_t i = 0; i < list->count; i++) {
        any_mapping item;
        field->prepare(parent, &item);
        fputs(i > 0 ? ", {" : "{", stream);
        write_members(stream, field, (const char *)list->items + i * field->item_size, &item, write_flow_member);
        fputc('}', stream);
    }
    fputc(']', stream);
}

static void write_value(FILE *stream, const field_row *field, const void *parent, const void *defaults)
{
    const void *value = field_at(field, parent);
    const scene_exposure *exposure = value;
    if (field_numbers_write(stream, field, value))
        return;
    switch (field->type) {
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        fputs(field_print(field, value).text, stream);
        break;
    case FIELD_EXPOSURE:
        fputs(exposure->automatic ? "auto" : double_text(exposure->stops).text, stream);
        break;
    case FIELD_TEXT:
        write_text(stream, *(char *const *)value);
        break;
    case FIELD_LIST:
        write_list(stream, field, parent);
        break;
    case FIELD_MAPPING:
        fputc('{', stream);
        write_members(stream, field, value, field_at(field, defaults), write_flow_member);
        fputc('}', stream);
        break;
    default:
        break;
    }
}

/* ---- whole files ------------------------------------------------------------------------------------------- */

static void write_inner_member(FILE *stream, const field_row *field, const void *parent, const void *defaults, bool first)
{
    (void)first;
    if (field->type != FIELD_LIST) {
        fprintf(stream, "  %s: ", field->key);
        write_value(stream, field, parent, defaults);
        fputc('\n', stream);
        return;
    }
    const scene_list *list = field_at(field, parent);
    fprintf(stream, "  %s:%s\n", field->key, list->count == 0 ? " []" : "");
    for (size_t i = 0; i < list->count; i++) {
        any_mapping item;
        field->prepare(parent, &item);
        fputs("    - {", stream);
        write_members(stream, field, (const char *)list->items + i * field->item_size, &item, write_flow_member);
        fputs("}\n", stream);
    }
}

static void write_outer_member(FILE *stream, const field_row *field, const void *parent, const void *defaults, bool first)
{
    (void)first;
    fprintf(stream, "%s:", field->key);
    if (field->type != FIELD_MAPPING) {
        fputc(' ', stream);
        write_value(stream, field, parent, defaults);
        fputc('\n', stream);
        return;
    }
    fputc('\n', stream);
    write_members(stream, field, field_at(field, parent), field_at(field, defaults), write_inner_member);
}

bool scene_values_write(FILE *stream, const scene_values *values)
{
    const scene_values defaults = scene_values_defaults();
    write_members(stream, scene_root_field(), values, &defaults, write_outer_member);
    return fflush(stream) == 0 && !ferror(stream);
}

/* ---- words ------------------------------------------------------------------------------------------------- */

static bool add_word(scene_overrides *out, const char *path, const field_row *field, const void *parent, const void *defaults)
{
    char **words = realloc(out->words, (out->count + 1) * sizeof *words);
    if (words == NULL)
        return false;
    out->words = words;
    words[out->count] = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&words[out->count], &size);
    if (stream == NULL)
        return false;
    fprintf(stream, "%s=", path);
    write_value(stream, field, parent, defaults);
    const bool bad = ferror(stream) != 0;
    out->count++;
    return fclose(stream) == 0 && !bad;
}

/* A whole item of a list, whatever form the file has it in. */
static bool add_item(scene_overrides *out, const char *path, const field_row *field, const void *item, const void *defaults)
{
    field_row whole = *field;
    whole.type = FIELD_MAPPING;
    whole.offset = 0;
    return add_word(out, path, &whole, item, defaults);
}

/* Where single members would leave a file that contradicts itself, or defaults that another key decides, the whole mapping is written. */
static bool needs_whole(const field_row *field, const void *from, const void *to)
{
    if (strcmp(field->key, "camera") == 0)
        return ((const scene_camera *)from)->path.count == 0 && ((const scene_camera *)to)->path.count > 0;
    if (strcmp(field->key, "light") == 0)
        return ((const mgt_light *)from)->body != ((const mgt_light *)to)->body;
    return strcmp(field->key, "post") == 0 && ((const scene_post *)from)->exposure.automatic != ((const scene_post *)to)->exposure.automatic;
}

/* Marks the fields that a mapping `field`, which differs, decides otherwise in `to` than in `from`. */
static uint64_t decided_by(const field_row *mapping, const field_row *field, const void *from, const void *to, const void *defaults)
{
    any_mapping old, new;
    uint64_t marks = 0;
    memcpy(&old, defaults, mapping_size(mapping));
    memcpy(&new, defaults, mapping_size(mapping));
    memcpy((char *)&old + field->offset, field_at(field, from), mapping_size(field));
    memcpy((char *)&new + field->offset, field_at(field, to), mapping_size(field));
    field->decide(&old);
    field->decide(&new);
    for (size_t i = 0; mapping->fields[i].key != NULL; i++)
        if (&mapping->fields[i] != field && !values_equal(&mapping->fields[i], &old, &new))
            marks |= (uint64_t)1 << i;
    return marks;
}

static bool add_differences(scene_overrides *out, const char *path, const field_row *mapping, const void *from, const void *to, const void *defaults)
{
    uint64_t decided = 0;
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        char name[PATH_SIZE];
        snprintf(name, sizeof name, "%s%s%s", path, path[0] != '\0' ? "." : "", field->key);
        const bool equal = values_equal(field, from, to), is_decided = decided >> (field - mapping->fields) & 1;
        if ((equal && !is_decided) || is_excluded(mapping, field, to))
            continue;
        if (field->decide != NULL && field->type == FIELD_MAPPING)
            decided |= decided_by(mapping, field, from, to, defaults);
        const void *left = field_at(field, from), *right = field_at(field, to);
        const scene_list *left_list = left, *right_list = right;
        bool good = true;
        if (is_decided) {
            const field_row *const inner = field->type == FIELD_MAPPING ? field->fields : NULL;
            for (const field_row *f = inner; good && f != NULL && f->key != NULL; f++) {
                char key[PATH_SIZE + 32];
                snprintf(key, sizeof key, "%s.%s", name, f->key);
                good = add_word(out, key, f, right, field_at(field, defaults));
            }
            if (inner == NULL)
                good = add_word(out, name, field, to, defaults);
        } else if (field->type == FIELD_MAPPING && !needs_whole(field, left, right)) {
            good = add_differences(out, name, field, left, right, field_at(field, defaults));
        } else if (field->type == FIELD_LIST && left_list->count == right_list->count) {
            for (size_t i = 0; good && i < left_list->count; i++) {
                char item[PATH_SIZE];
                any_mapping expected;
                field->prepare(to, &expected);
                snprintf(item, sizeof item, "%.60s[%zu]", name, i);
                const char *old = (const char *)left_list->items + i * field->item_size, *new = (const char *)right_list->items + i * field->item_size;
                if (!left_list->otherwise)
                    good = add_differences(out, item, field, old, new, &expected);
                else if (!mappings_equal(field, old, new))
                    good = add_item(out, item, field, new, &expected);
            }
        } else {
            good = add_word(out, name, field, to, defaults);
        }
        if (!good)
            return false;
    }
    return true;
}

/* Whether `to` holds the waves of `from` written out, all that its spectrum made. */
static bool is_written_out(const scene_values *from, const scene_values *to)
{
    const field_row *water = child_field(scene_root_field(), "water", 5), *waves = child_field(water, "waves", 5);
    return scene_water_has_sea(&from->water) && !scene_water_has_sea(&to->water) && lists_equal(waves, &from->water.sea, &to->water.waves);
}

bool scene_overrides_between(const scene_values *from, const scene_values *to, scene_overrides *out)
{
    const scene_values defaults = scene_values_defaults();
    scene_values goal = *to; /* borrows */
    *out = (scene_overrides){0};
    if (is_written_out(from, to)) {
        goal.water.waves = from->water.waves;
        goal.water.spectrum = from->water.spectrum;
        goal.water.wind = from->water.wind;
        goal.water.swell = from->water.swell;
        goal.water.height = from->water.height;
        if (scene_values_aerial(to) == scene_values_aerial(from))
            goal.sky.aerial = from->sky.aerial;
        if (scene_values_by_night(to, to->sky.stars) == scene_values_by_night(from, from->sky.stars))
            goal.sky.stars = from->sky.stars;
        if (scene_values_by_night(to, to->post.night_tint) == scene_values_by_night(from, from->post.night_tint))
            goal.post.night_tint = from->post.night_tint;
        if (goal.water.foam.amount == 0 && goal.water.foam.share == scene_water_foam(&from->water)) {
            goal.water.foam.amount = from->water.foam.amount;
            goal.water.foam.share = from->water.foam.share;
        }
    }
    if (add_differences(out, "", scene_root_field(), from, &goal, &defaults))
        return true;
    scene_overrides_free(out);
    return false;
}

void scene_overrides_free(scene_overrides *overrides)
{
    for (size_t i = 0; i < overrides->count; i++)
        free(overrides->words[i]);
    free(overrides->words);
    *overrides = (scene_overrides){0};
}
