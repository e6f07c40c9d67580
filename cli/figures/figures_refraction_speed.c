/* SPDX-License-Identifier: MIT */
/* Table 3: frames per second and memory, published and measured; and all scores of refraction as text. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/memory_text.h"

#include "cli/figures/figures_refraction.h"

enum { SIZES = 2 };
static const refraction_view size_views[SIZES] = {VIEW_SPEED_16K, VIEW_SPEED_128K};

/* The published frames per second with 16k triangles (`size` 0) or 128k (1); NaN: not published. */
static double published_rate(refraction_method method, int size)
{
    switch (method) {
    case TIMED_TRUTH:
        return size ? 18.33 : 55.90;
    case TIMED_LIU:
        return size ? 366.82 : 362.53;
    case TIMED_SCREEN_SPACE:
        return size ? 258.89 : 294.77;
    case TIMED_DISTANCE_FIELD:
        return size ? 36.50 : 166.47;
    case TIMED_OFF:
        return size ? 369.63 : 373.92;
    default:
        return NAN;
    }
}

static bool is_timed(const refraction_figures *r) { return r->place[VIEW_SPEED_16K] < COMPARE_SCENES && r->place[VIEW_SPEED_128K] < COMPARE_SCENES; }

static const compare_result *result_of(const refraction_figures *r, refraction_method method, int size)
{
    return &refraction_scene(r, size_views[size])->results[method];
}

static double milliseconds(const refraction_figures *r, refraction_method method, int size) { return 1000 * result_of(r, method, size)->time.median; }

static double rate(const refraction_figures *r, refraction_method method, int size) { return 1000 / milliseconds(r, method, size); }

/* ---- as text ---- */

static void print_scores(const refraction_figures *r, FILE *out)
{
    bool any = false;
    for (int v = 0; v < REFRACTION_VIEWS; v++)
        for (int m = 0; m < TIMED_TRUTH; m++) {
            const refraction_score *s = &r->scores[v][m];
            if (!isfinite(s->rmse))
                continue;
            if (!any)
                fprintf(out,
                        "What comes through the surface: RMSE 0 to 255 against one ray in the same place, and against %u x %u; pixels of water off "
                        "by more than %d; SSIM, FLIP, Yee's failures.\n\n| view | refraction | RMSE | RMSE, %u x %u | artefacts, %% | SSIM | FLIP | "
                        "Yee, %% |\n|---|---|---:|---:|---:|---:|---:|---:|\n",
                        r->figures->request->refraction_samples, r->figures->request->refraction_samples, ARTEFACT, r->figures->request->refraction_samples,
                        r->figures->request->refraction_samples);
            any = true;
            fprintf(out, "| %s | `%s` | %.2f | %.2f | %.2f | %.4f | %.4f |", refraction_scene(r, (refraction_view)v)->name,
                    strchr(refraction_methods[m].spec, '+') + 1, s->rmse, s->many, 100 * s->artefacts, s->ssim, s->flip);
            fprintf(out, isfinite(s->yee) ? " %.2f |\n" : " |\n", 100 * s->yee);
        }
    if (any && is_timed(r))
        fputs("\n", out);
}

static void print_times(const refraction_figures *r, FILE *out)
{
    if (!is_timed(r))
        return;
    const compare_scene *s = refraction_scene(r, VIEW_SPEED_16K);
    fprintf(out, "Table 3: frames a second, %u x %u, %u threads, the camera moves.\n\n| refraction |", s->width, s->height, r->compare->info.threads);
    for (int i = 0; i < SIZES; i++)
        fprintf(out, " published, %s | %s | ms | MiB |", i ? "128k" : "16k", i ? "128k" : "16k");
    fputs("\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n", out);
    for (int m = TIMED_TRUTH; m < REFRACTION_METHODS; m++) {
        fprintf(out, "| `%s` |", strchr(refraction_methods[m].spec, '+') + 1);
        for (int i = 0; i < SIZES; i++) {
            const double known = published_rate((refraction_method)m, i), bytes = result_of(r, (refraction_method)m, i)->memory;
            fprintf(out, isfinite(known) ? " %.2f |" : " |", known);
            fprintf(out, " %.2f | %.1f |", rate(r, (refraction_method)m, i), milliseconds(r, (refraction_method)m, i));
            fprintf(out, isfinite(bytes) ? " %.0f |" : " |", bytes / 0x1p20);
        }
        fputs("\n", out);
    }
}

static char *table_text(const refraction_figures *r)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    print_scores(r, out);
    print_times(r, out);
    return memory_text_finish(out, &text);
}

static json_t *scores_json(const refraction_figures *r)
{
    json_t *list = json_array();
    for (int v = 0; v < REFRACTION_VIEWS; v++)
        for (int m = 0; m < TIMED_TRUTH; m++) {
            const refraction_score *s = &r->scores[v][m];
            if (isfinite(s->rmse))
                json_array_append_new(list,
                                      json_pack("{s:s, s:s, s:f, s:f, s:f, s:o, s:o, s:o}", "view", refraction_scene(r, (refraction_view)v)->name, "method",
                                                refraction_methods[m].spec, "rmse", s->rmse, "rmse_many_rays", s->many, "artefacts", s->artefacts, "ssim",
                                                figures_number(s->ssim), "flip", figures_number(s->flip), "yee", figures_number(s->yee)));
        }
    return list;
}

static json_t *times_json(const refraction_figures *r)
{
    json_t *list = json_array();
    for (int m = TIMED_TRUTH; m < REFRACTION_METHODS; m++)
        for (int i = 0; i < SIZES; i++) {
            const compare_result *result = result_of(r, (refraction_method)m, i);
            json_array_append_new(list,
                                  json_pack("{s:s, s:s, s:o, s:o, s:o}", "view", refraction_scene(r, size_views[i])->name, "method", refraction_methods[m].spec,
                                            "milliseconds", figures_number(1000 * result->time.median), "bytes", figures_number(result->memory),
                                            "published_frames_per_second", figures_number(published_rate((refraction_method)m, i))));
        }
    return list;
}

void refraction_write_table(refraction_figures *r)
{
    figures_job *f = r->figures;
    f->refraction_table = table_text(r);
    json_object_set_new(f->result, "liu_scores", scores_json(r));
    if (is_timed(r))
        json_object_set_new(f->result, "liu_table3", times_json(r));
    figures_write(f, "refraction.md", f->refraction_table ? strdup(f->refraction_table) : NULL);
}

/* ---- in the page ---- */

static void put_row(refraction_figures *r, refraction_method method)
{
    FILE *page = r->figures->page;
    fprintf(page, "<tr><td>%s</td>", refraction_methods[method].title);
    for (int i = 0; i < SIZES; i++) {
        const double known = published_rate(method, i);
        if (isfinite(known))
            fprintf(page, "<td class=\"published\">%.2f</td>", known);
        else
            fputs("<td class=\"published\"></td>", page);
    }
    for (int i = 0; i < SIZES; i++) {
        const double bytes = result_of(r, method, i)->memory, off = milliseconds(r, TIMED_OFF, i), own = milliseconds(r, method, i);
        fprintf(page, "<td>%.2f</td><td>%.1f</td><td>%+.1f</td><td>%.2f</td>", 1000 / own, own, own - off, off / own);
        if (isfinite(bytes))
            fprintf(page, "<td>%.0f</td>", bytes / 0x1p20);
        else
            fputs("<td>–</td>", page);
    }
    fputs("</tr>\n", page);
}

/* Ratio of the times of the fastest frames, which other work on the machine disturbs least. */
static double quickest_ratio(const refraction_figures *r, refraction_method method, int size, refraction_method other, int other_size)
{
    return result_of(r, other, other_size)->time.least / result_of(r, method, size)->time.least;
}

static void check(refraction_figures *r)
{
    static const refraction_method baselines[] = {TIMED_TRUTH, TIMED_SCREEN_SPACE, TIMED_DISTANCE_FIELD};
    for (int i = 0; i < SIZES; i++) {
        char claim[128];
        double least = INFINITY;
        for (size_t m = 0; m < sizeof baselines / sizeof *baselines; m++)
            least = fmin(least, quickest_ratio(r, TIMED_TWO_PHASE, i, baselines[m], i));
        snprintf(claim, sizeof claim, "Liu Table 3, %s: frame rate of two-phase over that without refraction", i ? "128k" : "16k");
        figures_check(r->figures, claim, quickest_ratio(r, TIMED_TWO_PHASE, i, TIMED_OFF, i), 0.7, INFINITY);
        /* A few frames suffice, even if the machine does other work. */
        snprintf(claim, sizeof claim, "Liu Table 3, %s: frame rate of two-phase over that of the fastest baseline", i ? "128k" : "16k");
        figures_check(r->figures, claim, least, 0.95, INFINITY);
    }
    figures_check(r->figures, "Liu Table 3: frame rate of two-phase at 128k triangles over that at 16k",
                  quickest_ratio(r, TIMED_TWO_PHASE, 1, TIMED_TWO_PHASE, 0), 0.5, INFINITY);
}

void refraction_speed(refraction_figures *r)
{
    FILE *page = r->figures->page;
    figures_section(r->figures, "liu-table3", "Table 3: frames a second");
    fputs("<p class=\"published\">Published: frames a second of ray tracing, the paper's method, screen space, distance field and no refraction at "
          "16k and 128k triangles, on an unnamed GPU. “Ours” does not fall at all from 16k to 128k (362.53, 366.82), and ray tracing to a "
          "third.</p>\n",
          page);
    if (!is_timed(r)) {
        fputs("<p>Nothing was timed (<code>--time-runs 0</code>).</p>\n", page);
        figures_section_end(r->figures);
        return;
    }
    const compare_scene *s = refraction_scene(r, VIEW_SPEED_16K);
    fprintf(page,
            "<p>Here: the pool on the CPU, %u × %u pixels, %u threads, <code>--method none</code>, median of %llu frames with a camera that moves, the "
            "methods in turn. <i>More</i> is what a frame takes more than without refraction, which draws the objects as well; <i>of off</i> is its "
            "frame rate over that one's; memory is what a frame takes at its peak, tables, triangles and all, in a context of its own. One ray a pixel "
            "everywhere, the truth too.</p>\n",
            s->width, s->height, r->compare->info.threads, (unsigned long long)r->figures->request->time_runs);
    fputs("<table><tr><th></th><th class=\"published\">published, 16k</th><th class=\"published\">128k</th>", page);
    for (int i = 0; i < SIZES; i++)
        fprintf(page, "<th>here, %s</th><th>ms</th><th>more</th><th>of off</th><th>MiB</th>", i ? "128k" : "16k");
    fputs("</tr>\n", page);
    for (int m = TIMED_TRUTH; m < REFRACTION_METHODS; m++)
        put_row(r, (refraction_method)m);
    fputs("</table>\n", page);
    figures_section_end(r->figures);
    check(r);
}
