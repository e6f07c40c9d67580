/* SPDX-License-Identifier: MIT
 *
 * A YAML document as a tree of mappings, lists and scalars that know where they were written.
 */
#ifndef MANGATA_SCENE_SCENE_TREE_H
#define MANGATA_SCENE_SCENE_TREE_H

#include <stdbool.h>
#include <stddef.h>

#include "scene/scene_text.h"

typedef enum tree_kind { TREE_NULL, TREE_SCALAR, TREE_LIST, TREE_MAPPING } tree_kind;

/* One node; as a mapping's child it carries its key. Lives in its tree's memory. */
typedef struct tree_node tree_node;
struct tree_node {
    tree_kind kind;
    bool plain;         /* scalar: written without quotes, so that it may be a number */
    scene_place place;  /* of the value in its source */
    const char *source; /* NULL: the file; else the override "key=value" that wrote it */
    const char *text;   /* scalar: NUL-terminated and without a NUL inside */
    size_t length;
    const char *key; /* NULL for list items and the root; NUL-terminated */
    scene_place key_place;
    const char *key_source; /* as `source`, of the key */
    tree_node *first, *last, *next;
    size_t count; /* children */
};

typedef struct scene_tree {
    const char *file_name; /* for messages; must outlive the tree */
    tree_node *root;       /* NULL until tree_parse_file() */
    size_t node_count;
    struct tree_block *blocks;
} scene_tree;

/* Limits on what one tree may hold; what lies beyond is refused with a message. */
enum { TREE_MAX_DEPTH = 32, TREE_MAX_NODES = 1000000, TREE_MAX_SCALAR = 65536 };

/* Reads `text` as one YAML 1.2 document. Anchors, aliases and tags are refused. `source` is NULL for the scene file or the
 * override that the text comes from. NULL on failure, with *error filled. Nothing is printed. */
tree_node *tree_parse(scene_tree *tree, const char *text, size_t length, const char *source, scene_error *error);

/* A new empty node; NULL when memory runs out. */
tree_node *tree_add_node(scene_tree *tree, tree_kind kind, scene_place place, const char *source);
void tree_append(tree_node *parent, tree_node *child);
/* A copy of the bytes with a NUL behind, in the tree's memory; NULL when memory runs out. */
char *tree_copy_text(scene_tree *tree, const char *text, size_t length);

/* Child of a mapping by key, of a list by index; NULL where there is none. */
tree_node *tree_get(const tree_node *mapping, const char *key);
tree_node *tree_at(const tree_node *list, size_t index);

/* Fills *error with "file:line:column: …" or "--set key=value: …". Returns false. */
bool tree_error(const scene_tree *tree, const char *source, scene_place place, scene_error *error, const char *format, ...) SCENE_FORMAT(5, 6);

void tree_free(scene_tree *tree); /* its memory; the struct itself stays the caller's */

#endif
