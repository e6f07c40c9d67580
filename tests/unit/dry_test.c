/* SPDX-License-Identifier: MIT
 * Dry hulls: their inside against its definition in plain double precision, by every triangle; and no pixel of water in a boat that rolls. */
#include "unit/api_sea.h"

#include "cpu/path_dry.h"
#include "unit/dry_pixels.h"
#include "unit/random_numbers.h"

/* ---- the inside ---- */

/* Bounds of the boat, and of its levels. */
typedef struct boat_bounds {
    double low[3], high[3], least_rim, most_rim;
} boat_bounds;

static boat_bounds bounds_of(const world *w)
{
    boat_bounds b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * (size_t)w->objects[0].triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            const double x = (double)w->positions[3 * (size_t)w->indices[i] + (size_t)k];
            b.low[k] = fmin(b.low[k], x), b.high[k] = fmax(b.high[k], x);
        }
    for (size_t i = 0; i < 2 * (size_t)w->objects[0].triangle_count; i++)
        if (w->dry[i] > -INFINITY)
            b.least_rim = fmin(b.least_rim, (double)w->dry[i]), b.most_rim = fmax(b.most_rim, (double)w->dry[i]);
    return b;
}

/* Places that rays from above come to before they meet the boat: the level of the side that they meet then tells whether a place is inside, and so do rays
 * traced from there. At rolling rims heights between the lowest and the highest level are a matter of how many directions one asks; they are left out.
 * Returns how many places were inside. */
static int compare_places(const world *w, int count, int *wrong)
{
    const boat_bounds b = bounds_of(w);
    random_state random = {11};
    path_dry *dry = NULL;
    if (trace_available())
        assert_int_equal(path_dry_update(&dry, w, 1, &(reporter){0}), MGT_OK);
    int inside = 0;
    for (int i = 0; i < count; i++) {
        double eye[3], at[3], ray[3], facing = 0;
        int32_t before, behind;
        for (int k = 0; k < 3; k++) {
            const double size = b.high[k] - b.low[k];
            eye[k] = k == 1 ? b.high[k] + random_range(&random, 0.5, 3) : b.low[k] + size * random_range(&random, -1, 2);
            at[k] = b.low[k] + size * random_unit(&random);
        }
        for (int k = 0; k < 3; k++)
            ray[k] = at[k] - eye[k];
        if ((at[1] > b.least_rim - 0.005 && at[1] < b.most_rim + 0.005) || dry_nearest(w, NULL, eye, ray, &before, &facing) <= 1)
            continue;
        dry_nearest(w, NULL, at, ray, &behind, &facing);
        const double level = behind < 0 ? -INFINITY : (double)w->dry[2 * behind + (facing > 0)];
        const bool drawn = at[1] < level, truly = dry_encloses(w, NULL, at), traced = dry ? path_dry_holds(dry, at) : truly;
        inside += truly;
        *wrong += drawn != truly || traced != truly;
        if (drawn != truly || traced != truly)
            print_message("%g %g %g: level %g, traced %d, inside %d\n", at[0], at[1], at[2], level, traced, truly);
    }
    path_dry_free(dry);
    return inside;
}

static void boat_is_dry_inside(void **state)
{
    (void)state;
    for (int pose = 0; pose < DRY_FRAMES; pose += MGT_SANITIZED ? DRY_FRAMES : 2) {
        dry_boat b = dry_boat_of(pose, NULL);
        int wrong = 0;
        const int inside = compare_places(b.world, 2500, &wrong);
        const boat_bounds bounds = bounds_of(b.world);
        print_message("%s: rim %.3f to %.3f m, %d places inside, %d wrong\n", dry_frames[pose], bounds.least_rim, bounds.most_rim, inside, wrong);
        assert_true(inside > 30);
        assert_int_equal(wrong, 0);
        dry_boat_free(&b);
    }
}

/* ---- plain shapes ---- */

typedef struct shape {
    float positions[3 * 64];
    uint32_t indices[3 * 64], vertices, triangles;
} shape;

static void add_quad(shape *s, const float corner[4][3])
{
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    memcpy(s->positions + 3 * s->vertices, corner, 12 * sizeof(float));
    for (int i = 0; i < 6; i++)
        s->indices[3 * s->triangles + i] = s->vertices + order[i];
    s->vertices += 4;
    s->triangles += 2;
}

/* Walls and floor of a box that is open above, x and z to both sides, from y = low to 1; and a level rim to another one where `rim` is not 0. */
static void add_tub(shape *s, float x, float z, float low, bool floor, float rim)
{
    for (int side = 0; side < 4; side++) {
        const float a[2] = {side == 0 || side == 3 ? -x : x, side < 2 ? -z : z}, b[2] = {side < 2 ? x : -x, side == 0 || side == 3 ? -z : z};
        add_quad(s, (const float[4][3]){{a[0], low, a[1]}, {b[0], low, b[1]}, {b[0], 1, b[1]}, {a[0], 1, a[1]}});
        if (rim > 0)
            add_quad(s, (const float[4][3]){{a[0], 1, a[1]}, {b[0], 1, b[1]}, {b[0] * rim, 1, b[1] * rim}, {a[0] * rim, 1, a[1] * rim}});
    }
    if (floor)
        add_quad(s, (const float[4][3]){{-x, low, -z}, {x, low, -z}, {x, low, z}, {-x, low, z}});
}

static world *world_of(const shape *s, double roll, mgt_mesh **mesh, thread_pool *pool)
{
    mgt_mesh_desc desc;
    mgt_mesh_desc_init(&desc, sizeof desc);
    desc.positions = s->positions, desc.vertex_count = s->vertices;
    desc.indices = s->indices, desc.triangle_count = s->triangles;
    desc.dry = 1;
    assert_int_equal(mgt_mesh_create(mesh, &desc), MGT_OK);
    const mgt_object object = {.mesh = *mesh, .transform = {{cos(roll), -sin(roll), 0, 0}, {sin(roll), cos(roll), 0, 0}, {0, 0, 1, 0}}};
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.objects = &object;
    scene.object_count = 1;
    world *w = NULL;
    assert_int_equal(world_update(&w, &scene, pool), MGT_OK);
    return w;
}

static int wet_sides(const world *w)
{
    int wet = 0;
    for (size_t i = 0; i < 2 * w->triangle_count; i++)
        wet += w->dry[i] == -INFINITY;
    return wet;
}

static void tubs_are_dry_and_tubes_are_not(void **state)
{
    (void)state;
    static const double rolls[] = {0, 0.35, -0.2};
    thread_pool *pool = thread_pool_create(2);
    for (size_t i = 0; i < sizeof rolls / sizeof *rolls; i++) {
        shape single = {0}, shell = {0}, tube = {0}, plate = {0};
        add_tub(&single, 1, 2, 0, true, 0);
        add_tub(&shell, 1, 2, 0, true, 0.9f);
        add_tub(&shell, 0.9f, 1.8f, 0.1f, true, 0);
        add_tub(&tube, 1, 2, 0, false, 0);
        add_quad(&plate, (const float[4][3]){{-1, 0, -2}, {1, 0, -2}, {1, 0, 2}, {-1, 0, 2}});
        const shape *const shapes[] = {&single, &shell, &tube, &plate};
        for (int k = 0; k < 4; k++) {
            mgt_mesh *mesh;
            world *w = world_of(shapes[k], rolls[i], &mesh, pool);
            int wrong = 0;
            const int inside = k < 2 ? compare_places(w, 4000, &wrong) : 0;
            print_message("shape %d rolled by %g: %d sides of %zu wet, %d places inside, %d wrong\n", k, rolls[i], wet_sides(w), 2 * w->triangle_count, inside,
                          wrong);
            assert_int_equal(wrong, 0);
            if (k < 2)
                assert_true(inside > 20);
            else if (rolls[i] == 0)
                assert_int_equal(wet_sides(w), 2 * w->triangle_count);
            world_free(w);
            mgt_mesh_destroy(mesh);
        }
    }
    thread_pool_destroy(pool);
}

/* A scene without dry meshes asks for nothing. */
static void nothing_is_dry_by_itself(void **state)
{
    (void)state;
    dry_boat b = dry_boat_of(0, "objects[0].dry=false");
    assert_null(b.world->dry);
    dry_boat_free(&b);
}

/* ---- pictures ---- */

static void no_pixel_in_the_boat_shows_water(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    dry_expect_none(context, MGT_SANITIZED ? DRY_FRAMES : 1);
    mgt_context_destroy(context);
}

/* Every way of refraction has the same front: that of the ground truth among them. */
static void ways_of_refraction_agree(void **state)
{
    (void)state;
    static const char *const ways[] = {"quality.refraction=off",        "quality.refraction=screen-space", "quality.refraction=broad",
                                       "quality.refraction=liu",        "quality.refraction=narrow",       "quality.refraction=hybrid",
                                       "quality.refraction=path-traced"};
    static float first[3 * DRY_PIXELS], other[3 * DRY_PIXELS], mask[DRY_PIXELS];
    static uint8_t shown[DRY_PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        dry_boat b = dry_boat_of(3, ways[i]);
        const mgt_target targets[] = {sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, i ? other : first, 0),
                                      sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, mask, 0)};
        const mgt_status status = mgt_render(context, &b.scene, targets, 2);
        if (i == 0)
            dry_pixels(&b, shown);
        if (status != MGT_ERROR_UNAVAILABLE) {
            assert_int_equal(status, MGT_OK);
            assert_int_equal(dry_counted(shown, mask).wet, 0);
        }
        for (size_t k = 0; status == MGT_OK && i > 0 && k < sizeof mask / sizeof *mask; k++)
            for (size_t c = 3 * k; c < 3 * k + 3 && mask[k] == 0; c++)
                assert_true(first[c] == other[c]);
        dry_boat_free(&b);
    }
    mgt_context_destroy(context);
}

static void no_specks_along_the_waterline(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    dry_expect_no_specks(context);
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boat_is_dry_inside),       cmocka_unit_test(tubs_are_dry_and_tubes_are_not),
        cmocka_unit_test(nothing_is_dry_by_itself), cmocka_unit_test(no_pixel_in_the_boat_shows_water),
        cmocka_unit_test(ways_of_refraction_agree), cmocka_unit_test(no_specks_along_the_waterline),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
