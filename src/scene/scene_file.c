/* SPDX-License-Identifier: MIT
 *
 * Scene files: loading, and one mgt_scene a frame.
 */
#include "scene/scene_file.h"

#include <stdlib.h>
#include <string.h>

#include "params/options.h"
#include "scene/scene_edit.h"
#include "scene/scene_models.h"
#include "scene/scene_path.h"
#include "scene/scene_read.h"
#include "scene/scene_sea.h"
#include "scene/scene_text.h"

enum { MAX_BYTES = 16 * 1024 * 1024 };

struct scene_file {
    char *path;
    scene_values values;
    scene_error warning;
};

/* ---- loading -------------------------------------------------------------------------------------------- */

static const char TOO_LARGE[] = "is larger than 16 MiB";

static bool refuse_file(scene_error *error, scene_error_kind kind, const char *path, const char *what)
{
    return scene_error_set(error, kind, "%s: %s; allowed: a YAML or JSON file of at most 16 MiB", scene_file_name(path).text, what);
}

scene_file *scene_file_parse_like(const scene_values *like, const char *text, size_t length, const char *name, const char *const *overrides,
                                  size_t override_count, scene_error *error)
{
    scene_tree tree = {.file_name = name};
    scene_file *file = NULL;

    if (error != NULL)
        *error = (scene_error){0};
    if (length > MAX_BYTES) {
        refuse_file(error, SCENE_ERROR_BAD_SCENE, name, TOO_LARGE);
        return NULL;
    }
    tree.root = tree_parse(&tree, text, length, NULL, error);
    if (tree.root == NULL)
        goto fail;
    for (size_t i = 0; i < override_count; i++)
        if (!scene_override_apply(&tree, overrides[i], error))
            goto fail;
    file = calloc(1, sizeof *file);
    if (file == NULL || (file->path = strdup(name)) == NULL) {
        scene_error_memory(error);
        goto fail;
    }
    file->values = scene_values_defaults();
    if (!scene_read(&tree, &file->values, error) || !scene_check(&tree, &file->values, error) || !scene_sea_read(&tree, &file->values.water, error))
        goto fail;
    if (!scene_models_read(&tree, &file->values, like != NULL ? like->models : NULL, error))
        goto fail;
    scene_warn(&tree, &file->values, &file->warning);
    tree_free(&tree);
    return file;

fail:
    tree_free(&tree);
    scene_file_free(file);
    return NULL;
}

scene_file *scene_file_parse(const char *text, size_t length, const char *name, const char *const *overrides, size_t override_count, scene_error *error)
{
    return scene_file_parse_like(NULL, text, length, name, overrides, override_count, error);
}

scene_file *scene_file_load(const char *path, const char *const *overrides, size_t override_count, scene_error *error)
{
    size_t length = 0;
    if (error != NULL)
        *error = (scene_error){0};
    if (path == NULL || *path == '\0') {
        scene_error_set(error, SCENE_ERROR_MISSING_INPUT, "the scene's file name is empty; allowed: the path of a YAML or JSON file");
        return NULL;
    }
    regular_file read;
    char *text = regular_file_read(&read, path, true, MAX_BYTES, TOO_LARGE, &length);
    if (text == NULL) {
        refuse_file(error, scene_error_of_fault(read.fault), path,
                    read.fault == REGULAR_FILE_OTHER ? "is no regular file (standard input is \"-\")" : read.what);
        return NULL;
    }
    scene_file *file = scene_file_parse(text, length, path, overrides, override_count, error);
    free(text);
    return file;
}

void scene_file_free(scene_file *file)
{
    if (file == NULL)
        return;
    scene_values_free(&file->values);
    free(file->path);
    free(file);
}

/* ---- frames --------------------------------------------------------------------------------------------- */

bool scene_values_shot(const scene_values *values, double time, mgt_scene *out)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.image.width = values->image.width;
    scene.image.height = values->image.height;
    scene.time = time;
    scene.shutter = values->time.shutter / values->time.fps;
    scene.frame_interval = 1 / values->time.fps;
    scene.camera = scene_camera_at(&values->camera, scene.time);
    scene.camera_open = scene_camera_at(&values->camera, scene.time - scene.shutter);
    scene.camera_moves = !scene_camera_equal(&scene.camera, &scene.camera_open);
    if (scene_camera_fault(&scene.camera) != CAMERA_LEGAL || scene_camera_fault(&scene.camera_open) != CAMERA_LEGAL)
        return false;
    scene.light = values->light;
    scene.sky = values->sky.look;
    scene.aerial = scene_values_aerial(values);
    scene.stars = scene_values_by_night(values, values->sky.stars);
    scene.night_tint = scene_values_by_night(values, values->post.night_tint);
    const scene_list waves = scene_water_all(&values->water);
    scene.water = (mgt_water){.waves = waves.items,
                              .wave_count = waves.count,
                              .index_of_refraction = values->water.index_of_refraction,
                              .level = values->water.level,
                              .choppiness = values->water.choppiness};
    scene.foam = (float)scene_water_foam(&values->water);
    scene.foam_persistence = (float)values->water.foam.persistence;
    memcpy(scene.water.absorption, values->water.absorption, sizeof scene.water.absorption);
    memcpy(scene.water.scattering, values->water.scattering, sizeof scene.water.scattering);
    memcpy(scene.water.body_albedo, values->water.body_albedo, sizeof scene.water.body_albedo);
    scene.objects = scene_models_objects(values->models, &scene.object_count);
    const scene_exposure *exposure = &values->post.exposure;
    scene.post = (mgt_post){.auto_exposure = exposure->automatic,
                            .exposure_ev = exposure->automatic ? values->post.exposure_offset : exposure->stops,
                            .tone_map = values->post.tone_map,
                            .glare = values->post.glare};
    scene.quality = quality_restricted(&values->quality);
    *out = scene;
    return true;
}

bool scene_file_frame(const scene_file *file, int frame, mgt_scene *out)
{
    if (file == NULL || frame < 0)
        return false;
    return scene_values_shot(&file->values, file->values.time.start + frame / file->values.time.fps, out);
}

const scene_values *scene_file_values(const scene_file *file) { return &file->values; }

const char *scene_file_object_name(const scene_file *file, size_t object) { return scene_models_label(file->values.models, object); }

const char *scene_file_path(const scene_file *file) { return file->path; }

const char *scene_file_description(const scene_file *file) { return file->values.description != NULL ? file->values.description : ""; }

const char *scene_file_warning(const scene_file *file) { return file->warning.text; }

int scene_file_frame_count(const scene_file *file) { return (int)file->values.time.frames; }

double scene_file_fps(const scene_file *file) { return file->values.time.fps; }

double scene_file_start(const scene_file *file) { return file->values.time.start; }

size_t scene_file_wave_count(const scene_file *file) { return scene_water_all(&file->values.water).count; }

mgt_quality scene_file_quality(const scene_file *file) { return file->values.quality; }

char *scene_file_canonical(const scene_file *file, size_t *length) { return scene_values_canonical(&file->values, length); }
