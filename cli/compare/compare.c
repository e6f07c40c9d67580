/* SPDX-License-Identifier: MIT */
/* `mangata compare`: its command line. The work is in compare_job.c. */
#include <stdlib.h>
#include <string.h>

#include "cli/compare/compare_request.h"
#include "image/metrics_clip.h"
#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "cli/common/verbs.h"
#include "params/methods.h"

enum {
    OPT_OUTPUT,
    OPT_METHODS,
    OPT_FRAMES,
    OPT_SIZE,
    OPT_SPATIAL,
    OPT_TIME,
    OPT_SET,
    OPT_SEED,
    OPT_METRICS,
    OPT_TIME_RUNS,
    OPT_MAX_RMSE,
    OPT_MAX_FLICKER,
    OPT_PICTURE_MB,
    OPT_BACKEND,
    OPT_GL_DEVICE,
    OPT_THREADS,
    OPT_ISA,
    OPT_PROGRESS
};

static const option compare_options[] = {
    [OPT_OUTPUT] = {"output", 'o', "DIR", "the folder of the report; made where it is missing"},
    [OPT_METHODS] = {"methods", 0, "LIST",
                     "methods to compare, each NAME or NAME:OPTION=VALUE with an\n"
                     "option of mangata render, such as podee-pixel:ndf-mean=drop\n"
                     "(default none,podee-uniform,podee-pixel,mangata)"},
    [OPT_FRAMES] = {"frames", 0, "LIST", "A, A-B, A-B:STEP or a list of these (default 0-3)"},
    [OPT_SIZE] = {"size", 0, "WxH", "size in pixels instead of the scenes'"},
    [OPT_SPATIAL] = {"spatial", 0, "N", "reference: NxN samples a pixel for each time sample (default 8)"},
    [OPT_TIME] = {"time-samples", 0, "M", "reference: samples of the open shutter (default 8)"},
    [OPT_SET] = {"set", 0, "KEY=VALUE", "change a value of every scene; may be repeated"},
    [OPT_SEED] = {"seed", 0, "N", "seed of the methods' jitter; the reference's is N + 1 (default 0)"},
    [OPT_METRICS] = {"metrics", 0, "LIST", "what to measure, as in mangata diff (default: all)"},
    [OPT_TIME_RUNS] = {"time-runs", 0, "N",
                       "timed renders of each method on each scene, apart from the\n"
                       "pictures; 0: none (default 5)"},
    [OPT_MAX_RMSE] = {"max-rmse", 0, "METHOD=X",
                      "exit with 2 when the method's RMSE of coverage over all scenes\n"
                      "is above X; may be repeated"},
    [OPT_MAX_FLICKER] = {"max-flicker", 0, "METHOD=X", "the same for its flicker against the reference"},
    [OPT_PICTURE_MB] = {"picture-mb", 0, "N",
                        "megabytes of pictures in the page (default 14); where all\n"
                        "frames need more, it shows the first ones"},
    [OPT_BACKEND] = {"backend", 0, "NAME", "cpu (default), gl or auto; null renders nothing: for tests"},
    [OPT_GL_DEVICE] = CONTEXT_OPTION_GL_DEVICE,
    [OPT_THREADS] = CONTEXT_OPTION_THREADS,
    [OPT_ISA] = CONTEXT_OPTION_ISA,
    [OPT_PROGRESS] = {"progress", 0, "MODE", "auto (default: a bar on a terminal), json or none"},
};

static const option_table compare_table = {"compare",
                                           "SCENE... -o DIR [options]",
                                           "Renders every method on every scene, and the reference, measures how far they are apart, and\n"
                                           "writes DIR/report.html (one file that needs nothing else), report.json, report.csv and report.tex.\n"
                                           "Pictures are kept in DIR/frames: the same command again goes on where it was stopped.",
                                           compare_options,
                                           sizeof compare_options / sizeof compare_options[0],
                                           .notes = "exit codes: 0 done, 2 above a limit, 64 usage, 65 bad scene, 66 no such scene, 69 not available,\n"
                                                    "73 cannot write, 130 and 143 stopped by a signal"};

/* What must wait until the methods are known. */
typedef struct late_options {
    const char *methods;
    const char *gates[COMPARE_GATES];
    bool gate_flicker[COMPARE_GATES];
    size_t gate_count;
    char size[2][32];
    uint64_t seed;
} late_options;

static int bad_value(size_t id, const char *value, const char *allowed)
{
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is %s", compare_options[id].name, value, allowed);
}

static int set_number(size_t id, const char *value, uint64_t least, uint64_t most, uint64_t *number)
{
    if (number_parse_u64(value, most, number) && *number >= least)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is a number from %llu to %llu", compare_options[id].name, value, (unsigned long long)least,
                         (unsigned long long)most);
}

static int set_count(size_t id, const char *value, uint32_t *count)
{
    char wrong[240];
    return quality_count_read(compare_options[id].name, value, count, wrong, sizeof wrong) ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "%s", wrong);
}

static int set_size(const char *value, char size[2][32])
{
    uint64_t side[2];
    if (!number_parse_list(value, 'x', MGT_MAX_IMAGE_SIDE, 2, side) || side[0] == 0 || side[1] == 0)
        return bad_value(OPT_SIZE, value, "WxH, each from 1 to 32768 pixels, such as 320x180");
    snprintf(size[0], 32, "image.width=%u", (unsigned)side[0]);
    snprintf(size[1], 32, "image.height=%u", (unsigned)side[1]);
    return EXIT_CODE_OK;
}

static int add_scene(compare_request *r, const char *path)
{
    if (r->scene_count == COMPARE_SCENES)
        return console_error(EXIT_CODE_USAGE, "at most %d scenes are allowed; %s is one more", COMPARE_SCENES, path);
    r->scene_paths[r->scene_count++] = path;
    return EXIT_CODE_OK;
}

static int add_gate(late_options *late, size_t id, const char *value)
{
    if (late->gate_count == COMPARE_GATES)
        return console_error(EXIT_CODE_USAGE, "at most %d limits are allowed", COMPARE_GATES);
    late->gate_flicker[late->gate_count] = id == OPT_MAX_FLICKER;
    late->gates[late->gate_count++] = value;
    return EXIT_CODE_OK;
}

static int set_option(compare_request *r, int id, const char *value, late_options *late)
{
    const char *wrong;
    switch (id) {
    case OPTION_OPERAND:
        return add_scene(r, value);
    case OPT_OUTPUT:
        r->folder = value;
        break;
    case OPT_METHODS:
        late->methods = value;
        break;
    case OPT_FRAMES:
        if ((wrong = frame_list_parse(&r->frames, value)))
            return console_error(EXIT_CODE_USAGE, "--frames %s: %s", value, wrong);
        break;
    case OPT_SIZE:
        return set_size(value, late->size);
    case OPT_SPATIAL:
        return set_count(OPT_SPATIAL, value, &r->reference.spatial_samples);
    case OPT_TIME:
        return set_count(OPT_TIME, value, &r->reference.time_samples);
    case OPT_SET:
        r->overrides[r->override_count++] = value;
        break;
    case OPT_SEED:
        return set_number(OPT_SEED, value, 0, UINT64_MAX - 1, &late->seed);
    case OPT_METRICS:
        if (!clip_metrics_parse(value, &r->metrics) || r->metrics == 0)
            return bad_value(OPT_METRICS, value, clip_metric_words);
        break;
    case OPT_TIME_RUNS:
        return set_number(OPT_TIME_RUNS, value, 0, 1000, &r->time_runs);
    case OPT_MAX_RMSE:
    case OPT_MAX_FLICKER:
        return add_gate(late, (size_t)id, value);
    case OPT_PICTURE_MB: {
        uint64_t megabytes = 0;
        const int code = set_number(OPT_PICTURE_MB, value, 1, 1024, &megabytes);
        r->picture_bytes = megabytes * 1000000;
        return code;
    }
    case OPT_BACKEND:
    case OPT_GL_DEVICE:
    case OPT_THREADS:
    case OPT_ISA: {
        const char *allowed = context_option_set(&r->context, compare_options[id].name, value);
        return allowed ? bad_value((size_t)id, value, allowed) : EXIT_CODE_OK;
    }
    case OPT_PROGRESS:
        if (!progress_mode_from_name(value, &r->progress))
            return bad_value(OPT_PROGRESS, value, "auto, json or none");
        break;
    default:
        break;
    }
    return EXIT_CODE_OK;
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

static int add_methods(compare_request *r, const late_options *late)
{
    for (const char *p = late->methods;;) {
        const size_t length = strcspn(p, ",");
        const int code = add_method(r, p, length, late->seed);
        if (code != EXIT_CODE_OK)
            return code;
        if (!p[length])
            return EXIT_CODE_OK;
        p += length + 1;
    }
}

static int resolve_gates(compare_request *r, const late_options *late)
{
    for (size_t i = 0; i < late->gate_count; i++) {
        const char *name = late->gate_flicker[i] ? "max-flicker" : "max-rmse", *text = late->gates[i], *equals = strrchr(text, '=');
        compare_gate *gate = &r->gates[r->gate_count++];
        gate->flicker = late->gate_flicker[i];
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

/* Returns an exit code, or -1 when there is nothing more to do. */
static int read_command_line(compare_request *r, late_options *late)
{
    option_reader reader = option_reader_start(&compare_table, &r->out, r->argument_count, r->arguments);
    const char *value = NULL;
    int id;
    while ((id = option_reader_next(&reader, &value)) != OPTION_END) {
        if (id == OPTION_HELP)
            return -1;
        if (id == OPTION_ERROR)
            return EXIT_CODE_USAGE;
        const int code = set_option(r, id, value, late);
        if (code != EXIT_CODE_OK)
            return code;
    }
    if (r->scene_count == 0)
        return console_error(EXIT_CODE_USAGE, "no scene given; see mangata compare --help");
    if (!r->folder || !r->folder[0])
        return console_error(EXIT_CODE_USAGE, "no folder given: -o DIR; see mangata compare --help");
    if (late->size[0][0]) {
        r->overrides[r->override_count++] = late->size[0];
        r->overrides[r->override_count++] = late->size[1];
    }
    /* Another seed than the methods': else a method that jitters would share the reference's samples and look better than it is. */
    r->reference.seed = late->seed + 1;
    const int code = add_methods(r, late);
    return code == EXIT_CODE_OK ? resolve_gates(r, late) : code;
}

int verb_compare(int count, char **arguments)
{
    late_options late = {.methods = "none,podee-uniform,podee-pixel,mangata"};
    compare_request *request = calloc(1, sizeof *request);
    /* Each --set takes a word of the command line; two more hold the size. */
    const char **overrides = calloc((size_t)count + 2, sizeof *overrides);
    int code = EXIT_CODE_FAILED;
    if (!request || !overrides) {
        console_error(code, "out of memory");
        goto done;
    }
    request->overrides = overrides;
    request->arguments = arguments;
    request->argument_count = count;
    mgt_quality_init(&request->reference, sizeof request->reference);
    method_from_name("reference", &request->reference);
    request->metrics = CLIP_ALL_METRICS;
    request->time_runs = 5;
    request->picture_bytes = 14000000;
    frame_list_span(&request->frames, 0, 3);
    progress_mode_from_name("auto", &request->progress);
    code = read_command_line(request, &late);
    if (code == EXIT_CODE_OK) {
        if (request->out.quiet && request->progress == PROGRESS_BAR)
            request->progress = PROGRESS_NONE;
        code = compare_run(request);
    } else if (code < 0) {
        code = EXIT_CODE_OK;
    }
done:
    free(overrides);
    free(request);
    return code;
}
