/* SPDX-License-Identifier: MIT
 *
 * Meshes from PLY files (Stanford triangle format), text or binary. Read here rather than by assimp, which waits forever for the rest of a file that is
 * cut off in its header.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/model_ply.h"

enum { MAX_PROPERTIES = 64, MAX_ELEMENTS = 16, MAX_POLYGON = 65536 };

typedef enum ply_encoding { PLY_TEXT, PLY_LITTLE, PLY_BIG } ply_encoding;
typedef enum ply_type { TYPE_NONE, TYPE_I8, TYPE_U8, TYPE_I16, TYPE_U16, TYPE_I32, TYPE_U32, TYPE_F32, TYPE_F64 } ply_type;

/* What a value is for. */
typedef enum ply_role { ROLE_NONE, ROLE_X, ROLE_Y, ROLE_Z, ROLE_NX, ROLE_NY, ROLE_NZ, ROLE_S, ROLE_T, ROLE_INDICES, ROLE_COUNT } ply_role;

typedef struct ply_property {
    ply_type type, count_type; /* count_type: of a list's length; TYPE_NONE: no list */
    ply_role role;
} ply_property;

typedef struct ply_element {
    bool is_vertex, is_face;
    size_t count;
    ply_property properties[MAX_PROPERTIES];
    size_t property_count;
} ply_element;

typedef struct ply_reader {
    const char *bytes, *at, *end;
    const char *word; /* where what is read begins; NULL: in binary values, which have no lines */
    const char *name;
    model_fault *fault;
    ply_encoding encoding;
    ply_element elements[MAX_ELEMENTS];
    size_t element_count;
    mesh_data mesh;
    size_t triangle_room;
} ply_reader;

static bool refuse(ply_reader *r, const char *what)
{
    scene_place place = {1, 1};
    for (const char *p = r->bytes; r->word != NULL && p < r->word; p++)
        place = *p == '\n' ? (scene_place){place.line + 1, 1} : (scene_place){place.line, place.column + 1};
    if (r->word != NULL)
        return model_fault_set(r->fault, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: %s; allowed: a sound PLY file of triangles or polygons",
                               scene_file_name(r->name).text, place.line, place.column, what);
    return model_fault_set(r->fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: a sound PLY file of triangles or polygons", scene_file_name(r->name).text, what);
}

/* ---- header ------------------------------------------------------------------------------------------------------ */

/* The next line as at most five words, which are cut where they are long. Returns how many there are, -1 at the end of the file. */
static int next_line(ply_reader *r, char words[5][32])
{
    const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
    int count = 0;
    r->word = r->at;
    if (stop == NULL)
        return -1;
    for (const char *p = r->at; p < stop && count < 5;) {
        while (p < stop && (*p == ' ' || *p == '\t' || *p == '\r'))
            p++;
        const char *word = p;
        while (p < stop && *p != ' ' && *p != '\t' && *p != '\r')
            p++;
        if (p > word)
            snprintf(words[count++], sizeof words[0], "%.*s", (int)(p - word < 31 ? p - word : 31), word);
    }
    r->at = stop + 1;
    return count;
}

static ply_type type_of(const char *word)
{
    static const struct {
        const char *name;
        ply_type type;
    } types[] = {{"char", TYPE_I8},    {"int8", TYPE_I8},     {"uchar", TYPE_U8},   {"uint8", TYPE_U8},   {"short", TYPE_I16}, {"int16", TYPE_I16},
                 {"ushort", TYPE_U16}, {"uint16", TYPE_U16},  {"int", TYPE_I32},    {"int32", TYPE_I32},  {"uint", TYPE_U32},  {"uint32", TYPE_U32},
                 {"float", TYPE_F32},  {"float32", TYPE_F32}, {"double", TYPE_F64}, {"float64", TYPE_F64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(word, types[i].name) == 0)
            return types[i].type;
    return TYPE_NONE;
}

static ply_role role_of(const ply_element *e, const char *word, bool list)
{
    static const struct {
        const char *name;
        ply_role role;
    } roles[] = {{"x", ROLE_X}, {"y", ROLE_Y}, {"z", ROLE_Z}, {"nx", ROLE_NX}, {"ny", ROLE_NY},       {"nz", ROLE_NZ},
                 {"s", ROLE_S}, {"t", ROLE_T}, {"u", ROLE_S}, {"v", ROLE_T},   {"texture_u", ROLE_S}, {"texture_v", ROLE_T}};
    if (e->is_face && list && (strcmp(word, "vertex_indices") == 0 || strcmp(word, "vertex_index") == 0))
        return ROLE_INDICES;
    for (size_t i = 0; e->is_vertex && !list && i < sizeof roles / sizeof *roles; i++)
        if (strcmp(word, roles[i].name) == 0)
            return roles[i].role;
    return ROLE_NONE;
}

static bool add_element(ply_reader *r, const char *name, const char *number)
{
    char *end;
    const unsigned long long count = strtoull(number, &end, 10);
    if (*end != '\0' || number[0] == '-')
        return refuse(r, "an element's number in its header is none");
    if (r->element_count == MAX_ELEMENTS)
        return refuse(r, "its header has more than 16 elements");
    r->elements[r->element_count++] = (ply_element){.is_vertex = strcmp(name, "vertex") == 0, .is_face = strcmp(name, "face") == 0, .count = (size_t)count};
    return true;
}

static bool add_property(ply_reader *r, char words[5][32], int count)
{
    ply_element *e = r->element_count > 0 ? &r->elements[r->element_count - 1] : NULL;
    if (e == NULL || e->property_count == MAX_PROPERTIES)
        return refuse(r, "its header has a property without an element, or more than 64 of one");
    const bool list = count == 5 && strcmp(words[1], "list") == 0;
    const ply_property p = {.type = type_of(words[list ? 3 : 1]),
                            .count_type = list ? type_of(words[2]) : TYPE_NONE,
                            .role = role_of(e, words[list ? 4 : 2], list)};
    if ((!list && count != 3) || p.type == TYPE_NONE || (list && (p.count_type == TYPE_NONE || p.count_type >= TYPE_F32)))
        return refuse(r, "its header has a property that is not understood");
    e->properties[e->property_count++] = p;
    return true;
}

static bool read_header(ply_reader *r)
{
    char words[5][32];
    bool has_format = false;
    if (next_line(r, words) < 1 || strcmp(words[0], "ply") != 0)
        return refuse(r, "does not begin with \"ply\"");
    for (;;) {
        const int count = next_line(r, words);
        if (count < 0)
            return refuse(r, "ends in its header");
        if (count == 0 || strcmp(words[0], "comment") == 0 || strcmp(words[0], "obj_info") == 0)
            continue;
        if (strcmp(words[0], "end_header") == 0)
            return has_format || refuse(r, "its header names no format");
        if (strcmp(words[0], "format") == 0 && count >= 2) {
            has_format = true;
            r->encoding = strcmp(words[1], "binary_little_endian") == 0 ? PLY_LITTLE : strcmp(words[1], "binary_big_endian") == 0 ? PLY_BIG : PLY_TEXT;
            if (r->encoding == PLY_TEXT && strcmp(words[1], "ascii") != 0)
                return refuse(r, "its format is none of ascii, binary_little_endian and binary_big_endian");
        } else if (strcmp(words[0], "element") == 0 && count == 3) {
            if (!add_element(r, words[1], words[2]))
                return false;
        } else if (strcmp(words[0], "property") == 0) {
            if (!add_property(r, words, count))
                return false;
        } else {
            return refuse(r, "its header holds a line that is not understood");
        }
    }
}

/* ---- values ------------------------------------------------------------------------------------------------------ */

static bool read_text(ply_reader *r, double *value)
{
    char word[64];
    size_t length = 0;
    while (r->at < r->end && (*r->at == ' ' || *r->at == '\t' || *r->at == '\r' || *r->at == '\n'))
        r->at++;
    r->word = r->at;
    while (r->at < r->end && (*r->at > ' ') && length + 1 < sizeof word)
        word[length++] = *r->at++;
    word[length] = '\0';
    char *end;
    *value = strtod(word, &end);
    return length > 0 && *end == '\0' ? true : refuse(r, r->at == r->end ? "ends too early" : "holds something that is no number");
}

static bool read_value(ply_reader *r, ply_type type, double *value)
{
    static const size_t sizes[] =
        {[TYPE_I8] = 1, [TYPE_U8] = 1, [TYPE_I16] = 2, [TYPE_U16] = 2, [TYPE_I32] = 4, [TYPE_U32] = 4, [TYPE_F32] = 4, [TYPE_F64] = 8};
    if (r->encoding == PLY_TEXT)
        return read_text(r, value);
    const size_t size = sizes[type];
    if ((size_t)(r->end - r->at) < size)
        return refuse(r, "ends too early");
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits |= (uint64_t)(unsigned char)r->at[i] << 8 * (r->encoding == PLY_BIG ? size - 1 - i : i);
    r->at += size;
    const uint32_t low = (uint32_t)bits;
    float single;
    switch (type) {
    case TYPE_I8:
        *value = (int8_t)low;
        break;
    case TYPE_I16:
        *value = (int16_t)low;
        break;
    case TYPE_I32:
        *value = (int32_t)low;
        break;
    case TYPE_F32:
        memcpy(&single, &low, sizeof single);
        *value = (double)single;
        break;
    case TYPE_F64:
        memcpy(value, &bits, sizeof *value);
        break;
    default:
        *value = (double)low;
        break;
    }
    return true;
}

/* ---- elements ----------------------------------------------------------------------------------------------------- */

static bool add_triangle(ply_reader *r, uint32_t a, uint32_t b, uint32_t c)
{
    mesh_data *m = &r->mesh;
    if (m->triangle_count == MGT_MAX_TRIANGLES)
        return refuse(r, "holds more than 67108864 triangles");
    if (m->triangle_count == r->triangle_room) {
        const size_t room = 2 * r->triangle_room + 1024;
        uint32_t *indices = realloc(m->indices, room * 3 * sizeof *indices);
        if (indices == NULL)
            return model_fault_memory(r->fault);
        m->indices = indices;
        r->triangle_room = room;
    }
    uint32_t *index = m->indices + 3 * m->triangle_count++;
    index[0] = a, index[1] = b, index[2] = c;
    return true;
}

/* A list of indices as a fan of triangles, any other list as nothing. */
static bool read_list(ply_reader *r, const ply_property *p)
{
    double length, value;
    uint32_t first = 0, last = 0;
    if (!read_value(r, p->count_type, &length))
        return false;
    if (!(length >= 0 && length <= MAX_POLYGON && length == floor(length)))
        return refuse(r, "holds a list longer than 65536");
    for (uint32_t i = 0; i < (uint32_t)length; i++) {
        if (!read_value(r, p->type, &value))
            return false;
        if (p->role != ROLE_INDICES)
            continue;
        if (!(value >= 0 && value < (double)r->mesh.vertex_count))
            return refuse(r, "a face refers to a vertex that does not exist");
        const uint32_t index = (uint32_t)value;
        if (i == 0)
            first = index;
        else if (i > 1 && !add_triangle(r, first, last, index))
            return false;
        last = index;
    }
    return true;
}

static bool allocate_vertices(ply_reader *r, const ply_element *e, bool normals, bool texcoords)
{
    mesh_data *m = &r->mesh;
    if (m->vertex_count > 0)
        return refuse(r, "has its vertices twice");
    if (e->count == 0 || e->count > UINT32_MAX)
        return refuse(r, "has no vertices, or more than four thousand million");
    m->vertex_count = e->count;
    m->positions = malloc(e->count * 3 * sizeof(float));
    m->normals = normals ? malloc(e->count * 3 * sizeof(float)) : NULL;
    m->texcoords = texcoords ? malloc(e->count * 2 * sizeof(float)) : NULL;
    return (m->positions != NULL && (!normals || m->normals != NULL) && (!texcoords || m->texcoords != NULL)) || model_fault_memory(r->fault);
}

static bool read_element(ply_reader *r, const ply_element *e)
{
    bool has[ROLE_COUNT] = {false};
    double values[ROLE_COUNT] = {0};
    for (size_t i = 0; i < e->property_count; i++)
        has[e->properties[i].role] = true;
    if (e->property_count == 0)
        return true;
    /* Before anything is allocated: each takes a byte at least. */
    if (e->count > (size_t)(r->end - r->at))
        return refuse(r, "ends too early");
    const bool normals = has[ROLE_NX] && has[ROLE_NY] && has[ROLE_NZ], texcoords = has[ROLE_S] && has[ROLE_T];
    if (e->is_vertex && !(has[ROLE_X] && has[ROLE_Y] && has[ROLE_Z]))
        return refuse(r, "its vertices have no x, y and z");
    if (e->is_vertex && !allocate_vertices(r, e, normals, texcoords))
        return false;
    for (size_t i = 0; i < e->count; i++) {
        for (size_t k = 0; k < e->property_count; k++) {
            const ply_property *p = &e->properties[k];
            if (!(p->count_type != TYPE_NONE ? read_list(r, p) : read_value(r, p->type, &values[p->role])))
                return false;
        }
        for (int k = 0; e->is_vertex && k < 3; k++) {
            r->mesh.positions[3 * i + (size_t)k] = (float)values[ROLE_X + k];
            if (normals)
                r->mesh.normals[3 * i + (size_t)k] = (float)values[ROLE_NX + k];
        }
        if (e->is_vertex && texcoords) {
            r->mesh.texcoords[2 * i] = (float)values[ROLE_S];
            r->mesh.texcoords[2 * i + 1] = (float)(1 - values[ROLE_T]); /* counted from the bottom by those who write them */
        }
    }
    return true;
}

bool ply_parse(mesh_data *out, const char *bytes, size_t length, const char *name, model_fault *fault)
{
    ply_reader *r = calloc(1, sizeof *r);
    *out = (mesh_data){0};
    if (r == NULL)
        return model_fault_memory(fault);
    *r = (ply_reader){.bytes = bytes, .at = bytes, .end = bytes + length, .word = bytes, .name = name, .fault = fault};
    bool good = read_header(r);
    if (r->encoding != PLY_TEXT)
        r->word = NULL;
    for (size_t i = 0; good && i < r->element_count; i++)
        good = read_element(r, &r->elements[i]);
    if (good && r->mesh.triangle_count == 0)
        good = refuse(r, "holds no triangles");
    if (good && r->mesh.normals == NULL)
        good = mesh_data_smooth(&r->mesh) || model_fault_memory(fault);
    if (!good)
        mesh_data_free(&r->mesh);
    *out = r->mesh;
    free(r);
    return good;
}

bool ply_load(scene_model *out, const char *path, bool dry, model_fault *fault)
{
    mesh_data mesh = {0};
    regular_file read;
    size_t length = 0;
    char *bytes = regular_file_read(&read, path, false, (size_t)8 << 30, "is larger than 8 GiB", &length);
    if (bytes == NULL)
        return model_fault_set(fault, scene_error_of_fault(read.fault), "%s: %s%s; allowed: a PLY file", scene_file_name(path).text, read.what,
                               read.fault == REGULAR_FILE_MISSING ? " (scripts/fetch_models gets those of the project's own scenes)" : "");
    bool good = ply_parse(&mesh, bytes, length, path, fault);
    free(bytes);
    if (!good)
        return false;
    good = model_of_mesh(out, &mesh, scene_file_name(path).text, dry, fault);
    if (good) {
        out->hash = model_hash(1, mesh.positions, mesh.vertex_count * 3 * sizeof(float));
        out->hash = model_hash(out->hash, mesh.normals, mesh.vertex_count * 3 * sizeof(float));
        out->hash = model_hash(out->hash, mesh.indices, mesh.triangle_count * 3 * sizeof(uint32_t));
        if (mesh.texcoords != NULL)
            out->hash = model_hash(out->hash, mesh.texcoords, mesh.vertex_count * 2 * sizeof(float));
    }
    mesh_data_free(&mesh);
    return good;
}
