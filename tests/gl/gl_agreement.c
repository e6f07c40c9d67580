/* SPDX-License-Identifier: MIT
 *
 * OpenGL against the CPU: every method on scene files, coverage, foam and displayed colour, and the displayed bytes with glare.
 * usage: gl_agreement [--quick] [--only METHOD] SCENE…      Exit 1 where a limit is missed, 77 without OpenGL.
 * With --quick the default method is compared at half the size, others at three tenths and on every third scene, and seas by adaptive cells not at all:
 * gl_cells_test compares these.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/kernel_context.h"
#include "frame/kernel_data.h"
#include "frame/atmosphere.h"
#include "scene/scene_file.h"
#include "trace/trace.h"

#pragma GCC diagnostic ignored "-Wunused-parameter" /* the dialect hands cx to every function */
#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#define FRAME(cx) (*(cx)->frame)

#include "kernels/display/tone.k"

#undef sqrt
#undef abs
#undef min
#undef max

enum { WIDTH = 320, HEIGHT = 180, PIXELS = WIDTH * HEIGHT };

static const double far_off = 5e-3;      /* a pixel off by more than this has flipped at a discontinuity */
static const double most_far_off = 1e-3; /* share of pixels that may have flipped */
static const double largest_rms = 5e-5;  /* of the pixels that have not flipped */
/* Adaptive: the share of pixels that may have got another number of samples; they are left out of the rest. Scheme podee shares samples out by one sum over
 * the picture: where a path touches the light's limb, coverage differs by 1e-4 for an ulp of a ray, and that moves every later border between two pixels'
 * samples by a good part of one. More pixels then may differ, but by one sample. */
static const double most_recounted = 5e-3, most_by_one = 1e-2, most_by_more = 1e-3;
static const double most_bytes_off = 1e-3; /* share of displayed bytes that differ by more than a step */

static const struct {
    const char *name;
    mgt_quality quality;
} methods[] = {
    {"mangata", {.method = MGT_METHOD_MANGATA, .spatial_samples = 1, .time_samples = 1}},
    {"none", {.method = MGT_METHOD_NONE, .spatial_samples = 1, .time_samples = 1}},
    {"ssaa2", {.method = MGT_METHOD_SSAA, .spatial_samples = 2, .time_samples = 1, .seed = 0x123456789abcdef0}},
    {"podee-uniform", {.method = MGT_METHOD_PODEE_UNIFORM, .spatial_samples = 1, .time_samples = 1}},
    {"podee-pixel", {.method = MGT_METHOD_PODEE_PIXEL, .spatial_samples = 1, .time_samples = 1}},
    {"msaa32", {.method = MGT_METHOD_MSAA32, .spatial_samples = 1, .time_samples = 1}},
    {"lean", {.method = MGT_METHOD_LEAN, .spatial_samples = 1, .time_samples = 1}},
    {"leadr", {.method = MGT_METHOD_LEADR, .spatial_samples = 1, .time_samples = 1}},
    {"tokuyoshi", {.method = MGT_METHOD_TOKUYOSHI, .spatial_samples = 1, .time_samples = 1}},
    {"bruneton", {.method = MGT_METHOD_BRUNETON, .spatial_samples = 1, .time_samples = 1}},
    {"tndf", {.method = MGT_METHOD_TNDF, .spatial_samples = 1, .time_samples = 1}},
    {"ggx-moments", {.method = MGT_METHOD_GGX_MOMENTS, .spatial_samples = 1, .time_samples = 1}},
    {"fxaa", {.method = MGT_METHOD_FXAA, .spatial_samples = 1, .time_samples = 1}},
    {"taa", {.method = MGT_METHOD_TAA, .spatial_samples = 1, .time_samples = 1}},
    {"ssaa2 x 3", {.method = MGT_METHOD_SSAA, .spatial_samples = 2, .time_samples = 3, .seed = 7}},
    {"1 kernel", {.method = MGT_METHOD_PODEE_UNIFORM, .spatial_samples = 1, .time_samples = 1, .kernels = MGT_MIXTURE_1}},
    {"3 kernels", {.method = MGT_METHOD_PODEE_UNIFORM, .spatial_samples = 1, .time_samples = 1, .kernels = MGT_MIXTURE_3}},
    {"5 kernels", {.method = MGT_METHOD_PODEE_PIXEL, .spatial_samples = 1, .time_samples = 1, .kernels = MGT_MIXTURE_5}},
    {"9 kernels", {.method = MGT_METHOD_PODEE_UNIFORM, .spatial_samples = 1, .time_samples = 1, .kernels = MGT_MIXTURE_9}},
    {"feline", {.method = MGT_METHOD_PODEE_UNIFORM, .spatial_samples = 1, .time_samples = 1, .kernels = MGT_MIXTURE_FELINE}},
    {"riemann", {.method = MGT_METHOD_PODEE_UNIFORM, .spatial_samples = 1, .time_samples = 1, .kernels = MGT_MIXTURE_RIEMANN}},
    {"3 segments", {.method = MGT_METHOD_PODEE_PIXEL, .spatial_samples = 1, .time_samples = 1, .path_segments = 3}},
    {"adaptive", {.method = MGT_METHOD_ADAPTIVE, .spatial_samples = 1, .time_samples = 1}},
    {"adaptive podee", {.method = MGT_METHOD_ADAPTIVE, .adaptive = MGT_ADAPTIVE_PODEE, .spatial_samples = 1, .time_samples = 1}},
};
enum { METHODS = sizeof methods / sizeof *methods, VARIANTS = METHODS - 10, ADAPTIVE = METHODS - 2 };

/* Scenes with objects: every way to refract that both know, and methods that see objects each in their way. */
static const struct {
    const char *name;
    mgt_method method;
    mgt_refraction refraction;
    mgt_adaptive scheme;
} object_methods[] = {
    {"two-phase", MGT_METHOD_MANGATA, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"hybrid", MGT_METHOD_MANGATA, MGT_REFRACTION_HYBRID, MGT_ADAPTIVE_CELLS},
    {"liu", MGT_METHOD_MANGATA, MGT_REFRACTION_LIU, MGT_ADAPTIVE_CELLS},
    {"broad", MGT_METHOD_MANGATA, MGT_REFRACTION_BROAD, MGT_ADAPTIVE_CELLS},
    {"narrow", MGT_METHOD_MANGATA, MGT_REFRACTION_NARROW, MGT_ADAPTIVE_CELLS},
    {"screen-space", MGT_METHOD_MANGATA, MGT_REFRACTION_SCREEN_SPACE, MGT_ADAPTIVE_CELLS},
    {"off", MGT_METHOD_MANGATA, MGT_REFRACTION_OFF, MGT_ADAPTIVE_CELLS},
    {"none", MGT_METHOD_NONE, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"ssaa2", MGT_METHOD_SSAA, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"podee-pixel", MGT_METHOD_PODEE_PIXEL, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"lean", MGT_METHOD_LEAN, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"msaa32", MGT_METHOD_MSAA32, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"fxaa", MGT_METHOD_FXAA, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"taa", MGT_METHOD_TAA, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"adaptive", MGT_METHOD_ADAPTIVE, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_CELLS},
    {"adaptive podee", MGT_METHOD_ADAPTIVE, MGT_REFRACTION_TWO_PHASE, MGT_ADAPTIVE_PODEE},
};
enum { OBJECT_METHODS = sizeof object_methods / sizeof *object_methods, OBJECT_VARIANTS = OBJECT_METHODS - 9 };

static const int steps_off = 2;            /* a pixel off by more displayed steps than this has flipped: another triangle, another iterate */
static const double most_steps_off = 2e-3; /* share of pixels that may have flipped so */

/* What the command line asks for. */
typedef struct agreement_plan {
    const char *only; /* a method's name; NULL: all */
    bool quick;
} agreement_plan;

typedef struct layers {
    size_t pixels;
    float coverage[PIXELS], color[3 * PIXELS], samples[PIXELS], foam[PIXELS];
    unsigned char shown[4 * PIXELS];
} layers;

typedef struct difference {
    double far_share, rms;
} difference;

static difference compare(const float *a, const float *b, size_t count, size_t channels)
{
    double sum = 0;
    size_t far_count = 0, near_count = 0;
    for (size_t i = 0; i < count; i++) {
        double worst = 0, squared = 0;
        for (size_t c = 0; c < channels; c++) {
            const double d = fabs((double)a[channels * i + c] - (double)b[channels * i + c]);
            worst = d <= worst ? worst : d; /* NaN counts */
            squared += d * d;
        }
        if (worst <= far_off) {
            sum += squared;
            near_count += channels;
        } else {
            far_count++;
        }
    }
    return (difference){(double)far_count / (double)count, near_count ? sqrt(sum / (double)near_count) : 0};
}

static bool render(mgt_context *context, const mgt_scene *scene, layers *out)
{
    mgt_target targets[5];
    for (int i = 0; i < 5; i++)
        mgt_target_init(&targets[i], sizeof *targets);
    targets[0].layer = MGT_LAYER_COVERAGE, targets[0].format = MGT_FORMAT_R32F, targets[0].pixels = out->coverage;
    targets[1].format = MGT_FORMAT_RGB32F, targets[1].pixels = out->color;
    targets[2].pixels = out->shown;
    targets[3].layer = MGT_LAYER_SAMPLES, targets[3].format = MGT_FORMAT_R32F, targets[3].pixels = out->samples;
    targets[4].layer = MGT_LAYER_FOAM, targets[4].format = MGT_FORMAT_R32F, targets[4].pixels = out->foam;
    if (mgt_render(context, scene, targets, scene->foam > 0 ? 5 : 4) == MGT_OK)
        return true;
    fprintf(stderr, "gl_agreement: %s\n", mgt_last_error(context));
    return false;
}

/* Radiance to what is displayed, before rounding to bytes. */
static void display(const mgt_scene *scene, double exposure_ev, size_t pixels, float *color)
{
    const FrameData frame = {.exposure = (float)exp2(scene->post.exposure_ev + (scene->post.auto_exposure ? exposure_ev : 0))};
    const struct kernel_context cx = {.frame = &frame};
    for (size_t i = 0; i < pixels; i++) {
        float *c = color + 3 * i;
        const vec3 shown = display_color(&cx, vec3(c[0], c[1], c[2]), (int)scene->post.tone_map);
        c[0] = shown.x, c[1] = shown.y, c[2] = shown.z;
    }
}

/* Shares of pixels that have got another number of samples. */
typedef struct recounted {
    double by_one, by_more;
} recounted;

static bool counts_agree(mgt_adaptive scheme, recounted r)
{
    return scheme == MGT_ADAPTIVE_PODEE ? r.by_one <= most_by_one && r.by_more <= most_by_more : r.by_one + r.by_more <= most_recounted;
}

/* `other` gets the pixels of `reference` there. */
static recounted leave_out_recounted(const layers *reference, layers *other)
{
    size_t by_one = 0, by_more = 0;
    for (size_t i = 0; i < reference->pixels; i++) {
        const float more = fabsf(other->samples[i] - reference->samples[i]);
        if (more == 0)
            continue;
        if (more <= 1)
            by_one++;
        else
            by_more++;
        other->coverage[i] = reference->coverage[i];
        memcpy(other->color + 3 * i, reference->color + 3 * i, 3 * sizeof(float));
        memcpy(other->shown + 4 * i, reference->shown + 4 * i, 4);
    }
    return (recounted){(double)by_one / (double)reference->pixels, (double)by_more / (double)reference->pixels};
}

static bool is_near(const difference *d) { return d->far_share <= most_far_off && d->rms <= largest_rms; }

/* `foam`: NULL where there is none. */
static bool print(const char *scene, const char *method, const difference *coverage, const difference *color, const difference *foam, double bytes_off,
                  mgt_adaptive scheme, recounted samples)
{
    const bool good = counts_agree(scheme, samples) && is_near(coverage) && is_near(color) && (!foam || is_near(foam)) && bytes_off <= most_bytes_off;
    printf("%-10s %-14s %9.4f %% %9.1e %9.4f %% %9.1e %9.4f %%", scene, method, 100 * coverage->far_share, coverage->rms, 100 * color->far_share, color->rms,
           100 * bytes_off);
    if (samples.by_one > 0 || samples.by_more > 0)
        printf("%9.4f %% %9.4f %%", 100 * samples.by_one, 100 * samples.by_more);
    if (foam)
        printf("  foam %.4f %% %.1e", 100 * foam->far_share, foam->rms);
    printf("  %s\n", good ? "ok" : "MISSED");
    fflush(stdout);
    return good;
}

static bool render_bytes(mgt_context *context, const mgt_scene *scene, unsigned char *shown)
{
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.pixels = shown;
    if (mgt_render(context, scene, &target, 1) == MGT_OK)
        return true;
    fprintf(stderr, "gl_agreement: %s\n", mgt_last_error(context));
    return false;
}

/* What differs by an option, or sees objects as others do, needs one scene in four; what is no default, one in three where there is little time. */
static bool is_left_out(const agreement_plan *plan, int method, int first_variant, int scene_index)
{
    const int every = method >= first_variant ? 4 : plan->quick && method > 0 ? 3 : 1;
    return (method + scene_index) % every != 0;
}

/* Whether a sea without objects is compared by a method; `wind`: one of so many waves that other methods than the default learn nothing new. */
static bool is_compared(const agreement_plan *plan, int method, bool wind, int scene_index)
{
    if (method == 0)
        return true;
    if (method >= ADAPTIVE)
        return !plan->quick || (method > ADAPTIVE && !wind && !is_left_out(plan, method, METHODS, scene_index));
    return !wind && !is_left_out(plan, method, VARIANTS, scene_index);
}

/* Whether a row is what the command line asks for alone, or without that one of those that are compared. */
static bool is_wanted(const agreement_plan *plan, const char *name, bool compared) { return plan->only ? strcmp(plan->only, name) == 0 : compared; }

static mgt_image image_of(const agreement_plan *plan, const mgt_scene *scene)
{
    const uint32_t tenths = !plan->quick ? 10 : scene->quality.method == MGT_METHOD_MANGATA ? 5 : 3;
    return (mgt_image){.width = WIDTH * tenths / 10, .height = HEIGHT * tenths / 10};
}

static bool compare_objects(mgt_context *cpu, mgt_context *gl, const char *label, mgt_scene *scene, int scene_index, const agreement_plan *plan)
{
    static unsigned char a[4 * PIXELS], b[4 * PIXELS];
    bool all_good = true;
    for (int m = 0; m < OBJECT_METHODS; m++) {
        const bool needs_rays = object_methods[m].refraction == MGT_REFRACTION_HYBRID; /* of the CPU */
        if (!is_wanted(plan, object_methods[m].name, !is_left_out(plan, m, OBJECT_VARIANTS, scene_index)) || (needs_rays && !trace_available()))
            continue;
        mgt_quality_init(&scene->quality, sizeof scene->quality);
        scene->quality.method = object_methods[m].method;
        scene->image = image_of(plan, scene);
        const size_t pixels = (size_t)scene->image.width * scene->image.height;
        scene->quality.adaptive = object_methods[m].scheme;
        scene->quality.refraction = object_methods[m].refraction;
        scene->quality.spatial_samples = 2;
        scene->quality.tess_error = 0.05; /* both split triangles in ways of their own */
        if (!render_bytes(cpu, scene, a) || !render_bytes(gl, scene, b))
            return false;
        size_t off = 0;
        for (size_t i = 0; i < pixels; i++) {
            int worst = 0;
            for (size_t k = 0; k < 3; k++) {
                const int d = abs(a[4 * i + k] - b[4 * i + k]);
                worst = d > worst ? d : worst;
            }
            off += worst > steps_off;
        }
        const bool good = (double)off <= most_steps_off * (double)pixels;
        printf("%-10s %-14s %57.4f %%  %s\n", label, object_methods[m].name, 100.0 * (double)off / (double)pixels, good ? "ok" : "MISSED");
        fflush(stdout);
        all_good = all_good && good;
    }
    return all_good;
}

static bool compare_scene(mgt_context *cpu, mgt_context *gl, const char *path, int scene_index, sky_state *sky, const agreement_plan *plan)
{
    static layers reference, other;
    scene_error error;
    scene_file *file = scene_file_load(path, NULL, 0, &error);
    mgt_scene scene;
    if (!file || !scene_file_frame(file, 0, &scene)) {
        fprintf(stderr, "gl_agreement: %s\n", file ? path : error.text);
        scene_file_free(file);
        return false;
    }
    const char *name = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    char label[16];
    snprintf(label, sizeof label, "%.*s", (int)strcspn(name, "."), name);
    if (scene.object_count > 0) {
        const bool alike = compare_objects(cpu, gl, label, &scene, scene_index, plan);
        scene_file_free(file);
        return alike;
    }
    bool good = sky_state_build(sky, &scene.sky, &scene.light) == MGT_OK;
    bool rendered = good;
    const bool wind = scene.water.wave_count > 64;
    for (int m = 0; m < METHODS && rendered; m++) {
        if (!is_wanted(plan, methods[m].name, is_compared(plan, m, wind, scene_index)))
            continue;
        scene.quality = methods[m].quality;
        scene.image = image_of(plan, &scene);
        reference.pixels = other.pixels = (size_t)scene.image.width * scene.image.height;
        if (wind && scene.quality.method == MGT_METHOD_ADAPTIVE)
            scene.quality.samples = 1; /* each takes a software rasteriser a millisecond */
        rendered = render(cpu, &scene, &reference) && render(gl, &scene, &other);
        if (!rendered)
            break;
        const recounted samples = leave_out_recounted(&reference, &other);
        size_t bytes_off = 0;
        for (size_t i = 0; i < 4 * reference.pixels; i++)
            bytes_off += abs(reference.shown[i] - other.shown[i]) > 1;
        display(&scene, sky->exposure_ev, reference.pixels, reference.color);
        display(&scene, sky->exposure_ev, other.pixels, other.color);
        const difference coverage = compare(other.coverage, reference.coverage, reference.pixels, 1),
                         color = compare(other.color, reference.color, reference.pixels, 3);
        const difference foam = compare(other.foam, reference.foam, reference.pixels, 1);
        good = print(label, methods[m].name, &coverage, &color, scene.foam > 0 ? &foam : NULL, (double)bytes_off / (4.0 * (double)reference.pixels),
                     scene.quality.adaptive, samples) &&
               good;
    }
    scene_file_free(file);
    return good && rendered;
}

int main(int count, char **arguments)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    mgt_context *cpu = NULL, *gl = NULL;
    desc.backend = MGT_BACKEND_GL;
    const mgt_status status = mgt_context_create(&gl, &desc);
    if (status == MGT_ERROR_UNAVAILABLE) {
        printf("SKIPPED: %s\n", mgt_last_error(NULL));
        return 77;
    }
    if (status != MGT_OK || mgt_context_create(&cpu, NULL) != MGT_OK) {
        fprintf(stderr, "gl_agreement: %s\n", mgt_last_error(NULL));
        return 1;
    }
    mgt_context_info info = {.struct_size = sizeof info};
    mgt_context_get_info(gl, &info);
    printf(
        "%s\n%d x %d pixels; pixels off by more than %g, rms of the others (limits %g %%, %.0e), displayed bytes off by more than one (limit %g %%); "
        "left out and counted apart: pixels of one sample more or less, and of another number (%g %% together, podee %g and %g %%)\n\n%-25s %22s %22s %11s %22s\n",
        info.renderer, WIDTH, HEIGHT, far_off, 100 * most_far_off, largest_rms, 100 * most_bytes_off, 100 * most_recounted, 100 * most_by_one,
        100 * most_by_more, "", "coverage", "color", "bytes", "samples");
    sky_state *sky = sky_state_create();
    agreement_plan plan = {NULL, false};
    int first = 1;
    if (first < count && strcmp(arguments[first], "--quick") == 0)
        plan.quick = true, first++;
    if (first + 1 < count && strcmp(arguments[first], "--only") == 0)
        plan.only = arguments[first + 1], first += 2;
    bool good = sky != NULL && count > first;
    for (int i = first; i < count && sky; i++)
        good = compare_scene(cpu, gl, arguments[i], i - first + 1, sky, &plan) && good;
    sky_state_destroy(sky);
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
    return good ? 0 : 1;
}
