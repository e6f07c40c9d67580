/* SPDX-License-Identifier: MIT
 *
 * Meshes from files: glTF and OBJ, checked here and read by mangata-import in a process of its own, and PLY.
 */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "scene/gltf_check.h"
#include "scene/model_import.h"
#include "scene/model_ply.h"
#include "scene/model_wire.h"
#include "scene/obj_check.h"
#include "scene/scene_sea.h"

static const size_t MAX_FILE_BYTES = (size_t)8 << 30;

typedef enum mesh_format { FORMAT_UNKNOWN, FORMAT_GLTF, FORMAT_GLB, FORMAT_OBJ, FORMAT_PLY } mesh_format;

static mesh_format format_of(const char *path)
{
    static const struct {
        const char *extension;
        mesh_format format;
    } formats[] = {{".gltf", FORMAT_GLTF}, {".glb", FORMAT_GLB}, {".obj", FORMAT_OBJ}, {".ply", FORMAT_PLY}};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < sizeof formats / sizeof *formats; i++)
        if (strcasecmp(dot, formats[i].extension) == 0)
            return formats[i].format;
    return FORMAT_UNKNOWN;
}

static bool refuse(model_fault *fault, const char *path, const char *what)
{
    return model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: triangles or polygons in a sound .gltf, .glb, .obj or .ply file of at most 8 GiB",
                           scene_file_name(path).text, what);
}

/* ---- what the other process wrote --------------------------------------------------------------------------------- */

/* A picture of the file. Each material has its own, though they are often the same. */
typedef struct read_picture {
    const wire_picture *wire; /* with its bytes behind */
    mgt_texture *texture;     /* the model's; NULL: not made yet */
    uint64_t hash;            /* the texture's */
} read_picture;

typedef struct model_reader {
    const char *at, *end; /* of the records */
    wire_header header;
    const char *path;
    bool own, dry;    /* as model_use has them */
    uint64_t *pixels; /* of the scene's textures */
    mesh_format format;
    scene_model *model;
    model_fault *fault;
    read_picture *pictures;
    mgt_material *materials;
    struct read_mesh *meshes; /* each of the file's */
    size_t part_room;
} model_reader;

/* One of the file's meshes. */
typedef struct read_mesh {
    wire_mesh head;
    const float *positions; /* NULL: nothing to draw */
    uint32_t of_model;      /* which of the model's */
} read_mesh;

/* A record; NULL, with the fault filled, where it is cut short. */
static const void *take(model_reader *r, size_t size)
{
    const size_t filled = (size + 7) / 8 * 8;
    const char *at = r->at;
    if (size > (size_t)(r->end - at) || filled > (size_t)(r->end - at)) {
        refuse(r->fault, r->path, "the output of mangata-import is cut short");
        return NULL;
    }
    r->at += filled;
    return at;
}

static bool take_pictures(model_reader *r)
{
    if (r->header.picture_count > (size_t)(r->end - r->at) / sizeof(wire_picture))
        return refuse(r->fault, r->path, "the output of mangata-import is cut short");
    r->pictures = calloc((size_t)r->header.picture_count + 1, sizeof *r->pictures);
    if (r->pictures == NULL)
        return model_fault_memory(r->fault);
    for (uint32_t i = 0; i < r->header.picture_count; i++) {
        const wire_picture *wire = r->pictures[i].wire = take(r, sizeof *wire);
        if (wire == NULL || take(r, wire->length) == NULL)
            return false;
    }
    return true;
}

/* ---- materials ---------------------------------------------------------------------------------------------------- */

static float within(float value, float low, float high) { return value >= low ? value <= high ? value : high : low; }

static bool same_picture(const wire_picture *a, const wire_picture *b)
{
    return a->kind == b->kind && a->length == b->length && memcmp(a + 1, b + 1, a->length) == 0;
}

/* Inside the file, or a picture beside it. */
static bool load_picture(model_reader *r, read_picture *read)
{
    const wire_picture *picture = read->wire;
    const char *bytes = (const char *)(picture + 1);
    scene_model *model = r->model;
    mgt_texture **textures = realloc(model->textures, (model->texture_count + 1) * sizeof(mgt_texture *));
    if (textures == NULL)
        return model_fault_memory(r->fault);
    model->textures = textures;
    if (picture->kind == WIRE_PICTURE_INSIDE) {
        read->texture = texture_parse(bytes, picture->length, r->path, r->pixels, &read->hash, r->fault);
    } else if (picture->kind == WIRE_PICTURE_RAW) {
        refuse(r->fault, r->path, "holds a picture that is not compressed");
    } else {
        char *name = strndup(bytes, picture->length);
        char *path = name != NULL ? scene_file_beside(r->path, name) : NULL;
        for (char *at = path; at != NULL && *at != '\0'; at++)
            if (*at == '\\')
                *at = '/';
        if (path != NULL)
            read->texture = texture_load(path, r->pixels, &read->hash, r->fault);
        else
            model_fault_memory(r->fault);
        free(path);
        free(name);
    }
    if (read->texture == NULL) {
        const size_t used = strlen(r->fault->text);
        snprintf(r->fault->text + used, sizeof r->fault->text - used, ", or a material in the scene");
        return false;
    }
    model->textures[model->texture_count++] = read->texture;
    return true;
}

/* One texture for all pictures that are the same. NULL with the fault filled. */
static const mgt_texture *read_texture(model_reader *r, uint32_t index)
{
    read_picture *read = r->pictures;
    while (read < &r->pictures[index] && (read->texture == NULL || !same_picture(read->wire, r->pictures[index].wire)))
        read++;
    if (read->texture == NULL && !load_picture(r, read))
        return NULL;
    r->model->hash = model_hash(r->model->hash, &read->hash, sizeof read->hash);
    return read->texture;
}

static bool read_material(model_reader *r, const wire_material *m, mgt_material *out)
{
    *out = scene_material_defaults();
    if (m->plain)
        return true;
    for (int i = 0; m->has_color && i < 3; i++)
        out->base_color[i] = within(m->base_color[i], 0, 1);
    /* Of Blinn and Phong's exponent where there is no roughness: the same width of the highlight. */
    const float like = m->shininess > 0 ? sqrtf(sqrtf(2 / (m->shininess + 2))) : out->roughness;
    out->roughness = within(isnan(m->roughness) ? like : m->roughness, 0.02f, 1);
    out->metallic = within(isnan(m->metallic) ? 0 : m->metallic, 0, 1);
    if (m->picture == WIRE_NONE)
        return true;
    if (m->picture >= r->header.picture_count)
        return refuse(r->fault, r->path, "mangata-import names a picture that does not exist");
    out->texture = read_texture(r, m->picture);
    return out->texture != NULL;
}

static bool read_materials(model_reader *r)
{
    const uint32_t count = r->header.material_count;
    if (count > (size_t)(r->end - r->at) / sizeof(wire_material))
        return refuse(r->fault, r->path, "the output of mangata-import is cut short");
    r->materials = calloc((size_t)count + 1, sizeof *r->materials);
    if (r->materials == NULL)
        return model_fault_memory(r->fault);
    for (uint32_t i = 0; i < count; i++) {
        const wire_material *m = take(r, sizeof *m);
        if (m == NULL || (r->own && !read_material(r, m, &r->materials[i])))
            return false;
        mgt_material plain = r->own ? r->materials[i] : scene_material_defaults();
        r->materials[i] = plain;
        r->model->hash = model_hash(r->model->hash, &plain.base_color, sizeof plain.base_color);
        r->model->hash = model_hash(r->model->hash, &plain.roughness, sizeof plain.roughness);
        r->model->hash = model_hash(r->model->hash, &plain.metallic, sizeof plain.metallic);
    }
    return true;
}

/* ---- meshes ------------------------------------------------------------------------------------------------------- */

/* Texture coordinates as the library counts them, from the top, and normals where OBJ says nothing; a glTF without them is flat by its own rules. */
static bool complete(const model_reader *r, mesh_data *mesh, const float *texcoords, bool has_normals)
{
    if (texcoords != NULL) {
        mesh->texcoords = malloc(mesh->vertex_count * 2 * sizeof *mesh->texcoords);
        for (size_t i = 0; mesh->texcoords != NULL && i < mesh->vertex_count; i++) {
            mesh->texcoords[2 * i] = texcoords[2 * i];
            mesh->texcoords[2 * i + 1] = 1 - texcoords[2 * i + 1];
        }
        if (mesh->texcoords == NULL)
            return model_fault_memory(r->fault);
    }
    for (size_t i = 0; i < 3 * mesh->triangle_count; i++)
        if (mesh->indices[i] >= mesh->vertex_count)
            return refuse(r->fault, r->path, "a triangle refers to a vertex that does not exist");
    return has_normals || r->format != FORMAT_OBJ || mesh_data_smooth(mesh) || model_fault_memory(r->fault);
}

static bool make_mesh(model_reader *r, read_mesh *mesh, const float *normals, const float *texcoords, const uint32_t *indices)
{
    scene_model *model = r->model;
    mesh_data data = {.positions = (float *)mesh->positions,
                      .indices = (uint32_t *)indices,
                      .vertex_count = mesh->head.vertex_count,
                      .triangle_count = mesh->head.triangle_count};
    bool good = complete(r, &data, texcoords, normals != NULL);
    if (good) {
        mgt_mesh_desc desc;
        mgt_mesh_desc_init(&desc, sizeof desc);
        desc.positions = data.positions;
        desc.normals = normals != NULL ? normals : data.normals;
        desc.texcoords = data.texcoords;
        desc.vertex_count = mesh->head.vertex_count;
        desc.indices = indices;
        desc.triangle_count = mesh->head.triangle_count;
        desc.dry = r->dry;
        const mgt_status status = mgt_mesh_create(&model->meshes[model->mesh_count], &desc);
        good = status == MGT_OK || (status == MGT_ERROR_MEMORY ? model_fault_memory(r->fault) : refuse(r->fault, r->path, mgt_last_error(NULL)));
        if (good) {
            mesh->of_model = (uint32_t)model->mesh_count++;
            model->hash = model_hash(model->hash, desc.positions, (size_t)desc.vertex_count * 3 * sizeof(float));
            model->hash = model_hash(model->hash, desc.indices, (size_t)desc.triangle_count * 3 * sizeof(uint32_t));
            if (desc.normals != NULL)
                model->hash = model_hash(model->hash, desc.normals, (size_t)desc.vertex_count * 3 * sizeof(float));
            if (desc.texcoords != NULL)
                model->hash = model_hash(model->hash, desc.texcoords, (size_t)desc.vertex_count * 2 * sizeof(float));
        }
    }
    free(data.texcoords);
    free(data.normals);
    return good;
}

static bool take_mesh(model_reader *r, read_mesh *mesh)
{
    const wire_mesh *head = take(r, sizeof *head);
    if (head == NULL)
        return false;
    mesh->head = *head;
    if (head->triangle_count == 0)
        return true;
    const size_t vertex = head->vertex_count * sizeof(float);
    mesh->positions = take(r, 3 * vertex);
    const float *normals = mesh->positions != NULL && head->has_normals ? take(r, 3 * vertex) : NULL;
    if (mesh->positions == NULL || (head->has_normals && normals == NULL))
        return false;
    const float *texcoords = head->has_texcoords ? take(r, 2 * vertex) : NULL;
    if (head->has_texcoords && texcoords == NULL)
        return false;
    const uint32_t *indices = take(r, (size_t)head->triangle_count * 3 * sizeof *indices);
    return indices != NULL && make_mesh(r, mesh, normals, texcoords, indices);
}

static bool read_meshes(model_reader *r)
{
    const uint32_t count = r->header.mesh_count;
    if (count > (size_t)(r->end - r->at) / sizeof(wire_mesh))
        return refuse(r->fault, r->path, "the output of mangata-import is cut short");
    r->meshes = calloc((size_t)count + 1, sizeof *r->meshes);
    r->model->meshes = calloc((size_t)count + 1, sizeof(mgt_mesh *));
    if (r->meshes == NULL || r->model->meshes == NULL)
        return model_fault_memory(r->fault);
    for (uint32_t i = 0; i < count; i++)
        if (!take_mesh(r, &r->meshes[i]))
            return false;
    return true;
}

/* ---- parts -------------------------------------------------------------------------------------------------------- */

static double reach_of(const read_mesh *mesh, const double t[3][4])
{
    double reach = 0;
    for (size_t i = 0; i < mesh->head.vertex_count; i++) {
        const float *p = mesh->positions + 3 * i;
        for (int k = 0; k < 3; k++)
            reach = fmax(reach, fabs(t[k][0] * (double)p[0] + t[k][1] * (double)p[1] + t[k][2] * (double)p[2] + t[k][3]));
    }
    return reach;
}

/* A node that is scaled to nothing hides its meshes: the specification's way to make them visible and invisible (Khronos, section 3.5.3). */
static bool is_hidden(const wire_part *part)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (part->transform[i][j] != 0)
                return false;
    return true;
}

static bool read_parts(model_reader *r)
{
    scene_model *model = r->model;
    if (r->header.part_count > MGT_MAX_OBJECTS)
        return refuse(r->fault, r->path, "places more than 65536 meshes");
    model->parts = calloc((size_t)r->header.part_count + 1, sizeof *model->parts);
    if (model->parts == NULL)
        return model_fault_memory(r->fault);
    for (uint32_t i = 0; i < r->header.part_count; i++) {
        const wire_part *in = take(r, sizeof *in);
        if (in == NULL)
            return false;
        const read_mesh *mesh = in->mesh < r->header.mesh_count ? &r->meshes[in->mesh] : NULL;
        if (mesh == NULL || mesh->positions == NULL || mesh->head.material >= r->header.material_count)
            return refuse(r->fault, r->path, "mangata-import names a mesh or a material that does not exist");
        if (is_hidden(in))
            continue;
        model_part *part = &model->parts[model->part_count++];
        *part = (model_part){.mesh = model->meshes[mesh->of_model], .material = r->materials[mesh->head.material]};
        memcpy(part->transform, in->transform, sizeof part->transform);
        model->triangles += mesh->head.triangle_count;
        model->reach = fmax(model->reach, reach_of(mesh, part->transform));
        const uint32_t names[2] = {mesh->of_model, mesh->head.material};
        model->hash = model_hash(model->hash, part->transform, sizeof part->transform);
        model->hash = model_hash(model->hash, names, sizeof names);
    }
    return model->part_count > 0 || refuse(r->fault, r->path, "holds no triangles");
}

/* ---- files -------------------------------------------------------------------------------------------------------- */

/* Looks through the file; *weight is how many bytes there are to read. */
static bool check_file(const char *path, mesh_format format, uint64_t *weight, model_fault *fault)
{
    regular_file read;
    size_t length = 0;
    char *bytes = regular_file_read(&read, path, false, MAX_FILE_BYTES, "is too large", &length);
    if (bytes == NULL) {
        char what[160];
        snprintf(what, sizeof what, read.fault == REGULAR_FILE_MISSING ? "%s (scripts/fetch_models gets those of the project's own scenes)" : "%s", read.what);
        refuse(fault, path, what);
        fault->kind = scene_error_of_fault(read.fault);
        return false;
    }
    *weight = length;
    const bool good = format == FORMAT_OBJ ? obj_check(path, bytes, length, fault) : gltf_check(path, bytes, length, format == FORMAT_GLB, weight, fault);
    free(bytes);
    return good;
}

/* What assimp said, as one line. */
static bool refuse_import(const wire_header *header, const char *path, model_fault *fault)
{
    char what[sizeof header->what + 64];
    const int length = (int)sizeof header->what - 1;
    if (header->status == WIRE_MEMORY)
        return refuse(fault, path, "needs more memory than a file of its size may take");
    if (header->status == WIRE_MISSING)
        snprintf(what, sizeof what, "refers to %.*s, which cannot be read", length, header->what);
    else
        snprintf(what, sizeof what, "cannot be understood: %.*s", length, header->what);
    return refuse(fault, path, what);
}

bool model_load(scene_model *out, const char *path, model_use use, uint64_t *pixels, model_fault *fault)
{
    const mesh_format format = format_of(path);
    model_import import;
    uint64_t weight = 0;
    *out = (scene_model){.hash = 1};
    if (format == FORMAT_UNKNOWN)
        return refuse(fault, path, "has another extension");
    if (format == FORMAT_PLY)
        return ply_load(out, path, use.dry, fault);
    if (!check_file(path, format, &weight, fault) || !model_import_run(&import, path, weight, fault))
        return false;
    model_reader r = {.at = import.bytes,
                      .end = import.bytes + import.length,
                      .path = path,
                      .own = use.own_materials,
                      .dry = use.dry,
                      .pixels = pixels,
                      .format = format,
                      .model = out,
                      .fault = fault};
    memcpy(&r.header, take(&r, sizeof r.header), sizeof r.header);
    const bool good =
        r.header.status == WIRE_GOOD ? take_pictures(&r) && read_materials(&r) && read_meshes(&r) && read_parts(&r) : refuse_import(&r.header, path, fault);
    model_import_end(&import);
    free(r.pictures);
    free(r.materials);
    free(r.meshes);
    if (!good)
        model_free(out);
    return good;
}
