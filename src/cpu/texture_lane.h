/* SPDX-License-Identifier: MIT
 * Texture lookups, one point per lane. Include it after lane_access.h.
 */
#ifndef MANGATA_CPU_TEXTURE_LANE_H
#define MANGATA_CPU_TEXTURE_LANE_H

#include <stddef.h>

#include "cpu/shade.h"
#include "frame/mesh.h"

/* A mip level of a texture, which may differ between lanes. */
typedef struct TextureLevel {
    const shade_scene *scene;
    const mgt_texture *texture;
    mask start; /* index of its first texel */
    real width, height;
} TextureLevel;

static inline TextureLevel level_of_texture(const shade_scene *s, const mgt_texture *t, mask level)
{
    const mask none = level - level, wide = (none + (int)t->width) >> level, high = (none + (int)t->height) >> level;
    return (TextureLevel){s, t, gather_ints((const int *)t->level_start, level), max(real_from_int(wide), real(1.0f)), max(real_from_int(high), real(1.0f))};
}

static inline vec3 color_of_texel(TextureLevel l, real column, real row)
{
    const mask texel = l.start + whole(row) * whole(l.width) + whole(column);
    if (l.texture->linear) {
        const four_reals color = gather_rows(l.texture->linear, texel);
        return (vec3){color.x, color.y, color.z};
    }
    const mask rgba = gather_ints((const int *)l.texture->texels, texel);
    return (vec3){gather_floats(l.scene->linear, rgba & 255), gather_floats(l.scene->linear, rgba >> 8 & 255),
                  gather_floats(l.scene->linear, rgba >> 16 & 255)};
}

typedef const mgt_texture *texture_name;

#define TEXTURE_NAME texture_name
#define TEXTURE_LEVEL(cx, texture, level) level_of_texture((cx)->shade, texture, whole(level))
#define TEXTURE_TEXEL(cx, level, column, row) color_of_texel(level, column, row)

#include "kernels/refraction/texture.k"

/* Colour of the texture of each lane's object; 0 where the object has none. Lanes mostly have the same object, so that case takes one lookup. */
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
