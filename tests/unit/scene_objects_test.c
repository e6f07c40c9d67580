/* SPDX-License-Identifier: MIT
 *
 * Objects of scene files: every key in the library's structs, meshes of every format, instances, materials, the render hash, and errors that say
 * what is wrong and where.
 */
#include "image_test_folder.h"

#include <math.h>

#include "image/picture.h"
#include "scene/scene_edit.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static const char cube_obj[] =
    "mtllib cube.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl blue\n"
    "f 1/1 4/4 3/3 2/2\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4\nf 4/1 8/2 7/3 3/4\nf 1/1 5/2 8/3 4/4\nf 2/1 3/2 7/3 6/4\n";
static const char cube_mtl[] = "newmtl blue\nKd 0.1 0.2 0.8\nmap_Kd dots.png\n";
static const char triangle_ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                                   "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
/* One triangle in two nodes, the second inside the first; the buffer is inside the file. */
static const char nodes_gltf[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}],\n"
    "\"nodes\": [{\"mesh\": 0, \"translation\": [1, 2, 3], \"children\": [1]}, {\"mesh\": 0, \"scale\": [2, 2, 2]}],\n"
    "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"material\": 0}]}],\n"
    "\"materials\": [{\"pbrMetallicRoughness\": {\"baseColorFactor\": [0.5, 0.25, 0.125, 1], \"roughnessFactor\": 0.75, \"metallicFactor\": 0.5}}],\n"
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\", \"min\": [0, 0, 0], \"max\": [1, 1, 0]}],\n"
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}],\n"
    "\"buffers\": [{\"byteLength\": 36, \"uri\": \"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}\n";

static void put(const test_folder *folder, const char *name, const char *text)
{
    char path[512];
    write_bytes(in_folder(folder, name, path), text, strlen(text));
}

/* 8 x 8 pixels, all of one red. */
static void put_jpeg(const test_folder *folder)
{
    char path[512];
    static const uint8_t bytes[] = {0xff, 0xd8, 0xff, 0xe0, 0x00, 0x10, 0x4a, 0x46, 0x49, 0x46, 0x00, 0x01, 0x02, 0x00, 0x00, 0x01, 0x00, 0x01, 0x00,
                                    0x00, 0xff, 0xfe, 0x00, 0x10, 0x4c, 0x61, 0x76, 0x63, 0x35, 0x39, 0x2e, 0x33, 0x37, 0x2e, 0x31, 0x30, 0x30, 0x00,
                                    0xff, 0xdb, 0x00, 0x43, 0x00, 0x08, 0x04, 0x04, 0x04, 0x04, 0x04, 0x05, 0x05, 0x05, 0x05, 0x05, 0x05, 0x06, 0x06,
                                    0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x07, 0x07, 0x07, 0x08, 0x08, 0x08, 0x07, 0x07,
                                    0x07, 0x06, 0x06, 0x07, 0x07, 0x08, 0x08, 0x08, 0x08, 0x09, 0x09, 0x09, 0x08, 0x08, 0x08, 0x08, 0x09, 0x09, 0x0a,
                                    0x0a, 0x0a, 0x0c, 0x0c, 0x0b, 0x0b, 0x0e, 0x0e, 0x0e, 0x11, 0x11, 0x14, 0xff, 0xc4, 0x00, 0x4d, 0x00, 0x01, 0x01,
                                    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x06, 0x01, 0x01, 0x01,
                                    0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x06, 0x07, 0x10, 0x01,
                                    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x11, 0x01, 0x00,
                                    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0xc0, 0x00, 0x11,
                                    0x08, 0x00, 0x08, 0x00, 0x08, 0x03, 0x01, 0x12, 0x00, 0x02, 0x12, 0x00, 0x03, 0x12, 0x00, 0xff, 0xda, 0x00, 0x0c,
                                    0x03, 0x01, 0x00, 0x02, 0x11, 0x03, 0x11, 0x00, 0x3f, 0x00, 0x8d, 0x13, 0x83, 0x51, 0x1f, 0xff, 0xd9};
    write_bytes(in_folder(folder, "red.jpg", path), bytes, sizeof bytes);
}

static void put_dots(const test_folder *folder)
{
    char path[512];
    file_error error;
    static const uint8_t pixels[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255};
    assert_int_equal(picture_write_png(in_folder(folder, "dots.png", path), 2, 2, pixels, 0, NULL, &(output_options){.overwrite = true}, &error), FILE_OK);
}

static int files_setup(void **state)
{
    if (folder_setup(state) != 0)
        return -1;
    const test_folder *folder = *state;
    put(folder, "cube.obj", cube_obj);
    put(folder, "cube.mtl", cube_mtl);
    put(folder, "triangle.ply", triangle_ply);
    put(folder, "nodes.gltf", nodes_gltf);
    put_dots(folder);
    put_jpeg(folder);
    return 0;
}

/* Loads "mangata: 1\nobjects:\n" and what follows from a file in the folder. */
static scene_file *try_load(const test_folder *folder, const char *objects, scene_error *error)
{
    char path[512], text[4096];
    snprintf(text, sizeof text, "mangata: 1\nobjects:\n%s", objects);
    put(folder, "s.yaml", text);
    return scene_file_load(in_folder(folder, "s.yaml", path), NULL, 0, error);
}

static scene_file *load(const test_folder *folder, const char *objects)
{
    scene_error error;
    scene_file *file = try_load(folder, objects, &error);
    if (file == NULL)
        fail_msg("%s", error.text);
    return file;
}

static mgt_scene scene_of(const scene_file *file)
{
    mgt_scene scene;
    assert_true(scene_file_frame(file, 0, &scene));
    return scene;
}

static void assert_transform(const mgt_object *object, const double expected[12])
{
    for (int i = 0; i < 12; i++)
        if (!(fabs(object->transform[i / 4][i % 4] - expected[i]) < 1e-12))
            fail_msg("transform[%d][%d] is %.17g, not %.17g", i / 4, i % 4, object->transform[i / 4][i % 4], expected[i]);
}

static void water_keys_are_read(void **state)
{
    const test_folder *folder = *state;
    scene_file *file =
        load(folder, "  []\nwater: {level: -2.5, clarity: murky, absorption: [1, 2, 3], amplitude: 3, waves: [{amplitude: 0.5, a: 1, b: 2, c: 3}]}\n");
    mgt_scene scene = scene_of(file);
    assert_true(scene.water.level == -2.5);
    assert_true(scene.water.absorption[0] == 1 && scene.water.absorption[2] == 3);
    assert_true(scene.water.scattering[0] > 1); /* from clarity */
    assert_int_equal(scene.water.wave_count, 1);
    assert_true(scene.water.waves[0].amplitude == 1.5);
    assert_null(scene.objects);
    assert_int_equal(scene.object_count, 0);
    scene_file_free(file);
    /* Each is murkier than the one before; the clearest is the default. */
    static const char *const names[] = {"pure", "clear", "coastal", "murky"};
    float before = 0;
    for (int i = 0; i < 4; i++) {
        char text[64];
        snprintf(text, sizeof text, "  []\nwater: {clarity: %s}\n", names[i]);
        file = load(folder, text);
        scene = scene_of(file);
        assert_true(scene.water.scattering[1] + scene.water.absorption[1] > before);
        before = scene.water.scattering[1] + scene.water.absorption[1];
        mgt_scene defaults;
        mgt_scene_init(&defaults, sizeof defaults);
        assert_int_equal(i == 0, memcmp(scene.water.absorption, defaults.water.absorption, sizeof defaults.water.absorption) == 0);
        scene_file_free(file);
    }
    /* The factor scales a spectrum's waves too, and 0 stills them. */
    file = load(folder, "  []\nwater: {spectrum: {model: jonswap, count: 9}}\n");
    scene_file *twice = load(folder, "  []\nwater: {amplitude: 2, spectrum: {model: jonswap, count: 9}}\n");
    scene = scene_of(file);
    mgt_scene other = scene_of(twice);
    assert_int_equal(other.water.wave_count, 9);
    for (int i = 0; i < 9; i++)
        assert_true(other.water.waves[i].amplitude == 2 * scene.water.waves[i].amplitude && other.water.waves[i].kx == scene.water.waves[i].kx);
    scene_file_free(file);
    scene_file_free(twice);
    scene_error error;
    assert_null(try_load(folder, "  []\nwater: {amplitude: 600, waves: [{amplitude: 2, a: 1, b: 1, c: 1}]}\n", &error));
    assert_non_null(strstr(error.text, "s.yaml:4:20: water.amplitude is 600, which makes a wave of 1200 m; allowed: waves of at most 1000 m"));
}

static void places_are_scaled_turned_and_moved(void **state)
{
    const test_folder *folder = *state;
    scene_file *file = load(folder, "  - shape: box\n    position: [1, 2, 3]\n    scale: 2\n    instances:\n"
                                    "      - {rotation_deg: [0, 90, 0]}\n      - {rotation_deg: [90, 0, 0], scale: [1, 2, 3]}\n"
                                    "      - {rotation_deg: [90, 90, 90], position: [4, 5, 6]}\n      - {rotation_deg: [0, 0, -720]}\n");
    const mgt_scene scene = scene_of(file);
    assert_int_equal(scene.object_count, 5);
    assert_transform(&scene.objects[0], (const double[]){2, 0, 0, 1, 0, 2, 0, 2, 0, 0, 2, 3});
    /* About y: z goes to x. */
    assert_transform(&scene.objects[1], (const double[]){0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0});
    /* About x: y goes to z, each axis with its own scale. */
    assert_transform(&scene.objects[2], (const double[]){1, 0, 0, 0, 0, 0, -3, 0, 0, 2, 0, 0});
    /* z first: x to y; then x: y to z; then y: z to x. So x stays, y goes to −x, then … */
    assert_transform(&scene.objects[3], (const double[]){1, 0, 0, 4, 0, 0, -1, 5, 0, 1, 0, 6});
    assert_transform(&scene.objects[4], (const double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
    for (int i = 1; i < 5; i++)
        assert_ptr_equal(scene.objects[i].mesh, scene.objects[0].mesh);
    scene_file_free(file);
}

static void materials_are_read(void **state)
{
    const test_folder *folder = *state;
    scene_file *file =
        load(folder, "  - shape: plane\n    name: ground\n    material: {base_color: [0.1, 0.2, 0.3], roughness: 0.25, metallic: 1, pattern: checker,\n"
                     "      pattern_color: [1, 0, 1], pattern_size: 0.5, pattern_joint: 0.125, texture: dots.png}\n"
                     "  - shape: sphere\n    material: {texture: dots.png}\n  - shape: pool\n  - shape: box\n    material: {texture: red.jpg}\n");
    const mgt_scene scene = scene_of(file);
    const mgt_material *m = &scene.objects[0].material;
    assert_true(m->base_color[0] == 0.1f && m->base_color[2] == 0.3f && m->roughness == 0.25f && m->metallic == 1);
    assert_int_equal(m->pattern, MGT_PATTERN_CHECKER);
    assert_true(m->pattern_color[0] == 1 && m->pattern_color[1] == 0 && m->pattern_size == 0.5f && m->pattern_joint == 0.125f);
    assert_non_null(m->texture);
    assert_ptr_equal(m->texture, scene.objects[1].material.texture); /* read once */
    assert_null(scene.objects[2].material.texture);
    assert_non_null(scene.objects[3].material.texture);
    scene_file_free(file);
}

static void meshes_of_every_format(void **state)
{
    const test_folder *folder = *state;
    scene_file *file = load(
        folder,
        "  - mesh: cube.obj\n    instances: [{position: [9, 0, 0]}]\n  - mesh: triangle.ply\n    scale: 3\n  - mesh: nodes.gltf\n    position: [10, 0, 0]\n"
        "  - mesh: cube.obj\n    material: {roughness: 0.9}\n");
    const mgt_scene scene = scene_of(file);
    assert_int_equal(scene.object_count, 6);
    /* OBJ: the file's own material and picture; the second use has the scene's. */
    assert_ptr_equal(scene.objects[0].mesh, scene.objects[1].mesh);
    assert_true(scene.objects[0].material.base_color[0] == 0.1f && scene.objects[0].material.base_color[2] == 0.8f);
    assert_non_null(scene.objects[0].material.texture);
    assert_true(scene.objects[5].material.roughness == 0.9f && scene.objects[5].material.texture == NULL);
    assert_true(scene.objects[1].transform[0][3] == 9);
    assert_true(scene.objects[2].transform[0][0] == 3);
    /* glTF: a node inside another. */
    assert_ptr_equal(scene.objects[3].mesh, scene.objects[4].mesh);
    assert_transform(&scene.objects[3], (const double[]){1, 0, 0, 11, 0, 1, 0, 2, 0, 0, 1, 3});
    assert_transform(&scene.objects[4], (const double[]){2, 0, 0, 11, 0, 2, 0, 2, 0, 0, 2, 3});
    const mgt_material *m = &scene.objects[3].material;
    assert_true(m->base_color[0] == 0.5f && m->base_color[1] == 0.25f && m->roughness == 0.75f && m->metallic == 0.5f);
    scene_file_free(file);
}

/* A picture that two materials name is one texture. */
static void materials_of_a_file_share_a_picture(void **state)
{
    const test_folder *folder = *state;
    put(folder, "two.obj",
        "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 2/2\nusemtl c\nf 3/1 2/2 1/3\n");
    put(folder, "two.mtl", "newmtl a\nKd 1 0 0\nmap_Kd dots.png\nnewmtl b\nKd 0 1 0\nmap_Kd red.jpg\nnewmtl c\nKd 0 0 1\nmap_Kd dots.png\n");
    scene_file *file = load(folder, "  - mesh: two.obj\n");
    const mgt_scene scene = scene_of(file);
    assert_int_equal(scene.object_count, 3);
    const mgt_texture *of_color[3] = {NULL};
    for (size_t i = 0; i < 3; i++)
        for (size_t c = 0; c < 3; c++)
            if (scene.objects[i].material.base_color[c] == 1)
                of_color[c] = scene.objects[i].material.texture;
    assert_non_null(of_color[0]);
    assert_non_null(of_color[1]);
    assert_ptr_equal(of_color[0], of_color[2]);
    assert_ptr_not_equal(of_color[0], of_color[1]);
    scene_file_free(file);
}

/* An object without a name is called after its file: at most 63 bytes of whole characters. */
static void long_names_of_files_end_with_a_whole_character(void **state)
{
    const test_folder *folder = *state;
    char name[128] = "", objects[256];
    for (int i = 0; i < 59; i++)
        strcat(name, "n");
    snprintf(objects, sizeof objects, "%s\u6d77\u6ce2.ply", name); /* the second character of three bytes crosses the end */
    put(folder, objects, triangle_ply);
    snprintf(objects, sizeof objects, "  - mesh: %s\u6d77\u6ce2.ply\n", name);
    scene_file *file = load(folder, objects);
    assert_string_equal(scene_file_object_name(file, 0), strcat(name, "\u6d77"));
    scene_file_free(file);
}

/* nodes_gltf with the scale of its second node replaced. */
static void put_scaled(const test_folder *folder, const char *name, const char *scale)
{
    char text[sizeof nodes_gltf];
    memcpy(text, nodes_gltf, sizeof text);
    memcpy(strstr(text, "[2, 2, 2]"), scale, strlen("[2, 2, 2]"));
    put(folder, name, text);
}

static void a_node_scaled_to_nothing_hides_its_meshes(void **state)
{
    const test_folder *folder = *state;
    put_scaled(folder, "hidden.gltf", "[0, 0, 0]");
    scene_file *file = load(folder, "  - mesh: hidden.gltf\n");
    const mgt_scene scene = scene_of(file);
    assert_int_equal(scene.object_count, 1);
    assert_transform(&scene.objects[0], (const double[]){1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3});
    scene_file_free(file);
}

/* Files that scripts/fetch_models puts into data/: skipped where they are not. */
static void fetched_models(void **state)
{
    const test_folder *folder = *state;
    static const char *const names[] = {"bunny.ply", "quad.gltf"};
    bool missing = false;
    for (size_t i = 0; i < COUNT(names); i++) {
        char text[512];
        snprintf(text, sizeof text, MGT_SOURCE_DIR "/data/%s", names[i]);
        if (!file_exists(text)) {
            print_message("data/%s is missing: run scripts/fetch_models\n", names[i]);
            missing = true;
            continue;
        }
        snprintf(text, sizeof text, "  - mesh: \"" MGT_SOURCE_DIR "/data/%s\"\n", names[i]);
        scene_file *file = load(folder, text);
        assert_int_equal(scene_of(file).object_count, 1);
        scene_file_free(file);
    }
    if (missing)
        skip();
}

/* ---- the render hash --------------------------------------------------------------------------------------------- */

static char *canonical_of(const test_folder *folder, const char *objects)
{
    scene_file *file = load(folder, objects);
    char *text = scene_file_canonical(file, NULL);
    assert_non_null(text);
    scene_file_free(file);
    return text;
}

static void assert_canonical(const test_folder *folder, const char *left, const char *right, bool same)
{
    char *a = canonical_of(folder, left), *b = canonical_of(folder, right);
    if ((strcmp(a, b) == 0) != same)
        fail_msg("%s\n%s\n%s\n%s", same ? "should be the same:" : "should differ:", left, right, a);
    free(a);
    free(b);
}

static void the_render_hash_knows_what_files_hold(void **state)
{
    const test_folder *folder = *state;
    assert_canonical(folder, "  - {shape: box}\n", "  - {shape: box, scale: [1, 1, 1], material: {}, name: a box, instances: []}\n", true);
    assert_canonical(folder, "  - {shape: box}\n", "  - {shape: box, triangles: 100}\n", false);
    assert_canonical(folder, "  - {shape: box}\n", "  - {shape: box, instances: [{position: [3, 0, 0]}]}\n", false);
    assert_canonical(folder, "  - {mesh: cube.obj}\n", "  - {mesh: ./cube.obj, shape: mesh}\n", true);
    assert_canonical(folder, "  - {mesh: cube.obj}\n", "  - {mesh: cube.obj, material: {}}\n", false);
    assert_canonical(folder, "  []\nwater: {clarity: clear}\n", "  []\nwater: {clarity: murky}\n", false);
    assert_canonical(folder, "  []\nwater: {amplitude: 2, waves: [{amplitude: 1, a: 1, b: 1, c: 1}]}\n",
                     "  []\nwater: {waves: [{amplitude: 2, a: 1, b: 1, c: 1}]}\n", true);
    /* Other bytes under the same name. */
    static const struct {
        const char *objects, *name, *text;
    } changes[] = {
        {"  - {mesh: triangle.ply}\n", "triangle.ply", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2"},
        {"  - {mesh: nodes.gltf}\n", "nodes.gltf", "\"translation\": [1, 2, 3]"},
        {"  - {mesh: nodes.gltf}\n", "nodes.gltf", "\"roughnessFactor\": 0.75"},
    };
    for (size_t i = 0; i < COUNT(changes); i++) {
        char path[512];
        size_t size;
        char *before = canonical_of(folder, changes[i].objects);
        unsigned char *bytes = file_bytes(in_folder(folder, changes[i].name, path), &size);
        char *at = strstr((char *)bytes, changes[i].text);
        assert_non_null(at);
        char *digit = strpbrk(at, "1");
        digit = digit != NULL && digit < at + strlen(changes[i].text) ? digit : strpbrk(at, "7");
        const char old = *digit;
        *digit = '5';
        write_bytes(path, bytes, size);
        char *after = canonical_of(folder, changes[i].objects);
        assert_string_not_equal(before, after);
        *digit = old;
        write_bytes(path, bytes, size);
        free(before);
        free(after);
        free(bytes);
    }
    char *before = canonical_of(folder, "  - {shape: box, material: {texture: dots.png}}\n"), path[512];
    file_error error;
    assert_int_equal(picture_write_png(in_folder(folder, "dots.png", path), 1, 1, (const uint8_t[]){1, 2, 3, 255}, 0, NULL,
                                       &(output_options){.overwrite = true}, &error),
                     FILE_OK);
    char *after = canonical_of(folder, "  - {shape: box, material: {texture: dots.png}}\n");
    assert_string_not_equal(before, after);
    put_dots(folder);
    free(before);
    free(after);
}

/* ---- programs that edit -------------------------------------------------------------------------------------------- */

static void copies_share_models_and_write_the_same_scene(void **state)
{
    const test_folder *folder = *state;
    char *text = NULL;
    size_t size = 0;
    scene_file *file = load(folder, "  - {mesh: nodes.gltf, material: {}, instances: [{position: [1, 0, 0]}, {scale: [1, 2, 3]}]}\n"
                                    "  - {name: \"a \\\"pool\\\"\", shape: pool, size: [5, 1, 5], material: {pattern: tiles, texture: dots.png}}\n"
                                    "water: {level: 3, clarity: coastal, amplitude: 0.5, waves: [{amplitude: 1, a: 1, b: 1, c: 1}]}\n");
    scene_values values;
    assert_true(scene_values_copy(&values, scene_file_values(file)));
    assert_ptr_equal(values.models, scene_file_values(file)->models);
    assert_true(scene_values_fix_files(&values, scene_file_path(file)));
    scene_values_write_out_sea(&values);
    char *expected = scene_file_canonical(file, NULL);
    scene_file_free(file); /* the copy goes on alone */
    mgt_scene scene;
    assert_true(scene_values_shot(&values, 0, &scene));
    assert_int_equal(scene.object_count, 7);
    FILE *stream = open_memstream(&text, &size);
    assert_true(scene_values_write(stream, &values));
    fclose(stream);
    scene_error error;
    /* Read from elsewhere, with the models there already and anew. */
    for (int like = 0; like < 2; like++) {
        scene_file *again = scene_file_parse_like(like ? &values : NULL, text, size, "/elsewhere/t.yaml", NULL, 0, &error);
        if (again == NULL)
            fail_msg("%s\n%s", error.text, text);
        char *found = scene_file_canonical(again, NULL);
        assert_string_equal(found, expected);
        mgt_scene other;
        assert_true(scene_file_frame(again, 0, &other) && other.object_count == scene.object_count);
        for (size_t i = 0; i < scene.object_count; i++) {
            assert_int_equal(like != 0, other.objects[i].mesh == scene.objects[i].mesh);
            assert_int_equal(like != 0 || scene.objects[i].material.texture == NULL, other.objects[i].material.texture == scene.objects[i].material.texture);
        }
        free(found);
        scene_file_free(again);
    }
    free(expected);
    free(text);
    scene_values_free(&values);
}

/* ---- errors -------------------------------------------------------------------------------------------------------- */

static void errors_say_what_where_and_what_is_allowed(void **state)
{
    const test_folder *folder = *state;
    put(folder, "empty.ply", "");
    put(folder, "garbage.glb", "\x01\x02\x03 this is no mesh");
    put(folder, "cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n");
    put(folder, "points.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n");
    put(folder, "flat.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
    put(folder, "nan.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n");
    put(folder, "far.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1e9 0 0\n0 1 0\n3 0 1 2\n");
    put(folder, "index.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 99999\n");
    char nobin[sizeof nodes_gltf];
    memcpy(nobin, nodes_gltf, sizeof nobin);
    strcpy(strstr(nobin, "data:"), "nobin.bin\"}]}\n");
    put(folder, "nobin.gltf", nobin);
    put(folder, "cycle.gltf",
        "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"children\": [1]}, {\"children\": [0]}]}");
    put_scaled(folder, "flat.gltf", "[2, 0, 2]");
    put(folder, "flatten.gltf", "{\"asset\": {\"version\": \"2.0\"}}");
    put(folder, "jpeg.png", "\xff\xd8\xff\xe0 JFIF and so on, for as long as such files are");
    put(folder, "gif.png", "GIF89a and so on, for as long as such files are");
    put(folder, "nan.pfm", "Pf\n2 1\n-1.0\n12345678");
    char fifo[512];
    assert_int_equal(mkfifo(in_folder(folder, "pipe.ply", fifo), 0600), 0);
    assert_int_equal(mkfifo(in_folder(folder, "pipe.png", fifo), 0600), 0);
    static const struct {
        const char *objects;
        scene_error_kind kind;
        const char *message; /* a part; before it stands the folder */
    } cases[] = {
        {"  - {}\n", SCENE_ERROR_BAD_SCENE,
         "/s.yaml:3:5: objects[0].mesh and shape are missing; allowed: the path of a .gltf, .glb, .obj or .ply file, or a shape"},
        {"  - {mesh: cube.obj, shape: box}\n", SCENE_ERROR_BAD_SCENE, "/s.yaml:3:6: objects[0].mesh stands beside a shape; allowed: one of them"},
        {"  - {shape: cone}\n", SCENE_ERROR_BAD_SCENE, "/s.yaml:3:13: objects[0].shape is cone; allowed: one of mesh, plane, box, sphere, steps, pool, floor"},
        {"  - {shape: box, rim_width: 1}\n", SCENE_ERROR_BAD_SCENE, "/s.yaml:3:18: objects[0].rim_width is of a pool; allowed: with shape: pool"},
        {"  - {shape: plane, dry: true}\n", SCENE_ERROR_BAD_SCENE,
         "/s.yaml:3:20: objects[0].dry is of hulls, which hold water back; allowed: not with a plane or a floor"},
        {"  - {shape: box, dry: wet}\n", SCENE_ERROR_BAD_SCENE, "objects[0].dry is wet; allowed: one of false, true"},
        {"  - {shape: box, heights: a.png}\n", SCENE_ERROR_BAD_SCENE, "objects[0].heights is of a floor; allowed: with shape: floor"},
        {"  - {shape: pool, count: 3}\n", SCENE_ERROR_BAD_SCENE, "objects[0].count is a number of steps; allowed: with shape: steps"},
        {"  - {mesh: cube.obj, size: [1, 1, 1]}\n", SCENE_ERROR_BAD_SCENE, "objects[0].size is for shapes; allowed: with a mesh, scale"},
        {"  - {shape: floor}\n", SCENE_ERROR_BAD_SCENE, "objects[0].heights is missing; allowed: the path of a grey PNG or a PFM, from the scene's folder"},
        {"  - {shape: box, scale: 0}\n", SCENE_ERROR_BAD_SCENE,
         "/s.yaml:3:25: objects[0].scale is 0; allowed: a number, or a list of 3 numbers [x, y, z], each 1e-6 to 1e6"},
        {"  - {shape: box, scale: [1, 2]}\n", SCENE_ERROR_BAD_SCENE,
         "objects[0].scale is a list of 2; allowed: a number, or a list of 3 numbers [x, y, z], each 1e-6 to 1e6"},
        {"  - {shape: box, material: {roughness: 0}}\n", SCENE_ERROR_BAD_SCENE, "objects[0].material.roughness is 0; allowed: a number, 0.02 to 1"},
        {"  - {shape: box, instances: [{positon: [0, 0, 0]}]}\n", SCENE_ERROR_BAD_SCENE,
         "unknown key \"positon\" in objects[0].instances[0]; did you mean \"position\"? allowed: position, rotation_deg, scale"},
        {"  - {shape: box, size: [1e5, 1, 1], scale: 1e3}\n", SCENE_ERROR_BAD_SCENE,
         "/s.yaml:3:5: objects[0] reaches as far as 5e+07 m; allowed: 2e6 m from the origin"},
        {"  - {mesh: nowhere.ply}\n", SCENE_ERROR_MISSING_INPUT, "/s.yaml:3:12: objects[0].mesh: "},
        {"  - {mesh: nowhere.ply}\n", SCENE_ERROR_MISSING_INPUT, "/nowhere.ply: No such file or directory ("},
        {"  - {mesh: .}\n", SCENE_ERROR_BAD_SCENE, "has another extension; allowed: "},
        {"  - {mesh: s.yaml}\n", SCENE_ERROR_BAD_SCENE, "/s.yaml: has another extension; allowed: "},
        {"  - {mesh: pipe.ply}\n", SCENE_ERROR_MISSING_INPUT, "/pipe.ply: is no regular file; allowed: "},
        {"  - {mesh: empty.ply}\n", SCENE_ERROR_BAD_SCENE, "/empty.ply:1:1: does not begin with \"ply\"; allowed: "},
        {"  - {mesh: garbage.glb}\n", SCENE_ERROR_BAD_SCENE, "/garbage.glb: is not binary glTF; allowed: "},
        {"  - {mesh: cut.ply}\n", SCENE_ERROR_BAD_SCENE, "/cut.ply:5:1: ends in its header; allowed: "},
        {"  - {mesh: points.ply}\n", SCENE_ERROR_BAD_SCENE, "/points.ply:10:5: holds no triangles; allowed: "},
        {"  - {mesh: flat.ply}\n", SCENE_ERROR_BAD_SCENE, "/flat.ply: none of the mesh's 1 triangles has an area"},
        {"  - {mesh: nan.ply}\n", SCENE_ERROR_BAD_SCENE, "/nan.ply: vertex 1 lies at nan"},
        {"  - {mesh: far.ply}\n", SCENE_ERROR_BAD_SCENE, "/far.ply: vertex 1 lies at 1e+09; allowed is -1e6 to 1e6 m"},
        {"  - {mesh: index.ply}\n", SCENE_ERROR_BAD_SCENE, "/index.ply:13:7: a face refers to a vertex that does not exist; allowed: "},
        {"  - {mesh: nobin.gltf}\n", SCENE_ERROR_BAD_SCENE, "/nobin.bin, which cannot be read; allowed: a file beside"},
        {"  - {mesh: cycle.gltf}\n", SCENE_ERROR_BAD_SCENE, "/cycle.gltf:1:81: nodes[0] is nested deeper than 256 nodes, or in a circle; allowed: "},
        {"  - {mesh: flatten.gltf}\n", SCENE_ERROR_BAD_SCENE, "/flatten.gltf: "},
        {"  - {mesh: flat.gltf}\n", SCENE_ERROR_BAD_SCENE,
         "/s.yaml:3:5: objects[0] flattens a part of its mesh: with the scales of the file's nodes it has no volume left; allowed: scales other than 0"},
        {"  - {shape: box, material: {texture: nowhere.png}}\n", SCENE_ERROR_MISSING_INPUT, "/s.yaml:3:38: objects[0].material.texture: "},
        {"  - {shape: box, material: {texture: jpeg.png}}\n", SCENE_ERROR_BAD_SCENE,
         "/jpeg.png: is not a sound JPEG; allowed: a PNG or JPEG picture of at most 16384 x 16384 pixels"},
        {"  - {shape: box, material: {texture: gif.png}}\n", SCENE_ERROR_BAD_SCENE, "/gif.png: is neither PNG nor JPEG; allowed: a PNG or JPEG"},
        {"  - {shape: box, material: {texture: pipe.png}}\n", SCENE_ERROR_MISSING_INPUT, "/pipe.png: is no regular file; allowed: "},
        {"  - {shape: floor, heights: nowhere.png}\n", SCENE_ERROR_MISSING_INPUT, "/s.yaml:3:29: objects[0].heights: "},
        {"  - {shape: floor, heights: dots.png}\n", SCENE_ERROR_BAD_SCENE,
         "/dots.png: has colours or an alpha channel; allowed: a grey PNG or PFM of at least 2 x 2 pixels"},
        {"  - {shape: floor, heights: nan.pfm}\n", SCENE_ERROR_BAD_SCENE, "/nan.pfm: is too small; allowed: a grey PNG or PFM of at least 2 x 2 pixels"},
        {"  - {shape: sphere, triangles: 4194304, instances: [{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}]}\n", SCENE_ERROR_BAD_SCENE,
         "allowed: at most 65536 of 67108864"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        scene_error error;
        scene_file *file = try_load(folder, cases[i].objects, &error);
        if (file != NULL) {
            scene_file_free(file);
            fail_msg("accepted: %s", cases[i].objects);
        }
        if (error.kind != cases[i].kind || strstr(error.text, cases[i].message) == NULL)
            fail_msg("kind %d: %s\n  expected kind %d: …%s", (int)error.kind, error.text, (int)cases[i].kind, cases[i].message);
        assert_null(strchr(error.text, '\n'));
        assert_null(try_load(folder, cases[i].objects, NULL));
    }
}

/* Whatever is cut off or changed in a mesh's file: it loads, or there is one line. */
static void damaged_meshes_do_no_harm(void **state)
{
    const test_folder *folder = *state;
    static const struct {
        const char *name, *text;
    } files[] = {{"d.obj", cube_obj}, {"d.ply", triangle_ply}, {"d.gltf", nodes_gltf}};
    uint32_t random = 7;
    for (size_t f = 0; f < COUNT(files); f++)
        for (int round = 0; round < 150; round++) {
            char path[512], objects[64], text[2048];
            size_t length = strlen(files[f].text);
            memcpy(text, files[f].text, length);
            if (round % 3 == 0)
                length = test_random(&random) % length;
            for (int k = 0; k < round % 5 && length > 0; k++)
                text[test_random(&random) % length] = (char)(test_random(&random) % 3 == 0 ? test_random(&random) : 32 + test_random(&random) % 95);
            write_bytes(in_folder(folder, files[f].name, path), text, length);
            snprintf(objects, sizeof objects, "  - mesh: %s\n", files[f].name);
            scene_error error;
            scene_file *file = try_load(folder, objects, &error);
            if (file == NULL)
                assert_true(strlen(error.text) > 10 && strchr(error.text, '\n') == NULL);
            scene_file_free(file);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(water_keys_are_read, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(places_are_scaled_turned_and_moved, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(materials_are_read, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(meshes_of_every_format, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(materials_of_a_file_share_a_picture, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(long_names_of_files_end_with_a_whole_character, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(a_node_scaled_to_nothing_hides_its_meshes, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(fetched_models, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(the_render_hash_knows_what_files_hold, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(copies_share_models_and_write_the_same_scene, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(errors_say_what_where_and_what_is_allowed, files_setup, folder_teardown),
        cmocka_unit_test_setup_teardown(damaged_meshes_do_no_harm, files_setup, folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
