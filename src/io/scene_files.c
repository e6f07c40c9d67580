/* SPDX-License-Identifier: MIT */
/* Scene files behind the public header. */
#include <stdlib.h>
#include <string.h>

#include "base/struct_size.h"
#include "io/io_error.h"
#include "io/plain_numbers.h"
#include "scene/scene_file.h"
#include "scene/scene_text.h"

struct mgt_scene_file {
    scene_file *file;
    char warning[sizeof(((scene_error *)0)->text)]; /* in the words of the library */
};

static mgt_io_status missing_argument(mgt_io_error *error) { return io_error_take(error, MGT_IO_ARGUMENT, "a pointer is missing"); }

/* Whether all pointers are there. *file is NULL then, as it is to be on failure. */
static bool begin(mgt_scene_file **file, const void *from, const void *name, const char *const *changes, size_t change_count)
{
    if (file)
        *file = NULL;
    return file && from && name && (changes || change_count == 0);
}

/* `name`: of the file in texts of the problem; NULL: the scene is of no file. */
static mgt_io_status finish(mgt_scene_file **out, scene_file *file, const char *name, const scene_error *problem, mgt_io_error *error)
{
    if (file) {
        *out = malloc(sizeof **out);
        if (!*out) {
            scene_file_free(file);
            return io_error_take(error, MGT_IO_MEMORY, "out of memory");
        }
        (*out)->file = file;
        io_copy_words((*out)->warning, sizeof(*out)->warning, scene_file_warning(file));
        return MGT_IO_OK;
    }
    const mgt_io_status status = problem->kind == SCENE_ERROR_MISSING_INPUT  ? MGT_IO_MISSING
                                 : problem->kind == SCENE_ERROR_BAD_OVERRIDE ? MGT_IO_ARGUMENT
                                 : problem->kind == SCENE_ERROR_MEMORY       ? MGT_IO_MEMORY
                                                                             : MGT_IO_BAD;
    return io_error_take_file(error, status, problem->text, name, name ? scene_file_name(name).text : NULL);
}

mgt_io_status mgt_scene_file_load(mgt_scene_file **file, const char *path, const char *const *changes, size_t change_count, mgt_io_error *error)
{
    scene_error problem = {0};
    if (!begin(file, path, path, changes, change_count))
        return missing_argument(error);
    const plain_numbers numbers = plain_numbers_begin();
    scene_file *const loaded = scene_file_load(path, changes, change_count, &problem);
    plain_numbers_end(numbers);
    return finish(file, loaded, path, &problem, error);
}

mgt_io_status mgt_scene_file_parse(mgt_scene_file **file, const char *text, size_t length, const char *name, const char *const *changes, size_t change_count,
                                   mgt_io_error *error)
{
    scene_error problem = {0};
    if (!begin(file, text, name, changes, change_count))
        return missing_argument(error);
    const plain_numbers numbers = plain_numbers_begin();
    scene_file *const loaded = scene_file_parse(text, length, name, changes, change_count, &problem);
    plain_numbers_end(numbers);
    return finish(file, loaded, name, &problem, error);
}

mgt_io_status mgt_scene_file_sea(mgt_scene_file **file, const char *words, const char *const *changes, size_t change_count, mgt_io_error *error)
{
    scene_error problem = {0};
    if (!begin(file, words, words, changes, change_count))
        return missing_argument(error);
    const plain_numbers numbers = plain_numbers_begin();
    scene_file *const loaded = scene_file_sea(words, changes, change_count, &problem);
    plain_numbers_end(numbers);
    return finish(file, loaded, NULL, &problem, error);
}

void mgt_scene_file_free(mgt_scene_file *file)
{
    if (file)
        scene_file_free(file->file);
    free(file);
}

mgt_io_status mgt_scene_file_frame(const mgt_scene_file *file, uint32_t frame, mgt_scene *scene, size_t size)
{
    mgt_scene full;
    if (!file || !scene || frame > INT32_MAX || !struct_size_fits(size, sizeof scene->struct_size, sizeof *scene))
        return MGT_IO_ARGUMENT;
    if (!scene_file_frame(file->file, (int)frame, &full))
        return MGT_IO_BAD;
    memset(scene, 0, size); /* what a later version has more is 0 */
    memcpy(scene, &full, size < sizeof full ? size : sizeof full);
    scene->struct_size = size;
    return MGT_IO_OK;
}

uint32_t mgt_scene_file_frame_count(const mgt_scene_file *file) { return file ? (uint32_t)scene_file_frame_count(file->file) : 0; }
double mgt_scene_file_fps(const mgt_scene_file *file) { return file ? scene_file_fps(file->file) : 0; }
const char *mgt_scene_file_warning(const mgt_scene_file *file) { return file ? file->warning : ""; }
