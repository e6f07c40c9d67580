/* SPDX-License-Identifier: MIT
 *
 * State of the check of a glTF document, and the check of its buffers and views.
 */
#ifndef MANGATA_SCENE_GLTF_BUFFERS_H
#define MANGATA_SCENE_GLTF_BUFFERS_H

#include "scene/json_text.h"
#include "scene/model.h"

typedef enum gltf_lists {
    GLTF_BUFFERS,
    GLTF_VIEWS,
    GLTF_ACCESSORS,
    GLTF_MESHES,
    GLTF_NODES,
    GLTF_SCENES,
    GLTF_IMAGES,
    GLTF_TEXTURES,
    GLTF_SAMPLERS,
    GLTF_MATERIALS,
    GLTF_SKINS,
    GLTF_LIST_COUNT
} gltf_lists;

typedef struct gltf_list {
    const char *name;
    const json_value *list; /* NULL: the document lacks it */
    size_t count;
} gltf_list;

typedef struct gltf_buffer {
    uint64_t length;
    const json_value *uri; /* NULL: the buffer is the chunk of a .glb */
    char *path;            /* owned; a file beside the document; NULL: the buffer is in the document */
    char *bytes;           /* owned; NULL: not read yet */
} gltf_buffer;

typedef struct gltf_view {
    size_t buffer;
    uint64_t offset, length;
    double stride; /* bytes from element to element; 0: they are tightly packed */
} gltf_view;

typedef struct gltf_accessor {
    uint64_t count;
    int components, component_type;
} gltf_accessor;

typedef struct gltf_reader {
    json_text json;
    const char *path;
    bool binary;
    model_fault *fault;
    const char *chunk; /* the binary chunk of a .glb; NULL: there is none */
    uint64_t chunk_length;
    uint64_t weight;    /* size of the file and its buffers, bytes */
    uint64_t zeros;     /* size of all accessors without a view, bytes */
    uint64_t triangles; /* number of triangles of all meshes */
    gltf_list lists[GLTF_LIST_COUNT];
    gltf_buffer *buffers;
    gltf_view *views;
    gltf_accessor *accessors;
    uint32_t *parents; /* number of each node's parent, counted from 1; 0: it has none */
    uint8_t *roots;    /* for each node the mark of the last scene that lists it as a root */
} gltf_reader;

/* Fills the fault with "FILE:LINE:COLUMN: …", the place of a value. `at` NULL: without a place. Returns false. */
bool gltf_refuse(gltf_reader *g, const json_value *at, const char *format, ...) SCENE_FORMAT(3, 4);
/* Fills the fault with a place. Returns false. */
bool gltf_refuse_at(gltf_reader *g, scene_place place, const char *format, ...) SCENE_FORMAT(3, 4);

/* Checks an item of `buffers`. */
bool gltf_check_buffer(gltf_reader *g, const json_value *buffer, size_t index);
/* Checks an item of `bufferViews`. */
bool gltf_check_view(gltf_reader *g, const json_value *view, size_t index);

/* Checks that `count` indices of `size` bytes each, those of a sparse accessor, are below `limit` and rise. */
bool gltf_check_indices(gltf_reader *g, const json_value *at, const char *where, long view, uint64_t offset, uint64_t count, unsigned size, double limit);

void gltf_buffers_free(gltf_reader *g);

#endif
