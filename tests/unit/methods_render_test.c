/* SPDX-License-Identifier: MIT
 *
 * Every method through the API: on every standard scene, in several sizes, on moving and still water, under lights from 0.05° to
 * 10°; the baselines' bytes for any threads, lanes and crop; the light that each method keeps;
 * and the blur of near water while the shutter is open.
 */
#include "unit/api_sea.h"

#include "image/picture.h"
#include "unit/text_scene.h"

static const struct {
    mgt_quality quality;
    const char *name;
    double least, most; /* sum of coverage over the reference's, over four scenes */
} methods[] = {
    {{.method = MGT_METHOD_MSAA32}, "msaa32", 0.8, 1.3},
    {{.method = MGT_METHOD_LEAN}, "lean", 0.7, 0.95},
    {{.method = MGT_METHOD_LEADR}, "leadr", 0.85, 1.1},
    {{.method = MGT_METHOD_TOKUYOSHI}, "tokuyoshi", 0.6, 1.05},
    {{.method = MGT_METHOD_BRUNETON}, "bruneton", 0.4, 1.1},
    {{.method = MGT_METHOD_TNDF}, "tndf", 0.65, 0.95},
    {{.method = MGT_METHOD_GGX_MOMENTS}, "ggx-moments", 0.6, 1.1},
    {{.method = MGT_METHOD_FXAA}, "fxaa", 0.2, 1.0},
    {{.method = MGT_METHOD_TAA}, "taa", 0.1, 1.0},
    {{.method = MGT_METHOD_NONE}, "none", 0.8, 1.3},
    {{.method = MGT_METHOD_SSAA, .spatial_samples = 2, .time_samples = 2}, "ssaa2, two instants", 0.85, 1.15},
    {{.method = MGT_METHOD_PODEE_UNIFORM}, "podee-uniform", 0.65, 0.95},
    {{.method = MGT_METHOD_PODEE_PIXEL}, "podee-pixel", 0.65, 0.95},
    {{.method = MGT_METHOD_PODEE_PIXEL, .kernels = MGT_MIXTURE_9, .elongation_limit = 9}, "podee-pixel, 9 kernels", 0.65, 0.95},
    {{.method = MGT_METHOD_PODEE_PIXEL, .kernels = MGT_MIXTURE_FELINE, .elongation_limit = 1e6}, "podee-pixel, Feline", 0.65, 0.95},
    {{.method = MGT_METHOD_PODEE_PIXEL, .kernels = MGT_MIXTURE_RIEMANN}, "podee-pixel, Riemann", 0.65, 0.95},
    {{.method = MGT_METHOD_MANGATA}, "mangata", 0.9, 1.1},
    {{.method = MGT_METHOD_ADAPTIVE, .samples = 4}, "adaptive, cells", 0.9, 1.1},
    {{.method = MGT_METHOD_ADAPTIVE, .adaptive = MGT_ADAPTIVE_PODEE, .samples = 4}, "adaptive, podee", 0.5, 1.3},
    {{.method = MGT_METHOD_REFERENCE, .spatial_samples = 2, .time_samples = 2}, "reference, 8 samples", 0.93, 1.07}, /* its own noise is 2% */
};
/* The first ones are the baselines. */
enum { METHODS = sizeof methods / sizeof *methods, BASELINES = 9 };

static mgt_quality quality_of(int method)
{
    const mgt_quality *q = &methods[method].quality;
    mgt_quality quality;
    mgt_quality_init(&quality, sizeof quality);
    quality.method = q->method;
    quality.spatial_samples = q->spatial_samples ? q->spatial_samples : 1;
    quality.time_samples = q->time_samples ? q->time_samples : 1;
    quality.kernels = q->kernels;
    quality.adaptive = q->adaptive;
    quality.samples = q->samples;
    quality.elongation_limit = q->elongation_limit;
    return quality;
}

static scene_file *load(const char *name, mgt_scene *scene)
{
    char path[512];
    scene_error error;
    snprintf(path, sizeof path, MGT_SOURCE_DIR "/scenes/%s", name);
    scene_file *file = scene_file_load(path, NULL, 0, &error);
    assert_non_null(file);
    assert_true(scene_file_frame(file, 0, scene));
    return file;
}

/* ---- every scene ---- */

enum { MOST = 65 * 37 };

static void check_frame(mgt_context *context, const mgt_scene *scene, const char *what)
{
    static float rgb[MOST * 3], coverage[MOST], mask[MOST];
    const mgt_target targets[] = {sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, rgb, 0), sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage, 0),
                                  sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, mask, 0)};
    sea_render(context, scene, targets, 3);
    for (uint32_t i = 0; i < scene->image.width * scene->image.height; i++) {
        bool good = coverage[i] >= 0 && coverage[i] <= 1 && mask[i] >= 0 && mask[i] <= 1;
        for (int c = 0; c < 3; c++)
            good = good && rgb[3 * i + (uint32_t)c] >= 0 && isfinite(rgb[3 * i + (uint32_t)c]);
        if (!good)
            fail_msg("%s, %u x %u, light %g degrees, pixel %u: colour %g %g %g, coverage %g, mask %g", what, scene->image.width, scene->image.height,
                     scene->light.angular_radius_deg, i, (double)rgb[3 * i], (double)rgb[3 * i + 1], (double)rgb[3 * i + 2], (double)coverage[i],
                     (double)mask[i]);
    }
}

/* Every fourth pair of light and size, from `first` on; every eighth where the water stands still. They change faster than waves, for which lean makes a new
 * map. */
static void check_scene(mgt_context *context, mgt_scene *scene, const char *name, int first, int *frames)
{
    static const double radii[] = {0.05, 0.27, 1, 3, 10};
    static const uint32_t sizes[][2] = {{65, 37}, {33, 47}, {1, 1}};
    for (int still = 0; still < 2; still++) {
        mgt_wave waves[MGT_MAX_WAVES];
        memcpy(waves, scene->water.waves, scene->water.wave_count * sizeof *waves);
        for (size_t i = 0; still && i < scene->water.wave_count; i++)
            waves[i].omega = 0;
        mgt_scene s = *scene;
        s.water.waves = waves;
        for (int k = first; k < 15; k += (still ? 8 : 4) * (1 + MGT_SANITIZED))
            for (int m = 0; m < METHODS; m++, ++*frames) {
                s.image = (mgt_image){.width = sizes[k % 3][0], .height = sizes[k % 3][1]};
                s.light.angular_radius_deg = radii[k / 3]; /* each makes a sky anew */
                s.quality = quality_of(m);
                char what[64];
                snprintf(what, sizeof what, "%s, %s%s", methods[m].name, name, still ? ", still" : "");
                check_frame(context, &s, what);
            }
    }
}

static void every_scene_renders(void **state)
{
    (void)state;
    static const char *const names[] = {"simple.json", "smooth.json",  "medium.json", "high.json", "rough.json",
                                        "sunset.json", "moonlit.json", "breeze.yaml", "gale.yaml", "lagoon.yaml"};
    mgt_context *context = sea_context(0, MGT_ISA_AUTO);
    int frames = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i += MGT_SANITIZED ? 5 : 1) {
        mgt_scene scene;
        scene_file *file = load(names[i], &scene);
        check_scene(context, &scene, names[i], (int)(MGT_SANITIZED ? i / 5 : i) % 4, &frames);
        scene_file_free(file);
    }
    print_message("  %d frames: no NaN, nothing negative, coverage and mask in [0, 1]\n", frames);
    mgt_context_destroy(context);
}

/* ---- the same bytes ---- */

enum { PIXELS = SEA_WIDTH * SEA_HEIGHT };

static void render_sea(mgt_context *context, const mgt_scene *scene, float *rgb, unsigned char *shown)
{
    const mgt_target targets[] = {sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, rgb, 0), sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, shown, 0)};
    sea_render(context, scene, targets, 2);
}

static void threads_lanes_and_crops_change_nothing(void **state)
{
    (void)state;
    static const mgt_isa sets[] = {MGT_ISA_SCALAR, MGT_ISA_AVX2, MGT_ISA_AVX512};
    static float whole[PIXELS * 3], other[PIXELS * 3];
    static unsigned char shown[PIXELS * 4], other_shown[PIXELS * 4];
    mgt_wave waves[SEA_WAVES];
    for (int moves = MGT_SANITIZED; moves < 2; moves++) {
        mgt_scene scene = sea_scene(waves);
        scene.camera_moves = moves;
        scene.camera_open.position[0] -= 0.05;
        mgt_context *first = sea_context(2, MGT_ISA_AUTO);
        mgt_context *contexts[3] = {NULL};
        for (int i = 0; i < 3; i++)
            contexts[i] = mgt_isa_available(sets[i]) ? sea_context(1, sets[i]) : NULL;
        for (int m = 0; m < BASELINES; m++) {
            scene.quality = quality_of(m);
            scene.image = (mgt_image){.width = SEA_WIDTH, .height = SEA_HEIGHT};
            render_sea(first, &scene, whole, shown);
            for (int i = 0; i < 3; i++) {
                if (!contexts[i] || (moves && i == 0))
                    continue;
                render_sea(contexts[i], &scene, other, other_shown);
                if (memcmp(whole, other, sizeof whole) != 0 || memcmp(shown, other_shown, sizeof shown) != 0)
                    fail_msg("%s differs with instruction set %d", methods[m].name, (int)sets[i]);
            }
            scene.image.crop_x = 37, scene.image.crop_y = 11, scene.image.crop_width = 30, scene.image.crop_height = 21;
            render_sea(first, &scene, other, other_shown);
            for (int y = 0; y < 21; y++) {
                const size_t at = (size_t)(y + 11) * SEA_WIDTH + 37;
                if (memcmp(whole + 3 * at, other + 90 * y, 90 * sizeof *whole) != 0 || memcmp(shown + 4 * at, other_shown + 120 * y, 120) != 0)
                    fail_msg("%s differs in a crop, row %d", methods[m].name, y);
            }
        }
        mgt_context_destroy(first);
        for (int i = 0; i < 3; i++)
            mgt_context_destroy(contexts[i]);
    }
}

/* ---- msaa32 ---- */

static void msaa_is_none_but_for_the_edges(void **state)
{
    (void)state;
    static float mask[PIXELS], exact[PIXELS], rgb[PIXELS * 3], none[PIXELS * 3];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.camera.up[0] = 0.31; /* a slanting horizon */
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    const mgt_target sampled[] = {sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, exact, 0)};
    const mgt_target both[] = {sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, mask, 0), sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, rgb, 0)};
    scene.quality = (mgt_quality){.method = MGT_METHOD_SSAA, .spatial_samples = 32, .time_samples = 1};
    sea_render(context, &scene, sampled, 1);
    scene.quality = (mgt_quality){.method = MGT_METHOD_NONE, .spatial_samples = 1, .time_samples = 1};
    const mgt_target plain[] = {sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, none, 0)};
    sea_render(context, &scene, plain, 1);
    scene.quality.method = MGT_METHOD_MSAA32;
    sea_render(context, &scene, both, 2);
    double worst = 0;
    int edges = 0;
    for (int i = 0; i < PIXELS; i++) {
        assert_true(mask[i] * 32 == floorf(mask[i] * 32));
        worst = fmax(worst, fabs((double)(mask[i] - exact[i])));
        edges += mask[i] > 0 && mask[i] < 1;
        if (mask[i] == 0 || mask[i] == 1)
            assert_memory_equal(rgb + 3 * i, none + 3 * i, 3 * sizeof *rgb);
    }
    print_message("  %d pixels at the edge, visibility against 1024 samples off by %.3f\n", edges, worst);
    assert_true(edges > SEA_WIDTH && worst < 0.06);
    mgt_context_destroy(context);
}

/* ---- taa ---- */

/* Without waves that move, and with a sky that varies little, eight frames are their mean: near that of many samples. */
static void taa_of_a_still_sea_is_a_mean(void **state)
{
    (void)state;
    static float taa[PIXELS * 3], none[PIXELS * 3], exact[PIXELS * 3];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    for (int i = 0; i < SEA_WAVES; i++)
        waves[i].omega = 0, waves[i].amplitude *= i < 5 ? 0.5 : 0;
    scene.light.radiance[0] = scene.light.radiance[1] = scene.light.radiance[2] = 0;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    const struct {
        mgt_quality quality;
        float *rgb;
    } pictures[] = {{{.method = MGT_METHOD_TAA, .spatial_samples = 1, .time_samples = 1}, taa},
                    {{.method = MGT_METHOD_NONE, .spatial_samples = 1, .time_samples = 1}, none},
                    {{.method = MGT_METHOD_SSAA, .spatial_samples = 16, .time_samples = 1}, exact}};
    for (int i = 0; i < 3; i++) {
        scene.quality = pictures[i].quality;
        const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, pictures[i].rgb, 0);
        sea_render(context, &scene, &target, 1);
    }
    double before = 0, after = 0;
    for (int i = 0; i < PIXELS * 3; i++) {
        before += pow((double)(none[i] - exact[i]), 2);
        after += pow((double)(taa[i] - exact[i]), 2);
    }
    print_message("  RMSE of none %.4f, of taa %.4f\n", sqrt(before / PIXELS / 3), sqrt(after / PIXELS / 3));
    assert_true(after < 0.25 * before);
    mgt_context_destroy(context);
}

/* ---- light kept ---- */

static double reference_sum(const char *name, int frame, float *pixels)
{
    char path[512];
    file_error error;
    float_image image = {0};
    snprintf(path, sizeof path, MGT_SOURCE_DIR "/tests/reference/%s-%02d.pfm", name, frame);
    assert_int_equal(picture_read(&image, path, NULL, &error), FILE_OK);
    double sum = 0;
    for (size_t i = 0; i < (size_t)image.width * image.height; i++)
        sum += (double)(pixels[i] = image.pixels[i]);
    float_image_free(&image);
    return sum;
}

/* Also how much of taa's light stands where the reference has none in any neighbour: its ghosts. */
static void light_is_kept_within_limits(void **state)
{
    (void)state;
    if (MGT_SANITIZED)
        skip();
    enum { WIDTH = 160, HEIGHT = 90, FRAMES = 8 };
    static const char *const names[] = {"simple", "smooth", "medium", "high"};
    static float coverage[WIDTH * HEIGHT], reference[WIDTH * HEIGHT];
    mgt_context *context = sea_context(0, MGT_ISA_AUTO);
    double sums[METHODS][4] = {{0}}, exact[4] = {0}, ghosts[METHODS][4] = {{0}};
    for (int n = 0; n < 4; n++) {
        mgt_scene scene;
        char file_name[32];
        snprintf(file_name, sizeof file_name, "%s.json", names[n]);
        scene_file *file = load(file_name, &scene);
        for (int frame = 0; frame < FRAMES; frame++) {
            assert_true(scene_file_frame(file, 8 * frame, &scene));
            scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
            exact[n] += reference_sum(names[n], 8 * frame, reference);
            for (int m = 0; m < METHODS; m++) {
                scene.quality = quality_of(m);
                const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage, 0);
                sea_render(context, &scene, &target, 1);
                for (int i = 0; i < WIDTH * HEIGHT; i++) {
                    sums[m][n] += (double)coverage[i];
                    ghosts[m][n] += reference[i] == 0 ? (double)coverage[i] : 0;
                }
            }
        }
        scene_file_free(file);
    }
    print_message("  sum of coverage over the reference's, 8 frames                | share of it where the reference has no light\n");
    int bad = 0;
    for (int m = 0; m < METHODS; m++) {
        print_message("  %-22s", methods[m].name);
        for (int n = 0; n < 4; n++) {
            print_message(" %9.3f", sums[m][n] / exact[n]);
            bad += !(sums[m][n] / exact[n] >= methods[m].least && sums[m][n] / exact[n] <= methods[m].most);
        }
        print_message("  |");
        for (int n = 0; n < 4; n++)
            print_message(" %9.4f", ghosts[m][n] / sums[m][n]);
        print_message("\n");
    }
    assert_int_equal(bad, 0);
    mgt_context_destroy(context);
}

/* ---- small pictures of the light ---- */

static double coverage_sum(mgt_context *context, const mgt_scene *scene)
{
    static float coverage[MOST];
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage, 0);
    sea_render(context, scene, &target, 1);
    double sum = 0;
    for (uint32_t i = 0; i < scene->image.width * scene->image.height; i++)
        sum += (double)coverage[i];
    return sum;
}

/* The sun's image on calm water has a tenth of a pixel's area. It is seen wherever it stands in a pixel, and on average over these places it has its area. */
static void calm_water_mirrors_the_whole_sun(void **state)
{
    (void)state;
    static const mgt_method calm_methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_ADAPTIVE};
    static const double amplitudes[] = {0, 0.01};
    mgt_context *context = sea_context(0, MGT_ISA_AUTO);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    const double degree = 3.14159265358979323846 / 180, elevation = 20, step = 1.25, fov = 9 * step;
    scene.image = (mgt_image){.width = 16, .height = 9};
    scene.camera = (mgt_camera){{0, 4, 0}, {0, 4 - tan(elevation * degree), -1}, {0, 1, 0}, fov};
    scene.light.angular_radius_deg = 0.2665;
    const double pixel = 2 * tan(fov / 2 * degree) / 9, area = 3.14159265358979323846 * pow(tan(0.2665 * degree) / pixel, 2);
    for (int k = 0; k < 4; k++) {
        sea_scene(waves);
        for (int i = 0; i < SEA_WAVES; i++)
            waves[i].amplitude *= amplitudes[k / 2];
        mgt_quality_init(&scene.quality, sizeof scene.quality);
        scene.quality.method = calm_methods[k % 2];
        double sum = 0, least = 1e9, most = 0;
        for (int i = 0; i < 16; i++) {
            scene.light.elevation_deg = elevation + i % 4 * step / 4;
            scene.light.azimuth_deg = i / 4 * step / 4 / cos(elevation * degree);
            const double now = coverage_sum(context, &scene) / area;
            sum += now / 16;
            least = fmin(least, now);
            most = fmax(most, now);
        }
        print_message("  calm water, method %d, waves %.2f: %.3f of the sun's area, %.3f to %.3f\n", calm_methods[k % 2], amplitudes[k / 2], sum, least, most);
        assert_true(fabs(sum - 1) < 0.1 && least > 0.2 && most < 2.5);
    }
    mgt_context_destroy(context);
}

/* From under water methods with shadowing see the sun as the others do. */
static void the_sun_is_seen_from_below(void **state)
{
    (void)state;
    static const struct {
        mgt_method method;
        double least, most;
    } rows[] = {{MGT_METHOD_LEAN, 0.6, 1.4}, {MGT_METHOD_LEADR, 0.6, 1.4}, {MGT_METHOD_BRUNETON, 0.6, 1.4}, {MGT_METHOD_MANGATA, 0.6, 1.4}};
    mgt_context *context = sea_context(0, MGT_ISA_AUTO);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.image = (mgt_image){.width = 32, .height = 18};
    scene.camera = (mgt_camera){{0, -20, 0}, {0, 0, -14}, {0, 1, 0}, 60};
    scene.light.elevation_deg = 35;
    scene.quality.method = MGT_METHOD_SSAA;
    scene.quality.spatial_samples = 16;
    scene.quality.time_samples = 1;
    const double exact = coverage_sum(context, &scene);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mgt_quality_init(&scene.quality, sizeof scene.quality);
        scene.quality.method = rows[i].method;
        const double share = coverage_sum(context, &scene) / exact;
        print_message("  from below, method %d: coverage %.3f of ssaa's %.4f\n", rows[i].method, share, exact);
        assert_true(share > rows[i].least && share < rows[i].most);
    }
    mgt_context_destroy(context);
}

/* ---- near water under an open shutter ---- */

enum { NEAR_WIDTH = 48, NEAR_HEIGHT = 36, NEAR_PIXELS = NEAR_WIDTH * NEAR_HEIGHT };

/* The mirrored sky without the mean of each row. */
static void near_texture(mgt_context *context, const mgt_scene *scene, double texture[NEAR_PIXELS])
{
    static float color[3 * NEAR_PIXELS];
    const mgt_target target = sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, color, 0);
    sea_render(context, scene, &target, 1);
    for (int row = 0; row < NEAR_HEIGHT; row++) {
        double mean = 0;
        for (int x = 0; x < NEAR_WIDTH; x++)
            mean += (double)color[3 * (row * NEAR_WIDTH + x) + 1] / NEAR_WIDTH;
        for (int x = 0; x < NEAR_WIDTH; x++)
            texture[row * NEAR_WIDTH + x] = (double)color[3 * (row * NEAR_WIDTH + x) + 1] - mean;
    }
}

/* Water that heaves slides along under the rays, and rays move with the camera, by many short waves where the water is near. Pixels of 1/16 of a degree, 7 m
 * away, as in a picture of 720 rows; the camera moves by five rows and two columns. Without the blur the contrast is 1.24 and 1.29, the error .58 and .65. Of a
 * camera that is seen from both ends of the shutter the error is .66. */
static void an_open_shutter_blurs_near_water(void **state)
{
    (void)state;
    static const char near[] = "mangata: 1\n"
                               "image: {width: 48, height: 36}\n"
                               "camera: {position: [0, 2, 0], target: [0, 0, -7], fov_y_deg: 2.25}\n"
                               "light: {elevation_deg: 30, azimuth_deg: 90, radiance: [0, 0, 0]}\n"
                               "sky: {model: gradient}\n"
                               "time: {start: 3.5, fps: 30, shutter: 1}\n"
                               "water:\n"
                               "  spectrum: {model: jonswap, wind: 10, count: 96, seed: 9, shortest: 0.05}\n";
    static const char *const changes[] = {"water.choppiness=0.8",
                                          "camera={path: [{time: 3.466666667, position: [0, 2, 0], target: [0, 0, -7], fov_y_deg: 2.25}, "
                                          "{time: 3.5, position: [0, 2.01, -0.12], target: [0.02, 0.01, -7.12], fov_y_deg: 2.25}]}"};
    static double truth[NEAR_PIXELS], seen[NEAR_PIXELS];
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    for (size_t count = 0; count <= 2; count++) {
        text_scene v = text_scene_read(near, changes, count);
        v.scene.quality.method = MGT_METHOD_SSAA;
        v.scene.quality.spatial_samples = 3;
        v.scene.quality.time_samples = 16;
        near_texture(context, &v.scene, truth);
        static const mgt_method rows[] = {MGT_METHOD_MANGATA, MGT_METHOD_ADAPTIVE};
        for (int i = 0; i < 2; i++) {
            mgt_quality_init(&v.scene.quality, sizeof v.scene.quality);
            v.scene.quality.method = rows[i];
            near_texture(context, &v.scene, seen);
            double off = 0, own = 0, all = 0;
            for (int p = 0; p < NEAR_PIXELS; p++) {
                off += (seen[p] - truth[p]) * (seen[p] - truth[p]);
                own += seen[p] * seen[p];
                all += truth[p] * truth[p];
            }
            print_message("  near water, choppiness %g, a camera that %s, method %d: contrast %.3f of ssaa's, error %.3f of it\n", v.scene.water.choppiness,
                          v.scene.camera_moves ? "moves" : "rests", rows[i], sqrt(own / all), sqrt(off / all));
            assert_true(sqrt(own / all) > 0.8 && sqrt(own / all) < 1.1 && sqrt(off / all) < 0.45);
        }
        scene_file_free(v.file);
    }
    mgt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calm_water_mirrors_the_whole_sun),
        cmocka_unit_test(the_sun_is_seen_from_below),
        cmocka_unit_test(every_scene_renders),
        cmocka_unit_test(threads_lanes_and_crops_change_nothing),
        cmocka_unit_test(msaa_is_none_but_for_the_edges),
        cmocka_unit_test(taa_of_a_still_sea_is_a_mean),
        cmocka_unit_test(light_is_kept_within_limits),
        cmocka_unit_test(an_open_shutter_blurs_near_water),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
