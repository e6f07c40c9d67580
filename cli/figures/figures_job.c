/* SPDX-License-Identifier: MIT */
/* The run of `mangata figures`: the pictures that are needed, the function that makes each figure, and functions that figures share. */
#include "cli/figures/figures_job.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/figures/figures_refraction.h"
#include "cli/common/interrupt.h"
#include "cli/common/memory_text.h"

const char *const figure_scenes[FIGURE_SCENES] = {"simple", "smooth", "medium", "high"};

const double figure_stops[FIGURE_EXPOSURES] = {0, 4, 8, 12};

const figure_method_text figure_methods[FIGURE_METHODS] = {
    [FIGURE_NONE] = {"none", "no AA"},
    [FIGURE_MSAA32] = {"msaa32", "32x MSAA"},
    [FIGURE_LEAN] = {"lean", "LEAN"},
    [FIGURE_UNIFORM] = {"podee-uniform:kernels=9", "Podee et al., uniform"},
    [FIGURE_PIXEL] = {"podee-pixel:kernels=9", "Podee et al., per pixel"},
    [FIGURE_MANGATA] = {"mangata", "mangata"},
    [FIGURE_KERNELS_1] = {"podee-pixel:kernels=1:elongation=1e6", "1 kernel"},
    [FIGURE_KERNELS_3] = {"podee-pixel:kernels=3:elongation=1e6", "3 kernels"},
    [FIGURE_KERNELS_5] = {"podee-pixel:kernels=5:elongation=1e6", "5 kernels"},
    [FIGURE_KERNELS_9] = {"podee-pixel:kernels=9:elongation=1e6", "9 kernels"},
    [FIGURE_FELINE] = {"podee-pixel:kernels=feline", "Feline"},
    [FIGURE_RIEMANN] = {"podee-pixel:kernels=riemann", "convolution (Riemann)"},
    [FIGURE_HARD] = {"podee-uniform:kernels=9:transition=hard", "without transition"},
};

bool figure_wanted(const figures_job *f, figure_id id) { return (f->request->wanted >> id & 1) != 0; }

bool figures_podee_wanted(const figures_job *f) { return (f->request->wanted & ((1u << FIGURES_PODEE) - 1)) != 0; }

/* Whether the request wants any figure of Liu et al. */
static bool liu_wanted(const figures_job *f) { return f->request->wanted >> FIGURES_PODEE != 0; }

int figures_no_memory(void) { return console_error(EXIT_CODE_FAILED, "out of memory"); }

/* ---- which pictures ---- */

static bool method_wanted(const figures_job *f, figure_method method)
{
    const uint32_t wanted = f->request->wanted;
    const uint32_t six = 1u << FIGURE_TABLE1 | 1u << FIGURE_13 | 1u << FIGURE_14 | 1u << FIGURE_15 | 1u << FIGURE_16 | 1u << FIGURE_18;
    if (method == FIGURE_HARD)
        return figure_wanted(f, FIGURE_11);
    if (method >= FIGURE_KERNELS_1)
        return figure_wanted(f, FIGURE_17);
    return (wanted & six) || (figure_wanted(f, FIGURE_11) && (method == FIGURE_UNIFORM || method == FIGURE_MANGATA));
}

/* Whether `folder` holds the scenes. Sets f->folder and f->scene_paths. */
static bool try_scenes(figures_job *f, const char *folder)
{
    for (int i = 0; i < FIGURE_SCENES; i++)
        if ((size_t)snprintf(f->scene_paths[i], sizeof f->scene_paths[i], "%s/%s.json", folder, figure_scenes[i]) >= sizeof f->scene_paths[i])
            return false;
    if (access(f->scene_paths[0], R_OK) != 0)
        return false;
    return (size_t)snprintf(f->folder, sizeof f->folder, "%s", folder) < sizeof f->folder;
}

/* Finds the scenes in the present folder, beside a build folder, or where they are installed. */
static int find_scenes(figures_job *f)
{
    static const char *const places[] = {"../scenes", "../share/mangata/scenes"};
    const char *given = f->request->scenes;
    if (given)
        return try_scenes(f, given) ? EXIT_CODE_OK : console_error(EXIT_CODE_NO_INPUT, "--scenes %s: it holds no simple.json", given);
    if (try_scenes(f, "scenes"))
        return EXIT_CODE_OK;
    char program[4096], folder[4200];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    for (size_t i = 0; slash && i < sizeof places / sizeof places[0]; i++) {
        snprintf(folder, sizeof folder, "%.*s/%s", (int)(slash - program), program, places[i]);
        if (try_scenes(f, folder))
            return EXIT_CODE_OK;
    }
    return console_error(EXIT_CODE_NO_INPUT, "the standard scenes are not here; --scenes DIR says where they are");
}

static int choose_pictures(figures_job *f)
{
    const figures_request *r = f->request;
    compare_request *c = &f->renders;
    *c = (compare_request){.out = r->out,
                           .folder = r->folder,
                           .overwrite = r->overwrite,
                           .changes = r->changes,
                           .reference = r->reference,
                           .frames = r->frames,
                           .shard = r->shard,
                           .time_runs = r->time_runs,
                           .context = r->context,
                           .progress = r->progress};
    for (int m = 0; m < FIGURE_METHODS; m++) {
        char wrong[512];
        if (!method_wanted(f, (figure_method)m))
            continue;
        if (!method_spec_parse(&c->methods[c->method_count], figure_methods[m].spec, strlen(figure_methods[m].spec), wrong, sizeof wrong))
            return console_error(EXIT_CODE_FAILED, "%s", wrong);
        f->picture[m] = ++c->method_count;
    }
    const bool scenes = c->method_count > 0 || figure_wanted(f, FIGURE_12);
    const int code = scenes || liu_wanted(f) ? find_scenes(f) : EXIT_CODE_OK;
    if (!scenes || code != EXIT_CODE_OK)
        return code;
    for (int i = 0; i < FIGURE_SCENES; i++)
        c->scene_paths[i] = f->scene_paths[i];
    c->scene_count = FIGURE_SCENES;
    return EXIT_CODE_OK;
}

/* ---- pictures for the functions that make figures ---- */

int figures_display(compare_job *job, size_t scene, size_t picture, size_t frame, double stops, uint8_t **rgba)
{
    const compare_scene *s = &job->scenes[scene];
    char path[COMPARE_PATH];
    file_error error;
    float_image light = {0};
    mgt_scene view;
    *rgba = NULL;
    if (!compare_picture_path(job, s, picture, frame, path) || !compare_frame_scene(job, s, picture, frame, &view))
        return EXIT_CODE_USAGE;
    if (picture_read(&light, path, "color", &error) != FILE_OK)
        return compare_file_failure(job, &error);
    view.post.exposure_ev += stops;
    const int code = compare_display(job, &view, &light, rgba);
    float_image_free(&light);
    return code;
}

static int embed(figures_job *f, svg *sheet, const char *name, const uint8_t *rgba, uint32_t width, uint32_t height, svg_crop crop, double x, double y,
                 double shown_width, double shown_height)
{
    char path[COMPARE_PATH], file[128];
    file_error error;
    snprintf(file, sizeof file, "pictures/%s.png", name);
    if (!compare_file_path(f->compare, file, path))
        return EXIT_CODE_USAGE;
    if (picture_write_png(path, width, height, rgba, 0, NULL, &f->compare->output, &error) != FILE_OK)
        return compare_file_failure(f->compare, &error);
    size_t size = 0;
    char *png = memory_text_read(path, &size);
    if (!png)
        return console_error(EXIT_CODE_FAILED, "%s: it cannot be read back", path);
    const bool done = svg_picture(sheet, x, y, shown_width, shown_height, (const uint8_t *)png, size, width, height, crop);
    free(png);
    return done ? EXIT_CODE_OK : figures_no_memory();
}

void figures_embed(figures_job *f, svg *sheet, const char *name, const uint8_t *rgba, uint32_t width, uint32_t height, svg_crop crop, double x, double y,
                   double shown_width, double shown_height)
{
    if (figures_good(f))
        f->code = embed(f, sheet, name, rgba, width, height, crop, x, y, shown_width, shown_height);
}

void figures_put(figures_job *f, svg *sheet, size_t scene, size_t picture, const svg_crop *crop, double x, double y, double scale)
{
    const compare_scene *s = &f->compare->scenes[scene];
    uint8_t *rgba = NULL;
    char name[200];
    if (figures_good(f))
        f->code = figures_display(f->compare, scene, picture, 0, figure_stops[FIGURE_SHOWN], &rgba);
    snprintf(name, sizeof name, "%s-%s", s->name, picture == COMPARE_REFERENCE ? "reference" : f->renders.methods[picture - 1].file);
    figures_embed(f, sheet, name, rgba, s->width, s->height, *crop, x, y, crop->width * scale, crop->height * scale);
    free(rgba);
}

svg_crop figures_glitter_crop(uint32_t width, uint32_t height)
{
    const double w = floor(width * 0.34), h = floor(height * 0.68);
    return (svg_crop){floor((width - w) / 2), floor(height * 0.3), w, h};
}

void figures_steps(figures_job *f, uint64_t steps) { f->compare->progress = progress_start(f->request->progress, steps); }

void figures_step(figures_job *f)
{
    if (figures_good(f) && *interrupt_flag())
        f->code = compare_stopped(f->compare);
    f->compare->progress.frames_done++;
    progress_update(&f->compare->progress, 0);
}

/* ---- the run ---- */

static void make_figures(figures_job *f)
{
    static const struct {
        figure_id id;
        void (*make)(figures_job *f);
    } makers[] = {{FIGURE_TABLE1, figures_table1}, {FIGURE_11, figures_transition}, {FIGURE_12, figures_scene_views}, {FIGURE_13, figures_simple},
                  {FIGURE_14, figures_smooth},     {FIGURE_15, figures_medium},     {FIGURE_16, figures_high},        {FIGURE_17, figures_kernels},
                  {FIGURE_18, figures_bars},       {FIGURE_20, figures_mirror},     {FIGURE_21, figures_fits}};
    for (size_t i = 0; i < sizeof makers / sizeof *makers && figures_good(f); i++)
        if (figure_wanted(f, makers[i].id))
            makers[i].make(f);
    progress_clear(&f->compare->progress);
}

static int make_page(figures_job *f)
{
    char *sections = NULL;
    size_t size = 0;
    f->page = open_memstream(&sections, &size);
    if (!f->page)
        return figures_no_memory();
    make_figures(f);
    if (figures_good(f) && f->refraction)
        figures_refraction(f);
    const bool failed = ferror(f->page) != 0;
    if ((fclose(f->page) != 0 || failed) && figures_good(f))
        f->code = figures_no_memory();
    if (figures_good(f))
        figures_write_page(f, sections);
    free(sections);
    return f->code;
}

static int make_pictures_folder(figures_job *f)
{
    char path[COMPARE_PATH];
    if (!compare_file_path(f->compare, "pictures", path))
        return EXIT_CODE_USAGE;
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s: cannot make this folder: %s", path, strerror(errno));
    return EXIT_CODE_OK;
}

static int print_tables(figures_job *f)
{
    char *table = figure_wanted(f, FIGURE_TABLE1) ? figures_table1_text(f) : NULL;
    if (!table && figure_wanted(f, FIGURE_TABLE1))
        return figures_no_memory();
    if (table)
        fputs(table, stdout);
    if (table && f->refraction_table)
        fputc('\n', stdout);
    if (f->refraction_table)
        fputs(f->refraction_table, stdout);
    free(table);
    return EXIT_CODE_OK;
}

/* Writes figures.json, and prints the result. */
static int print_end(figures_job *f)
{
    const figures_request *r = f->request;
    json_object_set(f->result, "claims", f->checks);
    figures_write(f, "figures.json", json_dumps(f->result, JSON_INDENT(1) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(9)));
    if (!figures_good(f))
        return f->code;
    int code;
    console_note(&r->out, "%s/index.html: %llu pictures rendered, %llu kept", r->folder, (unsigned long long)f->compare->rendered,
                 (unsigned long long)f->compare->kept);
    size_t i;
    json_t *check;
    json_array_foreach(f->checks, i, check) if (!json_is_true(json_object_get(check, "holds")))
        console_note(&r->out, "this claim does not hold: %s (%.4g)", json_string_value(json_object_get(check, "claim")),
                     json_number_value(json_object_get(check, "value")));
    if (r->out.json) {
        json_object_set_new(f->result, "run",
                            json_pack("{s:o, s:I, s:I}", "folder", console_json_text(r->folder), "rendered", (json_int_t)f->compare->rendered, "kept",
                                      (json_int_t)f->compare->kept));
        code = console_print_json(json_incref(f->result));
    } else {
        code = print_tables(f);
    }
    if (code == EXIT_CODE_OK && r->check && f->failed)
        code = console_error(EXIT_CODE_DIFFERENT, "%u of %zu claims do not hold", f->failed, json_array_size(f->checks));
    return code;
}

const compare_output figures_outputs[] = {{"index.html", "<title>The papers' figures again</title>"},
                                          {"figures.json", "{\n \"version\": \""},
                                          {"table1.md", "\n\n| method |"},
                                          {"table1.csv", "scene,method,published_rmse,"},
                                          {"refraction.md", "| refraction |"},
                                          {NULL, NULL}};

static int run(figures_job *f)
{
    const figures_request *r = f->request;
    int code = choose_pictures(f);
    if (code != EXIT_CODE_OK)
        return code;
    code = compare_open(f->compare, &f->renders, figures_outputs);
    /* The scenes of both parts are checked before the first picture, so that an error does not appear after hours of rendering. */
    if (code == EXIT_CODE_OK && liu_wanted(f))
        code = figures_refraction_open(f, f->folder);
    if (code == EXIT_CODE_OK)
        code = make_pictures_folder(f);
    if (code == EXIT_CODE_OK && r->progress == PROGRESS_NONE)
        console_note(&r->out, "%s: all plates and tables take about half an hour of two cores the first time; --progress text tells how far they are",
                     r->folder);
    if (code == EXIT_CODE_OK && f->renders.method_count)
        code = compare_render(f->compare);
    if (code == EXIT_CODE_OK && r->shard.count) {
        if (f->refraction)
            figures_refraction(f);
        code = figures_good(f) ? compare_shard_done(f->compare) : f->code;
        goto done;
    }
    if (code == EXIT_CODE_OK && f->renders.method_count)
        code = compare_time_methods(f->compare);
    f->code = code;
    if (figures_good(f) && f->renders.method_count)
        figures_measure(f);
    code = figures_good(f) ? make_page(f) : f->code;
    if (code == EXIT_CODE_OK)
        code = print_end(f);
done:
    figures_refraction_close(f);
    compare_close(f->compare);
    return code;
}

int figures_run(const figures_request *request)
{
    figures_job *f = calloc(1, sizeof *f);
    compare_job *compare = calloc(1, sizeof *compare);
    int code = EXIT_CODE_FAILED;
    if (!f || !compare) {
        figures_no_memory();
        goto done;
    }
    f->request = request;
    f->compare = compare;
    f->checks = json_array();
    f->result = json_pack("{s:s}", "version", mgt_version());
    code = f->checks && f->result ? run(f) : figures_no_memory();
    json_decref(f->checks);
    json_decref(f->result);
    free(f->refraction_table);
done:
    free(compare);
    free(f);
    return code;
}
