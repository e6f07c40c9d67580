/* SPDX-License-Identifier: MIT
 *
 * Output of mangata-import, which reads glTF and OBJ files with assimp in a process of its own, for the process that has started it. Records have the machine's
 * byte order and are padded to multiples of 8 bytes. Both processes belong to one build.
 *
 *     wire_header, and if its status is WIRE_GOOD:
 *     picture_count times wire_picture and its bytes
 *     material_count times wire_material
 *     mesh_count times wire_mesh with positions, normals and texture coordinates (float) and indices (uint32_t)
 *     part_count times wire_part
 */
#ifndef MANGATA_SCENE_MODEL_WIRE_H
#define MANGATA_SCENE_MODEL_WIRE_H

#include <stdint.h>

enum { WIRE_MAGIC = 0x3249474d, WIRE_NONE = UINT32_MAX };

typedef enum wire_status {
    WIRE_GOOD,
    WIRE_BAD,     /* the file is bad; `what` is assimp's message */
    WIRE_MISSING, /* a file that the first one refers to is missing; `what` is its name */
    WIRE_MEMORY   /* the process may not use that much memory */
} wire_status;

typedef struct wire_header {
    uint32_t magic, status;
    uint32_t picture_count, material_count, mesh_count, part_count;
    char what[232];
} wire_header;

typedef enum wire_picture_kind { WIRE_PICTURE_INSIDE, WIRE_PICTURE_RAW, WIRE_PICTURE_FILE } wire_picture_kind;

typedef struct wire_picture {
    uint32_t kind;
    uint32_t length; /* number of bytes that follow: a PNG, a JPEG, or a file's name */
} wire_picture;

typedef struct wire_material {
    uint32_t plain;     /* 1: assimp's default for meshes without a material; the other members are not set */
    uint32_t has_color; /* 1: base_color is set */
    float base_color[3];
    float shininess, roughness, metallic; /* NaN: not given */
    uint32_t picture;                     /* picture of the base colour; WIRE_NONE: there is none */
    uint32_t unused;
} wire_material;

typedef struct wire_mesh {
    uint32_t vertex_count, triangle_count;
    uint32_t has_normals, has_texcoords; /* texture coordinates start at the bottom of a picture */
    uint32_t material, unused;
} wire_mesh;

typedef struct wire_part {
    uint32_t mesh, unused;
    double transform[3][4];
} wire_part;

/* The child's descriptor of a pipe that closes when the child ends. */
enum { WIRE_LIFE = 3 };

#endif
