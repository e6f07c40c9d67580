/* SPDX-License-Identifier: MIT
 * A program that was built against the first version of every struct runs on this library. Its structs are no larger than they were then, and what
 * follows them in memory is its own. */
#include <assert.h>

#include "api_sea.h"

/* Bytes of the first versions where a pointer has 8. */
enum { CONTEXT_DESC = 64, CONTEXT_INFO = 160, MESH_DESC = 48, TEXTURE_DESC = 32, SCENE = 592, TARGET = 32, PIXEL_INFO = 256, CANARY = 64 };

/* Members of the first versions stay where they were. */
#define STAYS(type, member, bytes) static_assert(sizeof(void *) != 8 || offsetof(type, member) == (bytes), #type "." #member " has moved")
STAYS(mgt_context_desc, gl_get_proc, 56);
STAYS(mgt_context_info, software, 152);
STAYS(mgt_mesh_desc, indices, 40);
STAYS(mgt_texture_desc, row_stride, 24);
STAYS(mgt_scene, camera_moves, 192);
STAYS(mgt_scene, light, 224);
STAYS(mgt_scene, objects, 392);
STAYS(mgt_scene, quality.sample_slots, 584);
STAYS(mgt_target, row_stride, 24);
STAYS(mgt_pixel_info, filtered, 248);

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

/* `count` structs of `size` bytes, then bytes that nobody may touch. */
static void *structs(size_t size, size_t count)
{
    unsigned char *memory = malloc(count * size + CANARY);
    assert_non_null(memory);
    memset(memory, 0x5a, count * size + CANARY);
    return memory;
}

static void free_structs(void *memory, size_t size, size_t count)
{
    const unsigned char *bytes = memory;
    for (size_t i = 0; i < CANARY; i++)
        assert_int_equal(bytes[count * size + i], 0x5a);
    free(memory);
}

static mgt_context *old_context(void)
{
    mgt_context_desc *desc = structs(CONTEXT_DESC, 1);
    mgt_context_desc_init(desc, CONTEXT_DESC);
    desc->threads = 1;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, desc), MGT_OK);
    free_structs(desc, CONTEXT_DESC, 1);
    return context;
}

/* The sea over a triangle with a texture, in one picture of colour and one of coverage. */
static void draw(mgt_context *context, mgt_scene *scene, size_t target_size, mgt_mesh_desc *mesh_desc, mgt_texture_desc *texture_desc, float *color,
                 float *coverage)
{
    static const float corners[] = {-9, -1, 2, 9, -1, 2, 0, -1.5f, -20};
    static const uint32_t indices[] = {0, 1, 2};
    static const uint8_t texels[] = {200, 90, 30, 255};
    mesh_desc->positions = corners;
    mesh_desc->vertex_count = 3;
    mesh_desc->triangle_count = 1;
    mesh_desc->indices = indices;
    texture_desc->width = texture_desc->height = 1;
    texture_desc->pixels = texels;
    mgt_mesh *mesh = NULL;
    mgt_texture *texture = NULL;
    assert_int_equal(mgt_mesh_create(&mesh, mesh_desc), MGT_OK);
    assert_int_equal(mgt_texture_create(&texture, texture_desc), MGT_OK);
    const mgt_object object = {.mesh = mesh, .transform = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, .material = {.roughness = 0.5f, .texture = texture}};
    scene->objects = &object;
    scene->object_count = 1;
    char *targets = structs(target_size, 2);
    for (int i = 0; i < 2; i++) {
        mgt_target *target = (mgt_target *)(void *)(targets + (size_t)i * target_size);
        mgt_target_init(target, target_size);
        target->layer = i ? MGT_LAYER_COVERAGE : MGT_LAYER_COLOR;
        target->format = i ? MGT_FORMAT_R32F : MGT_FORMAT_RGB32F;
        target->pixels = i ? coverage : color;
    }
    sea_render(context, scene, (const mgt_target *)(void *)targets, 2);
    free_structs(targets, target_size, 2);
    scene->objects = NULL;
    scene->object_count = 0;
    mgt_mesh_destroy(mesh);
    mgt_texture_destroy(texture);
}

static void old_callers_get_the_same_bytes(void **state)
{
    (void)state;
    static float color[2][3 * PIXELS], coverage[2][PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_context *context = old_context();
    for (mgt_method method = MGT_METHOD_NONE; method <= MGT_METHOD_MANGATA; method++) {
        mgt_scene scene = sea_scene(waves);
        mgt_mesh_desc mesh;
        mgt_texture_desc texture;
        mgt_mesh_desc_init(&mesh, sizeof mesh);
        mgt_texture_desc_init(&texture, sizeof texture);
        scene.quality.method = method;
        draw(context, &scene, sizeof(mgt_target), &mesh, &texture, color[0], coverage[0]);

        mgt_scene *old = structs(SCENE, 1);
        mgt_mesh_desc *old_mesh = structs(MESH_DESC, 1);
        mgt_texture_desc *old_texture = structs(TEXTURE_DESC, 1);
        mgt_scene_init(old, SCENE);
        memcpy((char *)old + sizeof(size_t), (const char *)&scene + sizeof(size_t), SCENE - sizeof(size_t));
        mgt_mesh_desc_init(old_mesh, MESH_DESC);
        mgt_texture_desc_init(old_texture, TEXTURE_DESC);
        draw(context, old, TARGET, old_mesh, old_texture, color[1], coverage[1]);
        assert_memory_equal(color[0], color[1], sizeof *color);
        assert_memory_equal(coverage[0], coverage[1], sizeof *coverage);
        free_structs(old, SCENE, 1);
        free_structs(old_mesh, MESH_DESC, 1);
        free_structs(old_texture, TEXTURE_DESC, 1);
    }
    mgt_context_destroy(context);
}

static void what_is_filled_keeps_within_the_size(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    mgt_context *context = old_context();
    mgt_context_info *info = structs(CONTEXT_INFO, 1), all = {.struct_size = sizeof all};
    info->struct_size = CONTEXT_INFO;
    assert_int_equal(mgt_context_get_info(context, info), MGT_OK);
    assert_int_equal(mgt_context_get_info(context, &all), MGT_OK);
    assert_true(info->struct_size == CONTEXT_INFO && info->lanes == all.lanes && info->threads == 1);
    free_structs(info, CONTEXT_INFO, 1);
    mgt_pixel_info *pixel = structs(PIXEL_INFO, 1), whole = {.struct_size = sizeof whole};
    pixel->struct_size = PIXEL_INFO;
    assert_int_equal(mgt_inspect_pixel(context, &scene, 40, 40, pixel), MGT_OK);
    assert_int_equal(mgt_inspect_pixel(context, &scene, 40, 40, &whole), MGT_OK);
    assert_true(pixel->struct_size == PIXEL_INFO && pixel->water > 0);
    assert_memory_equal(pixel->radiance, whole.radiance, sizeof whole.radiance);
    assert_int_equal(pixel->resolved + pixel->mixed + pixel->filtered, SEA_WAVES);
    free_structs(pixel, PIXEL_INFO, 1);
    mgt_context_destroy(context);
}

/* Smaller than any version, and later members that are set: refused, and the error says what was found. */
static void sizes_of_no_version_are_refused(void **state)
{
    (void)state;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *context = old_context();
    scene.struct_size = SCENE - 8;
    assert_int_equal(mgt_scene_check(context, &scene), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(context), "mgt_scene 0: struct_size is 584; this library knows 592 to"));
    mgt_context_info info = {.struct_size = CONTEXT_INFO - 8};
    assert_int_equal(mgt_context_get_info(context, &info), MGT_ERROR_ARGUMENT);
    mgt_context_destroy(context);

    struct {
        mgt_context_desc desc;
        uint64_t later[32];
    } newer;
    mgt_context_desc_init(&newer.desc, sizeof newer);
    assert_int_equal(mgt_context_create(&context, &newer.desc), MGT_OK);
    mgt_context_destroy(context);
    newer.later[31] = 1;
    assert_int_equal(mgt_context_create(&context, &newer.desc), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(NULL), "a member that this library does not know is set"));
    assert_null(context);
}

int main(void)
{
    if (sizeof(void *) != 8)
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(old_callers_get_the_same_bytes),
        cmocka_unit_test(what_is_filled_keeps_within_the_size),
        cmocka_unit_test(sizes_of_no_version_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
