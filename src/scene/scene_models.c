/* SPDX-License-Identifier: MIT
 *
 * The objects of a scene with what they are made of: which keys go together, each file once, every instance at its place.
 */
#define _POSIX_C_SOURCE 200809L

#include "scene/scene_models.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/affine.h"
#include "base/pixel_budget.h"
#include "scene/model.h"
#include "scene/scene_sea.h"
#include "sea/spectrum_math.h"

/* What a model or a texture was made from. Equal sources make equal ones. */
typedef struct model_source {
    char *path;         /* owned: of the mesh, the heights or the texture; NULL: none */
    struct stat stamp;  /* the file's; zeros where there is none */
    scene_object shape; /* a shape's own numbers; owns nothing */
    model_use use;
} model_source;

/* A model, or a texture, counted by its owners: several readings of a scene share it. */
typedef struct loaded_model {
    atomic_int owners;
    model_source source;
    uint64_t pixels;   /* of its textures */
    scene_model model; /* a texture has none */
    mgt_texture *texture;
    uint64_t hash; /* the texture's */
} loaded_model;

/* Owned, as is a share of each. */
typedef struct loaded_list {
    loaded_model **items;
    size_t count;
} loaded_list;

struct scene_models {
    atomic_int owners;
    loaded_list models, textures;
    mgt_object *objects;
    size_t object_count, object_room;
    uint32_t *label_of; /* of each object */
    char **labels;      /* owned: of each place of each object of the file */
    size_t label_count;
    uint64_t *hashes; /* of each object of the file */
    size_t hash_count;
};

typedef struct models_reader {
    const scene_tree *tree;
    scene_models *models;
    const scene_models *former; /* of an earlier reading; NULL: none */
    scene_error *error;
    uint64_t triangles;
    uint64_t pixels; /* of textures */
} models_reader;

/* ---- keys that go together -------------------------------------------------------------------------------------- */

static bool refuse_key(const models_reader *r, size_t index, const tree_node *item, const char *key, const char *what)
{
    const tree_node *node = tree_get(item, key);
    const char *source = node != NULL && node->key_source != NULL ? node->key_source : item->source;
    return tree_error(r->tree, source, node != NULL ? node->key_place : item->place, r->error, "objects[%zu].%s %s", index, key, what);
}

/* Settings that would do nothing are refused, as they were meant for something. */
static bool check_keys(const models_reader *r, size_t index, const tree_node *item, const scene_object *o)
{
    static const struct {
        const char *key;
        unsigned shapes;
        const char *allowed;
    } settings[] = {
        {"size", ~(1u << SHAPE_MESH), "is for shapes; allowed: with a mesh, scale"},
        {"triangles", ~(1u << SHAPE_MESH), "is for shapes; allowed: not with a mesh"},
        {"count", 1u << SHAPE_STEPS, "is a number of steps; allowed: with shape: steps"},
        {"rim_width", 1u << SHAPE_POOL, "is of a pool; allowed: with shape: pool"},
        {"rim_height", 1u << SHAPE_POOL, "is of a pool; allowed: with shape: pool"},
        {"heights", 1u << SHAPE_FLOOR, "is of a floor; allowed: with shape: floor"},
        {"lowest", 1u << SHAPE_FLOOR, "is of a floor; allowed: with shape: floor"},
        {"highest", 1u << SHAPE_FLOOR, "is of a floor; allowed: with shape: floor"},
        {"dry", ~(1u << SHAPE_PLANE | 1u << SHAPE_FLOOR), "is of hulls, which hold water back; allowed: not with a plane or a floor"},
    };
    const bool has_mesh = o->mesh != NULL && o->mesh[0] != '\0', has_heights = o->heights != NULL && o->heights[0] != '\0';
    if (has_mesh && o->shape != SHAPE_MESH)
        return refuse_key(r, index, item, "mesh", "stands beside a shape; allowed: one of them");
    if (!has_mesh && o->shape == SHAPE_MESH)
        return refuse_key(r, index, item, "mesh", "and shape are missing; allowed: the path of a .gltf, .glb, .obj or .ply file, or a shape");
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++)
        if (!(settings[i].shapes & 1u << o->shape) && tree_get(item, settings[i].key) != NULL)
            return refuse_key(r, index, item, settings[i].key, settings[i].allowed);
    if (o->shape == SHAPE_FLOOR && !has_heights)
        return refuse_key(r, index, item, "heights", "is missing; allowed: the path of a grey PNG or a PFM, from the scene's folder");
    return true;
}

/* ---- loading ---------------------------------------------------------------------------------------------------- */

static bool refuse_fault(const models_reader *r, size_t index, const tree_node *item, const char *key, const model_fault *fault)
{
    if (fault->kind == SCENE_ERROR_MEMORY)
        return scene_error_memory(r->error);
    const tree_node *inner = strncmp(key, "material.", 9) == 0 ? tree_get(tree_get(item, "material"), key + 9) : tree_get(item, key);
    const tree_node *node = inner != NULL ? inner : item;
    tree_error(r->tree, node->source, node->place, r->error, "objects[%zu].%s: %s", index, key, fault->text);
    if (r->error != NULL)
        r->error->kind = fault->kind;
    return false;
}

/* Room for one more in an array; NULL when memory runs out. */
static void *grown(void *items, size_t count, size_t size) { return realloc(items, (count + 1) * size); }

static void release_loaded(loaded_model *m)
{
    if (m == NULL || atomic_fetch_sub(&m->owners, 1) > 1)
        return;
    free(m->source.path);
    model_free(&m->model);
    mgt_texture_destroy(m->texture);
    free(m);
}

static void release_list(loaded_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        release_loaded(list->items[i]);
    free(list->items);
}

static bool same_file(const model_source *a, const model_source *b)
{
    if (a->path == NULL || b->path == NULL)
        return a->path == b->path;
    return strcmp(a->path, b->path) == 0 && a->stamp.st_dev == b->stamp.st_dev && a->stamp.st_ino == b->stamp.st_ino && a->stamp.st_size == b->stamp.st_size &&
           a->stamp.st_mtim.tv_sec == b->stamp.st_mtim.tv_sec && a->stamp.st_mtim.tv_nsec == b->stamp.st_mtim.tv_nsec;
}

static bool same_shape(const scene_object *a, const scene_object *b)
{
    if (a->shape != b->shape || a->shape == SHAPE_MESH)
        return a->shape == b->shape;
    return a->size[0] == b->size[0] && a->size[1] == b->size[1] && a->size[2] == b->size[2] && a->triangles == b->triangles && a->count == b->count &&
           a->rim_width == b->rim_width && a->rim_height == b->rim_height && a->lowest == b->lowest && a->highest == b->highest;
}

static loaded_model *find_loaded(const loaded_list *list, const model_source *source)
{
    for (size_t i = 0; i < list->count; i++) {
        const model_source *other = &list->items[i]->source;
        if (other->use.own_materials == source->use.own_materials && other->use.dry == source->use.dry && same_file(other, source) &&
            same_shape(&other->shape, &source->shape))
            return list->items[i];
    }
    return NULL;
}

/* The entry of a source (taken over) in a list: the one that is there, a share of the former reading's, or, with *fresh, one that is still to be made. NULL
 * when memory runs out. */
static loaded_model *take_loaded(models_reader *r, loaded_list *list, const loaded_list *former, model_source source, bool *fresh)
{
    *fresh = false;
    loaded_model *found = find_loaded(list, &source), *shared = NULL, **items = NULL;
    if (found == NULL && former != NULL)
        shared = find_loaded(former, &source);
    if (shared != NULL && r->pixels + shared->pixels > pixel_budget())
        shared = NULL;
    if (found == NULL && (items = grown(list->items, list->count, sizeof(loaded_model *))) != NULL) {
        list->items = items;
        found = shared != NULL ? shared : calloc(1, sizeof *found);
    }
    *fresh = found != NULL && items != NULL && shared == NULL;
    if (*fresh)
        found->source = source;
    else
        free(source.path);
    if (items != NULL && found != NULL) {
        atomic_fetch_add(&found->owners, 1);
        list->items[list->count++] = found;
        r->pixels += found->pixels;
    }
    return found;
}

/* False when memory runs out. `file` may be NULL. */
static bool source_of(const models_reader *r, const char *file, model_source *out)
{
    *out = (model_source){.path = file != NULL ? scene_file_beside(r->tree->file_name, file) : NULL};
    if (out->path != NULL && stat(out->path, &out->stamp) != 0)
        out->stamp = (struct stat){0};
    return file == NULL || out->path != NULL;
}

static bool make_shape(scene_model *out, const scene_object *object, const char *path, model_fault *fault)
{
    mesh_data mesh = {0};
    uint64_t hash = 0;
    if (object->shape == SHAPE_FLOOR) {
        if (!floor_build(&mesh, object, path, &hash, fault))
            return false;
    } else if (!shape_build(&mesh, object)) {
        return model_fault_memory(fault);
    }
    const bool good = model_of_mesh(out, &mesh, "the shape", object->dry, fault);
    out->hash = hash;
    mesh_data_free(&mesh);
    return good;
}

/* NULL with the error set. */
static const scene_model *take_model(models_reader *r, size_t index, const tree_node *item, const scene_object *object)
{
    const bool is_mesh = object->shape == SHAPE_MESH;
    const char *file = is_mesh ? object->mesh : object->shape == SHAPE_FLOOR ? object->heights : NULL;
    model_source source;
    model_fault fault = {0};
    bool fresh = false;
    if (!source_of(r, file, &source)) {
        scene_error_memory(r->error);
        return NULL;
    }
    source.shape = *object;
    source.use = (model_use){.own_materials = is_mesh && !object->material.given, .dry = object->dry};
    loaded_model *m = take_loaded(r, &r->models->models, r->former != NULL ? &r->former->models : NULL, source, &fresh);
    if (m == NULL)
        scene_error_memory(r->error);
    if (m == NULL || !fresh)
        return m != NULL ? &m->model : NULL;
    const uint64_t before = r->pixels;
    const bool good =
        is_mesh ? model_load(&m->model, m->source.path, m->source.use, &r->pixels, &fault) : make_shape(&m->model, object, m->source.path, &fault);
    m->pixels = r->pixels - before;
    if (good)
        return &m->model;
    refuse_fault(r, index, item, is_mesh ? "mesh" : file != NULL ? "heights" : "shape", &fault);
    return NULL;
}

static const loaded_model *take_texture(models_reader *r, size_t index, const tree_node *item, const char *file)
{
    model_source source;
    model_fault fault = {0};
    bool fresh = false;
    loaded_model *t =
        source_of(r, file, &source) ? take_loaded(r, &r->models->textures, r->former != NULL ? &r->former->textures : NULL, source, &fresh) : NULL;
    if (t == NULL)
        scene_error_memory(r->error);
    if (t == NULL || !fresh)
        return t;
    const uint64_t before = r->pixels;
    t->texture = texture_load(t->source.path, &r->pixels, &t->hash, &fault);
    t->pixels = r->pixels - before;
    if (t->texture != NULL)
        return t;
    refuse_fault(r, index, item, "material.texture", &fault);
    return NULL;
}

/* ---- places ----------------------------------------------------------------------------------------------------- */

typedef struct placement {
    double at[3][4];
} placement;

/* Of an angle in degrees; exact at right angles. */
static double sine_of(double degrees)
{
    const double turns = degrees / 360, part = 4 * (turns - floor(turns)), quarter = floor(part + 0.5), rest = (part - quarter) * SPECTRUM_PI / 2;
    switch ((int)quarter % 4) {
    case 0:
        return portable_sin(rest);
    case 1:
        return portable_cos(rest);
    case 2:
        return -portable_sin(rest);
    default:
        return -portable_cos(rest);
    }
}

static placement product(const double a[3][4], const double b[3][4])
{
    placement p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            p.at[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] + (j == 3 ? a[i][3] : 0);
    return p;
}

static placement turn(int axis, double degrees)
{
    const double s = sine_of(degrees), c = sine_of(degrees + 90);
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    placement p = {0};
    p.at[axis][axis] = 1;
    p.at[j][j] = p.at[k][k] = c;
    p.at[j][k] = -s;
    p.at[k][j] = s;
    return p;
}

static placement placement_of(const scene_pose *pose)
{
    placement p = product(turn(1, pose->rotation_deg[1]).at, product(turn(0, pose->rotation_deg[0]).at, turn(2, pose->rotation_deg[2]).at).at);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            p.at[i][j] *= pose->scale[j];
        p.at[i][3] = pose->position[i];
    }
    return p;
}

/* The library's own limits, at the object's place in the file. */
static bool check_reach(const models_reader *r, size_t index, const tree_node *item, const scene_model *model, const placement *p)
{
    double reach = 0;
    for (int i = 0; i < 3; i++)
        reach = fmax(reach, model->reach * (fabs(p->at[i][0]) + fabs(p->at[i][1]) + fabs(p->at[i][2])) + fabs(p->at[i][3]));
    if (reach <= 2e6)
        return true;
    return tree_error(r->tree, item->source, item->place, r->error, "objects[%zu] reaches as far as %.3g m; allowed: 2e6 m from the origin", index, reach);
}

static bool add_parts(models_reader *r, size_t index, const tree_node *item, const scene_object *object, const scene_model *model, const scene_pose *pose,
                      const mgt_texture *texture)
{
    scene_models *m = r->models;
    const placement p = placement_of(pose);
    if (!check_reach(r, index, item, model, &p))
        return false;
    r->triangles += model->triangles;
    if (m->object_count + model->part_count > MGT_MAX_OBJECTS || r->triangles > MGT_MAX_TRIANGLES)
        return tree_error(r->tree, item->source, item->place, r->error,
                          "with objects[%zu] the scene has %zu parts of %llu triangles; allowed: at most %d of %d", index, m->object_count + model->part_count,
                          (unsigned long long)r->triangles, MGT_MAX_OBJECTS, MGT_MAX_TRIANGLES);
    if (m->object_count + model->part_count > m->object_room) {
        const size_t room = 2 * (m->object_count + model->part_count);
        mgt_object *objects = realloc(m->objects, room * sizeof *objects);
        if (objects == NULL)
            return scene_error_memory(r->error);
        m->objects = objects;
        uint32_t *label_of = realloc(m->label_of, room * sizeof *label_of);
        if (label_of == NULL)
            return scene_error_memory(r->error);
        m->label_of = label_of;
        m->object_room = room;
    }
    for (size_t i = 0; i < model->part_count; i++) {
        m->label_of[m->object_count] = (uint32_t)(m->label_count - 1);
        mgt_object *o = &m->objects[m->object_count++];
        const placement whole = product(p.at, model->parts[i].transform);
        *o = (mgt_object){.mesh = model->parts[i].mesh,
                          .material = object->material.given || object->shape != SHAPE_MESH ? object->material.look : model->parts[i].material};
        memcpy(o->transform, whole.at, sizeof o->transform);
        if (!affine_keeps_volume(affine_volume(whole.at)))
            return tree_error(r->tree, item->source, item->place, r->error,
                              "objects[%zu] flattens a part of its mesh: with the scales of the file's nodes it has no volume left; "
                              "allowed: scales other than 0, or a node that is 0 along all axes, which hides its meshes",
                              index);
        if (texture != NULL)
            o->material.texture = texture;
    }
    return true;
}

static bool is_label(const scene_models *m, const char *text)
{
    for (size_t i = 0; i < m->label_count; i++)
        if (strcmp(m->labels[i], text) == 0)
            return true;
    return false;
}

/* What an object without a name is called after: its shape, or its file without folder and extension. */
static void describe(const scene_object *object, char text[64])
{
    const char *slash = object->mesh != NULL ? strrchr(object->mesh, '/') : NULL, *stem = slash != NULL ? slash + 1 : object->mesh;
    size_t length = stem != NULL && object->shape == SHAPE_MESH ? strcspn(stem, ".") : 0;
    if (length > 63)
        for (length = 63; length > 0 && ((unsigned char)stem[length] & 0xc0) == 0x80;)
            length--; /* a whole character ends here */
    snprintf(text, 64, "%.*s", length > 0 ? (int)length : 40, length > 0 ? stem : scene_shape_names[object->shape]);
}

/* Names the next place: NAME, then NAME/2, …. Objects of one name share their places' names; without one an object has a name of its own. */
static bool add_label(models_reader *r, size_t index, const scene_object *object, size_t place, const char *first)
{
    scene_models *m = r->models;
    char own[96], *text = NULL;
    size_t size = 0;
    const bool named = object->name != NULL && object->name[0] != '\0';
    describe(object, own);
    if (!named && place == 0 && is_label(m, own))
        snprintf(own + strlen(own), sizeof own - strlen(own), "-%zu", index + 1);
    const char *base = first != NULL ? first : named ? object->name : own;
    char **labels = grown(m->labels, m->label_count, sizeof *labels);
    if (labels != NULL)
        m->labels = labels;
    size = strlen(base) + 24;
    if (labels == NULL || (text = malloc(size)) == NULL)
        return scene_error_memory(r->error);
    snprintf(text, size, place == 0 ? "%s" : "%s/%zu", base, place + 1);
    m->labels[m->label_count++] = text;
    return true;
}

static bool add_object(models_reader *r, size_t index, const tree_node *item, const scene_object *object)
{
    const loaded_model *texture = NULL;
    const char *file = object->material.texture;
    if (!check_keys(r, index, item, object))
        return false;
    if (file != NULL && file[0] != '\0' && (texture = take_texture(r, index, item, file)) == NULL)
        return false;
    const scene_model *model = take_model(r, index, item, object);
    if (model == NULL)
        return false;
    r->models->hashes[index] = texture != NULL ? model_hash(model->hash, &texture->hash, sizeof texture->hash) : model->hash;
    const mgt_texture *picture = texture != NULL ? texture->texture : NULL;
    if (!add_label(r, index, object, 0, NULL) || !add_parts(r, index, item, object, model, &object->pose, picture))
        return false;
    const scene_pose *poses = object->instances.items;
    const size_t first = r->models->label_count - 1;
    for (size_t i = 0; i < object->instances.count; i++)
        if (!add_label(r, index, object, i + 1, r->models->labels[first]) || !add_parts(r, index, item, object, model, &poses[i], picture))
            return false;
    return true;
}

bool scene_models_read(const scene_tree *tree, scene_values *values, const scene_models *former, scene_error *error)
{
    const scene_object *objects = values->objects.items;
    const size_t count = values->objects.count;
    if (count == 0)
        return true;
    models_reader r = {.tree = tree, .models = calloc(1, sizeof *r.models), .former = former, .error = error};
    if (r.models == NULL)
        return scene_error_memory(error);
    atomic_init(&r.models->owners, 1);
    values->models = r.models;
    r.models->hashes = calloc(count, sizeof *r.models->hashes);
    if (r.models->hashes == NULL)
        return scene_error_memory(error);
    r.models->hash_count = count;
    const tree_node *item = tree_get(tree->root, "objects")->first;
    for (size_t i = 0; i < count; i++, item = item->next)
        if (!add_object(&r, i, item, &objects[i]))
            return false;
    return true;
}

/* ---- owners ----------------------------------------------------------------------------------------------------- */

scene_models *scene_models_share(scene_models *models)
{
    if (models != NULL)
        atomic_fetch_add(&models->owners, 1);
    return models;
}

void scene_models_release(scene_models *models)
{
    if (models == NULL || atomic_fetch_sub(&models->owners, 1) > 1)
        return;
    release_list(&models->models);
    release_list(&models->textures);
    for (size_t i = 0; i < models->label_count; i++)
        free(models->labels[i]);
    free(models->labels);
    free(models->label_of);
    free(models->objects);
    free(models->hashes);
    free(models);
}

const mgt_object *scene_models_objects(const scene_models *models, size_t *count)
{
    *count = models != NULL ? models->object_count : 0;
    return models != NULL ? models->objects : NULL;
}

const char *scene_models_label(const scene_models *models, size_t object)
{
    return models != NULL && object < models->object_count ? models->labels[models->label_of[object]] : NULL;
}

void scene_models_write(FILE *stream, const scene_models *models)
{
    for (size_t i = 0; models != NULL && i < models->hash_count; i++)
        if (models->hashes[i] != 0)
            fprintf(stream, "objects[%zu].content %016llx\n", i, (unsigned long long)models->hashes[i]);
}
