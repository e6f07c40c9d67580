/* SPDX-License-Identifier: MIT
 *
 * Scenes with objects where cameras, water and sizes are as awkward as they may be: every way of refraction and every method end, and every layer
 * holds numbers within its range. What bends no rays shows what stands there.
 */
#include "unit/api_sea.h"

#include "unit/text_scene.h"

enum { WIDTH = 61, HEIGHT = 35, MOST_PIXELS = 4096 * 16, LAYERS = 8 };

/* A basin with a ball on the waterline, one in the air, one on the floor and a wall beside the water. */
static const char pool[] = "mangata: 1\n"
                           "image: {width: 61, height: 35}\n"
                           "camera: {position: [0.4, 2.2, 4.4], target: [0.1, -0.2, 0], fov_y_deg: 55}\n"
                           "light: {elevation_deg: 50, azimuth_deg: 250}\n"
                           "time: {start: 3, fps: 30, frames: 2, shutter: 0.5}\n"
                           "water:\n"
                           "  clarity: clear\n"
                           "  waves:\n"
                           "    - {amplitude: 0.02, a: 2.3, b: -1.1, c: -5, phase: 0.7}\n"
                           "    - {amplitude: 0.012, a: -1.9, b: 4.1, c: -6.6, phase: 2.1}\n"
                           "    - {amplitude: 0.004, a: 9, b: 5, c: -10, phase: 4}\n"
                           "objects:\n"
                           "  - {shape: pool, size: [4, 1.5, 6], triangles: 600, material: {pattern: tiles, pattern_size: 0.3}}\n"
                           "  - {shape: sphere, size: [0.8, 0.8, 0.8], position: [-0.6, 0, 0.4], material: {pattern: stripes, pattern_size: 0.2}}\n"
                           "  - {shape: sphere, size: [0.5, 0.5, 0.5], position: [0.9, 0.8, 0], material: {metallic: 1, roughness: 0.02}}\n"
                           "  - {shape: sphere, size: [0.6, 0.6, 0.6], position: [0.7, -1.1, 0.8]}\n"
                           "  - {shape: box, size: [6, 2, 0.2], position: [0, 1, -3.6], material: {pattern: checker, pattern_size: 0.5}}\n";

static const struct {
    mgt_layer layer;
    const char *name;
    uint32_t channels;
    float least, most;
    bool endless; /* +inf is a value */
} layers[LAYERS] = {{MGT_LAYER_COLOR, "color", 3, 0, 1e9f, false},
                    {MGT_LAYER_COVERAGE, "coverage", 1, 0, 1, false},
                    {MGT_LAYER_MASK, "mask", 1, 0, 1, false},
                    {MGT_LAYER_DEPTH, "depth", 1, 0, 1e9f, true},
                    {MGT_LAYER_NORMAL, "normal", 3, -1.001f, 1.001f, false},
                    {MGT_LAYER_REFRACTION, "refraction", 3, 0, 1e9f, false},
                    {MGT_LAYER_REFRACTION_ERROR, "refraction_error", 1, 0, 1e30f, true},
                    {MGT_LAYER_SAMPLES, "samples", 1, 0, 1e9f, false}};

static float planes[LAYERS][3 * MOST_PIXELS];

/* How many values are out of their range; the first one is told. */
static int check_layer(const mgt_scene *scene, int layer, const char *what)
{
    int wrong = 0;
    const uint32_t pixels = scene->image.width * scene->image.height, channels = layers[layer].channels;
    for (uint32_t i = 0; i < pixels * channels; i++) {
        const float x = planes[layer][i];
        const bool good = (x >= layers[layer].least && x <= layers[layer].most) || (layers[layer].endless && x == INFINITY);
        if (!good && wrong++ == 0)
            print_error("%s: method %d, refraction %d, %u x %u: %s at %u, %u is %g\n", what, scene->quality.method, scene->quality.refraction,
                        scene->image.width, scene->image.height, layers[layer].name, i / channels % scene->image.width, i / channels / scene->image.width,
                        (double)x);
    }
    return wrong;
}

typedef enum drawing { DRAWN_WELL, DRAWN_BADLY, NOT_DRAWN } drawing;

/* Draws all layers into `planes`. A build without what traces rays, and methods that do not draw objects, may say so. */
static drawing draw(mgt_context *context, const mgt_scene *scene, const char *what)
{
    assert_true((size_t)scene->image.width * scene->image.height <= MOST_PIXELS);
    mgt_target targets[LAYERS];
    for (int i = 0; i < LAYERS; i++)
        targets[i] = sea_target(layers[i].layer, layers[i].channels == 3 ? MGT_FORMAT_RGB32F : MGT_FORMAT_R32F, planes[i], 0);
    const mgt_status status = mgt_render(context, scene, targets, LAYERS);
    const bool traces = scene->quality.refraction == MGT_REFRACTION_HYBRID || scene->quality.refraction == MGT_REFRACTION_PATH_TRACED;
    const bool samples = scene->quality.method == MGT_METHOD_REFERENCE || scene->quality.method == MGT_METHOD_ADAPTIVE;
    if ((traces && status == MGT_ERROR_UNAVAILABLE) || (samples && status == MGT_ERROR_UNSUPPORTED))
        return NOT_DRAWN;
    if (status != MGT_OK)
        fail_msg("%s: %s: %s", what, mgt_status_text(status), mgt_last_error(context));
    int wrong = 0;
    for (int i = 0; i < LAYERS; i++)
        wrong += check_layer(scene, i, what);
    return wrong ? DRAWN_BADLY : DRAWN_WELL;
}

/* ---- awkward scenes ---- */

static const struct {
    const char *name, *overrides[4];
} cases[] = {
    {"from above", {"camera.fov_y_deg=55"}},
    {"from below", {"camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}"}},
    {"straight down", {"camera={position: [0, 3, 0], target: [0, 0, 0], up: [0, 0, -1], fov_y_deg: 60}"}},
    {"straight up", {"camera={position: [0, -1, 0], target: [0, 0, 0], up: [0, 0, -1], fov_y_deg: 170}"}},
    {"on the surface", {"camera={position: [0.3, 0, 2.4], target: [0, 0, -0.6], fov_y_deg: 80}"}},
    {"on the surface, down", {"camera={position: [0.3, 0, 2.4], target: [0, -1, -0.6], fov_y_deg: 80}"}},
    {"on the surface, up", {"camera={position: [0.3, 0, 2.4], target: [0, 1, -0.6], fov_y_deg: 80}"}},
    {"a millimetre above", {"camera={position: [0.3, 0.001, 2.4], target: [0, -0.3, -0.6], fov_y_deg: 80}"}},
    {"a millimetre below", {"camera={position: [0.3, -0.001, 2.4], target: [0, 0.3, -0.6], fov_y_deg: 80}"}},
    {"a nanometre above", {"camera={position: [0.3, 1e-9, 2.4], target: [0, -0.3, -0.6], fov_y_deg: 80}"}},
    {"a nanometre below", {"camera={position: [0.3, -1e-9, 2.4], target: [0, 0.3, -0.6], fov_y_deg: 80}"}},
    {"in a crest", {"camera={position: [0.3, 0.1, 2.4], target: [0, 0, -0.6], fov_y_deg: 80}", "water.waves[0].amplitude=0.5"}},
    {"in a trough", {"camera={position: [0.3, -0.1, 2.4], target: [0, 0, -0.6], fov_y_deg: 80}", "water.waves[0].amplitude=0.5"}},
    {"in a ball", {"camera={position: [-0.6, 0.1, 0.4], target: [0, 0, 0], fov_y_deg: 80}"}},
    {"in a ball under water", {"camera={position: [0.7, -1.1, 0.8], target: [0, 0, 0], fov_y_deg: 80}"}},
    {"in the wall", {"camera={position: [0, 1, -3.6], target: [0, 0.8, 0], fov_y_deg: 80}"}},
    {"on a triangle", {"camera={position: [0, 1, -3.5], target: [0, 0.8, 0], fov_y_deg: 80}"}},
    {"under the floor", {"camera={position: [0, -5, 0], target: [0, 0, -0.5], fov_y_deg: 80}"}},
    {"all in the air", {"water.level=-9"}},
    {"all under water", {"water.level=9", "camera.position=[0.4, 14, 4.4]"}},
    {"all under water, and the camera", {"water.level=9"}},
    {"nothing in view", {"camera.target=[0.4, 2, 40]"}},
    {"nothing at all", {"objects=[]"}},
    {"flat water", {"water.waves=[]"}},
    {"flat water from below", {"water.waves=[]", "camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}"}},
    {"index 1", {"water.ior=1"}},
    {"index 1 from below", {"water.ior=1", "camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}"}},
    {"index 3", {"water.ior=3"}},
    {"index 3 from below", {"water.ior=3", "camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}"}},
    {"waves of 10 m", {"water.waves[0].amplitude=10", "camera.position=[0.4, 20, 40]"}},
    {"waves of 10 m from below", {"water.waves[0].amplitude=10", "camera.position=[0.4, -20, 40]"}},
    {"waves of 10 m about the camera", {"water.waves[0].amplitude=10"}},
    {"steep ripples", {"water.waves[2].amplitude=0.5"}},
    {"two millimetres wide",
     {"objects=[{shape: pool, size: [0.002, 0.001, 0.002]}]", "water.amplitude=0", "camera={position: [0, 0.001, 0.001], target: [0, 0, 0], fov_y_deg: 60}"}},
    {"two millimetres wide, from below",
     {"objects=[{shape: pool, size: [0.002, 0.001, 0.002]}]", "water.amplitude=0",
      "camera={position: [0, -0.0002, 0.0003], target: [0, 0, 0], fov_y_deg: 60}"}},
    {"ten kilometres wide", {"objects=[{shape: pool, size: [10000, 1500, 10000]}]", "camera={position: [0, 800, 3000], target: [0, 0, 0], fov_y_deg: 60}"}},
    {"ten kilometres wide, close", {"objects=[{shape: pool, size: [10000, 1500, 10000]}]"}},
    {"ten kilometres wide, from below",
     {"objects=[{shape: pool, size: [10000, 1500, 10000]}]", "camera={position: [0, -3, 0], target: [0, 0, -20], fov_y_deg: 60}"}},
    {"far from the origin", {"camera={position: [900000, 2.2, 4.4], target: [900000, -0.2, 0], fov_y_deg: 55}", "objects[0].position=[900000, 0, 0]"}},
    {"murky", {"water.clarity=murky"}},
    {"as black as ink", {"water.absorption=[1000, 1000, 1000]", "water.scattering=[1000, 1000, 1000]"}},
    {"at night", {"light.elevation_deg=-30"}},
    {"light from straight above", {"light.elevation_deg=90"}},
    {"light on the horizon", {"light.elevation_deg=0"}},
    {"a film with a path",
     {"camera={fov_y_deg: 55, path: [{time: 0, position: [0.4, 2.2, 4.4], target: [0, 0, 0]}, "
      "{time: 3, position: [0.4, -0.4, 2.4], target: [0, 0, 0]}]}"}},
    {"through the surface while the shutter is open",
     {"camera={fov_y_deg: 55, path: [{time: 2.98, position: [0.4, 0.2, 2.4], target: [0, 0, 0]}, "
      "{time: 3, position: [0.4, -0.2, 2.4], target: [0, 0, 0]}]}"}},
    {"one pixel", {"image={width: 1, height: 1}"}},
    {"a row", {"image={width: 700, height: 1}"}},
    {"a column", {"image={width: 1, height: 700}"}},
};
enum { CASES = sizeof cases / sizeof *cases };

static void every_refraction_ends(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    int bad = 0;
    for (int i = 0; i < CASES; i++) {
        size_t count = 0;
        while (count < 4 && cases[i].overrides[count])
            count++;
        text_scene v = text_scene_read(pool, cases[i].overrides, count);
        for (int r = MGT_SANITIZED ? i % 4 : 0; r <= MGT_REFRACTION_PATH_TRACED; r += 1 + 3 * MGT_SANITIZED) {
            const bool caustics = (i + r + r / 4) % 2 != 0;
            v.scene.quality.refraction = (mgt_refraction)r;
            v.scene.quality.refraction_samples = 1;
            v.scene.quality.caustics = caustics;
            v.scene.quality.method = caustics ? MGT_METHOD_NONE : MGT_METHOD_MANGATA;
            bad += draw(context, &v.scene, cases[i].name) == DRAWN_BADLY;
        }
        scene_file_free(v.file);
    }
    assert_int_equal(bad, 0);
    mgt_context_destroy(context);
}

/* ---- index 1 ---- */

/* What bends nothing shows everything where it is. */
static void index_one_is_straight(void **state)
{
    (void)state;
    static const char *const cameras[] = {"camera.fov_y_deg=55", "camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}"};
    static float straight[3 * WIDTH * HEIGHT];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int i = 0; i < 4; i++) {
        const char *const overrides[] = {cameras[i % 2], "water.ior=1", i < 2 ? "water.waves=[]" : "water.level=0"};
        text_scene v = text_scene_read(pool, overrides, 3);
        v.scene.quality.method = MGT_METHOD_NONE;
        v.scene.quality.refraction = MGT_REFRACTION_OFF;
        assert_int_equal(draw(context, &v.scene, "index 1, straight"), DRAWN_WELL);
        memcpy(straight, planes[5], sizeof straight);
        static const mgt_refraction others[] = {MGT_REFRACTION_TWO_PHASE, MGT_REFRACTION_HYBRID, MGT_REFRACTION_BROAD, MGT_REFRACTION_PATH_TRACED};
        for (int k = 0; k < 4; k++) {
            v.scene.quality.refraction = others[k];
            v.scene.quality.refraction_samples = 1;
            if (draw(context, &v.scene, "index 1") == NOT_DRAWN)
                continue;
            int off = 0, water = 0;
            for (int p = 0; p < WIDTH * HEIGHT; p++) {
                if (planes[2][p] < 1)
                    continue;
                water++;
                double most = 0;
                for (int c = 0; c < 3; c++)
                    most = fmax(most, fabs((double)planes[5][3 * p + c] - (double)straight[3 * p + c]) / fmax(1, (double)straight[3 * p + c]));
                off += most > 0.03;
            }
            assert_true(water > 300);
            if (off > water / 100)
                fail_msg("index 1, camera %d, %s water, refraction %d: %d of %d pixels differ from those seen straight through", i % 2, i < 2 ? "flat" : "wavy",
                         others[k], off, water);
        }
        scene_file_free(v.file);
    }
    mgt_context_destroy(context);
}

/* ---- edges in front ---- */

/* A white ball of triangles smaller than a pixel, half in black water. */
static const char *const ball[] = {"objects=[{shape: pool, size: [4, 1.5, 6], triangles: 600, material: {base_color: [0.02, 0.02, 0.02]}}, "
                                   "{shape: sphere, size: [2.4, 2.4, 2.4], material: {base_color: [0.9, 0.9, 0.9]}}]",
                                   "time.shutter=0"};

static double mean_mask(const mgt_scene *scene)
{
    double sum = 0;
    const uint32_t pixels = scene->image.width * scene->image.height;
    for (uint32_t p = 0; p < pixels; p++)
        sum += (double)planes[2][p];
    return sum / pixels;
}

/* Triangles that no pixel's centre shows count, too: what stands in front hides as much of the water in a small picture as in one with four times the rows. */
static void outlines_in_front_are_whole(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(pool, ball, 2);
    v.scene.quality.method = MGT_METHOD_NONE;
    assert_int_equal(draw(context, &v.scene, "a ball"), DRAWN_WELL);
    const double small = mean_mask(&v.scene);
    v.scene.image.width *= 4, v.scene.image.height *= 4;
    assert_int_equal(draw(context, &v.scene, "a large ball"), DRAWN_WELL);
    const double large = mean_mask(&v.scene);
    printf("a ball in front: %.4f of the picture is water, %.4f of one with four times the rows\n", small, large);
    assert_true(fabs(small - large) < 0.001);
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* What is seen beside a thing in front is what lies behind the water there, not the thing's inside. */
static void what_hides_water_is_not_seen_through_it(void **state)
{
    (void)state;
    static float wanted[3 * WIDTH * HEIGHT];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(pool, ball, 2);
    v.scene.quality.method = MGT_METHOD_NONE;
    v.scene.quality.refraction = MGT_REFRACTION_PATH_TRACED;
    if (draw(context, &v.scene, "a ball, traced") == NOT_DRAWN)
        skip();
    memcpy(wanted, planes[0], sizeof wanted);
    v.scene.quality.refraction = MGT_REFRACTION_TWO_PHASE;
    for (uint32_t places = 0; places < 4; places += 3) {
        v.scene.quality.refraction_samples = places;
        assert_int_equal(draw(context, &v.scene, "a ball"), DRAWN_WELL);
        double sum = 0;
        int edges = 0;
        for (int p = 0; p < WIDTH * HEIGHT; p++) {
            if (!(planes[2][p] > 0 && planes[2][p] < 1))
                continue;
            edges++;
            sum += pow((double)planes[0][3 * p] - (double)wanted[3 * p], 2);
        }
        printf("a ball in front, %u places: rms %.3f kcd/m2 of %d pixels at its edge\n", places, sqrt(sum / edges), edges);
        assert_true(edges > 40);
        assert_true(sqrt(sum / edges) < 0.32);
    }
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* Two things whose surfaces lie in one plane have an edge between them as others do: a row that crosses it has a pixel between both colours. */
static void things_in_one_plane_have_an_edge(void **state)
{
    (void)state;
    static const char *const slabs[] =
        {"objects=[{shape: box, size: [3, 0.4, 3], position: [-1.5, 0.4, 0], material: {base_color: [0.1, 0.1, 0.1], roughness: 1}}, "
         "{shape: box, size: [3, 0.4, 3], position: [1.5, 0.4, 0], material: {base_color: [0.8, 0.8, 0.8], roughness: 1}}]",
         "camera={position: [0.05, 4, 0], target: [0.05, 0, 0], up: [0.3, 0, -1], fov_y_deg: 30}", "time.shutter=0"};
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(pool, slabs, 3);
    v.scene.quality.method = MGT_METHOD_NONE;
    assert_int_equal(draw(context, &v.scene, "slabs"), DRAWN_WELL);
    int rows = 0, smooth = 0;
    for (int y = 0; y < HEIGHT; y++) {
        bool crosses = false, between = false;
        for (int x = 1; x + 1 < WIDTH; x++) {
            const int i = y * WIDTH + x;
            const float dark = planes[0][3 * i - 3], here = planes[0][3 * i], light = planes[0][3 * i + 3];
            const bool on_top = planes[4][3 * i - 2] > 0.9f && planes[4][3 * i + 1] > 0.9f && planes[4][3 * i + 4] > 0.9f;
            if (planes[2][i - 1] > 0 || planes[2][i + 1] > 0 || !on_top || !(light > 3 * dark))
                continue;
            crosses = true;
            between = between || (here > 1.2f * dark && here < light / 1.1f);
        }
        rows += crosses;
        smooth += between;
    }
    printf("things in one plane: %d of %d rows have a pixel between\n", smooth, rows);
    assert_true(rows > 8 && smooth > rows / 2);
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

/* ---- methods ---- */

static const mgt_method methods[] = {MGT_METHOD_NONE,      MGT_METHOD_SSAA,   MGT_METHOD_PODEE_UNIFORM, MGT_METHOD_PODEE_PIXEL, MGT_METHOD_MANGATA,
                                     MGT_METHOD_REFERENCE, MGT_METHOD_MSAA32, MGT_METHOD_LEAN,          MGT_METHOD_LEADR,       MGT_METHOD_TOKUYOSHI,
                                     MGT_METHOD_BRUNETON,  MGT_METHOD_FXAA,   MGT_METHOD_TAA,           MGT_METHOD_TNDF,        MGT_METHOD_GGX_MOMENTS};
enum { METHODS = sizeof methods / sizeof *methods };

/* Whether no pixel beside this one is water. */
static bool is_inside(const float *water, int p)
{
    for (int y = p / WIDTH - 1; y <= p / WIDTH + 1; y++)
        for (int x = p % WIDTH - 1; x <= p % WIDTH + 1; x++)
            if (x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT && water[y * WIDTH + x] > 0)
                return false;
    return true;
}

/* Every method draws the objects before the water where the default does: mask and depth tell. */
static void every_method_shows_objects(void **state)
{
    (void)state;
    static const char *const cameras[] = {"camera.fov_y_deg=55", "camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}"};
    static float mask[WIDTH * HEIGHT], color[3 * WIDTH * HEIGHT];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int i = 0; i < 2; i++) {
        text_scene v = text_scene_read(pool, &cameras[i], 1);
        v.scene.quality.spatial_samples = 2;
        assert_int_equal(draw(context, &v.scene, "the default method"), DRAWN_WELL);
        memcpy(mask, planes[2], sizeof mask);
        memcpy(color, planes[0], sizeof color);
        for (int m = 0; m < METHODS + 2; m++) {
            v.scene.quality.method = m < METHODS ? methods[m] : MGT_METHOD_ADAPTIVE;
            v.scene.quality.adaptive = m <= METHODS ? MGT_ADAPTIVE_CELLS : MGT_ADAPTIVE_PODEE;
            v.scene.quality.samples = m < METHODS ? 0 : 3;
            const drawing drawn = draw(context, &v.scene, "a method");
            assert_int_not_equal(drawn, DRAWN_BADLY);
            if (drawn == NOT_DRAWN)
                continue;
            /* Edges are blended by these on purpose: away from the water their mean stays. */
            const bool blends = v.scene.quality.method == MGT_METHOD_FXAA || v.scene.quality.method == MGT_METHOD_TAA;
            double sum = 0, wanted = 0;
            int solid = 0, off = 0;
            for (int p = 0; p < WIDTH * HEIGHT; p++) {
                if (mask[p] > 0)
                    continue;
                solid++;
                double most = planes[2][p] > 0 ? 1 : 0;
                const bool counts = !blends || is_inside(mask, p);
                for (int c = 0; c < 3; c++) {
                    sum += counts ? (double)planes[0][3 * p + c] : 0, wanted += counts ? (double)color[3 * p + c] : 0;
                    most = fmax(most, fabs((double)planes[0][3 * p + c] - (double)color[3 * p + c]) / fmax(1, (double)color[3 * p + c]));
                }
                off += most > 0.02 && !blends;
            }
            assert_true(solid > 200);
            assert_true(fabs(sum / wanted - 1) < 0.02);
            if (off > solid / 50)
                fail_msg("camera %d, method %d: %d of %d pixels of objects differ from the default method's", i, v.scene.quality.method, off, solid);
        }
        scene_file_free(v.file);
    }
    mgt_context_destroy(context);
}

/* However many samples method adaptive may take, it takes none for what objects hide, beyond the first look at each pixel. */
static void what_objects_hide_takes_no_samples(void **state)
{
    (void)state;
    static const char *const cameras[] = {"camera.fov_y_deg=55", "camera={position: [0.4, 0.8, 4.4], target: [0.1, 0.3, 0], fov_y_deg: 40}"};
    static float few[WIDTH * HEIGHT];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (int i = 0; i < 2; i++) {
        text_scene v = text_scene_read(pool, &cameras[i], 1);
        v.scene.quality.method = MGT_METHOD_ADAPTIVE;
        v.scene.quality.samples = 1;
        assert_int_equal(draw(context, &v.scene, "adaptive"), DRAWN_WELL);
        memcpy(few, planes[7], sizeof few);
        v.scene.quality.samples = 60;
        assert_int_equal(draw(context, &v.scene, "adaptive"), DRAWN_WELL);
        int hidden = 0, seen = 0;
        for (int p = 0; p < WIDTH * HEIGHT; p++) {
            const bool more = planes[7][p] > few[p];
            seen += planes[2][p] > 0 && more;
            if (!is_inside(planes[2], p) || !isfinite(planes[3][p]))
                continue;
            hidden++;
            if (more)
                fail_msg("camera %d: pixel %d %d, hidden by objects, took %g samples, %g at first", i, p % WIDTH, p / WIDTH, (double)planes[7][p],
                         (double)few[p]);
        }
        assert_true(hidden > 50 && seen > 100);
        scene_file_free(v.file);
    }
    mgt_context_destroy(context);
}

/* ---- meshes ---- */

static mgt_status make(mgt_mesh **mesh, const float *positions, uint32_t vertices, const uint32_t *indices, uint32_t triangles)
{
    mgt_mesh_desc desc;
    mgt_mesh_desc_init(&desc, sizeof desc);
    desc.positions = positions;
    desc.vertex_count = vertices;
    desc.indices = indices;
    desc.triangle_count = triangles;
    return mgt_mesh_create(mesh, &desc);
}

static void broken_meshes_are_refused(void **state)
{
    (void)state;
    static const float bad[] = {NAN, INFINITY, -INFINITY, 2e6f};
    static const uint32_t indices[] = {0, 1, 2}, beyond[] = {0, 1, 3};
    mgt_mesh *mesh;
    for (int i = 0; i < 4 * 9; i++) {
        float positions[9] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
        positions[i % 9] = bad[i / 9];
        mesh = (mgt_mesh *)(void *)&mesh;
        assert_int_not_equal(make(&mesh, positions, 3, indices, 1), MGT_OK);
        assert_null(mesh);
        assert_true(strlen(mgt_last_error(NULL)) > 0);
    }
    static const float good[] = {0, 0, 0, 1, 0, 0, 0, 0, 1}, flat[] = {0, 0, 0, 1, 0, 0, 2, 0, 0};
    assert_int_not_equal(make(&mesh, good, 3, beyond, 1), MGT_OK);
    assert_int_not_equal(make(&mesh, flat, 3, indices, 1), MGT_OK);
    assert_int_not_equal(make(&mesh, good, 3, indices, 0), MGT_OK);
    assert_int_not_equal(make(&mesh, NULL, 3, indices, 1), MGT_OK);
    assert_int_not_equal(make(&mesh, good, 3, NULL, 1), MGT_OK);
    for (int i = 0; i < 9; i++) { /* normals, too */
        float normals[9] = {0, 1, 0, 0, 1, 0, 0, 1, 0};
        normals[i] = NAN;
        mgt_mesh_desc desc;
        mgt_mesh_desc_init(&desc, sizeof desc);
        desc.positions = good, desc.vertex_count = 3, desc.indices = indices, desc.triangle_count = 1;
        desc.normals = normals;
        assert_int_not_equal(mgt_mesh_create(&mesh, &desc), MGT_OK);
        assert_null(mesh);
    }
}

static mgt_status make_with_texcoord(float value)
{
    static const float positions[] = {0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const uint32_t indices[] = {0, 1, 2};
    const float texcoords[6] = {0, 0, 0, value};
    mgt_mesh *mesh;
    mgt_mesh_desc desc;
    mgt_mesh_desc_init(&desc, sizeof desc);
    desc.positions = positions, desc.vertex_count = 3, desc.indices = indices, desc.triangle_count = 1;
    desc.texcoords = texcoords;
    const mgt_status status = mgt_mesh_create(&mesh, &desc);
    mgt_mesh_destroy(mesh);
    return status;
}

/* The ranges that mangata/objects.h states. */
static void ranges_of_objects_end_where_stated(void **state)
{
    (void)state;
    assert_int_equal(make_with_texcoord(-1e6f), MGT_OK);
    assert_int_equal(make_with_texcoord(1.001e6f), MGT_ERROR_ARGUMENT);
    assert_int_equal(make_with_texcoord(NAN), MGT_ERROR_ARGUMENT);

    const text_scene v = text_scene_read(pool, NULL, 0);
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    mgt_scene scene = v.scene;
    mgt_object object = v.scene.objects[0]; /* of tiles */
    scene.objects = &object;
    scene.object_count = 1;
    const struct {
        float size, joint;
        mgt_status status;
    } patterns[] = {{1e-4f, 0, MGT_OK},
                    {1e6f, 0.999f, MGT_OK},
                    {0.9e-4f, 0, MGT_ERROR_SCENE},
                    {1.001e6f, 0, MGT_ERROR_SCENE},
                    {1, 0.9991f, MGT_ERROR_SCENE},
                    {1, -0.001f, MGT_ERROR_SCENE}};
    for (size_t i = 0; i < sizeof patterns / sizeof patterns[0]; i++) {
        object.material.pattern_size = patterns[i].size;
        object.material.pattern_joint = patterns[i].joint;
        if (mgt_scene_check(context, &scene) != patterns[i].status)
            fail_msg("pattern %zu: %s", i, mgt_last_error(context));
    }
    object = v.scene.objects[0];
    const struct {
        double scale, shift;
        mgt_status status;
    } places[] = {{1.01e-8, -1e6, MGT_OK}, {-1e6, 1e6, MGT_OK}, {0.99e-8, 0, MGT_ERROR_SCENE}, {1.001e6, 0, MGT_ERROR_SCENE}, {1, -1.001e6, MGT_ERROR_SCENE}};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const double s = places[i].scale;
        memcpy(object.transform, (double[3][4]){{s, 0, 0, places[i].shift}, {0, s, 0, 0}, {0, 0, s, 0}}, sizeof object.transform);
        if (mgt_scene_check(context, &scene) != places[i].status)
            fail_msg("place %zu: %s", i, mgt_last_error(context));
    }
    mgt_context_destroy(context);
    scene_file_free(v.file);
}

/* Needles, specks and triangles as wide as the world, through the camera and across the waterline, among sound ones. */
static void poor_triangles_render(void **state)
{
    (void)state;
    static const float positions[] = {-1,    -1,   -1,    1,     -1,    -1,    0,    -1,         2,    /* a floor */
                                      -1e6f, -5,   -9e5f, 1e6f,  -5,    -9e5f, 0,    -5,         1e6f, /* a floor to the horizon */
                                      -1e6f, 7e4f, -9e5f, 1e6f,  -7e4f, -9e5f, 3,    0,          2,    /* across the surface */
                                      0,     2,    4,     1e-7f, 2,     4,     0,    2.0000001f, 4,    /* a speck at the camera */
                                      -1,    2.2f, 4.4f,  2,     2.2f,  4.4f,  0.5f, 2.2f,       -6,   /* through the camera, edge on */
                                      -3,    0,    0,     3,     0,     0,     0,    1e-30f,     1,    /* as thin as it can be */
                                      -3,    0,    -1,    3,     0,     -1,    0,    0,          1,    /* in the surface */
                                      0.4f,  2.2f, 4.4f,  0,     -1,    0,     1,    -1,         0};   /* from the camera */
    uint32_t indices[24];
    for (uint32_t i = 0; i < 24; i++)
        indices[i] = i;
    mgt_mesh *mesh;
    assert_int_equal(make(&mesh, positions, 24, indices, 8), MGT_OK);
    static const char *const cameras[] = {"camera.fov_y_deg=55", "camera={position: [0.3, -0.9, 2.4], target: [0, 0.4, -0.6], fov_y_deg: 80}",
                                          "camera={position: [0.3, 0, 2.4], target: [0, 0, -0.6], fov_y_deg: 80}"};
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    int bad = 0;
    for (int i = 0; i < 3; i++) {
        text_scene v = text_scene_read(pool, &cameras[i], 1);
        mgt_object object = v.scene.objects[1];
        object.mesh = mesh;
        memcpy(object.transform, (double[3][4]){{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, sizeof object.transform);
        v.scene.objects = &object;
        v.scene.object_count = 1;
        v.scene.quality.refraction_samples = 1;
        for (int r = MGT_SANITIZED ? i : 0; r <= MGT_REFRACTION_PATH_TRACED; r += 1 + 3 * MGT_SANITIZED) {
            v.scene.quality.refraction = (mgt_refraction)r;
            bad += draw(context, &v.scene, "poor triangles") == DRAWN_BADLY;
        }
        scene_file_free(v.file);
    }
    assert_int_equal(bad, 0);
    mgt_context_destroy(context);
    mgt_mesh_destroy(mesh);
}

/* ---- crops ---- */

static void crops_and_long_pictures(void **state)
{
    (void)state;
    static float whole[3 * WIDTH * HEIGHT];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    text_scene v = text_scene_read(pool, NULL, 0);
    for (int r = 0; r <= MGT_REFRACTION_PATH_TRACED; r++) {
        v.scene.quality.refraction = (mgt_refraction)r;
        v.scene.quality.refraction_samples = 1;
        v.scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
        if (draw(context, &v.scene, "whole") == NOT_DRAWN)
            continue;
        memcpy(whole, planes[0], sizeof whole);
        v.scene.image.crop_x = 17, v.scene.image.crop_y = 11, v.scene.image.crop_width = 21, v.scene.image.crop_height = 9;
        const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, planes[0], 0);
        sea_render(context, &v.scene, &target, 1);
        for (int y = 0; y < 9; y++)
            assert_memory_equal(planes[0] + 3 * 21 * y, whole + 3 * (WIDTH * (y + 11) + 17), 3 * 21 * sizeof(float));
        v.scene.image = (mgt_image){.width = 4096, .height = 16};
        assert_int_not_equal(draw(context, &v.scene, "4096 x 16"), DRAWN_BADLY);
    }
    scene_file_free(v.file);
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_refraction_ends),
        cmocka_unit_test(index_one_is_straight),
        cmocka_unit_test(outlines_in_front_are_whole),
        cmocka_unit_test(what_hides_water_is_not_seen_through_it),
        cmocka_unit_test(things_in_one_plane_have_an_edge),
        cmocka_unit_test(every_method_shows_objects),
        cmocka_unit_test(what_objects_hide_takes_no_samples),
        cmocka_unit_test(broken_meshes_are_refused),
        cmocka_unit_test(ranges_of_objects_end_where_stated),
        cmocka_unit_test(poor_triangles_render),
        cmocka_unit_test(crops_and_long_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
