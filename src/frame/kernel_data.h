/* SPDX-License-Identifier: MIT
 * The uniform structs of the kernels, seen from ordinary C. */
#ifndef MANGATA_FRAME_KERNEL_DATA_H
#define MANGATA_FRAME_KERNEL_DATA_H

#include "kernels/common/constants.h"

#define STRUCT(name)          \
    typedef struct name name; \
    struct name
/* Stands at the end of a struct: rounds its size up to a multiple of 16 bytes, as std140 does. */
#define STD140 __attribute__((aligned(16)))
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) float name;
#include "kernels/common/types.k"
#include "kernels/waves/foam_types.k"
#include "kernels/waves/sines_types.k"
#include "kernels/baselines/lean_types.k"
#include "kernels/display/reproject_types.k"
#include "kernels/refraction/refract_types.k"
#include "kernels/refraction/narrow_types.k"
#include "kernels/refraction/shade_types.k"
#undef STRUCT
#undef STD140

_Static_assert(sizeof(FrameData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(TileData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(ViewData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(ShadeData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(NarrowData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(WaveData) == 96, "std140 layout");
_Static_assert(sizeof(FoamData) % 16 == 0, "std140 layout");
_Static_assert(sizeof(FoamWave) == 192, "std140 layout");
_Static_assert(sizeof(SearchWave) == 48, "std140 layout");
_Static_assert(sizeof(RefractData) == 48, "std140 layout");
_Static_assert(sizeof(PictureData) == 80, "std140 layout");

#endif
