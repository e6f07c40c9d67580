/* SPDX-License-Identifier: MIT */
/* Scene files behind the public header. A mgt_scene_file is a scene_file. */
#include <stdlib.h>
#include <string.h>

#include "io/io_error.h"
#include "scene/scene_file.h"

static mgt_scene_file *opaque(scene_file *file) { return (mgt_scene_file *)file; }
static const scene_file *inner(const mgt_scene_file *file) { return (const scene_file *)file; }

static mgt_io_status missing_argument(mgt_io_error *error) { return io_error_take(error, MGT_IO_ARGUMENT, "a pointer is missing"); }

static mgt_io_status finish(mgt_scene_file **out, scene_file *file, const scene_error *problem, mgt_io_error *error)
{
    *out = opaque(file);
    if (file)
        return MGT_IO_OK;
    const mgt_io_status status = problem->kind == SCENE_ERROR_MISSING_INPUT  ? MGT_IO_MISSING
                                 : problem->kind == SCENE_ERROR_BAD_OVERRIDE ? MGT_IO_ARGUMENT
                                 : problem->kind == SCENE_ERROR_MEMORY       ? MGT_IO_MEMORY
                                                                             : MGT_IO_BAD;
    return io_error_take(error, status, problem->text);
}

mgt_io_status mgt_scene_file_load(mgt_scene_file **file, const char *path, const char *const *changes, size_t change_count, mgt_io_error *error)
{
    scene_error problem = {0};
    if (!file || !path || (!changes && change_count))
        return missing_argument(error);
    return finish(file, scene_file_load(path, changes, change_count, &problem), &problem, error);
}

mgt_io_status mgt_scene_file_parse(mgt_scene_file **file, const char *text, size_t length, const char *name, const char *const *changes, size_t change_count,
                                   mgt_io_error *error)
{
    scene_error problem = {0};
    if (!file || !text || !name || (!changes && change_count))
        return missing_argument(error);
    return finish(file, scene_file_parse(text, length, name, changes, change_count, &problem), &problem, error);
}

mgt_io_status mgt_scene_file_sea(mgt_scene_file **file, const char *words, const char *const *changes, size_t change_count, mgt_io_error *error)
{
    scene_error problem = {0};
    if (!file || !words || (!changes && change_count))
        return missing_argument(error);
    return finish(file, scene_file_sea(words, changes, change_count, &problem), &problem, error);
}

void mgt_scene_file_free(mgt_scene_file *file) { scene_file_free((scene_file *)file); }

mgt_io_status mgt_scene_file_frame(const mgt_scene_file *file, uint32_t frame, mgt_scene *scene, size_t size)
{
    mgt_scene full;
    if (!file || !scene || frame > INT32_MAX || size < sizeof scene->struct_size)
        return MGT_IO_ARGUMENT;
    if (!scene_file_frame(inner(file), (int)frame, &full))
        return MGT_IO_BAD;
    memcpy(scene, &full, size < sizeof full ? size : sizeof full);
    scene->struct_size = size < sizeof full ? size : sizeof full;
    return MGT_IO_OK;
}

uint32_t mgt_scene_file_frame_count(const mgt_scene_file *file) { return file ? (uint32_t)scene_file_frame_count(inner(file)) : 0; }
double mgt_scene_file_fps(const mgt_scene_file *file) { return file ? scene_file_fps(inner(file)) : 0; }
const char *mgt_scene_file_warning(const mgt_scene_file *file) { return file ? scene_file_warning(inner(file)) : ""; }
