/* SPDX-License-Identifier: MIT */
/* `mangata figures`: its command line. The work begins in figures_job.c. */
#include <string.h>

#include "cli/figures/figures_request.h"
#include "cli/common/verbs.h"
#include "params/methods.h"

static const char *const figure_words[FIGURES] = {"table1", "11",         "12",     "13",     "14",     "15",    "16",    "17",
                                                  "18",     "20",         "21",     "liu-4",  "liu-7",  "liu-8", "liu-9", "liu-10",
                                                  "liu-11", "liu-table3", "liu-12", "liu-13", "liu-14", "liu-15"};

static int set_only(const option *o, void *place, const char *value)
{
    uint32_t *wanted = place;
    *wanted = 0;
    for (const char *p = value;;) {
        const size_t length = strcspn(p, ",");
        int id = 0;
        while (id < FIGURES && (strlen(figure_words[id]) != length || strncmp(figure_words[id], p, length) != 0))
            id++;
        if (id == FIGURES)
            return option_wrong(o, value,
                                "a list of table1, 11, 12, 13, 14, 15, 16, 17, 18, 20, 21, liu-4, liu-7, liu-8, liu-9, liu-10, "
                                "liu-11, liu-12, liu-13, liu-14, liu-15, liu-table3");
        *wanted |= 1u << id;
        if (!p[length])
            return EXIT_CODE_OK;
        p += length + 1;
    }
}

static int set_size(const option *o, void *place, const char *value)
{
    figures_request *r = place;
    r->size_given = true;
    return option_size(o, &r->changes, value);
}

static int refuse_operand(const option *o, void *place, const char *value)
{
    (void)o, (void)place;
    return console_error(EXIT_CODE_USAGE, "%s: figures takes no scene; --scenes DIR names their folder", value);
}

static int run(void *request)
{
    figures_request *r = request;
    if (!r->folder || !r->folder[0])
        return console_error(EXIT_CODE_USAGE, "no folder given: -o DIR; see mangata figures --help");
    const int wrong = context_options_check(&r->context);
    if (wrong != EXIT_CODE_OK)
        return wrong;
    r->progress = progress_mode_heard(r->progress, r->out.quiet);
    r->out.json_notes = r->progress == PROGRESS_JSON;
    return figures_run(r);
}

static const option figures_options[] = {
    {"output", 'o', "DIR", "the folder of plates and page; made where it is missing", .set = option_text, .offset = offsetof(figures_request, folder)},
    {"only", 0, "LIST", "of table1, 11 to 18, 20, 21, liu-4, liu-7 to liu-15 and liu-table3\n(default: all), such as table1,17,liu-10", .set = set_only,
     .offset = offsetof(figures_request, wanted)},
    {"frames", 0, "LIST",
     "frames that errors are taken over; plates show the first, of\n"
     "refraction nothing but the first is made (default 0-56:8)",
     .set = option_frames, .offset = offsetof(figures_request, frames)},
    OPTION_SHARD(figures_request,
                 "one of N machines' part of all pictures: draws it and measures\nnothing; the same command without --shard then measures all"),
    {"size", 0, "WxH", "size of what is scored (default 320x180; refraction 640x360, and\n1280x720 for its times)", set_size,
     .least = 16, /* smaller pictures are too small for the parts that plates show */
     .allowed = "WxH, each from 16 to 32768 pixels, such as 320x180"},
    {"spatial", 0, "N", "reference: NxN samples a pixel for each time sample (default 16)", .set = option_samples,
     .offset = offsetof(figures_request, reference.spatial_samples)},
    {"time-samples", 0, "M", "reference: samples of the open shutter (default 8)", .set = option_samples,
     .offset = offsetof(figures_request, reference.time_samples)},
    {"refraction-samples", 0, "N", "refraction's path-traced reference: NxN rays a pixel (default 4)", .set = option_samples,
     .offset = offsetof(figures_request, refraction_samples)},
    {"scenes", 0, "DIR",
     "the folder of the standard scenes, simple.json to pool.yaml\n"
     "(default: scenes here, else those that came with this program)",
     .set = option_text, .offset = offsetof(figures_request, scenes)},
    {"set", 0, "KEY=VALUE", "change a value of every scene; may be repeated", .set = option_change, .offset = offsetof(figures_request, changes)},
    {"time-runs", 0, "N", "timed renders of each method on each scene (default 5; 0: none)", .set = option_number,
     .offset = offsetof(figures_request, time_runs), .most = 1000},
    {"check", 0, NULL, "exit with 2 when a claim of the page does not hold", .set = option_given, .offset = offsetof(figures_request, check)},
    {"overwrite", 0, NULL, "replace files of the plates' and tables' names that this command did not write", .set = option_given,
     .offset = offsetof(figures_request, overwrite)},
    {"backend", 0, "NAME", "cpu (default), gl or auto; null renders nothing: for tests", .set = option_context, .offset = offsetof(figures_request, context)},
    CONTEXT_OPTION_GL_DEVICE(figures_request),
    CONTEXT_OPTION_THREADS(figures_request),
    CONTEXT_OPTION_ISA(figures_request),
    OPTION_PROGRESS(figures_request),
};

static const option_table figures_table = {"figures",
                                           "-o DIR [options]",
                                           "Makes the tables and plates of Podee et al. 2021 and of Liu et al. 2020 again on the standard scenes:\n"
                                           "DIR/index.html with one SVG a plate, table1.md, table1.csv, refraction.md and figures.json. Pictures are\n"
                                           "kept in DIR/frames: the same command again goes on where it was stopped. The first time all of\n"
                                           "it takes about half an hour of two cores. Prints the tables, or with --json everything measured.",
                                           figures_options,
                                           sizeof figures_options / sizeof figures_options[0],
                                           .notes = "exit codes: 0 done, 2 a claim does not hold (--check), 64 usage, 65 bad scene, 66 no such scene,\n"
                                                    "69 not available, 73 cannot write, 75 try again, 129, 130 and 143 stopped by a signal",
                                           .operand = {.set = refuse_operand},
                                           .changes = offsetof(figures_request, changes),
                                           .run = run};

int verb_figures(int count, char **arguments)
{
    figures_request request = {.arguments = arguments,
                               .argument_count = count,
                               .wanted = (1u << FIGURES) - 1,
                               .refraction_samples = 4,
                               .time_runs = 5,
                               .changes = {.width = 320, .height = 180},
                               .progress = progress_mode_auto()};
    mgt_quality_init(&request.reference, sizeof request.reference);
    method_from_name("reference", &request.reference);
    request.reference.spatial_samples = 16;
    /* The reference has another seed than the methods. Otherwise a method with random samples would share samples with the reference. */
    request.reference.seed = 1;
    frame_list_parse(&request.frames, "0-56:8");
    return options_run(&figures_table, &request, count, arguments);
}
