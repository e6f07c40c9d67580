/* SPDX-License-Identifier: MIT
 *
 * From a tree of YAML nodes to scene values: keys, types and ranges, as the field table says.
 */
#include "scene/scene_read.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FIELDS = 64 };

typedef struct scene_reader {
    const scene_tree *tree;
    scene_error *error;
    char path[128]; /* "water.waves[3].amplitude", for messages */
} scene_reader;

/* ---- messages ------------------------------------------------------------------------------------------- */

/* "elevation_deg is …; allowed: …": the one shape of all messages about values. */
static bool refuse_value(const scene_reader *reader, const field_row *field, const tree_node *node)
{
    char allowed[240], value[128];
    scene_quote quote = scene_quote_text(node->text != NULL ? node->text : "", node->length);
    field_allowed_text(field, allowed, sizeof allowed);
    switch (node->kind) {
    case TREE_NULL:
        snprintf(value, sizeof value, "empty");
        break;
    case TREE_LIST:
        snprintf(value, sizeof value, "a list of %zu", node->count);
        break;
    case TREE_MAPPING:
        snprintf(value, sizeof value, "a mapping");
        break;
    case TREE_SCALAR:
        snprintf(value, sizeof value, node->plain ? "%s" : "the text \"%s\"", quote.text);
        break;
    }
    bool may_go = node->kind == TREE_NULL && node->key != NULL && !(field->flags & FIELD_REQUIRED);
    return tree_error(reader->tree, node->source, node->place, reader->error, "%s is %s; allowed: %s%s", reader->path[0] != '\0' ? reader->path : "the scene",
                      value, allowed, may_go ? ", or no such key" : "");
}

/* How far a key is from a known one; a known one's beginning counts as near ("elevation" for "elevation_deg"). */
static size_t key_distance(const char *key, const char *known)
{
    size_t length = strlen(key), distance = scene_edit_distance(key, length, known);
    if (length >= 3 && strncmp(key, known, length) == 0)
        return 1;
    return 2 * distance < strlen(known) ? distance : SIZE_MAX;
}

/* The known keys of one table, and the one nearest to a key. */
typedef struct known_keys {
    char list[480], hint[64];
    size_t used, nearest;
} known_keys;

static void add_known(known_keys *known, const char *key, const field_row *fields)
{
    for (const field_row *field = fields; field->key != NULL; field++) {
        const char *const names[] = {field->key, field->alias};
        for (int i = 0; i < 2 && names[i] != NULL; i++) {
            size_t distance = key_distance(key, names[i]);
            if (distance < known->nearest) {
                known->nearest = distance;
                snprintf(known->hint, sizeof known->hint, "did you mean \"%s\"? ", names[i]);
            }
        }
        if (known->used < sizeof known->list)
            known->used += (size_t)snprintf(known->list + known->used, sizeof known->list - known->used, "%s%s",
                                            known->used == 0  ? ""
                                            : field == fields ? "; or "
                                                              : ", ",
                                            field->key);
    }
}

static bool refuse_unknown_key(const scene_reader *reader, const field_row *mapping, const tree_node *node)
{
    known_keys known = {.nearest = 3}; /* further than two edits is no slip of the finger */
    add_known(&known, node->key, mapping->fields);
    if (mapping->other != NULL)
        add_known(&known, node->key, mapping->other->fields);
    scene_quote quote = scene_quote_text(node->key, strlen(node->key));
    return tree_error(reader->tree, node->key_source, node->key_place, reader->error, "unknown key \"%s\" in %s; %sallowed: %s", quote.text,
                      reader->path[0] != '\0' ? reader->path : "the scene", known.hint, known.list);
}

static size_t path_enter(scene_reader *reader, const char *key)
{
    size_t length = strlen(reader->path);
    snprintf(reader->path + length, sizeof reader->path - length, "%s%s", length > 0 ? "." : "", key);
    return length;
}

static size_t path_enter_item(scene_reader *reader, size_t index)
{
    size_t length = strlen(reader->path);
    snprintf(reader->path + length, sizeof reader->path - length, "[%zu]", index);
    return length;
}

static void path_leave(scene_reader *reader, size_t length) { reader->path[length] = '\0'; }

/* ---- numbers -------------------------------------------------------------------------------------------- */

/* A number in the field's range. */
static bool read_number(const scene_reader *reader, const field_row *field, const tree_node *node, double *value)
{
    return (node->kind == TREE_SCALAR && node->plain && number_read(node->text, value) && field_in_range(field, *value)) || refuse_value(reader, field, node);
}

/* ---- values --------------------------------------------------------------------------------------------- */

static bool read_vector(scene_reader *reader, const field_row *field, const tree_node *node, double vector[3])
{
    if (node->kind != TREE_LIST || node->count != 3)
        return refuse_value(reader, field, node);
    field_row component = *field;
    component.type = FIELD_NUMBER;
    const tree_node *item = node->first;
    for (size_t i = 0; i < 3; i++, item = item->next) {
        size_t length = path_enter_item(reader, i);
        if (!read_number(reader, &component, item, &vector[i]))
            return false;
        path_leave(reader, length);
    }
    return true;
}

static bool read_scale(scene_reader *reader, const field_row *field, const tree_node *node, double scale[3])
{
    if (node->kind == TREE_LIST)
        return read_vector(reader, field, node, scale);
    if (!read_number(reader, field, node, &scale[0]))
        return false;
    scale[1] = scale[2] = scale[0];
    return true;
}

/* A single number, choice or switch. Words may be quoted, numbers not. */
static bool read_single(const scene_reader *reader, const field_row *field, const tree_node *node, void *value)
{
    return (node->kind == TREE_SCALAR && (node->plain || field->choices) && field_parse(field, node->text, value)) || refuse_value(reader, field, node);
}

static bool read_text(const scene_reader *reader, const field_row *field, const tree_node *node, char **text)
{
    if (node->kind != TREE_SCALAR)
        return refuse_value(reader, field, node);
    char *copy = strdup(node->text);
    if (copy == NULL)
        return scene_error_memory(reader->error);
    free(*text);
    *text = copy;
    return true;
}

static bool read_exposure(const scene_reader *reader, const field_row *field, const tree_node *node, scene_exposure *exposure)
{
    if (node->kind == TREE_SCALAR && strcmp(node->text, "auto") == 0) {
        *exposure = (scene_exposure){.automatic = true};
        return true;
    }
    exposure->automatic = false;
    return read_number(reader, field, node, &exposure->stops);
}

static bool read_mapping(scene_reader *reader, const field_row *field, const tree_node *node, void *values);

/* The first of a mapping's keys that is in one table and not in another; NULL: none. */
static const tree_node *key_of_one(const tree_node *mapping, const field_row *one, const field_row *another)
{
    if (mapping->kind == TREE_MAPPING)
        for (const tree_node *child = mapping->first; child != NULL; child = child->next) {
            const size_t length = strlen(child->key);
            if (field_find(one, child->key, length) != NULL && field_find(another, child->key, length) == NULL)
                return child;
        }
    return NULL;
}

static bool is_before(scene_place left, scene_place right) { return left.line != right.line ? left.line < right.line : left.column < right.column; }

/* Keys of both forms in one item: the later one is at fault. */
static bool refuse_forms(const scene_reader *reader, const field_row *field, const tree_node *own, const tree_node *other)
{
    char keys[160] = "";
    size_t used = 0;
    for (const field_row *row = field->other->fields; row->key != NULL && used < sizeof keys; row++)
        used += (size_t)snprintf(keys + used, sizeof keys - used, "%s%s", used > 0 ? ", " : "", row->key);
    const bool own_last = own->key_source != NULL || (other->key_source == NULL && is_before(other->key_place, own->key_place));
    const tree_node *last = own_last ? own : other, *first = own_last ? other : own;
    return tree_error(reader->tree, last->key_source, last->key_place, reader->error,
                      "%s.%s stands beside %s, which is of another form; allowed: one form, the other one is %s", reader->path, last->key, first->key, keys);
}

/* An item of a list, in either of its forms. */
static bool read_item(scene_reader *reader, const field_row *field, const tree_node *node, scene_list *list, void *item)
{
    const field_form *form = field->other;
    const tree_node *other = form != NULL ? key_of_one(node, form->fields, field->fields) : NULL;
    if (other == NULL)
        return read_mapping(reader, field, node, item);
    const tree_node *own = key_of_one(node, field->fields, form->fields);
    if (own != NULL)
        return refuse_forms(reader, field, own, other);
    union {
        max_align_t align;
        char bytes[FORM_SIZE];
    } values;
    field_row rows = *field;
    rows.fields = form->fields;
    rows.other = NULL;
    form->prepare(&values);
    if (!read_mapping(reader, &rows, node, &values))
        return false;
    form->convert(&values, item);
    list->otherwise = true;
    return true;
}

static bool read_list(scene_reader *reader, const field_row *field, const tree_node *node, void *parent)
{
    scene_list *list = (scene_list *)((char *)parent + field->offset);
    if (node->kind != TREE_LIST)
        return refuse_value(reader, field, node);
    if (node->count > field->max_items)
        return tree_error(reader->tree, node->source, node->place, reader->error, "%s has %zu items; allowed: at most %zu", reader->path, node->count,
                          field->max_items);
    if (node->count == 0)
        return true;
    list->items = calloc(node->count, field->item_size);
    if (list->items == NULL)
        return scene_error_memory(reader->error);
    list->count = node->count;
    const tree_node *child = node->first;
    for (size_t i = 0; i < list->count; i++, child = child->next) {
        void *item = (char *)list->items + i * field->item_size;
        size_t length = path_enter_item(reader, i);
        field->prepare(parent, item);
        if (!read_item(reader, field, child, list, item))
            return false;
        path_leave(reader, length);
    }
    return true;
}

static bool read_field(scene_reader *reader, const field_row *field, const tree_node *node, void *parent)
{
    void *place = (char *)parent + field->offset;
    double vector[3];
    switch (field->type) {
    case FIELD_COUNT:
    case FIELD_LARGE:
    case FIELD_NUMBER:
    case FIELD_FLOAT:
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        if (field->also != NULL)
            return (node->kind == TREE_SCALAR && field->also->read(node->text, parent)) || refuse_value(reader, field, node);
        return read_single(reader, field, node, place);
    case FIELD_COLOR:
        if (!read_vector(reader, field, node, vector))
            return false;
        for (int i = 0; i < 3; i++)
            ((float *)place)[i] = (float)vector[i];
        return true;
    case FIELD_VECTOR:
        return read_vector(reader, field, node, place);
    case FIELD_SCALE:
        return read_scale(reader, field, node, place);
    case FIELD_EXPOSURE:
        return read_exposure(reader, field, node, place);
    case FIELD_TEXT:
        return read_text(reader, field, node, place);
    case FIELD_MAPPING:
        if (field->flags & FIELD_SHORT && node->kind == TREE_SCALAR)
            return (node->plain && field_parse(field->fields, node->text, (char *)place + field->fields->offset)) || refuse_value(reader, field, node);
        if (field->flags & FIELD_GIVEN)
            *(bool *)place = true;
        return read_mapping(reader, field, node, place);
    case FIELD_LIST:
        return read_list(reader, field, node, parent);
    }
    return false;
}

/* Which field each child is; refuses unknown and repeated keys, in the order of the file. */
static bool match_keys(const scene_reader *reader, const field_row *mapping, const tree_node *node, const tree_node *found[MAX_FIELDS])
{
    for (const tree_node *child = node->first; child != NULL; child = child->next) {
        const field_row *field = field_find(mapping->fields, child->key, strlen(child->key));
        if (field == NULL)
            return refuse_unknown_key(reader, mapping, child);
        const ptrdiff_t index = field - mapping->fields;
        if (found[index] != NULL && strcmp(found[index]->key, child->key) != 0)
            return tree_error(reader->tree, child->key_source, child->key_place, reader->error,
                              "key \"%s\" stands beside \"%s\" at line %d, column %d; \"%s\" is the new name of \"%s\"; allowed: one of them", child->key,
                              found[index]->key, found[index]->key_place.line, found[index]->key_place.column, field->alias, field->key);
        if (found[index] != NULL)
            return tree_error(reader->tree, child->key_source, child->key_place, reader->error,
                              "key \"%s\" stands twice, first at line %d, column %d; allowed: once", child->key, found[index]->key_place.line,
                              found[index]->key_place.column);
        found[index] = child;
    }
    return true;
}

static bool read_mapping(scene_reader *reader, const field_row *mapping, const tree_node *node, void *values)
{
    const tree_node *found[MAX_FIELDS] = {0};
    if (node->kind != TREE_MAPPING) {
        field_row item = *mapping;
        item.type = FIELD_MAPPING;
        return refuse_value(reader, &item, node);
    }
    if (!match_keys(reader, mapping, node, found))
        return false;
    for (size_t i = 0; mapping->fields[i].key != NULL; i++) {
        const field_row *field = &mapping->fields[i];
        size_t length = path_enter(reader, found[i] != NULL ? found[i]->key : field->key);
        if (found[i] == NULL && field->flags & FIELD_REQUIRED) {
            char allowed[240];
            field_allowed(field, allowed, sizeof allowed);
            return tree_error(reader->tree, node->source, node->place, reader->error, "%s is missing; required: %s: %s", reader->path, field->key, allowed);
        }
        if (found[i] != NULL) {
            if (!read_field(reader, field, found[i], values))
                return false;
            if (field->decide != NULL && field->also == NULL)
                field->decide(values);
        }
        path_leave(reader, length);
    }
    return true;
}

bool scene_read(const scene_tree *tree, scene_values *values, scene_error *error)
{
    scene_reader reader = {.tree = tree, .error = error};
    if (!read_mapping(&reader, scene_root_field(), tree->root, values))
        return false;
    /* A material replaces those of a file; where there is none it says nothing that it is there. */
    scene_object *objects = values->objects.items;
    for (size_t i = 0; i < values->objects.count; i++)
        objects[i].material.given &= objects[i].shape == SHAPE_MESH;
    return true;
}
