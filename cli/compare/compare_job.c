/* SPDX-License-Identifier: MIT */
/* A comparison from loading the scenes to checking the limits. Everything that can be checked is checked before rendering. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/compare/compare_external.h"
#include "cli/compare/compare_page.h"
#include "cli/compare/compare_scores.h"
#include "cli/compare/compare_tables.h"
#include "cli/common/interrupt.h"

const char *compare_picture_name(const compare_job *job, size_t picture)
{
    static const char *const halves[] = {"reference-1", "reference-2"};
    if (picture >= COMPARE_HALF)
        return halves[picture - COMPARE_HALF];
    return picture == COMPARE_REFERENCE ? "reference" : job->request->methods[picture - 1].name;
}

/* The name of a picture in its files' names. */
static const char *picture_file(const compare_job *job, size_t picture)
{
    return picture == COMPARE_REFERENCE || picture >= COMPARE_HALF ? compare_picture_name(job, picture) : job->request->methods[picture - 1].file;
}

const mgt_quality *compare_picture_quality(const compare_scene *scene, size_t picture)
{
    if (picture >= COMPARE_HALF)
        return &scene->halves[picture - COMPARE_HALF];
    return picture == COMPARE_REFERENCE ? &scene->reference : &scene->methods[picture - 1];
}

static bool is_external(const compare_job *job, size_t picture)
{
    return picture != COMPARE_REFERENCE && picture < COMPARE_HALF && compare_is_external(job->request, picture - 1);
}

uint32_t compare_frame_number(const compare_job *job, size_t frame) { return frame_list_at(&job->request->frames, frame); }

bool compare_file_path(const compare_job *job, const char *name, char path[COMPARE_PATH])
{
    const int length = snprintf(path, COMPARE_PATH, "%s/%s", job->request->folder, name);
    if (length > 0 && length < COMPARE_PATH)
        return true;
    console_error(0, "%s: the path is too long", job->request->folder);
    return false;
}

bool compare_picture_path(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, char path[COMPARE_PATH])
{
    char name[METHOD_SPEC_TEXT + 96];
    if (is_external(job, picture))
        return compare_external_path(job, scene, picture - 1, frame, path);
    snprintf(name, sizeof name, "frames/%s/%s_%04u.exr", scene->name, picture_file(job, picture), compare_frame_number(job, frame));
    return compare_file_path(job, name, path);
}

int compare_read_layer(compare_job *job, const compare_scene *scene, size_t picture, size_t frame, const char *layer, float_image *image)
{
    const bool color = strcmp(layer, "color") == 0;
    const compare_result *result = is_external(job, picture) ? &scene->results[picture - 1] : NULL;
    char path[COMPARE_PATH];
    file_error error;
    if (result && (color ? result->lacks_color : result->lacks_coverage)) {
        *image = (float_image){scene->width, scene->height, color ? 3 : 1, NULL};
        image->pixels = calloc((size_t)image->width * image->height * image->channels, sizeof *image->pixels);
        return image->pixels ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
    }
    if (!compare_picture_path(job, scene, picture, frame, path))
        return EXIT_CODE_USAGE;
    return picture_read(image, path, layer, &error) == FILE_OK ? EXIT_CODE_OK : compare_file_failure(job, &error);
}

bool compare_draws(const compare_scene *scene, size_t picture)
{
    return picture == COMPARE_REFERENCE || picture >= COMPARE_HALF || scene->view->methods == 0 || (scene->view->methods >> (picture - 1) & 1);
}

bool compare_number_scene(const compare_scene *scene, size_t picture, uint32_t number, mgt_scene *out)
{
    if (!scene_file_frame(scene->file, (int)number, out)) {
        console_error(0, "%s: the camera of frame %u is not a legal one", scene->path, number);
        return false;
    }
    out->quality = *compare_picture_quality(scene, picture);
    return true;
}

bool compare_frame_scene(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, mgt_scene *out)
{
    return compare_number_scene(scene, picture, compare_frame_number(job, frame), out);
}

int compare_stopped(compare_job *job)
{
    progress_clear(&job->progress);
    console_note(&job->request->out, "mangata: stopped; the same command goes on from here");
    return interrupt_exit_code();
}

int compare_file_failure(compare_job *job, const file_error *error)
{
    progress_clear(&job->progress);
    return error->status == FILE_CANCELLED ? compare_stopped(job) : console_file_error(error);
}

int compare_write_text(compare_job *job, const char *path, const char *text, size_t size)
{
    file_error error;
    return output_file_write_whole(path, text, size, &job->output, &error) == FILE_OK ? EXIT_CODE_OK : compare_file_failure(job, &error);
}

/* ---- before the first pixel ---------------------------------------------------------------------------- */

static bool on_progress(void *user, double fraction)
{
    compare_job *job = user;
    progress_update(&job->progress, job->part_first + job->part_share * fraction);
    return *interrupt_flag() == 0;
}

/* Sets the name of a scene: "scenes/high.json" becomes "high", a second one "high-2"; "--sea wind=7.5" becomes "sea_wind_7_5". */
static void name_scene(compare_job *job, size_t index)
{
    compare_scene *scene = &job->scenes[index];
    const char *path = scene->view->name ? scene->view->name : scene->path;
    const bool words = strncmp(path, "--", 2) == 0;
    const char *slash = strrchr(path, '/'), *start = words ? path + 2 : slash ? slash + 1 : path, *dot = words ? NULL : strrchr(start, '.');
    const size_t length = dot && dot > start ? (size_t)(dot - start) : strlen(start);
    char base[48];
    snprintf(base, sizeof base, "%.*s", (int)(length < sizeof base ? length : sizeof base - 1), start);
    for (char *p = base; *p; p++)
        if (!((*p >= 'a' && *p <= 'z') || (*p >= 'A' && *p <= 'Z') || (*p >= '0' && *p <= '9') || *p == '-'))
            *p = '_';
    snprintf(scene->name, sizeof scene->name, "%s", base[0] ? base : "scene");
    for (unsigned number = 2;; number++) {
        size_t i = 0;
        while (i < index && strcmp(job->scenes[i].name, scene->name) != 0)
            i++;
        if (i == index)
            return;
        snprintf(scene->name, sizeof scene->name, "%s-%u", base, number);
    }
}

/* Opens the scene's file with the overrides of the request and of the view. */
static scene_file *load_file(const compare_job *job, const compare_scene *scene, scene_error *error)
{
    const compare_request *r = job->request;
    const compare_view *view = scene->view;
    const char **all = calloc(r->changes.count + view->override_count + 1, sizeof *all);
    if (!all) {
        *error = (scene_error){SCENE_ERROR_MEMORY, "out of memory"};
        return NULL;
    }
    for (size_t i = 0; i < r->changes.count; i++)
        all[i] = r->changes.items[i];
    for (size_t i = 0; i < view->override_count; i++)
        all[r->changes.count + i] = view->overrides[i];
    scene_file *file = scene_file_open(scene->path, all, r->changes.count + view->override_count, error);
    free(all);
    return file;
}

/* Sets the qualities of the reference and of the methods: those of the scene, changed by the request. */
static int set_qualities(const compare_job *job, compare_scene *scene)
{
    const compare_request *r = job->request;
    const mgt_quality base = scene_file_quality(scene->file);
    mgt_quality reference = base;
    char wrong[600];
    reference.method = r->reference.method;
    reference.spatial_samples = r->reference.spatial_samples;
    reference.time_samples = r->reference.time_samples;
    reference.seed = r->reference.seed;
    if (r->reference.refraction_samples > 0)
        reference.refraction_samples = r->reference.refraction_samples;
    scene->reference = quality_restricted(&reference);
    for (size_t m = 0; m < r->method_count; m++) {
        if (!quality_options_apply(&r->methods[m].given, &base, &scene->methods[m], wrong, sizeof wrong))
            return console_error(EXIT_CODE_USAGE, "%s: %s: %s", scene->path, r->methods[m].name, wrong);
        scene->methods[m].seed = r->methods[m].quality.seed;
    }
    return EXIT_CODE_OK;
}

/* Tells whether method `reference` cannot draw a frame: it computes the water's surface alone, seen from above. */
static int look_below(const compare_job *job, const compare_scene *scene, bool *below)
{
    *below = false;
    for (size_t frame = 0; frame < job->frame_count && !*below && scene->reference.method == MGT_METHOD_REFERENCE; frame++) {
        mgt_scene view;
        if (!compare_frame_scene(job, scene, COMPARE_REFERENCE, frame, &view))
            return EXIT_CODE_BAD_INPUT;
        *below = !mgt_supports(MGT_BACKEND_NULL, &view, MGT_LAYER_COVERAGE);
    }
    return EXIT_CODE_OK;
}

/* Sets method ssaa with as many refracted rays as samples, in whole squares, and at least `instants` time samples: a single one would be the instant when
 * the shutter closes. */
static void sample_below(mgt_quality *quality, uint32_t instants)
{
    enum { MOST_SIDE = 64 };
    quality->method = MGT_METHOD_SSAA;
    quality->time_samples = quality->time_samples > instants ? quality->time_samples : instants;
    quality->refraction_samples = 2;
    while (quality->refraction_samples < MOST_SIDE && (uint64_t)quality->refraction_samples * quality->refraction_samples < compare_samples(quality))
        quality->refraction_samples++;
    *quality = quality_restricted(quality);
}

/* Sets the quality of the reference's objects and that of its halves. */
static int finish_reference(const compare_job *job, compare_scene *scene, bool objects)
{
    bool below;
    const int code = look_below(job, scene, &below);
    if (objects)
        scene->reference.refraction = MGT_REFRACTION_PATH_TRACED;
    for (int half = 0; half < 2 && job->request->halved; half++) {
        scene->halves[half] = scene->reference;
        scene->halves[half].time_samples /= 2;
        scene->halves[half].seed += (uint64_t)half;
        if (below)
            sample_below(&scene->halves[half], 2);
    }
    if (below)
        sample_below(&scene->reference, job->request->halved ? 4 : 2);
    return code;
}

static int load_scene(compare_job *job, size_t index)
{
    const compare_request *r = job->request;
    compare_scene *scene = &job->scenes[index];
    scene_error error;
    mgt_scene first;
    scene->path = r->scene_paths[index];
    scene->view = &r->views[index];
    scene->reference_seconds = NAN;
    name_scene(job, index);
    scene->file = load_file(job, scene, &error);
    if (!scene->file)
        return console_scene_error(&error);
    scene->canonical = scene_file_canonical(scene->file, NULL);
    scene->results = calloc(r->method_count, sizeof *scene->results);
    scene->methods = calloc(r->method_count, sizeof *scene->methods);
    if (!scene->canonical || !scene->results || !scene->methods)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    int code = set_qualities(job, scene);
    if (code != EXIT_CODE_OK)
        return code;
    if (!compare_frame_scene(job, scene, COMPARE_REFERENCE, 0, &first))
        return EXIT_CODE_BAD_INPUT;
    scene->width = first.image.width;
    scene->height = first.image.height;
    scene->black_sky = first.sky.model == MGT_SKY_BLACK;
    code = finish_reference(job, scene, first.object_count > 0);
    if (code != EXIT_CODE_OK)
        return code;
    const compare_scene *other = &job->scenes[0];
    if (r->gate_count && (scene->width != other->width || scene->height != other->height))
        return console_error(EXIT_CODE_USAGE, "%s has %u x %u pixels, %s has %u x %u; a limit scores all scenes as one clip, so give --size", other->path,
                             other->width, other->height, scene->path, scene->width, scene->height);
    return EXIT_CODE_OK;
}

/* Checks every frame of every method, so that an error does not appear after an hour of rendering. */
static int check_scene(compare_job *job, const compare_scene *scene)
{
    for (size_t frame = 0; frame < job->frame_count; frame++)
        for (size_t picture = 0; picture <= job->request->method_count; picture++) {
            mgt_scene view;
            if (!compare_draws(scene, picture) || is_external(job, picture))
                continue;
            if (!compare_frame_scene(job, scene, picture, frame, &view))
                return EXIT_CODE_BAD_INPUT;
            const mgt_status status = mgt_scene_check(job->context, &view);
            if (status != MGT_OK)
                return console_error(exit_code_of_status(status), "%s: frame %u by %s: %s", scene->path, compare_frame_number(job, frame),
                                     compare_picture_name(job, picture), mgt_last_error(job->context));
            if (*interrupt_flag())
                return compare_stopped(job);
        }
    return EXIT_CODE_OK;
}

/* Whether a file that exists is another's: its beginning lacks the mark of what would be written there. */
static bool is_foreign(const char *path, const char *mark)
{
    char start[2048];
    FILE *file = fopen(path, "r");
    if (!file)
        return false;
    const size_t length = fread(start, 1, sizeof start, file), marked = strlen(mark);
    bool found = false;
    for (size_t i = 0; i + marked <= length && !found; i++)
        found = memcmp(start + i, mark, marked) == 0;
    fclose(file);
    return length > 0 && !found;
}

/* Checks that a file of the report can be written, and would replace nobody's own file. */
static int check_output(compare_job *job, const compare_output *output)
{
    char path[COMPARE_PATH];
    file_error error;
    if (!compare_file_path(job, output->name, path))
        return EXIT_CODE_USAGE;
    if (output_file_check(path, &job->output, &error) != FILE_OK)
        return compare_file_failure(job, &error);
    if (job->request->overwrite || !is_foreign(path, output->mark))
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_CANNOT_WRITE, "%s: exists already, and this command did not write it; --overwrite replaces it", path);
}

/* Makes the folder, and checks the files that will be written there. */
static int make_report_folder(compare_job *job, const compare_output *outputs)
{
    const char *folder = job->request->folder;
    struct stat state;
    int code = EXIT_CODE_OK;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s: cannot make this folder: %s", folder, strerror(errno));
    if (stat(folder, &state) != 0)
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s: %s", folder, strerror(errno));
    if (!S_ISDIR(state.st_mode))
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s: it is not a folder", folder);
    for (size_t i = 0; outputs[i].name && code == EXIT_CODE_OK; i++)
        code = check_output(job, &outputs[i]);
    return code;
}

/* ---- the end -------------------------------------------------------------------------------------------- */

static const compare_output report_outputs[] = {{"report.html", "<title>Mangata comparison</title>"},
                                                {"report.json", "\"mangata_comparison\": 1"},
                                                {"report.csv", "scene,method,samples,median_ms"},
                                                {"report.tex", "% mangata compare"},
                                                {NULL, NULL}};

typedef struct report_text {
    const char *name;
    char *(*print)(const compare_job *job, size_t *size); /* NULL: out of memory */
} report_text;

static const report_text report_texts[] = {{"report.json", compare_json_text}, {"report.csv", compare_csv_text}, {"report.tex", compare_tex_text}};

static int write_reports(compare_job *job)
{
    int code = EXIT_CODE_OK;
    for (size_t i = 0; i < sizeof report_texts / sizeof report_texts[0] && code == EXIT_CODE_OK; i++) {
        char path[COMPARE_PATH];
        size_t size = 0;
        if (!compare_file_path(job, report_texts[i].name, path))
            return EXIT_CODE_USAGE;
        char *text = report_texts[i].print(job, &size);
        code = text ? compare_write_text(job, path, text, size) : console_error(EXIT_CODE_FAILED, "out of memory");
        free(text);
    }
    return code == EXIT_CODE_OK ? compare_page_write(job) : code;
}

/* Appends a word to a list; "…" stands for what does not fit. */
static void list_word(char *text, size_t size, const char *word)
{
    static const char more[] = ", …";
    const size_t used = strlen(text);
    const bool cut = used >= sizeof more && strcmp(text + used - strlen(more), more) == 0;
    if (used + strlen(word) + 2 * sizeof more < size && !cut)
        snprintf(text + used, size - used, "%s%s", used ? ", " : "", word);
    else if (!cut && used + sizeof more <= size)
        snprintf(text + used, size - used, "%s", more);
}

static int check_gates(const compare_job *job)
{
    int code = EXIT_CODE_OK;
    for (size_t i = 0; i < job->request->gate_count; i++) {
        const compare_gate *gate = &job->request->gates[i];
        const double value = compare_gate_value(job, gate);
        char *mismatches = score_mismatches_text(job, gate->method);
        if (!mismatches)
            code = console_error(EXIT_CODE_FAILED, "out of memory");
        else if (mismatches[0])
            code = console_error(EXIT_CODE_DIFFERENT, "%s, so it passes no limit", mismatches);
        else if (!(value <= gate->limit))
            code = console_error(EXIT_CODE_DIFFERENT, "%s: %s of coverage %g is above %g", job->request->methods[gate->method].name,
                                 gate->flicker ? "flicker" : "RMSE", value, gate->limit);
        free(mismatches);
    }
    return code;
}

/* Why a column has no score; NULL: it has one, or is not wanted. */
static const char *column_missing(const compare_job *job, size_t column)
{
    return score_wanted(job->request, &score_columns[column]) ? score_missing(job, &score_columns[column]) : NULL;
}

/* Warns of columns without any score, once a reason. */
static void warn_of_missing(const compare_job *job)
{
    const compare_request *r = job->request;
    char methods[240] = "", scenes[240] = "";
    for (size_t m = 0; m < r->method_count; m++)
        list_word(methods, sizeof methods, r->methods[m].name);
    for (size_t s = 0; s < r->scene_count; s++)
        list_word(scenes, sizeof scenes, job->scenes[s].name);
    for (size_t c = 0; c < score_column_count; c++) {
        char titles[400] = "";
        const char *missing = column_missing(job, c), *other;
        bool told = false;
        size_t count = 0;
        for (size_t i = 0; missing && i < c; i++)
            told |= (other = column_missing(job, i)) && strcmp(other, missing) == 0;
        for (size_t i = c; missing && !told && i < score_column_count; i++) {
            bool listed = false;
            for (size_t j = c; j < i; j++)
                listed |= strcmp(score_columns[j].title, score_columns[i].title) == 0;
            if (listed || !(other = column_missing(job, i)) || strcmp(other, missing) != 0)
                continue;
            list_word(titles, sizeof titles, score_columns[i].title);
            count++;
        }
        if (count)
            console_note(&r->out, "mangata: warning: %s %s unavailable for %s on %s: %s", titles, count == 1 ? "is" : "are", methods, scenes, missing);
    }
}

static int print_end(const compare_job *job)
{
    const compare_request *r = job->request;
    console_note(&r->out, "%s/report.html: %zu scene%s, %zu method%s, %zu frame%s; %llu pictures rendered, %llu kept", r->folder, r->scene_count,
                 r->scene_count == 1 ? "" : "s", r->method_count, r->method_count == 1 ? "" : "s", job->frame_count, job->frame_count == 1 ? "" : "s",
                 (unsigned long long)job->rendered, (unsigned long long)job->kept);
    warn_of_missing(job);
    char *black = score_black_text(job);
    if (black && black[0])
        console_note(&r->out, "mangata: warning: %s", black);
    free(black);
    for (size_t m = 0; m < r->method_count; m++) {
        char *mismatches = score_mismatches_text(job, m);
        if (mismatches && mismatches[0])
            console_note(&r->out, "mangata: warning: %s", mismatches);
        free(mismatches);
    }
    if (!r->out.json)
        return EXIT_CODE_OK;
    json_t *report = compare_result_json(job);
    if (report)
        json_object_set_new(report, "run",
                            json_pack("{s:o, s:I, s:I}", "folder", console_json_text(r->folder), "rendered", (json_int_t)job->rendered, "kept",
                                      (json_int_t)job->kept));
    return console_print_json(report);
}

int compare_open(compare_job *job, const compare_request *request, const compare_output *outputs)
{
    int code = EXIT_CODE_OK;
    job->request = request;
    job->frame_count = (size_t)frame_list_length(&request->frames);
    if (job->frame_count > COMPARE_FRAMES)
        return console_error(EXIT_CODE_USAGE, "--frames: %zu frames; allowed are %d", job->frame_count, (int)COMPARE_FRAMES);
    job->part_share = 1;
    job->output = (output_options){.overwrite = true, .cancel = interrupt_flag()};
    for (size_t s = 0; s < request->scene_count && code == EXIT_CODE_OK; s++)
        code = load_scene(job, s);
    interrupt_install();
    if (code == EXIT_CODE_OK)
        code = context_open(&request->context, &request->out, on_progress, job, &job->context, &job->info);
    for (size_t s = 0; s < request->scene_count && code == EXIT_CODE_OK; s++)
        code = check_scene(job, &job->scenes[s]);
    if (code == EXIT_CODE_OK)
        code = compare_external_check(job);
    return code == EXIT_CODE_OK ? make_report_folder(job, outputs) : code;
}

static void free_scene(compare_scene *scene, size_t methods)
{
    for (size_t m = 0; scene->results && m < methods; m++) {
        for (int k = 0; k < COMPARE_KINDS; k++)
            free(scene->results[m].frames[k]);
        free(scene->results[m].mismatches);
        json_decref(scene->results[m].texture);
        json_decref(scene->results[m].specks);
    }
    free(scene->results);
    free(scene->methods);
    free(scene->canonical);
    scene_file_free(scene->file);
}

void compare_close(compare_job *job)
{
    for (size_t s = 0; s < job->request->scene_count; s++)
        free_scene(&job->scenes[s], job->request->method_count);
    mgt_context_destroy(job->context);
}

int compare_shard_done(const compare_job *job)
{
    const compare_request *r = job->request;
    console_note(&r->out, "%s: shard %u/%u: %llu pictures rendered, %llu kept; when all shards are done, the same command without --shard measures them",
                 r->folder, r->shard.index, r->shard.count, (unsigned long long)job->rendered, (unsigned long long)job->kept);
    if (!r->out.json)
        return EXIT_CODE_OK;
    return console_print_json(
        json_pack("{s:{s:o, s:I, s:I}}", "run", "folder", console_json_text(r->folder), "rendered", (json_int_t)job->rendered, "kept", (json_int_t)job->kept));
}

/* Times, measures and writes the reports, after all pictures have been rendered. */
static int finish_report(compare_job *job)
{
    int code = compare_time_methods(job);
    if (code == EXIT_CODE_OK)
        code = compare_measure(job);
    if (code == EXIT_CODE_OK)
        code = write_reports(job);
    if (code == EXIT_CODE_OK)
        code = print_end(job);
    return code == EXIT_CODE_OK ? check_gates(job) : code;
}

int compare_run(const compare_request *request)
{
    compare_job *job = calloc(1, sizeof *job);
    if (!job)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    int code = compare_open(job, request, report_outputs);
    if (code == EXIT_CODE_OK)
        code = compare_render(job);
    if (code == EXIT_CODE_OK)
        code = request->shard.count ? compare_shard_done(job) : finish_report(job);
    compare_close(job);
    free(job);
    return code;
}
