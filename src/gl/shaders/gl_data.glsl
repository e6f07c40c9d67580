/* SPDX-License-Identifier: MIT
 *
 * Accessors of the kernels in compute passes. A band's tiles stand in storage buffers. tile_slot is the number of the current one.
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
#endif
#ifdef SOFTWARE_GL
#undef CACHES_TILE /* shared memory is no faster there, and each access is a loop over lanes that takes long to compile */
#endif

#ifndef TILE_ACCESS
#define TILE_ACCESS readonly
#endif
layout(std430, binding = 0) restrict TILE_ACCESS buffer TileBlock { TileData tile_data[]; };
/* Waves stand as vectors, because GPUs load a vector with one instruction, but a struct float by float. */
layout(std430, binding = 1) restrict TILE_ACCESS buffer TileWaveBlock { uvec4 tile_waves[]; };    /* TileWave */
layout(std430, binding = 2) restrict TILE_ACCESS buffer SearchBlock { vec4 search_waves[]; };     /* SEARCH_VECTORS of each SearchWave */

layout(binding = 0) uniform sampler2D sky_texture;

int tile_slot = 0;
ivec2 layer_texel = ivec2(0); /* texel of the current pixel in the layers */

#ifdef CACHES_TILE
#define TILE(cx) cached_tile
shared TileData cached_tile;
#else
#define TILE(cx) tile_data[tile_slot]
#endif
#ifdef CHOPPY_WATER /* programs are built for either kind of water */
#define CHOPPY(cx) 1
#else
#define CHOPPY(cx) 0
#endif
#define CHOPPY_BEHIND(cx) CHOPPY(cx)
#define CHOPPY_LIGHT(cx) CHOPPY(cx)
#include "foam_data.glsl"
#define WAVE(cx, i) wave_of_tile(i)
#define SEARCH_WAVE(cx, i) searched_wave(i)

#define WAVES_AS_VECTORS
#include "kernels/waves/sines.k"

SearchWave searched_wave(int i)
{
    int at = SEARCH_VECTORS * (tile_slot * pass_data.wave_stride + i);
    return search_wave_of_vectors(search_waves[at], CHOPPY(0) != 0 ? search_waves[at + 1].xy : vec2(0.0f));
}

TileWave tile_wave_of_vector(uvec4 v) { return TileWave(int(v.x), uintBitsToFloat(v.y), uintBitsToFloat(v.z), 0.0f); }
uvec4 vector_of_tile_wave(int index, float turns, float share) { return uvec4(uint(index), floatBitsToUint(turns), floatBitsToUint(share), 0u); }

#ifndef CELLS_PASS
#if defined(SOFTWARE_GL) && !defined(MANY_WAVES) /* reads of uniform blocks need no loop over lanes */
layout(std140, binding = 4) uniform WaveBlock { vec4 frame_waves[BLOCK_WAVES * WAVE_VECTORS]; };
#else
layout(std430, binding = 6) restrict readonly buffer WaveBlock { vec4 frame_waves[]; }; /* WAVE_VECTORS each: WaveData */
#endif

WaveData SET_WAVE(int i)
{
    int at = WAVE_VECTORS * i;
    return wave_of_vectors(frame_waves[at], frame_waves[at + 1], frame_waves[at + 2], frame_waves[at + 3], frame_waves[at + 4], frame_waves[at + 5]);
}
#endif

/* A wave of the tile: the frame's, with the tile's phase and share. */
WaveData listed_wave(int i)
{
    TileWave entry = tile_wave_of_vector(tile_waves[tile_slot * pass_data.wave_stride + i]);
    WaveData w = wave_placed(0, SET_WAVE(entry.index), entry.turns);
#ifdef WEIGHTED_WAVES
    w = wave_weighted(0, w, entry.share);
#endif
    return w;
}

#ifdef CACHES_TILE
/* A cache of the first waves of the workgroup's tile. Most tiles have no more waves than that. */
const int CACHED_WAVES = 64;
shared vec4 cached_waves[CACHED_WAVES * WAVE_VECTORS];

WaveData wave_of_tile(int i)
{
    if (i >= CACHED_WAVES)
        return listed_wave(i);
    int at = WAVE_VECTORS * i;
    return wave_of_vectors(cached_waves[at], cached_waves[at + 1], cached_waves[at + 2], cached_waves[at + 3], cached_waves[at + 4], cached_waves[at + 5]);
}

void cache_wave(int i)
{
    vec4 v[WAVE_VECTORS];
    wave_to_vectors(listed_wave(i), v);
    for (int k = 0; k < WAVE_VECTORS; k++)
        cached_waves[WAVE_VECTORS * i + k] = v[k];
}

/* Reads the tile tile_slot and its waves into the cache. The whole workgroup must call it. `lanes` is the number of its invocations. */
void enter_tile(int lanes)
{
    int lane = int(gl_LocalInvocationIndex);
    barrier(); /* all invocations have read the previous tile */
    if (lane == 0)
        cached_tile = tile_data[tile_slot];
    barrier();
    int count = min(TILE(0).resolved_count + TILE(0).mixed_count, CACHED_WAVES);
    for (int i = lane; i < count; i += lanes)
        cache_wave(i);
    barrier();
}
#else
#define wave_of_tile(i) listed_wave(i)
#define enter_tile(lanes)
#endif

vec3 SKY_TEXEL(int cx, float column, float row) { return texelFetch(sky_texture, ivec2(int(column), int(row)), 0).rgb; }

#ifndef OBJECTS_PASS
#undef SKYLINE
layout(binding = 3) uniform sampler2D skyline_texture;
vec2 SKYLINE(int cx, float entry) { return texelFetch(skyline_texture, ivec2(int(entry), TILE(cx).skyline - 1), 0).rg; }

/* Objects that the passes objects*.comp have found, if the scene has some. */
layout(binding = 11) uniform sampler2D front_texture;
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
#undef OBJECTS_COVERAGE
#undef OBJECTS_COLOR
#undef CLEAR_TO_LIGHT
#undef DEEP_WATER
#undef FRONT_COVERAGE
#define UPWELLING(cx) body_light()
#define MIRRORS_OBJECTS(cx) pass_data.objects
#define OBJECTS_COVERAGE(cx) texelFetch(mirrored_texture, layer_texel, 0).a
#define OBJECTS_COLOR(cx) texelFetch(mirrored_texture, layer_texel, 0).rgb
#define CLEAR_TO_LIGHT(cx) texelFetch(clear_texture, layer_texel, 0).rgb
#define DEEP_WATER(cx) texelFetch(deep_texture, layer_texel, 0).rgb
#define FRONT_COVERAGE(cx) texelFetch(front_texture, layer_texel, 0).a
#endif
