/* SPDX-License-Identifier: MIT
 *
 * Pixels of water inside a dry hull, counted by plain double precision: every triangle of scenes/hull.yaml's boat that a ray may meet is asked. Include it
 * after api_sea.h.
 */
#ifndef MANGATA_TESTS_DRY_PIXELS_H
#define MANGATA_TESTS_DRY_PIXELS_H

#include "base/thread_pool.h"
#include "frame/view_rays.h"
#include "frame/world.h"
#include "scene/scene_file.h"

enum { DRY_WIDTH = 112, DRY_HEIGHT = 63, DRY_PIXELS = DRY_WIDTH * DRY_HEIGHT, DRY_AROUND = 24, DRY_FRAMES = 6, DRY_BLOCK = 16 };

/* How the boat lies in each frame: it rolls by up to 20° and pitches. */
static const char *const dry_frames[DRY_FRAMES] = {"objects[0].rotation_deg=[0, -38, 2]",    "objects[0].rotation_deg=[0, -38, 12]",
                                                   "objects[0].rotation_deg=[3, -38, 20]",   "objects[0].rotation_deg=[-3, -38, -8]",
                                                   "objects[0].rotation_deg=[-4, -38, -20]", "objects[0].rotation_deg=[5, -38, -14]"};

typedef struct dry_boat {
    scene_file *file;
    mgt_scene scene;
    thread_pool *pool;
    world *world;
    double (*spheres)[4];
} dry_boat;

/* Sanitizers check what is tested, not what it is tested against. */
#define DRY_ORACLE __attribute__((no_sanitize("address", "undefined")))

DRY_ORACLE static inline double dry_dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* A sphere about every block of DRY_BLOCK triangles of the first object: its centre and its squared radius. */
DRY_ORACLE static inline double (*dry_spheres_of(const world *w))[4]
{
    const size_t corners = 3 * (size_t)w->objects[0].triangle_count, step = 3 * DRY_BLOCK;
    double(*spheres)[4] = calloc(corners / step + 1, sizeof *spheres);
    assert_non_null(spheres);
    for (size_t i = 0; i < corners; i += step) {
        double *s = spheres[i / step];
        const size_t end = i + step < corners ? i + step : corners;
        for (size_t c = i; c < end; c++)
            for (int k = 0; k < 3; k++)
                s[k] += (double)w->positions[3 * (size_t)w->indices[c] + (size_t)k] / (double)(end - i);
        for (size_t c = i; c < end; c++) {
            double to[3];
            for (int k = 0; k < 3; k++)
                to[k] = (double)w->positions[3 * (size_t)w->indices[c] + (size_t)k] - s[k];
            s[3] = fmax(s[3], dry_dot(to, to) * 1.001);
        }
    }
    return spheres;
}

static inline dry_boat dry_boat_of(int pose, const char *more)
{
    static const char *const camera = "camera={position: [1.7, 2.3, 2.3], target: [0, -0.1, 0], fov_y_deg: 60}";
    const char *const overrides[] = {dry_frames[pose], camera, "image={width: 112, height: 63}", more};
    dry_boat b = {0};
    scene_error error;
    b.file = scene_file_load(MGT_SOURCE_DIR "/scenes/hull.yaml", overrides, more ? 4 : 3, &error);
    if (!b.file)
        fail_msg("%s", error.text);
    assert_true(scene_file_frame(b.file, (uint32_t)pose, &b.scene));
    b.pool = thread_pool_create(2);
    assert_non_null(b.pool);
    assert_int_equal(world_update(&b.world, &b.scene, b.pool), MGT_OK);
    b.spheres = dry_spheres_of(b.world);
    return b;
}

static inline void dry_boat_free(dry_boat *b)
{
    free(b->spheres);
    world_free(b->world);
    thread_pool_destroy(b->pool);
    scene_file_free(b->file);
}

/* Multiple of a ray at which it meets a triangle; +inf: it does not. *facing: its normal · the ray. */
DRY_ORACLE static inline double dry_meet(const world *w, size_t triangle, const double from[3], const double ray[3], double *facing)
{
    double p[3][3], a[3], b[3], to[3];
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            p[c][k] = (double)w->positions[3 * (size_t)w->indices[3 * triangle + (size_t)c] + (size_t)k];
    for (int k = 0; k < 3; k++)
        a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k], to[k] = from[k] - p[0][k];
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double det = dry_dot(n, ray), along = -dry_dot(n, to) / det;
    *facing = det;
    if (!(along > 0) || !(along < INFINITY))
        return INFINITY;
    const double at[3] = {to[0] + along * ray[0], to[1] + along * ray[1], to[2] + along * ray[2]};
    const double aa = dry_dot(a, a), ab = dry_dot(a, b), bb = dry_dot(b, b), pa = dry_dot(at, a), pb = dry_dot(at, b), area = aa * bb - ab * ab;
    const double u = (bb * pa - ab * pb) / area, v = (aa * pb - ab * pa) / area;
    return u >= 0 && v >= 0 && u + v <= 1 ? along : INFINITY;
}

/* Whether the line of a ray stays outside a sphere. */
DRY_ORACLE static inline bool dry_passes(const double sphere[4], const double from[3], const double ray[3])
{
    const double to[3] = {sphere[0] - from[0], sphere[1] - from[1], sphere[2] - from[2]}, along = dry_dot(to, ray);
    return dry_dot(to, to) - along * along / dry_dot(ray, ray) > sphere[3];
}

/* The nearest of the boat's triangles; *triangle is −1 where there is none. `spheres` spare the triangles of blocks that the ray passes; NULL asks all. */
DRY_ORACLE static inline double dry_nearest(const world *w, double (*spheres)[4], const double from[3], const double ray[3], int32_t *triangle, double *facing)
{
    double nearest = INFINITY, side;
    *triangle = -1;
    for (size_t t = 0; t < w->objects[0].triangle_count; t++) {
        if (spheres && t % DRY_BLOCK == 0 && dry_passes(spheres[t / DRY_BLOCK], from, ray)) {
            t += DRY_BLOCK - 1;
            continue;
        }
        const double along = dry_meet(w, t, from, ray, &side);
        if (along < nearest)
            nearest = along, *triangle = (int32_t)t, *facing = side;
    }
    return nearest;
}

/* The definition, in more directions than anyone else asks. */
static inline bool dry_encloses(const world *w, double (*spheres)[4], const double point[3])
{
    static const double down[3] = {0, -1, 0};
    int32_t met;
    double facing;
    dry_nearest(w, spheres, point, down, &met, &facing);
    int missed = 0;
    for (int i = 0; i < DRY_AROUND && met >= 0 && missed <= DRY_AROUND / 8; i++) {
        const double angle = 2 * M_PI * (i + 0.2) / DRY_AROUND, ray[3] = {cos(angle), 0, sin(angle)};
        int32_t there;
        dry_nearest(w, spheres, point, ray, &there, &facing);
        missed += there < 0;
    }
    return met >= 0 && missed <= DRY_AROUND / 8;
}

/* What a ray of the camera shows: 0: water or sky, maybe; 1: the boat, which it meets before any wave could; 2: the boat, below the crests, inside. */
static inline int dry_shown(const dry_boat *b, const camera_rays *c, double x, double y)
{
    const double crest = 0.12; /* more than four deviations */
    const double from[3] = {c->position[0] - b->world->origin[0], c->position[1] - b->scene.water.level, c->position[2] - b->world->origin[1]};
    double ray[3], facing;
    int32_t triangle;
    for (int k = 0; k < 3; k++)
        ray[k] = c->corner[k] + x * c->right[k] + y * c->down[k];
    const double along = dry_nearest(b->world, b->spheres, from, ray, &triangle, &facing), first = (crest - from[1]) / ray[1];
    if (triangle < 0)
        return 0;
    const double enters[3] = {from[0] + first * ray[0], from[1] + first * ray[1], from[2] + first * ray[2]};
    return along <= first ? 1 : dry_encloses(b->world, b->spheres, enters) ? 2 : 0;
}

/* Of the pixels, by their corners and centres: 1: nothing but the boat; 2: nothing but its inside below the crests. */
static inline void dry_pixels(const dry_boat *b, uint8_t shown[DRY_PIXELS])
{
    static uint8_t corner[DRY_HEIGHT + 1][DRY_WIDTH + 1];
    const camera_rays c = camera_rays_of(&b->scene.camera, DRY_WIDTH, DRY_HEIGHT);
    for (int y = 0; y <= DRY_HEIGHT; y++)
        for (int x = 0; x <= DRY_WIDTH; x++)
            corner[y][x] = (uint8_t)dry_shown(b, &c, x - 0.5, y - 0.5);
    for (int i = 0; i < DRY_PIXELS; i++) {
        const int x = i % DRY_WIDTH, y = i / DRY_WIDTH;
        const int all[5] = {corner[y][x], corner[y][x + 1], corner[y + 1][x], corner[y + 1][x + 1],
                            corner[y][x] && corner[y + 1][x + 1] ? dry_shown(b, &c, x, y) : 0};
        int boat = 0, inside = 0;
        for (int k = 0; k < 5; k++)
            boat += all[k] > 0, inside += all[k] == 2;
        shown[i] = inside == 5 ? 2 : boat == 5;
    }
}

typedef struct dry_count {
    int boat, inside, wet; /* pixels of the boat; of them those of its inside; of these those with water */
} dry_count;

static inline dry_count dry_counted(const uint8_t shown[DRY_PIXELS], const float mask[DRY_PIXELS])
{
    dry_count n = {0};
    for (int i = 0; i < DRY_PIXELS; i++) {
        n.boat += shown[i] > 0;
        n.inside += shown[i] == 2;
        n.wet += shown[i] == 2 && mask[i] > 0;
    }
    return n;
}

static inline void dry_draw(mgt_context *context, const mgt_scene *scene, float mask[DRY_PIXELS])
{
    const mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, mask, 0);
    if (mgt_render(context, scene, &target, 1) != MGT_OK)
        fail_msg("%s", mgt_last_error(context));
}

/* Renders every so many of the frames, also as a boat that is not dry: there, water must be found. */
static inline void dry_expect_none(mgt_context *context, int step)
{
    static float mask[DRY_PIXELS];
    static uint8_t shown[DRY_PIXELS];
    dry_count sum = {0}, sum_wet = {0};
    int frames = 0;
    for (int pose = 0; pose < DRY_FRAMES; pose += step, frames++) {
        dry_boat b = dry_boat_of(pose, NULL), wet = dry_boat_of(pose, "objects[0].dry=false");
        dry_pixels(&b, shown);
        dry_draw(context, &b.scene, mask);
        const dry_count n = dry_counted(shown, mask);
        dry_draw(context, &wet.scene, mask);
        const dry_count of_wet = dry_counted(shown, mask);
        print_message("%s: %d pixels of the boat, %d inside; with water: dry %d, else %d\n", dry_frames[pose], n.boat, n.inside, n.wet, of_wet.wet);
        sum.inside += n.inside, sum.wet += n.wet, sum_wet.wet += of_wet.wet;
        dry_boat_free(&b);
        dry_boat_free(&wet);
    }
    assert_true(sum.inside > 100 * frames && sum_wet.wet > 50 * frames);
    assert_int_equal(sum.wet, 0);
}

/* ---- along the waterline ---- */

/* False where the method is not available. */
static inline bool dry_refract(mgt_context *context, mgt_scene *scene, mgt_refraction method, float color[3 * DRY_PIXELS])
{
    scene->quality.refraction = method;
    const mgt_target target = sea_target(MGT_LAYER_REFRACTION, MGT_FORMAT_RGB32F, color, 0);
    const mgt_status status = mgt_render(context, scene, &target, 1);
    if (status != MGT_OK && status != MGT_ERROR_UNAVAILABLE)
        fail_msg("%s", mgt_last_error(context));
    return status == MGT_OK;
}

/* In waves far from the mean surface, rays beside the hull pass under it, where the picture refracted by a flat surface shows only hull. There is no
 * bottom: two-phase must show water without end as traced rays do, not the hull's planes where the hull does not reach. */
static inline void dry_expect_no_specks(mgt_context *context)
{
    static float pictured[3 * DRY_PIXELS], traced[3 * DRY_PIXELS];
    int specks = 0, lost = 0, shown = 0;
    for (int pose = 0; pose < DRY_FRAMES; pose += MGT_SANITIZED ? DRY_FRAMES : 2) {
        dry_boat b = dry_boat_of(pose, "water.amplitude=4");
        b.scene.object_count = 1;
        b.scene.quality.method = MGT_METHOD_NONE;
        b.scene.quality.refraction_samples = 1;
        const bool traces = dry_refract(context, &b.scene, MGT_REFRACTION_HYBRID, traced);
        dry_refract(context, &b.scene, MGT_REFRACTION_TWO_PHASE, pictured);
        dry_boat_free(&b);
        for (int i = 0; i < DRY_PIXELS && traces; i++) { /* the hull is red, water blue */
            const bool hull = pictured[3 * i] > pictured[3 * i + 2], truly = traced[3 * i] > traced[3 * i + 2];
            shown += truly;
            specks += hull && !truly;
            lost += truly && !hull;
        }
    }
    print_message("%d pixels of the hull through the water; by two-phase %d too many, %d too few\n", shown, specks, lost);
    assert_true(specks <= 6 && lost <= 12);
}

#endif
