/* SPDX-License-Identifier: MIT */
/* Table 1 beside the published one, and its scores as bars (Fig. 18). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/figures/figures_job.h"
#include "cli/common/memory_text.h"
#include "cli/common/plot.h"

enum { TABLE_METHODS = FIGURE_MANGATA + 1 };

/* The published RMSE of displayed colour, for the scenes simple, smooth, medium and high. */
static const double published[TABLE_METHODS][FIGURE_SCENES] = {
    [FIGURE_NONE] = {0.0797, 0.0299, 0.0315, 0.0778},    [FIGURE_MSAA32] = {0.0795, 0.0287, 0.0282, 0.0676}, [FIGURE_LEAN] = {0.0675, 0.0329, 0.0298, 0.0633},
    [FIGURE_UNIFORM] = {0.0384, 0.0200, 0.0278, 0.0611}, [FIGURE_PIXEL] = {0.0384, 0.0192, 0.0229, 0.0610},  [FIGURE_MANGATA] = {NAN, NAN, NAN, NAN},
};

/* Columns of scores: that of coverage, then those of displayed colour at each exposure. */
enum { COLUMN_COVERAGE = 0, COLUMN_DISPLAYED, COLUMNS = COLUMN_DISPLAYED + FIGURE_EXPOSURES };

static double score(const figures_job *f, int column, int scene, int method)
{
    const figure_score *s = &f->scores[scene][method];
    return column == COLUMN_COVERAGE ? s->rmse : s->displayed[column - COLUMN_DISPLAYED];
}

static void column_title(int column, char text[96])
{
    if (column == COLUMN_COVERAGE)
        snprintf(text, 96, "coverage");
    else
        snprintf(text, 96, "displayed colour, %+g stops", figure_stops[column - COLUMN_DISPLAYED]);
}

static int best_of(const figures_job *f, int column, int scene)
{
    int best = 0;
    for (int m = 1; m < TABLE_METHODS; m++)
        if (score(f, column, scene, m) < score(f, column, scene, best))
            best = m;
    return best;
}

/* Score of mangata divided by that of the better of the two published models, mean over the scenes. */
static double over_published(const figures_job *f, int column)
{
    double sum = 0;
    for (int s = 0; s < FIGURE_SCENES; s++)
        sum += score(f, column, s, FIGURE_MANGATA) / fmin(score(f, column, s, FIGURE_UNIFORM), score(f, column, s, FIGURE_PIXEL));
    return sum / FIGURE_SCENES;
}

/* ---- as text ---- */

char *figures_table1_text(const figures_job *f)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    for (int column = 0; column < COLUMNS; column++) {
        char title[96];
        column_title(column, title);
        fprintf(out, "%sRMSE, %s:\n\n| method |", column ? "\n" : "", title);
        for (int s = 0; s < FIGURE_SCENES; s++)
            fprintf(out, " %s | published |", figure_scenes[s]);
        fputs(column ? "\n|---|" : " light kept |\n|---|", out);
        for (int s = 0; s < FIGURE_SCENES; s++)
            fputs("---:|---:|", out);
        fputs(column ? "\n" : "---|\n", out);
        for (int m = 0; m < TABLE_METHODS; m++) {
            fprintf(out, "| `%s` |", figure_methods[m].spec);
            for (int s = 0; s < FIGURE_SCENES; s++) {
                const bool best = best_of(f, column, s) == m;
                fprintf(out, best ? " **%.4f** |" : " %.4f |", score(f, column, s, m));
                fprintf(out, isfinite(published[m][s]) ? " %.4f |" : " |", published[m][s]);
            }
            for (int s = 0; s < FIGURE_SCENES && column == 0; s++)
                fprintf(out, " %.2f", f->scores[s][m].kept);
            fputs(column ? "\n" : " |\n", out);
        }
    }
    fprintf(out, "\nRMSE, displayed colour, %+g stops, above / below the middle row (share of its square that is too bright):\n\n| method |",
            figure_stops[FIGURE_SHOWN]);
    for (int s = 0; s < FIGURE_SCENES; s++)
        fprintf(out, " %s |", figure_scenes[s]);
    fputs("\n|---|---|---|---|---|\n", out);
    for (int m = 0; m < TABLE_METHODS; m++) {
        fprintf(out, "| `%s` |", figure_methods[m].spec);
        for (int s = 0; s < FIGURE_SCENES; s++) {
            const figure_score *scores = &f->scores[s][m];
            fprintf(out, " %.4f (%.2f) / %.4f (%.2f) |", scores->half[0], scores->excess[0], scores->half[1], scores->excess[1]);
        }
        fputs("\n", out);
    }
    fprintf(out, "\nOver the better of the paper's two models `mangata` stands at %.3f of its RMSE of coverage on average.\n",
            over_published(f, COLUMN_COVERAGE));
    return memory_text_finish(out, &text);
}

static char *table_csv(const figures_job *f)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs("scene,method,published_rmse,coverage_rmse,light_kept", out);
    for (int i = 0; i < FIGURE_EXPOSURES; i++)
        fprintf(out, ",displayed_rmse_%+g_stops", figure_stops[i]);
    fputs(",median_ms\n", out);
    for (int s = 0; s < FIGURE_SCENES; s++)
        for (int m = 0; m < TABLE_METHODS; m++) {
            const figure_score *scores = &f->scores[s][m];
            const double ms = 1000 * f->compare->scenes[s].results[f->picture[m] - 1].time.median;
            fprintf(out, "%s,%s,", figure_scenes[s], figure_methods[m].spec);
            if (isfinite(published[m][s]))
                fprintf(out, "%.4f", published[m][s]);
            fprintf(out, ",%.6f,%.6f", scores->rmse, scores->kept);
            for (int i = 0; i < FIGURE_EXPOSURES; i++)
                fprintf(out, ",%.6f", scores->displayed[i]);
            fprintf(out, isfinite(ms) ? ",%.3f\n" : ",\n", ms);
        }
    return memory_text_finish(out, &text);
}

/* ---- in the page ---- */

static void put_table(figures_job *f, int column)
{
    char title[96];
    column_title(column, title);
    fprintf(f->page, "<table><tr><th>RMSE, %s</th>", title);
    for (int s = 0; s < FIGURE_SCENES; s++)
        fprintf(f->page, "<th>%s</th><th class=\"published\">published</th>", figure_scenes[s]);
    fputs(column == COLUMN_COVERAGE ? "<th>light kept</th></tr>\n" : "</tr>\n", f->page);
    for (int m = 0; m < TABLE_METHODS; m++) {
        fprintf(f->page, "<tr><td>%s</td>", figure_methods[m].title);
        for (int s = 0; s < FIGURE_SCENES; s++) {
            fprintf(f->page, "<td%s>%.4f</td>", best_of(f, column, s) == m ? " class=\"best\"" : "", score(f, column, s, m));
            fprintf(f->page, isfinite(published[m][s]) ? "<td class=\"published\">%.4f</td>" : "<td></td>", published[m][s]);
        }
        if (column == COLUMN_COVERAGE) {
            fputs("<td>", f->page);
            for (int s = 0; s < FIGURE_SCENES; s++)
                fprintf(f->page, "%s%.2f", s ? " " : "", f->scores[s][m].kept);
            fputs("</td>", f->page);
        }
        fputs("</tr>\n", f->page);
    }
    fputs("</table>\n", f->page);
}

/* Writes the errors of far and of near water, and the fractions of them that are too bright. */
static void put_halves(figures_job *f)
{
    fprintf(f->page, "<table><tr><th>RMSE, displayed colour, %+g stops</th>", figure_stops[FIGURE_SHOWN]);
    for (int s = 0; s < FIGURE_SCENES; s++)
        fprintf(f->page, "<th>%s: far (too bright)</th><th>near (too bright)</th>", figure_scenes[s]);
    fputs("</tr>\n", f->page);
    for (int m = 0; m < TABLE_METHODS; m++) {
        fprintf(f->page, "<tr><td>%s</td>", figure_methods[m].title);
        for (int s = 0; s < FIGURE_SCENES; s++)
            for (int half = 0; half < 2; half++)
                fprintf(f->page, "<td>%.4f (%.0f%%)</td>", f->scores[s][m].half[half], 100 * f->scores[s][m].excess[half]);
        fputs("</tr>\n", f->page);
    }
    fputs("</table>\n<p>Far and near: above and below the middle row. In brackets the share of the squared error where the picture is brighter than the "
          "reference.</p>\n",
          f->page);
}

static json_t *table_json(const figures_job *f)
{
    json_t *rows = json_array();
    for (int s = 0; s < FIGURE_SCENES; s++)
        for (int m = 0; m < TABLE_METHODS; m++) {
            json_t *displayed = json_object();
            for (int i = 0; i < FIGURE_EXPOSURES; i++) {
                char key[24];
                snprintf(key, sizeof key, "%+g", figure_stops[i]);
                json_object_set_new(displayed, key, figures_number(f->scores[s][m].displayed[i]));
            }
            const figure_score *scores = &f->scores[s][m];
            json_t *row = json_pack("{s:s, s:s, s:o, s:o, s:o}", "scene", figure_scenes[s], "method", figure_methods[m].spec, "coverage_rmse",
                                    figures_number(f->scores[s][m].rmse), "light_kept", figures_number(f->scores[s][m].kept), "displayed_rmse", displayed);
            json_object_set_new(row, "displayed_far_near",
                                json_pack("{s:[f, f], s:[f, f]}", "rmse", scores->half[0], scores->half[1], "too_bright", scores->excess[0],
                                          scores->excess[1]));
            if (isfinite(published[m][s]))
                json_object_set_new(row, "published_rmse", json_real(published[m][s]));
            json_array_append_new(rows, row);
        }
    return rows;
}

static void check_table(figures_job *f)
{
    for (int s = 0; s < FIGURE_SCENES; s++) {
        char claim[96];
        double baseline = INFINITY;
        for (int m = 0; m < FIGURE_MANGATA; m++)
            baseline = fmin(baseline, f->scores[s][m].rmse);
        snprintf(claim, sizeof claim, "Table 1, %s: RMSE of coverage of mangata over the best of the others", figure_scenes[s]);
        figures_check(f, claim, f->scores[s][FIGURE_MANGATA].rmse / baseline, 0, 1);
        snprintf(claim, sizeof claim, "Table 1, %s: light that mangata keeps", figure_scenes[s]);
        figures_check(f, claim, f->scores[s][FIGURE_MANGATA].kept, 0.9, 1.1);
    }
    figures_check(f, "Table 1: RMSE of mangata over the better of the paper's two models, mean of the scenes", over_published(f, COLUMN_COVERAGE), 0, 0.75);
}

void figures_table1(figures_job *f)
{
    figures_section(f, "table1", "Table 1: RMSE against the reference");
    fputs("<p class=\"published\">Published: RMSE of displayed colour, after glare and tone mapping, presumably of one frame a scene.</p>\n"
          "<p>Here: of all frames together; of linear coverage (the share of pixel and shutter time whose mirror ray meets the light), and of "
          "displayed colour as a PNG holds it, at four exposures: a brighter one shows fainter glints and cuts strong ones off at white. <i>Light "
          "kept</i> is the sum of coverage over the reference's, scene by scene.</p>\n",
          f->page);
    for (int column = 0; column < COLUMNS; column++)
        put_table(f, column);
    put_halves(f);
    check_table(f);
    json_object_set_new(f->result, "table1", table_json(f));
    figures_section_end(f);
    figures_write(f, "table1.md", figures_table1_text(f));
    figures_write(f, "table1.csv", table_csv(f));
}

/* ---- Fig. 18 ---- */

static double bar_value(const figures_job *f, int panel, int scene, int method)
{
    return panel == 0 ? published[method][scene] : score(f, panel == 1 ? COLUMN_DISPLAYED + FIGURE_SHOWN : COLUMN_COVERAGE, scene, method);
}

void figures_bars(figures_job *f)
{
    char shown[96], title[3][128];
    svg sheet;
    column_title(COLUMN_DISPLAYED + FIGURE_SHOWN, shown);
    snprintf(title[0], sizeof title[0], "published (displayed colour)");
    snprintf(title[1], sizeof title[1], "here, %s", shown);
    snprintf(title[2], sizeof title[2], "here, coverage");
    if (!figures_sheet(f, &sheet, 1320, 420))
        return;
    for (int panel = 0; panel < 3; panel++) {
        double most = 0;
        for (int s = 0; s < FIGURE_SCENES; s++)
            for (int m = 0; m < TABLE_METHODS; m++)
                most = fmax(most, bar_value(f, panel, s, m));
        const double step = most > 0.1 ? 0.05 : most > 0.05 ? 0.02 : 0.01;
        const plot p = {.x = 70 + 430 * panel,
                        .y = 40,
                        .width = 350,
                        .height = 270,
                        .title = title[panel],
                        .across = {.label = "", .low = 0, .high = FIGURE_SCENES},
                        .up = {.label = "RMSE", .low = 0, .high = most * 1.05, .step = step}};
        plot_frame(&sheet, &p);
        for (int s = 0; s < FIGURE_SCENES; s++) {
            svg_text(&sheet, plot_x(&p, s + 0.5), p.y + p.height + 18, 12, SVG_MIDDLE, "", "%s", figure_scenes[s]);
            for (int m = 0; m < TABLE_METHODS; m++) {
                const double value = bar_value(f, panel, s, m), width = p.width / FIGURE_SCENES * 0.84 / TABLE_METHODS;
                if (isfinite(value))
                    svg_box(&sheet, plot_x(&p, s + 0.08) + m * width, plot_y(&p, value), width * 0.92, p.y + p.height - plot_y(&p, value),
                            plot_color((size_t)m), "none");
            }
        }
    }
    for (int m = 0; m < TABLE_METHODS; m++) {
        svg_box(&sheet, 150 + 180 * m, 368, 14, 14, plot_color((size_t)m), "none");
        svg_text(&sheet, 170 + 180 * m, 380, 12, SVG_LEFT, "", "%s", figure_methods[m].title);
    }
    figures_section(f, "fig18", "Fig. 18: RMSE comparison");
    fputs("<p class=\"published\">Published: Table 1 as bars.</p>\n", f->page);
    figures_plate(f, &sheet, "fig18", "Bars of RMSE by scene and method, published and here");
    figures_section_end(f);
}
