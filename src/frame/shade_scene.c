/* SPDX-License-Identifier: MIT
 * What the shading of objects needs beside the hits: light in air and in water, materials, shadows. */
#include "frame/shade_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "frame/fresnel.h"
#include "frame/mesh.h"

/* The slopes of the light's rays in air and, refracted by a flat surface, in water. A light below the least elevation is placed there. */
static shadow_rays rays_of(const double direction[3], double n)
{
    const double level = hypot(direction[0], direction[2]), up = fmax(direction[1], 0.01);
    const double sine = level / n, down = sqrt(fmax(1 - sine * sine, 1e-4));
    shadow_rays rays;
    for (int i = 0; i < 2; i++) {
        rays.air[i] = direction[2 * i] / up;
        rays.water[i] = direction[2 * i] / n / down;
    }
    return rays;
}

/* Objects are lit by the first light, which casts their shadows. */
static void set_light(ShadeData *d, const frame *f, const sky_state *sky, const shadow_rays *rays)
{
    const mgt_water *water = &f->scene->water;
    const light_state *light = lights_get(sky->lights, 0);
    const double n = water->index_of_refraction, up = light_toward(light)[1], entering = up > 0 ? 1 - fresnel_reflectance(up, n) : 0;
    const double slant = sqrt(1 + rays->water[0] * rays->water[0] + rays->water[1] * rays->water[1]), diffuse = 1 - fresnel_diffuse(n);
    double sun[3], sun_water[3], above[3], ground[3];
    light_beam(light, sun);
    for (int i = 0; i < 3; i++) {
        sun[i] = up > 0 ? sun[i] : 0;
        sun_water[i] = sun[i] * up * entering * slant; /* the flux through the surface is kept, while the beam's cross-section changes */
        above[i] = sky->irradiance_sky[i];
        ground[i] = 0.25 * (above[i] + sun[i] * fmax(up, 0));
    }
    d->sun_r = (float)sun[0], d->sun_g = (float)sun[1], d->sun_b = (float)sun[2];
    d->sun_water_r = (float)sun_water[0], d->sun_water_g = (float)sun_water[1], d->sun_water_b = (float)sun_water[2];
    d->sky_r = (float)above[0], d->sky_g = (float)above[1], d->sky_b = (float)above[2];
    d->sky_water_r = (float)(above[0] * diffuse), d->sky_water_g = (float)(above[1] * diffuse), d->sky_water_b = (float)(above[2] * diffuse);
    d->ground_r = (float)ground[0], d->ground_g = (float)ground[1], d->ground_b = (float)ground[2];
    d->bounce = 0.35f;
    d->sun_air_x = (float)rays->air[0], d->sun_air_z = (float)rays->air[1];
    d->sun_water_x = (float)rays->water[0], d->sun_water_z = (float)rays->water[1];
    d->sun_water_slant = (float)slant;
}

static void set_water(ShadeData *d, const frame *f, const sky_state *sky)
{
    const mgt_water *water = &f->scene->water;
    double deep[3];
    sky_upwelling_radiance(sky, water, deep);
    d->absorption_r = water->absorption[0], d->absorption_g = water->absorption[1], d->absorption_b = water->absorption[2];
    d->scattering_r = water->scattering[0], d->scattering_g = water->scattering[1], d->scattering_b = water->scattering[2];
    const double n = water->index_of_refraction, height = f->scene->camera.position[1];
    d->deep_r = (float)(n * n * deep[0]), d->deep_g = (float)(n * n * deep[1]), d->deep_b = (float)(n * n * deep[2]);
    d->index = (float)n;
    d->glow_gain = (float)(height < 0 ? 1 : 1 / (n * n));
    d->camera_depth = (float)fmax(-height, 0);
    d->pixel_angle = f->data.pixel_angle;
}

/* Fills the waves of caustics, with phases at the world's origin and the frame's instant. */
static void set_waves(shade_scene *s, const frame *f, const world *w, const sky_state *sky)
{
    const mgt_water *water = &f->scene->water;
    const light_state *light = lights_get(sky->lights, 0);
    const bool gathers = f->scene->quality.caustics && light_toward(light)[1] > 0;
    s->data.caustic_waves = gathers ? (int)water->wave_count : 0;
    s->data.choppy = water->choppiness > 0;
    s->data.sun_radius = (float)light_tan_radius(light);
    if (gathers)
        sines_searched(water, (wave_meeting){.x = w->origin[0], .z = w->origin[1], .middle = f->scene->time}, s->waves);
}

static void set_shadows(ShadeData *d, const shadow_map *m)
{
    d->shadow_left = m->left;
    d->shadow_top = m->top;
    d->shadow_texel = m->texel;
    d->shadow_scale = m->columns > 0 ? 1 / m->texel : 0;
    d->shadow_columns = (float)m->columns;
    d->shadow_rows = (float)m->rows;
    d->shadow_dry_row = m->halves > 1 ? (float)m->rows : 0;
}

static shade_material material_of(const mgt_material *m)
{
    const float alpha = m->roughness * m->roughness, size = m->pattern_size;
    shade_material out = {
        .alpha = alpha > 0.02f ? alpha : 0.02f,
        .metallic = m->metallic,
        .kind = (float)m->pattern,
        .inverse_size = size > 0 ? 1 / size : 1,
        .joint = m->pattern_joint,
        .texture_width = m->texture ? (float)m->texture->width : 0,
        .texture_height = m->texture ? (float)m->texture->height : 0,
        .texture = m->texture,
    };
    memcpy(out.base, m->base_color, sizeof out.base);
    memcpy(out.color, m->pattern_color, sizeof out.color);
    return out;
}

static void fill_material(const shade_material *m, float *out)
{
    const float values[HIT_MATERIAL_FLOATS] = {m->base[0],  m->base[1],  m->base[2],      m->alpha, m->metallic,      m->kind,          m->color[0],
                                               m->color[1], m->color[2], m->inverse_size, m->joint, m->texture_width, m->texture_height};
    memcpy(out, values, sizeof values);
}

static bool set_materials(shade_scene *s, const world *w)
{
    if (w->object_count > s->material_room || !s->material_rows) {
        shade_material *more = realloc(s->materials, (w->object_count + 1) * sizeof *more);
        s->materials = more ? more : s->materials;
        float *rows = realloc(s->material_rows, (w->object_count + 1) * HIT_MATERIAL_FLOATS * sizeof *rows);
        s->material_rows = rows ? rows : s->material_rows;
        if (!more || !rows)
            return false;
        s->material_room = w->object_count;
    }
    for (size_t i = 0; i < w->object_count; i++) {
        s->materials[i] = material_of(&w->objects[i].material);
        fill_material(&s->materials[i], s->material_rows + i * HIT_MATERIAL_FLOATS);
    }
    fill_material(&(shade_material){.alpha = 1, .inverse_size = 1}, s->material_rows + w->object_count * HIT_MATERIAL_FLOATS);
    return true;
}

/* ---- triangles ---- */

static void fill_triangle(const world *w, size_t triangle, float *out)
{
    const bool smooth = w->objects[w->object[triangle]].smooth;
    const uint32_t *corner = w->indices + 3 * triangle;
    const float *p0 = w->positions + 3 * (size_t)corner[0];
    for (int k = 0; k < 3; k++) {
        out[k] = p0[k];
        out[3 + k] = w->positions[3 * (size_t)corner[1] + (size_t)k] - p0[k];
        out[6 + k] = w->positions[3 * (size_t)corner[2] + (size_t)k] - p0[k];
        for (int c = 0; c < 3; c++)
            out[9 + 3 * c + k] = smooth ? w->normals[3 * (size_t)corner[c] + (size_t)k] : 0;
    }
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 2; k++)
            out[18 + 2 * c + k] = w->texcoords[2 * (size_t)corner[c] + (size_t)k];
}

bool shade_list_triangles(shade_scene *s)
{
    /* The record for rays that meet nothing: shading with it gives finite numbers, which are not shown. */
    static const float no_triangle[HIT_TRIANGLE_FLOATS] = {[3] = 1, [8] = 1};
    const world *w = s->world;
    if (s->triangles && s->triangle_version == w->version)
        return true;
    if (!s->triangles || w->triangle_count > s->triangle_room) {
        free(s->triangles);
        s->triangles = malloc((w->triangle_count + 1) * sizeof no_triangle);
        s->triangle_room = w->triangle_count;
    }
    if (!s->triangles)
        return false;
    for (size_t i = 0; i < w->triangle_count; i++)
        fill_triangle(w, i, s->triangles + i * HIT_TRIANGLE_FLOATS);
    memcpy(s->triangles + w->triangle_count * HIT_TRIANGLE_FLOATS, no_triangle, sizeof no_triangle);
    s->triangle_version = w->version;
    return true;
}

/* ---- all ---- */

static void fill_codes(shade_scene *s)
{
    for (int i = 0; i < TEXTURE_CODES; i++) {
        const double c = i / 255.0;
        s->linear[i] = (float)(c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4));
    }
}

mgt_status shade_update(shade_scene **scene, const world *w, const frame *f, const sky_state *sky)
{
    if (!*scene) {
        if (!(*scene = calloc(1, sizeof **scene)))
            return MGT_ERROR_MEMORY;
        fill_codes(*scene);
    }
    shade_scene *s = *scene;
    s->frame = f->data;
    s->sky = sky->table;
    s->world = w;
    const shadow_rays rays = rays_of(light_toward(lights_get(sky->lights, 0)), f->scene->water.index_of_refraction);
    if (!set_materials(s, w) || shadow_map_update(&s->shadows, w, &rays) != MGT_OK)
        return MGT_ERROR_MEMORY;
    set_light(&s->data, f, sky, &rays);
    set_water(&s->data, f, sky);
    set_waves(s, f, w, sky);
    set_shadows(&s->data, s->shadows);
    return MGT_OK;
}

void shade_free(shade_scene *s)
{
    if (!s)
        return;
    shadow_map_free(s->shadows);
    free(s->materials);
    free(s->material_rows);
    free(s->triangles);
    free(s);
}
