/* SPDX-License-Identifier: MIT
 *
 * Meshes from files: glTF and OBJ, read by Open Asset Import (assimp), and PLY.
 */
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "scene/model_ply.h"
#include "scene/scene_sea.h"

enum { MAX_DEPTH = 256 };
static const uint64_t MAX_FILE_BYTES = (uint64_t)8 << 30;

typedef enum mesh_format { FORMAT_UNKNOWN, FORMAT_GLTF, FORMAT_OBJ, FORMAT_PLY } mesh_format;

static mesh_format format_of(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot == NULL                                                     ? FORMAT_UNKNOWN
           : strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0 ? FORMAT_GLTF
           : strcasecmp(dot, ".obj") == 0                                  ? FORMAT_OBJ
           : strcasecmp(dot, ".ply") == 0                                  ? FORMAT_PLY
                                                                           : FORMAT_UNKNOWN;
}

static bool refuse(model_fault *fault, const char *path, const char *what)
{
    return model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: triangles or polygons in a sound .gltf, .glb, .obj or .ply file of at most 8 GiB",
                           scene_file_name(path).text, what);
}

/* ---- files: regular ones only, so that nothing waits; those that are missing are remembered ---------------------- */

typedef struct file_access {
    bool missing; /* one that the first refers to */
    char name[192];
} file_access;

static size_t file_read(struct aiFile *file, char *bytes, size_t size, size_t count) { return fread(bytes, size, count, (FILE *)(void *)file->UserData); }

static size_t file_write(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file) { return (size_t)ftello((FILE *)(void *)file->UserData); }

static size_t file_size(struct aiFile *file)
{
    struct stat status;
    return fstat(fileno((FILE *)(void *)file->UserData), &status) == 0 ? (size_t)status.st_size : 0;
}

static enum aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    const int whence = origin == aiOrigin_SET ? SEEK_SET : origin == aiOrigin_CUR ? SEEK_CUR : SEEK_END;
    return fseeko((FILE *)(void *)file->UserData, (off_t)offset, whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static void file_flush(struct aiFile *file) { (void)file; }

static bool is_readable(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode) && (uint64_t)status.st_size <= MAX_FILE_BYTES;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    file_access *access = (file_access *)(void *)io->UserData;
    FILE *stream = strchr(mode, 'w') == NULL && is_readable(path) ? fopen(path, "rbe") : NULL;
    struct aiFile *file = stream != NULL ? malloc(sizeof *file) : NULL;
    if (file == NULL) {
        access->missing = true;
        snprintf(access->name, sizeof access->name, "%s", scene_file_name(path).text);
        if (stream != NULL)
            fclose(stream);
        return NULL;
    }
    *file = (struct aiFile){.ReadProc = file_read,
                            .WriteProc = file_write,
                            .TellProc = file_tell,
                            .FileSizeProc = file_size,
                            .SeekProc = file_seek,
                            .FlushProc = file_flush,
                            .UserData = (char *)stream};
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose((FILE *)(void *)file->UserData);
    free(file);
}

/* ---- import ----------------------------------------------------------------------------------------------------- */

typedef struct model_reader {
    const struct aiScene *scene;
    const char *path;
    bool dry;
    mesh_format format;
    scene_model *model;
    model_fault *fault;
    uint32_t *mesh_of;       /* of each of the scene's: which of the model's, or none */
    mgt_material *materials; /* of each of the scene's */
    size_t part_room;
} model_reader;

static const uint32_t NO_MESH = UINT32_MAX;

static const struct aiScene *import(const char *path, mesh_format format, model_fault *fault)
{
    file_access access = {0};
    struct aiFileIO io = {.OpenProc = open_file, .CloseProc = close_file, .UserData = (char *)&access};
    struct aiPropertyStore *store = aiCreatePropertyStore();
    if (store == NULL) {
        model_fault_memory(fault);
        return NULL;
    }
    aiSetImportPropertyInteger(store, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const struct aiScene *scene =
        aiImportFileExWithProperties(path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType, &io, store);
    aiReleasePropertyStore(store);
    if (scene == NULL) {
        char what[256];
        if (access.missing)
            snprintf(what, sizeof what, "refers to %s, which cannot be read", access.name);
        else
            snprintf(what, sizeof what, "cannot be understood: %.200s", aiGetErrorString());
        refuse(fault, path, what);
        return NULL;
    }
    bool smooth = false;
    for (unsigned i = 0; i < scene->mNumMeshes; i++)
        smooth |= scene->mMeshes[i]->mNormals == NULL;
    /* Where corners do not share their vertices there is nothing to be smooth between. */
    return smooth && format == FORMAT_OBJ ? aiApplyPostProcessing(scene, aiProcess_JoinIdenticalVertices) : scene;
}

/* ---- materials -------------------------------------------------------------------------------------------------- */

static float within(float value, float low, float high) { return value >= low ? value <= high ? value : high : low; }

static float number_of(const struct aiMaterial *m, const char *key, float otherwise)
{
    ai_real value;
    return aiGetMaterialFloatArray(m, key, 0, 0, &value, NULL) == aiReturn_SUCCESS ? (float)value : otherwise;
}

/* A picture inside the file, by its number, "*3", or its name; NULL where there is none. */
static const struct aiTexture *inner_picture(const struct aiScene *scene, const char *name)
{
    if (name[0] == '*') {
        const unsigned long index = strtoul(name + 1, NULL, 10);
        return index < scene->mNumTextures ? scene->mTextures[index] : NULL;
    }
    for (unsigned i = 0; i < scene->mNumTextures; i++)
        if (strcmp(scene->mTextures[i]->mFilename.data, name) == 0)
            return scene->mTextures[i];
    return NULL;
}

/* Inside the file, or a picture beside it. NULL with the fault filled. */
static const mgt_texture *read_texture(model_reader *r, const char *name)
{
    scene_model *model = r->model;
    uint64_t hash = 0;
    mgt_texture *texture = NULL;
    const struct aiTexture *inside = inner_picture(r->scene, name);
    mgt_texture **textures = realloc(model->textures, (model->texture_count + 1) * sizeof(mgt_texture *));
    if (textures == NULL) {
        model_fault_memory(r->fault);
        return NULL;
    }
    model->textures = textures;
    if (inside != NULL && inside->mHeight == 0) {
        texture = texture_parse(inside->pcData, inside->mWidth, r->path, &hash, r->fault);
    } else if (inside != NULL) {
        refuse(r->fault, r->path, "holds a picture that is not compressed");
    } else {
        char *path = scene_file_beside(r->path, name);
        for (char *at = path; at != NULL && *at != '\0'; at++)
            if (*at == '\\')
                *at = '/';
        if (path != NULL)
            texture = texture_load(path, &hash, r->fault);
        else
            model_fault_memory(r->fault);
        free(path);
    }
    if (texture == NULL) {
        const size_t used = strlen(r->fault->text);
        snprintf(r->fault->text + used, sizeof r->fault->text - used, ", or a material in the scene");
        return NULL;
    }
    model->textures[model->texture_count++] = texture;
    model->hash = model_hash(model->hash, &hash, sizeof hash);
    return texture;
}

static bool read_material(model_reader *r, const struct aiMaterial *m, mgt_material *out)
{
    struct aiColor4D color;
    struct aiString text;
    *out = scene_material_defaults();
    if (aiGetMaterialString(m, AI_MATKEY_NAME, &text) == aiReturn_SUCCESS && strcmp(text.data, AI_DEFAULT_MATERIAL_NAME) == 0)
        return true;
    if (aiGetMaterialColor(m, AI_MATKEY_BASE_COLOR, &color) == aiReturn_SUCCESS || aiGetMaterialColor(m, AI_MATKEY_COLOR_DIFFUSE, &color) == aiReturn_SUCCESS) {
        out->base_color[0] = within((float)color.r, 0, 1);
        out->base_color[1] = within((float)color.g, 0, 1);
        out->base_color[2] = within((float)color.b, 0, 1);
    }
    /* Of Blinn and Phong's exponent where there is no roughness: the same width of the highlight. */
    const float exponent = number_of(m, "$mat.shininess", 0);
    const float like = exponent > 0 ? sqrtf(sqrtf(2 / (exponent + 2))) : out->roughness;
    out->roughness = within(number_of(m, "$mat.roughnessFactor", like), 0.02f, 1);
    out->metallic = within(number_of(m, "$mat.metallicFactor", 0), 0, 1);
    if (aiGetMaterialTexture(m, aiTextureType_BASE_COLOR, 0, &text, NULL, NULL, NULL, NULL, NULL, NULL) == aiReturn_SUCCESS ||
        aiGetMaterialTexture(m, aiTextureType_DIFFUSE, 0, &text, NULL, NULL, NULL, NULL, NULL, NULL) == aiReturn_SUCCESS) {
        out->texture = read_texture(r, text.data);
        return out->texture != NULL;
    }
    return true;
}

static bool read_materials(model_reader *r, bool own)
{
    const unsigned count = r->scene->mNumMaterials;
    r->materials = calloc(count + 1, sizeof *r->materials);
    if (r->materials == NULL)
        return model_fault_memory(r->fault);
    for (unsigned i = 0; i < count; i++) {
        if (own && !read_material(r, r->scene->mMaterials[i], &r->materials[i]))
            return false;
        mgt_material plain = own ? r->materials[i] : scene_material_defaults();
        r->materials[i] = plain;
        plain.texture = NULL;
        r->model->hash = model_hash(r->model->hash, &plain.base_color, sizeof plain.base_color);
        r->model->hash = model_hash(r->model->hash, &plain.roughness, sizeof plain.roughness);
        r->model->hash = model_hash(r->model->hash, &plain.metallic, sizeof plain.metallic);
    }
    return true;
}

/* ---- meshes ----------------------------------------------------------------------------------------------------- */

/* Indices and texture coordinates as the library wants them; positions and normals are borrowed. */
static bool convert(const model_reader *r, const struct aiMesh *mesh, mesh_data *out)
{
    *out = (mesh_data){.positions = (float *)mesh->mVertices, .vertex_count = mesh->mNumVertices, .triangle_count = mesh->mNumFaces};
    out->indices = malloc((size_t)mesh->mNumFaces * 3 * sizeof *out->indices);
    if (mesh->mTextureCoords[0] != NULL)
        out->texcoords = malloc((size_t)mesh->mNumVertices * 2 * sizeof *out->texcoords);
    if (out->indices == NULL || (mesh->mTextureCoords[0] != NULL && out->texcoords == NULL))
        return false;
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        memcpy(out->indices + 3 * (size_t)i, mesh->mFaces[i].mIndices, 3 * sizeof *out->indices);
    for (unsigned i = 0; out->texcoords != NULL && i < mesh->mNumVertices; i++) {
        out->texcoords[2 * (size_t)i] = mesh->mTextureCoords[0][i].x;
        out->texcoords[2 * (size_t)i + 1] = 1 - mesh->mTextureCoords[0][i].y; /* assimp counts from the bottom */
    }
    /* A glTF without normals is flat by its own rules; the others say nothing. */
    return mesh->mNormals != NULL || r->format == FORMAT_GLTF || mesh_data_smooth(out);
}

static bool read_mesh(model_reader *r, unsigned index)
{
    const struct aiMesh *mesh = r->scene->mMeshes[index];
    scene_model *model = r->model;
    r->mesh_of[index] = NO_MESH;
    if (!(mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE) || mesh->mNumFaces == 0)
        return true;
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        if (mesh->mFaces[i].mNumIndices != 3)
            return refuse(r->fault, r->path, "holds a polygon that cannot be cut into triangles");
    mesh_data data;
    bool good = convert(r, mesh, &data) || model_fault_memory(r->fault);
    if (good) {
        mgt_mesh_desc desc;
        mgt_mesh_desc_init(&desc, sizeof desc);
        desc.positions = data.positions;
        desc.normals = mesh->mNormals != NULL ? (const float *)mesh->mNormals : data.normals;
        desc.texcoords = data.texcoords;
        desc.vertex_count = mesh->mNumVertices;
        desc.indices = data.indices;
        desc.triangle_count = mesh->mNumFaces;
        desc.dry = r->dry;
        const mgt_status status = mgt_mesh_create(&model->meshes[model->mesh_count], &desc);
        good = status == MGT_OK || (status == MGT_ERROR_MEMORY ? model_fault_memory(r->fault) : refuse(r->fault, r->path, mgt_last_error(NULL)));
        if (good) {
            r->mesh_of[index] = (uint32_t)model->mesh_count++;
            model->hash = model_hash(model->hash, desc.positions, (size_t)desc.vertex_count * 3 * sizeof(float));
            model->hash = model_hash(model->hash, desc.indices, (size_t)desc.triangle_count * 3 * sizeof(uint32_t));
            if (desc.normals != NULL)
                model->hash = model_hash(model->hash, desc.normals, (size_t)desc.vertex_count * 3 * sizeof(float));
            if (desc.texcoords != NULL)
                model->hash = model_hash(model->hash, desc.texcoords, (size_t)desc.vertex_count * 2 * sizeof(float));
        }
    }
    data.positions = NULL;
    mesh_data_free(&data);
    return good;
}

static bool read_meshes(model_reader *r)
{
    const unsigned count = r->scene->mNumMeshes;
    uint64_t triangles = 0;
    for (unsigned i = 0; i < count; i++)
        triangles += r->scene->mMeshes[i]->mNumFaces;
    if (triangles > MGT_MAX_TRIANGLES) {
        char what[96];
        snprintf(what, sizeof what, "holds %llu triangles, more than %d", (unsigned long long)triangles, MGT_MAX_TRIANGLES);
        return refuse(r->fault, r->path, what);
    }
    r->mesh_of = calloc((size_t)count + 1, sizeof *r->mesh_of);
    r->model->meshes = calloc((size_t)count + 1, sizeof(mgt_mesh *));
    if (r->mesh_of == NULL || r->model->meshes == NULL)
        return model_fault_memory(r->fault);
    for (unsigned i = 0; i < count; i++)
        if (!read_mesh(r, i))
            return false;
    return true;
}

/* ---- nodes ------------------------------------------------------------------------------------------------------ */

static double reach_of(const struct aiMesh *mesh, const double t[3][4])
{
    double reach = 0;
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const double x = (double)mesh->mVertices[i].x, y = (double)mesh->mVertices[i].y, z = (double)mesh->mVertices[i].z;
        for (int k = 0; k < 3; k++)
            reach = fmax(reach, fabs(t[k][0] * x + t[k][1] * y + t[k][2] * z + t[k][3]));
    }
    return reach;
}

static bool add_part(model_reader *r, unsigned index, const double transform[3][4])
{
    scene_model *model = r->model;
    const struct aiMesh *mesh = r->scene->mMeshes[index];
    if (r->mesh_of[index] == NO_MESH)
        return true;
    if (model->part_count == MGT_MAX_OBJECTS)
        return refuse(r->fault, r->path, "places more than 65536 meshes");
    if (model->part_count == r->part_room) {
        const size_t room = 2 * r->part_room + 8;
        model_part *parts = realloc(model->parts, room * sizeof *parts);
        if (parts == NULL)
            return model_fault_memory(r->fault);
        model->parts = parts;
        r->part_room = room;
    }
    model_part *part = &model->parts[model->part_count++];
    *part = (model_part){.mesh = model->meshes[r->mesh_of[index]], .material = r->materials[mesh->mMaterialIndex]};
    memcpy(part->transform, transform, sizeof part->transform);
    model->triangles += mesh->mNumFaces;
    model->reach = fmax(model->reach, reach_of(mesh, transform));
    const uint32_t names[2] = {r->mesh_of[index], mesh->mMaterialIndex};
    model->hash = model_hash(model->hash, transform, sizeof part->transform);
    model->hash = model_hash(model->hash, names, sizeof names);
    return true;
}

static bool add_node(model_reader *r, const struct aiNode *node, const double above[3][4], int depth)
{
    const struct aiMatrix4x4 *m = &node->mTransformation;
    const double own[3][4] = {{(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4},
                              {(double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4},
                              {(double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4}};
    double whole[3][4];
    if (depth > MAX_DEPTH)
        return refuse(r->fault, r->path, "nests its nodes deeper than 256");
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            whole[i][j] = above[i][0] * own[0][j] + above[i][1] * own[1][j] + above[i][2] * own[2][j] + (j == 3 ? above[i][3] : 0);
            if (!isfinite(whole[i][j]))
                return refuse(r->fault, r->path, "places a mesh at what is not a number");
        }
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (!add_part(r, node->mMeshes[i], whole))
            return false;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!add_node(r, node->mChildren[i], whole, depth + 1))
            return false;
    return true;
}

bool model_load(scene_model *out, const char *path, model_use use, model_fault *fault)
{
    static const double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    *out = (scene_model){.hash = 1};
    const mesh_format format = format_of(path);
    if (format == FORMAT_UNKNOWN)
        return refuse(fault, path, "has another extension");
    struct stat status;
    if (stat(path, &status) != 0) {
        char what[160];
        snprintf(what, sizeof what, "%s (scripts/fetch_models gets those of the project's own scenes)", strerror(errno));
        refuse(fault, path, what);
        fault->kind = SCENE_ERROR_MISSING_INPUT;
        return false;
    }
    if (!is_readable(path))
        return refuse(fault, path, S_ISREG(status.st_mode) ? "is too large" : "is no regular file");
    if (format == FORMAT_PLY)
        return ply_load(out, path, use.dry, fault);
    const struct aiScene *scene = import(path, format, fault);
    if (scene == NULL)
        return false;
    model_reader r = {.scene = scene, .path = path, .dry = use.dry, .format = format, .model = out, .fault = fault};
    bool good = read_materials(&r, use.own_materials) && read_meshes(&r) && add_node(&r, scene->mRootNode, identity, 0);
    if (good && out->part_count == 0)
        good = refuse(fault, path, "holds no triangles");
    aiReleaseImport(scene);
    free(r.mesh_of);
    free(r.materials);
    if (!good)
        model_free(out);
    return good;
}
