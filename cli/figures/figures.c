/* SPDX-License-Identifier: MIT */
/* `mangata figures`: its command line. The work begins in figures_job.c. */
#include <stdlib.h>
#include <string.h>

#include "cli/figures/figures_request.h"
#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "cli/common/quality_options.h"
#include "cli/common/verbs.h"
#include "params/methods.h"

enum {
    OPT_OUTPUT,
    OPT_ONLY,
    OPT_FRAMES,
    OPT_SIZE,
    OPT_SPATIAL,
    OPT_TIME,
    OPT_RAYS,
    OPT_SCENES,
    OPT_SET,
    OPT_TIME_RUNS,
    OPT_CHECK,
    OPT_BACKEND,
    OPT_GL_DEVICE,
    OPT_THREADS,
    OPT_ISA,
    OPT_PROGRESS
};

static const option figures_options[] = {
    [OPT_OUTPUT] = {"output", 'o', "DIR", "the folder of plates and page; made where it is missing"},
    [OPT_ONLY] = {"only", 0, "LIST", "of table1, 11 to 18, 20, 21, liu-4, liu-7 to liu-15 and liu-table3\n(default: all), such as table1,17,liu-10"},
    [OPT_FRAMES] = {"frames", 0, "LIST",
                    "frames that errors are taken over; plates show the first, of\n"
                    "refraction nothing but the first is made (default 0-56:8)"},
    [OPT_SIZE] = {"size", 0, "WxH", "size of what is scored (default 320x180; refraction 640x360, and\n1280x720 for its times)"},
    [OPT_SPATIAL] = {"spatial", 0, "N", "reference: NxN samples a pixel for each time sample (default 16)"},
    [OPT_TIME] = {"time-samples", 0, "M", "reference: samples of the open shutter (default 8)"},
    [OPT_RAYS] = {"refraction-samples", 0, "N", "the truth of refraction: NxN rays a pixel (default 4)"},
    [OPT_SCENES] = {"scenes", 0, "DIR",
                    "the folder of the standard scenes, simple.json to pool.yaml\n"
                    "(default: scenes here, else those that came with this program)"},
    [OPT_SET] = {"set", 0, "KEY=VALUE", "change a value of every scene; may be repeated"},
    [OPT_TIME_RUNS] = {"time-runs", 0, "N", "timed renders of each method on each scene (default 5; 0: none)"},
    [OPT_CHECK] = {"check", 0, NULL, "exit with 2 when a claim of the page does not hold"},
    [OPT_BACKEND] = {"backend", 0, "NAME", "cpu (default), gl or auto; null renders nothing: for tests"},
    [OPT_GL_DEVICE] = CONTEXT_OPTION_GL_DEVICE,
    [OPT_THREADS] = CONTEXT_OPTION_THREADS,
    [OPT_ISA] = CONTEXT_OPTION_ISA,
    [OPT_PROGRESS] = {"progress", 0, "MODE", "auto (default: a bar on a terminal), json or none"},
};

static const option_table figures_table = {"figures",
                                           "-o DIR [options]",
                                           "Makes the tables and plates of Podee et al. 2021 and of Liu et al. 2020 again on the standard scenes:\n"
                                           "DIR/index.html with one SVG a plate, table1.md, table1.csv, refraction.md and figures.json. Pictures are\n"
                                           "kept in DIR/frames: the same command again goes on where it was stopped. Prints the tables, or with\n"
                                           "--json everything measured.",
                                           figures_options,
                                           sizeof figures_options / sizeof figures_options[0],
                                           .notes = "exit codes: 0 done, 2 a claim does not hold (--check), 64 usage, 65 bad scene, 66 no such scene,\n"
                                                    "69 not available, 73 cannot write, 130 and 143 stopped by a signal"};

static const char *const figure_words[FIGURES] = {"table1", "11",         "12",     "13",     "14",     "15",    "16",    "17",
                                                  "18",     "20",         "21",     "liu-4",  "liu-7",  "liu-8", "liu-9", "liu-10",
                                                  "liu-11", "liu-table3", "liu-12", "liu-13", "liu-14", "liu-15"};

static int bad_value(size_t id, const char *value, const char *allowed)
{
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is %s", figures_options[id].name, value, allowed);
}

static int set_only(const char *value, uint32_t *wanted)
{
    *wanted = 0;
    for (const char *p = value;;) {
        const size_t length = strcspn(p, ",");
        int id = 0;
        while (id < FIGURES && (strlen(figure_words[id]) != length || strncmp(figure_words[id], p, length) != 0))
            id++;
        if (id == FIGURES)
            return bad_value(OPT_ONLY, value,
                             "a list of table1, 11, 12, 13, 14, 15, 16, 17, 18, 20, 21, liu-4, liu-7, liu-8, liu-9, liu-10, "
                             "liu-11, liu-12, liu-13, liu-14, liu-15, liu-table3");
        *wanted |= 1u << id;
        if (!p[length])
            return EXIT_CODE_OK;
        p += length + 1;
    }
}

static int set_number(size_t id, const char *value, uint64_t least, uint64_t most, uint64_t *number)
{
    if (number_parse_u64(value, most, number) && *number >= least)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is a number from %llu to %llu", figures_options[id].name, value, (unsigned long long)least,
                         (unsigned long long)most);
}

static int set_count(size_t id, const char *value, uint32_t *count)
{
    char wrong[240];
    return quality_count_read(figures_options[id].name, value, count, wrong, sizeof wrong) ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "%s", wrong);
}

static int set_size(const char *value, char size[2][32])
{
    uint64_t side[2];
    /* Smaller pictures have no room for what the plates cut out of them. */
    if (!number_parse_list(value, 'x', MGT_MAX_IMAGE_SIDE, 2, side) || side[0] < 16 || side[1] < 16)
        return bad_value(OPT_SIZE, value, "WxH, each from 16 to 32768 pixels, such as 320x180");
    snprintf(size[0], 32, "image.width=%u", (unsigned)side[0]);
    snprintf(size[1], 32, "image.height=%u", (unsigned)side[1]);
    return EXIT_CODE_OK;
}

static int set_option(figures_request *r, int id, const char *value, char size[2][32])
{
    const char *wrong;
    switch (id) {
    case OPTION_OPERAND:
        return console_error(EXIT_CODE_USAGE, "%s: figures takes no scene; --scenes DIR names their folder", value);
    case OPT_OUTPUT:
        r->folder = value;
        break;
    case OPT_ONLY:
        return set_only(value, &r->wanted);
    case OPT_FRAMES:
        if ((wrong = frame_list_parse(&r->frames, value)))
            return console_error(EXIT_CODE_USAGE, "--frames %s: %s", value, wrong);
        break;
    case OPT_SIZE:
        r->size_given = true;
        return set_size(value, size);
    case OPT_SPATIAL:
        return set_count(OPT_SPATIAL, value, &r->reference.spatial_samples);
    case OPT_TIME:
        return set_count(OPT_TIME, value, &r->reference.time_samples);
    case OPT_RAYS:
        return set_count(OPT_RAYS, value, &r->refraction_samples);
    case OPT_SCENES:
        r->scenes = value;
        break;
    case OPT_SET:
        r->overrides[r->override_count++] = value;
        break;
    case OPT_TIME_RUNS:
        return set_number(OPT_TIME_RUNS, value, 0, 1000, &r->time_runs);
    case OPT_CHECK:
        r->check = true;
        break;
    case OPT_BACKEND:
    case OPT_GL_DEVICE:
    case OPT_THREADS:
    case OPT_ISA: {
        const char *allowed = context_option_set(&r->context, figures_options[id].name, value);
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

/* Returns an exit code, or -1 when there is nothing more to do. */
static int read_command_line(figures_request *r, char size[2][32])
{
    option_reader reader = option_reader_start(&figures_table, &r->out, r->argument_count, r->arguments);
    const char *value = NULL;
    int id;
    while ((id = option_reader_next(&reader, &value)) != OPTION_END) {
        if (id == OPTION_HELP)
            return -1;
        if (id == OPTION_ERROR)
            return EXIT_CODE_USAGE;
        const int code = set_option(r, id, value, size);
        if (code != EXIT_CODE_OK)
            return code;
    }
    if (!r->folder || !r->folder[0])
        return console_error(EXIT_CODE_USAGE, "no folder given: -o DIR; see mangata figures --help");
    r->overrides[r->override_count++] = size[0];
    r->overrides[r->override_count++] = size[1];
    return EXIT_CODE_OK;
}

int verb_figures(int count, char **arguments)
{
    char size[2][32] = {"image.width=320", "image.height=180"};
    figures_request *request = calloc(1, sizeof *request);
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
    request->wanted = (1u << FIGURES) - 1;
    mgt_quality_init(&request->reference, sizeof request->reference);
    method_from_name("reference", &request->reference);
    request->reference.spatial_samples = 16;
    /* Not the methods' seed: else one that jitters would share the reference's samples. */
    request->reference.seed = 1;
    request->refraction_samples = 4;
    request->time_runs = 5;
    frame_list_parse(&request->frames, "0-56:8");
    progress_mode_from_name("auto", &request->progress);
    code = read_command_line(request, size);
    if (code == EXIT_CODE_OK) {
        if (request->out.quiet && request->progress == PROGRESS_BAR)
            request->progress = PROGRESS_NONE;
        code = figures_run(request);
    } else if (code < 0) {
        code = EXIT_CODE_OK;
    }
done:
    free(overrides);
    free(request);
    return code;
}
