/* SPDX-License-Identifier: MIT */
/* `mangata render`: its command line. The work is in render_job.c. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "image/video.h"
#include "cli/render/render_request.h"
#include "cli/common/verbs.h"

static int set_crop(const option *o, void *place, const char *value)
{
    render_request *r = place;
    if (!number_parse_list(value, ',', MGT_MAX_IMAGE_SIDE, 4, r->crop) || r->crop[2] == 0 || r->crop[3] == 0)
        return option_wrong(o, value, "X,Y,W,H in pixels, W and H at least 1");
    return EXIT_CODE_OK;
}

static int add_layer(const option *o, void *place, const char *value)
{
    render_request *r = place;
    mgt_layer layer = MGT_LAYER_COLOR;
    const bool all = strcmp(value, "all") == 0;
    if (!all && !mgt_layer_from_name(value, &layer))
        return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is %s or all; --layer may be repeated", o->name, value, names_list(layer_names).text);
    bool wanted[LAYER_COUNT] = {false};
    for (size_t i = 0; i < r->layer_count; i++)
        wanted[r->layers[i]] = true;
    r->layer_count = 0;
    for (int i = 0; i < LAYER_COUNT; i++)
        if (wanted[i] || all || i == (int)layer)
            r->layers[r->layer_count++] = (mgt_layer)i;
    return EXIT_CODE_OK;
}

/* Checks that the file format can hold the layers. */
static int check_layers(render_request *r)
{
    if (r->format == PICTURE_SUMS)
        return EXIT_CODE_OK;
    if (r->layer_count == 0)
        r->layers[r->layer_count++] = MGT_LAYER_COLOR;
    if (r->format == PICTURE_EXR)
        return EXIT_CODE_OK;
    if (r->layer_count > 1)
        return console_error(EXIT_CODE_USAGE, "%s: only .exr holds several layers; ask for one --layer", r->output);
    /* Metres, and radiance that no exposure and tone map has been chosen for. */
    if ((r->layers[0] == MGT_LAYER_DEPTH || r->layers[0] == MGT_LAYER_REFRACTION) && r->format != PICTURE_PFM)
        return console_error(EXIT_CODE_USAGE, "%s: %s does not fit into 8 bits; write .exr or .pfm", r->output, mgt_layer_name(r->layers[0]));
    return EXIT_CODE_OK;
}

static int set_codec(const option *o, void *place, const char *value)
{
    render_request *r = place;
    return video_codec_from_name(value, &r->film.codec) ? EXIT_CODE_OK : option_wrong(o, value, VIDEO_CODEC_NAMES);
}

static int set_crf(const option *o, void *place, const char *value)
{
    render_request *r = place;
    uint64_t crf;
    if (!number_parse_u64(value, VIDEO_CRF_MOST, &crf))
        return option_wrong(o, value, "a number from 0 (lossless for h264) to 51");
    r->film.crf = (int)crf;
    r->film.crf_given = true;
    return EXIT_CODE_OK;
}

/* Whether the options of films fit the format. If not, it prints why. */
static bool film_fits(render_request *r)
{
    const bool encoded = r->format == PICTURE_MP4 || r->format == PICTURE_MOV;
    if (!encoded && (r->film.codec != VIDEO_CODEC_DEFAULT || r->film.crf_given))
        return console_error(0, "-o %s: --codec and --crf are for .mp4 and .mov", r->output), false;
    if (r->film.codec == VIDEO_CODEC_DEFAULT)
        r->film.codec = r->format == PICTURE_MOV ? VIDEO_CODEC_PRORES : VIDEO_CODEC_H264;
    if (r->format == PICTURE_MP4 && r->film.codec == VIDEO_CODEC_PRORES)
        return console_error(0, "-o %s: --codec prores goes into .mov", r->output), false;
    if (r->film.codec == VIDEO_CODEC_PRORES && r->film.crf_given)
        return console_error(0, "--crf is for h264 and hevc; prores has one quality, HQ"), false;
    if (!r->film.crf_given)
        r->film.crf = VIDEO_CRF_DEFAULT;
    return true;
}

static int set_checkpoint(const option *o, void *place, const char *value)
{
    render_request *r = place;
    if (!number_parse_double(value, &r->checkpoint) || r->checkpoint < 0.1 || r->checkpoint > 86400)
        return option_wrong(o, value, "a number of seconds from 0.1 to 86400");
    return EXIT_CODE_OK;
}

/* Checks the options that files of sums and checkpoints exclude. */
static int check_sums(render_request *r)
{
    if (r->format == PICTURE_SUMS && r->layer_count)
        return console_error(EXIT_CODE_USAGE, "-o %s: a file of sums serves every layer; --layer is for the mangata merge that makes a picture", r->output);
    if (r->checkpoint > 0 && render_is_film(r))
        return console_error(EXIT_CODE_USAGE, "-o %s: --checkpoint is for pictures; a film is made of them afterwards", r->output);
    if (r->format == PICTURE_SUMS && r->context.backend == MGT_BACKEND_GL)
        return console_error(EXIT_CODE_USAGE, "-o %s: sums are the CPU's; leave out --backend gl", r->output);
    if (r->format == PICTURE_SUMS && r->context.backend == MGT_BACKEND_AUTO)
        r->context.backend = MGT_BACKEND_CPU;
    return EXIT_CODE_OK;
}

static int check_output(render_request *r, const char *verb)
{
    if (!r->scene_path)
        return console_error(EXIT_CODE_USAGE, "no scene given; see mangata %s --help", verb);
    if (!r->output)
        return console_error(EXIT_CODE_USAGE, "no output given: -o OUT; see mangata %s --help", verb);
    file_error error;
    if (output_file_check_kind(r->output, &error) != FILE_OK)
        return console_file_error(&error);
    const char *wrong = frame_path_parse(&r->path, r->output);
    if (wrong)
        return console_error(EXIT_CODE_USAGE, "-o %s: %s", r->output, wrong);
    r->format = picture_format_of(r->output);
    if (r->format == PICTURE_UNKNOWN)
        return console_error(EXIT_CODE_USAGE, "-o %s: unknown kind of file; allowed are .png .exr .pfm .mp4 .mov .y4m .sums", r->output);
    if (render_is_film(r) && r->path.numbered)
        return console_error(EXIT_CODE_USAGE, "-o %s: a film is one file; leave the frame number out", r->output);
    if (!render_is_film(r) && !r->path.numbered && frame_list_length(&r->frames) > 1)
        return console_error(EXIT_CODE_USAGE, "-o %s: %llu frames do not fit into one picture; number the files: frame_%%04d.png or frame_####.png", r->output,
                             (unsigned long long)frame_list_length(&r->frames));
    if (r->shard.count && !r->path.numbered)
        return console_error(EXIT_CODE_USAGE, "-o %s: --shard takes numbered pictures, such as frame_%%04d.png; a film is made of them afterwards", r->output);
    if (r->format != PICTURE_EXR && !exr_choice_is_plain(&r->exr))
        return console_error(EXIT_CODE_USAGE, "-o %s: --exr is for .exr alone", r->output);
    if (!film_fits(r))
        return EXIT_CODE_USAGE;
    int code = context_options_check(&r->context);
    if (code == EXIT_CODE_OK)
        code = check_sums(r);
    return code == EXIT_CODE_OK ? check_layers(r) : code;
}

static int render_checked(render_request *r)
{
    r->progress = progress_mode_heard(r->progress, r->out.quiet);
    r->out.json_notes = r->progress == PROGRESS_JSON;
    return render_job_run(r);
}

static int run(void *request)
{
    const int code = check_output(request, "render");
    return code == EXIT_CODE_OK ? render_checked(request) : code;
}

static int run_merge(void *request)
{
    render_request *r = request;
    const int code = check_output(r, "merge");
    if (code != EXIT_CODE_OK)
        return code;
    if (!r->part_count)
        return console_error(EXIT_CODE_USAGE, "no parts given: mangata merge SCENE PART.sums... -o OUT; see mangata merge --help");
    return render_checked(r);
}

/* Takes an operand of mangata merge: the scene first, then the parts. */
static int add_merged(const option *o, void *place, const char *value)
{
    render_request *r = place;
    (void)o;
    if (!r->scene_path) {
        r->scene_path = value;
        return EXIT_CODE_OK;
    }
    const char *wrong = frame_path_parse(&r->parts[r->part_count], value);
    if (wrong)
        return console_error(EXIT_CODE_USAGE, "%s: %s", value, wrong);
    r->part_paths[r->part_count++] = value;
    return EXIT_CODE_OK;
}

static const option render_options[] = {
    {"output", 'o', "OUT",
     "the file to write: .png .exr .pfm, or a film: .mp4 .mov .y4m;\n"
     "several pictures: frame_%04d.png or frame_####.png; .sums:\n"
     "sums of samples, for mangata merge",
     .set = option_text, .offset = offsetof(render_request, output)},
    OPTION_SEA,
    {"frames", 0, "LIST",
     "A, A-B, A-B:STEP or a list of these, up to " FRAME_LIMIT_TEXT "\n"
     "(default: all frames of the scene for a film or a numbered name,\n"
     "else frame 0)",
     .set = option_frames, .offset = offsetof(render_request, frames)},
    OPTION_SHARD(render_request, "one of N machines' part: the frames whose place in the list,\ncounted from 0, modulo N is I"),
    {"size", 0, "WxH", "size in pixels instead of the scene's", .set = option_size, .offset = offsetof(render_request, changes), .least = 1,
     .allowed = "WxH, each from 1 to 32768 pixels, such as 1280x720"},
    {"crop", 0, "X,Y,W,H", "render this rectangle of the picture alone", .set = set_crop},
    {"method", 0, OPTION_VALUE_METHOD, "how pixels are filtered: one of the methods below (default mangata)", .set = option_quality,
     .offset = offsetof(render_request, options)},
    {"integral", 0, "exact|kernels", "podee-*: --kernels exact, or 9 where --kernels is not given", .set = option_quality,
     .offset = offsetof(render_request, options)},
    {"set", 0, "KEY=VALUE",
     "change a value of the scene, e.g. light.elevation_deg=3;\n"
     "may be repeated",
     .set = option_change, .offset = offsetof(render_request, changes)},
    {"layer", 0, "NAME",
     "color (default), coverage, mask, depth, normal, samples,\n"
     "importance, detail, refraction, refraction_error or foam; may be\n"
     "repeated for .exr, which also takes all",
     .set = add_layer},
    {"exr", 0, "WORDS",
     ".exr, separated by commas: float (default) or half (16 bits), zip\n"
     "(default), piz or none, alpha (channel A, the fraction of water),\n"
     "z (channel Z, metres along the view), acescg, parts (a part for\n"
     "each layer), cryptomatte or cryptomatte:N (mattes of objects, water\n"
     "and sky by NxN rays a pixel; default 4)",
     .set = option_exr, .offset = offsetof(render_request, exr)},
    {"codec", 0, "NAME", "films: h264 (default of .mp4), hevc (10 bits), prores (422 HQ, default\nof .mov)", .set = set_codec},
    {"crf", 0, "N", "films: quality of h264 and hevc, 0 (best) to 51 (default 16)", .set = set_crf},
    CONTEXT_OPTION_THREADS(render_request),
    CONTEXT_OPTION_ISA(render_request),
    {"overwrite", 0, NULL, "replace existing output", .set = option_given, .offset = offsetof(render_request, overwrite)},
    {"skip-existing", 0, NULL,
     "keep existing output that was rendered from the same scene\n"
     "with the same options; together with --overwrite: replace\n"
     "the rest",
     .set = option_given, .offset = offsetof(render_request, skip_existing)},
    {"dry-run", 0, NULL, "check everything that is checked before the first frame; render and\nwrite nothing", .set = option_given,
     .offset = offsetof(render_request, dry_run)},
    {"stamp", 0, NULL, "record host, date, threads and instruction set in the output", .set = option_given, .offset = offsetof(render_request, stamp)},
    OPTION_PROGRESS(render_request),
    /* The options from here on are not those of merge. */
    {"samples-range", 0, "FIRST,COUNT",
     "reference, ssaaN: take only these of the NxNxM samples; or I/N,\nthe part I of N equal ones. adaptive podee: of the M of --slots", .set = option_quality,
     .offset = offsetof(render_request, options)},
    {"checkpoint", 0, "SECONDS",
     "what has ranges: keep what is done in OUT.checkpoint about so\n"
     "often, from which the same command goes on after a kill",
     .set = set_checkpoint},
    {"backend", 0, "NAME", "cpu (default), gl, auto, or null (for tests: renders nothing, writes\nfiles whose pixels are zero)", .set = option_context,
     .offset = offsetof(render_request, context)},
    CONTEXT_OPTION_GL_DEVICE(render_request),
};
enum { RENDER_ONLY = 4 };

static const option_table render_table =
    {"render",
     "SCENE -o OUT [options]\n       mangata render --sea wind=12 -o OUT [options]",
     "Renders frames of a scene into pictures or a film.",
     render_options,
     sizeof render_options / sizeof render_options[0],
     .notes = "The same scene, frame and options give the same bytes, whatever the threads and the machine, but for --isa sse2,\n"
              "a compatible build without fused arithmetic.\n"
              "exit codes: 0 done, 1 failed, 64 usage, 65 bad scene, 66 no such input, 69 not available,\n"
              "73 cannot write, 75 try again (a device was lost, no thread could be started), 129, 130 and 143 stopped by a signal",
     .operand = {.set = option_one_scene, .offset = offsetof(render_request, scene_path)},
     .quality = offsetof(render_request, options),
     .changes = offsetof(render_request, changes),
     .run = run};

int verb_render(int count, char **arguments)
{
    render_request request = {.options = quality_options_none(), .progress = progress_mode_auto()};
    return options_run(&render_table, &request, count, arguments);
}

static const option_table merge_table =
    {"merge",
     "SCENE PART.sums... -o OUT [options]",
     "Makes a picture of samples that mangata render -o PART.sums --samples-range has rendered in parts.",
     render_options,
     sizeof render_options / sizeof render_options[0] - RENDER_ONLY,
     .notes = "The scene and the options are those of the parts, which hold exact sums: however the samples were cut into parts, the picture has\n"
              "the bytes of the one that a single mangata render makes. A part that is numbered, p0_%04d.sums, stands for a part of each frame.\n"
              "exit codes: those of render; 65 a part that is damaged, of something else, or given twice, 66 a part or samples missing",
     .operand = {.set = add_merged},
     .quality = offsetof(render_request, options),
     .changes = offsetof(render_request, changes),
     .run = run_merge};

int verb_merge(int count, char **arguments)
{
    render_request request = {.options = quality_options_none(), .progress = progress_mode_auto()};
    request.part_paths = calloc((size_t)count + 1, sizeof *request.part_paths);
    request.parts = calloc((size_t)count + 1, sizeof *request.parts);
    const int code =
        request.part_paths && request.parts ? options_run(&merge_table, &request, count, arguments) : console_error(EXIT_CODE_FAILED, "out of memory");
    free(request.part_paths);
    free(request.parts);
    return code;
}
