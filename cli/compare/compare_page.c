/* SPDX-License-Identifier: MIT */
/* The page: a template whose {{marks}} are replaced by style, script, table, data and pictures. */
#include "cli/compare/compare_page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/compare/compare_external.h"
#include "cli/compare/compare_pixels.h"
#include "cli/compare/compare_scores.h"
#include "cli/compare/compare_tables.h"
#include "cli/common/markup.h"

/* How the page shows a scene. */
typedef struct scene_light {
    float scale;              /* stored = radiance × scale, a power of two, so that the sun fits into half floats */
    double exposure;          /* stops that bring the reference's mean colour to a middle grey */
    double coverage_exposure; /* stops that bring all but a few pixels of its coverage below white */
} scene_light;

typedef struct page {
    compare_job *job;
    scene_light light[COMPARE_SCENES];
    size_t shown; /* frames whose pictures are in the page */
    char *pictures;
    size_t picture_size;
} page;

static const char *text_named(const char *name)
{
    for (size_t i = 0; i < page_text_count; i++)
        if (strcmp(page_texts[i].name, name) == 0)
            return page_texts[i].text;
    return "";
}

/* ---- pictures -------------------------------------------------------------------------------------------- */

static int measure_light(compare_job *job, const compare_scene *scene, scene_light *light)
{
    float most = 0;
    double sum = 0;
    for (size_t frame = 0; frame < job->frame_count; frame++)
        for (size_t picture = 0; picture <= job->request->method_count; picture++) {
            float_image image;
            const int code = compare_read_layer(job, scene, picture, frame, "color", &image);
            if (code != EXIT_CODE_OK)
                return code;
            const size_t count = (size_t)image.width * image.height * image.channels;
            for (size_t i = 0; i < count; i++) {
                most = fmaxf(most, image.pixels[i]);
                /* The mean of the logarithm, so that a few glints do not dominate. */
                if (picture == COMPARE_REFERENCE && frame == 0)
                    sum += log2(fmax(image.pixels[i], 1e-6)) / (double)count;
            }
            float_image_free(&image);
        }
    light->scale = most > 65504 && isfinite(most) ? exp2f(-ceilf(log2f(most / 65504))) : 1;
    light->exposure = round(10 * (log2(0.18) - sum)) / 10;
    return EXIT_CODE_OK;
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static int measure_coverage(compare_job *job, const compare_scene *scene, scene_light *light)
{
    float_image image;
    const int code = compare_read_layer(job, scene, COMPARE_REFERENCE, 0, "coverage", &image);
    if (code != EXIT_CODE_OK)
        return code;
    const size_t count = (size_t)image.width * image.height;
    qsort(image.pixels, count, sizeof *image.pixels, ascending);
    const double high = image.pixels[(size_t)(0.998 * (double)(count - 1))];
    light->coverage_exposure = fmin(fmax(round(-2 * log2(fmax(high, 1e-4))) / 2, 0), 8);
    float_image_free(&image);
    return EXIT_CODE_OK;
}

static int put_picture(const page *p, FILE *stream, size_t s, size_t picture, size_t frame, const char *layer, float scale)
{
    float_image image;
    size_t length = 0;
    const int code = compare_read_layer(p->job, &p->job->scenes[s], picture, frame, layer, &image);
    if (code != EXIT_CODE_OK)
        return code;
    char *text = pixels_pack(&image, scale, &length);
    float_image_free(&image);
    if (!text)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    fprintf(stream, "<script type=\"text/plain\" id=\"%s-%zu-%zu-%zu\">", layer, s, picture, frame);
    fwrite(text, 1, length, stream);
    fputs("</script>\n", stream);
    free(text);
    return EXIT_CODE_OK;
}

static int put_frame(const page *p, FILE *stream, size_t frame)
{
    int code = EXIT_CODE_OK;
    for (size_t s = 0; s < p->job->request->scene_count; s++)
        for (size_t picture = 0; picture <= p->job->request->method_count && code == EXIT_CODE_OK; picture++) {
            code = put_picture(p, stream, s, picture, frame, "coverage", 1);
            if (code == EXIT_CODE_OK && !p->job->scenes[s].black_sky)
                code = put_picture(p, stream, s, picture, frame, "color", p->light[s].scale);
        }
    return code;
}

/* Packs the pictures of as many frames as the page may hold, at least of the first one. */
static int pack_pictures(page *p)
{
    int code = EXIT_CODE_OK;
    FILE *stream = open_memstream(&p->pictures, &p->picture_size);
    if (!stream)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    while (p->shown < p->job->frame_count && code == EXIT_CODE_OK) {
        char *text = NULL;
        size_t size = 0;
        FILE *part = open_memstream(&text, &size);
        code = part ? put_frame(p, part, p->shown) : console_error(EXIT_CODE_FAILED, "out of memory");
        if (part && fclose(part) != 0 && code == EXIT_CODE_OK)
            code = console_error(EXIT_CODE_FAILED, "out of memory");
        fflush(stream);
        const bool fits = p->picture_size + size <= p->job->request->picture_bytes;
        if (code == EXIT_CODE_OK && !fits && p->shown == 0)
            console_note(&p->job->request->out, "mangata: warning: the pictures of one frame take %.1f MB of the page; --size makes them smaller",
                         1e-6 * (double)size);
        if (code == EXIT_CODE_OK && (fits || p->shown == 0)) {
            fwrite(text, 1, size, stream);
            p->shown++;
        }
        free(text);
        if (!fits)
            break;
    }
    if (fclose(stream) != 0 && code == EXIT_CODE_OK)
        code = console_error(EXIT_CODE_FAILED, "out of memory");
    if (code == EXIT_CODE_OK && p->shown < p->job->frame_count)
        console_note(&p->job->request->out, "the page shows the first %zu of %zu frames; --picture-mb allows more", p->shown, p->job->frame_count);
    return code;
}

/* ---- the table ------------------------------------------------------------------------------------------- */

static void put_number(FILE *stream, double value, const char *class_name, int digits)
{
    if (isfinite(value))
        fprintf(stream, "<td class=\"%s\" data-value=\"%.9g\">%.*f</td>", class_name, value, digits, value);
    else
        fprintf(stream, "<td class=\"%s\">–</td>", class_name);
}

static void put_score(FILE *stream, const compare_job *job, const compare_scene *scene, size_t method, const score_column *column)
{
    const double value = scene ? score_of(&scene->results[method], column) : score_mean(job, method, column), noise = score_noise(job, scene, column);
    fprintf(stream, "<td class=\"score%s%s\"", column->main ? "" : " minor", score_winner(job, scene, column) == (int)method ? " best" : "");
    if (!isfinite(value)) {
        fputs(">–</td>", stream);
        return;
    }
    fprintf(stream, " data-value=\"%.9g\"", value);
    if (isfinite(noise))
        fprintf(stream, " title=\"noise floor %s\"", score_noise_text(noise).text);
    fprintf(stream, ">%s</td>", number_print_measured(value, noise).text);
}

/* Writes a row of the table. `scene` NULL: that of the means over all scenes. */
static void put_row(FILE *stream, const compare_job *job, const compare_scene *scene, size_t index, size_t method)
{
    const method_spec *spec = &job->request->methods[method];
    number_spread time = {0};
    for (size_t s = 0; s < job->request->scene_count; s++) {
        const number_spread *t = &job->scenes[s].results[method].time;
        const double share = 1 / (double)job->request->scene_count;
        time = (number_spread){time.median + share * t->median, time.least + share * t->least, time.most + share * t->most};
    }
    if (scene)
        time = scene->results[method].time;
    fprintf(stream, "<tr data-scene=\"%d\" data-method=\"%zu\"><td class=\"scene\">%s</td><th scope=\"row\">", scene ? (int)index : -1, method,
            scene ? scene->name : "mean");
    markup_escape(stream, spec->name);
    fputs("</th>", stream);
    put_number(stream, compare_method_samples(job, scene ? scene : &job->scenes[0], method), "samples", 0);
    put_number(stream, 1e3 * time.median, "time", 1);
    if (isfinite(time.least))
        fprintf(stream, "<td class=\"spread\" data-value=\"%.9g\">%.1f–%.1f</td>", 1e3 * (time.most - time.least), 1e3 * time.least, 1e3 * time.most);
    else
        fputs("<td class=\"spread\">–</td>", stream);
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        if (score_wanted(job->request, column))
            put_score(stream, job, scene, method, column);
    }
    fputs("</tr>\n", stream);
}

/* Writes the row of noise floors. `scene` NULL: those of the means. */
static void put_noise_row(FILE *stream, const compare_job *job, const compare_scene *scene, size_t index)
{
    fprintf(stream, "<tr data-scene=\"%d\"><td class=\"scene\">%s</td><th scope=\"row\">noise floor</th><td></td><td></td><td></td>", scene ? (int)index : -1,
            scene ? scene->name : "mean");
    for (size_t c = 0; c < score_column_count; c++) {
        const double noise = score_noise(job, scene, &score_columns[c]);
        if (score_wanted(job->request, &score_columns[c]))
            fprintf(stream, "<td class=\"%s\">%s</td>", score_columns[c].main ? "score" : "score minor", isfinite(noise) ? score_noise_text(noise).text : "–");
    }
    fputs("</tr>\n", stream);
}

static void put_table(FILE *stream, const compare_job *job)
{
    const compare_request *r = job->request;
    fputs("<thead><tr><th scope=\"col\">scene</th><th scope=\"col\">method</th><th scope=\"col\" title=\"shaded samples a pixel\">samples</th>"
          "<th scope=\"col\" title=\"milliseconds a frame, median of the timed runs\">time, ms</th>"
          "<th scope=\"col\" title=\"least and most of the timed runs\">least–most</th>",
          stream);
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        if (!score_wanted(r, column))
            continue;
        fprintf(stream, "<th scope=\"col\"%s title=\"", column->main ? "" : " class=\"minor\"");
        markup_escape(stream, column->help);
        if (job->missing[column->kind][column->metric][0]) {
            fputs(" (a dash: ", stream);
            markup_escape(stream, job->missing[column->kind][column->metric]);
            putc(')', stream);
        }
        fputs("\">", stream);
        markup_escape(stream, column->title);
        fputs("</th>", stream);
    }
    fputs("</tr></thead>\n<tbody>\n", stream);
    for (size_t s = 0; s < r->scene_count; s++)
        for (size_t m = 0; m < r->method_count; m++)
            put_row(stream, job, &job->scenes[s], s, m);
    for (size_t m = 0; m < r->method_count && r->scene_count > 1; m++)
        put_row(stream, job, NULL, 0, m);
    fputs("</tbody>", stream);
    if (!r->halved)
        return;
    fputs("\n<tfoot>\n", stream);
    for (size_t s = 0; s < r->scene_count; s++)
        put_noise_row(stream, job, &job->scenes[s], s);
    if (r->scene_count > 1)
        put_noise_row(stream, job, NULL, 0);
    fputs("</tfoot>", stream);
}

/* A line for each method with values that no score can be made of. */
static int put_mismatches(FILE *stream, const compare_job *job)
{
    for (size_t m = 0; m < job->request->method_count; m++) {
        char *mismatches = score_mismatches_text(job, m);
        if (!mismatches)
            return console_error(EXIT_CODE_FAILED, "out of memory");
        if (mismatches[0]) {
            fputs("<p class=\"caption mismatches\">", stream);
            markup_escape(stream, mismatches);
            fputs("</p>\n", stream);
        }
        free(mismatches);
    }
    return EXIT_CODE_OK;
}

static int put_ties(FILE *stream, const compare_job *job)
{
    char *const texts[] = {score_ties_text(job, false), score_black_text(job)};
    for (int i = 0; i < 2; i++) {
        if (texts[i] && texts[i][0]) {
            fprintf(stream, "<p class=\"caption\" id=\"%s\">", i ? "black" : "ties");
            markup_escape(stream, texts[i]);
            fputs("</p>", stream);
        }
        free(texts[i]);
    }
    return texts[0] && texts[1] ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
}

/* ---- everything ------------------------------------------------------------------------------------------ */

static json_t *page_json(const page *p)
{
    json_t *report = compare_result_json(p->job), *scene;
    size_t s;
    json_array_foreach(json_object_get(report, "scenes"), s, scene)
    {
        json_t *layers = json_pack("[{s:s, s:i, s:f, s:f}]", "name", "coverage", "channels", 1, "scale", 1.0, "exposure", p->light[s].coverage_exposure);
        if (!p->job->scenes[s].black_sky)
            json_array_append_new(layers, json_pack("{s:s, s:i, s:f, s:f}", "name", "color", "channels", 3, "scale", (double)p->light[s].scale, "exposure",
                                                    p->light[s].exposure));
        json_object_set_new(scene, "layers", layers);
    }
    if (report)
        json_object_set_new(report, "shown", json_integer((json_int_t)p->shown));
    return report;
}

/* Writes the report's JSON. "<" is escaped, so that a name in it cannot end the element that contains it. */
static int put_data(FILE *stream, const page *p)
{
    json_t *report = page_json(p);
    char *text = report ? json_dumps(report, JSON_COMPACT | JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(7)) : NULL;
    json_decref(report);
    if (!text)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    for (const char *c = text; *c; c++)
        if (*c == '<')
            fputs("\\u003c", stream);
        else
            putc(*c, stream);
    free(text);
    return EXIT_CODE_OK;
}

static void put_scripts(FILE *stream)
{
    for (size_t i = 0; i < page_text_count; i++) {
        const size_t length = strlen(page_texts[i].name);
        if (length > 3 && strcmp(page_texts[i].name + length - 3, ".js") == 0)
            fputs(page_texts[i].text, stream);
    }
}

static void put_summary(FILE *stream, const compare_job *job)
{
    const compare_request *r = job->request;
    char frames[240];
    frame_list_print(&r->frames, frames, sizeof frames);
    fprintf(stream, "%zu scene%s, %zu method%s, frame%s %s. Every figure compares whole frames with a reference of %s jittered samples a pixel.",
            r->scene_count, r->scene_count == 1 ? "" : "s", r->method_count, r->method_count == 1 ? "" : "s", job->frame_count == 1 ? "" : "s", frames,
            compare_reference_samples(job).text);
    if (r->time_runs)
        fprintf(stream, " Times are medians of %llu runs on %s.", (unsigned long long)r->time_runs, job->info.backend == MGT_BACKEND_GL ? "OpenGL" : "the CPU");
}

static int put_mark(FILE *stream, const page *p, const char *mark, size_t length)
{
    if (strncmp(mark, "style", length) == 0)
        fputs(text_named("page.css"), stream);
    else if (strncmp(mark, "summary", length) == 0)
        put_summary(stream, p->job);
    else if (strncmp(mark, "table", length) == 0)
        put_table(stream, p->job);
    else if (strncmp(mark, "ties", length) == 0)
        return put_ties(stream, p->job);
    else if (strncmp(mark, "mismatches", length) == 0)
        return put_mismatches(stream, p->job);
    else if (strncmp(mark, "data", length) == 0)
        return put_data(stream, p);
    else if (strncmp(mark, "pictures", length) == 0)
        fwrite(p->pictures, 1, p->picture_size, stream);
    else if (strncmp(mark, "script", length) == 0)
        put_scripts(stream);
    else if (strncmp(mark, "version", length) == 0)
        fputs(mgt_version(), stream);
    return EXIT_CODE_OK;
}

static int put_page(FILE *stream, const page *p)
{
    const char *text = text_named("page.html");
    for (;;) {
        const char *mark = strstr(text, "{{"), *end = mark ? strstr(mark, "}}") : NULL;
        if (!end) {
            fputs(text, stream);
            return EXIT_CODE_OK;
        }
        fwrite(text, 1, (size_t)(mark - text), stream);
        const int code = put_mark(stream, p, mark + 2, (size_t)(end - mark - 2));
        if (code != EXIT_CODE_OK)
            return code;
        text = end + 2;
    }
}

int compare_page_write(compare_job *job)
{
    char path[COMPARE_PATH], *text = NULL;
    size_t size = 0;
    page *p = calloc(1, sizeof *p);
    FILE *stream = NULL;
    int code = p ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
    if (code == EXIT_CODE_OK)
        p->job = job;
    for (size_t s = 0; code == EXIT_CODE_OK && s < job->request->scene_count; s++) {
        code = measure_coverage(job, &job->scenes[s], &p->light[s]);
        if (code == EXIT_CODE_OK && !job->scenes[s].black_sky)
            code = measure_light(job, &job->scenes[s], &p->light[s]);
    }
    if (code == EXIT_CODE_OK)
        code = pack_pictures(p);
    if (code == EXIT_CODE_OK && !(stream = open_memstream(&text, &size)))
        code = console_error(EXIT_CODE_FAILED, "out of memory");
    if (code == EXIT_CODE_OK)
        code = put_page(stream, p);
    if (stream && fclose(stream) != 0 && code == EXIT_CODE_OK)
        code = console_error(EXIT_CODE_FAILED, "out of memory");
    if (code == EXIT_CODE_OK && compare_file_path(job, "report.html", path))
        code = compare_write_text(job, path, text, size);
    free(text);
    if (p)
        free(p->pictures);
    free(p);
    return code;
}
