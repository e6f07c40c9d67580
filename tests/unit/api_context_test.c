/* SPDX-License-Identifier: MIT
 *
 * Contexts: what creation accepts and resolves to, errors and log messages, progress and cancelling.
 */
#include <pthread.h>

#include "api_sea.h"

typedef struct log_record {
    int count;
    mgt_log_level level;
    char id[64], text[512];
} log_record;

static void keep_log(void *user, mgt_log_level level, const char *id, const char *text)
{
    log_record *r = user;
    r->count++;
    r->level = level;
    snprintf(r->id, sizeof r->id, "%s", id);
    snprintf(r->text, sizeof r->text, "%s", text);
}

static void creation_refuses_nonsense(void **state)
{
    (void)state;
    log_record log = {0};
    mgt_context_desc good;
    mgt_context_desc_init(&good, sizeof good);
    good.log = keep_log;
    good.log_user = &log;
    assert_int_equal(mgt_context_create(NULL, &good), MGT_ERROR_ARGUMENT);
    assert_int_equal(log.level, MGT_LOG_ERROR);
    assert_string_equal(log.id, "context.create");
    assert_int_equal(mgt_context_create(NULL, NULL), MGT_ERROR_ARGUMENT);

    const struct {
        mgt_context_desc desc;
        mgt_status status;
        const char *text, *id;
    } cases[] = {
        {{.struct_size = 0}, MGT_ERROR_ARGUMENT, "struct_size", NULL},
        {{.struct_size = sizeof good - 8, .log = keep_log, .log_user = &log}, MGT_ERROR_ARGUMENT, "struct_size", NULL}, /* may not be called */
        {{.struct_size = sizeof good, .backend = (mgt_backend)4, .log = keep_log, .log_user = &log}, MGT_ERROR_ARGUMENT, "backend", "context.desc"},
        {{.struct_size = sizeof good, .backend = (mgt_backend)-1, .log = keep_log, .log_user = &log}, MGT_ERROR_ARGUMENT, "backend", "context.desc"},
        {{.struct_size = sizeof good, .isa = (mgt_isa)6, .log = keep_log, .log_user = &log}, MGT_ERROR_ARGUMENT, "isa", "context.desc"},
        {{.struct_size = sizeof good, .threads = 1025, .log = keep_log, .log_user = &log}, MGT_ERROR_ARGUMENT, "threads", "context.desc"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        memset(&log, 0, sizeof log);
        mgt_context *context = (void *)&log;
        assert_int_equal(mgt_context_create(&context, &cases[i].desc), cases[i].status);
        assert_null(context);
        assert_non_null(strstr(mgt_last_error(NULL), cases[i].text));
        assert_int_equal(log.count, cases[i].id ? 1 : 0);
        if (cases[i].id) {
            assert_string_equal(log.id, cases[i].id);
            assert_string_equal(log.text, mgt_last_error(NULL));
            assert_int_equal(log.level, MGT_LOG_ERROR);
        }
    }
    for (mgt_isa isa = MGT_ISA_SCALAR; isa <= MGT_ISA_NEON; isa++) {
        mgt_context_desc desc = good;
        desc.isa = isa;
        desc.threads = 1;
        mgt_context *context = NULL;
        const mgt_status status = mgt_context_create(&context, &desc);
        assert_int_equal(status, mgt_isa_available(isa) ? MGT_OK : MGT_ERROR_UNAVAILABLE);
        assert_int_equal(context != NULL, mgt_isa_available(isa));
        if (!context)
            assert_string_equal(log.id, "context.isa");
        mgt_context_destroy(context);
    }
    assert_true(mgt_isa_available(MGT_ISA_AUTO) && mgt_isa_available(MGT_ISA_SCALAR));
    assert_false(mgt_isa_available((mgt_isa)99));
}

/* Every call without a context leaves its own words, or none. */
static void calls_without_a_context_share_an_error(void **state)
{
    (void)state;
    mgt_context_desc bad;
    mgt_context_desc_init(&bad, sizeof bad);
    bad.threads = 1025;
    mgt_context *context = NULL;
    mgt_method_properties properties;
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    assert_int_equal(mgt_context_create(&context, &bad), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(NULL), "threads"));
    assert_int_equal(mgt_method_info((mgt_method)99, &properties, sizeof properties), MGT_ERROR_ARGUMENT);
    assert_non_null(strstr(mgt_last_error(NULL), "method 99"));
    assert_int_equal(mgt_method_info(MGT_METHOD_MANGATA, &properties, sizeof properties), MGT_OK);
    assert_string_equal(mgt_last_error(NULL), "");
    scene.struct_size = 4;
    assert_false(mgt_supports(MGT_BACKEND_CPU, &scene, MGT_LAYER_COLOR));
    assert_non_null(strstr(mgt_last_error(NULL), "struct_size"));
    assert_int_equal(mgt_sea_wave_count(NULL), 0);
    assert_null(strstr(mgt_last_error(NULL), "struct_size"));
    assert_true(strlen(mgt_last_error(NULL)) > 0);
    scene.struct_size = sizeof scene;
    assert_true(mgt_supports(MGT_BACKEND_CPU, &scene, MGT_LAYER_COLOR));
    assert_string_equal(mgt_last_error(NULL), "");
}

static void creation_resolves(void **state)
{
    (void)state;
    mgt_context *context = NULL;
    mgt_context_info info = {.struct_size = sizeof info};
    assert_int_equal(mgt_context_create(&context, NULL), MGT_OK);
    assert_string_equal(mgt_last_error(NULL), "");
    assert_string_equal(mgt_last_error(context), "");
    assert_int_equal(mgt_context_get_info(context, &info), MGT_OK);
    assert_true(info.backend == MGT_BACKEND_CPU && info.isa != MGT_ISA_AUTO && info.lanes >= 1 && info.threads >= 1);
    assert_int_equal(info.struct_size, sizeof info);
    assert_int_equal(mgt_context_get_info(NULL, &info), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_context_get_info(context, NULL), MGT_ERROR_ARGUMENT);
    info.struct_size = 4;
    assert_int_equal(mgt_context_get_info(context, &info), MGT_ERROR_ARGUMENT);
    assert_int_equal(info.struct_size, 4);
    mgt_context_destroy(context);
    mgt_context_destroy(NULL);

    log_record log = {0};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_AUTO;
    desc.isa = MGT_ISA_SCALAR;
    desc.threads = 7;
    desc.log = keep_log;
    desc.log_user = &log;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    info.struct_size = sizeof info;
    assert_int_equal(mgt_context_get_info(context, &info), MGT_OK);
    assert_true(info.backend == MGT_BACKEND_CPU || (info.backend == MGT_BACKEND_GL && !info.software));
    if (info.backend == MGT_BACKEND_CPU)
        assert_true(info.threads == 7 && info.isa == MGT_ISA_SCALAR && info.lanes == 1);
    assert_string_equal(log.id, "context.backend");
    assert_int_equal(log.level, MGT_LOG_INFO);
    mgt_context_destroy(context);
}

static void texts_are_there(void **state)
{
    (void)state;
    for (int status = -1; status <= MGT_ERROR_LOST + 1; status++)
        assert_true(strlen(mgt_status_text((mgt_status)status)) > 1);
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", MGT_VERSION_MAJOR, MGT_VERSION_MINOR, MGT_VERSION_PATCH);
    assert_string_equal(mgt_version(), version);
    assert_string_equal(MGT_VERSION_STRING, version);
}

/* Every value has a name of its own that leads back to it, and the first value without one ends the enum. */
#define NAMES(type, count)                                                                                               \
    do {                                                                                                                 \
        type value = (type)1;                                                                                            \
        assert_false(type##_from_name("", &value) || type##_from_name(NULL, &value) || type##_from_name("SUN", &value)); \
        assert_int_equal(value, 1);                                                                                      \
        assert_true(!type##_name((type)(count)) && !type##_name((type)-1));                                              \
        for (int i = 0; i < (count); i++)                                                                                \
            assert_true(type##_from_name(type##_name((type)i), &value) && (int)value == i);                              \
    } while (0)

static void enums_have_names_and_back(void **state)
{
    (void)state;
    NAMES(mgt_status, MGT_ERROR_LOST + 1);
    NAMES(mgt_backend, MGT_BACKEND_NULL + 1);
    NAMES(mgt_isa, MGT_ISA_NEON + 1);
    NAMES(mgt_log_level, MGT_LOG_ERROR + 1);
    NAMES(mgt_layer, MGT_LAYER_FOAM + 1);
    NAMES(mgt_format, MGT_FORMAT_RGBA8_SRGB + 1);
    NAMES(mgt_source, MGT_SOURCE_MOON + 1);
    NAMES(mgt_sky_model, MGT_SKY_BLACK + 1);
    NAMES(mgt_tone_map, MGT_TONE_AGX + 1);
    NAMES(mgt_method_waves, MGT_WAVES_SHUTTER + 1);
    NAMES(mgt_refraction, MGT_REFRACTION_PATH_TRACED + 1);
    mgt_refraction refraction = MGT_REFRACTION_OFF;
    assert_true(mgt_refraction_from_name("path-traced", &refraction) && refraction == MGT_REFRACTION_PATH_TRACED);
    assert_string_equal(mgt_refraction_name(refraction), "truth");
    assert_false(mgt_refraction_from_name("path-trace", &refraction) || mgt_refraction_from_name("path_traced", &refraction));
    NAMES(mgt_adaptive, MGT_ADAPTIVE_PODEE + 1);
    NAMES(mgt_pattern, MGT_PATTERN_STRIPES + 1);
    NAMES(mgt_gl_color, MGT_GL_COLOR_DISPLAY + 1);
    mgt_method_properties p;
    int methods = 0;
    for (; mgt_method_info((mgt_method)methods, &p, sizeof p) == MGT_OK; methods++)
        assert_true(mgt_method_name((mgt_method)methods) == p.name);
    NAMES(mgt_method, methods);
    static const mgt_mixture kernels[] = {MGT_MIXTURE_EXACT, MGT_MIXTURE_1,      MGT_MIXTURE_3,      MGT_MIXTURE_5,
                                          MGT_MIXTURE_9,     MGT_MIXTURE_FELINE, MGT_MIXTURE_RIEMANN};
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++) {
        mgt_mixture value;
        assert_true(mgt_mixture_from_name(mgt_mixture_name(kernels[i]), &value) && value == kernels[i]);
    }
    assert_null(mgt_mixture_name((mgt_mixture)2));
    assert_true(mgt_layer_channels(MGT_LAYER_NORMAL) == 3 && mgt_layer_channels(MGT_LAYER_DEPTH) == 1 && mgt_layer_channels((mgt_layer)99) == 0);
}

/* Errors are logged once, under a stable id, with the text of mgt_last_error(); the next success clears it. */
static void render_errors_are_logged(void **state)
{
    (void)state;
    log_record log = {0};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.log = keep_log;
    desc.log_user = &log;
    desc.threads = 1;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    log.count = 0;
    static float pixels[SEA_WIDTH * SEA_HEIGHT];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, pixels, 0);
    scene.shutter = -1;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_ERROR_SCENE);
    assert_int_equal(log.count, 1);
    assert_string_equal(log.id, "render.scene");
    assert_string_equal(log.text, mgt_last_error(context));
    scene.shutter = 0;
    target.format = MGT_FORMAT_RGB32F;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(log.count, 2);
    assert_string_equal(log.id, "render.target");
    target.format = MGT_FORMAT_R32F;
    assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_OK);
    assert_string_equal(mgt_last_error(context), "");
    mgt_context_destroy(context);
}

typedef struct progress_record {
    int calls, stop_after;
    double last;
    bool in_order;
} progress_record;

static bool keep_progress(void *user, double fraction)
{
    progress_record *p = user;
    p->in_order = p->in_order && fraction >= p->last && fraction >= 0 && fraction <= 1;
    p->last = fraction;
    return ++p->calls != p->stop_after;
}

/* A frame long enough to be asked about several times; stopping it leaves a context that renders as before. */
static void progress_can_cancel(void **state)
{
    (void)state;
    static float pixels[SEA_WIDTH * SEA_HEIGHT], before[SEA_WIDTH * SEA_HEIGHT];
    log_record log = {0};
    progress_record progress = {.in_order = true};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = 2;
    desc.log = keep_log;
    desc.log_user = &log;
    desc.progress = keep_progress;
    desc.progress_user = &progress;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels, 0);
    sea_render(context, &scene, &target, 1);
    memcpy(before, pixels, sizeof before);

    mgt_scene slow = scene;
    slow.quality = (mgt_quality){.method = MGT_METHOD_REFERENCE, .spatial_samples = 128, .time_samples = 64};
    progress = (progress_record){.in_order = true, .stop_after = 2};
    assert_int_equal(mgt_render(context, &slow, &target, 1), MGT_CANCELLED);
    assert_true(progress.in_order && progress.calls >= 2);
    assert_string_equal(log.id, "render.cancelled");
    assert_int_equal(log.level, MGT_LOG_INFO); /* it was asked for */
    assert_string_equal(log.text, mgt_last_error(context));

    slow.quality = (mgt_quality){.method = MGT_METHOD_SSAA, .spatial_samples = 32, .time_samples = 4};
    progress = (progress_record){.in_order = true, .stop_after = 1};
    assert_int_equal(mgt_render(context, &slow, &target, 1), MGT_CANCELLED);

    progress = (progress_record){.in_order = true};
    sea_render(context, &scene, &target, 1);
    assert_memory_equal(pixels, before, sizeof before);
    assert_true(progress.in_order);
    mgt_context_destroy(context);
}

/* What a callback gets from the context that calls it. */
typedef struct inner_calls {
    mgt_context *context;
    mgt_scene scene;
    mgt_target target;
    mgt_pixel_info info;
    int calls, refused;
} inner_calls;

static bool call_again(void *user, double fraction)
{
    inner_calls *inner = user;
    (void)fraction;
    inner->calls += 4;
    inner->refused += mgt_render(inner->context, &inner->scene, &inner->target, 1) == MGT_ERROR_ARGUMENT;
    inner->refused += mgt_inspect_pixel(inner->context, &inner->scene, 0, 0, &inner->info) == MGT_ERROR_ARGUMENT;
    inner->refused += mgt_display(inner->context, &inner->scene, inner->target.pixels, &inner->target) == MGT_ERROR_ARGUMENT;
    inner->refused += mgt_sum_samples(inner->context, &inner->scene, NULL) == MGT_ERROR_ARGUMENT;
    return true;
}

/* A callback's calls are refused, and change nothing of the frame around them. */
static void a_context_in_use_is_refused(void **state)
{
    (void)state;
    static float pixels[SEA_WIDTH * SEA_HEIGHT], inner_pixels[SEA_WIDTH * SEA_HEIGHT], alone[SEA_WIDTH * SEA_HEIGHT];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality = (mgt_quality){.method = MGT_METHOD_REFERENCE, .spatial_samples = 8, .time_samples = 8};
    inner_calls inner = {.scene = scene, .info = {.struct_size = sizeof inner.info}};
    inner.target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, inner_pixels, 0);
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.threads = 2;
    desc.progress = call_again;
    desc.progress_user = &inner;
    assert_int_equal(mgt_context_create(&inner.context, &desc), MGT_OK);
    mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels, 0);
    sea_render(inner.context, &scene, &target, 1);
    assert_true(inner.calls > 0 && inner.refused == inner.calls);
    mgt_context_destroy(inner.context);
    mgt_context *context = sea_context(1, MGT_ISA_AUTO);
    target.pixels = alone;
    sea_render(context, &scene, &target, 1);
    mgt_context_destroy(context);
    assert_memory_equal(pixels, alone, sizeof alone);
}

/* One of four threads that share a context. */
static void *share_context(void *user)
{
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    static _Thread_local float pixels[SEA_WIDTH * SEA_HEIGHT];
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, pixels, 0);
    for (int i = 0; i < 20; i++) {
        const mgt_status status = mgt_render(user, &scene, &target, 1);
        if (status != MGT_OK && status != MGT_ERROR_ARGUMENT)
            return user;
    }
    return NULL;
}

static void threads_do_not_share_a_context(void **state)
{
    (void)state;
    mgt_context *context = sea_context(2, MGT_ISA_AUTO);
    pthread_t threads[4];
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, share_context, context), 0);
    for (int i = 0; i < 4; i++) {
        void *failed = context;
        assert_int_equal(pthread_join(threads[i], &failed), 0);
        assert_null(failed);
    }
    mgt_context_destroy(context);
}

/* A host's mistakes that no status can answer. */
static void missing_pointers_do_nothing(void **state)
{
    (void)state;
    uint64_t sums[MGT_SUM_WORDS] = {1};
    mgt_method method = MGT_METHOD_NONE;
    mgt_scene scene;
    mgt_sums_add(NULL, sums, 1);
    mgt_sums_add(sums, NULL, 1);
    assert_int_equal(sums[0], 1);
    assert_false(mgt_method_from_name(NULL, &method));
    assert_false(mgt_method_from_name("none", NULL));
    assert_false(mgt_layer_from_name("color", NULL));
    assert_false(mgt_refraction_from_name("liu", NULL));
    assert_false(mgt_mixture_from_name("exact", NULL));
    memset(&scene, 7, sizeof scene);
    mgt_scene_init(&scene, SIZE_MAX);
    mgt_quality_init(&scene.quality, SIZE_MAX);
    assert_int_equal(((unsigned char *)&scene)[0], 7);
    assert_int_equal(((unsigned char *)&scene.quality)[0], 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(creation_refuses_nonsense),
        cmocka_unit_test(calls_without_a_context_share_an_error),
        cmocka_unit_test(creation_resolves),
        cmocka_unit_test(texts_are_there),
        cmocka_unit_test(enums_have_names_and_back),
        cmocka_unit_test(render_errors_are_logged),
        cmocka_unit_test(progress_can_cancel),
        cmocka_unit_test(a_context_in_use_is_refused),
        cmocka_unit_test(threads_do_not_share_a_context),
        cmocka_unit_test(missing_pointers_do_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
