/* SPDX-License-Identifier: MIT
 *
 * The format described by its own table: as a JSON Schema, and as the tables of the documentation.
 */
#include <stdio.h>
#include <string.h>

#include "scene/scene_fields.h"

/* Room for the defaults of an item of any list. */
typedef union scene_list_item {
    mgt_wave wave;
    scene_keyframe keyframe;
    scene_swell swell;
    scene_pose pose;
    scene_object object;
    char form[FORM_SIZE];
} scene_list_item;

/* The rows of the other form of a list's items, and their defaults. */
static field_row other_form(const field_row *field, scene_list_item *item)
{
    field_row rows = *field;
    rows.fields = field->other->fields;
    rows.other = NULL;
    memset(item, 0, sizeof *item);
    field->other->prepare(item);
    return rows;
}

/* ---- defaults ------------------------------------------------------------------------------------------- */

/* A field's default as JSON, which is YAML too: "30", "[0, 4, 0]", "\"sun\"". Empty where it has none. */
static void write_default(FILE *stream, const field_row *field, const void *value)
{
    const scene_exposure *exposure = value;
    if (field_numbers_write(stream, field, value))
        return;
    switch (field->type) {
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        fprintf(stream, "\"%s\"", field_print(field, value).text);
        break;
    case FIELD_EXPOSURE:
        if (exposure->automatic)
            fputs("\"auto\"", stream);
        else
            fputs(double_text(exposure->stops).text, stream);
        break;
    case FIELD_TEXT:
        fputs("\"\"", stream);
        break;
    case FIELD_LIST:
        fputs("[]", stream);
        break;
    default:
        break;
    }
}

static bool has_default(const field_row *field) { return !(field->flags & FIELD_REQUIRED) && field->type != FIELD_MAPPING; }

/* ---- JSON Schema ---------------------------------------------------------------------------------------- */

static void write_text(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (; *text != '\0'; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', stream);
        fputc(*text, stream);
    }
    fputc('"', stream);
}

static const char *type_word(const field_row *field) { return field->type == FIELD_COUNT || field->type == FIELD_LARGE ? "integer" : "number"; }

static void write_range(FILE *stream, const field_row *field)
{
    fprintf(stream, "\"%s\": %s, \"%s\": %s", field->flags & FIELD_OPEN_MIN ? "exclusiveMinimum" : "minimum", double_text(field->min).text,
            field->flags & FIELD_OPEN_MAX ? "exclusiveMaximum" : "maximum", double_text(field->max).text);
}

static void write_number_schema(FILE *stream, const field_row *field)
{
    fprintf(stream, "{\"type\": \"%s\", ", type_word(field));
    write_range(stream, field);
    fputs("}", stream);
}

static void write_vector_schema(FILE *stream, const field_row *field)
{
    fputs("\"type\": \"array\", \"minItems\": 3, \"maxItems\": 3, \"items\": ", stream);
    write_number_schema(stream, field);
}

static void indent(FILE *stream, int depth) { fprintf(stream, "%*s", 2 * depth, ""); }

/* `values`: the struct that holds the mapping's defaults. */
static void write_mapping_schema(FILE *stream, const field_row *mapping, const void *values, int depth);

/* What the items of a list may be. */
static void write_items_schema(FILE *stream, const field_row *field, const void *parent, int depth)
{
    scene_list_item item;
    memset(&item, 0, sizeof item);
    field->prepare(parent, &item);
    if (field->other == NULL) {
        write_mapping_schema(stream, field, &item, depth);
        return;
    }
    fputs("\"oneOf\": [{", stream);
    write_mapping_schema(stream, field, &item, depth);
    fputs("}, {", stream);
    const field_row rows = other_form(field, &item);
    write_mapping_schema(stream, &rows, &item, depth);
    fputs("}]", stream);
}

static void write_type_schema(FILE *stream, const field_row *field, const void *value, const void *parent, int depth)
{
    double number;
    switch (field->type) {
    case FIELD_COUNT:
    case FIELD_LARGE:
    case FIELD_NUMBER:
    case FIELD_FLOAT:
        if (field->min == field->max) {
            fprintf(stream, "\"const\": %s", double_text(field->min).text);
            break;
        }
        if (field->flags & FIELD_OR_ZERO && field->min > 0) {
            fputs("\"oneOf\": [{\"const\": 0}, ", stream);
            write_number_schema(stream, field);
            fputs("]", stream);
            break;
        }
        fprintf(stream, "\"type\": \"%s\", ", type_word(field));
        write_range(stream, field);
        break;
    case FIELD_VECTOR:
    case FIELD_COLOR:
        write_vector_schema(stream, field);
        break;
    case FIELD_SCALE:
        fputs("\"oneOf\": [", stream);
        write_number_schema(stream, field);
        fputs(", {", stream);
        write_vector_schema(stream, field);
        fputs("}]", stream);
        break;
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        fputs(field->also != NULL ? "\"anyOf\": [{" : "", stream);
        for (int i = 0; field_word(field, i) != NULL; i++) {
            fprintf(stream, "%s\"%s\"", i == 0 ? "\"enum\": [" : ", ", field_word(field, i));
            if (field_word_alias(field, i))
                fprintf(stream, ", \"%s\"", field_word_alias(field, i));
            if (number_read(field_word(field, i), &number)) /* YAML and JSON may leave the quotes out */
                fprintf(stream, ", %s", field_word(field, i));
        }
        fputs(field->type == FIELD_SWITCH ? ", false, true]" : "]", stream);
        if (field->also != NULL)
            fprintf(stream, "}, {\"type\": \"string\", \"pattern\": \"%s\"}]", field->also->pattern);
        break;
    case FIELD_EXPOSURE:
        fputs("\"oneOf\": [{\"const\": \"auto\"}, ", stream);
        write_number_schema(stream, field);
        fputs("]", stream);
        break;
    case FIELD_TEXT:
        fputs("\"type\": [\"string\", \"number\", \"boolean\"]", stream);
        break;
    case FIELD_MAPPING:
        if (!(field->flags & FIELD_SHORT)) {
            write_mapping_schema(stream, field, value, depth);
            break;
        }
        fputs("\"oneOf\": [{", stream);
        write_type_schema(stream, field->fields, field_at(field->fields, value), value, depth);
        fputs("}, {", stream);
        write_mapping_schema(stream, field, value, depth);
        fputs("}]", stream);
        break;
    case FIELD_LIST:
        fprintf(stream, "\"type\": \"array\", \"maxItems\": %zu,\n", field->max_items);
        indent(stream, depth);
        fputs("\"items\": {\n", stream);
        indent(stream, depth + 1);
        write_items_schema(stream, field, parent, depth + 1);
        fputs("\n", stream);
        indent(stream, depth);
        fputs("}", stream);
        break;
    }
}

/* A key of its own; the older one beside it is refused by write_exclusions(). */
static void write_alias_schema(FILE *stream, const field_row *field, const void *values, int depth)
{
    fputs(",\n", stream);
    indent(stream, depth);
    fprintf(stream, "\"%s\": {\n", field->alias);
    indent(stream, depth + 1);
    fprintf(stream, "\"description\": \"the new name of %s\",\n", field->key);
    indent(stream, depth + 1);
    write_type_schema(stream, field, field_at(field, values), values, depth + 1);
    fputs("\n", stream);
    indent(stream, depth);
    fputs("}", stream);
}

/* No key stands beside its new name. */
static void write_exclusions(FILE *stream, const field_row *mapping)
{
    const char *separator = " \"not\": {\"anyOf\": [";
    for (const field_row *field = mapping->fields; field->key != NULL; field++)
        if (field->alias != NULL) {
            fprintf(stream, "%s{\"required\": [\"%s\", \"%s\"]}", separator, field->key, field->alias);
            separator = ", ";
        }
    if (separator[0] == ',')
        fputs("]},", stream);
}

static void write_mapping_schema(FILE *stream, const field_row *mapping, const void *values, int depth)
{
    const char *separator = " \"required\": [";
    fputs("\"type\": \"object\", \"additionalProperties\": false,", stream);
    for (const field_row *field = mapping->fields; field->key != NULL; field++)
        if (field->flags & FIELD_REQUIRED) {
            fprintf(stream, "%s\"%s\"", separator, field->key);
            separator = ", ";
        }
    fputs(separator[0] == ',' ? "]," : "", stream);
    write_exclusions(stream, mapping);
    fputs("\n", stream);
    indent(stream, depth);
    fputs("\"properties\": {\n", stream);
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        const void *value = field_at(field, values);
        indent(stream, depth + 1);
        fprintf(stream, "\"%s\": {\n", field->key);
        indent(stream, depth + 2);
        fputs("\"description\": ", stream);
        char text[512], meaning[400];
        field_meaning(mapping->fields, field, meaning, sizeof meaning);
        snprintf(text, sizeof text, "%s%s%s%s", meaning, field->unit != NULL ? " [" : "", field->unit != NULL ? field->unit : "",
                 field->unit != NULL ? "]" : "");
        write_text(stream, text);
        fputs(",\n", stream);
        indent(stream, depth + 2);
        if (has_default(field)) {
            fputs("\"default\": ", stream);
            write_default(stream, field, value);
            fputs(",\n", stream);
            indent(stream, depth + 2);
        }
        write_type_schema(stream, field, value, values, depth + 2);
        fputs("\n", stream);
        indent(stream, depth + 1);
        fputs("}", stream);
        if (field->alias != NULL)
            write_alias_schema(stream, field, values, depth + 1);
        fputs(field[1].key != NULL ? ",\n" : "\n", stream);
    }
    indent(stream, depth);
    fputs("}", stream);
}

bool scene_schema_write(FILE *stream)
{
    const scene_values defaults = scene_values_defaults();
    fputs("{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n  \"title\": \"Mangata scene\",\n  ", stream);
    write_mapping_schema(stream, scene_root_field(), &defaults, 1);
    fputs("\n}\n", stream);
    return fflush(stream) == 0 && !ferror(stream);
}

/* ---- tables of the documentation ------------------------------------------------------------------------- */

static void write_table(FILE *stream, const char *path, const field_row *mapping, const void *values);

/* The rows of a list's items, and those of their other form that are not the same. */
static void write_items(FILE *stream, const char *path, const field_row *field, const void *parent)
{
    scene_list_item item;
    memset(&item, 0, sizeof item);
    field->prepare(parent, &item);
    write_table(stream, path, field, &item);
    if (field->other == NULL)
        return;
    const field_row rows = other_form(field, &item);
    for (const field_row *row = rows.fields; row->key != NULL; row++)
        if (field_find(field->fields, row->key, strlen(row->key)) == NULL) {
            const field_row single[] = {*row, {0}};
            const field_row one = {.fields = single};
            write_table(stream, path, &one, &item);
        }
}

static void write_table(FILE *stream, const char *path, const field_row *mapping, const void *values)
{
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        const void *value = field_at(field, values);
        char name[64], allowed[200], meaning[400];
        snprintf(name, sizeof name, "%s%s%s", path, path[0] != '\0' ? "." : "", field->key);
        if (field->type == FIELD_MAPPING) {
            write_table(stream, name, field, value);
            continue;
        }
        field_allowed_text(field, allowed, sizeof allowed);
        fprintf(stream, "| `%s` | %s | ", name, allowed);
        if (has_default(field)) {
            fputs("`", stream);
            write_default(stream, field, value);
            fputs("`", stream);
        } else {
            fputs("required", stream);
        }
        field_meaning(mapping->fields, field, meaning, sizeof meaning);
        fprintf(stream, " | %s |\n", meaning);
        if (field->type == FIELD_LIST) {
            snprintf(name + strlen(name), sizeof name - strlen(name), "[]");
            write_items(stream, name, field, values);
        }
    }
}

bool scene_reference_write(FILE *stream)
{
    const scene_values defaults = scene_values_defaults();
    fputs("| key | allowed | default | meaning |\n|---|---|---|---|\n", stream);
    write_table(stream, "", scene_root_field(), &defaults);
    return fflush(stream) == 0 && !ferror(stream);
}
