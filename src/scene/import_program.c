/* SPDX-License-Identifier: MIT
 *
 * mangata-import: reads one glTF or OBJ file with assimp (Open Asset Import) and writes what a scene needs of it to standard output, as model_wire.h says.
 * Programs start it for each such file, so that a crash of assimp or its use of memory does not end them. It limits itself, and ends with the process that
 * started it.
 *
 *     mangata-import FILE PARENT MEGABYTES SECONDS
 */
#define _GNU_SOURCE /* close_range */

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/regular_file.h"
#include "mangata/mangata.h"
#include "scene/model_wire.h"

enum { MAX_DEPTH = 256 };

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { SANITIZED = 1 };
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
enum { SANITIZED = 1 };
#else
enum { SANITIZED = 0 };
#endif
#else
enum { SANITIZED = 0 };
#endif

/* ---- output ------------------------------------------------------------------------------------------------------- */

static void put(const void *bytes, size_t size)
{
    static const char zeros[8];
    if ((size > 0 && fwrite(bytes, 1, size, stdout) != size) || fwrite(zeros, 1, (0 - size) & 7, stdout) != ((0 - size) & 7))
        _exit(1);
}

static int ends(wire_status status, const char *what)
{
    wire_header header = {.magic = WIRE_MAGIC, .status = status};
    snprintf(header.what, sizeof header.what, "%s", what);
    put(&header, sizeof header);
    return fflush(stdout) == 0 ? 0 : 1;
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

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    file_access *access = (file_access *)(void *)io->UserData;
    regular_file found = {0};
    struct aiFile *file = strchr(mode, 'w') == NULL && regular_file_open(&found, path) ? malloc(sizeof *file) : NULL;
    if (file == NULL) {
        access->missing = true;
        snprintf(access->name, sizeof access->name, "%s", path);
        if (found.stream != NULL)
            fclose(found.stream);
        return NULL;
    }
    *file = (struct aiFile){.ReadProc = file_read,
                            .WriteProc = file_write,
                            .TellProc = file_tell,
                            .FileSizeProc = file_size,
                            .SeekProc = file_seek,
                            .FlushProc = file_flush,
                            .UserData = (char *)found.stream};
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose((FILE *)(void *)file->UserData);
    free(file);
}

/* ---- import ------------------------------------------------------------------------------------------------------- */

static const struct aiScene *import(const char *path, file_access *access)
{
    struct aiFileIO io = {.OpenProc = open_file, .CloseProc = close_file, .UserData = (char *)access};
    struct aiPropertyStore *store = aiCreatePropertyStore();
    const char *dot = strrchr(path, '.');
    bool smooth = false;
    aiSetImportPropertyInteger(store, AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const struct aiScene *scene =
        aiImportFileExWithProperties(path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType, &io, store);
    for (unsigned i = 0; scene != NULL && i < scene->mNumMeshes; i++)
        smooth |= scene->mMeshes[i]->mNormals == NULL;
    /* Where corners do not share their vertices there is nothing to be smooth between. */
    return smooth && dot != NULL && strcasecmp(dot, ".obj") == 0 ? aiApplyPostProcessing(scene, aiProcess_JoinIdenticalVertices) : scene;
}

/* ---- materials ---------------------------------------------------------------------------------------------------- */

static float number_of(const struct aiMaterial *m, const char *key)
{
    ai_real value;
    return aiGetMaterialFloatArray(m, key, 0, 0, &value, NULL) == aiReturn_SUCCESS ? (float)value : NAN;
}

static bool picture_name(const struct aiMaterial *m, struct aiString *name)
{
    return aiGetMaterialTexture(m, aiTextureType_BASE_COLOR, 0, name, NULL, NULL, NULL, NULL, NULL, NULL) == aiReturn_SUCCESS ||
           aiGetMaterialTexture(m, aiTextureType_DIFFUSE, 0, name, NULL, NULL, NULL, NULL, NULL, NULL) == aiReturn_SUCCESS;
}

static bool is_plain(const struct aiMaterial *m)
{
    struct aiString name;
    return aiGetMaterialString(m, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS && strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
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

static void put_picture(const struct aiScene *scene, const char *name)
{
    const struct aiTexture *inside = inner_picture(scene, name);
    wire_picture out = {.kind = WIRE_PICTURE_FILE, .length = (uint32_t)strlen(name)};
    const void *bytes = name;
    if (inside != NULL) {
        out.kind = inside->mHeight == 0 ? WIRE_PICTURE_INSIDE : WIRE_PICTURE_RAW;
        out.length = inside->mHeight == 0 ? inside->mWidth : 0;
        bytes = inside->pcData;
    }
    put(&out, sizeof out);
    put(bytes, out.length);
}

static void put_material(const struct aiMaterial *m, uint32_t picture)
{
    struct aiColor4D color = {0};
    wire_material out = {.plain = is_plain(m),
                         .shininess = number_of(m, "$mat.shininess"),
                         .roughness = number_of(m, "$mat.roughnessFactor"),
                         .metallic = number_of(m, "$mat.metallicFactor"),
                         .picture = picture};
    out.has_color =
        aiGetMaterialColor(m, AI_MATKEY_BASE_COLOR, &color) == aiReturn_SUCCESS || aiGetMaterialColor(m, AI_MATKEY_COLOR_DIFFUSE, &color) == aiReturn_SUCCESS;
    out.base_color[0] = (float)color.r;
    out.base_color[1] = (float)color.g;
    out.base_color[2] = (float)color.b;
    put(&out, sizeof out);
}

/* ---- meshes and nodes --------------------------------------------------------------------------------------------- */

/* Triangles alone; SIZE_MAX where a polygon could not be cut. */
static size_t triangles_of(const struct aiMesh *mesh)
{
    if (!(mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE))
        return 0;
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        if (mesh->mFaces[i].mNumIndices != 3)
            return SIZE_MAX;
    return mesh->mNumFaces;
}

static void put_mesh(const struct aiMesh *mesh)
{
    const struct aiVector3D *texcoords = mesh->mTextureCoords[0];
    const size_t vertices = mesh->mNumVertices, triangles = triangles_of(mesh);
    wire_mesh out = {.triangle_count = (uint32_t)triangles, .material = mesh->mMaterialIndex};
    if (triangles > 0) {
        out.vertex_count = mesh->mNumVertices;
        out.has_normals = mesh->mNormals != NULL;
        out.has_texcoords = texcoords != NULL;
    }
    put(&out, sizeof out);
    if (triangles == 0)
        return;
    put(mesh->mVertices, vertices * 3 * sizeof(float));
    put(mesh->mNormals, out.has_normals ? vertices * 3 * sizeof(float) : 0);
    float *pairs = out.has_texcoords ? malloc(vertices * 2 * sizeof *pairs) : NULL;
    uint32_t *indices = malloc(triangles * 3 * sizeof *indices);
    if (indices == NULL || (out.has_texcoords && pairs == NULL))
        _exit(1);
    for (size_t i = 0; pairs != NULL && i < vertices; i++) {
        pairs[2 * i] = texcoords[i].x;
        pairs[2 * i + 1] = texcoords[i].y;
    }
    put(pairs, pairs != NULL ? vertices * 2 * sizeof *pairs : 0);
    for (size_t i = 0; i < triangles; i++)
        memcpy(indices + 3 * i, mesh->mFaces[i].mIndices, 3 * sizeof *indices);
    put(indices, triangles * 3 * sizeof *indices);
    free(pairs);
    free(indices);
}

/* The parts of a node and of those below it, written where `write` says so, else counted. NULL: all is well. */
static const char *visit(const struct aiScene *scene, const struct aiNode *node, const double above[3][4], int depth, bool write, uint32_t *count)
{
    const struct aiMatrix4x4 *m = &node->mTransformation;
    const double own[3][4] = {{(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4},
                              {(double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4},
                              {(double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4}};
    wire_part part = {0};
    if (depth > MAX_DEPTH)
        return "nests its nodes deeper than 256";
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            part.transform[i][j] = above[i][0] * own[0][j] + above[i][1] * own[1][j] + above[i][2] * own[2][j] + (j == 3 ? above[i][3] : 0);
            if (!isfinite(part.transform[i][j]))
                return "places a mesh at a position that is not a number";
        }
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        if (scene->mMeshes[node->mMeshes[i]]->mNumFaces == 0 || triangles_of(scene->mMeshes[node->mMeshes[i]]) == 0)
            continue;
        if (++*count > MGT_MAX_OBJECTS)
            return "places more than 65536 meshes";
        part.mesh = node->mMeshes[i];
        if (write)
            put(&part, sizeof part);
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        const char *fault = visit(scene, node->mChildren[i], part.transform, depth + 1, write, count);
        if (fault != NULL)
            return fault;
    }
    return NULL;
}

static int write_scene(const struct aiScene *scene)
{
    static const double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    wire_header header = {.magic = WIRE_MAGIC, .material_count = scene->mNumMaterials, .mesh_count = scene->mNumMeshes};
    struct aiString name;
    uint64_t triangles = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        const size_t count = triangles_of(scene->mMeshes[i]);
        if (count == SIZE_MAX)
            return ends(WIRE_BAD, "holds a polygon that cannot be cut into triangles");
        triangles += count;
    }
    if (triangles > MGT_MAX_TRIANGLES)
        return ends(WIRE_BAD, "holds more than 67108864 triangles");
    const char *fault = visit(scene, scene->mRootNode, identity, 0, false, &header.part_count);
    if (fault != NULL)
        return ends(WIRE_BAD, fault);
    for (unsigned i = 0; i < scene->mNumMaterials; i++)
        header.picture_count += !is_plain(scene->mMaterials[i]) && picture_name(scene->mMaterials[i], &name);
    put(&header, sizeof header);
    for (unsigned i = 0; i < scene->mNumMaterials; i++)
        if (!is_plain(scene->mMaterials[i]) && picture_name(scene->mMaterials[i], &name))
            put_picture(scene, name.data);
    for (uint32_t i = 0, picture = 0; i < scene->mNumMaterials; i++) {
        const bool has = !is_plain(scene->mMaterials[i]) && picture_name(scene->mMaterials[i], &name);
        put_material(scene->mMaterials[i], has ? picture++ : WIRE_NONE);
    }
    for (unsigned i = 0; i < scene->mNumMeshes; i++)
        put_mesh(scene->mMeshes[i]);
    uint32_t again = 0;
    visit(scene, scene->mRootNode, identity, 0, true, &again);
    return fflush(stdout) == 0 ? 0 : 1;
}

/* ---- limits ------------------------------------------------------------------------------------------------------- */

static void limit(int resource, rlim_t value)
{
    struct rlimit old;
    if (getrlimit(resource, &old) == 0 && (old.rlim_max == RLIM_INFINITY || old.rlim_max > value))
        setrlimit(resource, &(struct rlimit){value, value});
}

static int run(const char *path)
{
    file_access access = {0};
    const struct aiScene *scene = import(path, &access);
    if (scene != NULL)
        return write_scene(scene);
    const char *what = aiGetErrorString();
    if (strstr(what, "bad_alloc") != NULL || strstr(what, "length_error") != NULL)
        return ends(WIRE_MEMORY, "");
    return access.missing ? ends(WIRE_MISSING, access.name) : ends(WIRE_BAD, what);
}

int main(int argc, char **argv)
{
    if (argc != 5) {
        fputs("mangata-import is a part of mangata and started by it: mangata-import FILE PARENT MEGABYTES SECONDS\n", stderr);
        return 64;
    }
    const rlim_t bytes = (rlim_t)strtoull(argv[3], NULL, 10) << 20, seconds = (rlim_t)strtoull(argv[4], NULL, 10);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != (pid_t)strtol(argv[2], NULL, 10))
        return 1; /* it has ended before */
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    close_range(WIRE_LIFE + 1, ~0u, 0);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, seconds);
    if (!SANITIZED) {
        limit(RLIMIT_AS, bytes);
        limit(RLIMIT_FSIZE, bytes);
    }
    /* Without tidying up, which takes time, and which assimp does not do after some damaged files. */
    _exit(run(argv[1]));
}
