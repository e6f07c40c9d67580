/* SPDX-License-Identifier: MIT
 *
 * A YAML document as a tree of mappings, lists and scalars with their places in the text.
 */
#ifndef MANGATA_SCENE_SCENE_TREE_H
#define MANGATA_SCENE_SCENE_TREE_H

#include <stdbool.h>
#include <stddef.h>

#include "scene/scene_text.h"

typedef enum tree_kind { TREE_NULL, TREE_SCALAR, TREE_LIST, TREE_MAPPING } tree_kind;

/* A node. A child of a mapping has a key. The tree owns its memory. */
typedef struct tree_node tree_node;
struct tree_node {
    tree_kind kind;
    bool plain;         /* scalar: it has no quotes, so that it may be a number */
    scene_place place;  /* place of the value in its source */
    const char *source; /* the override "key=value" that the value is from; NULL: the file */
    const char *text;   /* scalar: NUL-terminated and without a NUL inside */
    size_t length;
    const char *key; /* NUL-terminated; NULL for list items and the root */
    scene_place key_place;
    const char *key_source; /* source of the key, see `source` */
    tree_node *first, *last, *next;
    size_t count; /* number of children */
};

typedef struct scene_tree {
    const char *file_name; /* for messages; must outlive the tree */
    tree_node *root;       /* NULL until the caller of tree_parse() sets it */
    size_t node_count;
    struct tree_block *blocks;
} scene_tree;

/* Limits of a tree. Larger documents are refused with a message. */
enum { TREE_MAX_DEPTH = 32, TREE_MAX_NODES = 1000000, TREE_MAX_SCALAR = 65536 };

/* Reads `text` as one YAML 1.2 document. Anchors, aliases and tags are refused. `source`: the override that the text is from; NULL: the scene file. NULL:
 * *error is filled. Nothing is printed. */
tree_node *tree_parse(scene_tree *tree, const char *text, size_t length, const char *source, scene_error *error);

/* A new empty node. NULL: out of memory. */
tree_node *tree_add_node(scene_tree *tree, tree_kind kind, scene_place place, const char *source);
void tree_append(tree_node *parent, tree_node *child);
/* A copy of the bytes with a NUL behind them, in the tree's memory. NULL: out of memory. */
char *tree_copy_text(scene_tree *tree, const char *text, size_t length);

/* The child of a mapping with this key. NULL: there is none. */
tree_node *tree_get(const tree_node *mapping, const char *key);
/* Item `index` of a list. NULL: there is none. */
tree_node *tree_at(const tree_node *list, size_t index);

/* Fills *error with "file:line:column: …" or "--set key=value: …". Returns false. */
bool tree_error(const scene_tree *tree, const char *source, scene_place place, scene_error *error, const char *format, ...) SCENE_FORMAT(5, 6);

void tree_free(scene_tree *tree); /* frees the tree's memory, but not the struct */

#endif
