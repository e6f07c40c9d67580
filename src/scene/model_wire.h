/* SPDX-License-Identifier: MIT
 *
 * What mangata-import, which reads glTF and OBJ files with assimp in a process of its own, writes for the process that started it: records in the
 * machine's own order of bytes, each filled up to a multiple of 8. Both belong to one build.
 *
 *     wire_header, and if its status is WIRE_GOOD:
 *     wire_picture with its bytes, one for each of picture_count
 *     wire_material, one for each of material_count
 *     wire_mesh with positions, normals and texture coordinates (float) and indices (uint32_t), one for each of mesh_count
 *     wire_part, one for each of part_count
 */
#ifndef MANGATA_SCENE_MODEL_WIRE_H
#define MANGATA_SCENE_MODEL_WIRE_H

#include <stdint.h>

enum { WIRE_MAGIC = 0x3249474d, WIRE_NONE = UINT32_MAX };

typedef enum wire_status {
    WIRE_GOOD,
    WIRE_BAD,     /* `what` says what assimp says */
    WIRE_MISSING, /* `what` names a file that the first refers to */
    WIRE_MEMORY   /* more than the process may have */
} wire_status;

typedef struct wire_header {
    uint32_t magic, status;
    uint32_t picture_count, material_count, mesh_count, part_count;
    char what[232];
} wire_header;

typedef enum wire_picture_kind { WIRE_PICTURE_INSIDE, WIRE_PICTURE_RAW, WIRE_PICTURE_FILE } wire_picture_kind;

typedef struct wire_picture {
    uint32_t kind;
    uint32_t length; /* of the bytes behind: of a PNG or JPEG, or of a file's name */
} wire_picture;

typedef struct wire_material {
    uint32_t plain;     /* 1: assimp's default, for meshes without a material; the other members are not set */
    uint32_t has_color; /* base_color counts */
    float base_color[3];
    float shininess, roughness, metallic; /* NaN: not given */
    uint32_t picture;                     /* of base_color; WIRE_NONE: none */
    uint32_t unused;
} wire_material;

typedef struct wire_mesh {
    uint32_t vertex_count, triangle_count;
    uint32_t has_normals, has_texcoords; /* texture coordinates are counted from the bottom */
    uint32_t material, unused;
} wire_mesh;

typedef struct wire_part {
    uint32_t mesh, unused;
    double transform[3][4];
} wire_part;

/* Where its pipe is in the child; closed when it ends. */
enum { WIRE_LIFE = 3 };

#endif
