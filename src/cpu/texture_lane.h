/* SPDX-License-Identifier: MIT
 * Textures looked up a point a lane. Include it after lane_access.h.
 *
 * Coordinates are double: those of a texel far from 0 would lose the place within it. */
#ifndef MANGATA_CPU_TEXTURE_LANE_H
#define MANGATA_CPU_TEXTURE_LANE_H

#include <stddef.h>

#include "cpu/shade.h"
#include "frame/mesh.h"

/* As many doubles as a register of MGT_LANES floats holds, where it holds more than two. */
#if MGT_LANES == 1
enum { DOUBLE_LANES = 1 };
typedef double doubles;
typedef int64_t double_mask;
typedef float few_reals;
typedef int few_whole;
#define DOUBLES_OF(x) ((double)(x))
#define REALS_OF(x) ((float)(x))
#define WHOLE_OF(x) ((int)(x))
#define DOUBLES_WHERE(m, x) ((m) ? (x) : 0.0)
#else
enum { DOUBLE_LANES = MGT_LANES > 4 ? MGT_LANES / 2 : MGT_LANES };
typedef double doubles __attribute__((vector_size(8 * DOUBLE_LANES)));
typedef int64_t double_mask __attribute__((vector_size(8 * DOUBLE_LANES)));
typedef float few_reals __attribute__((vector_size(4 * DOUBLE_LANES)));
typedef int few_whole __attribute__((vector_size(4 * DOUBLE_LANES)));
#define DOUBLES_OF(x) __builtin_convertvector(x, doubles)
#define REALS_OF(x) __builtin_convertvector(x, few_reals)
#define WHOLE_OF(x) __builtin_convertvector(x, few_whole)
#define DOUBLES_WHERE(m, x) ((doubles)((double_mask)(m) & (double_mask)(x)))
#endif

/* The greatest whole number that is not above x; |x| < 2^51. */
static inline doubles doubles_floor(doubles x)
{
    static const double whole_from = 6755399441055744.0; /* 1.5 · 2^52: to its sum with this, numbers are rounded to whole ones */
    const doubles nearest = (x + whole_from) - whole_from, one = x - x + 1;
    return nearest - DOUBLES_WHERE(nearest > x, one);
}

/* Two texels side by side in a texture that repeats, and the place between them. */
typedef struct texel_lanes {
    mask first, second;
    real share; /* weight of the second texel */
} texel_lanes;

/* The two texels around a place at x texels, in a texture of a power of two of them; |x| < 2^30. */
static inline texel_lanes texels_of_power(real x, mask size)
{
    const real whole_x = floor(x), half = real(0.5f), within = x - whole_x;
    const mask upper = within >= half, texel = whole(whole_x) + 1;
    texel_lanes t;
    t.first = whole_select(upper, texel - 1, texel - 2) & (size - 1);
    t.second = whole_select(upper, texel, texel - 1) & (size - 1);
    t.share = SELECT(upper, x - (whole_x + half), within + half);
    return t;
}

/* The two texels around a texture coordinate, which is 1 at `size` texels and within ±1e9. `power`: all sizes are powers of two; the bits are the same. */
static inline texel_lanes texels_about(real coordinate, mask size, bool power)
{
    if (power) {
        const real x = coordinate * real_from_int(size);
        if (!any_lane(abs(x) >= real(1073741824.0f)))
            return texels_of_power(x, size);
    }
    float share[MGT_LANES], places[MGT_LANES];
    int sizes[MGT_LANES], first[MGT_LANES];
    __builtin_memcpy(places, &coordinate, sizeof places);
    __builtin_memcpy(sizes, &size, sizeof sizes);
    for (int i = 0; i < MGT_LANES; i += DOUBLE_LANES) {
        few_reals at;
        few_whole width;
        __builtin_memcpy(&at, places + i, sizeof at);
        __builtin_memcpy(&width, sizes + i, sizeof width);
        const doubles whole_size = DOUBLES_OF(width), x = DOUBLES_OF(at) * whole_size - 0.5, texel = doubles_floor(x);
        doubles within = texel - whole_size * doubles_floor(texel / whole_size);
        within += DOUBLES_WHERE(within < 0, whole_size); /* the quotient was rounded */
        within -= DOUBLES_WHERE(within >= whole_size, whole_size);
        const few_reals part = REALS_OF(x - texel);
        const few_whole column = WHOLE_OF(within);
        __builtin_memcpy(share + i, &part, sizeof part);
        __builtin_memcpy(first + i, &column, sizeof column);
    }
    texel_lanes t;
    __builtin_memcpy(&t.first, first, sizeof t.first);
    __builtin_memcpy(&t.share, share, sizeof t.share);
    const mask next = t.first + 1;
    t.second = whole_select(next < size, next, next - next);
    return t;
}

typedef float texel_color __attribute__((vector_size(16)));

static inline texel_color color_of(const shade_scene *s, const mgt_texture *t, int texel)
{
    texel_color c;
    if (t->linear) {
        __builtin_memcpy(&c, t->linear + 4 * (size_t)texel, sizeof c);
        return c;
    }
    const uint32_t rgba = t->texels[texel];
    return (texel_color){s->linear[rgba & 255], s->linear[rgba >> 8 & 255], s->linear[rgba >> 16 & 255], 0};
}

/* Texels are looked up and blended a lane at a time, all colours of one at once. */
static inline vec3 bilinear_color(const shade_scene *s, const mgt_texture *t, mask level, real u, real v)
{
    const mask none = level - level, one = none + 1, wide = (none + (int)t->width) >> level, high = (none + (int)t->height) >> level;
    const mask width = whole_select(wide > 1, wide, one), height = whole_select(high > 1, high, one);
    const bool power = (t->width & (t->width - 1)) == 0 && (t->height & (t->height - 1)) == 0;
    const texel_lanes columns = texels_about(u, width, power), rows = texels_about(v, height, power);
    const mask start = gather_ints((const int *)t->level_start, level);
    const mask upper = start + rows.first * width, lower = start + rows.second * width;
    const mask corners[4] = {upper + columns.first, upper + columns.second, lower + columns.first, lower + columns.second};
    int at[4][MGT_LANES];
    float across[MGT_LANES], down[MGT_LANES], colors[4 * MGT_LANES];
    __builtin_memcpy(at, corners, sizeof at);
    store(across, columns.share);
    store(down, rows.share);
    for (int i = 0; i < MGT_LANES; i++) {
        const texel_color a = color_of(s, t, at[0][i]), b = color_of(s, t, at[1][i]), c = color_of(s, t, at[2][i]), d = color_of(s, t, at[3][i]);
        const texel_color above = a + across[i] * (b - a), below = c + across[i] * (d - c), color = above + down[i] * (below - above);
        __builtin_memcpy(colors + 4 * i, &color, sizeof color);
    }
    const four_reals lanes = gather_rows(colors, whole(lane_numbers()));
    return (vec3){lanes.x, lanes.y, lanes.z};
}

typedef const mgt_texture *texture_name;

#define TEXTURE_NAME texture_name
#define TEXTURE_LEVEL(cx, texture, level, u, v) bilinear_color((cx)->shade, texture, whole(level), u, v)

#include "kernels/refraction/texture.k"

/* `object`: whose material's texture it is, if it has one. Neighbours mostly share theirs. */
static inline vec3 object_texture(const struct kernel_context *cx, real object, real u, real v, real level)
{
    const shade_scene *s = cx->shade;
    float objects[MGT_LANES];
    store(objects, object);
    const mgt_texture *shared = s->materials[(size_t)objects[0]].texture;
    if (shared && all_lanes(object == real(objects[0])))
        return texture_color(cx, shared, u, v, level, real((float)(shared->levels - 1)));
    vec3 color = vec3(real(0.0f), real(0.0f), real(0.0f));
    for (int i = 0; i < MGT_LANES; i++) {
        const mgt_texture *t = s->materials[(size_t)objects[i]].texture;
        bool known = !t;
        for (int k = 0; k < i && !known; k++)
            known = objects[k] == objects[i];
        if (!known)
            color = SELECT3(object == real(objects[i]), texture_color(cx, t, u, v, level, real((float)(t->levels - 1))), color);
    }
    return color;
}

#endif
