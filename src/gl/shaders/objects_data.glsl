/* SPDX-License-Identifier: MIT
 *
 * Data of the kernels that find and shade objects.
 */
#include "kernels/refraction/refract_types.k"
#include "kernels/refraction/narrow_types.k"
#include "kernels/refraction/shade_types.k"
#include "kernels/refraction/layer.k"

layout(std140, binding = 3) uniform ObjectsBlock {
    RefractData refract_data;
    NarrowData narrow_data;
    ShadeData shade_data;
    ObjectsData objects_data;
};

layout(binding = 1) uniform samplerBuffer vertex_table;   /* two a vertex: x, y, z, u; normal x, y, z, v */
layout(binding = 2) uniform usamplerBuffer index_table;   /* three a triangle */
layout(binding = 15) uniform isamplerBuffer neighbour_table; /* three a triangle, across the edges from each corner to the next; −1: none */
layout(binding = 3) uniform usamplerBuffer owner_table;   /* the object of a triangle */
layout(binding = 4) uniform samplerBuffer plane_table;    /* of a triangle: unit normal, and its product with a point; behind all, dry levels of its sides */
/* The linear values of sRGB codes, four in a texel; waves that make caustics; waves that rays behind the surface meet again; then four texels for each
 * object. */
layout(binding = 5) uniform samplerBuffer material_table;
layout(binding = 6) uniform usamplerBuffer texel_table;   /* the texels of all textures */
layout(binding = 7) uniform sampler2D shadow_texture;
layout(binding = 8) uniform sampler2D far_depth;
layout(binding = 9) uniform isampler2D far_triangle;
layout(binding = 10) uniform sampler2D mirrored_depth;
layout(binding = 11) uniform isampler2D mirrored_triangle;
layout(binding = 12) uniform sampler2D front_depth;
layout(binding = 13) uniform isampler2D front_triangle;

#define REFRACT(cx) refract_data
#define NARROW(cx) narrow_data
#define SHADE(cx) shade_data

/* ---- layers ---- */

int layer_triangle(int layer, ivec2 at) { return layer == LAYER_REFRACTED ? texelFetch(far_triangle, at, 0).r : texelFetch(mirrored_triangle, at, 0).r; }

/* Inverse of a layer's depth, 1/metres; 0: nothing is seen. */
float layer_inverse(int layer, ivec2 at)
{
    return (layer == LAYER_REFRACTED ? texelFetch(far_depth, at, 0).r : texelFetch(mirrored_depth, at, 0).r) / objects_data.least_depth;
}

float LAYER_DEPTH(int cx, int layer, float column, float row)
{
    ivec2 at = ivec2(int(column), int(row));
    float inverse = layer == LAYER_REFRACTED ? texelFetch(far_depth, at, 0).r : texelFetch(mirrored_depth, at, 0).r;
    return inverse > 0.0f ? objects_data.least_depth / inverse : INFINITE;
}

LayerPlane LAYER_PLANE(int cx, int layer, float column, float row)
{
    int triangle = layer_triangle(layer, ivec2(int(column), int(row)));
    vec4 plane = texelFetch(plane_table, max(triangle, 0));
    return LayerPlane(plane.xyz, plane.w, triangle < 0 ? 0.0f : 1.0f);
}

/* The GPU has no bounds of the layers: any place may show something, at any depth. */
#define MIRRORED_WITHIN(cx, a, b) true
#define LAYER_NEAREST(cx, layer, column, row) 0.0f

int object_of(int triangle) { return int(texelFetch(owner_table, triangle).r); }

ivec3 triangle_corners(int triangle)
{
    return ivec3(int(texelFetch(index_table, 3 * triangle).r), int(texelFetch(index_table, 3 * triangle + 1).r),
                 int(texelFetch(index_table, 3 * triangle + 2).r));
}

/* ---- materials ---- */

const int WAVE_TEXELS = 3; /* of a SearchWave */

vec4 material_texel(int object, int i) { return texelFetch(material_table, CODE_TEXELS + 2 * WAVE_TEXELS * MAX_WAVES + MATERIAL_TEXELS * object + i); }

SearchWave wave_of_table(int i)
{
    int at = CODE_TEXELS + WAVE_TEXELS * i;
    return search_wave_of_vectors(texelFetch(material_table, at), texelFetch(material_table, at + 1).zw);
}

SearchWave caustic_wave(int i) { return wave_of_table(i); }
SearchWave wave_met_again(int i) { return wave_of_table(MAX_WAVES + i); }

float linear_of_code(uint code) { return texelFetch(material_table, int(code >> 2))[int(code & 3u)]; }

/* A level of a texture. */
struct TextureLevel {
    int first; /* texel */
    float width, height;
};

TextureLevel TEXTURE_LEVEL(int cx, int object, float level)
{
    vec4 m = material_texel(object, 3);
    int first = floatBitsToInt(m.z), width = int(m.x), height = int(m.y);
    for (int i = 0; i < int(level); i++) {
        first += width * height;
        width = max(width >> 1, 1);
        height = max(height >> 1, 1);
    }
    return TextureLevel(first, float(width), float(height));
}

vec3 TEXTURE_TEXEL(int cx, TextureLevel l, float column, float row)
{
    uint rgba = texelFetch(texel_table, l.first + int(row) * int(l.width) + int(column)).r;
    return vec3(linear_of_code(rgba & 255u), linear_of_code(rgba >> 8 & 255u), linear_of_code(rgba >> 16 & 255u));
}

#define TEXTURE_NAME int
#include "kernels/refraction/texture.k"

vec3 TEXTURE(int cx, float object, float u, float v, float level) { return texture_color(0, int(object), u, v, level, material_texel(int(object), 3).w - 1.0f); }

/* ---- shadows ---- */

float SHADOW_TEXEL(int cx, float column, float row) { return texelFetch(shadow_texture, ivec2(int(column), int(row)), 0).r; }

/* The GPU has no bounds of blocks of the shadow map. */
#define SHADOW_RANGE(cx, column, row, width, dry) vec2(0.0f - INFINITE, INFINITE)

#include "kernels/refraction/shadow.k"
#define SUN_VISIBILITY(cx, position, first, second, dry) shadow_over(cx, position, first, second, dry)
