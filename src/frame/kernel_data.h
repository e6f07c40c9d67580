/* SPDX-License-Identifier: MIT
 * The uniform structs of the kernels, seen from ordinary C. */
#ifndef MANGATA_FRAME_KERNEL_DATA_H
#define MANGATA_FRAME_KERNEL_DATA_H

#define STRUCT(name)          \
    typedef struct name name; \
    struct name
#include "kernels/common/types.k"
#include "kernels/baselines/lean_types.k"
#include "kernels/refraction/refract_types.k"
#include "kernels/refraction/narrow_types.k"
#include "kernels/refraction/shade_types.k"
#undef STRUCT

#include "frame/podee_tables.h"

_Static_assert(sizeof(FrameData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(TileData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(ViewData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(ShadeData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(NarrowData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(WaveData) == 96, "std140 layout");
_Static_assert(sizeof(MarchWave) == 16, "std140 layout");
_Static_assert(sizeof(RefractData) == 48, "std140 layout");
_Static_assert(sizeof(PictureData) == 80, "std140 layout");

/* What a kernel can reach through its accessors. */
struct kernel_context {
    const FrameData *frame;
    const TileData *tile;
    const WaveData *waves;
    const MarchWave *march;
    const float *sky;                  /* SKY_ROWS × SKY_COLUMNS × 3 */
    const ViewData *view;              /* only while tiles are sorted */
    const podee_tables *podee;         /* only where podee-* replaces its Gaussian by kernels */
    const struct lean_map *lean;       /* methods lean and leadr alone */
    const RefractData *refract;        /* scenes with objects alone, as what follows */
    const PictureData *picture;        /* only where triangles are drawn */
    const struct shade_scene *shade;   /* only where objects are shaded */
    const struct narrow_scene *narrow; /* only where objects are looked for */
    const float *light;                /* of this vector's pixels, planes of a tile_light; NULL: no objects */
};

#endif
