/* SPDX-License-Identifier: MIT
 *
 * The glTF 2.0 specification's own rules (Khronos, sections 3.6 and 4.4), as far as the safety of reading depends on them. Animations, skins and cameras, which a
 * scene does not use, are looked at only for what refers to accessors.
 */
#include "scene/gltf_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/gltf_buffers.h"
#include "scene/scene_sea.h"

enum { MAX_NODE_DEPTH = 256, CHUNK_JSON = 0x4e4f534a, CHUNK_BINARY = 0x004e4942, GLB_MAGIC = 0x46546c67 };
/* Bytes of accessors that have no buffer, beside 64 for each byte of the file. */
static const uint64_t FREE_ZEROS = (uint64_t)16 << 20;

/* ---- members ------------------------------------------------------------------------------------------------------ */

static bool is_whole(double value, double low, double high) { return value >= low && value <= high && value == floor(value); }

/* A whole number, `otherwise` where it is left out; at least `low`. */
static bool take_whole(gltf_reader *g, const json_value *object, const char *where, const char *key, double low, double high, double otherwise, double *out)
{
    const json_value *value = json_text_get(&g->json, object, key);
    *out = otherwise;
    if (value == NULL)
        return otherwise >= 0 || gltf_refuse(g, object, "%s.%s is missing; allowed: a whole number, %.17g to %.17g", where, key, low, high);
    if (value->kind != JSON_NUMBER || !is_whole(value->number, low, high))
        return gltf_refuse(g, value, "%s.%s is %.*s; allowed: a whole number, %.17g to %.17g", where, key, value->kind == JSON_NUMBER ? (int)value->length : 12,
                           value->kind == JSON_NUMBER ? g->json.text + value->at : "not a number", low, high);
    *out = value->number;
    return true;
}

/* An index into one of the document's lists, -1 where it is left out and may be. */
static bool take_index(gltf_reader *g, const json_value *object, const char *where, const char *key, const char *list, size_t count, bool needed, long *out)
{
    const json_value *value = json_text_get(&g->json, object, key);
    *out = -1;
    if (value == NULL)
        return !needed || gltf_refuse(g, object, "%s.%s is missing; allowed: one of the %zu %s, from 0", where, key, count, list);
    if (value->kind != JSON_NUMBER || !is_whole(value->number, 0, (double)count - 1))
        return gltf_refuse(g, value, "%s.%s is none of the %zu %s; allowed: their number, from 0", where, key, count, list);
    *out = (long)value->number;
    return true;
}

/* A list or an object; *out is NULL where it is left out and may be. */
static bool take_kind(gltf_reader *g, const json_value *object, const char *where, const char *key, json_kind kind, bool needed, const json_value **out)
{
    static const char *const words[] = {[JSON_STRING] = "a string", [JSON_LIST] = "a list", [JSON_OBJECT] = "an object"};
    *out = json_text_get(&g->json, object, key);
    if (*out == NULL)
        return !needed || gltf_refuse(g, object, "%s.%s is missing; allowed: %s", where, key, words[kind]);
    return (*out)->kind == kind || gltf_refuse(g, *out, "%s.%s is of another kind; allowed: %s", where, key, words[kind]);
}

/* A list of exactly so many finite numbers, where it is there. */
static bool check_numbers(gltf_reader *g, const json_value *object, const char *where, const char *key, uint32_t count)
{
    const json_value *list;
    if (!take_kind(g, object, where, key, JSON_LIST, false, &list))
        return false;
    bool good = list == NULL || list->count == count;
    for (const json_value *v = json_text_first(&g->json, list); v != NULL; v = json_text_next(&g->json, v))
        good &= v->kind == JSON_NUMBER;
    return good || gltf_refuse(g, list, "%s.%s is not a list of %u numbers; allowed: %u finite numbers", where, key, count, count);
}

/* The list of that name at the top, with all its items objects. */
static bool take_items(gltf_reader *g, const char *name, gltf_list *out)
{
    const json_value *list;
    if (!take_kind(g, &g->json.values[0], "document", name, JSON_LIST, false, &list))
        return false;
    *out = (gltf_list){.name = name, .list = list, .count = list != NULL ? list->count : 0};
    for (const json_value *v = json_text_first(&g->json, list); v != NULL; v = json_text_next(&g->json, v))
        if (v->kind != JSON_OBJECT)
            return gltf_refuse(g, v, "%s holds a value that is not an object; allowed: objects", name);
    return true;
}

/* ---- accessors ---------------------------------------------------------------------------------------------------- */

static double component_bytes(double type) { return type <= 5121 ? 1 : type <= 5123 ? 2 : 4; }

static bool take_component(gltf_reader *g, const json_value *object, const char *where, double *type)
{
    if (!take_whole(g, object, where, "componentType", 5120, 5126, -1, type))
        return false;
    return *type != 5124 ||
           gltf_refuse(g, json_text_get(&g->json, object, "componentType"), "%s.componentType is 5124; allowed: 5120 to 5123, 5125, 5126", where);
}

/* Bytes from `offset`, `stride` apart, `count` times `size`, inside a view. */
static bool check_span(gltf_reader *g, const json_value *at, const char *where, long view, double offset, double stride, double count, double size)
{
    const double end = offset + stride * (count - 1) + size, room = (double)g->views[view].length;
    return end <= room ||
           gltf_refuse(g, at, "%s ends %.17g bytes behind the start of bufferViews[%ld], which has %.17g; allowed: bytes inside it", where, end, view, room);
}

/* The indices say which elements are replaced: they are read, as those that lie outside would be written outside. */
static bool check_sparse(gltf_reader *g, const json_value *sparse, const char *name, double elements, double size)
{
    char where[64], inner[80];
    const json_value *indices, *values;
    double count, type, offset;
    long view, value_view;
    snprintf(where, sizeof where, "%s.sparse", name);
    if (!take_whole(g, sparse, where, "count", 1, elements, -1, &count) || !take_kind(g, sparse, where, "indices", JSON_OBJECT, true, &indices) ||
        !take_kind(g, sparse, where, "values", JSON_OBJECT, true, &values))
        return false;
    snprintf(inner, sizeof inner, "%s.indices", where);
    if (!take_index(g, indices, inner, "bufferView", "bufferViews", g->lists[GLTF_VIEWS].count, true, &view) || !take_component(g, indices, inner, &type) ||
        !take_whole(g, indices, inner, "byteOffset", 0, 1e15, 0, &offset))
        return false;
    if (type != 5121 && type != 5123 && type != 5125)
        return gltf_refuse(g, indices, "%s.componentType is %g; allowed: 5121, 5123, 5125", inner, type);
    const double bytes = component_bytes(type);
    if (!check_span(g, indices, inner, view, offset, bytes, count, bytes) ||
        !gltf_check_indices(g, indices, inner, view, (uint64_t)offset, (uint64_t)count, (unsigned)bytes, elements))
        return false;
    snprintf(inner, sizeof inner, "%s.values", where);
    return take_index(g, values, inner, "bufferView", "bufferViews", g->lists[GLTF_VIEWS].count, true, &value_view) &&
           take_whole(g, values, inner, "byteOffset", 0, 1e15, 0, &offset) && check_span(g, values, inner, value_view, offset, size, count, size);
}

static bool check_accessor(gltf_reader *g, const json_value *value, size_t index)
{
    static const struct {
        const char *name;
        int components;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    gltf_accessor *a = &g->accessors[index];
    const json_value *type, *sparse;
    double count, component, offset;
    long view;
    char where[48];
    snprintf(where, sizeof where, "accessors[%zu]", index);
    if (!take_component(g, value, where, &component) || !take_whole(g, value, where, "count", 1, 3.0 * MGT_MAX_TRIANGLES, -1, &count) ||
        !take_kind(g, value, where, "type", JSON_STRING, true, &type) || !take_whole(g, value, where, "byteOffset", 0, 1e15, 0, &offset) ||
        !take_index(g, value, where, "bufferView", "bufferViews", g->lists[GLTF_VIEWS].count, false, &view) ||
        !take_kind(g, value, where, "sparse", JSON_OBJECT, false, &sparse))
        return false;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (json_text_is(&g->json, type, types[i].name))
            a->components = types[i].components;
    if (a->components == 0)
        return gltf_refuse(g, type, "%s.type is unknown; allowed: SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4", where);
    a->count = (uint64_t)count;
    a->component_type = (int)component;
    const double size = a->components * component_bytes(component);
    if (view >= 0) {
        const double stride = g->views[view].stride > 0 ? g->views[view].stride : size;
        if (!check_span(g, value, where, view, offset, stride, count, size))
            return false;
    } else {
        g->zeros += (uint64_t)(count * size);
        if (g->zeros > FREE_ZEROS + 64 * g->weight)
            return gltf_refuse(g, value, "%s has no bufferView: with it %llu bytes come from nothing; allowed: at most %llu in a file of this size", where,
                               (unsigned long long)g->zeros, (unsigned long long)(FREE_ZEROS + 64 * g->weight));
    }
    return sparse == NULL || check_sparse(g, sparse, where, count, size);
}

/* ---- meshes ------------------------------------------------------------------------------------------------------- */

/* What an attribute may be made of; those with other names are free. */
typedef struct attribute_rule {
    const char *name; /* the beginning */
    int least, most;  /* components */
    bool floats;
} attribute_rule;

static bool check_attributes(gltf_reader *g, const json_value *attributes, const char *where, uint64_t *vertices)
{
    static const attribute_rule rules[] = {{"POSITION", 3, 3, true}, {"NORMAL", 3, 3, true},   {"TANGENT", 3, 4, true},  {"TEXCOORD_", 2, 2, false},
                                           {"COLOR_", 3, 4, false},  {"JOINTS_", 4, 4, false}, {"WEIGHTS_", 4, 4, false}};
    for (const json_value *v = json_text_first(&g->json, attributes); v != NULL; v = json_text_next(&g->json, v)) {
        const char *name = g->json.text + v->key_at;
        if (v->kind != JSON_NUMBER || !is_whole(v->number, 0, (double)g->lists[GLTF_ACCESSORS].count - 1))
            return gltf_refuse(g, v, "%s.%s is none of the %zu accessors; allowed: their number, from 0", where, scene_quote_text(name, v->key_length).text,
                               g->lists[GLTF_ACCESSORS].count);
        const gltf_accessor *a = &g->accessors[(size_t)v->number];
        for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
            const size_t length = strlen(rules[i].name);
            if (v->key_length < length || memcmp(name, rules[i].name, length) != 0)
                continue;
            if (a->components < rules[i].least || a->components > rules[i].most || (rules[i].floats && a->component_type != 5126))
                return gltf_refuse(g, v, "%s.%s is of another type; allowed: %d%s%s", where, rules[i].name, rules[i].least,
                                   rules[i].most > rules[i].least ? " or more components" : " components", rules[i].floats ? ", floats" : "");
            if (*vertices == 0)
                *vertices = a->count;
            if (a->count != *vertices)
                return gltf_refuse(g, v, "%s.%s has %llu elements, others %llu; allowed: as many in each", where, rules[i].name, (unsigned long long)a->count,
                                   (unsigned long long)*vertices);
        }
    }
    return true;
}

static bool check_primitive(gltf_reader *g, const json_value *p, const char *where)
{
    const json_value *attributes, *targets;
    long indices, material;
    double mode;
    uint64_t vertices = 0;
    if (p->kind != JSON_OBJECT)
        return gltf_refuse(g, p, "%s is not an object; allowed: an object", where);
    if (!take_kind(g, p, where, "attributes", JSON_OBJECT, true, &attributes) || !take_whole(g, p, where, "mode", 0, 6, 4, &mode) ||
        !take_index(g, p, where, "indices", "accessors", g->lists[GLTF_ACCESSORS].count, false, &indices) ||
        !take_index(g, p, where, "material", "materials", g->lists[GLTF_MATERIALS].count, false, &material) ||
        !take_kind(g, p, where, "targets", JSON_LIST, false, &targets) || !check_attributes(g, attributes, where, &vertices))
        return false;
    for (const json_value *t = json_text_first(&g->json, targets); t != NULL; t = json_text_next(&g->json, t))
        if (!check_attributes(g, t, where, &vertices))
            return false;
    const gltf_accessor *a = indices >= 0 ? &g->accessors[indices] : NULL;
    if (a != NULL && (a->components != 1 || (a->component_type != 5121 && a->component_type != 5123 && a->component_type != 5125)))
        return gltf_refuse(g, json_text_get(&g->json, p, "indices"), "%s.indices is of another type; allowed: SCALAR of 5121, 5123 or 5125", where);
    const uint64_t corners = a != NULL ? a->count : vertices;
    g->triangles += mode < 4 ? 0 : mode == 4 ? corners / 3 : corners > 2 ? corners - 2 : 0;
    if (g->triangles > MGT_MAX_TRIANGLES)
        return gltf_refuse(g, p, "with %s the meshes have %llu triangles; allowed: at most %d", where, (unsigned long long)g->triangles, MGT_MAX_TRIANGLES);
    return true;
}

static bool check_mesh(gltf_reader *g, const json_value *mesh, size_t index)
{
    const json_value *primitives;
    char where[64];
    size_t i = 0;
    snprintf(where, sizeof where, "meshes[%zu]", index);
    if (!take_kind(g, mesh, where, "primitives", JSON_LIST, true, &primitives))
        return false;
    for (const json_value *p = json_text_first(&g->json, primitives); p != NULL; p = json_text_next(&g->json, p)) {
        snprintf(where, sizeof where, "meshes[%zu].primitives[%zu]", index, i++);
        if (!check_primitive(g, p, where))
            return false;
    }
    return true;
}

/* ---- nodes and scenes --------------------------------------------------------------------------------------------- */

static bool check_node(gltf_reader *g, const json_value *node, size_t index)
{
    const json_value *children;
    const size_t count = g->lists[GLTF_NODES].count;
    long mesh, skin;
    char where[48];
    snprintf(where, sizeof where, "nodes[%zu]", index);
    if (!take_index(g, node, where, "mesh", "meshes", g->lists[GLTF_MESHES].count, false, &mesh) ||
        !take_index(g, node, where, "skin", "skins", g->lists[GLTF_SKINS].count, false, &skin) || !check_numbers(g, node, where, "matrix", 16) ||
        !check_numbers(g, node, where, "translation", 3) || !check_numbers(g, node, where, "rotation", 4) || !check_numbers(g, node, where, "scale", 3) ||
        !take_kind(g, node, where, "children", JSON_LIST, false, &children))
        return false;
    for (const json_value *v = json_text_first(&g->json, children); v != NULL; v = json_text_next(&g->json, v)) {
        if (v->kind != JSON_NUMBER || !is_whole(v->number, 0, (double)count - 1))
            return gltf_refuse(g, v, "%s.children names none of the %zu nodes; allowed: their numbers, from 0", where, count);
        uint32_t *parent = &g->parents[(size_t)v->number];
        if (*parent != 0)
            return gltf_refuse(g, v, "nodes[%.0f] is a child of nodes[%u] and of nodes[%zu]; allowed: one parent", v->number, *parent - 1, index);
        *parent = (uint32_t)index + 1;
    }
    return true;
}

/* With one parent each, a circle is a way up that never ends. */
static bool check_depths(gltf_reader *g)
{
    size_t i = 0;
    for (const json_value *node = json_text_first(&g->json, g->lists[GLTF_NODES].list); node != NULL; node = json_text_next(&g->json, node), i++) {
        int depth = 0;
        for (uint32_t at = g->parents[i]; at != 0; at = g->parents[at - 1])
            if (++depth > MAX_NODE_DEPTH)
                return gltf_refuse(g, node, "nodes[%zu] is nested deeper than %d nodes, or in a circle; allowed: a tree of at most %d", i, MAX_NODE_DEPTH,
                                   MAX_NODE_DEPTH);
    }
    return true;
}

static bool check_scene(gltf_reader *g, const json_value *scene, size_t index)
{
    const json_value *nodes;
    char where[48];
    snprintf(where, sizeof where, "scenes[%zu]", index);
    if (!take_kind(g, scene, where, "nodes", JSON_LIST, false, &nodes))
        return false;
    for (const json_value *v = json_text_first(&g->json, nodes); v != NULL; v = json_text_next(&g->json, v)) {
        if (v->kind != JSON_NUMBER || !is_whole(v->number, 0, (double)g->lists[GLTF_NODES].count - 1))
            return gltf_refuse(g, v, "%s.nodes names none of the %zu nodes; allowed: their numbers, from 0", where, g->lists[GLTF_NODES].count);
        uint8_t *seen = &g->roots[(size_t)v->number];
        if (g->parents[(size_t)v->number] != 0 || *seen == (uint8_t)(1 + index % 255))
            return gltf_refuse(g, v, "%s.nodes names nodes[%.0f], which is another's child or named twice; allowed: roots, once each", where, v->number);
        *seen = (uint8_t)(1 + index % 255);
    }
    return true;
}

/* ---- what else refers to something -------------------------------------------------------------------------------- */

static bool check_image(gltf_reader *g, const json_value *image, size_t index)
{
    const json_value *uri, *type;
    long view;
    char where[48];
    snprintf(where, sizeof where, "images[%zu]", index);
    if (!take_kind(g, image, where, "uri", JSON_STRING, false, &uri) || !take_kind(g, image, where, "mimeType", JSON_STRING, false, &type) ||
        !take_index(g, image, where, "bufferView", "bufferViews", g->lists[GLTF_VIEWS].count, false, &view))
        return false;
    return (uri != NULL) != (view >= 0) || gltf_refuse(g, image, "%s has a uri and a bufferView, or neither; allowed: one of them", where);
}

static bool check_texture(gltf_reader *g, const json_value *texture, size_t index)
{
    char where[48];
    long source, sampler;
    snprintf(where, sizeof where, "textures[%zu]", index);
    return take_index(g, texture, where, "source", "images", g->lists[GLTF_IMAGES].count, false, &source) &&
           take_index(g, texture, where, "sampler", "samplers", g->lists[GLTF_SAMPLERS].count, false, &sampler);
}

static bool check_material(gltf_reader *g, const json_value *material, size_t index)
{
    static const char *const own[] = {"normalTexture", "occlusionTexture", "emissiveTexture"}, *const rough[] = {"baseColorTexture",
                                                                                                                 "metallicRoughnessTexture"};
    const size_t textures = g->lists[GLTF_TEXTURES].count;
    const json_value *pbr, *texture;
    char where[80], inner[128];
    long found;
    snprintf(where, sizeof where, "materials[%zu]", index);
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        snprintf(inner, sizeof inner, "%s.%s", where, own[i]);
        if (!take_kind(g, material, where, own[i], JSON_OBJECT, false, &texture) ||
            (texture != NULL && !take_index(g, texture, inner, "index", "textures", textures, true, &found)))
            return false;
    }
    if (!check_numbers(g, material, where, "emissiveFactor", 3) || !take_kind(g, material, where, "pbrMetallicRoughness", JSON_OBJECT, false, &pbr))
        return false;
    strcat(where, ".pbrMetallicRoughness");
    for (size_t i = 0; pbr != NULL && i < sizeof rough / sizeof *rough; i++) {
        snprintf(inner, sizeof inner, "%s.%s", where, rough[i]);
        if (!take_kind(g, pbr, where, rough[i], JSON_OBJECT, false, &texture) ||
            (texture != NULL && !take_index(g, texture, inner, "index", "textures", textures, true, &found)))
            return false;
    }
    return pbr == NULL || check_numbers(g, pbr, where, "baseColorFactor", 4);
}

static bool check_skin(gltf_reader *g, const json_value *skin, size_t index)
{
    const json_value *joints;
    long matrices;
    char where[48];
    snprintf(where, sizeof where, "skins[%zu]", index);
    if (!take_kind(g, skin, where, "joints", JSON_LIST, true, &joints) ||
        !take_index(g, skin, where, "inverseBindMatrices", "accessors", g->lists[GLTF_ACCESSORS].count, false, &matrices))
        return false;
    for (const json_value *v = json_text_first(&g->json, joints); v != NULL; v = json_text_next(&g->json, v))
        if (v->kind != JSON_NUMBER || !is_whole(v->number, 0, (double)g->lists[GLTF_NODES].count - 1))
            return gltf_refuse(g, v, "%s.joints names none of the nodes; allowed: their numbers, from 0", where);
    const gltf_accessor *a = matrices >= 0 ? &g->accessors[matrices] : NULL;
    return a == NULL || (a->components == 16 && a->component_type == 5126 && a->count >= joints->count) ||
           gltf_refuse(g, skin, "%s.inverseBindMatrices has too few matrices or another type; allowed: a MAT4 of floats for each joint", where);
}

/* ---- the whole ---------------------------------------------------------------------------------------------------- */

static bool check_version(gltf_reader *g)
{
    const json_value *asset, *version;
    const json_value *root = &g->json.values[0];
    if (root->kind != JSON_OBJECT)
        return gltf_refuse(g, root, "is not a JSON object; allowed: a glTF 2.0 document");
    if (!take_kind(g, root, "document", "asset", JSON_OBJECT, true, &asset) || !take_kind(g, asset, "asset", "version", JSON_STRING, true, &version))
        return false;
    return (version->length == 3 && memcmp(g->json.text + version->at, "2.", 2) == 0) ||
           gltf_refuse(g, version, "asset.version is %.*s; allowed: 2.0", (int)(version->length < 20 ? version->length : 20), g->json.text + version->at);
}

/* Extensions without which a file would be seen otherwise. Those that are known add nothing that a scene shows: lights, highlights, words about the file. */
static bool check_extensions(gltf_reader *g)
{
    static const char *const known[] = {"KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_emissive_strength", "KHR_materials_ior",
                                        "KHR_materials_sheen", "KHR_materials_specular",  "KHR_materials_variants",          "KHR_xmp_json_ld"};
    enum { KNOWN = sizeof known / sizeof *known };
    const json_value *required, *first = NULL;
    char names[80] = "", allowed[240] = "";
    if (!take_kind(g, &g->json.values[0], "document", "extensionsRequired", JSON_LIST, false, &required))
        return false;
    for (const json_value *v = json_text_first(&g->json, required); v != NULL; v = json_text_next(&g->json, v)) {
        int i = 0;
        if (v->kind != JSON_STRING)
            return gltf_refuse(g, v, "extensionsRequired holds a value that is not a string; allowed: names of extensions");
        while (i < KNOWN && !json_text_is(&g->json, v, known[i]))
            i++;
        if (i < KNOWN)
            continue;
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%.40s", first != NULL ? ", " : "", scene_quote_text(g->json.text + v->at, v->length).text);
        if (first == NULL)
            first = v;
    }
    for (int i = 0; i < KNOWN; i++)
        snprintf(allowed + strlen(allowed), sizeof allowed - strlen(allowed), "%s%s", i > 0 ? ", " : "", known[i]);
    return first == NULL || gltf_refuse(g, first, "extensionsRequired names %s: not supported; allowed: %s", names, allowed);
}

typedef bool (*item_check)(gltf_reader *, const json_value *, size_t);

static bool check_items(gltf_reader *g, gltf_lists which, item_check check)
{
    size_t i = 0;
    for (const json_value *v = json_text_first(&g->json, g->lists[which].list); v != NULL; v = json_text_next(&g->json, v))
        if (!check(g, v, i++))
            return false;
    return true;
}

static bool check_document(gltf_reader *g)
{
    static const char *const names[GLTF_LIST_COUNT] =
        {[GLTF_BUFFERS] = "buffers",   [GLTF_VIEWS] = "bufferViews",   [GLTF_ACCESSORS] = "accessors", [GLTF_MESHES] = "meshes",
         [GLTF_NODES] = "nodes",       [GLTF_SCENES] = "scenes",       [GLTF_IMAGES] = "images",       [GLTF_TEXTURES] = "textures",
         [GLTF_SAMPLERS] = "samplers", [GLTF_MATERIALS] = "materials", [GLTF_SKINS] = "skins"};
    long scene;
    if (!check_version(g) || !check_extensions(g))
        return false;
    for (int i = 0; i < GLTF_LIST_COUNT; i++)
        if (!take_items(g, names[i], &g->lists[i]))
            return false;
    g->buffers = calloc(g->lists[GLTF_BUFFERS].count + 1, sizeof *g->buffers);
    g->views = calloc(g->lists[GLTF_VIEWS].count + 1, sizeof *g->views);
    g->accessors = calloc(g->lists[GLTF_ACCESSORS].count + 1, sizeof *g->accessors);
    g->parents = calloc(g->lists[GLTF_NODES].count + 1, sizeof *g->parents);
    g->roots = calloc(g->lists[GLTF_NODES].count + 1, 1);
    if (g->buffers == NULL || g->views == NULL || g->accessors == NULL || g->parents == NULL || g->roots == NULL)
        return model_fault_memory(g->fault);
    return take_index(g, &g->json.values[0], "document", "scene", "scenes", g->lists[GLTF_SCENES].count, false, &scene) &&
           check_items(g, GLTF_BUFFERS, gltf_check_buffer) && check_items(g, GLTF_VIEWS, gltf_check_view) && check_items(g, GLTF_ACCESSORS, check_accessor) &&
           check_items(g, GLTF_IMAGES, check_image) && check_items(g, GLTF_TEXTURES, check_texture) && check_items(g, GLTF_MATERIALS, check_material) &&
           check_items(g, GLTF_MESHES, check_mesh) && check_items(g, GLTF_SKINS, check_skin) && check_items(g, GLTF_NODES, check_node) && check_depths(g) &&
           check_items(g, GLTF_SCENES, check_scene);
}

static uint32_t word_at(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* The chunks of a .glb: JSON, and one of bytes that may be missing. */
static bool find_chunks(gltf_reader *g, const char *bytes, size_t length, const char **text, size_t *text_length)
{
    if (length < 20 || word_at(bytes) != GLB_MAGIC)
        return gltf_refuse(g, NULL, "is not binary glTF; allowed: a file that begins with \"glTF\", a version and a length");
    if (word_at(bytes + 4) != 2)
        return gltf_refuse(g, NULL, "is binary glTF of version %u; allowed: 2", word_at(bytes + 4));
    if (word_at(bytes + 8) != length)
        return gltf_refuse(g, NULL, "says that it has %u bytes and has %zu; allowed: the same", word_at(bytes + 8), length);
    for (size_t at = 12, i = 0; at < length; i++) {
        const uint64_t size = length - at >= 8 ? word_at(bytes + at) : UINT64_MAX;
        const uint32_t kind = length - at >= 8 ? word_at(bytes + at + 4) : 0;
        if (size > length - at - 8 || (i == 0) != (kind == CHUNK_JSON))
            return gltf_refuse(g, NULL, "chunk %zu is not JSON first, or ends behind the file; allowed: a chunk of JSON, then one of bytes", i);
        at += 8;
        if (i == 0) {
            *text = bytes + at;
            *text_length = (size_t)size;
        } else if (i == 1 && kind == CHUNK_BINARY) {
            g->chunk = bytes + at;
            g->chunk_length = size;
        }
        at += (size_t)size;
    }
    return true;
}

bool gltf_check(const char *path, const char *bytes, size_t length, bool binary, uint64_t *weight, model_fault *fault)
{
    gltf_reader g = {.path = path, .binary = binary, .fault = fault, .weight = length};
    const char *text = bytes;
    size_t text_length = length;
    bool good = !binary || find_chunks(&g, bytes, length, &text, &text_length);
    if (good && !json_text_parse(&g.json, text, text_length))
        good = g.json.fault_what == NULL ? model_fault_memory(fault)
                                         : gltf_refuse_at(&g, g.json.fault_place, "not valid JSON: %s; allowed: a glTF 2.0 document", g.json.fault_what);
    good = good && check_document(&g);
    *weight = g.weight;
    json_text_free(&g.json);
    gltf_buffers_free(&g);
    free(g.views);
    free(g.accessors);
    free(g.parents);
    free(g.roots);
    return good;
}
