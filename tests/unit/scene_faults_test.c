/* SPDX-License-Identifier: MIT
 *
 * Every allocation of a scene's life fails once, where scenes are read, copied, written and made into text for hashes: memory is said to be short, nothing
 * leaks, and the scene loads afterwards. The linker hands malloc, calloc, realloc and free of our own code to the functions below (--wrap).
 */
#include "image_test_folder.h"

#include "image/picture.h"
#include "scene/scene_edit.h"
#include "unit/wrapped_memory.h"

enum { LIVE = 1 << 14 };

/* Blocks of our own code that are in use. */
static struct {
    long calls, fail_at; /* fail_at: number of the call that fails, from 1; 0: none */
    void *live[LIVE];
    size_t count;
} heap;

static void *noted(void *memory)
{
    if (memory != NULL && heap.count < LIVE)
        heap.live[heap.count++] = memory;
    return memory;
}

static void forget(const void *memory)
{
    for (size_t i = heap.count; i-- > 0;)
        if (heap.live[i] == memory) {
            heap.live[i] = heap.live[--heap.count];
            return;
        }
}

void *__wrap_malloc(size_t size) { return ++heap.calls == heap.fail_at ? NULL : noted(__real_malloc(size)); }

void *__wrap_calloc(size_t count, size_t size) { return ++heap.calls == heap.fail_at ? NULL : noted(__real_calloc(count, size)); }

void *__wrap_realloc(void *memory, size_t size)
{
    if (++heap.calls == heap.fail_at)
        return NULL;
    forget(memory);
    return noted(__real_realloc(memory, size));
}

void __wrap_free(void *memory)
{
    forget(memory);
    __real_free(memory);
}

static void put(const test_folder *folder, const char *name, const char *text)
{
    char path[512];
    write_bytes(in_folder(folder, name, path), text, strlen(text));
}

static int setup(void **state)
{
    if (folder_setup(state) != 0)
        return -1;
    const test_folder *folder = *state;
    char path[512];
    file_error error;
    static const uint8_t pixels[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255};
    put(folder, "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    put(folder, "a.gltf",
        "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0}],\n"
        "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"material\": 0}]}],\n"
        "\"materials\": [{\"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": 0}}}], \"textures\": [{\"source\": 0}], \"images\": [{\"uri\": \"a.png\"}],\n"
        "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\"}], \"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}],\n"
        "\"buffers\": [{\"byteLength\": 36, \"uri\": \"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}\n");
    put(folder, "b.txt", "0.1 0 1\n0.1 90 2\n0.1 180 1\n0.2 0 1\n0.2 120 1\n0.2 240 1\n");
    put(folder, "s.yaml",
        "mangata: 1\ndescription: all that is read\ncamera: {path: [{time: 0, position: [0, 3, 0], target: [0, 2, -5]}, {time: 1, position: [0, 4, 0], target: [0, 2, -5]}]}\n"
        "water: {wind: {speed: 6, count: 24}, swell: [{height: 0.5, period: 9}]}\n"
        "objects:\n  - {mesh: a.ply, material: {texture: a.png}, instances: [{}, {position: [1, 0, 0]}]}\n  - {shape: plane}\n  - {mesh: a.gltf}\n"
        "  - {shape: sphere, triangles: 40}\n");
    put(folder, "t.yaml", "mangata: 1\nwater: {spectrum: {model: buoy, file: b.txt, count: 8}}\n");
    return picture_write_png(in_folder(folder, "a.png", path), 2, 2, pixels, 0, NULL, &(output_options){.overwrite = true}, &error) == FILE_OK ? 0 : -1;
}

/* Loads, changes, copies and writes a scene. False if an allocation failed, which must then be the reported error. */
static bool live(const char *path)
{
    static const char *const words[] = {"light.elevation_deg=12", "objects[1]={shape: box}"};
    scene_error error;
    scene_overrides changes = {0};
    scene_values values = {0};
    char *text = NULL, *canonical = NULL;
    size_t size = 0;
    scene_file *file = scene_file_load(path, words, strstr(path, "s.yaml") != NULL ? 2 : 1, &error);
    if (file == NULL) {
        if (error.kind != SCENE_ERROR_MEMORY)
            fail_msg("call %ld: %s", heap.fail_at, error.text);
        return false;
    }
    bool good =
        (canonical = scene_file_canonical(file, NULL)) != NULL && scene_values_copy(&values, scene_file_values(file)) && scene_values_fix_files(&values, path);
    if (good) {
        scene_values_write_out_sea(&values);
        FILE *stream = open_memstream(&text, &size);
        good = stream != NULL && scene_values_write(stream, &values);
        good = stream != NULL && fclose(stream) == 0 && good;
    }
    if (good) {
        scene_file *again = scene_file_parse(text, size, "again.yaml", NULL, 0, &error);
        good = again != NULL && scene_overrides_between(scene_file_values(file), scene_file_values(again), &changes);
        if (again == NULL && error.kind != SCENE_ERROR_MEMORY)
            fail_msg("call %ld: %s", heap.fail_at, error.text);
        scene_file_free(again);
    }
    scene_overrides_free(&changes);
    scene_values_free(&values);
    scene_file_free(file);
    free(canonical);
    free(text);
    return good;
}

static void every_allocation_fails_once(void **state)
{
    const test_folder *folder = *state;
    static const char *const names[] = {"s.yaml", "t.yaml"};
    for (int i = 0; i < 2; i++) {
        char path[512];
        in_folder(folder, names[i], path);
        const size_t before = heap.count;
        heap.calls = heap.fail_at = 0;
        assert_true(live(path));
        assert_int_equal(heap.count, before);
        const long calls = heap.calls;
        long harmless = 0;
        for (long at = 1; at <= calls; at += MGT_SANITIZED ? 5 : 1) {
            heap.calls = 0;
            heap.fail_at = at;
            harmless += live(path);
            heap.fail_at = 0;
            if (heap.count != before)
                fail_msg("%s: allocation %ld of %ld fails: %zu blocks are left", names[i], at, calls, heap.count - before);
        }
        assert_true(live(path));
        print_message("  %s: %ld allocations, which failed one at a time, %ld of them without harm\n", names[i], calls, harmless);
        assert_true(harmless * 10 < calls);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(every_allocation_fails_once, setup, folder_teardown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
