/* SPDX-License-Identifier: MIT
 * All objects of a scene as one indexed list of triangles, kept between frames. */
#ifndef MANGATA_FRAME_WORLD_H
#define MANGATA_FRAME_WORLD_H

#include "base/thread_pool.h"
#include "mangata/mangata.h"

/* What the triangles of one object share; world.objects are in the scene's order. */
typedef struct world_object {
    mgt_material material;
    uint32_t first_triangle, triangle_count;
    float low[3], high[3]; /* bounds of the vertices in use; low > high where there are none */
    bool smooth;           /* the mesh has normals of its own; else its triangles are flat and `normals` holds zeros */
    bool cut;              /* it is closed, and the mean surface cuts it */
    bool dry;              /* it is a hull without water inside */
    bool in_dry;           /* it reaches into the bounds of all dry objects; always true of a dry object */
} world_object;

/*
 * Positions are metres from world.origin, a horizontal point that depends on the objects alone, and from the mean surface: y is the height above
 * it. The point under a camera at c is (c[0] − origin[0], c[2] − origin[1]). 32 bytes a vertex and 28 a triangle: at most 124 bytes a triangle,
 * about 44 where most vertices are shared; where something is dry, 8 a triangle more.
 */
typedef struct world {
    uint64_t version; /* identifies the geometry within the process; what was built from a world stays valid while its version is the same */
    double origin[2]; /* x, z */
    size_t vertex_count, triangle_count, object_count;
    float *positions;      /* 3 a vertex, and room for one float more, as Embree wants */
    float *normals;        /* 3 a vertex, unit; see world_object.smooth */
    float *texcoords;      /* 2 a vertex */
    uint32_t *indices;     /* 3 a triangle, counter-clockwise seen from outside */
    int32_t *neighbours;   /* 3 a triangle: the triangles across its edges, of which edge i goes from corner i to the next; −1: none */
    uint32_t *object;      /* for each triangle its object, an index into `objects` */
    world_object *objects; /* in the scene's order; materials are those of the latest frame's scene, and their textures live only during that frame */
    float *dry;            /* 2 a triangle: the levels of its front and its back, see dry.h; NULL: no object is dry */
    float low[3], high[3]; /* bounds of all objects */
} world;

/* Makes *w, which is NULL at first, the world of the scene's objects. The geometry and its version are kept while meshes, transforms and water.level are the
 * same. Materials are read anew in every call. After MGT_ERROR_MEMORY *w is NULL. */
mgt_status world_update(world **w, const mgt_scene *scene, thread_pool *pool);
void world_free(world *w); /* NULL is allowed */

/* Bytes that the world holds. */
size_t world_size(const world *w);

#endif
