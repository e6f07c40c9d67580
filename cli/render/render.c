/* SPDX-License-Identifier: MIT */
/* `mangata render`: its command line. The work is in render_job.c. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    OPT_RANGE,
    OPT_INTEGRAL,
    OPT_SET,
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
    [OPT_RANGE] = {"samples-range", 0, "FIRST,COUNT", "reference, ssaaN: take only these of the NxNxM samples"},
    [OPT_INTEGRAL] = {"integral", 0, "exact|kernels", "podee-*: --kernels exact, or 9 where --kernels is not given"},
    [OPT_SET] = {"set", 0, "KEY=VALUE",
                 "change a value of the scene, e.g. light.elevation_deg=3;\n"
                 "may be repeated"},
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
                                          .notes = "The same scene, frame and options give the same bytes, whatever the threads and the machine.\n"
                                                   "exit codes: 0 done, 1 failed, 64 usage, 65 bad scene, 66 no such input, 69 not available,\n"
                                                   "73 cannot write, 130 and 143 stopped by a signal",
                                          .quality = true};

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
    if (!all && !mgt_layer_from_name(value, &layer))
        return console_error(EXIT_CODE_USAGE, "--layer %s: allowed is %s or all", value, names_list(layer_names).text);
    bool wanted[LAYER_COUNT] = {false};
    for (size_t i = 0; i < r->layer_count; i++)
        wanted[r->layers[i]] = true;
    r->layer_count = 0;
    for (int i = 0; i < LAYER_COUNT; i++)
        if (wanted[i] || all || i == (int)layer)
            r->layers[r->layer_count++] = (mgt_layer)i;
    return EXIT_CODE_OK;
}

static int set_quality(render_request *r, const char *name, const char *value)
{
    char wrong[600];
    bool known;
    return quality_option_set(&r->options, name, strlen(name), value, &known, wrong, sizeof wrong) ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "%s", wrong);
}

static int set_option(render_request *r, int id, const char *value, char size[2][32])
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
    case OPT_RANGE:
    case OPT_INTEGRAL:
        return set_quality(r, render_options[id].name, value);
    case OPT_SET:
        r->overrides[r->override_count++] = value;
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
    default:
        return set_quality(r, quality_fields[id - OPTION_QUALITY].key, value);
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
        const int code = set_option(r, id, value, size);
        if (code != EXIT_CODE_OK)
            return code;
    }
    if (size[0][0]) {
        r->overrides[r->override_count++] = size[0];
        r->overrides[r->override_count++] = size[1];
    }
    return check_output(r);
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
    request->options = quality_options_none();
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
