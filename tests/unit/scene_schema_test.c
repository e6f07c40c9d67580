/* SPDX-License-Identifier: MIT
 *
 * The field table against the reader, docs/scene.schema.json and docs/scenes.md.
 * MGT_UPDATE=1 in the environment rewrites the two documents instead of comparing them.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_fields.h"

#define DOCS MGT_SOURCE_DIR "/docs/"
#define TABLE_BEGIN "| key | allowed |"

static char *read_file(const char *path)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        fail_msg("%s is missing", path);
    char *text = calloc(1, 1 << 20);
    assert_non_null(text);
    assert_true(fread(text, 1, (1 << 20) - 1, stream) > 0);
    fclose(stream);
    return text;
}

static void write_file(const char *path, const char *head, size_t head_length, const char *middle, const char *tail)
{
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    fwrite(head, 1, head_length, stream);
    fputs(middle, stream);
    fputs(tail, stream);
    assert_int_equal(fclose(stream), 0);
}

static char *written(bool (*write)(FILE *))
{
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    assert_non_null(stream);
    assert_true(write(stream));
    fclose(stream);
    return text;
}

static void the_schema_in_docs_is_this_one(void **state)
{
    (void)state;
    char *schema = written(scene_schema_write);
    if (getenv("MGT_UPDATE") != NULL)
        write_file(DOCS "scene.schema.json", "", 0, schema, "");
    char *shipped = read_file(DOCS "scene.schema.json");
    if (strcmp(schema, shipped) != 0)
        fail_msg("docs/scene.schema.json is not what the field table says; run this test with MGT_UPDATE=1");
    free(schema);
    free(shipped);
}

static void the_table_in_docs_is_this_one(void **state)
{
    (void)state;
    char *table = written(scene_reference_write), *document = read_file(DOCS "scenes.md");
    char *begin = strstr(document, TABLE_BEGIN);
    assert_non_null(begin);
    char *end = strstr(begin, "|\n\n");
    assert_non_null(end);
    end += 2;
    if (getenv("MGT_UPDATE") != NULL)
        write_file(DOCS "scenes.md", document, (size_t)(begin - document), table, end);
    else if (strlen(table) != (size_t)(end - begin) || memcmp(table, begin, strlen(table)) != 0)
        fail_msg("the table in docs/scenes.md is not what the field table says; run this test with MGT_UPDATE=1");
    free(table);
    free(document);
}

/* Loads every YAML block of a page; returns how many there are. */
static int load_examples(const char *page)
{
    char *document = read_file(page);
    int examples = 0;
    for (char *at = document; (at = strstr(at, "```yaml\n")) != NULL; examples++) {
        at += strlen("```yaml\n");
        char *end = strstr(at, "```");
        assert_non_null(end);
        scene_error error;
        scene_file *file = scene_file_parse(at, (size_t)(end - at), page, NULL, 0, &error);
        if (file == NULL)
            fail_msg("%s", error.text);
        scene_file_free(file);
        at = end;
    }
    free(document);
    return examples;
}

static void the_examples_in_docs_load(void **state)
{
    (void)state;
    assert_true(load_examples(DOCS "scenes.md") >= 2);
    assert_true(load_examples(DOCS "objects.md") >= 1);
}

/* ---- every numeric field at and just beyond its ends ---------------------------------------------------------- */

/* Some settings belong to one shape. */
static const char *shape_for(const char *override)
{
    if (strstr(override, ".count") != NULL)
        return "shape: steps";
    if (strstr(override, ".rim_") != NULL)
        return "shape: pool";
    if (strstr(override, "est=") != NULL)
        return "shape: floor, heights: \"" MGT_SOURCE_DIR "/tests/data/scenes/floor.pfm\"";
    return "shape: plane";
}

static bool loads(const char *override)
{
    /* A path excludes a still camera's position and target. */
    static const char text[] = "mangata: 1\ncamera: {up: [0.3, 1, 0.2]}\nwater: {waves: [{amplitude: 1, a: 1, b: 1, c: 1}]}\n";
    static const char path[] = "mangata: 1\ncamera: {path: [{time: 0, position: [0, 4, 0], target: [0, 3, -1], up: [0.3, 1, 0.2]}]}\n";
    static const char calm[] = "mangata: 1\ncamera: {up: [0.3, 1, 0.2]}\n"; /* the wind excludes other waves */
    static const char swell[] = "mangata: 1\ncamera: {up: [0.3, 1, 0.2]}\nwater: {swell: [{height: 1}]}\n";
    static const char spectrum[] = "mangata: 1\ncamera: {up: [0.3, 1, 0.2]}\nwater: {spectrum: {model: none}}\n";
    static const struct {
        const char *key, *text;
    } bases[] = {{"camera.path", path}, {"water.wind", calm}, {"water.swell", swell}, {"water.spectrum", spectrum}, {"", text}};
    size_t i = 0;
    while (strncmp(override, bases[i].key, strlen(bases[i].key)) != 0)
        i++;
    char base[512];
    snprintf(base, sizeof base, "%s%s%s}]\n", bases[i].text, "objects: [{instances: [{}], ", shape_for(override));
    scene_error error;
    scene_file *file = scene_file_parse(base, strlen(base), "test", &override, 1, &error);
    scene_file_free(file);
    return file != NULL;
}

static void check_end(const char *name, const field_row *field, double value, bool allowed)
{
    static const char *const shapes[] = {"%s=%.17g", "%s=[%.17g, 1, 0.5]", "%s=[0.5, 1, %.17g]"};
    bool scale = field->type == FIELD_SCALE, vector = field->type == FIELD_VECTOR || field->type == FIELD_COLOR;
    for (int i = vector ? 1 : 0; i < (vector || scale ? 3 : 1); i++) {
        char override[160];
        snprintf(override, sizeof override, shapes[i], name, value);
        if (loads(override) != allowed)
            fail_msg("%s is %s", override, allowed ? "refused" : "accepted");
    }
}

static void check_ranges(const char *path, const field_row *mapping, size_t *checked)
{
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s%s", path, path[0] != '\0' ? "." : "", field->key);
        if (field->type == FIELD_MAPPING) {
            check_ranges(name, field, checked);
        } else if (field->type == FIELD_LIST) {
            char item[72];
            snprintf(item, sizeof item, "%s[0]", name);
            check_ranges(item, field, checked);
        } else if (field->type != FIELD_TEXT && !field->choices) {
            double step = field->type == FIELD_COUNT ? 1 : 0;
            if (field->max > 1e19) /* the nearest double to 2^64 - 1 is beyond it */
                continue;
            check_end(name, field, field->min, !(field->flags & FIELD_OPEN_MIN));
            check_end(name, field, field->max, !(field->flags & FIELD_OPEN_MAX));
            if (!(field->flags & FIELD_OR_ZERO) || field->min - step != 0)
                check_end(name, field, step > 0 ? field->min - step : nextafter(field->min, -INFINITY), false);
            check_end(name, field, step > 0 ? field->max + step : nextafter(field->max, INFINITY), false);
            check_end(name, field, NAN, false);
            ++*checked;
        }
    }
}

static void the_reader_keeps_every_range(void **state)
{
    (void)state;
    size_t checked = 0;
    check_ranges("", scene_root_field(), &checked);
    assert_true(checked >= 34);
}

static int words_named(const field_row *field, const char *name)
{
    int count = 0;
    for (int i = 0; field_word(field, i) != NULL; i++)
        count += strcmp(field_word(field, i), name) == 0;
    return count;
}

static int check_aliases(const field_row *mapping)
{
    int count = 0;
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        if (field->fields != NULL)
            count += check_aliases(field);
        if (field->alias != NULL) {
            assert_false(field->flags & FIELD_REQUIRED);
            for (const field_row *other = mapping->fields; other->key != NULL; other++)
                assert_true(strcmp(other->key, field->alias) != 0 && (other == field || other->alias == NULL || strcmp(other->alias, field->alias) != 0));
            count++;
        }
        for (const name_alias *other = field->aliases; other != NULL && other->alias != NULL; other++) {
            assert_int_equal(words_named(field, other->name), 1);
            assert_int_equal(words_named(field, other->alias), 0);
            count++;
        }
    }
    return count;
}

static void new_names_stand_for_one_old_name(void **state)
{
    (void)state;
    assert_true(check_aliases(scene_root_field()) >= 3);
}

/* A file that loads also passes the library's own check. */
static void the_library_takes_every_end(void **state)
{
    (void)state;
    static const char *const overrides[] = {
        "time={start: 1e8, fps: 0.01, frames: 1000000, shutter: 1000}",
        "light.angular_radius_deg=0.0001",
        "light.radiance=[1e12, 0, 1e12]",
        "sky={turbidity: 10, zenith: [1e9, 1e9, 1e9], horizon: [0, 0, 0], night: [1e9, 0, 0]}",
        "water={ior: 3, body_albedo: [1, 1, 1], waves: [{amplitude: 1000, a: -1e5, b: 1e5, c: 1e5, phase: -1e9}]}",
        "camera={position: [1e9, 1e9, -1e9], target: [-1e9, -1e9, 1e9], up: [1e9, 1e9, 0], fov_y_deg: 178.999}",
        "post={exposure: -60, glare: 1}",
        "post={exposure_offset: 60, glare: 0}",
    };
    mgt_context *context = NULL;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    for (size_t i = 0; i < sizeof overrides / sizeof overrides[0]; i++) {
        scene_error error;
        scene_file *file = scene_file_parse("mangata: 1", 10, "test", &overrides[i], 1, &error);
        if (file == NULL)
            fail_msg("%s", error.text);
        mgt_scene scene;
        assert_true(scene_file_frame(file, scene_file_frame_count(file) - 1, &scene));
        if (mgt_scene_check(context, &scene) != MGT_OK)
            fail_msg("%s: %s", overrides[i], mgt_last_error(context));
        scene_file_free(file);
    }
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_schema_in_docs_is_this_one), cmocka_unit_test(the_table_in_docs_is_this_one), cmocka_unit_test(the_examples_in_docs_load),
        cmocka_unit_test(the_reader_keeps_every_range),   cmocka_unit_test(the_library_takes_every_end),   cmocka_unit_test(new_names_stand_for_one_old_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
