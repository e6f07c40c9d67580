/* SPDX-License-Identifier: MIT */
/* Scene files and pictures of libmangata-io: what failures leave, the sizes of structs, and where errors say that they are. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mangata/io.h"

static const char scene_text[] = "mangata: 1\n";

static mgt_scene_file *parse(const char *text, const char *change)
{
    mgt_scene_file *file;
    mgt_io_error error;
    mgt_io_error_init(&error, sizeof error);
    if (mgt_scene_file_parse(&file, text, strlen(text), "s.yaml", &change, change != NULL, &error) != MGT_IO_OK)
        fail_msg("%s", error.text);
    return file;
}

/* ---- failures ---- */

static char *const garbage = (char *)"not a pointer to free";

static void failures_leave_nothing(void **state)
{
    (void)state;
    static const char *const change = "time.start=1";
    mgt_scene_file *file;
    mgt_io_error error;
    mgt_io_error_init(&error, sizeof error);
#define LEAVES_NULL(status, call)                 \
    do {                                          \
        file = (mgt_scene_file *)(void *)garbage; \
        assert_int_equal(call, status);           \
        assert_null(file);                        \
    } while (0)
    LEAVES_NULL(MGT_IO_ARGUMENT, mgt_scene_file_load(&file, NULL, NULL, 0, &error));
    LEAVES_NULL(MGT_IO_ARGUMENT, mgt_scene_file_load(&file, "a.yaml", NULL, 1, &error));
    LEAVES_NULL(MGT_IO_MISSING, mgt_scene_file_load(&file, "/nowhere/a.yaml", &change, 1, NULL));
    LEAVES_NULL(MGT_IO_ARGUMENT, mgt_scene_file_parse(&file, NULL, 0, "a.yaml", NULL, 0, &error));
    LEAVES_NULL(MGT_IO_ARGUMENT, mgt_scene_file_parse(&file, scene_text, strlen(scene_text), NULL, NULL, 0, &error));
    LEAVES_NULL(MGT_IO_BAD, mgt_scene_file_parse(&file, "no: 1\n", 6, "a.yaml", NULL, 0, &error));
    LEAVES_NULL(MGT_IO_ARGUMENT, mgt_scene_file_sea(&file, NULL, NULL, 0, &error));
    LEAVES_NULL(MGT_IO_ARGUMENT, mgt_scene_file_sea(&file, "wind=9", NULL, 2, &error));
#undef LEAVES_NULL
    assert_int_equal(mgt_scene_file_sea(NULL, "wind=9", NULL, 0, &error), MGT_IO_ARGUMENT);

    mgt_io_picture picture = {.struct_size = sizeof picture, .width = 3, .pixels = (float *)(void *)garbage};
    assert_int_equal(mgt_io_picture_read(&picture, NULL, NULL, &error), MGT_IO_ARGUMENT);
    assert_null(picture.pixels);
    assert_int_equal(picture.width, 0);
    mgt_io_picture_free(&picture);
    mgt_scene_file_free(NULL);
}

/* ---- sizes ---- */

/* A frame has all the bytes that the caller says it has, as mgt_scene_init() gives them: programs of earlier and of later headers. */
static void frames_are_as_large_as_asked(void **state)
{
    (void)state;
    enum { LATER = 64 };
    _Alignas(mgt_scene) unsigned char wanted[sizeof(mgt_scene) + LATER + 1], got[sizeof wanted];
    static const size_t sizes[] = {sizeof(size_t), offsetof(mgt_scene, quality), sizeof(mgt_scene), sizeof(mgt_scene) + 1, sizeof(mgt_scene) + LATER};
    mgt_scene_file *file = parse(scene_text, NULL);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        mgt_scene *scene = (mgt_scene *)(void *)got;
        memset(got, 0x77, sizeof got);
        memset(wanted, 0x77, sizeof wanted);
        mgt_scene_init((mgt_scene *)(void *)wanted, sizes[i]);
        assert_int_equal(mgt_scene_file_frame(file, 0, scene, sizes[i]), MGT_IO_OK);
        assert_int_equal(scene->struct_size, sizes[i]);
        if (sizes[i] > sizeof(mgt_scene)) {
            assert_int_equal(((mgt_scene *)(void *)wanted)->struct_size, sizes[i]);
            assert_memory_equal(got + sizeof(mgt_scene), wanted + sizeof(mgt_scene), LATER + 1);
        }
        for (size_t k = sizes[i]; k < sizeof got; k++)
            assert_int_equal(got[k], 0x77);
    }
    mgt_scene scene;
    memset(&scene, 0x77, sizeof scene);
    const mgt_scene before = scene;
    assert_int_equal(mgt_scene_file_frame(file, 0, &scene, sizeof(size_t) - 1), MGT_IO_ARGUMENT);
    assert_int_equal(mgt_scene_file_frame(file, 0, &scene, SIZE_MAX), MGT_IO_ARGUMENT);
    assert_memory_equal(&scene, &before, sizeof scene);
    mgt_scene_file_free(file);
}

/* ---- errors ---- */

typedef struct expected {
    const char *file, *text; /* `text`: how it begins */
    uint32_t line, column;
} expected;

static void expect(const mgt_io_error *got, expected e)
{
    if (strcmp(got->file, e.file) != 0 || got->line != e.line || got->column != e.column || strncmp(got->text, e.text, strlen(e.text)) != 0)
        fail_msg("'%s' %u %u '%s' in place of '%s' %u %u '%s'", got->file, got->line, got->column, got->text, e.file, e.line, e.column, e.text);
    assert_true(strlen(got->text) > 10);
    assert_null(strstr(got->text, "--"));
}

static void errors_say_where(void **state)
{
    (void)state;
    static const char bad[] = "mangata: 1\nlight: 3\n";
    static char long_name[1500], cut[1024];
    memset(long_name, 'n', sizeof long_name - 1);
    memset(cut, 'n', sizeof cut - 1);
    const struct {
        const char *path, *text; /* of a file that is parsed; NULL: it is loaded */
        expected wanted;
    } files[] = {{"/nowhere/a.yaml", NULL, {"/nowhere/a.yaml", "No such file or directory; allowed: ", 0, 0}},
                 {"/tmp", NULL, {"/tmp", "is a directory; allowed: ", 0, 0}},
                 {"", NULL, {"", "the scene's file name is empty", 0, 0}},
                 {"s.yaml", bad, {"s.yaml", "light is 3; allowed: ", 2, 8}},
                 {"a b:3:4: c", bad, {"a b:3:4: c", "light is 3; allowed: ", 2, 8}},
                 {"a\nb:9", bad, {"a\nb:9", "light is 3; allowed: ", 2, 8}},
                 {long_name, bad, {cut, "light is 3; allowed: ", 2, 8}}};
    mgt_scene_file *file;
    mgt_io_error error;
    mgt_io_error_init(&error, sizeof error);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        if (files[i].text)
            mgt_scene_file_parse(&file, files[i].text, strlen(files[i].text), files[i].path, NULL, 0, &error);
        else
            mgt_scene_file_load(&file, files[i].path, NULL, 0, &error);
        assert_null(file);
        expect(&error, files[i].wanted);
    }

    mgt_io_picture picture = {.struct_size = sizeof picture};
    assert_int_equal(mgt_io_picture_read(&picture, "/nowhere/a\t1:2: b.png", NULL, &error), MGT_IO_MISSING);
    expect(&error, (expected){.file = "/nowhere/a\t1:2: b.png", .text = "cannot read: "});
}

/* The library has no options: its texts speak of what was given to it. */
static void errors_speak_of_changes_and_words(void **state)
{
    (void)state;
    static const struct {
        const char *changes[2], *text;
    } cases[] =
        {{{"nokey"}, "change nokey: not of the form key=value; allowed: "},
         {{"light.elevation_deg=high"}, "change light.elevation_deg=high: light.elevation_deg is high; allowed: "},
         {{"light.body=moon", "light.source=sun"},
          "change light.source=sun: key \"source\" stands beside \"body\" of change light.body=moon; \"source\" is the new name of \"body\"; allowed: "}};
    mgt_scene_file *file;
    mgt_io_error error;
    mgt_io_error_init(&error, sizeof error);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_not_equal(mgt_scene_file_parse(&file, scene_text, strlen(scene_text), "s.yaml", cases[i].changes, 1 + (cases[i].changes[1] != NULL), &error),
                             MGT_IO_OK);
        expect(&error, (expected){.file = "", .text = cases[i].text});
    }
    assert_int_equal(mgt_scene_file_sea(&file, "wind=abc", NULL, 0, &error), MGT_IO_ARGUMENT);
    expect(&error, (expected){.file = "", .text = "sea wind=abc: wind is \"abc\"; allowed: "});

    file = parse(scene_text, "water.waves=[{amplitude: 3, a: 2, b: 0, c: 0}]");
    const char *warning = mgt_scene_file_warning(file), begin[] = "change water.waves=[{amplitude: 3,";
    if (strncmp(warning, begin, strlen(begin)) != 0)
        fail_msg("the warning is '%s'", warning);
    mgt_scene_file_free(file);
    file = parse(scene_text, NULL);
    assert_string_equal(mgt_scene_file_warning(file), "");
    mgt_scene_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failures_leave_nothing),
        cmocka_unit_test(frames_are_as_large_as_asked),
        cmocka_unit_test(errors_say_where),
        cmocka_unit_test(errors_speak_of_changes_and_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
