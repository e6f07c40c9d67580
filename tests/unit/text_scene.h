/* SPDX-License-Identifier: MIT
 *
 * Scenes of tests that are written as text.
 */
#ifndef MANGATA_TESTS_TEXT_SCENE_H
#define MANGATA_TESTS_TEXT_SCENE_H

#include "scene/scene_file.h"

typedef struct text_scene {
    scene_file *file; /* owned: scene_file_free() */
    mgt_scene scene;  /* frame 0; it refers to `file` */
} text_scene;

/* Reads a scene with `count` changes "key=value". The test fails if the text is no scene. */
static inline text_scene text_scene_read(const char *text, const char *const *changes, size_t count)
{
    text_scene t = {0};
    scene_error error;
    t.file = scene_file_parse(text, strlen(text), "text", changes, count, &error);
    if (!t.file)
        fail_msg("%s", error.text);
    assert_true(scene_file_frame(t.file, 0, &t.scene));
    return t;
}

#endif
