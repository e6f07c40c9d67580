/* SPDX-License-Identifier: MIT
 *
 * Overrides, "key=value", written into a scene's tree before it is read.
 */
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_fields.h"
#include "scene/scene_read.h"

/* One step of a key's path: a word, or an index in brackets. */
typedef struct path_step {
    const char *word; /* not terminated; NULL: an index */
    size_t length, index;
} path_step;

/* Takes the next step of "light.radiance[1]" from *text; false where it is malformed. */
static bool next_step(const char **text, const char *end, bool first, path_step *step)
{
    const char *at = *text;
    if (*at == '[' && !first) {
        char *close;
        if (!isdigit((unsigned char)at[1]))
            return false;
        unsigned long long index = strtoull(at + 1, &close, 10);
        if (*close != ']' || close - at > 10)
            return false;
        *step = (path_step){.index = (size_t)index};
        *text = close + 1;
        return true;
    }
    if (!first && *at++ != '.')
        return false;
    const char *word = at;
    while (at < end && (isalnum((unsigned char)*at) || *at == '_'))
        at++;
    *step = (path_step){.word = word, .length = (size_t)(at - word)};
    *text = at;
    return at > word;
}

static bool refuse_form(const char *override, scene_error *error)
{
    scene_quote quote = scene_quote_text(override, strlen(override));
    return scene_error_set(error, SCENE_ERROR_BAD_OVERRIDE,
                           "--set %s: not of the form key=value; allowed: such as light.elevation_deg=3, "
                           "water.waves[0].amplitude=0.1, camera.position=[0, 5, 0]",
                           quote.text);
}

/* The step asks for another kind of value than the scene has there. */
static bool refuse_step(const scene_tree *tree, const char *override, const tree_node *node, scene_error *error)
{
    const char *name = node->key != NULL ? node->key : "the item";
    switch (node->kind) {
    case TREE_LIST:
        return tree_error(tree, override, node->place, error, "%s is a list; allowed: an index, as in %s[0]", name, name);
    case TREE_MAPPING:
        return tree_error(tree, override, node->place, error, "%s is a mapping; allowed: a key, as in %s.key", name, name);
    default:
        return tree_error(tree, override, node->place, error, "%s is a single value; allowed: %s=value", name, name);
    }
}

/* The child that has the other name of the same key; NULL: none, or the key has one name. */
static tree_node *child_by_other_name(const tree_node *node, const field_row *field, const char *word)
{
    if (field == NULL || field->alias == NULL)
        return NULL;
    return tree_get(node, field_is_alias(field, word, strlen(word)) ? field->key : field->alias);
}

/* The child that a step names, made where it is missing. `field`: its row; NULL: an index, or no known key. */
static tree_node *take_step(scene_tree *tree, tree_node *node, const path_step *step, const field_row *field, const char *override, scene_error *error)
{
    tree_kind wanted = step->word != NULL ? TREE_MAPPING : TREE_LIST;
    if (node->kind == TREE_NULL) {
        node->kind = wanted;
        node->source = override;
    }
    if (node->kind != wanted) {
        refuse_step(tree, override, node, error);
        return NULL;
    }
    char *word = NULL;
    tree_node *child;
    if (step->word != NULL) {
        word = tree_copy_text(tree, step->word, step->length);
        if (word == NULL)
            goto memory;
        child = tree_get(node, word);
        tree_node *other = child == NULL ? child_by_other_name(node, field, word) : NULL;
        if (other != NULL && other->source != NULL) {
            scene_quote quote = scene_quote_text(other->source, strlen(other->source));
            tree_error(tree, override, node->place, error,
                       "key \"%s\" stands beside \"%s\" of --set %s; \"%s\" is the new name of \"%s\"; allowed: one of them", word, other->key, quote.text,
                       field->alias, field->key);
            return NULL;
        }
        if (other != NULL) {
            other->key = word;
            child = other;
        }
    } else {
        child = tree_at(node, step->index);
        if (child == NULL && step->index > node->count) {
            tree_error(tree, override, node->place, error, "%s has %zu items; allowed: an index from 0 to %zu (which appends)",
                       node->key != NULL ? node->key : "the list", node->count, node->count);
            return NULL;
        }
    }
    if (child != NULL)
        return child;
    child = tree_add_node(tree, TREE_NULL, node->place, override);
    if (child == NULL)
        goto memory;
    child->key = word;
    tree_append(node, child);
    if (word == NULL)
        node->source = override; /* which has made the list longer */
    return child;

memory:
    scene_error_memory(error);
    return NULL;
}

/* "wind: 12" as "wind: {speed: 12}", so that a step finds its key. False when memory runs out. */
static bool spell_out(scene_tree *tree, tree_node *node, const field_row *field)
{
    if (field == NULL || !(field->flags & FIELD_SHORT) || node->kind != TREE_SCALAR)
        return true;
    tree_node *value = tree_add_node(tree, TREE_SCALAR, node->place, node->source);
    if (value == NULL)
        return false;
    *value = *node;
    value->key = field->fields->key;
    value->key_place = node->place;
    value->key_source = node->source;
    value->next = NULL;
    node->kind = TREE_MAPPING;
    node->text = NULL;
    node->length = 0;
    node->first = node->last = NULL;
    node->count = 0;
    tree_append(node, value);
    return true;
}

bool scene_override_apply(scene_tree *tree, const char *override, scene_error *error)
{
    const char *equals = override != NULL ? strchr(override, '=') : NULL;
    if (equals == NULL)
        return refuse_form(override != NULL ? override : "", error);
    path_step step;
    for (const char *at = override; at == override || at < equals;)
        if (!next_step(&at, equals, at == override, &step))
            return refuse_form(override, error);
    tree_node *value = tree_parse(tree, equals + 1, strlen(equals + 1), override, error);
    if (value == NULL)
        return false;
    if (tree->root->kind != TREE_MAPPING)
        return true; /* reading it will say what is wrong */

    tree_node *node = tree->root;
    const field_row *field = scene_root_field();
    for (const char *at = override; at < equals;) {
        next_step(&at, equals, at == override, &step);
        if (step.word != NULL && !spell_out(tree, node, field))
            return scene_error_memory(error);
        if (step.word != NULL)
            field = field != NULL ? field_find(field->fields, step.word, step.length) : NULL;
        node = take_step(tree, node, &step, step.word != NULL ? field : NULL, override, error);
        if (node == NULL)
            return false;
    }
    tree_node replaced = *value;
    replaced.key = node->key;
    replaced.key_place = node->key_place;
    replaced.key_source = node->key_source;
    replaced.next = node->next;
    *node = replaced;
    return true;
}
