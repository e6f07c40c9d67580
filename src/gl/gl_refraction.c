/* SPDX-License-Identifier: MIT
 * Scenes with objects on the GPU: their textures, materials and shadows, and the passes that find what pixels see of them. */
#include "gl/gl_refraction.h"

#include <stdlib.h>
#include <string.h>

#include "frame/mesh.h"
#include "frame/refraction_data.h"
#include "gl/gl_renderer.h"
#include "frame/targets.h"

/* ---- textures ---- */

/* The texture of an object. `first` is the texture's first texel among those of all textures. */
typedef struct used_texture {
    const mgt_texture *texture;
    size_t object, first;
} used_texture;

static int by_identity(const void *a, const void *b)
{
    const uint64_t x = ((const used_texture *)a)->texture->id, y = ((const used_texture *)b)->texture->id;
    return x < y ? -1 : x > y;
}

static size_t texel_count(const mgt_texture *t) { return t->level_start[t->levels - 1] + 1; /* the last level is one texel */ }

/* Whether entry i is the first one of its texture. `used` is sorted by identity. */
static bool starts_texture(const used_texture *used, size_t i) { return i == 0 || used[i].texture->id != used[i - 1].texture->id; }

/* Whether o->texels holds exactly these textures already. */
static bool are_uploaded(const gl_refraction *o, const used_texture *used, size_t count)
{
    size_t known = 0;
    for (size_t i = 0; i < count; i++)
        if (starts_texture(used, i) && (known >= o->texture_count || o->textures[known++] != used[i].texture->id))
            return false;
    return known == o->texture_count;
}

/* Uploads `texels` texels in all, those of each texture once. `used` is sorted by identity. */
static mgt_status upload_textures(const gl_api *gl, gl_refraction *o, const used_texture *used, size_t count, size_t texels, const reporter *r)
{
    o->texture_count = 0;
    mgt_status status = gl_table_reserve(gl, &o->texels, GL_R32UI, texels, sizeof(uint32_t), r);
    if (status != MGT_OK || texels == 0)
        return status;
    if (count > o->texture_room) {
        uint64_t *more = realloc(o->textures, count * sizeof *more);
        if (!more)
            return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the textures of %zu objects", count);
        o->textures = more;
        o->texture_room = count;
    }
    uint32_t *map = gl_table_map(gl, &o->texels, texels * sizeof *map, r);
    if (!map)
        return MGT_ERROR_MEMORY;
    for (size_t i = 0; i < count; i++)
        if (starts_texture(used, i)) {
            memcpy(map + used[i].first, used[i].texture->texels, texel_count(used[i].texture) * sizeof *map);
            o->textures[o->texture_count++] = used[i].texture->id;
        }
    gl_table_unmap(gl, &o->texels);
    return MGT_OK;
}

/* ---- materials ---- */

/* The table of materials begins with the linear values of sRGB codes. Then come the waves that make caustics, the waves that rays behind the surface meet
 * again, and the materials. */
enum {
    MATERIAL_FLOATS = 4 * MATERIAL_TEXELS,
    WAVE_FLOATS = sizeof(SearchWave) / sizeof(float),
    FIRST_AGAIN = TEXTURE_CODES + MAX_WAVES * WAVE_FLOATS,
    FIRST_MATERIAL = FIRST_AGAIN + MAX_WAVES * WAVE_FLOATS
};

static void fill_material(const shade_material *m, bool smooth, float out[MATERIAL_FLOATS])
{
    const float values[MATERIAL_FLOATS] = {
        m->base[0],       m->base[1],        m->base[2],  m->alpha,
        m->color[0],      m->color[1],       m->color[2], m->kind,
        m->metallic,      m->inverse_size,   m->joint,    smooth ? 1.0f : 0.0f,
        m->texture_width, m->texture_height, 0,           m->texture ? (float)m->texture->levels : 1.0f,
    };
    memcpy(out, values, sizeof values);
}

/* Uploads the table of materials. `waves` is the number of the scene's waves. `used` are the textures of the materials. */
static mgt_status upload_materials(const gl_api *gl, gl_refraction *o, const world *w, size_t waves, const used_texture *used, size_t used_count,
                                   const reporter *r)
{
    const shade_scene *s = o->shade;
    const size_t floats = FIRST_MATERIAL + MATERIAL_FLOATS * w->object_count;
    const mgt_status status = gl_table_reserve(gl, &o->materials, GL_RGBA32F, floats, sizeof(float), r);
    float *map = status == MGT_OK ? gl_table_map(gl, &o->materials, floats * sizeof(float), r) : NULL;
    if (!map)
        return status == MGT_OK ? MGT_ERROR_MEMORY : status;
    memcpy(map, s->linear, sizeof s->linear);
    memcpy(map + TEXTURE_CODES, s->waves, waves * sizeof *s->waves);
    memcpy(map + FIRST_AGAIN, o->again, waves * sizeof *o->again);
    float *materials = map + FIRST_MATERIAL;
    for (size_t i = 0; i < w->object_count; i++)
        fill_material(&s->materials[i], w->objects[i].smooth, materials + MATERIAL_FLOATS * i);
    for (size_t i = 0; i < used_count; i++) {
        const uint32_t first = (uint32_t)used[i].first;
        memcpy(materials + MATERIAL_FLOATS * used[i].object + 14, &first, sizeof first);
    }
    gl_table_unmap(gl, &o->materials);
    return MGT_OK;
}

/* Uploads the textures, if they have changed, and the table of materials. `waves` is the number of the scene's waves. */
static mgt_status update_materials(gl_renderer *g, size_t waves, const reporter *r)
{
    gl_refraction *o = &g->refraction;
    const world *w = g->objects.world;
    used_texture *used = malloc((w->object_count + 1) * sizeof *used);
    if (!used)
        return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the materials of %zu objects", w->object_count);
    size_t count = 0, texels = 0;
    for (size_t i = 0; i < w->object_count; i++)
        if (o->shade->materials[i].texture)
            used[count++] = (used_texture){o->shade->materials[i].texture, i, 0};
    qsort(used, count, sizeof *used, by_identity);
    for (size_t i = 0; i < count; i++) {
        used[i].first = starts_texture(used, i) ? texels : used[i - 1].first;
        texels += starts_texture(used, i) ? texel_count(used[i].texture) : 0;
    }
    mgt_status status = MGT_OK;
    if (texels > g->limits.table_texels)
        status = report_error(r, MGT_ERROR_UNSUPPORTED, "render.size", "textures of %zu texels are more than this OpenGL's tables hold (%zu)", texels,
                              g->limits.table_texels);
    if (status == MGT_OK && (!o->texels.texture || !are_uploaded(o, used, count)))
        status = upload_textures(&g->gl, o, used, count, texels, r);
    if (status == MGT_OK)
        status = upload_materials(&g->gl, o, w, waves, used, count, r);
    free(used);
    return status;
}

/* ---- shadows ---- */

/* Uploads the shadow map if it has changed. */
static mgt_status update_shadows(const gl_api *gl, gl_refraction *o, const reporter *r)
{
    const shadow_map *m = o->shade->shadows;
    if (m->columns == 0 || (o->shadow_version == m->version && memcmp(&o->shadow_rays, &m->rays, sizeof m->rays) == 0))
        return MGT_OK;
    o->shadow_version = 0;
    mgt_status status = gl_image_reserve(gl, &o->shadows, GL_R32F, m->columns, m->rows * m->halves, r);
    if (status != MGT_OK)
        return status;
    gl->TextureSubImage2D(o->shadows.name, 0, 0, 0, (GLsizei)m->columns, (GLsizei)(m->rows * m->halves), GL_RED, GL_FLOAT, m->height);
    status = gl_check(gl, "shadows", r);
    if (status == MGT_OK) {
        o->shadow_rays = m->rays;
        o->shadow_version = m->version;
    }
    return status;
}

/* ---- a frame ---- */

enum { IMAGES = 7 };

/* Lists the images in the order of their bindings in objects.comp. The last one is used under water alone. */
static void list_images(gl_seen *o, gl_image *out[IMAGES])
{
    gl_image *const images[IMAGES] = {&o->body, &o->mirrored, &o->front, &o->surface, &o->error, &o->clear, &o->deep};
    memcpy(out, images, sizeof images);
}

static mgt_status reserve_images(const gl_api *gl, gl_seen *o, const region *area, bool under, const reporter *r)
{
    gl_image *images[IMAGES];
    list_images(o, images);
    mgt_status status = MGT_OK;
    for (int i = 0; i < (under ? IMAGES : IMAGES - 1) && status == MGT_OK; i++)
        status = gl_image_reserve(gl, images[i], images[i] == &o->error ? GL_R32F : GL_RGBA32F, area->width, area->height, r);
    return status;
}

mgt_status gl_refraction_reserve_least(gl_renderer *g, const reporter *r)
{
    const region texel = {0, 0, 1, 1};
    mgt_status status = reserve_images(&g->gl, &g->refraction.seen, &texel, true, r);
    if (status == MGT_OK)
        status = reserve_images(&g->gl, &g->refraction.opened, &texel, true, r);
    if (status == MGT_OK)
        status = gl_image_reserve(&g->gl, &g->refraction.shadows, GL_R32F, 1, 1, r);
    return status == MGT_OK ? gl_table_reserve(&g->gl, &g->objects.tree, GL_RGBA32UI, 0, sizeof(uint32_t[4]), r) : status;
}

mgt_status gl_refraction_prepare(gl_renderer *g, const frame *f, const region *area, const reporter *r)
{
    gl_refraction *o = &g->refraction;
    mgt_status status = gl_objects_update(&g->gl, &g->objects, f->scene, g->threads, g->limits.table_texels, r);
    if (status != MGT_OK)
        return status;
    if (f->scene->quality.refraction == MGT_REFRACTION_HYBRID)
        status = gl_objects_update_tree(&g->gl, &g->objects, g->limits.table_texels, r);
    if (status != MGT_OK)
        return status;
    const world *w = g->objects.world;
    if (shade_update(&o->shade, w, f, g->sky) != MGT_OK)
        return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the scene's objects");
    const gbuffer_job direct = refraction_job(f), mirrored = refraction_mirrored_job(f);
    const bool mirrors = refraction_mirrors(f, w);
    status = reserve_images(&g->gl, &o->seen, area, f->under, r);
    if (status == MGT_OK)
        status = gl_gbuffers_draw(g, &direct, mirrors ? &mirrored : NULL, r);
    refraction_wave_list(f, w, o->again);
    if (status == MGT_OK)
        status = update_materials(g, f->scene->water.wave_count, r);
    if (status == MGT_OK)
        status = update_shadows(&g->gl, o, r);
    const gbuffer shape = gbuffer_shape(&direct);
    const uint32_t places = f->scene->quality.refraction_samples;
    o->block = (gl_objects_block){
        .refract = refract_data_of(direct.camera.position[1], direct.index, direct.map),
        .narrow = refraction_narrow_data(f, w, &shape),
        .shade = o->shade->data,
        .objects = {.least_depth = g->gbuffers.least_depth,
                    .mirrors = mirrors,
                    .places = places > 1 ? (int)places : 1,
                    .dry = w->dry && !f->under ? (int)w->triangle_count : 0},
    };
    return status;
}

/* Binds the images of g->refraction.seen. */
static void bind_images(gl_renderer *g, GLenum access)
{
    gl_image *images[IMAGES];
    list_images(&g->refraction.seen, images);
    for (GLuint i = 0; i < IMAGES; i++)
        gl_bind_image(g, i, images[i], access);
}

/* Binds all that the passes over a band read and write, except the lists. */
static void bind_all(gl_renderer *g)
{
    const gl_refraction *o = &g->refraction;
    const gl_gbuffers *b = &g->gbuffers;
    const gl_table *const tables[] = {&g->objects.vertices, &g->objects.indices, &g->objects.owners, &g->objects.planes, &o->materials, &o->texels};
    for (GLuint i = 0; i < sizeof tables / sizeof *tables; i++)
        gl_bind_texture(g, UNIT_VERTICES + i, tables[i]->texture);
    gl_bind_texture(g, UNIT_TREE, g->objects.tree.texture);
    gl_bind_texture(g, UNIT_NEIGHBOURS, g->objects.neighbours.texture);
    gl_bind_texture(g, UNIT_SKY, g->sky_texture);
    gl_bind_texture(g, UNIT_SHADOWS, o->shadows.name);
    const gl_gbuffer *const layers[] = {&b->refracted, o->block.objects.mirrors ? &b->mirrored : &b->refracted, &b->front};
    for (GLuint i = 0; i < sizeof layers / sizeof *layers; i++) {
        gl_bind_texture(g, UNIT_REFRACTED_LAYER + 2 * i, layers[i]->depth.name);
        gl_bind_texture(g, UNIT_REFRACTED_LAYER + 2 * i + 1, layers[i]->triangle.name);
    }
    bind_images(g, GL_WRITE_ONLY);
    gl_uniform(g, BIND_EXTRA, &o->block, sizeof o->block);
}

/* ---- the passes over a band ---- */

/* Begin of a list: the size of an indirect dispatch over it, and the number of its pixels. */
typedef struct list_head {
    uint32_t groups[3], count;
} list_head;

/* Reserves and binds the lists of a band of `pixels` pixels, and empties them. */
static mgt_status empty_lists(gl_renderer *g, size_t pixels, const reporter *r)
{
    const gl_api *gl = &g->gl;
    gl_refraction *o = &g->refraction;
    mgt_status status = gl_buffer_reserve(gl, &o->water, pixels * WATER_FLOATS * sizeof(float), 0, r);
    if (status == MGT_OK)
        status = gl_buffer_reserve(gl, &o->lists, LISTS * (sizeof(list_head) + pixels * sizeof(uint32_t)), 0, r);
    if (status != MGT_OK)
        return status;
    list_head heads[LISTS];
    for (int i = 0; i < LISTS; i++)
        heads[i] = (list_head){{0, 1, 1}, 0};
    size_t offset;
    memcpy(gl_ring_allocate(&g->ring, sizeof heads, &offset), heads, sizeof heads);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl->CopyNamedBufferSubData(g->ring.buffer, o->lists.name, (GLintptr)offset, 0, sizeof heads);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_OBJECT_WATER, o->water.name);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, BIND_OBJECT_LISTS, o->lists.name);
    gl->BindBuffer(GL_DISPATCH_INDIRECT_BUFFER, o->lists.name);
    return MGT_OK;
}

/* Runs a program over the pixels of a list. */
static mgt_status over_list(gl_renderer *g, gl_program program, int list, const reporter *r)
{
    const mgt_status status = gl_use(g, program, r);
    if (status == MGT_OK)
        g->gl.DispatchComputeIndirect((GLintptr)((size_t)list * sizeof(list_head)));
    return status;
}

/* Runs a program over all pixels of the band. */
static mgt_status over_pixels(gl_renderer *g, gl_program program, const PassData *pass, const reporter *r)
{
    const mgt_status status = gl_use(g, program, r);
    if (status == MGT_OK)
        g->gl.DispatchCompute((GLuint)pass->columns, (GLuint)pass->rows * GROUPS_A_TILE, 1);
    return status;
}

/* Finds what pixels see through the surface. If each pixel has several places, one pass also finds what the surface mirrors and traces rays. */
static mgt_status see_through(gl_renderer *g, const PassData *pass, const reporter *r)
{
    if (g->refraction.block.objects.places > 1)
        return over_pixels(g, PROGRAM_OBJECTS_PLACES, pass, r);
    const mgt_status status = over_list(g, PROGRAM_OBJECTS_THROUGH, LIST_THROUGH, r);
    if (status != MGT_OK || g->refraction.block.narrow.method != MGT_REFRACTION_HYBRID)
        return status;
    g->gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    return over_list(g, PROGRAM_OBJECTS_TRACED, LIST_TRACED, r);
}

/* Runs the passes of a band. The first one fills the lists that the others run over. */
static mgt_status run_passes(gl_renderer *g, const PassData *pass, const reporter *r)
{
    const gl_api *gl = &g->gl;
    const ObjectsData *objects = &g->refraction.block.objects;
    PassData edges = *pass;
    edges.edges = 1;
    mgt_status status = over_pixels(g, PROGRAM_OBJECTS, pass, r);
    gl->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    if (status == MGT_OK)
        status = see_through(g, pass, r);
    if (status == MGT_OK && objects->mirrors && objects->places == 1)
        status = over_list(g, PROGRAM_OBJECTS_MIRRORED, LIST_THROUGH, r);
    if (status == MGT_OK && g->refraction.block.narrow.side < 0)
        status = over_list(g, PROGRAM_OBJECTS_DEEP, LIST_DEEP, r);
    if (status == MGT_OK)
        status = over_list(g, PROGRAM_OBJECTS_FRONT, LIST_FRONT, r);
    gl_uniform(g, BIND_PASS, &edges, sizeof edges);
    if (status == MGT_OK)
        status = over_list(g, PROGRAM_OBJECTS_FRONT, LIST_EDGES, r);
    gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return status;
}

mgt_status gl_refraction_see(gl_renderer *g, const PassData *pass, const reporter *r)
{
    const size_t pixels = (size_t)pass->columns * (size_t)pass->rows * TILE_PIXELS;
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, 2 * sizeof *pass + sizeof g->refraction.block + LISTS * sizeof(list_head), 4, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "refraction");
    status = empty_lists(g, pixels, r);
    gl_uniform(g, BIND_PASS, pass, sizeof *pass);
    bind_all(g);
    if (status == MGT_OK)
        status = run_passes(g, pass, r);
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

void gl_refraction_keep(gl_renderer *g)
{
    const gl_seen opened = g->refraction.seen;
    g->refraction.seen = g->refraction.opened;
    g->refraction.opened = opened;
}

mgt_status gl_refraction_blend(gl_renderer *g, const PassData *pass, const reporter *r)
{
    const gl_seen *o = &g->refraction.opened;
    mgt_status status = gl_ring_begin(&g->gl, &g->ring, sizeof *pass, 1, r);
    if (status != MGT_OK)
        return status;
    gl_pass_begin(g, "refraction");
    status = gl_use(g, PROGRAM_OBJECTS_BLEND, r);
    if (status == MGT_OK) {
        const gl_image *const images[] = {&o->body, &o->mirrored, &o->front, &o->clear, &o->deep};
        for (GLuint i = 0; i < sizeof images / sizeof *images; i++)
            gl_bind_texture(g, 1 + i, images[i]->name);
        bind_images(g, GL_READ_WRITE);
        gl_uniform(g, BIND_PASS, pass, sizeof *pass);
        g->gl.DispatchCompute((GLuint)pass->columns, (GLuint)pass->rows * GROUPS_A_TILE, 1);
        g->gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    }
    const mgt_status ended = gl_pass_end(g, r);
    return status == MGT_OK ? ended : status;
}

void gl_refraction_bind_light(const gl_renderer *g)
{
    const gl_refraction *o = &g->refraction;
    const gl_image *const images[] = {&o->seen.front, &o->seen.clear, &o->seen.deep, &o->seen.body, &o->seen.mirrored};
    for (GLuint i = 0; i < sizeof images / sizeof *images; i++)
        gl_bind_texture(g, UNIT_HIDDEN + i, images[i]->name);
}

void gl_refraction_bind_front(const gl_renderer *g)
{
    gl_bind_texture(g, UNIT_FRONT, g->refraction.seen.front.name);
    gl_bind_texture(g, UNIT_FRONT + 1, g->refraction.seen.surface.name);
    const gl_image *const layers[] = {&g->refraction.seen.body, &g->refraction.seen.error};
    for (GLuint i = 0; i < 2; i++)
        gl_bind_image(g, IMAGE_LAYERS + i, layers[i], GL_WRITE_ONLY);
}

void gl_refraction_free(const gl_api *gl, gl_refraction *o)
{
    gl_seen *const both[] = {&o->seen, &o->opened};
    for (int k = 0; k < 2; k++) {
        gl_image *images[IMAGES];
        list_images(both[k], images);
        for (int i = 0; i < IMAGES; i++)
            gl_image_free(gl, images[i]);
    }
    gl_image_free(gl, &o->shadows);
    gl_table_free(gl, &o->materials);
    gl_table_free(gl, &o->texels);
    gl_buffer_free(gl, &o->water);
    gl_buffer_free(gl, &o->lists);
    shade_free(o->shade);
    free(o->textures);
    *o = (gl_refraction){0};
}
