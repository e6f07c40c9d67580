/* SPDX-License-Identifier: MIT */
/* `mangata bench`: time per frame of several methods. They take turns, so that a change of the machine's speed affects all of them. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/context_options.h"
#include "cli/common/interrupt.h"
#include "cli/common/memory_use.h"
#include "cli/common/method_spec.h"
#include "cli/common/numbers.h"
#include "cli/common/progress.h"
#include "cli/common/verbs.h"
#include "params/methods.h"
#include "scene/scene_text.h"

enum { METHOD_LIMIT = 16 };

typedef struct bench_request {
    console out;
    const char *scene_path, *methods;
    scene_changes changes;
    uint64_t frames, repeat;
    context_options context;
    bool display, memory;
} bench_request;

typedef struct bench_method {
    method_spec spec;
    mgt_context *context; /* each method has its own, so that it cannot reuse the work of another one */
    double *seconds;      /* frames × repeat */
    double memory;        /* largest number of bytes in use; NaN: not known */
} bench_method;

typedef struct bench {
    const bench_request *request;
    scene_file *scene;
    mgt_context_info info;
    mgt_target target;
    uint32_t width, height;
    size_t count;
    bench_method methods[METHOD_LIMIT];
} bench;

static int add_methods(bench *b)
{
    for (const char *p = b->request->methods; *p;) {
        const size_t length = strcspn(p, ",");
        char wrong[300];
        if (b->count == METHOD_LIMIT)
            return console_error(EXIT_CODE_USAGE, "--methods: at most %d are allowed", METHOD_LIMIT);
        bench_method *method = &b->methods[b->count];
        if (!method_spec_parse(&method->spec, p, length, wrong, sizeof wrong))
            return console_error(EXIT_CODE_USAGE, "--methods: %s", wrong);
        method->seconds = calloc((size_t)(b->request->frames * b->request->repeat), sizeof *method->seconds);
        if (!method->seconds)
            return console_error(EXIT_CODE_FAILED, "out of memory");
        method->memory = NAN;
        b->count++;
        p += length + (p[length] == ',');
    }
    return b->count ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "--methods %s: allowed is %s", b->request->methods, method_names().text);
}

static int open_context(bench *b, bench_method *method)
{
    return context_open(&b->request->context, &b->request->out, interrupt_keep_going, NULL, &method->context, &b->info);
}

static void close_context(bench_method *method)
{
    mgt_context_destroy(method->context);
    method->context = NULL;
}

/* Reads the methods and the scene, and allocates the picture. */
static int prepare(bench *b)
{
    const bench_request *r = b->request;
    scene_error error;
    const int code = add_methods(b);
    if (code != EXIT_CODE_OK)
        return code;
    b->scene = scene_file_open(r->scene_path, r->changes.items, r->changes.count, &error);
    if (!b->scene)
        return console_scene_error(&error);
    mgt_scene first;
    const mgt_quality base = scene_file_quality(b->scene);
    for (size_t i = 0; i < b->count; i++) {
        char wrong[600];
        method_spec *spec = &b->methods[i].spec;
        if (!quality_options_apply(&spec->given, &base, &spec->quality, wrong, sizeof wrong))
            return console_error(EXIT_CODE_USAGE, "%s: %s", spec->name, wrong);
    }
    if (!scene_file_frame(b->scene, 0, &first))
        return console_error(EXIT_CODE_BAD_INPUT, "%s: the camera of frame 0 is not a legal one", r->scene_path);
    b->width = first.image.width;
    b->height = first.image.height;
    mgt_target_init(&b->target, sizeof b->target);
    b->target.format = r->display ? MGT_FORMAT_RGBA8_SRGB : MGT_FORMAT_RGB32F;
    b->target.pixels = calloc((size_t)b->width * b->height, r->display ? 4 : 12);
    return b->target.pixels ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
}

static int render_once(bench *b, const bench_method *method, uint64_t frame, double *seconds)
{
    mgt_scene scene;
    if (!scene_file_frame(b->scene, (int)frame, &scene))
        return console_error(EXIT_CODE_BAD_INPUT, "%s: the camera of frame %d is not a legal one", b->request->scene_path, (int)frame);
    scene.quality = method->spec.quality;
    const double start = seconds_now();
    const mgt_status status = mgt_render(method->context, &scene, &b->target, 1);
    *seconds = seconds_now() - start;
    if (status == MGT_CANCELLED || *interrupt_flag())
        return interrupt_exit_code();
    return status == MGT_OK ? EXIT_CODE_OK : console_library_error(method->context, status);
}

static int measure_memory(bench *b)
{
    double unused;
    memset(b->target.pixels, 0, (size_t)b->width * b->height * (b->request->display ? 4 : 12)); /* so that the picture's own memory is in use before */
    for (size_t m = 0; m < b->count; m++) {
        const double before = memory_use_begin();
        int code = open_context(b, &b->methods[m]);
        if (code == EXIT_CODE_OK)
            code = render_once(b, &b->methods[m], 0, &unused);
        b->methods[m].memory = memory_use_peak() - before;
        close_context(&b->methods[m]);
        if (code != EXIT_CODE_OK)
            return code;
    }
    return EXIT_CODE_OK;
}

static int measure(bench *b)
{
    const uint64_t runs = b->request->frames * b->request->repeat;
    double unused;
    /* The first frame builds tables and touches memory. It is not counted. */
    for (size_t m = 0; m < b->count; m++) {
        int code = open_context(b, &b->methods[m]);
        if (code == EXIT_CODE_OK)
            code = render_once(b, &b->methods[m], 0, &unused);
        if (code != EXIT_CODE_OK)
            return code;
    }
    for (uint64_t i = 0; i < runs; i++)
        for (size_t m = 0; m < b->count; m++) {
            const int code = render_once(b, &b->methods[m], i % b->request->frames, &b->methods[m].seconds[i]);
            if (code != EXIT_CODE_OK)
                return code;
        }
    return EXIT_CODE_OK;
}

static int print_report(bench *b)
{
    const size_t runs = (size_t)(b->request->frames * b->request->repeat);
    const double megapixels = 1e-6 * b->width * b->height;
    json_t *list = b->request->out.json ? json_array() : NULL;
    int width = 15;
    for (size_t m = 0; m < b->count; m++) {
        const int length = (int)strlen(b->methods[m].spec.name);
        width = length >= width ? length + 1 : width;
    }
    if (!list) {
        char name[PATH_MAX];
        scene_copy_line(name, sizeof name, b->request->scene_path, strlen(b->request->scene_path));
        printf("%s, %u x %u, ", name, b->width, b->height);
        if (b->info.backend == MGT_BACKEND_GL)
            printf("%s, ", b->info.renderer);
        else
            printf("%s, %u lanes, %u threads, ", mgt_isa_name(b->info.isa), b->info.lanes, b->info.threads);
        printf("%zu frame%s each\n%-*s%10s%10s%10s%10s%10s%s\n", runs, runs == 1 ? "" : "s", width, "method", "median ms", "min ms", "max ms", "fps",
               "Mpixel/s", b->request->memory ? "       MiB" : "");
    }
    for (size_t m = 0; m < b->count; m++) {
        const number_spread seconds = number_spread_of(b->methods[m].seconds, runs);
        const double median = seconds.median;
        const char *name = b->methods[m].spec.name;
        const double memory = b->methods[m].memory;
        json_t *bytes = list && isfinite(memory) ? json_integer((json_int_t)memory) : NULL;
        if (list)
            json_array_append_new(list, json_pack("{s:s, s:f, s:f, s:f, s:f, s:f, s:o*}", "method", name, "median_ms", 1e3 * median, "min_ms",
                                                  1e3 * seconds.least, "max_ms", 1e3 * seconds.most, "fps", 1 / fmax(median, 1e-9), "mpixel_per_s",
                                                  megapixels / fmax(median, 1e-9), "memory_bytes", bytes));
        else
            printf("%-*s%10.2f%10.2f%10.2f%10.1f%10.1f", width, name, 1e3 * median, 1e3 * seconds.least, 1e3 * seconds.most, 1 / fmax(median, 1e-9),
                   megapixels / fmax(median, 1e-9));
        if (!list && isfinite(memory))
            printf("%10.1f", memory / 1048576);
        if (!list)
            puts(b->request->memory && !isfinite(memory) ? "         -" : "");
    }
    if (!list)
        return EXIT_CODE_OK;
    return console_print_json(json_pack("{s:s, s:o, s:i, s:i, s:s, s:s, s:s, s:i, s:i, s:I, s:b, s:o}", "version", mgt_version(), "scene",
                                        console_json_text(b->request->scene_path), "width", (int)b->width, "height", (int)b->height, "backend",
                                        mgt_backend_name(b->info.backend), "renderer", b->info.renderer, "isa", mgt_isa_name(b->info.isa), "lanes",
                                        (int)b->info.lanes, "threads", (int)b->info.threads, "runs", (json_int_t)runs, "display", b->request->display,
                                        "methods", list));
}

static int run(void *place)
{
    const bench_request *request = place;
    bench b = {.request = request};
    if (!request->scene_path)
        return console_error(EXIT_CODE_USAGE, "no scene given; see mangata bench --help");
    int code = context_options_check(&request->context);
    if (code == EXIT_CODE_OK)
        code = prepare(&b);
    interrupt_install();
    if (code == EXIT_CODE_OK && request->memory)
        code = measure_memory(&b);
    if (code == EXIT_CODE_OK)
        code = measure(&b);
    if (code == EXIT_CODE_OK)
        code = print_report(&b);
    free(b.target.pixels);
    for (size_t m = 0; m < b.count; m++) {
        close_context(&b.methods[m]);
        free(b.methods[m].seconds);
    }
    scene_file_free(b.scene);
    return code;
}

static const option bench_options[] = {
    OPTION_SEA,
    {"methods", 0, "LIST", "methods to measure, with options if wanted:\nadaptive:samples=4, none+hybrid (default none,podee-pixel,mangata)",
     .set = option_text, .offset = offsetof(bench_request, methods)},
    {"size", 0, "WxH", "size in pixels instead of the scene's", .set = option_size, .offset = offsetof(bench_request, changes), .least = 1,
     .allowed = "WxH, each from 1 to 32768 pixels, such as 1280x720"},
    {"frames", 0, "N", "measure frames 0 to N-1 (default 3)", .set = option_number, .offset = offsetof(bench_request, frames), .least = 1, .most = 1000000},
    {"repeat", 0, "R", "measure each of them R times (default 5)", .set = option_number, .offset = offsetof(bench_request, repeat), .least = 1, .most = 1000},
    {"backend", 0, "NAME", "cpu (default), gl or auto", .set = option_drawing_backend, .offset = offsetof(bench_request, context),
     .allowed = "cpu, gl or auto"},
    CONTEXT_OPTION_GL_DEVICE(bench_request),
    CONTEXT_OPTION_THREADS(bench_request),
    CONTEXT_OPTION_ISA(bench_request),
    {"set", 0, "KEY=VALUE", "change a value of the scene; may be repeated", .set = option_change, .offset = offsetof(bench_request, changes)},
    {"display", 0, NULL, "make displayed colours: with exposure, glare and tone mapping", .set = option_given, .offset = offsetof(bench_request, display)},
    {"memory", 0, NULL, "also measure the memory that a frame takes at its peak, in a\ncontext of its own for every method", .set = option_given,
     .offset = offsetof(bench_request, memory)},
};

static const option_table bench_table = {"bench",
                                         "SCENE [options]",
                                         "Renders in memory, without output: scene-linear colour, or with --display what a picture shows.\n"
                                         "The methods take turns, so that a change of the machine's pace meets all of them.",
                                         bench_options,
                                         sizeof bench_options / sizeof bench_options[0],
                                         .notes = "exit codes: 0 done, 1 failed, 64 usage, 65 bad scene, 66 no such scene, 69 not available,\n"
                                                  "75 try again, 129, 130 and 143 stopped by a signal",
                                         .operand = {.set = option_one_scene, .offset = offsetof(bench_request, scene_path)},
                                         .changes = offsetof(bench_request, changes),
                                         .run = run};

int verb_bench(int count, char **arguments)
{
    bench_request request = {.methods = "none,podee-pixel,mangata", .frames = 3, .repeat = 5};
    return options_run(&bench_table, &request, count, arguments);
}
