/* SPDX-License-Identifier: MIT
 *
 * Where the kernels find their data in the compute passes. A band's tiles stand in storage buffers; tile_slot says which one is meant.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
#include "kernels/waves/sines_types.k"
#include "pass_data.k"

layout(std140, binding = 2) uniform PassBlock { PassData pass_data; };
#ifdef CELLS_PASS
#include "cells_waves.glsl"
#else
layout(std140, binding = 0) uniform FrameBlock { FrameData frame_data; };
#define FRAME(cx) frame_data
#ifdef WAVES_IN_STORAGE
layout(std430, binding = 6) readonly buffer WaveBlock { WaveData wave_data[]; };
#else
layout(std140, binding = 1) uniform WaveBlock { WaveData wave_data[MAX_WAVES]; };
#endif
#define SET_WAVE(i) wave_data[i]
#endif

#ifndef TILE_ACCESS
#define TILE_ACCESS readonly
#endif
layout(std430, binding = 0) TILE_ACCESS buffer TileBlock { TileData tile_data[]; };
layout(std430, binding = 1) TILE_ACCESS buffer TileWaveBlock { TileWave tile_waves[]; };
layout(std430, binding = 2) TILE_ACCESS buffer SearchBlock { SearchWave search_waves[]; };

layout(binding = 0) uniform sampler2D sky_texture;

int tile_slot = 0;
ivec2 layer_texel = ivec2(0); /* the pixel's */

#define TILE(cx) tile_data[tile_slot]
#define WAVE(cx, i) wave_of_tile(i)
#define SEARCH_WAVE(cx, i) search_waves[tile_slot * pass_data.wave_stride + i]

#include "kernels/waves/sines.k"

/* A wave of the tile: the frame's, with the tile's phase and share. */
WaveData wave_of_tile(int i)
{
    TileWave entry = tile_waves[tile_slot * pass_data.wave_stride + i];
    WaveData w = wave_placed(0, SET_WAVE(entry.index), entry.turns);
#ifdef SHARED_WAVES
    w = wave_shared(0, w, entry.share);
#endif
    return w;
}

vec3 SKY_TEXEL(int cx, float column, float row) { return texelFetch(sky_texture, ivec2(int(column), int(row)), 0).rgb; }

#ifndef OBJECTS_PASS
/* Objects, where the scene has some, as objects.comp saw them. */
layout(binding = 12) uniform sampler2D clear_texture;
layout(binding = 13) uniform sampler2D deep_texture;
layout(binding = 14) uniform sampler2D body_texture;
layout(binding = 15) uniform sampler2D mirrored_texture;

vec3 body_light()
{
    if (pass_data.objects == 0)
        return vec3(FRAME(0).body_r, FRAME(0).body_g, FRAME(0).body_b);
    return texelFetch(body_texture, layer_texel, 0).rgb;
}

#undef UPWELLING
#undef MIRRORS_OBJECTS
#undef OBJECTS_SHARE
#undef OBJECTS_COLOR
#undef CLEAR_TO_LIGHT
#undef DEEP_WATER
#define UPWELLING(cx) body_light()
#define MIRRORS_OBJECTS(cx) pass_data.objects
#define OBJECTS_SHARE(cx) texelFetch(mirrored_texture, layer_texel, 0).a
#define OBJECTS_COLOR(cx) texelFetch(mirrored_texture, layer_texel, 0).rgb
#define CLEAR_TO_LIGHT(cx) texelFetch(clear_texture, layer_texel, 0).rgb
#define DEEP_WATER(cx) texelFetch(deep_texture, layer_texel, 0).rgb
#endif
