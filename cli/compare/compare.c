/* SPDX-License-Identifier: MIT */
/* `mangata compare`: its command line. The work is in compare_job.c. */
#include <string.h>

#include "cli/compare/compare_external.h"
#include "image/metrics_clip.h"
#include "cli/common/numbers.h"
#include "cli/common/verbs.h"
#include "params/methods.h"

/* The request, and options that are read after the methods are known. */
typedef struct compare_line {
    compare_request request; /* first member, because rows have offsets into it */
    const char *methods;
    const char *external[COMPARE_METHODS];
    size_t external_count;
    bool metrics_given;
    const char *gates[COMPARE_GATES];
    bool gate_flicker[COMPARE_GATES];
    size_t gate_count;
    uint64_t seed, megabytes;
} compare_line;

static int add_scene(const option *o, void *place, const char *path)
{
    compare_request *r = place;
    (void)o;
    if (r->scene_count == COMPARE_SCENES)
        return console_error(EXIT_CODE_USAGE, "at most %d scenes are allowed; %s is one more", COMPARE_SCENES, path);
    r->scene_paths[r->scene_count++] = path;
    return EXIT_CODE_OK;
}

static int add_gate(const option *o, void *place, const char *value)
{
    compare_line *line = place;
    if (line->gate_count == COMPARE_GATES)
        return console_error(EXIT_CODE_USAGE, "at most %d limits are allowed", COMPARE_GATES);
    line->gate_flicker[line->gate_count] = strcmp(o->name, "max-flicker") == 0;
    line->gates[line->gate_count++] = value;
    return EXIT_CODE_OK;
}

/* Keeps --external, which is read after scenes and frames are known. */
static int add_external(const option *o, void *place, const char *value)
{
    compare_line *line = place;
    if (line->external_count == COMPARE_METHODS)
        return console_error(EXIT_CODE_USAGE, "--%s: at most %d methods are allowed", o->name, COMPARE_METHODS);
    line->external[line->external_count++] = value;
    return EXIT_CODE_OK;
}

static int set_metrics(const option *o, void *place, const char *value)
{
    compare_line *line = place;
    line->metrics_given = true;
    if (truth_words_parse(value, &line->request.truth, &line->request.metrics))
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed are %s, %s, separated by commas", o->name, value, clip_metric_words, truth_words_text);
}

static int add_method(compare_request *r, const char *text, size_t length, uint64_t seed)
{
    char wrong[512];
    if (r->method_count == COMPARE_METHODS)
        return console_error(EXIT_CODE_USAGE, "--methods: at most %d are allowed", COMPARE_METHODS);
    method_spec *spec = &r->methods[r->method_count];
    if (!method_spec_parse(spec, text, length, wrong, sizeof wrong))
        return console_error(EXIT_CODE_USAGE, "--methods: %s", wrong);
    if (strcmp(spec->name, "reference") == 0)
        return console_error(EXIT_CODE_USAGE, "--methods: the reference is always rendered; to judge it itself, give it other samples, "
                                              "such as reference:spatial=4");
    for (size_t i = 0; i < r->method_count; i++)
        if (strcmp(r->methods[i].file, spec->file) == 0)
            return console_error(EXIT_CODE_USAGE, "--methods: %s is given twice", spec->name);
    spec->quality.seed = seed;
    r->method_count++;
    return EXIT_CODE_OK;
}

static int add_methods(compare_request *r, const compare_line *line)
{
    for (const char *p = line->methods;;) {
        const size_t length = strcspn(p, ",");
        const int code = add_method(r, p, length, line->seed);
        if (code != EXIT_CODE_OK)
            return code;
        if (!p[length])
            return EXIT_CODE_OK;
        p += length + 1;
    }
}

static int resolve_gates(compare_request *r, const compare_line *line)
{
    for (size_t i = 0; i < line->gate_count; i++) {
        const char *name = line->gate_flicker[i] ? "max-flicker" : "max-rmse", *text = line->gates[i], *equals = strrchr(text, '=');
        compare_gate *gate = &r->gates[r->gate_count++];
        gate->flicker = line->gate_flicker[i];
        if (!equals || !number_parse_double(equals + 1, &gate->limit) || gate->limit < 0)
            return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is METHOD=X, X a number from 0", name, text);
        const size_t length = (size_t)(equals - text);
        size_t m = 0;
        while (m < r->method_count && (strlen(r->methods[m].name) != length || strncmp(r->methods[m].name, text, length) != 0))
            m++;
        if (m == r->method_count)
            return console_error(EXIT_CODE_USAGE, "--%s %s: %.*s is not one of the methods compared", name, text, (int)length, text);
        gate->method = m;
        if (!(r->metrics >> (gate->flicker ? CLIP_FLICKER : CLIP_RMSE) & 1))
            return console_error(EXIT_CODE_USAGE, "--%s needs %s among --metrics", name, gate->flicker ? "flicker" : "rmse");
        if (gate->flicker && frame_list_length(&r->frames) < 2)
            return console_error(EXIT_CODE_USAGE, "--max-flicker needs at least two frames");
    }
    return EXIT_CODE_OK;
}

/* Flicker that is asked for needs two frames; nothing else may be left to measure. */
static int check_flicker(const compare_line *line)
{
    const compare_request *r = &line->request;
    if (!line->metrics_given || !(r->metrics & CLIP_ALL_FLICKER) || frame_list_length(&r->frames) > 1)
        return EXIT_CODE_OK;
    if (!(r->metrics & ~(uint32_t)CLIP_ALL_FLICKER) && !r->truth.texture && !r->truth.specks)
        return console_error(EXIT_CODE_USAGE, "--metrics flicker needs at least two --frames");
    console_note(&r->out, "mangata: warning: --metrics flicker needs at least two --frames; it is left out");
    return EXIT_CODE_OK;
}

static int run(void *place)
{
    compare_line *line = place;
    compare_request *r = &line->request;
    if (r->scene_count == 0)
        return console_error(EXIT_CODE_USAGE, "no scene given; see mangata compare --help");
    if (!r->folder || !r->folder[0])
        return console_error(EXIT_CODE_USAGE, "no folder given: -o DIR; see mangata compare --help");
    /* The reference has another seed than the methods. Otherwise a method with random samples would share samples with the reference and score too well. */
    r->reference.seed = line->seed + 1;
    r->reference.time_samples += r->reference.time_samples % 2;
    r->halved = true;
    r->picture_bytes = line->megabytes * 1000000;
    r->progress = progress_mode_heard(r->progress, r->out.quiet);
    r->out.json_notes = r->progress == PROGRESS_JSON;
    int code = context_options_check(&r->context);
    if (code == EXIT_CODE_OK)
        code = check_flicker(line);
    if (code == EXIT_CODE_OK)
        code = add_methods(r, line);
    for (size_t i = 0; i < line->external_count && code == EXIT_CODE_OK; i++)
        code = compare_external_add(r, line->external[i]);
    if (code == EXIT_CODE_OK)
        code = resolve_gates(r, line);
    return code == EXIT_CODE_OK ? compare_run(r) : code;
}

static const option compare_options[] = {
    OPTION_SEA,
    {"output", 'o', "DIR", "the folder of the report; made where it is missing", .set = option_text, .offset = offsetof(compare_request, folder)},
    {"methods", 0, "LIST",
     "methods to compare, each NAME or NAME:OPTION=VALUE with an\n"
     "option of mangata render, such as podee-pixel:ndf-mean=drop\n"
     "(default none,podee-uniform,podee-pixel,mangata)",
     .set = option_text, .offset = offsetof(compare_line, methods)},
    {"external", 0, "NAME=PATH",
     "pictures of another program beside the methods: dir/%04d.exr with\n"
     "color, coverage or both, scene-linear, or .pfm with one of them;\n" EXTERNAL_SCENE " in it is the scene's name; may be repeated",
     .set = add_external},
    {"frames", 0, "LIST", "A, A-B, A-B:STEP or a list of these (default 0-3)", .set = option_frames, .offset = offsetof(compare_request, frames)},
    OPTION_SHARD(compare_request,
                 "one of N machines' part of all pictures: draws it and measures\nnothing; the same command without --shard then measures all"),
    {"size", 0, "WxH", "size in pixels instead of the scenes'", .set = option_size, .offset = offsetof(compare_request, changes), .least = 1,
     .allowed = "WxH, each from 1 to 32768 pixels, such as 320x180"},
    {"spatial", 0, "N", "reference: NxN samples a pixel for each time sample (default 8)", .set = option_samples,
     .offset = offsetof(compare_request, reference.spatial_samples)},
    {"time-samples", 0, "M",
     "reference: samples of the open shutter (default 8), half of them\n"
     "for each of two halves whose difference is the noise floor",
     .set = option_samples, .offset = offsetof(compare_request, reference.time_samples)},
    {"set", 0, "KEY=VALUE", "change a value of every scene; may be repeated", .set = option_change, .offset = offsetof(compare_request, changes)},
    {"seed", 0, "N", "seed of the methods' jitter; the reference's are N + 1, N + 2 (default 0)", .set = option_number, .offset = offsetof(compare_line, seed),
     .most = UINT64_MAX - 2},
    {"metrics", 0, "LIST",
     "what to measure, as in mangata diff, texture and specks against\n"
     "the halves of the reference (default: all)",
     .set = set_metrics},
    {"time-runs", 0, "N",
     "timed renders of each method on each scene, apart from the\n"
     "pictures; 0: none (default 5)",
     .set = option_number, .offset = offsetof(compare_request, time_runs), .most = 1000},
    {"max-rmse", 0, "METHOD=X",
     "exit with 2 when the method's RMSE of coverage over all scenes\n"
     "is above X or values are not comparable; may be repeated",
     .set = add_gate},
    {"max-flicker", 0, "METHOD=X", "the same for its flicker against the reference", .set = add_gate},
    {"picture-mb", 0, "N",
     "megabytes of pictures in the page (default 14); where all\n"
     "frames need more, it shows the first ones",
     .set = option_number, .offset = offsetof(compare_line, megabytes), .least = 1, .most = 1024},
    {"overwrite", 0, NULL, "replace files of the report's names that this command did not write", .set = option_given,
     .offset = offsetof(compare_request, overwrite)},
    {"backend", 0, "NAME", "cpu (default), gl or auto; null renders nothing: for tests", .set = option_context, .offset = offsetof(compare_request, context)},
    CONTEXT_OPTION_GL_DEVICE(compare_request),
    CONTEXT_OPTION_THREADS(compare_request),
    CONTEXT_OPTION_ISA(compare_request),
    OPTION_PROGRESS(compare_request),
};

static const option_table compare_table = {"compare",
                                           "SCENE... -o DIR [options]",
                                           "Renders every method on every scene, and the reference, measures how far they are apart, and how\n"
                                           "far the reference's own noise moves each score; writes DIR/report.html (one file that needs nothing\n"
                                           "else), report.json, report.csv and report.tex.\n"
                                           "Pictures are kept in DIR/frames: the same command again goes on where it was stopped.",
                                           compare_options,
                                           sizeof compare_options / sizeof compare_options[0],
                                           .notes = "exit codes: 0 done, 2 above a limit, 64 usage, 65 bad scene, 66 no such scene, 69 not available,\n"
                                                    "73 cannot write, 75 try again, 129, 130 and 143 stopped by a signal",
                                           .operand = {.set = add_scene},
                                           .changes = offsetof(compare_request, changes),
                                           .run = run};

int verb_compare(int count, char **arguments)
{
    compare_line line = {.request = {.arguments = arguments,
                                     .argument_count = count,
                                     .metrics = CLIP_ALL_METRICS,
                                     .truth = {true, true},
                                     .time_runs = 5,
                                     .progress = progress_mode_auto()},
                         .methods = "none,podee-uniform,podee-pixel,mangata",
                         .megabytes = 14};
    mgt_quality_init(&line.request.reference, sizeof line.request.reference);
    method_from_name("reference", &line.request.reference);
    frame_list_span(&line.request.frames, 0, 3);
    return options_run(&compare_table, &line, count, arguments);
}
