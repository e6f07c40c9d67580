/* SPDX-License-Identifier: MIT */
/* The results of a comparison as JSON, CSV and LaTeX. */
#include "cli/compare/compare_tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/compare/compare_command.h"
#include "cli/compare/compare_external.h"
#include "cli/compare/compare_scores.h"
#include "cli/common/memory_text.h"
#include "params/methods.h"

uint64_t compare_samples(const mgt_quality *quality) { return (uint64_t)quality->spatial_samples * quality->spatial_samples * quality->time_samples; }

double compare_method_samples(const compare_job *job, const compare_scene *scene, size_t method)
{
    const uint64_t samples = compare_is_external(job->request, method) ? 0 : quality_pixel_samples(&scene->methods[method]);
    return samples ? (double)samples : NAN;
}

number_text compare_reference_samples(const compare_job *job)
{
    uint64_t least = UINT64_MAX, most = 0;
    number_text text;
    for (size_t s = 0; s < job->request->scene_count; s++) {
        const uint64_t own = compare_samples(&job->scenes[s].reference);
        least = own < least ? own : least;
        most = own > most ? own : most;
    }
    snprintf(text.text, sizeof text.text, least == most ? "%llu" : "%llu to %llu", (unsigned long long)least, (unsigned long long)most);
    return text;
}

double compare_gate_value(const compare_job *job, const compare_gate *gate)
{
    for (size_t c = 0; c < score_column_count; c++)
        if (score_columns[c].kind == KIND_COVERAGE && score_columns[c].metric == (gate->flicker ? CLIP_FLICKER : CLIP_RMSE))
            return score_pooled(job, gate->method, &score_columns[c]);
    return NAN;
}

/* ---- JSON ------------------------------------------------------------------------------------------------ */

/* A JSON number, or null for NaN and infinities, which JSON does not have. */
static json_t *number(double value) { return isfinite(value) ? json_real(value) : json_null(); }

static json_t *owned_text(char *text)
{
    json_t *value = text ? console_json_text(text) : NULL;
    free(text);
    return value;
}

static json_t *time_json(const number_spread *time)
{
    return json_pack("{s:o, s:o, s:o}", "median", number(1e3 * time->median), "least", number(1e3 * time->least), "most", number(1e3 * time->most));
}

static json_t *columns_json(const compare_job *job)
{
    json_t *list = json_array();
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        if (!score_wanted(job->request, column))
            continue;
        const char *missing = score_missing(job, column);
        json_t *entry = json_pack("{s:s, s:s, s:s, s:f, s:b}", "key", column->key, "title", column->title, "help", column->help, "best", column->best, "main",
                                  column->main);
        if (missing)
            json_object_set_new(entry, "unavailable", console_json_text(missing));
        json_array_append_new(list, entry);
    }
    return list;
}

/* The files with values that are infinite or not a number in one picture only. */
static json_t *mismatches_json(const compare_job *job, const compare_scene *scene, size_t method)
{
    json_t *list = json_array();
    for (size_t f = 0; f < job->frame_count; f++) {
        const uint64_t count = scene->results[method].mismatches[f];
        char path[COMPARE_PATH];
        if (count && compare_picture_path(job, scene, method + 1, f, path))
            json_array_append_new(list, json_pack("{s:o, s:I}", "file", console_json_text(path), "values", (json_int_t)count));
    }
    return list;
}

static json_t *method_json(const compare_job *job, const compare_scene *scene, size_t method)
{
    const method_spec *spec = &job->request->methods[method];
    const compare_result *result = &scene->results[method];
    json_t *scores = json_object(), *frames = json_object();
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        if (!score_wanted(job->request, column))
            continue;
        json_t *list = json_array();
        for (size_t f = 0; f < job->frame_count; f++)
            json_array_append_new(list, number(score_of_frame(result, column, f)));
        json_object_set_new(scores, column->key, number(score_of(result, column)));
        json_object_set_new(frames, column->key, list);
    }
    const char *external = job->request->external[method];
    const double samples = compare_method_samples(job, scene, method);
    json_t *object = json_pack("{s:s, s:o, s:o, s:o, s:o, s:o}", "method", spec->name, "samples",
                               isfinite(samples) ? json_integer((json_int_t)samples) : json_null(), "time_ms", time_json(&result->time), "scores", scores,
                               "frames", frames, "command", external ? json_null() : owned_text(compare_picture_command(job, scene, method + 1)));
    if (external)
        json_object_set_new(object, "external", console_json_text(external));
    json_t *mismatches = mismatches_json(job, scene, method);
    if (json_array_size(mismatches))
        json_object_set(object, "mismatches", mismatches);
    json_decref(mismatches);
    if (job->request->halved)
        json_object_set_new(object, "noiseless_rmse", number(result->noiseless_rmse));
    if (result->texture)
        json_object_set(object, "texture", result->texture);
    if (result->specks)
        json_object_set(object, "specks", result->specks);
    return object;
}

/* For each column the noise floor; null: not known. best_json() gives the best method; null: none is. */
static json_t *floors_json(const compare_job *job, const compare_scene *scene)
{
    json_t *floors = json_object();
    for (size_t c = 0; c < score_column_count; c++)
        if (score_wanted(job->request, &score_columns[c]))
            json_object_set_new(floors, score_columns[c].key, number(score_noise(job, scene, &score_columns[c])));
    return floors;
}

static json_t *best_json(const compare_job *job, const compare_scene *scene)
{
    json_t *best = json_object();
    for (size_t c = 0; c < score_column_count; c++) {
        if (!score_wanted(job->request, &score_columns[c]))
            continue;
        const int winner = score_winner(job, scene, &score_columns[c]);
        json_object_set_new(best, score_columns[c].key, winner < 0 ? json_null() : json_string(job->request->methods[winner].name));
    }
    return best;
}

static json_t *reference_json(const compare_job *job, const compare_scene *scene)
{
    const json_int_t samples = (json_int_t)compare_samples(&scene->reference);
    if (!job->request->halved)
        return json_pack("{s:o, s:I, s:o}", "time_ms", number(1e3 * scene->reference_seconds), "samples", samples, "command",
                         owned_text(compare_picture_command(job, scene, COMPARE_REFERENCE)));
    return json_pack("{s:o, s:I, s:o, s:o}", "time_ms", number(1e3 * scene->reference_seconds), "samples", samples, "command",
                     owned_text(compare_picture_command(job, scene, COMPARE_HALF)), "second_command",
                     owned_text(compare_picture_command(job, scene, COMPARE_HALF + 1)));
}

static json_t *scene_json(const compare_job *job, const compare_scene *scene)
{
    json_t *methods = json_array();
    for (size_t m = 0; m < job->request->method_count; m++)
        json_array_append_new(methods, method_json(job, scene, m));
    return json_pack("{s:s, s:o, s:o, s:i, s:i, s:o, s:o, s:o, s:o}", "name", scene->name, "path", console_json_text(scene->path), "description",
                     console_json_text(scene_file_description(scene->file)), "width", (int)scene->width, "height", (int)scene->height, "reference",
                     reference_json(job, scene), "methods", methods, "noise_floor", floors_json(job, scene), "best", best_json(job, scene));
}

/* The results as means over the scenes. */
static json_t *all_json(const compare_job *job)
{
    json_t *list = json_array();
    for (size_t m = 0; m < job->request->method_count; m++) {
        json_t *scores = json_object();
        for (size_t c = 0; c < score_column_count; c++)
            if (score_wanted(job->request, &score_columns[c]))
                json_object_set_new(scores, score_columns[c].key, number(score_mean(job, m, &score_columns[c])));
        json_array_append_new(list, json_pack("{s:s, s:o}", "method", job->request->methods[m].name, "scores", scores));
    }
    return list;
}

static bool has_mismatches(const compare_job *job, size_t method)
{
    for (size_t s = 0; s < job->request->scene_count; s++)
        for (size_t f = 0; f < job->frame_count; f++)
            if (job->scenes[s].results[method].mismatches[f])
                return true;
    return false;
}

static json_t *gates_json(const compare_job *job)
{
    json_t *list = json_array();
    for (size_t i = 0; i < job->request->gate_count; i++) {
        const compare_gate *gate = &job->request->gates[i];
        const double value = compare_gate_value(job, gate);
        json_array_append_new(list, json_pack("{s:s, s:s, s:f, s:o, s:b}", "gate", gate->flicker ? "max-flicker" : "max-rmse", "method",
                                              job->request->methods[gate->method].name, "limit", gate->limit, "value", number(value), "passed",
                                              value <= gate->limit && !has_mismatches(job, gate->method)));
    }
    return list;
}

/* A seed. Above 2⁶³ − 1, the largest integer here, it is text. */
static json_t *seed_json(uint64_t seed)
{
    char text[24];
    snprintf(text, sizeof text, "%llu", (unsigned long long)seed);
    return seed <= INT64_MAX ? json_integer((json_int_t)seed) : json_string(text);
}

json_t *compare_result_json(const compare_job *job)
{
    const compare_request *r = job->request;
    json_t *frames = json_array(), *scenes = json_array();
    for (size_t f = 0; f < job->frame_count; f++)
        json_array_append_new(frames, json_integer(compare_frame_number(job, f)));
    for (size_t s = 0; s < r->scene_count; s++)
        json_array_append_new(scenes, scene_json(job, &job->scenes[s]));
    json_t *reference = json_pack("{s:i, s:i, s:I, s:o}", "spatial", (int)r->reference.spatial_samples, "time_samples", (int)r->reference.time_samples,
                                  "samples", (json_int_t)compare_samples(&r->reference), "seed", seed_json(r->reference.seed));
    return json_pack("{s:i, s:s, s:o, s:s, s:s, s:s, s:i, s:I, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "mangata_comparison", 1, "version", mgt_version(),
                     "command", owned_text(compare_command(job)), "backend", mgt_backend_name(job->info.backend), "renderer", job->info.renderer, "isa",
                     mgt_isa_name(job->info.isa), "threads", (int)job->info.threads, "time_runs", (json_int_t)r->time_runs, "frames", frames, "reference",
                     reference, "columns", columns_json(job), "scenes", scenes, "all", all_json(job), "all_noise_floor", floors_json(job, NULL), "all_best",
                     best_json(job, NULL), "gates", gates_json(job));
}

char *compare_json_text(const compare_job *job, size_t *size)
{
    json_t *report = compare_result_json(job);
    char *text = report ? json_dumps(report, JSON_INDENT(1) | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(report);
    *size = text ? strlen(text) : 0;
    return text;
}

/* ---- CSV ------------------------------------------------------------------------------------------------- */

static void csv_number(FILE *stream, double value)
{
    if (isfinite(value))
        fprintf(stream, ",%.9g", value);
    else
        putc(',', stream);
}

char *compare_csv_text(const compare_job *job, size_t *size)
{
    const compare_request *r = job->request;
    char *text = NULL;
    FILE *stream = open_memstream(&text, size);
    if (!stream)
        return NULL;
    fputs("scene,method,samples,median_ms,least_ms,most_ms", stream);
    for (size_t c = 0; c < score_column_count; c++)
        if (score_wanted(r, &score_columns[c]))
            fprintf(stream, ",%s", score_columns[c].key);
    for (size_t c = 0; c < score_column_count; c++)
        if (score_wanted(r, &score_columns[c]))
            fprintf(stream, ",%s.noise-floor", score_columns[c].key);
    putc('\n', stream);
    for (size_t s = 0; s < r->scene_count; s++)
        for (size_t m = 0; m < r->method_count; m++) {
            const compare_result *result = &job->scenes[s].results[m];
            fprintf(stream, "%s,%s,", job->scenes[s].name, r->methods[m].name);
            const double samples = compare_method_samples(job, &job->scenes[s], m);
            if (isfinite(samples))
                fprintf(stream, "%.0f", samples);
            csv_number(stream, 1e3 * result->time.median);
            csv_number(stream, 1e3 * result->time.least);
            csv_number(stream, 1e3 * result->time.most);
            for (size_t c = 0; c < score_column_count; c++)
                if (score_wanted(r, &score_columns[c]))
                    csv_number(stream, score_of(result, &score_columns[c]));
            for (size_t c = 0; c < score_column_count; c++)
                if (score_wanted(r, &score_columns[c]))
                    csv_number(stream, score_noise(job, &job->scenes[s], &score_columns[c]));
            putc('\n', stream);
        }
    return memory_text_finish(stream, &text);
}

/* ---- LaTeX ----------------------------------------------------------------------------------------------- */

/* Writes a name for LaTeX. Names of scenes and methods contain [A-Za-z0-9_:=.-] only. */
static void tex_name(FILE *stream, const char *name)
{
    for (; *name; name++)
        fprintf(stream, *name == '_' ? "\\_" : "%c", *name);
}

/* Writes text into a comment of LaTeX, each of its lines behind a percent sign. */
static void tex_comment(FILE *stream, const char *text)
{
    fputs("% ", stream);
    for (; *text; text++) {
        putc(*text == '\r' ? '\n' : *text, stream);
        if (*text == '\n' || *text == '\r')
            fputs("% ", stream);
    }
    putc('\n', stream);
}

static bool tex_column(const compare_job *job, const score_column *column)
{
    return column->main && score_wanted(job->request, column) && !score_missing(job, column);
}

static void tex_row(FILE *stream, const compare_job *job, const compare_scene *scene, size_t method)
{
    const compare_result *result = &scene->results[method];
    fputs("  ", stream);
    tex_name(stream, job->request->methods[method].name);
    fprintf(stream, isfinite(result->time.median) ? " & %.2f" : " & --", 1e3 * result->time.median);
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        if (!tex_column(job, column))
            continue;
        const double score = score_of(result, column);
        const char *begin = score_winner(job, scene, column) == (int)method ? "\\textbf{" : "";
        if (isfinite(score))
            fprintf(stream, " & %s%s%s%s", begin, score < 0 ? "$-$" : "", number_print_measured(fabs(score), score_noise(job, scene, column)).text,
                    begin[0] ? "}" : "");
        else
            fputs(" & --", stream);
    }
    fputs(" \\\\\n", stream);
}

static void tex_noise_row(FILE *stream, const compare_job *job, const compare_scene *scene)
{
    fputs("  \\textit{noise floor} & --", stream);
    for (size_t c = 0; c < score_column_count; c++)
        if (tex_column(job, &score_columns[c])) {
            const double noise = score_noise(job, scene, &score_columns[c]);
            fprintf(stream, " & %s", isfinite(noise) ? score_noise_text(noise).text : "--");
        }
    fputs(" \\\\\n", stream);
}

/* Writes the lines about ties, and about references without light, under the table. False: out of memory. */
static bool tex_ties(FILE *stream, const compare_job *job)
{
    char *const texts[] = {score_ties_text(job, true), score_black_text(job)};
    for (int i = 0; i < 2; i++) {
        if (texts[i] && texts[i][0]) {
            fputs("\\par\\noindent{\\footnotesize ", stream);
            tex_name(stream, texts[i]);
            fputs("}\n", stream);
        }
        free(texts[i]);
    }
    return texts[0] && texts[1];
}

char *compare_tex_text(const compare_job *job, size_t *size)
{
    const compare_request *r = job->request;
    size_t columns = 0;
    char *text = NULL, *command = compare_command(job);
    FILE *stream = open_memstream(&text, size);
    if (!stream || !command) {
        if (stream)
            fclose(stream);
        free(text);
        free(command);
        return NULL;
    }
    for (size_t c = 0; c < score_column_count; c++)
        columns += tex_column(job, &score_columns[c]);
    tex_comment(stream, command);
    fprintf(stream,
            "%% Needs \\usepackage{booktabs}. Against a reference of %s samples a pixel, %zu frame%s; the best of each scene is bold where it leads by more "
            "than the\n"
            "%% reference's noise floor, which also sets how many digits are printed.\n",
            compare_reference_samples(job).text, job->frame_count, job->frame_count == 1 ? "" : "s");
    fputs("\\begin{tabular}{lr", stream);
    for (size_t c = 0; c < columns; c++)
        putc('r', stream);
    fputs("}\n\\toprule\nMethod & ms", stream);
    for (size_t c = 0; c < score_column_count; c++)
        if (tex_column(job, &score_columns[c]))
            fprintf(stream, " & %s", score_columns[c].title);
    fputs(" \\\\\n", stream);
    for (size_t s = 0; s < r->scene_count; s++) {
        fprintf(stream, "\\midrule\n\\multicolumn{%zu}{l}{\\textit{", columns + 2);
        tex_name(stream, job->scenes[s].name);
        fputs("}} \\\\\n", stream);
        for (size_t m = 0; m < r->method_count; m++)
            tex_row(stream, job, &job->scenes[s], m);
        if (r->halved)
            tex_noise_row(stream, job, &job->scenes[s]);
    }
    fputs("\\bottomrule\n\\end{tabular}\n", stream);
    free(command);
    const bool good = tex_ties(stream, job);
    text = memory_text_finish(stream, &text);
    if (good)
        return text;
    free(text);
    return NULL;
}
