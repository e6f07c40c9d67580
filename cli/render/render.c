/* SPDX-License-Identifier: MIT */
/* `mangata render`: its command line. The work is in render_job.c. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/method_options.h"
#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "cli/render/render_request.h"
#include "cli/common/verbs.h"

enum {
    OPT_OUTPUT,
    OPT_FRAMES,
    OPT_SIZE,
    OPT_CROP,
    OPT_METHOD,
    OPT_SPATIAL,
    OPT_TIME,
    OPT_RANGE,
    OPT_NDF_MEAN,
    OPT_KERNELS,
    OPT_INTEGRAL,
    OPT_ELONGATION,
    OPT_SEGMENTS,
    OPT_TRANSITION,
    OPT_WIDTH,
    OPT_ADAPTIVE,
    OPT_SAMPLES,
    OPT_TARGET,
    OPT_BUDGET,
    OPT_CENTER,
    OPT_IMPORTANCE_WIDTH,
    OPT_THRESHOLD,
    OPT_SLOTS,
    OPT_REFRACTION,
    OPT_TESS_ERROR,
    OPT_REFRACTION_SAMPLES,
    OPT_CAUSTICS,
    OPT_SET,
    OPT_SEED,
    OPT_LAYER,
    OPT_BACKEND,
    OPT_GL_DEVICE,
    OPT_THREADS,
    OPT_ISA,
    OPT_OVERWRITE,
    OPT_SKIP,
    OPT_STAMP,
    OPT_PROGRESS
};

static const option render_options[] = {
    [OPT_OUTPUT] = {"output", 'o', "OUT",
                    "the file to write: .png .exr .pfm, or a film: .mp4 .y4m;\n"
                    "several pictures: frame_%04d.png or frame_####.png"},
    [OPT_FRAMES] = {"frames", 0, "LIST",
                    "A, A-B, A-B:STEP or a list of these (default: all frames of the\n"
                    "scene for a film or a numbered name, else frame 0)"},
    [OPT_SIZE] = {"size", 0, "WxH", "size in pixels instead of the scene's"},
    [OPT_CROP] = {"crop", 0, "X,Y,W,H", "render this rectangle of the picture alone"},
    [OPT_METHOD] = {"method", 0, OPTION_VALUE_METHOD, "how pixels are filtered: one of the methods below (default mangata)"},
    [OPT_SPATIAL] = {"spatial", 0, "N", "reference: NxN samples a pixel for each time sample (default 8)"},
    [OPT_TIME] = {"time-samples", 0, "M", "reference, ssaaN: samples of the open shutter (default 8; 1)"},
    [OPT_RANGE] = {"samples-range", 0, "FIRST,COUNT", "reference, ssaaN: take only these of the NxNxM samples"},
    [OPT_NDF_MEAN] = {"ndf-mean", 0, "add|drop",
                      "podee-pixel: add the mean slope of the filtered waves (default)\n"
                      "or drop it"},
    [OPT_KERNELS] = {"kernels", 0, "K",
                     "podee-*: 1, 3, 5 or 9 circular Gaussians, feline, riemann, or exact\n"
                     "(default)"},
    [OPT_INTEGRAL] = {"integral", 0, "I", "podee-*: exact (default) or kernels (9 where --kernels is not given)"},
    [OPT_ELONGATION] = {"elongation", 0, "E",
                        "podee-* with kernels: ellipses longer than this fall back to riemann\n"
                        "(default: the number of kernels; 1 and feline: never)"},
    [OPT_SEGMENTS] = {"path-segments", 0, "N", "podee-*: straight pieces of the open shutter, 1 (default) to 64"},
    [OPT_TRANSITION] = {"transition", 0, "T", "podee-*: waves turn from resolved to unresolved soft (default) or hard"},
    [OPT_WIDTH] = {"transition-width", 0, "W", "podee-*: cycles per pixel that a soft one takes, to 0.5 (default 0.3)"},
    [OPT_ADAPTIVE] = {"adaptive", 0, "SCHEME", "adaptive: cells (default) or podee, the paper's"},
    [OPT_SAMPLES] = {"samples", 0, "N", "adaptive: samples per pixel of water on average (default 8)"},
    [OPT_TARGET] = {"target-rmse", 0, "E", "adaptive: sample until the predicted error of coverage is E instead"},
    [OPT_BUDGET] = {"budget-ms", 0, "T",
                    "adaptive: sample until a frame has taken T milliseconds instead\n"
                    "(the pixels then depend on the machine)"},
    [OPT_CENTER] = {"importance-center", 0, "C", "adaptive podee: coverage that is most important (default 0.1)"},
    [OPT_IMPORTANCE_WIDTH] = {"importance-width", 0, "R", "adaptive podee: deviation of the importance (default 0.04)"},
    [OPT_THRESHOLD] = {"importance-threshold", 0, "V",
                       "adaptive podee: importance below which no samples are taken\n"
                       "(default 0.05)"},
    [OPT_SLOTS] = {"slots", 0, "M", "adaptive podee: samples of the whole picture"},
    [OPT_REFRACTION] = {"refraction", 0, "NAME",
                        "how what lies behind the surface is found: two-phase (default),\n"
                        "hybrid, liu, broad, narrow, screen-space, distance-field, off, truth"},
    [OPT_TESS_ERROR] = {"tess-error", 0, "PX",
                        "two-phase, hybrid, liu, broad: pixels that a bent triangle may be off\n"
                        "by (default 0.1)"},
    [OPT_REFRACTION_SAMPLES] = {"refraction-samples", 0, "N", "NxN refracted rays a pixel (default 1; truth: 4)"},
    [OPT_CAUSTICS] = {"caustics", 0, "on|off", "light that the waves bundle under water (default off)"},
    [OPT_SET] = {"set", 0, "KEY=VALUE",
                 "change a value of the scene, e.g. light.elevation_deg=3;\n"
                 "may be repeated"},
    [OPT_SEED] = {"seed", 0, "N", "seed of the jitter (default 0)"},
    [OPT_LAYER] = {"layer", 0, "NAME",
                   "color (default), coverage, mask, depth, normal, samples,\n"
                   "importance, detail, refraction or refraction_error;\n"
                   ".exr takes several, or all"},
    [OPT_BACKEND] = {"backend", 0, "NAME", "cpu (default), gl, auto, or null (renders nothing: for tests)"},
    [OPT_GL_DEVICE] = CONTEXT_OPTION_GL_DEVICE,
    [OPT_THREADS] = CONTEXT_OPTION_THREADS,
    [OPT_ISA] = CONTEXT_OPTION_ISA,
    [OPT_OVERWRITE] = {"overwrite", 0, NULL, "replace existing output"},
    [OPT_SKIP] = {"skip-existing", 0, NULL,
                  "keep existing output that was rendered from the same scene\n"
                  "with the same options; together with --overwrite: replace\n"
                  "the rest"},
    [OPT_STAMP] = {"stamp", 0, NULL, "record host, date, threads and instruction set in the output"},
    [OPT_PROGRESS] = {"progress", 0, "MODE", "auto (default: a bar on a terminal), json or none"},
};

static const option_table render_table = {"render",
                                          "SCENE -o OUT [options]",
                                          "Renders frames of a scene into pictures or a film.",
                                          render_options,
                                          sizeof render_options / sizeof render_options[0],
                                          "The same scene, frame and options give the same bytes, whatever the threads and the machine.\n"
                                          "exit codes: 0 done, 1 failed, 64 usage, 65 bad scene, 66 no such input, 69 not available,\n"
                                          "73 cannot write, 130 and 143 stopped by a signal"};

static int bad_value(size_t id, const char *value, const char *allowed)
{
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is %s", render_options[id].name, value, allowed);
}

static int set_size(const char *value, char size[2][32])
{
    uint64_t side[2];
    if (!number_parse_list(value, 'x', MGT_MAX_IMAGE_SIDE, 2, side) || side[0] == 0 || side[1] == 0)
        return bad_value(OPT_SIZE, value, "WxH, each from 1 to 32768 pixels, such as 1280x720");
    snprintf(size[0], 32, "image.width=%u", (unsigned)side[0]);
    snprintf(size[1], 32, "image.height=%u", (unsigned)side[1]);
    return EXIT_CODE_OK;
}

static int add_layer(render_request *r, const char *value)
{
    mgt_layer layer = MGT_LAYER_COLOR;
    const bool all = strcmp(value, "all") == 0;
    if (!all && !layer_from_name(value, &layer))
        return bad_value(OPT_LAYER, value, "color, coverage, mask, depth, normal, samples, importance, detail, refraction, refraction_error or all");
    bool wanted[LAYER_COUNT] = {false};
    for (size_t i = 0; i < r->layer_count; i++)
        wanted[r->layers[i]] = true;
    r->layer_count = 0;
    for (int i = 0; i < LAYER_COUNT; i++)
        if (wanted[i] || all || i == (int)layer)
            r->layers[r->layer_count++] = (mgt_layer)i;
    return EXIT_CODE_OK;
}

/* The options of the method, checked together once the method is known. */
typedef struct sample_options {
    const char *spatial, *time, *range, *ndf_mean;
    method_options method;
} sample_options;

static int set_samples(mgt_quality *q, const sample_options *given)
{
    uint64_t n;
    if (given->spatial && !method_takes(q->method, METHOD_TAKES_STRATA))
        return console_error(EXIT_CODE_USAGE, "--spatial %s: only --method reference takes it%s", given->spatial,
                             method_of(q->method)->numbered ? "; write the number into ssaaN" : "");
    if ((given->time || given->range) && !method_takes(q->method, METHOD_TAKES_TIMES))
        return console_error(EXIT_CODE_USAGE, "--%s: method %s takes one sample; only reference and ssaaN take more",
                             given->time ? "time-samples" : "samples-range", method_name(q).text);
    if (given->ndf_mean && !method_takes(q->method, METHOD_TAKES_NDF_MEAN))
        return console_error(EXIT_CODE_USAGE, "--ndf-mean: only --method podee-pixel takes it");
    if (given->spatial) {
        if (!number_parse_u64(given->spatial, 1024, &n) || n == 0)
            return bad_value(OPT_SPATIAL, given->spatial, "a number from 1 to 1024");
        q->spatial_samples = (uint32_t)n;
    }
    if (given->time) {
        if (!number_parse_u64(given->time, 65536, &n) || n == 0)
            return bad_value(OPT_TIME, given->time, "a number from 1 to 65536");
        q->time_samples = (uint32_t)n;
    }
    if (given->range) {
        const uint64_t total = (uint64_t)q->spatial_samples * q->spatial_samples * q->time_samples;
        uint64_t range[2];
        if (!number_parse_list(given->range, ',', UINT64_MAX, 2, range) || range[1] == 0 || range[0] >= total || range[1] > total - range[0])
            return console_error(EXIT_CODE_USAGE, "--samples-range %s: allowed is FIRST,COUNT with COUNT at least 1, within the %llu samples of a pixel",
                                 given->range, (unsigned long long)total);
        /* The whole range is the same picture as no range. */
        q->sample_first = range[0];
        q->sample_count = range[1] == total ? 0 : range[1];
    }
    if (given->ndf_mean) {
        if (strcmp(given->ndf_mean, "add") != 0 && strcmp(given->ndf_mean, "drop") != 0)
            return bad_value(OPT_NDF_MEAN, given->ndf_mean, "add or drop");
        q->ndf_mean_drop = given->ndf_mean[0] == 'd';
    }
    char wrong[240];
    if (!method_options_apply(&given->method, q, wrong, sizeof wrong))
        return console_error(EXIT_CODE_USAGE, "%s", wrong);
    return EXIT_CODE_OK;
}

static int set_option(render_request *r, int id, const char *value, sample_options *samples, char size[2][32])
{
    const char *wrong;
    switch (id) {
    case OPT_OUTPUT:
        r->output = value;
        break;
    case OPT_FRAMES:
        if ((wrong = frame_list_parse(&r->frames, value)))
            return console_error(EXIT_CODE_USAGE, "--frames %s: %s", value, wrong);
        r->frames_given = true;
        break;
    case OPT_SIZE:
        return set_size(value, size);
    case OPT_CROP:
        if (!number_parse_list(value, ',', MGT_MAX_IMAGE_SIDE, 4, r->crop) || r->crop[2] == 0 || r->crop[3] == 0)
            return bad_value(OPT_CROP, value, "X,Y,W,H in pixels, W and H at least 1");
        r->crop_given = true;
        break;
    case OPT_METHOD:
        if (!method_from_name(value, &r->quality))
            return bad_value(OPT_METHOD, value, method_names().text);
        break;
    case OPT_SPATIAL:
        samples->spatial = value;
        break;
    case OPT_TIME:
        samples->time = value;
        break;
    case OPT_RANGE:
        samples->range = value;
        break;
    case OPT_NDF_MEAN:
        samples->ndf_mean = value;
        break;
    case OPT_SET:
        r->overrides[r->override_count++] = value;
        break;
    case OPT_SEED:
        if (!number_parse_u64(value, UINT64_MAX, &r->quality.seed))
            return bad_value(OPT_SEED, value, "a whole number from 0 to 18446744073709551615");
        break;
    case OPT_LAYER:
        return add_layer(r, value);
    case OPT_BACKEND:
    case OPT_GL_DEVICE:
    case OPT_THREADS:
    case OPT_ISA: {
        const char *allowed = context_option_set(&r->context, render_options[id].name, value);
        return allowed ? bad_value((size_t)id, value, allowed) : EXIT_CODE_OK;
    }
    case OPT_OVERWRITE:
        r->overwrite = true;
        break;
    case OPT_SKIP:
        r->skip_existing = true;
        break;
    case OPT_STAMP:
        r->stamp = true;
        break;
    case OPT_PROGRESS:
        if (!progress_mode_from_name(value, &r->progress))
            return bad_value(OPT_PROGRESS, value, "auto, json or none");
        break;
    default: { /* of a method */
        const char *name = render_options[id].name;
        *method_option(&samples->method, name, strlen(name)) = value;
        break;
    }
    }
    return EXIT_CODE_OK;
}

/* What a kind of file can hold. */
static int check_layers(render_request *r)
{
    if (r->layer_count == 0)
        r->layers[r->layer_count++] = MGT_LAYER_COLOR;
    if (r->format == PICTURE_EXR)
        return EXIT_CODE_OK;
    if (r->layer_count > 1)
        return console_error(EXIT_CODE_USAGE, "%s: only .exr holds several layers; ask for one --layer", r->output);
    if (r->layers[0] == MGT_LAYER_DEPTH && r->format != PICTURE_PFM)
        return console_error(EXIT_CODE_USAGE, "%s: depth does not fit into 8 bits; write .exr or .pfm", r->output);
    return EXIT_CODE_OK;
}

static int check_output(render_request *r)
{
    if (!r->scene_path)
        return console_error(EXIT_CODE_USAGE, "no scene given; see mangata render --help");
    if (!r->output)
        return console_error(EXIT_CODE_USAGE, "no output given: -o OUT; see mangata render --help");
    const char *wrong = frame_path_parse(&r->path, r->output);
    if (wrong)
        return console_error(EXIT_CODE_USAGE, "-o %s: %s", r->output, wrong);
    r->format = picture_format_of(r->output);
    if (r->format == PICTURE_UNKNOWN)
        return console_error(EXIT_CODE_USAGE, "-o %s: unknown kind of file; allowed are .png .exr .pfm .mp4 .y4m", r->output);
    if (render_is_film(r) && r->path.numbered)
        return console_error(EXIT_CODE_USAGE, "-o %s: a film is one file; leave the frame number out", r->output);
    if (!render_is_film(r) && !r->path.numbered && r->frames_given && frame_list_length(&r->frames) > 1)
        return console_error(EXIT_CODE_USAGE, "-o %s: %llu frames do not fit into one picture; number the files: frame_%%04d.png or frame_####.png", r->output,
                             (unsigned long long)frame_list_length(&r->frames));
    return check_layers(r);
}

/* Fills the request from the command line. Returns an exit code, or -1 when there is nothing more to do. */
static int read_command_line(render_request *r, int count, char **arguments, char size[2][32])
{
    option_reader reader = option_reader_start(&render_table, &r->out, count, arguments);
    sample_options samples = {0};
    const char *value = NULL;
    int id;
    while ((id = option_reader_next(&reader, &value)) != OPTION_END) {
        if (id == OPTION_HELP)
            return -1;
        if (id == OPTION_ERROR)
            return EXIT_CODE_USAGE;
        if (id == OPTION_OPERAND) {
            if (r->scene_path)
                return console_error(EXIT_CODE_USAGE, "one scene at a time: %s and %s are given", r->scene_path, value);
            r->scene_path = value;
            continue;
        }
        const int code = set_option(r, id, value, &samples, size);
        if (code != EXIT_CODE_OK)
            return code;
    }
    if (size[0][0]) {
        r->overrides[r->override_count++] = size[0];
        r->overrides[r->override_count++] = size[1];
    }
    const int code = set_samples(&r->quality, &samples);
    return code == EXIT_CODE_OK ? check_output(r) : code;
}

int verb_render(int count, char **arguments)
{
    char size[2][32] = {{0}};
    render_request *request = calloc(1, sizeof *request);
    /* Each --set takes a word of the command line; two more hold the size. */
    const char **overrides = calloc((size_t)count + 2, sizeof *overrides);
    int code = EXIT_CODE_FAILED;
    if (!request || !overrides) {
        console_error(code, "out of memory");
        goto done;
    }
    request->overrides = overrides;
    mgt_quality_init(&request->quality, sizeof request->quality);
    method_from_name("mangata", &request->quality);
    progress_mode_from_name("auto", &request->progress);
    code = read_command_line(request, count, arguments, size);
    if (code == EXIT_CODE_OK) {
        if (request->out.quiet && request->progress == PROGRESS_BAR)
            request->progress = PROGRESS_NONE;
        code = render_job_run(request);
    } else if (code < 0) {
        code = EXIT_CODE_OK;
    }
done:
    free(overrides);
    free(request);
    return code;
}
