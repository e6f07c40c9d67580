/* SPDX-License-Identifier: MIT
 * The scene that is edited. */
#define _POSIX_C_SOURCE 200809L
#include "viewer/scene/document.h"

#include <stdlib.h>
#include <string.h>

#include "image/output_file.h"
#include "scene/scene_models.h"
#include "scene/scene_path.h"

static bool values_of_words(const scene_values *base, const char *const *words, size_t count, scene_values *out, scene_error *error);

/* The camera of values from a file when it does not follow their path. A file has a path or a still camera: beside a path it stands where the path is at the
 * scene's start. */
static mgt_camera still_camera(const scene_values *values)
{
    mgt_camera camera = values->camera.still;
    if (values->camera.path.count == 0)
        return camera;
    const mgt_camera start = scene_camera_at(&values->camera, values->time.start);
    memcpy(camera.position, start.position, sizeof camera.position);
    memcpy(camera.target, start.target, sizeof camera.target);
    return scene_camera_fault(&camera) == CAMERA_LEGAL ? camera : values->camera.still;
}

/* Copies the values of a file. Paths in them are made valid for other folders, because the scene may be saved in one. False: out of memory. */
static bool copy_values(scene_values *out, const scene_file *file)
{
    if (!scene_values_copy(out, scene_file_values(file)))
        return false;
    out->camera.still = still_camera(out);
    if (scene_values_fix_files(out, scene_file_path(file)))
        return true;
    scene_values_free(out);
    return false;
}

/* ---- opening ------------------------------------------------------------------------------------------------ */

static bool same_stamp(const struct stat *a, const struct stat *b)
{
    return a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec && a->st_size == b->st_size && a->st_ino == b->st_ino;
}

scene_source *scene_source_share(scene_source *source)
{
    if (source)
        source->shares++;
    return source;
}

void scene_source_release(scene_source *source)
{
    if (!source || --source->shares > 0)
        return;
    scene_file_free(source->file);
    free(source->path);
    free(source);
}

static scene_source *source_create(const char *path)
{
    scene_source *source = calloc(1, sizeof *source);
    char *name = strdup(path);
    if (!source || !name) {
        free(source);
        free(name);
        return NULL;
    }
    *source = (scene_source){.path = name, .shares = 1};
    if (stat(path, &source->stamp) != 0)
        source->stamp = (struct stat){0};
    return source;
}

bool document_open(document *d, const char *path, const char *const *words, size_t count, scene_error *error)
{
    scene_source *source = source_create(path);
    *d = (document){.source = source};
    if (!source)
        return scene_error_memory(error);
    scene_file *changed = scene_file_open(path, words, count, error);
    if (!changed) {
        document_close(d);
        return false;
    }
    source->file = scene_file_open(path, NULL, 0, error);
    /* The file may be valid only with the changes of the words. */
    if (!source->file) {
        source->file = changed;
        changed = NULL;
    }
    const bool good = copy_values(&d->values, changed ? changed : source->file);
    scene_file_free(changed);
    if (!good) {
        document_close(d);
        return scene_error_memory(error);
    }
    source->home = d->values.camera.still;
    *error = (scene_error){0};
    return true;
}

void document_close(document *d)
{
    scene_values_free(&d->values);
    scene_source_release(d->source);
    *d = (document){0};
}

void document_replace(document *d, scene_values *values)
{
    scene_values_free(&d->values);
    d->values = *values;
    d->stale = false;
    d->fault = (scene_error){0};
    *values = (scene_values){0};
}

bool document_revert(document *d)
{
    scene_values values;
    if (!copy_values(&values, d->source->file))
        return false;
    document_replace(d, &values);
    d->source->home = d->values.camera.still;
    return true;
}

/* ---- changes as words --------------------------------------------------------------------------------------- */

/* The values as the text of a scene file. The caller frees it. NULL: out of memory. */
static char *text_of_values(const scene_values *values, size_t *size)
{
    char *text = NULL;
    FILE *stream = open_memstream(&text, size);
    if (!stream)
        return NULL;
    const bool good = scene_values_write(stream, values);
    if (fclose(stream) == 0 && good)
        return text;
    free(text);
    return NULL;
}

/* The values with the default position and target of the still camera. A file has a path or a still camera, but a document has both. The result borrows from
 * `values`. */
static scene_values without_still_camera(const scene_values *values)
{
    scene_values plain = *values; /* borrows the lists */
    plain.camera.still = scene_values_defaults().camera.still;
    plain.camera.still.fov_y_deg = values->camera.still.fov_y_deg;
    memcpy(plain.camera.still.up, values->camera.still.up, sizeof plain.camera.still.up);
    return plain;
}

/* Changes `base` by words as `--set` does. The caller frees `out`. False: a word is not allowed, and `error` says why. */
static bool values_of_words(const scene_values *base, const char *const *words, size_t count, scene_values *out, scene_error *error)
{
    size_t size = 0;
    bool gets_path = false;
    for (size_t i = 0; i < count; i++)
        gets_path |= strncmp(words[i], "camera.path", 11) == 0;
    const scene_values plain = gets_path ? without_still_camera(base) : *base;
    char *text = text_of_values(&plain, &size);
    if (!text)
        return scene_error_memory(error);
    scene_file *file = scene_file_parse_like(base, text, size, "the scene", words, count, error);
    free(text);
    if (!file)
        return false;
    const bool good = copy_values(out, file) || scene_error_memory(error);
    scene_file_free(file);
    if (good && (gets_path || out->camera.path.count > 0)) {
        memcpy(out->camera.still.position, base->camera.still.position, sizeof out->camera.still.position);
        memcpy(out->camera.still.target, base->camera.still.target, sizeof out->camera.still.target);
    }
    return good;
}

bool document_set(document *d, const char *word, scene_error *error)
{
    scene_values values;
    if (!values_of_words(&d->values, &word, 1, &values, error))
        return false;
    document_replace(d, &values);
    return true;
}

/* ---- changes in place ---------------------------------------------------------------------------------------- */

void document_changed(document *d, bool objects)
{
    scene_water *water = &d->values.water;
    if (water->wind.speed > 0) {
        free(water->waves.items);
        water->waves = (scene_list){0};
        water->spectrum.settings.kind = SPECTRUM_NONE;
    }
    d->stale |= objects || scene_water_has_sea(water);
}

void document_refresh(document *d)
{
    size_t size = 0;
    if (!d->stale)
        return;
    char *text = text_of_values(&d->values, &size);
    scene_file *file = text ? scene_file_parse_like(&d->values, text, size, "the scene", NULL, 0, &d->fault) : NULL;
    scene_values made = {0};
    d->stale = false;
    if (!text || (file && !scene_values_copy(&made, scene_file_values(file))))
        scene_error_memory(&d->fault);
    else if (file) {
        scene_values *v = &d->values;
        const scene_list sea = v->water.sea;
        scene_models *models = v->models;
        v->water.sea = made.water.sea;
        v->models = made.models;
        made.water.sea = sea;
        made.models = models;
        d->fault = (scene_error){0};
    }
    scene_values_free(&made);
    scene_file_free(file);
    free(text);
}

/* ---- the file on the disk ------------------------------------------------------------------------------------ */

/* Whether two words "key=value" have the same key. */
static bool same_key(const char *a, const char *b)
{
    const size_t length = strcspn(a, "=");
    return length == strcspn(b, "=") && memcmp(a, b, length) == 0;
}

/* Lists the words whose keys `others` does not have, and returns their number. A list or mapping in brackets or braces is one value. */
static size_t without_keys_of(const scene_overrides *words, const scene_overrides *others, const char **out)
{
    size_t count = 0;
    for (size_t i = 0; i < words->count; i++) {
        bool taken = false;
        for (size_t j = 0; j < others->count; j++)
            taken |= same_key(words->words[i], others->words[j]);
        if (!taken)
            out[count++] = words->words[i];
    }
    return count;
}

static bool same_view(const mgt_camera *a, const mgt_camera *b)
{
    return memcmp(a->position, b->position, sizeof a->position) == 0 && memcmp(a->target, b->target, sizeof a->target) == 0;
}

/* Keeps a view that the user has chosen beside a path, which no words of the format hold. A still camera of the file replaces it if that has changed. */
static void keep_view(const scene_values *old, const scene_values *new, const scene_values *mine, scene_values *out)
{
    const mgt_camera *view = &mine->camera.still;
    if (same_view(view, &old->camera.still) || (new->camera.path.count == 0 && !same_view(&old->camera.still, &new->camera.still)))
        return;
    memcpy(out->camera.still.position, view->position, sizeof view->position);
    memcpy(out->camera.still.target, view->target, sizeof view->target);
}

/* The values of the new file with the changes that the user has made to the old one. Where both have changed a value, that of the file counts. False: out of
 * memory. */
static bool merge(document *d, const scene_file *fresh, scene_values *out)
{
    scene_overrides mine = {0}, theirs = {0};
    scene_values old, new = {0};
    const char **words = NULL;
    bool good = copy_values(&old, d->source->file) && copy_values(&new, fresh) && scene_overrides_between(&old, &d->values, &mine) &&
                scene_overrides_between(&old, &new, &theirs);
    if (good)
        words = calloc(mine.count + 1, sizeof *words);
    if (words)
        good = values_of_words(&new, words, without_keys_of(&mine, &theirs, words), out, NULL);
    if (words && good)
        keep_view(&old, &new, &d->values, out);
    /* If the user's changes do not fit the new file, they are dropped. */
    if (!words || !good)
        good = copy_values(out, fresh);
    scene_values_free(&old);
    scene_values_free(&new);
    free(words);
    scene_overrides_free(&mine);
    scene_overrides_free(&theirs);
    return good;
}

document_news document_poll(document *d)
{
    struct stat stamp;
    scene_values values;
    scene_source *source = d->source;
    if (stat(source->path, &stamp) != 0 || same_stamp(&stamp, &source->stamp))
        return DOCUMENT_SAME;
    source->stamp = stamp;
    scene_file *fresh = scene_file_open(source->path, NULL, 0, &source->error);
    if (!fresh)
        return DOCUMENT_BROKEN;
    if (!merge(d, fresh, &values)) {
        scene_file_free(fresh);
        scene_error_memory(&source->error);
        return DOCUMENT_BROKEN;
    }
    const mgt_camera before = still_camera(scene_file_values(source->file)), camera = still_camera(scene_file_values(fresh));
    if (!scene_camera_equal(&before, &camera))
        source->home = camera;
    document_replace(d, &values);
    scene_file_free(source->file);
    source->file = fresh;
    source->error = (scene_error){0};
    return DOCUMENT_READ_ANEW;
}

/* ---- saving -------------------------------------------------------------------------------------------------- */

const char *scene_source_name(const scene_source *source)
{
    const char *slash = strrchr(source->path, '/');
    return slash ? slash + 1 : source->path;
}

void document_save_name(const document *d, char *name, size_t size)
{
    const char *path = d->source->path, *dot = strrchr(scene_source_name(d->source), '.');
    const size_t length = dot ? (size_t)(dot - path) : strlen(path);
    if (strncmp(path, "--", 2) == 0) { /* the path is the words of --sea */
        snprintf(name, size, "sea-edited.yaml");
        return;
    }
    const bool edited = length > 7 && strncmp(path + length - 7, "-edited", 7) == 0;
    snprintf(name, size, "%.*s%s.yaml", (int)length, path, edited ? "" : "-edited");
}

/* Whether the text, read back as the file at `path`, gives the same scene. If not, `error` says so. */
static bool reads_back(const char *text, size_t size, const char *path, const scene_values *values, file_error *error)
{
    scene_error problem = {0};
    scene_file *file = scene_file_parse_like(values, text, size, path, NULL, 0, &problem);
    char *expected = file ? scene_values_canonical(values, NULL) : NULL, *found = file ? scene_file_canonical(file, NULL) : NULL;
    const bool same = expected && found && strcmp(expected, found) == 0;
    if (!same)
        file_error_set(error, FILE_ARGUMENT, "%s", file ? "the scene does not read back as it is" : problem.text);
    free(expected);
    free(found);
    scene_file_free(file);
    return same;
}

file_status document_save(const scene_values *values, const char *path, bool overwrite, file_error *error)
{
    const output_options options = {.overwrite = overwrite};
    size_t size = 0;
    scene_values written;
    char *text = NULL;
    if (scene_values_copy(&written, values)) {
        text = scene_values_relative_files(&written, path) ? text_of_values(&written, &size) : NULL;
        scene_values_free(&written);
    }
    if (!text)
        return file_error_set(error, FILE_MEMORY, "out of memory");
    file_status status = reads_back(text, size, path, values, error) ? FILE_OK : FILE_ARGUMENT;
    if (status == FILE_OK)
        status = output_file_write_whole(path, text, size, &options, error);
    free(text);
    return status;
}
