/* SPDX-License-Identifier: MIT
 *
 * A YAML document as a tree of mappings, lists and scalars that know where they were written.
 */
#include "scene/scene_tree.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include <libfyaml.h>

#include "scene/scene_quoted.h"

enum { BLOCK_BYTES = 64 * 1024 };

/* Memory of a tree: blocks that are freed together. */
struct tree_block {
    struct tree_block *next;
    size_t used, size;
    max_align_t bytes[];
};

static void *tree_allocate(scene_tree *tree, size_t size)
{
    size_t align = sizeof(max_align_t);
    if (size > SIZE_MAX / 2)
        return NULL;
    size = (size + align - 1) / align * align;
    struct tree_block *block = tree->blocks;
    if (block == NULL || block->size - block->used < size) {
        size_t room = size > BLOCK_BYTES ? size : BLOCK_BYTES;
        block = malloc(sizeof *block + room);
        if (block == NULL)
            return NULL;
        *block = (struct tree_block){.next = tree->blocks, .size = room};
        tree->blocks = block;
    }
    void *memory = (char *)block->bytes + block->used;
    block->used += size;
    return memory;
}

char *tree_copy_text(scene_tree *tree, const char *text, size_t length)
{
    char *copy = tree_allocate(tree, length + 1);
    if (copy == NULL)
        return NULL;
    if (length > 0)
        memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

tree_node *tree_add_node(scene_tree *tree, tree_kind kind, scene_place place, const char *source)
{
    tree_node *node = tree_allocate(tree, sizeof *node);
    if (node == NULL)
        return NULL;
    *node = (tree_node){.kind = kind, .place = place, .source = source, .key_place = place, .key_source = source};
    tree->node_count++;
    return node;
}

void tree_append(tree_node *parent, tree_node *child)
{
    if (parent->last != NULL)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    parent->count++;
}

tree_node *tree_get(const tree_node *mapping, const char *key)
{
    if (mapping == NULL || mapping->kind != TREE_MAPPING)
        return NULL;
    for (tree_node *child = mapping->first; child != NULL; child = child->next)
        if (strcmp(child->key, key) == 0)
            return child;
    return NULL;
}

tree_node *tree_at(const tree_node *list, size_t index)
{
    if (list == NULL || list->kind != TREE_LIST || index >= list->count)
        return NULL;
    tree_node *child = list->first;
    while (index-- > 0)
        child = child->next;
    return child;
}

void tree_free(scene_tree *tree)
{
    while (tree->blocks != NULL) {
        struct tree_block *next = tree->blocks->next;
        free(tree->blocks);
        tree->blocks = next;
    }
    tree->root = NULL;
}

bool tree_error(const scene_tree *tree, const char *source, scene_place place, scene_error *error, const char *format, ...)
{
    char what[sizeof error->text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (source != NULL) {
        scene_quote quote = scene_quote_text(source, strlen(source));
        return scene_error_set(error, SCENE_ERROR_BAD_SCENE, "--set %s: %s", quote.text, what);
    }
    return scene_error_set(error, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: %s", scene_file_name(tree->file_name).text, place.line, place.column, what);
}

/* ---- from libfyaml's events --------------------------------------------------------------------------- */

/* A document being read: the open collections and the key that waits for its value. */
typedef struct tree_reader {
    scene_tree *tree;
    const char *text; /* all of it */
    const char *source;
    scene_error *error;
    tree_node *open[TREE_MAX_DEPTH];
    bool flow[TREE_MAX_DEPTH]; /* opened by [ or { */
    size_t depth;
    const char *key;
    scene_place key_place;
    scene_place last; /* the latest place seen, for what has none of its own */
    scene_place end;  /* of the text */
    tree_node *root;
} tree_reader;

static scene_place event_place(const tree_reader *reader, struct fy_event *event)
{
    const struct fy_mark *mark = fy_event_start_mark(event);
    if (mark == NULL || mark->line < 0)
        return reader->key != NULL ? reader->key_place : reader->last;
    return (scene_place){mark->line + 1, mark->column + 1};
}

/* NUL where there is none. */
static char scalar_quote(struct fy_token *value)
{
    const enum fy_scalar_style style = value != NULL ? fy_scalar_token_get_style(value) : FYSS_ANY;
    return style == FYSS_SINGLE_QUOTED ? '\'' : style == FYSS_DOUBLE_QUOTED ? '"' : '\0';
}

static bool awaits_key(const tree_reader *reader) { return reader->depth > 0 && reader->open[reader->depth - 1]->kind == TREE_MAPPING && reader->key == NULL; }

static bool refuse(tree_reader *reader, scene_place place, const char *what)
{
    return tree_error(reader->tree, reader->source, place, reader->error, "%s", what);
}

/* Hangs a finished scalar or a begun collection into the open one. */
static bool place_node(tree_reader *reader, tree_node *node)
{
    if (node == NULL)
        return scene_error_memory(reader->error);
    if (reader->tree->node_count > TREE_MAX_NODES)
        return refuse(reader, node->place, "too many values; allowed: at most 1000000 in a scene");
    if (reader->depth == 0) {
        reader->root = node;
        return true;
    }
    if (reader->key != NULL) {
        node->key = reader->key;
        node->key_place = reader->key_place;
        reader->key = NULL;
    }
    tree_append(reader->open[reader->depth - 1], node);
    return true;
}

/* The text of a quoted scalar in the tree's memory; NULL when memory runs out. */
static const char *quoted_text(tree_reader *reader, struct fy_token *value, char quote, size_t *length)
{
    const size_t start = fy_token_start_mark(value)->input_pos, size = fy_token_end_mark(value)->input_pos - start;
    char *text = tree_allocate(reader->tree, 2 * size + 1);
    if (text == NULL)
        return NULL;
    *length = scene_unquote(reader->text + start, size, quote, text);
    text[*length] = '\0';
    return text;
}

static bool read_scalar(tree_reader *reader, struct fy_token *value, scene_place place)
{
    size_t length = 0;
    const char quote = scalar_quote(value);
    const bool quoted = quote != '\0';
    const char *text = quoted ? quoted_text(reader, value, quote, &length) : value != NULL ? fy_token_get_text(value, &length) : "";
    if (text == NULL)
        return scene_error_memory(reader->error);
    if (length > TREE_MAX_SCALAR)
        return refuse(reader, place, "a text is too long; allowed: at most 65536 bytes");
    if (memchr(text, '\0', length) != NULL && quoted)
        return refuse(reader, place, "a text holds a NUL character; allowed: any other");
    if (memchr(text, '\0', length) != NULL) /* libfyaml 0.7 loses a line end there, and leaves a NUL at the end */
        return refuse(reader, place,
                      "a text behind > has an empty line before one that is indented by one more; allowed: by two or more, or such a text behind |");
    const char *copy = quoted ? text : tree_copy_text(reader->tree, text, length);
    if (copy == NULL)
        return scene_error_memory(reader->error);
    if (awaits_key(reader)) {
        reader->key = copy;
        reader->key_place = place;
        return true;
    }
    const enum fy_scalar_style style = value != NULL ? fy_scalar_token_get_style(value) : FYSS_ANY;
    const bool plain = style == FYSS_PLAIN || style == FYSS_ANY;
    bool null = plain && (length == 0 || strcmp(copy, "~") == 0 || strcasecmp(copy, "null") == 0);
    tree_node *node = tree_add_node(reader->tree, null ? TREE_NULL : TREE_SCALAR, place, reader->source);
    if (node != NULL) {
        node->plain = plain;
        node->text = copy;
        node->length = length;
    }
    return place_node(reader, node);
}

static bool open_collection(tree_reader *reader, struct fy_event *event, tree_kind kind, scene_place place)
{
    if (awaits_key(reader))
        return refuse(reader, place, "a list or mapping stands as a key; allowed: a plain word");
    if (reader->depth == TREE_MAX_DEPTH)
        return refuse(reader, place, "nested too deep; allowed: at most 32 levels");
    tree_node *node = tree_add_node(reader->tree, kind, place, reader->source);
    if (!place_node(reader, node))
        return false;
    reader->flow[reader->depth] = fy_event_get_node_style(event) == FYNS_FLOW;
    reader->open[reader->depth++] = node;
    return true;
}

/* Anchors would let a small file grow without bound, tags change types: a scene needs neither. */
static bool refuse_extras(tree_reader *reader, struct fy_event *event, scene_place place)
{
    if (fy_event_get_anchor_token(event) != NULL)
        return refuse(reader, place, "anchors (&name) are not supported; allowed: the value written out");
    if (fy_event_get_tag_token(event) != NULL)
        return refuse(reader, place, "tags (!type) are not supported; allowed: a plain value");
    return true;
}

static bool read_event(tree_reader *reader, struct fy_event *event)
{
    scene_place place = event_place(reader, event);
    reader->last = place;
    switch (event->type) {
    case FYET_DOCUMENT_START:
        if (reader->root != NULL)
            return refuse(reader, place, "a second document begins here; allowed: one");
        return true;
    case FYET_ALIAS:
        place.column--; /* libfyaml marks the name, not the star */
        return refuse(reader, place, "aliases (*name) are not supported; allowed: the value written out");
    case FYET_SCALAR:
        place.column -= scalar_quote(event->scalar.value) != '\0'; /* nor the quote */
        return refuse_extras(reader, event, place) && read_scalar(reader, event->scalar.value, place);
    case FYET_SEQUENCE_START:
        return refuse_extras(reader, event, place) && open_collection(reader, event, TREE_LIST, place);
    case FYET_MAPPING_START:
        return refuse_extras(reader, event, place) && open_collection(reader, event, TREE_MAPPING, place);
    case FYET_SEQUENCE_END:
    case FYET_MAPPING_END:
        reader->depth--;
        return true;
    default:
        return true;
    }
}

/* libfyaml's own words, where they would puzzle a reader who does not know its insides. */
static const char *plain_words(const char *message)
{
    static const char *const words[][2] = {
        {"invalid multiline plain key", "the lines after this one belong to it by their indentation, but are no text"},
        {"missing comma in flow mapping", "a comma or a closing bracket is missing"},
        {"missing comma in flow sequence", "a comma or a closing bracket is missing"},
        {"flow sequence without a closing bracket", "a closing bracket is missing"},
        {"mismatched flow mapping end", "a closing bracket does not match"},
        {"mismatched flow sequence end", "a closing bracket does not match"},
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcmp(message, words[i][0]) == 0)
            return words[i][1];
    return message;
}

/* Turns libfyaml's first diagnostic into the message; a bracket left open is named, being the usual reason. */
static bool report_syntax(const tree_reader *reader, struct fy_diag *diagnostics)
{
    void *iterator = NULL;
    const struct fy_diag_error *first = fy_diag_errors_iterate(diagnostics, &iterator);
    scene_place place = reader->last;
    const char *what = "this is not YAML";
    if (first != NULL) {
        what = first->msg != NULL ? plain_words(first->msg) : what;
        if (first->line > 0)
            place = (scene_place){first->line, first->column > 0 ? first->column : 1};
        if (place.line > reader->end.line)
            place = reader->end;
    }
    if (reader->depth > 0 && reader->flow[reader->depth - 1]) {
        const tree_node *open = reader->open[reader->depth - 1];
        bool list = open->kind == TREE_LIST;
        return tree_error(reader->tree, reader->source, place, reader->error,
                          "not valid YAML or JSON: %s; allowed: a \"%s\" for the \"%s\" of line %d, column %d", what, list ? "]" : "}", list ? "[" : "{",
                          open->place.line, open->place.column);
    }
    return tree_error(reader->tree, reader->source, place, reader->error, "not valid YAML or JSON: %s; allowed: YAML 1.2 or JSON", what);
}

static void discard_output(struct fy_diag *diagnostics, void *user, const char *text, size_t length)
{
    (void)diagnostics, (void)user, (void)text, (void)length;
}

tree_node *tree_parse(scene_tree *tree, const char *text, size_t length, const char *source, scene_error *error)
{
    tree_reader reader = {.tree = tree, .text = text, .source = source, .error = error, .last = {1, 1}};
    tree_node *root = NULL;
    scene_place place;
    struct fy_diag *diagnostics = NULL;
    struct fy_parser *parser = NULL;

    if (!scene_text_is_clean(text, length, &place)) {
        refuse(&reader, place, "not a text file: a byte that is not printable UTF-8; allowed: YAML or JSON in UTF-8");
        return NULL;
    }
    reader.end = place;
    struct fy_diag_cfg diag_config;
    fy_diag_cfg_default(&diag_config);
    diag_config.fp = NULL;
    diag_config.output_fn = discard_output;
    diag_config.level = FYET_ERROR;
    diagnostics = fy_diag_create(&diag_config);
    if (diagnostics == NULL)
        goto memory;
    fy_diag_set_collect_errors(diagnostics, true);
    struct fy_parse_cfg config = {.flags = FYPCF_DEFAULT_VERSION_1_2 | FYPCF_JSON_NONE, .diag = diagnostics};
    parser = fy_parser_create(&config);
    if (parser == NULL || fy_parser_set_string(parser, text, length) != 0)
        goto memory;

    for (struct fy_event *event; (event = fy_parser_parse(parser)) != NULL;) {
        bool good = read_event(&reader, event);
        fy_parser_event_free(parser, event);
        if (!good)
            goto done;
    }
    if (fy_parser_get_stream_error(parser))
        report_syntax(&reader, diagnostics);
    else if (reader.root == NULL && source != NULL)
        root = tree_add_node(tree, TREE_NULL, reader.last, source);
    else if (reader.root == NULL)
        refuse(&reader, (scene_place){1, 1}, "the file is empty; allowed: a scene, at least \"mangata: 1\"");
    else
        root = reader.root;
    goto done;

memory:
    scene_error_memory(error);
done:
    if (parser != NULL)
        fy_parser_destroy(parser);
    if (diagnostics != NULL)
        fy_diag_destroy(diagnostics);
    return root;
}
