/* SPDX-License-Identifier: MIT
 *
 * Buffers and views of a glTF document while it is checked.
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
    const json_value *list; /* NULL: left out */
    size_t count;
} gltf_list;

typedef struct gltf_buffer {
    uint64_t length;
    const json_value *uri; /* NULL: the chunk of a .glb */
    char *path;            /* owned; a file beside the document; NULL: the buffer is inside the document */
    char *bytes;           /* owned; NULL: not read yet */
} gltf_buffer;

typedef struct gltf_view {
    size_t buffer;
    uint64_t offset, length;
    double stride; /* 0: elements stand side by side */
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
    const char *chunk; /* the binary chunk of a .glb; NULL: none */
    uint64_t chunk_length;
    uint64_t weight;    /* bytes of the file and its buffers */
    uint64_t zeros;     /* bytes of accessors without a view */
    uint64_t triangles; /* of all meshes */
    gltf_list lists[GLTF_LIST_COUNT];
    gltf_buffer *buffers;
    gltf_view *views;
    gltf_accessor *accessors;
    uint32_t *parents; /* parent of each node, counted from 1; 0: none */
    uint8_t *roots;    /* of each node: mark of the last scene that lists it as a root */
} gltf_reader;

/* "FILE:LINE:COLUMN: …" of a value; NULL: of no place in the text. Both return false. */
bool gltf_refuse(gltf_reader *g, const json_value *at, const char *format, ...) SCENE_FORMAT(3, 4);
bool gltf_refuse_at(gltf_reader *g, scene_place place, const char *format, ...) SCENE_FORMAT(3, 4);

/* One item of `buffers`, and of `bufferViews`. */
bool gltf_check_buffer(gltf_reader *g, const json_value *buffer, size_t index);
bool gltf_check_view(gltf_reader *g, const json_value *view, size_t index);

/* Whether `count` indices of `size` bytes each are below `limit` and rise, as those of a sparse accessor. */
bool gltf_check_indices(gltf_reader *g, const json_value *at, const char *where, long view, uint64_t offset, uint64_t count, unsigned size, double limit);

void gltf_buffers_free(gltf_reader *g);

#endif
