/* SPDX-License-Identifier: MIT
 *
 * Scenes with objects on OpenGL: beside the CPU, in parts, and in textures of a host.
 */
#include "gl_sea.h"

#include "mangata/gl.h"
#include "trace/trace.h"
#include "unit/test_mesh.h"

enum { SIDE = 8, TEXTURE_SIDE = 16 };

/* ---- a box, half of it under water, in front of the camera, and a floor under it ---- */

typedef struct props {
    mgt_mesh *box, *floor;
    mgt_texture *texture;
    mgt_object objects[2];
} props;

static mgt_texture *checks(void)
{
    static uint8_t pixels[4 * TEXTURE_SIDE * TEXTURE_SIDE];
    for (int i = 0; i < TEXTURE_SIDE * TEXTURE_SIDE; i++)
        for (int k = 0; k < 3; k++)
            pixels[4 * i + k] = (uint8_t)((i / TEXTURE_SIDE / 4 + i % TEXTURE_SIDE / 4) % 2 ? 230 - 60 * k : 40 + 20 * k);
    mgt_texture_desc desc;
    mgt_texture_desc_init(&desc, sizeof desc);
    desc.width = desc.height = TEXTURE_SIDE;
    desc.pixels = pixels;
    mgt_texture *texture = NULL;
    assert_int_equal(mgt_texture_create(&texture, &desc), MGT_OK);
    return texture;
}

static mgt_material material_of(float r, float g, float b) { return (mgt_material){.base_color = {r, g, b}, .roughness = 0.5f, .pattern_size = 1}; }

static props make_props(void)
{
    static const float corners[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
    static const uint32_t sides[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 0, 4, 7, 0, 7, 3};
    static float floor_points[3 * (SIDE + 1) * (SIDE + 1)], places[2 * (SIDE + 1) * (SIDE + 1)];
    static uint32_t cells[6 * SIDE * SIDE];
    for (int i = 0; i < (SIDE + 1) * (SIDE + 1); i++) {
        places[2 * i] = (float)(i % (SIDE + 1)) / 2;
        places[2 * i + 1] = (float)(i / (SIDE + 1)) / 2;
        floor_points[3 * i] = 3 * (places[2 * i] - SIDE / 4.0f);
        floor_points[3 * i + 2] = 3 * (places[2 * i + 1] - SIDE / 4.0f);
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE, cell[6] = {a, a + SIDE + 1, a + 1, a + 1, a + SIDE + 1, a + SIDE + 2};
        memcpy(cells + 6 * i, cell, sizeof cell);
    }
    props p = {.box = test_mesh(corners, NULL, 8, sides, 12), .texture = checks()};
    p.floor = test_mesh(floor_points, places, (SIDE + 1) * (SIDE + 1), cells, 2 * SIDE * SIDE);
    p.objects[0] =
        (mgt_object){.mesh = p.box, .transform = {{0.5, 0, 0.2, 0.3}, {0, 0.7, 0, 0}, {-0.2, 0, 0.5, -4}}, .material = material_of(0.8f, 0.3f, 0.2f)};
    p.objects[1] = (mgt_object){.mesh = p.floor, .transform = {{1, 0, 0, 0}, {0, 1, 0, -1.2}, {0, 0, 1, -4}}, .material = material_of(1, 1, 1)};
    p.objects[1].material.texture = p.texture;
    return p;
}

static void free_props(props *p)
{
    mgt_mesh_destroy(p->box);
    mgt_mesh_destroy(p->floor);
    mgt_texture_destroy(p->texture);
}

static mgt_scene scene_of(const props *p, mgt_wave waves[SEA_WAVES], bool under)
{
    mgt_scene scene = sea_scene(waves);
    for (size_t i = 0; i < scene.water.wave_count; i++)
        waves[i].amplitude *= 0.2;
    scene.objects = p->objects;
    scene.object_count = 2;
    const double position[3] = {0, under ? -0.8 : 1.6, 0}, target[3] = {0.2, under ? -0.2 : -0.2, -4};
    memcpy(scene.camera.position, position, sizeof position);
    memcpy(scene.camera.target, target, sizeof target);
    scene.camera_open = scene.camera;
    scene.camera_open.position[0] = -0.02;
    scene.frame_interval = 0.01;
    return scene;
}

/* ---- layers ---- */

/* Ways to refract and methods; cameras above and under the water, at rest and moving. */
static void objects_are_those_of_the_cpu(void **state)
{
    (void)state;
    static layers expected, got;
    mgt_wave waves[SEA_WAVES];
    props p = make_props();
    mgt_context *gl = gl_context(), *cpu = sea_context(2, MGT_ISA_AUTO);
    static const struct {
        mgt_method method;
        mgt_refraction refraction;
        uint32_t places;
        bool caustics;
    } ways[] = {
        {MGT_METHOD_MANGATA, MGT_REFRACTION_TWO_PHASE, 1, true}, {MGT_METHOD_MANGATA, MGT_REFRACTION_TWO_PHASE, 2, false},
        {MGT_METHOD_MANGATA, MGT_REFRACTION_HYBRID, 1, false},   {MGT_METHOD_NONE, MGT_REFRACTION_HYBRID, 2, false},
        {MGT_METHOD_NONE, MGT_REFRACTION_BROAD, 1, false},       {MGT_METHOD_PODEE_PIXEL, MGT_REFRACTION_OFF, 1, false},
        {MGT_METHOD_BRUNETON, MGT_REFRACTION_NARROW, 1, false},  {MGT_METHOD_TNDF, MGT_REFRACTION_SCREEN_SPACE, 1, false},
    };
    for (int i = MGT_SANITIZED; i < 4 - MGT_SANITIZED; i++)
        for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
            if (ways[k].refraction == MGT_REFRACTION_HYBRID && !trace_available())
                continue;
            mgt_scene scene = scene_of(&p, waves, i & 1);
            scene.camera_moves = i >> 1;
            scene.quality.method = ways[k].method;
            scene.quality.refraction = ways[k].refraction;
            scene.quality.refraction_samples = ways[k].places;
            scene.quality.caustics = ways[k].caustics;
            scene.quality.tess_error = 0.01; /* both split triangles in ways of their own */
            render_all(cpu, &scene, &expected);
            render_all(gl, &scene, &got);
            char name[64];
            snprintf(name, sizeof name, "%s, %s, way %zu: color", i & 1 ? "under" : "above", i >> 1 ? "moving" : "still", k);
            expect_same(name, got.color, expected.color, PIXELS * 3, 2e-2);
            expect_same("coverage", got.coverage, expected.coverage, PIXELS, 5e-3);
            expect_same("mask", got.mask, expected.mask, PIXELS, 1e-3);
            expect_same("depth", got.depth, expected.depth, PIXELS, 2e-3);
            expect_same("normal", got.normal, expected.normal, PIXELS * 3, 5e-3);
            if (scene.camera_moves)
                continue;
            expect_same("refraction", got.refraction, expected.refraction, PIXELS * 3, 2e-2);
            expect_same("refraction_error", got.error, expected.error, PIXELS, 5e-2);
        }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
    free_props(&p);
}

/* ---- horizons ---- */

/* Under water the far water of a camera that rests or tilts. Above, a box far away that the water mirrors through air. */
static void horizons_are_those_of_the_cpu(void **state)
{
    (void)state;
    static layers expected, got;
    mgt_wave waves[SEA_WAVES];
    props p = make_props();
    mgt_context *gl = gl_context(), *cpu = sea_context(2, MGT_ISA_AUTO);
    for (int i = 0; i < 3; i++) {
        const bool under = i < 2;
        mgt_scene scene = scene_of(&p, waves, under);
        scene.camera.target[0] = 0;
        scene.camera.target[1] = scene.camera.position[1];
        scene.camera_open = scene.camera;
        scene.camera_open.target[1] += 0.4;
        scene.camera_moves = i == 1;
        scene.object_count = under ? 0 : 1;
        mgt_object far = p.objects[0];
        far.transform[0][0] = 400, far.transform[0][2] = 0, far.transform[0][3] = 0;
        far.transform[1][1] = 200;
        far.transform[2][0] = 0, far.transform[2][3] = -3000;
        scene.objects = &far;
        if (!under) {
            scene.sky.model = MGT_SKY_ATMOSPHERE;
            scene.sky.turbidity = 6;
            scene.aerial = true;
            scene.camera.fov_y_deg = 12;
        }
        render_all(cpu, &scene, &expected);
        render_all(gl, &scene, &got);
        expect_same(i == 0 ? "under water, still" : i == 1 ? "under water, moving" : "mirrored through air", got.color, expected.color, PIXELS * 3, 2e-2);
    }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
    free_props(&p);
}

/* The same bytes again, after other frames and other objects, and within a crop. */
static void render_again(mgt_context *gl, const props *p, mgt_refraction refraction)
{
    static layers whole, again;
    static float part[3 * PIXELS];
    enum { X = 35, Y = 17, W = 40, H = 26 };
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = scene_of(p, waves, false);
    scene.quality.refraction = refraction;
    render_all(gl, &scene, &whole);
    mgt_scene other = scene;
    other.object_count = 1;
    render_all(gl, &other, &again);
    assert_memory_not_equal(again.color, whole.color, sizeof again.color);
    other.object_count = 0;
    other.objects = NULL;
    render_all(gl, &other, &again);
    render_all(gl, &scene, &again);
    assert_memory_equal(&again, &whole, sizeof again);
    mgt_scene crop = scene;
    crop.image.crop_x = X, crop.image.crop_y = Y, crop.image.crop_width = W, crop.image.crop_height = H;
    const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, part, 0);
    sea_render(gl, &crop, &target, 1);
    for (size_t y = 0; y < H; y++)
        assert_memory_equal(part + 3 * y * W, whole.color + 3 * ((y + Y) * SEA_WIDTH + X), 3 * W * sizeof(float));
}

static void the_same_bytes_again(void **state)
{
    (void)state;
    props p = make_props();
    mgt_context *gl = gl_context();
    render_again(gl, &p, MGT_REFRACTION_TWO_PHASE);
    render_again(gl, &p, MGT_REFRACTION_HYBRID);
    mgt_context_destroy(gl);
    free_props(&p);
}

/* A host's texture gets what mgt_render() gets, and its context stays without errors. */
static void textures_hold_objects(void **state)
{
    (void)state;
    static layers expected;
    static float color[4 * PIXELS];
    gl_host host;
    gl_host_start(&host);
    const gl_api gl = host.gl;
    mgt_context *context = gl_context_of(gl_egl_get_proc);
    mgt_gl_texture texture;
    mgt_gl_texture_init(&texture, sizeof texture);
    gl.CreateTextures(GL_TEXTURE_2D, 1, &texture.texture);
    gl.TextureStorage2D(texture.texture, 1, GL_RGBA32F, SEA_WIDTH, SEA_HEIGHT);
    gl.Enable(GL_SCISSOR_TEST); /* of the host, in nobody's way */
    gl.Enable(GL_CULL_FACE);
    mgt_wave waves[SEA_WAVES];
    props p = make_props();
    mgt_scene scene = scene_of(&p, waves, false);
    scene.quality.refraction = MGT_REFRACTION_HYBRID;
    render_all(context, &scene, &expected);
    assert_int_equal(mgt_gl_render_textures(context, &scene, &texture, 1), MGT_OK);
    assert_int_equal(gl.GetError(), GL_NO_ERROR);
    assert_true(gl.IsEnabled(GL_SCISSOR_TEST) && gl.IsEnabled(GL_CULL_FACE) && !gl.IsEnabled(GL_DEPTH_TEST));
    gl.GetTextureSubImage(texture.texture, 0, 0, 0, 0, SEA_WIDTH, SEA_HEIGHT, 1, GL_RGBA, GL_FLOAT, (GLsizei)sizeof color, color);
    for (size_t i = 0; i < PIXELS; i++)
        assert_memory_equal(color + 4 * i, expected.color + 3 * i, 3 * sizeof(float));
    scene.quality.refraction = MGT_REFRACTION_PATH_TRACED;
    assert_int_equal(mgt_gl_render_textures(context, &scene, &texture, 1), MGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(mgt_last_error(context), "on the CPU alone"));
    gl.DeleteTextures(1, &texture.texture);
    mgt_context_destroy(context);
    gl_host_stop(&host);
    free_props(&p);
}

int main(void)
{
    if (gl_is_missing())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(objects_are_those_of_the_cpu),
        cmocka_unit_test(horizons_are_those_of_the_cpu),
        cmocka_unit_test(the_same_bytes_again),
        cmocka_unit_test(textures_hold_objects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
