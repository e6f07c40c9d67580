/* SPDX-License-Identifier: MIT */
/* The viewer's parts that need no window: the document and its file, controls, camera, keyframes, waves. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "params/waves.h"
#include "scene/scene_path.h"
#include "viewer/scene/camera_moves.h"
#include "viewer/scene/history.h"
#include "viewer/ui/controls.h"
#include "viewer/picture/palette.h"

static const char scene_text[] = "mangata: 1\n"
                                 "# a comment\n"
                                 "light: {elevation_deg: 10, azimuth_deg: 5}\n"
                                 "camera: {position: [0, 3, 0], target: [0, 2, -4]}\n"
                                 "water: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3}, {amplitude: 0.2, a: -1, b: 0.5, c: 4}]}\n";

typedef struct folder {
    char path[64];
    char scene[96], saved[96];
} folder;

static void write_file(const char *path, const char *text)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    assert_int_equal(fclose(stream), 0);
}

static int make_folder(void **state)
{
    folder *f = calloc(1, sizeof *f);
    snprintf(f->path, sizeof f->path, "/tmp/mangata_parts_XXXXXX");
    assert_non_null(mkdtemp(f->path));
    snprintf(f->scene, sizeof f->scene, "%s/scene.yaml", f->path);
    snprintf(f->saved, sizeof f->saved, "%s/scene-edited.yaml", f->path);
    write_file(f->scene, scene_text);
    *state = f;
    return 0;
}

static int remove_folder(void **state)
{
    folder *f = *state;
    unlink(f->scene);
    unlink(f->saved);
    assert_int_equal(rmdir(f->path), 0); /* nothing else was left behind */
    free(f);
    return 0;
}

static document open_document(const folder *f)
{
    document d;
    scene_error error;
    if (!document_open(&d, f->scene, NULL, 0, &error))
        fail_msg("%s", error.text);
    return d;
}

static void set(document *d, const char *word)
{
    scene_error error;
    if (!document_set(d, word, &error))
        fail_msg("%s", error.text);
}

/* ---- the document ---- */

static void the_file_wins_where_it_changed_and_nothing_else_is_lost(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    assert_int_equal(document_poll(&d), DOCUMENT_SAME);
    set(&d, "light.elevation_deg=20");
    set(&d, "light.azimuth_deg=30");
    set(&d, "water.waves[1].phase=1.5");
    write_file(f->scene, "mangata: 1\nlight: {elevation_deg: 12, azimuth_deg: 5}\ncamera: {position: [0, 3, 0], target: [0, 2, -4]}\n"
                         "water: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3}, {amplitude: 0.25, a: -1, b: 0.5, c: 4}]}\nsky: {model: black}\n");
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    const mgt_wave *waves = d.values.water.waves.items;
    assert_true(d.values.light.elevation_deg == 12);
    assert_true(d.values.light.azimuth_deg == 30);
    assert_true(waves[1].phase == 1.5 && waves[1].amplitude == 0.25);
    assert_int_equal(d.values.sky.look.model, MGT_SKY_BLACK);
    assert_true(document_revert(&d));
    assert_true(d.values.light.azimuth_deg == 5);
    document_close(&d);
}

/* The words of --sea in place of a file. */
static void a_sea_is_a_document(void **state)
{
    (void)state;
    document d;
    scene_error error;
    static const char *const word = "light.elevation_deg=5";
    char name[64];
    if (!document_open(&d, "--sea wind=8,seed=3", &word, 1, &error))
        fail_msg("%s", error.text);
    assert_true(d.values.light.elevation_deg == 5);
    assert_int_equal(scene_water_all(&d.values.water).count, 160);
    assert_true(d.values.water.wind.speed == 8);
    assert_int_equal(document_poll(&d), DOCUMENT_SAME);
    document_save_name(&d, name, sizeof name);
    assert_string_equal(name, "sea-edited.yaml");
    document_close(&d);
    assert_false(document_open(&d, "--sea wind=gale", NULL, 0, &error));
}

static void a_broken_file_changes_nothing(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    set(&d, "light.elevation_deg=20");
    write_file(f->scene, "mangata: 1\nlight: {elevation_deg: far}\n");
    assert_int_equal(document_poll(&d), DOCUMENT_BROKEN);
    assert_non_null(strstr(d.source->error.text, "scene.yaml:2:24: "));
    assert_true(d.values.light.elevation_deg == 20);
    assert_int_equal(document_poll(&d), DOCUMENT_SAME); /* told once */
    unlink(f->scene);
    assert_int_equal(document_poll(&d), DOCUMENT_SAME); /* editors replace files */
    write_file(f->scene, scene_text);
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_int_equal(d.source->error.kind, SCENE_ERROR_NONE);
    assert_true(d.values.light.elevation_deg == 20);
    document_close(&d);
}

static void changes_that_no_longer_fit_are_given_up(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    set(&d, "water.waves[1].phase=1.5");
    write_file(f->scene, "mangata: 1\nlight: {elevation_deg: 11}\n");
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_true(d.values.light.elevation_deg == 11);
    assert_int_equal(d.values.water.waves.count, 0);
    document_close(&d);
}

static void a_spectrum_stays_one(void **state)
{
    const folder *f = *state;
    write_file(f->scene, "mangata: 1\nwater: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3}], spectrum: {model: jonswap, count: 7}}\n");
    document d = open_document(f);
    assert_int_equal(d.values.water.waves.count, 1);
    assert_int_equal(scene_water_all(&d.values.water).count, 8);
    set(&d, "water.waves[0].phase=1.5");
    const double before = ((const mgt_wave *)d.values.water.sea.items)[3].amplitude;
    d.values.water.spectrum.settings.wind = 12;
    document_changed(&d, false);
    document_refresh(&d);
    assert_true(d.fault.kind == SCENE_ERROR_NONE && ((const mgt_wave *)d.values.water.sea.items)[3].amplitude != before);
    scene_overrides words;
    assert_true(scene_overrides_between(scene_file_values(d.source->file), &d.values, &words));
    assert_int_equal(words.count, 2);
    scene_overrides_free(&words);
    /* A sea that cannot be made says why, and the former one stays. */
    d.values.water.spectrum.count = 2048;
    document_changed(&d, false);
    document_refresh(&d);
    assert_true(d.fault.kind == SCENE_ERROR_BAD_SCENE && strstr(d.fault.text, "water.spectrum.count") != NULL);
    assert_int_equal(scene_water_all(&d.values.water).count, 8);
    d.values.water.spectrum.count = 9;
    document_changed(&d, false);
    document_refresh(&d);
    assert_true(d.fault.kind == SCENE_ERROR_NONE && scene_water_all(&d.values.water).count == 10);
    write_file(f->scene, "mangata: 1\nlight: {elevation_deg: 12}\n"
                         "water: {waves: [{amplitude: 0.1, a: 1, b: 2, c: -3}], spectrum: {model: jonswap, count: 7, seed: 2}}\n");
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_true(d.values.light.elevation_deg == 12 && d.values.water.spectrum.seed == 2 && d.values.water.spectrum.settings.wind == 12);
    document_close(&d);
}

static void a_wind_takes_the_place_of_waves(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    settings s = settings_defaults();
    const control_board board = {&d, &s};
    assert_true(control_set_number(&board, "water.wind.speed", 10));
    document_refresh(&d);
    assert_true(d.fault.kind == SCENE_ERROR_NONE && d.values.water.waves.count == 0 && scene_water_all(&d.values.water).count == 160);
    assert_true(d.values.water.choppiness == 0.7f && d.values.water.foam.amount == 1);
    assert_true(control_set_number(&board, "water.foam.share", 0.1));
    assert_true(d.values.water.foam.amount == 0); /* one says it */
    assert_true(control_set_number(&board, "water.choppiness", 0));
    file_error error;
    assert_int_equal(document_save(&d.values, f->saved, false, &error), FILE_OK);
    document_close(&d);
}

static void objects_are_built_anew(void **state)
{
    const folder *f = *state;
    write_file(f->scene, "mangata: 1\nobjects: [{shape: box, size: [1, 1, 1]}]\n");
    document d = open_document(f);
    settings s = settings_defaults();
    const control_board board = {&d, &s};
    char error[256];
    control c;
    const struct scene_models *before = d.values.models;
    assert_true(control_set(&board, "objects[0].position", "[1, 2, 3]", error, sizeof error));
    assert_true(control_set(&board, "objects[0].material.roughness", "0.25", error, sizeof error));
    document_refresh(&d);
    assert_true(d.fault.kind == SCENE_ERROR_NONE && d.values.models != before);
    mgt_scene scene;
    assert_true(scene_values_shot(&d.values, 0, &scene) && scene.object_count == 1);
    assert_false(control_find(&board, "objects[0].rim_width", &c)); /* of pools alone */
    document_close(&d);
}

static const mgt_object *object_of(document *d, mgt_scene *scene)
{
    document_refresh(d);
    assert_true(d->fault.kind == SCENE_ERROR_NONE && scene_values_shot(&d->values, 0, scene) && scene->object_count == 1);
    return &scene->objects[0];
}

/* A mesh is made again where its shape or its file has changed, not where it is put elsewhere. */
static void what_is_moved_keeps_its_mesh(void **state)
{
    static const char *const written[] = {
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n"};
    const folder *f = *state;
    char mesh[128], text[256], error[256];
    settings s = settings_defaults();
    mgt_scene scene;
    for (int of_file = 0; of_file < 2; of_file++) {
        snprintf(mesh, sizeof mesh, "%s.ply", f->scene);
        write_file(mesh, written[0]);
        snprintf(text, sizeof text, "mangata: 1\nobjects: [{%s%s%s}]\n", of_file ? "mesh: \"" : "shape: box, size: [1, 1, 1]", of_file ? mesh : "",
                 of_file ? "\"" : "");
        write_file(f->scene, text);
        document d = open_document(f);
        const control_board board = {&d, &s};
        const mgt_mesh *first = object_of(&d, &scene)->mesh;
        assert_true(control_set(&board, "objects[0].position", "[1, 2, 3]", error, sizeof error));
        const mgt_object *moved = object_of(&d, &scene);
        assert_true(moved->mesh == first && moved->transform[1][3] == 2);
        assert_true(control_set(&board, "objects[0].scale", "[1, 2, 1]", error, sizeof error));
        assert_true(object_of(&d, &scene)->mesh == first);
        if (of_file)
            write_file(mesh, written[1]);
        assert_true(control_set(&board, of_file ? "objects[0].position" : "objects[0].size", "[2, 2, 2]", error, sizeof error));
        assert_true(object_of(&d, &scene)->mesh != first);
        document_close(&d);
        unlink(mesh);
    }
}

static void a_saved_scene_is_whole_and_replaces_nothing(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    char name[128];
    file_error error;
    document_save_name(&d, name, sizeof name);
    assert_string_equal(name, f->saved);
    set(&d, "camera.path=[{time: 0, position: [0, 3, 0], target: [0, 2, -4]}, {time: 1, position: [1, 3, 0], target: [0, 2, -4]}]");
    assert_true(d.values.camera.still.position[1] == 3); /* still there, for the hand */
    assert_int_equal(document_save(&d.values, name, false, &error), FILE_OK);
    scene_error problem;
    scene_file *saved = scene_file_load(name, NULL, 0, &problem);
    assert_non_null(saved);
    char *left = scene_values_canonical(&d.values, NULL), *right = scene_file_canonical(saved, NULL);
    assert_string_equal(left, right);
    free(left);
    free(right);
    scene_file_free(saved);
    assert_int_equal(document_save(&d.values, name, false, &error), FILE_EXISTS);
    /* What would not read back is not written. */
    ((scene_keyframe *)d.values.camera.path.items)[1].time = -1;
    assert_int_not_equal(document_save(&d.values, name, true, &error), FILE_OK);
    assert_non_null(strstr(error.text, "time"));
    document_close(&d);
}

/* A file has no still camera beside a path, but the hand has a view. */
static void a_view_beside_a_path_stays(void **state)
{
    static const char start[] = "mangata: 1\ntime: {start: 1}\ncamera:\n  path:\n    - {time: 0, position: [0, 3, 0], target: [0, 2, -4]}\n"
                                "    - {time: 2, position: [2, 3, 0], target: [0, 2, -4]}\n";
    const folder *f = *state;
    char text[400];
    write_file(f->scene, start);
    document d = open_document(f);
    const mgt_camera *view = &d.values.camera.still;
    assert_true(view->position[0] == 1 && view->position[1] == 3 && view->target[2] == -4 && scene_camera_equal(view, &d.source->home));
    /* Not moved, it stays at the path's start, wherever that is. */
    snprintf(text, sizeof text, "%s    - {time: 3, position: [9, 5, 0], target: [0, 2, -4]}\n", start);
    memcpy(strstr(text, "start: 1"), "start: 3", 8);
    write_file(f->scene, text);
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_true(view->position[0] == 9 && d.source->home.position[0] == 9);
    /* Moved, it stays where it is when the file changes. */
    d.values.camera.still.position[0] = 5;
    snprintf(text, sizeof text, "%slight: {elevation_deg: 12}\n", start);
    write_file(f->scene, text);
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_true(d.values.light.elevation_deg == 12 && view->position[0] == 5);
    document_close(&d);
    /* So it does beside a path that is in the document alone, until the file's own camera changes. */
    write_file(f->scene, scene_text);
    d = open_document(f);
    set(&d, "camera.path=[{time: 0, position: [0, 3, 0], target: [0, 2, -4]}]");
    d.values.camera.still.position[0] = 5;
    write_file(f->scene, "mangata: 1\ncamera: {position: [0, 3, 0], target: [0, 2, -4]}\n");
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_true(d.values.camera.path.count == 1 && d.values.water.waves.count == 0 && view->position[0] == 5);
    write_file(f->scene, "mangata: 1\ncamera: {position: [0, 8, 0], target: [0, 2, -4]}\n");
    assert_int_equal(document_poll(&d), DOCUMENT_READ_ANEW);
    assert_true(d.values.camera.path.count == 1 && view->position[0] == 0 && view->position[1] == 8);
    document_close(&d);
}

/* ---- controls ---- */

static void every_control_reads_back_and_keeps_to_its_range(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    settings s = settings_defaults();
    const control_board board = {&d, &s};
    size_t count;
    uint64_t chance = 7;
    control *list = control_list(&board, &count);
    assert_non_null(list);
    for (size_t i = 0; i < count; i++) {
        char error[256], wrong[64];
        control c;
        double before[3], after[3];
        assert_true(control_find(&board, list[i].name, &c));
        assert_ptr_equal(c.value, list[i].value);
        if (c.hint == NULL && c.name[1] != '.') /* an option of a side may have its row alone */
            fail_msg("%s has no hint", c.name);
        control_read(&c, before);
        const control_text text = control_print(&c);
        if (!control_set(&board, c.name, text.text, error, sizeof error))
            fail_msg("%s", error);
        control_read(&c, after);
        for (int k = 0; k < 3; k++)
            if (fabs(after[k] - before[k]) > 1e-12 * fabs(before[k]))
                fail_msg("%s changes when it is set to itself", c.name);
        for (int k = 0; k < 20; k++)
            if (!control_set(&board, c.name, control_random(&c, &chance).text, error, sizeof error))
                fail_msg("%s", error);
        static const char *const words[] = {"", "x", "nan", "1e999", "[1, 2]", "1 2"};
        for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
            snprintf(wrong, sizeof wrong, "%s", words[k]);
            if (control_set(&board, c.name, wrong, error, sizeof error))
                fail_msg("%s=%s is accepted", c.name, wrong);
            assert_non_null(strstr(error, c.name));
        }
        /* Beyond every range there is. */
        const double huge[3] = {1e300, 1e300, 1e300}, low[3] = {-1e300, -1e300, -1e300};
        control_write(&board, &c, huge);
        control_write(&board, &c, low);
        if (!control_set(&board, c.name, control_print(&c).text, error, sizeof error))
            fail_msg("%s", error);
    }
    free(list);
    document_close(&d);
}

static void every_value_of_the_scene_is_a_control(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    settings s = settings_defaults();
    const control_board board = {&d, &s};
    control c;
    for (const field_row *part = scene_root_field()->fields; part->key; part++)
        for (const field_row *field = part->fields; part->type == FIELD_MAPPING && field->key; field++) {
            char name[96];
            snprintf(name, sizeof name, "%s.%s", part->key, field->key);
            /* The document holds the coefficients that the first has made; each side has a quality of its own. */
            const bool done = strcmp(name, "water.clarity") == 0 || strcmp(part->key, "quality") == 0;
            if (field->type != FIELD_LIST && field->type != FIELD_MAPPING && control_find(&board, name, &c) == done)
                fail_msg("%s is %s control", name, done ? "a" : "no");
        }
    assert_false(control_find(&board, "light", &c));
    assert_false(control_find(&board, "view", &c));
    assert_false(control_find(&board, "water.waves[2].a", &c));
    assert_false(control_find(&board, "water.swell[0].height", &c));
    assert_false(control_find(&board, "objects[0].position", &c)); /* there is none */
    assert_true(control_find(&board, "water.spectrum.wind", &c) && control_find(&board, "water.wind.fetch", &c));
    assert_false(control_find(&board, "view.wipes", &c));
    document_close(&d);
}

static void another_body_brings_its_own_light(void **state)
{
    const folder *f = *state;
    document d = open_document(f);
    settings s = settings_defaults();
    const control_board board = {&d, &s};
    char error[256];
    assert_true(control_set(&board, "light.body", "moon", error, sizeof error));
    assert_true(d.values.light.angular_radius_deg == 0.2590);
    assert_true(d.values.light.elevation_deg == 10 && d.values.light.azimuth_deg == 5);
    document_close(&d);
}

/* ---- camera and waves ---- */

static double distance(const mgt_camera *c)
{
    return sqrt(pow(c->target[0] - c->position[0], 2) + pow(c->target[1] - c->position[1], 2) + pow(c->target[2] - c->position[2], 2));
}

static void cameras_turn_without_tumbling(void **state)
{
    (void)state;
    mgt_camera c = {.position = {0, 3, 0}, .target = {0, 2, -4}, .up = {0, 1, 0}, .fov_y_deg = 50};
    const double length = distance(&c);
    const mgt_camera start = c;
    camera_orbit(&c, 0.3, 0.2, -100);
    assert_true(fabs(distance(&c) - length) < 1e-9 && memcmp(c.target, start.target, sizeof c.target) == 0);
    camera_orbit(&c, 0, 9, -100); /* stops short of straight down */
    const camera_axes axes = camera_axes_of(&c);
    assert_true(isfinite(axes.right[0]) && axes.forward[1] > -1 && axes.forward[1] < -0.99);
    c = start;
    camera_look(&c, 0.5, -9);
    assert_true(memcmp(c.position, start.position, sizeof c.position) == 0 && fabs(distance(&c) - length) < 1e-9);
    c = start;
    camera_set_pivot(&c, 0);
    assert_true(fabs(c.target[1]) < 1e-9); /* where the view meets the water */
    const camera_axes before = camera_axes_of(&start), after = camera_axes_of(&c);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(before.forward[i] - after.forward[i]) < 1e-12);
    const double arm = distance(&c);
    camera_orbit(&c, 0, -2, 0.5); /* not into the water, at the same distance */
    assert_true(fabs(c.position[1] - 0.5) < 1e-9 && fabs(distance(&c) - arm) < 1e-9);
    c = start;
    camera_set_pivot(&c, 0);
    camera_keep_above(&c, 7);
    assert_true(c.position[1] == 7 && fabs(c.target[1] - 4) < 1e-9);
    camera_move(&c, 0, 0, -1);
    assert_true(c.position[1] == 6);
}

static void what_is_grabbed_stays_under_the_pointer(void **state)
{
    (void)state;
    mgt_camera c = {.position = {2, 3, 1}, .target = {3, 2.4, -4}, .up = {0, 1, 0}, .fov_y_deg = 50};
    const double aspect = 1.5, from[2] = {0.3, 0.8}, to[2] = {0.7, 0.65}, sky[2] = {0.5, 0};
    double direction[3], point[3], at[2];
    camera_view_ray(&c, aspect, from, direction);
    for (int i = 0; i < 3; i++)
        point[i] = c.position[i] + 4 * direction[i];
    assert_true(camera_project(&c, aspect, point, at));
    assert_true(fabs(at[0] - from[0]) < 1e-12 && fabs(at[1] - from[1]) < 1e-12);
    assert_true(camera_grab(&c, aspect, point, to));
    assert_true(c.position[1] == 3 && c.target[1] == 2.4);
    assert_true(camera_project(&c, aspect, point, at));
    assert_true(fabs(at[0] - to[0]) < 1e-9 && fabs(at[1] - to[1]) < 1e-9);
    assert_false(camera_grab(&c, aspect, point, sky));
    for (int i = 0; i < 3; i++)
        point[i] = 2 * c.position[i] - c.target[i];
    assert_false(camera_project(&c, aspect, point, at));
}

static void states_are_undone_and_redone(void **state)
{
    (void)state;
    history h = {0};
    document d = {.values = scene_values_defaults()};
    settings chosen = settings_defaults();
    assert_true(history_start(&h, &d, &chosen) && history_is_current(&h, &d, &chosen));
    assert_false(history_add(&h, &d, &chosen)); /* nothing has changed */
    assert_null(history_step(&h, -1));
    for (int i = 1; i <= 3; i++) {
        d.values.light.elevation_deg = 10 * i;
        assert_true(history_add(&h, &d, &chosen));
    }
    chosen.view.wipe = 0.25;
    assert_true(history_add(&h, &d, &chosen));
    assert_true(history_step(&h, -1)->settings.view.wipe == 0.5);
    assert_true(history_step(&h, -1)->values.light.elevation_deg == 20);
    assert_true(history_step(&h, 1)->values.light.elevation_deg == 30);
    history_follow(&h, 7, &d.values.camera.still);
    chosen.clock.time = 7;
    chosen.view.wipe = 0.5;
    assert_true(history_is_current(&h, &d, &chosen));
    d.values.light.elevation_deg = 50; /* in place of the wipe that was undone */
    assert_true(history_add(&h, &d, &chosen));
    assert_null(history_step(&h, 1));
    for (int i = 0; i < 2000; i++) {
        d.values.light.elevation_deg = i % 2;
        assert_true(history_add(&h, &d, &chosen));
    }
    assert_true(h.count < 1000 && h.at == h.count - 1);
    history_free(&h);
    assert_false(history_add(&h, &d, &chosen));
    document_close(&d);
}

static void keyframes_stay_in_order(void **state)
{
    (void)state;
    scene_list path = {0};
    mgt_camera c = {.position = {0, 1, 0}};
    static const double times[] = {2, 0, 1, 3, 1};
    for (size_t i = 0; i < 5; i++) {
        c.position[0] = (double)i;
        assert_true(keyframe_record(&path, times[i], &c));
    }
    assert_int_equal(path.count, 4); /* the last one replaced another */
    const scene_keyframe *items = path.items;
    for (size_t i = 0; i < 4; i++)
        assert_true(items[i].time == (double)i);
    assert_true(items[1].camera.position[0] == 4);
    assert_int_equal(keyframe_move(&path, 0, 2.5), 2);
    assert_true(items[0].time == 1 && items[1].time == 2 && items[2].time == 2.5 && items[2].camera.position[0] == 1);
    assert_int_equal(keyframe_move(&path, 0, 3), 0); /* taken */
    assert_true(items[0].time == 1);
    for (size_t left = 4; left > 0; left--)
        keyframe_delete(&path, left / 2);
    assert_int_equal(path.count, 0);
    assert_null(path.items);
}

static void waves_have_shapes(void **state)
{
    (void)state;
    for (size_t i = 0; i < 50; i++) {
        mgt_wave w = wave_new(i), again = w;
        const wave_shape shape = wave_shape_of(&w);
        wave_set_shape(&again, &shape);
        assert_true(fabs(again.kx - w.kx) < 1e-9 && fabs(again.kz - w.kz) < 1e-9 && fabs(again.omega - w.omega) < 1e-9);
        assert_true(shape.speed > 0);
        /* Crests travel where the shape says. */
        const double angle = shape.direction_deg * 3.14159265358979 / 180, t = 0.37, way = shape.speed * t;
        const double x = 1.2, z = -0.4, here = waves_height(&w, 1, x, z, 0);
        assert_true(fabs(waves_height(&w, 1, x + way * sin(angle), z - way * cos(angle), t) - here) < 1e-9);
    }
}

static void palettes_have_their_ends(void **state)
{
    (void)state;
    assert_true(palette_color(PALETTE_AMOUNT, -1) == palette_color(PALETTE_AMOUNT, 0));
    assert_true(palette_color(PALETTE_AMOUNT, 2) == palette_color(PALETTE_AMOUNT, 1));
    assert_true(palette_color(PALETTE_AMOUNT, NAN) == palette_color(PALETTE_AMOUNT, 0));
    int last = -1;
    for (int i = 0; i <= 100; i++) { /* green stands for lightness */
        const int green = (int)(palette_color(PALETTE_AMOUNT, i / 100.0) >> 16 & 255);
        assert_true(green >= last);
        last = green;
    }
    assert_true(palette_lean(0.5, 0) != palette_lean(-0.5, 0) && palette_lean(0, 0.5) != palette_lean(0, -0.5));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_file_wins_where_it_changed_and_nothing_else_is_lost, make_folder, remove_folder),
        cmocka_unit_test(a_sea_is_a_document),
        cmocka_unit_test_setup_teardown(a_broken_file_changes_nothing, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(changes_that_no_longer_fit_are_given_up, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(a_spectrum_stays_one, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(a_wind_takes_the_place_of_waves, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(objects_are_built_anew, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(what_is_moved_keeps_its_mesh, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(a_saved_scene_is_whole_and_replaces_nothing, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(a_view_beside_a_path_stays, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(every_control_reads_back_and_keeps_to_its_range, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(every_value_of_the_scene_is_a_control, make_folder, remove_folder),
        cmocka_unit_test_setup_teardown(another_body_brings_its_own_light, make_folder, remove_folder),
        cmocka_unit_test(cameras_turn_without_tumbling),
        cmocka_unit_test(what_is_grabbed_stays_under_the_pointer),
        cmocka_unit_test(states_are_undone_and_redone),
        cmocka_unit_test(keyframes_stay_in_order),
        cmocka_unit_test(waves_have_shapes),
        cmocka_unit_test(palettes_have_their_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
