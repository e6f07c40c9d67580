/* SPDX-License-Identifier: MIT */
/* The page of the figures: sections with their plates, and the claims with what was measured. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/figures/figures_job.h"
#include "cli/common/markup.h"
#include "cli/common/memory_text.h"

/* ---- for the functions that make figures ---- */

void figures_section(figures_job *f, const char *name, const char *title) { fprintf(f->page, "<section id=\"%s\"><h2>%s</h2>\n", name, title); }

void figures_section_end(figures_job *f) { fputs("</section>\n", f->page); }

json_t *figures_number(double value) { return isfinite(value) ? json_real(value) : json_null(); }

void figures_write(figures_job *f, const char *name, char *text)
{
    char path[COMPARE_PATH];
    if (figures_good(f) && !text)
        f->code = figures_no_memory();
    if (figures_good(f))
        f->code = compare_file_path(f->compare, name, path) ? compare_write_text(f->compare, path, text, strlen(text)) : EXIT_CODE_USAGE;
    free(text);
}

bool figures_sheet(figures_job *f, svg *sheet, double width, double height)
{
    if (figures_good(f) && !svg_start(sheet, width, height))
        f->code = figures_no_memory();
    return figures_good(f);
}

void figures_plate(figures_job *f, svg *sheet, const char *name, const char *description)
{
    char file[64];
    size_t size = 0;
    snprintf(file, sizeof file, "%s.svg", name);
    figures_write(f, file, svg_finish(sheet, &size));
    fprintf(f->page, "<a href=\"%s\"><img src=\"%s\" alt=\"%s\"></a>\n", file, file, description);
}

void figures_check(figures_job *f, const char *claim, double value, double least, double most)
{
    const bool holds = value >= least && value <= most;
    f->failed += !holds;
    json_t *check = json_pack("{s:s, s:o, s:b}", "claim", claim, "value", figures_number(value), "holds", (int)holds);
    if (isfinite(least))
        json_object_set_new(check, "least", json_real(least));
    if (isfinite(most))
        json_object_set_new(check, "most", json_real(most));
    json_array_append_new(f->checks, check);
}

/* ---- the whole page ---- */

static const char page_head[] = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
                                "content=\"width=device-width, initial-scale=1\">\n"
                                "<title>The papers' figures again</title>\n<style>\n"
                                "body { font: 16px/1.5 system-ui, \"DejaVu Sans\", sans-serif; color: #1c1c1c; background: #fafafa; max-width: "
                                "1360px; margin: 0 auto; padding: 1.5em; }\n"
                                "h1 { font-size: 1.6em; margin-top: 1.4em; } h2 { font-size: 1.2em; margin: 0 0 .4em; }\n"
                                "section { background: #fff; border: 1px solid #ddd; border-radius: 6px; padding: 1.2em; margin: 1.4em 0; }\n"
                                "img { display: block; max-width: 100%; height: auto; margin: .6em auto; }\n"
                                "p { max-width: 60em; } .published { color: #5a5a5a; }\n"
                                "table { border-collapse: collapse; margin: .8em 0; font-variant-numeric: tabular-nums; font-size: .9em; }\n"
                                "th, td { padding: .25em .7em; border-bottom: 1px solid #e4e4e4; text-align: right; } th:first-child, "
                                "td:first-child { text-align: left; }\n"
                                "td.best { font-weight: bold; } td.published, th.published { color: #777; } td.no { color: #b00020; font-weight: "
                                "bold; }\n"
                                "nav a { margin-right: .9em; } code { background: #f0f0f0; padding: .1em .3em; border-radius: 3px; overflow-wrap: "
                                "anywhere; }\n"
                                "</style></head><body>\n";

static void put_command(figures_job *f, FILE *page)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return;
    fputs("mangata figures", stream);
    for (int i = 0; i < f->request->argument_count; i++)
        shell_word(stream, f->request->arguments[i]);
    if (fclose(stream) == 0)
        markup_escape(page, text);
    free(text);
}

static void put_checks(figures_job *f, FILE *page)
{
    size_t i;
    json_t *check;
    if (json_array_size(f->checks) == 0)
        return;
    fputs("<section id=\"claims\"><h2>Claims</h2>\n<table><tr><th>claim</th><th>measured</th><th>allowed</th><th>holds</th></tr>\n", page);
    json_array_foreach(f->checks, i, check)
    {
        const json_t *least = json_object_get(check, "least"), *most = json_object_get(check, "most");
        const bool holds = json_is_true(json_object_get(check, "holds"));
        fputs("<tr><td>", page);
        markup_escape(page, json_string_value(json_object_get(check, "claim")));
        fprintf(page, "</td><td>%.4g</td><td>", json_number_value(json_object_get(check, "value")));
        if (least && most)
            fprintf(page, "%g to %g", json_number_value(least), json_number_value(most));
        else if (least || most)
            fprintf(page, "%s %g", least ? "at least" : "at most", json_number_value(least ? least : most));
        fprintf(page, "</td><td%s>%s</td></tr>\n", holds ? "" : " class=\"no\"", holds ? "yes" : "no");
    }
    fputs("</table></section>\n", page);
}

static void put_podee(figures_job *f, FILE *page)
{
    char frames[240];
    frame_list_print(&f->request->frames, frames, sizeof frames);
    fputs("<h1 id=\"podee\">Podee et al. 2021</h1>\n<p>N. Podee, N. Max, K. Iwasaki, Y. Dobashi: <i>Temporal and spatial anti-aliasing for "
          "rendering reflections on water waves</i>, Computational Visual Media 7(2), 2021. Their waves and cameras are not printed: the scenes "
          "here have as many waves of the kinds that the paper describes, so compare orders and ratios, not single values.",
          page);
    if (f->renders.scene_count)
        fprintf(page, " %u × %u pixels, frames %s, reference of %u × %u × %u samples a pixel.", f->compare->scenes[0].width, f->compare->scenes[0].height,
                frames, f->request->reference.spatial_samples, f->request->reference.spatial_samples, f->request->reference.time_samples);
    fputs("</p>\n", page);
}

void figures_write_page(figures_job *f, const char *sections)
{
    char *text = NULL;
    size_t size = 0;
    FILE *page = open_memstream(&text, &size);
    if (!page) {
        f->code = figures_no_memory();
        return;
    }
    fputs(page_head, page);
    fputs("<h1>The papers' figures again</h1>\n<p>Made by <code>", page);
    put_command(f, page);
    fprintf(page, "</code>, version %s. Plates open larger by a click; they are SVG files with their pictures inside.</p>\n", mgt_version());
    if (figures_podee_wanted(f))
        put_podee(f, page);
    fputs(sections, page);
    put_checks(f, page);
    fputs("</body></html>\n", page);
    figures_write(f, "index.html", memory_text_finish(page, &text));
}
