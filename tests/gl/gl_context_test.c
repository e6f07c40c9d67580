/* SPDX-License-Identifier: MIT
 *
 * The OpenGL backend behind the API: creation, layers, formats, crops, sources, refusals, and textures of a host. What a host's framebuffer
 * sees is in tests/host, how far pictures are from the CPU's on whole scenes in gl_agreement.
 */
#include "gl_sea.h"

#include <dlfcn.h>

#include "gl/gl_sources.h"
#include "mangata/gl.h"

typedef struct log_record {
    int count;
    char last_id[64], ids[1024], text[512];
} log_record;

static void keep_log(void *user, mgt_log_level level, const char *id, const char *text)
{
    (void)level;
    log_record *r = user;
    r->count++;
    snprintf(r->last_id, sizeof r->last_id, "%s", id);
    snprintf(r->ids + strlen(r->ids), sizeof r->ids - strlen(r->ids), "%s ", id);
    snprintf(r->text, sizeof r->text, "%s", text);
}

static mgt_context_info info_of(const mgt_context *context)
{
    mgt_context_info info = {.struct_size = sizeof info};
    assert_int_equal(mgt_context_get_info(context, &info), MGT_OK);
    return info;
}

/* ---- creation ---- */

static void creation_says_what_runs(void **state)
{
    (void)state;
    log_record log = {0};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.log = keep_log;
    desc.log_user = &log;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    const mgt_context_info info = info_of(context);
    assert_int_equal(info.backend, MGT_BACKEND_GL);
    assert_true(strlen(info.renderer) > 4);
    assert_int_equal(info.software, strstr(log.ids, "context.software") != NULL);
    print_message("  %s\n", info.renderer);
    mgt_context_destroy(context);

    desc.gl_device = 1000;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_ERROR_UNAVAILABLE);
    assert_null(context);
    assert_string_equal(log.last_id, "context.device");
    assert_non_null(strstr(mgt_last_error(NULL), "there is no OpenGL device 1000"));
}

/* What OpenGL does not render comes from the CPU, which the log says once a method; mgt_supports() knows it before. */
static void the_cpus_frames_are_announced(void **state)
{
    (void)state;
    static float samples[SEA_WIDTH * SEA_HEIGHT];
    log_record log = {0};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.log = keep_log;
    desc.log_user = &log;
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    const mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, samples, 0), spent = sea_target(MGT_LAYER_SAMPLES, MGT_FORMAT_R32F, samples, 0);
    const struct {
        mgt_method method;
        const mgt_target *target;
        bool gl, announced;
    } cases[] = {{MGT_METHOD_NONE, &target, true, false},      {MGT_METHOD_NONE, &spent, true, false},        {MGT_METHOD_REFERENCE, &target, false, true},
                 {MGT_METHOD_REFERENCE, &spent, false, false}, {MGT_METHOD_REFERENCE, &target, false, false}, {MGT_METHOD_NONE, &target, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        scene.quality.method = cases[i].method;
        log.ids[0] = 0;
        assert_int_equal(mgt_supports(MGT_BACKEND_GL, &scene, cases[i].target->layer), cases[i].gl);
        assert_true(mgt_supports(MGT_BACKEND_CPU, &scene, cases[i].target->layer) && mgt_supports(MGT_BACKEND_AUTO, &scene, cases[i].target->layer));
        sea_render(context, &scene, cases[i].target, 1);
        assert_int_equal(strstr(log.ids, "render.cpu") != NULL, cases[i].announced);
    }
    mgt_context_destroy(context);

    /* Sums are the CPU's as well. */
    static uint64_t sums[SEA_WIDTH * SEA_HEIGHT * MGT_SUM_WORDS];
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    scene.quality.method = MGT_METHOD_REFERENCE;
    for (int i = 0; i < 2; i++) {
        log.ids[0] = 0;
        assert_int_equal(mgt_sum_samples(context, &scene, sums), MGT_OK);
        assert_int_equal(strstr(log.ids, "render.cpu") != NULL, i == 0);
    }
    assert_false(mgt_supports(MGT_BACKEND_CPU, &scene, (mgt_layer)99) || mgt_supports((mgt_backend)9, &scene, MGT_LAYER_COLOR));
    scene.image.width = 0;
    assert_false(mgt_supports(MGT_BACKEND_CPU, &scene, MGT_LAYER_COLOR) || mgt_supports(MGT_BACKEND_CPU, NULL, MGT_LAYER_COLOR));
    mgt_context_destroy(context);
}

/* AUTO takes OpenGL by hardware only, and says what it took. */
static void automatic_choice(void **state)
{
    (void)state;
    mgt_context *gl = gl_context(), *context = NULL;
    const bool software = info_of(gl).software;
    mgt_context_destroy(gl);
    log_record log = {0};
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_AUTO;
    desc.log = keep_log;
    desc.log_user = &log;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    assert_int_equal(info_of(context).backend, software ? MGT_BACKEND_CPU : MGT_BACKEND_GL);
    assert_string_equal(log.last_id, "context.backend");
    assert_int_equal(log.count, 1);
    assert_string_equal(mgt_last_error(context), "");
    mgt_context_destroy(context);
}

static const char *const functions[] = {
#define GL_NAME(TYPE, name) "gl" #name,
    GL_FUNCTIONS(GL_NAME)
#undef GL_NAME
};
static const char *missing; /* the function that an old OpenGL lacks */

static mgt_gl_function without_one(const char *name) { return strcmp(name, missing) == 0 ? NULL : gl_egl_get_proc(name); }

/* Each function of the table is missing in turn. */
static void incomplete_hosts_are_refused(void **state)
{
    (void)state;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_get_proc = without_one;
    mgt_context *context = NULL;
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        char lacks[80];
        missing = functions[i];
        snprintf(lacks, sizeof lacks, "lacks %s;", missing);
        assert_int_equal(mgt_context_create(&context, &desc), MGT_ERROR_UNAVAILABLE);
        assert_null(context);
        assert_non_null(strstr(mgt_last_error(NULL), lacks));
    }
    desc.gl_get_proc = gl_egl_get_proc; /* every function, and no context that is current */
    assert_int_equal(mgt_context_create(&context, &desc), MGT_ERROR_UNAVAILABLE);
    assert_null(context);
    assert_non_null(strstr(mgt_last_error(NULL), "no OpenGL context is current on this thread"));
}

/* ---- a host's errors, and a context that is lost ---- */

/* A context in the host's own, whose log ids are kept. */
static mgt_context_desc logged_desc(mgt_gl_get_proc get_proc, log_record *log)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_get_proc = get_proc;
    desc.log = keep_log;
    desc.log_user = log;
    return desc;
}

/* The host's own error is no failure of creation; the log tells it. */
static void pending_errors_are_cleared(void **state)
{
    (void)state;
    gl_host h;
    gl_host_start(&h);
    log_record log = {0};
    const mgt_context_desc desc = logged_desc(gl_egl_get_proc, &log);
    mgt_context *context = NULL;
    h.gl.Enable(0xdead);
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    assert_non_null(strstr(log.ids, "gl.host "));
    assert_int_equal(h.gl.GetError(), GL_NO_ERROR);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

static gl_host lossy;       /* a host whose context gets lost: then its functions do nothing */
static bool lost, tells;    /* `tells`: as long as glGetGraphicsResetStatus() says so; GL_CONTEXT_LOST tells it as well */
static int calls_when_lost; /* questions about the host's state, and changes to it */

static GLenum APIENTRY lost_status(void) { return lost && tells ? GL_INNOCENT_CONTEXT_RESET : GL_NO_ERROR; }

static GLenum APIENTRY lost_error(void)
{
    static int turn;
    return !lost ? lossy.gl.GetError() : ++turn % 3 ? GL_CONTEXT_LOST : GL_NO_ERROR;
}

static void APIENTRY lost_get_integer(GLenum name, GLint *out)
{
    calls_when_lost += lost;
    if (!lost)
        lossy.gl.GetIntegerv(name, out);
}

static void APIENTRY lost_bind_buffer(GLenum target, GLuint buffer)
{
    calls_when_lost += lost;
    if (!lost)
        lossy.gl.BindBuffer(target, buffer);
}

static mgt_gl_function lossy_get_proc(const char *name)
{
    static const struct {
        const char *name;
        mgt_gl_function function;
    } own[] = {{"glGetGraphicsResetStatus", (mgt_gl_function)lost_status},
               {"glGetError", (mgt_gl_function)lost_error},
               {"glGetIntegerv", (mgt_gl_function)lost_get_integer},
               {"glBindBuffer", (mgt_gl_function)lost_bind_buffer}};
    for (size_t i = 0; i < sizeof own / sizeof *own; i++)
        if (strcmp(own[i].name, name) == 0)
            return own[i].function;
    return gl_egl_get_proc(name);
}

/* Calls say so, ask a lost context for nothing that it does not answer, and blame nobody. */
static void lost_contexts_are_told(void **state)
{
    (void)state;
    gl_host_start(&lossy);
    log_record log = {0};
    const mgt_context_desc desc = logged_desc(lossy_get_proc, &log);
    mgt_context *context = NULL;
    assert_int_equal(mgt_context_create(&context, &desc), MGT_OK);
    static float pixels[PIXELS];
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    const mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, pixels, 0);
    sea_render(context, &scene, &target, 1);
    for (int i = 0; i < 2; i++) {
        lost = true;
        tells = i == 0;
        log.ids[0] = 0;
        calls_when_lost = 0;
        assert_int_equal(mgt_render(context, &scene, &target, 1), MGT_ERROR_LOST);
        assert_int_equal(mgt_gl_set_sources(context, NULL, 0), MGT_ERROR_LOST);
        assert_non_null(strstr(mgt_last_error(context), "create a new context"));
        assert_int_equal(calls_when_lost, 0);
        assert_null(strstr(log.ids, "gl.host"));
        lost = false;
        sea_render(context, &scene, &target, 1);
    }
    mgt_context_destroy(context);
    gl_host_stop(&lossy);
}

/* ---- layers ---- */

static void expect_same_layers(const layers *a, const layers *b)
{
    expect_same("color", a->color, b->color, PIXELS * 3, 5e-3);
    expect_same("coverage", a->coverage, b->coverage, PIXELS, 5e-3);
    expect_same("mask", a->mask, b->mask, PIXELS, 1e-3);
    expect_same("depth", a->depth, b->depth, PIXELS, 2e-3);
    expect_same("normal", a->normal, b->normal, PIXELS * 3, 5e-3);
    size_t off = 0;
    for (size_t i = 0; i < sizeof a->shown; i++)
        off += abs(a->shown[i] - b->shown[i]) > 1;
    if (off > sizeof a->shown / 200)
        fail_msg("displayed color: %zu of %zu values differ", off, sizeof a->shown);
    for (size_t i = 0; i < PIXELS; i++) {
        assert_memory_equal(a->color4 + 4 * i, a->color + 3 * i, 3 * sizeof(float));
        assert_memory_equal(a->normal4 + 4 * i, a->normal + 3 * i, 3 * sizeof(float));
        assert_true(a->color4[4 * i + 3] == 1 && a->normal4[4 * i + 3] == 1 && a->shown[4 * i + 3] == 255);
    }
}

/* Every method; podee-* also with kernels and a path of several pieces. */
enum { QUALITIES = SEA_METHODS + SEA_BASELINES + 3 };

static mgt_quality quality_of(const mgt_scene *scene, int i)
{
    static const mgt_mixture kernels[] = {MGT_MIXTURE_5, MGT_MIXTURE_FELINE, MGT_MIXTURE_RIEMANN};
    mgt_quality q = scene->quality;
    if (i < SEA_METHODS) {
        q.method = sea_methods[i].method;
        q.adaptive = sea_methods[i].adaptive;
    } else if (i < SEA_METHODS + SEA_BASELINES) {
        q.method = sea_baselines[i - SEA_METHODS];
    } else {
        q.method = i % 2 ? MGT_METHOD_PODEE_UNIFORM : MGT_METHOD_PODEE_PIXEL;
        q.kernels = kernels[i - SEA_METHODS - SEA_BASELINES];
        q.path_segments = (uint32_t)(i - SEA_METHODS - SEA_BASELINES + 1);
    }
    return q;
}

/* Every method, layer and format, with a camera that rests and one that moves. */
static void layers_are_those_of_the_cpu(void **state)
{
    (void)state;
    static layers expected, got;
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.frame_interval = 0.01;
    const mgt_scene still = scene;
    mgt_context *gl = gl_context(), *cpu = sea_context(2, MGT_ISA_AUTO);
    for (int moves = 0; moves < 2; moves++)
        for (int m = MGT_SANITIZED * moves; m < QUALITIES; m += 1 + MGT_SANITIZED) {
            scene.camera_moves = moves;
            scene.camera_open.position[0] = -0.05;
            scene.quality = quality_of(&still, m);
            render_all(cpu, &scene, &expected);
            render_all(gl, &scene, &got);
            expect_same_layers(&got, &expected);
            if (!mgt_supports(MGT_BACKEND_GL, &scene, MGT_LAYER_COLOR)) /* the same code */
                assert_memory_equal(&got, &expected, sizeof got);
        }
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
}

/* The same bytes again, after other frames, and within a crop. */
static void crops_are_parts_of_the_whole(void **state)
{
    (void)state;
    static layers whole, again;
    static float part[PIXELS];
    static unsigned char shown[PIXELS * 4];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *gl = gl_context();
    enum { X = 35, Y = 17, W = 40, H = 26 };
    static const mgt_method methods[] = {MGT_METHOD_MANGATA, MGT_METHOD_MSAA32, MGT_METHOD_BRUNETON, MGT_METHOD_FXAA, MGT_METHOD_TAA};
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        scene.quality.method = methods[m];
        render_all(gl, &scene, &whole);
        mgt_scene crop = scene;
        crop.image.crop_x = X, crop.image.crop_y = Y, crop.image.crop_width = W, crop.image.crop_height = H;
        const mgt_target targets[] = {sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, part, 0), sea_target(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, shown, 0)};
        sea_render(gl, &crop, targets, 1); /* alone: rendered as small as it is */
        for (size_t y = 0; y < H; y++)
            assert_memory_equal(part + y * W, whole.coverage + (y + Y) * SEA_WIDTH + X, W * sizeof(float));
        sea_render(gl, &crop, targets, 2); /* with glare: cut out of the whole picture */
        for (size_t y = 0; y < H; y++) {
            assert_memory_equal(part + y * W, whole.coverage + (y + Y) * SEA_WIDTH + X, W * sizeof(float));
            assert_memory_equal(shown + y * W * 4, whole.shown + ((y + Y) * SEA_WIDTH + X) * 4, W * 4);
        }
        render_all(gl, &scene, &again);
        assert_memory_equal(&again, &whole, sizeof again);
    }
    mgt_context_destroy(gl);
}

static void strides_are_kept(void **state)
{
    (void)state;
    enum { PITCH = SEA_WIDTH + 5 };
    static float tight[PIXELS], loose[PITCH * SEA_HEIGHT];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *gl = gl_context();
    for (size_t i = 0; i < sizeof loose / sizeof *loose; i++)
        loose[i] = -7;
    const ptrdiff_t stride = PITCH * sizeof(float);
    const mgt_target targets[] = {sea_target(MGT_LAYER_DEPTH, MGT_FORMAT_R32F, tight, 0),
                                  sea_target(MGT_LAYER_DEPTH, MGT_FORMAT_R32F, loose + PITCH * (SEA_HEIGHT - 1), -stride)};
    sea_render(gl, &scene, targets, 2);
    for (size_t y = 0; y < SEA_HEIGHT; y++) {
        const float *row = loose + PITCH * (SEA_HEIGHT - 1 - y);
        assert_memory_equal(row, tight + SEA_WIDTH * y, SEA_WIDTH * sizeof(float));
        for (size_t x = SEA_WIDTH; x < PITCH; x++)
            assert_true(row[x] == -7);
    }
    mgt_context_destroy(gl);
}

/* Two halves of the samples have the whole's mean. */
static void sample_ranges_add_up(void **state)
{
    (void)state;
    static float whole[PIXELS], half[2][PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality = (mgt_quality){.method = MGT_METHOD_SSAA, .spatial_samples = 3, .time_samples = 2, .seed = 5};
    mgt_context *gl = gl_context();
    mgt_target target = sea_target(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, whole, 0);
    sea_render(gl, &scene, &target, 1);
    for (int i = 0; i < 2; i++) {
        scene.quality.sample_first = i ? 7 : 0;
        scene.quality.sample_count = i ? 0 : 7;
        target.pixels = half[i];
        sea_render(gl, &scene, &target, 1);
    }
    for (size_t i = 0; i < PIXELS; i++)
        assert_true(fabs((double)whole[i] - (7 * (double)half[0][i] + 11 * (double)half[1][i]) / 18) < 1e-5);
    mgt_context_destroy(gl);
}

/* ---- refusals ---- */

static void large_pictures_are_refused(void **state)
{
    (void)state;
    static float pixels[PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves), large = scene;
    mgt_context *gl = gl_context();
    large.image = (mgt_image){.width = MGT_MAX_IMAGE_SIDE, .height = 2};
    float *much = calloc((size_t)MGT_MAX_IMAGE_SIDE * 2, sizeof *much);
    assert_non_null(much);
    mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, much, 0);
    for (int adapts = 0; adapts < 2; adapts++) { /* adaptive has memory of its own for its layers */
        large.quality.method = adapts ? MGT_METHOD_ADAPTIVE : scene.quality.method;
        const mgt_status status = mgt_render(gl, &large, &target, 1);
        if (status == MGT_OK) /* an OpenGL with textures that large renders it */
            continue;
        assert_int_equal(status, MGT_ERROR_UNSUPPORTED);
        assert_non_null(strstr(mgt_last_error(gl), "32768 x 2"));
    }
    free(much);
    target.pixels = pixels;
    sea_render(gl, &scene, &target, 1);
    mgt_context_destroy(gl);
}

static bool stop_at_once(void *user, double fraction)
{
    int *calls = user;
    assert_true(fraction >= 0 && fraction <= 1);
    return ++*calls < 2;
}

static void rendering_can_be_cancelled(void **state)
{
    (void)state;
    static float pixels[PIXELS];
    int calls = 0;
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.progress = stop_at_once;
    desc.progress_user = &calls;
    mgt_context *gl = NULL;
    assert_int_equal(mgt_context_create(&gl, &desc), MGT_OK);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    scene.quality = (mgt_quality){.method = MGT_METHOD_SSAA, .spatial_samples = 32, .time_samples = 8};
    const mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, pixels, 0);
    assert_int_equal(mgt_render(gl, &scene, &target, 1), MGT_CANCELLED);
    assert_int_equal(calls, 2);
    calls = -1000;
    scene.quality.method = MGT_METHOD_MANGATA;
    sea_render(gl, &scene, &target, 1);
    mgt_context_destroy(gl);
}

/* ---- sources ---- */

/* Replaced texts show at once; a broken one is named with its line and changes nothing. */
static void sources_can_be_replaced(void **state)
{
    (void)state;
    static float before[PIXELS], after[PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_context *gl = gl_context(), *cpu = sea_context(1, MGT_ISA_AUTO);
    mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, before, 0);
    sea_render(gl, &scene, &target, 1);
    target.pixels = after;

    const char *broken = "/* broken */\n#include \"math.k\"\nKERNEL real broken(CTX cx, real x) { return x +; }\n";
    const struct {
        mgt_gl_source source;
        mgt_status status;
        const char *text;
    } refused[] = {
        {{"tone.k", broken}, MGT_ERROR_UNAVAILABLE, "tone.k:3:"}, {{"glitter.k", "#include \"nowhere.k\"\n"}, MGT_ERROR_UNAVAILABLE, "glitter.k"},
        {{"no_such.k", "\n"}, MGT_ERROR_ARGUMENT, "no_such.k"},   {{NULL, "\n"}, MGT_ERROR_ARGUMENT, "NULL"},
        {{"tone.k", NULL}, MGT_ERROR_ARGUMENT, "NULL"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        assert_int_equal(mgt_gl_set_sources(gl, &refused[i].source, 1), refused[i].status);
        if (!strstr(mgt_last_error(gl), refused[i].text))
            fail_msg("'%s' does not name %s", mgt_last_error(gl), refused[i].text);
        sea_render(gl, &scene, &target, 1);
        assert_memory_equal(after, before, sizeof after);
    }
    assert_int_equal(mgt_gl_set_sources(gl, NULL, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_gl_set_sources(cpu, NULL, 0), MGT_ERROR_UNAVAILABLE);
    assert_int_equal(mgt_gl_set_sources(NULL, NULL, 0), MGT_ERROR_ARGUMENT);

    const mgt_gl_source shade =
        {"shade.glsl", "layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;\nlayout(binding = 2) writeonly uniform image2D water_image;\n"
                       "void main()\n{\n    TilePixel p = tile_pixel();\n    if (p.inside)\n        imageStore(water_image, p.texel, vec4(0.25));\n}\n"};
    assert_int_equal(mgt_gl_set_sources(gl, &shade, 1), MGT_OK);
    sea_render(gl, &scene, &target, 1);
    for (size_t i = 0; i < PIXELS; i++)
        assert_true(after[i] == 0.25f);
    assert_int_equal(mgt_gl_set_sources(gl, NULL, 0), MGT_OK);
    sea_render(gl, &scene, &target, 1);
    assert_memory_equal(after, before, sizeof after);
    mgt_context_destroy(gl);
    mgt_context_destroy(cpu);
}

/* Whatever the driver's way of saying it, a message names the kernel file and its line. */
static void messages_name_the_file(void **state)
{
    (void)state;
    const gl_replacements none = {0};
    gl_source source;
    assert_true(gl_source_assemble(&source, &none, "shade_slopes.comp", "glitter.k", "#define NOTHING\n"));
    assert_ptr_equal(strstr(source.text, "#version 450 core\n#define NOTHING\n#line 1 1\n"), source.text);
    assert_null(strstr(source.text, "#include"));
    assert_null(strstr(source.text, "#pragma"));
    int glitter = 0;
    for (int i = 0; i < source.file_count; i++)
        glitter = strcmp(source.files[i], "glitter.k") == 0 ? i : glitter;
    assert_true(glitter > 0);
    static const char *const forms[] = {"%d:12(5): error: `x' undeclared\n", "%d(12) : error C1503: undefined variable\n",
                                        "ERROR: %d:12: 'x' : undeclared identifier\n", "1:3(1): warning: something else\n%d:12(5): error: `x' undeclared\n"};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        char log[128], text[128];
        snprintf(log, sizeof log, forms[i], glitter);
        gl_source_explain(&source, log, text, sizeof text);
        if (strncmp(text, "glitter.k:12: ", 14) != 0 || strlen(text) < 24 || strchr(text, '\n'))
            fail_msg("'%s' became '%s'", log, text);
    }
    char text[64];
    gl_source_explain(&source, "internal error\nand more", text, sizeof text);
    assert_string_equal(text, "internal error");
    gl_source_free(&source);
}

/* ---- a host ---- */

static mgt_gl_texture host_texture(const gl_host *h, mgt_layer layer, GLenum format, int width, int height)
{
    mgt_gl_texture t;
    mgt_gl_texture_init(&t, sizeof t);
    t.layer = layer;
    h->gl.CreateTextures(GL_TEXTURE_2D, 1, &t.texture);
    h->gl.TextureStorage2D(t.texture, 1, format, width, height);
    return t;
}

static void read_texture(const gl_host *h, GLuint texture, GLenum format, GLenum type, size_t size, void *out)
{
    h->gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
    h->gl.GetTextureSubImage(texture, 0, 0, 0, 0, SEA_WIDTH, SEA_HEIGHT, 1, format, type, (GLsizei)size, out);
}

static void textures_hold_the_layers(void **state)
{
    (void)state;
    static layers expected, got;
    gl_host h;
    gl_host_start(&h);
    mgt_context *context = gl_context_of(gl_egl_get_proc);
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    mgt_gl_texture t[] = {
        host_texture(&h, MGT_LAYER_COLOR, GL_RGBA32F, SEA_WIDTH, SEA_HEIGHT), host_texture(&h, MGT_LAYER_COLOR, GL_RGBA8, SEA_WIDTH, SEA_HEIGHT),
        host_texture(&h, MGT_LAYER_COVERAGE, GL_R32F, SEA_WIDTH, SEA_HEIGHT), host_texture(&h, MGT_LAYER_MASK, GL_R16F, SEA_WIDTH, SEA_HEIGHT),
        host_texture(&h, MGT_LAYER_DEPTH, GL_R32F, SEA_WIDTH, SEA_HEIGHT),    host_texture(&h, MGT_LAYER_NORMAL, GL_RGBA16F, SEA_WIDTH, SEA_HEIGHT),
    };
    enum { TEXTURES = sizeof t / sizeof *t };
    for (int m = 0; m < QUALITIES; m += 1 + MGT_SANITIZED) {
        mgt_scene drawn = scene;
        drawn.quality = quality_of(&scene, m);
        if (!mgt_supports(MGT_BACKEND_GL, &drawn, MGT_LAYER_COLOR))
            continue;
        render_all(context, &drawn, &expected);
        if (mgt_gl_render_textures(context, &drawn, t, TEXTURES) != MGT_OK)
            fail_msg("%s", mgt_last_error(context));
        assert_int_equal(h.gl.GetError(), GL_NO_ERROR);
        read_texture(&h, t[0].texture, GL_RGBA, GL_FLOAT, sizeof got.color4, got.color4);
        read_texture(&h, t[1].texture, GL_RGBA, GL_UNSIGNED_BYTE, sizeof got.shown, got.shown);
        read_texture(&h, t[2].texture, GL_RED, GL_FLOAT, sizeof got.coverage, got.coverage);
        read_texture(&h, t[3].texture, GL_RED, GL_FLOAT, sizeof got.mask, got.mask);
        read_texture(&h, t[4].texture, GL_RED, GL_FLOAT, sizeof got.depth, got.depth);
        read_texture(&h, t[5].texture, GL_RGBA, GL_FLOAT, sizeof got.normal4, got.normal4);
        assert_memory_equal(got.color4, expected.color4, sizeof got.color4);
        assert_memory_equal(got.shown, expected.shown, sizeof got.shown);
        assert_memory_equal(got.coverage, expected.coverage, sizeof got.coverage);
        assert_memory_equal(got.depth, expected.depth, sizeof got.depth);
        assert_int_equal(count_off(got.mask, expected.mask, PIXELS, 1e-3), 0);
        assert_int_equal(count_off(got.normal4, expected.normal4, PIXELS * 4, 1e-3), 0);
    }

    mgt_gl_timing timings[16];
    const size_t count = mgt_gl_get_timings(context, timings, 16);
    bool shaded = false;
    for (size_t i = 0; i < count; i++)
        shaded = shaded || (strcmp(timings[i].name, "shade") == 0 && timings[i].seconds > 0 && timings[i].seconds < 60);
    assert_true(shaded);
    assert_int_equal(mgt_gl_get_timings(context, NULL, 0), count);
    assert_int_equal(mgt_gl_get_timings(NULL, timings, 16), 0);
    for (int i = 0; i < TEXTURES; i++)
        h.gl.DeleteTextures(1, &t[i].texture);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

static void wrong_textures_are_refused(void **state)
{
    (void)state;
    gl_host h;
    gl_host_start(&h);
    mgt_context *context = gl_context_of(gl_egl_get_proc);
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_gl_texture good = host_texture(&h, MGT_LAYER_COLOR, GL_RGBA16F, SEA_WIDTH, SEA_HEIGHT);
    enum { WRONG = 9 };
    mgt_gl_texture changed[WRONG];
    for (size_t i = 0; i < WRONG; i++)
        changed[i] = good;
    changed[0].layer = MGT_LAYER_DEPTH;
    changed[1].level = 1;
    changed[2].texture = 0;
    changed[3].texture = 12345;
    changed[4].struct_size = 1;
    changed[5].layer = MGT_LAYER_REFRACTION_ERROR;
    changed[6] = host_texture(&h, MGT_LAYER_COLOR, GL_RGBA32UI, SEA_WIDTH, SEA_HEIGHT);
    changed[7] = host_texture(&h, MGT_LAYER_COLOR, GL_RGBA32F, SEA_WIDTH, SEA_HEIGHT + 1);
    changed[8].reserved = 1;
    for (size_t i = 0; i < WRONG; i++) {
        assert_int_equal(mgt_gl_render_textures(context, &scene, &changed[i], 1), MGT_ERROR_ARGUMENT);
        assert_non_null(strstr(mgt_last_error(context), "texture 0"));
    }
    assert_int_equal(mgt_gl_render_textures(context, &scene, &good, 0), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_gl_render_textures(context, &scene, NULL, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_gl_render_textures(NULL, &scene, &good, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_gl_render_textures(context, NULL, &good, 1), MGT_ERROR_ARGUMENT);
    scene.quality.method = MGT_METHOD_ADAPTIVE;
    scene.quality.budget_ms = 100;
    assert_int_equal(mgt_gl_render_textures(context, &scene, &good, 1), MGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(mgt_last_error(context), "a budget of milliseconds is kept on the CPU alone"));
    scene.quality.budget_ms = 0;
    scene.quality.method = MGT_METHOD_REFERENCE;
    assert_int_equal(mgt_gl_render_textures(context, &scene, &good, 1), MGT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(mgt_last_error(context), "the method runs on the CPU alone"));
    scene.quality.method = MGT_METHOD_NONE;
    assert_int_equal(mgt_gl_render_textures(context, &scene, &good, 1), MGT_OK);
    assert_int_equal(h.gl.GetError(), GL_NO_ERROR);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

/* Other methods than adaptive have spent the same everywhere. */
static void spent_layers_are_even(void **state)
{
    (void)state;
    static float got[3][PIXELS];
    mgt_wave waves[SEA_WAVES];
    mgt_scene scene = sea_scene(waves);
    mgt_target targets[3];
    for (int i = 0; i < 3; i++)
        targets[i] = sea_target((mgt_layer)(MGT_LAYER_SAMPLES + i), MGT_FORMAT_R32F, got[i], 0);
    static const struct {
        mgt_method method;
        float samples;
    } cases[] = {{MGT_METHOD_SSAA, 8}, {MGT_METHOD_MSAA32, 32}, {MGT_METHOD_TAA, 8}, {MGT_METHOD_MANGATA, 1}};
    mgt_context *gl = gl_context();
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        scene.quality.method = cases[k].method;
        memset(got, 0x7f, sizeof got);
        sea_render(gl, &scene, targets, 3);
        for (size_t i = 0; i < PIXELS; i++)
            assert_true(got[0][i] == cases[k].samples && got[1][i] == 0 && got[2][i] == 0);
    }
    mgt_context_destroy(gl);

    gl_host h;
    gl_host_start(&h);
    mgt_context *context = gl_context_of(gl_egl_get_proc);
    mgt_gl_texture t = host_texture(&h, MGT_LAYER_SAMPLES, GL_R32F, SEA_WIDTH, SEA_HEIGHT);
    assert_int_equal(mgt_gl_render_textures(context, &scene, &t, 1), MGT_OK);
    read_texture(&h, t.texture, GL_RED, GL_FLOAT, sizeof got[0], got[0]);
    assert_true(got[0][0] == 1 && got[0][PIXELS - 1] == 1);
    h.gl.DeleteTextures(1, &t.texture);
    mgt_context_destroy(context);
    gl_host_stop(&h);
}

/* A context of our own comes and goes without a trace on the thread's current one, and renders nothing of a host's. */
static void the_threads_context_stays_current(void **state)
{
    (void)state;
    static float pixels[PIXELS];
    gl_host h;
    gl_host_start(&h);
    void *(*const current)(void) = (void *(*)(void))dlsym(dlopen("libEGL.so.1", RTLD_NOW), "eglGetCurrentContext");
    assert_non_null(current);
    void *const before = current();
    assert_non_null(before);
    mgt_context *own = gl_context();
    assert_ptr_equal(current(), before);
    mgt_wave waves[SEA_WAVES];
    const mgt_scene scene = sea_scene(waves);
    const mgt_target target = sea_target(MGT_LAYER_MASK, MGT_FORMAT_R32F, pixels, 0);
    sea_render(own, &scene, &target, 1);
    assert_ptr_equal(current(), before);
    mgt_gl_texture texture;
    mgt_gl_texture_init(&texture, sizeof texture);
    mgt_gl_view view;
    mgt_gl_view_init(&view, sizeof view);
    assert_int_equal(mgt_gl_render_textures(own, &scene, &texture, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_gl_render_views(own, &scene, &view, 1), MGT_ERROR_ARGUMENT);
    assert_int_equal(mgt_gl_set_sources(own, NULL, 0), MGT_OK);
    mgt_context_destroy(own);
    assert_ptr_equal(current(), before);
    assert_int_equal(h.gl.GetError(), GL_NO_ERROR);
    gl_host_stop(&h);
    assert_null(current());
}

int main(void)
{
    if (gl_is_missing())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(creation_says_what_runs),
        cmocka_unit_test(automatic_choice),
        cmocka_unit_test(the_cpus_frames_are_announced),
        cmocka_unit_test(incomplete_hosts_are_refused),
        cmocka_unit_test(pending_errors_are_cleared),
        cmocka_unit_test(lost_contexts_are_told),
        cmocka_unit_test(layers_are_those_of_the_cpu),
        cmocka_unit_test(crops_are_parts_of_the_whole),
        cmocka_unit_test(strides_are_kept),
        cmocka_unit_test(sample_ranges_add_up),
        cmocka_unit_test(large_pictures_are_refused),
        cmocka_unit_test(rendering_can_be_cancelled),
        cmocka_unit_test(sources_can_be_replaced),
        cmocka_unit_test(textures_hold_the_layers),
        cmocka_unit_test(spent_layers_are_even),
        cmocka_unit_test(wrong_textures_are_refused),
        cmocka_unit_test(the_threads_context_stays_current),
        cmocka_unit_test(messages_name_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
