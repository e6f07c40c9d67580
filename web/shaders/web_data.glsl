/* SPDX-License-Identifier: MIT
 *
 * Where the kernels find their data in the page's shaders: uniform blocks, and textures of texels in rows of DATA_WIDTH. tile_of_texels() is made from TileData when
 * the page is built.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/common/types.k"
#include "kernels/waves/sines_types.k"
#include "kernels/waves/foam_types.k"

precision highp sampler2D;
precision highp usampler2D;

const int DATA_WIDTH = 4096;
ivec2 data_texel(int at) { return ivec2(at & (DATA_WIDTH - 1), at >> 12); }

layout(std140) uniform FrameBlock { FrameData frame_data; };
#define FRAME(cx) frame_data

uniform sampler2D sky_texture;
uniform usampler2D tile_texture;
uniform sampler2D list_texture;   /* TileWave */
uniform sampler2D search_texture; /* SearchWave, two texels each */
uniform sampler2D hit_texture;    /* of nodes, or of pixels of grazing water, two texels each */
uniform sampler2D wave_texture;   /* WaveData, six texels each */
uniform sampler2D skyline_texture; /* two entries each */
uniform ivec2 tile_grid;          /* columns, and the picture's height in pixels */

#include "tile_texels.glsl"

TileData tile_data;
int tile_first_wave, tile_first_search, tile_first_hit;
#define TILE(cx) tile_data

void enter_tile(ivec2 tile)
{
    int at = (tile.y * tile_grid.x + tile.x) * (TILE_TEXELS + 1);
    uvec4 v[TILE_TEXELS];
    for (int i = 0; i < TILE_TEXELS; i++)
        v[i] = texelFetch(tile_texture, data_texel(at + i), 0);
    tile_data = tile_of_texels(v);
    ivec4 parts = ivec4(texelFetch(tile_texture, data_texel(at + TILE_TEXELS), 0));
    tile_first_wave = parts.x;
    tile_first_search = parts.y;
    tile_first_hit = parts.z;
}

#ifdef CHOPPY_WATER
#define CHOPPY(cx) 1
#else
#define CHOPPY(cx) 0
#endif

#ifdef FOAMY_WATER
layout(std140) uniform FoamBlock
{
    FoamData foam_data;
    FoamSine foam_sines[2 * FOAM_SINES];
};
uniform sampler2D foam_texture; /* FoamWave, twelve texels each */
#define FOAMY(cx) 1
#define FOAM(cx) foam_data
#define FOAM_SINE(cx, i) foam_sines[i]
vec4 foam_texel(int i) { return texelFetch(foam_texture, data_texel(i), 0); }
FoamWave stored_foam_wave(int i)
{
    vec4 a = foam_texel(12 * i), b = foam_texel(12 * i + 1), c = foam_texel(12 * i + 2), d = foam_texel(12 * i + 3), e = foam_texel(12 * i + 4), f = foam_texel(12 * i + 5);
    vec4 g = foam_texel(12 * i + 6), h = foam_texel(12 * i + 7), k = foam_texel(12 * i + 8), l = foam_texel(12 * i + 9), m = foam_texel(12 * i + 10), n = foam_texel(12 * i + 11);
    return FoamWave(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w, d.x, d.y, d.z, d.w, e.x, e.y, e.z, e.w, f.x, f.y, f.z, f.w, g.x, g.y, g.z, g.w, h.x, h.y, h.z, h.w, k.x, k.y, k.z, k.w, l.x, l.y, l.z, l.w,
                    m.x, m.y, m.z, m.w, n.x, n.y, n.z, n.w);
}
#define FOAM_WAVE(cx, i) stored_foam_wave(i)
#else
#include "kernels/waves/no_foam_accessors_glsl.k"
#endif

#define WAVE(cx, i) listed_wave(i)
#define SEARCH_WAVE(cx, i) searched_wave(i)
#define WAVES_AS_VECTORS
#include "kernels/waves/sines.k"

SearchWave searched_wave(int i)
{
    int at = 3 * (tile_first_search + i);
    return search_wave_of_vectors(texelFetch(search_texture, data_texel(at), 0), CHOPPY(0) != 0 ? texelFetch(search_texture, data_texel(at + 1), 0).zw : vec2(0.0f));
}

#ifdef WAVES_IN_BLOCK /* software rasterisers read blocks faster; not every GPU's are large enough */
layout(std140) uniform WaveBlock { vec4 frame_waves[WAVES_IN_BLOCK * WAVE_VECTORS]; };
#define WAVE_VECTOR(at) frame_waves[at]
#else
#define WAVE_VECTOR(at) texelFetch(wave_texture, data_texel(at), 0)
#endif

/* A wave of the tile: the frame's, with the tile's phase and weight. The index is the bits of a whole number. */
WaveData listed_wave(int i)
{
    vec4 entry = texelFetch(list_texture, data_texel(tile_first_wave + i), 0);
    int at = WAVE_VECTORS * int(entry.x);
    WaveData w = wave_of_vectors(WAVE_VECTOR(at), WAVE_VECTOR(at + 1), WAVE_VECTOR(at + 2), WAVE_VECTOR(at + 3), WAVE_VECTOR(at + 4), WAVE_VECTOR(at + 5));
    return wave_weighted(0, wave_placed(0, w, entry.y), entry.z);
}

vec3 SKY_TEXEL(int cx, float column, float row) { return texelFetch(sky_texture, ivec2(int(column), int(row)), 0).rgb; }

#undef SKYLINE
vec2 SKYLINE(int cx, float entry)
{
    vec4 entries = texelFetch(skyline_texture, data_texel(int(entry) / 2), 0);
    return int(entry) % 2 == 0 ? entries.xy : entries.zw;
}

#include "kernels/glitter/pixel.k"
#define HIT_FOUND(cx, column, row, hit, where)
#include "kernels/glitter/lattice.k"

/* ---- where a pixel's hit is looked for ---- */

LatticeNode node_of(int column, int row)
{
    int at = 2 * (tile_first_hit + row * NODE_COLUMNS + column);
    vec4 a = texelFetch(hit_texture, data_texel(at), 0), b = texelFetch(hit_texture, data_texel(at + 1), 0);
    LatticeNode node;
    node.ray = pixel_ray_at(0, float(column * NODE_STEP_X), float(row * NODE_STEP_Y));
    node.along = a.x;
    node.found = a.y;
    node.plane.level = a.z;
    node.plane.height = a.w;
    node.plane.slope_x = b.x;
    node.plane.slope_z = b.y;
    node.shift = b.zw;
    return node;
}

bool tile_may_occlude()
{
    float right = float(TILE_WIDTH), down = float(TILE_HEIGHT);
    return corners_occlude(0, pixel_ray_at(0, 0.0f, 0.0f), pixel_ray_at(0, right, 0.0f), pixel_ray_at(0, 0.0f, down), pixel_ray_at(0, right, down));
}

/* `pixel`: its column, and the row of the hit. */
HitEstimate pixel_estimate(ivec2 pixel)
{
    HitEstimate estimate;
    estimate.height = 0.0f;
    estimate.from = 0.0f;
    estimate.search = 0.0f;
    estimate.slope = vec2(0.0f);
    estimate.shift = vec2(0.0f);
    if (TILE(0).grazing != 0 && tile_first_hit >= 0) {
        int at = 2 * (tile_first_hit + pixel.y * TILE_WIDTH + pixel.x);
        vec4 a = texelFetch(hit_texture, data_texel(at), 0), b = texelFetch(hit_texture, data_texel(at + 1), 0);
        estimate.height = a.x;
        estimate.slope = a.yz;
        estimate.shift = b.xy;
        return estimate;
    }
    if (tile_first_hit < 0) {
        estimate.search = TILE(0).search_pixels != 0 ? 1.0f : 0.0f;
        return estimate;
    }
    ivec2 cell = pixel / ivec2(NODE_STEP_X, NODE_STEP_Y);
    vec2 part = vec2(pixel % ivec2(NODE_STEP_X, NODE_STEP_Y)) / vec2(float(NODE_STEP_X), float(NODE_STEP_Y));
    return cell_estimate(0, node_of(cell.x, cell.y), node_of(cell.x + 1, cell.y), node_of(cell.x, cell.y + 1), node_of(cell.x + 1, cell.y + 1),
                         pixel_ray_at(0, float(pixel.x), float(pixel.y)), part.x, part.y, tile_may_occlude());
}

/* Enters the fragment's tile; its place in there. Row 0 of a picture is the texture's row 0. */
ivec2 enter_pixel()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    enter_tile(texel / ivec2(TILE_WIDTH, TILE_HEIGHT));
    return texel % ivec2(TILE_WIDTH, TILE_HEIGHT);
}
