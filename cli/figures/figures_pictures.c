/* SPDX-License-Identifier: MIT */
/* Plates of pictures: the transition (Fig. 11), the four scenes (Fig. 12), every method on each of them (Figs. 13–16). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/figures/figures_job.h"

/* A part of a picture, and its place on the sheet. */
typedef struct panel {
    double x, y, scale; /* scale: units of the sheet per pixel */
    svg_crop crop;
} panel;

static void put_picture(figures_job *f, svg *sheet, size_t scene, size_t picture, const panel *p)
{
    figures_put(f, sheet, scene, picture, &p->crop, p->x, p->y, p->scale);
}

/* Draws the signed error of coverage: red where there is too much light, blue where there is too little. Half of full coverage has the strongest colour. */
static void put_error(figures_job *f, svg *sheet, size_t scene, size_t picture, const panel *p)
{
    const compare_scene *s = &f->compare->scenes[scene];
    const size_t pixels = (size_t)s->width * s->height, pair[] = {picture, COMPARE_REFERENCE};
    float_image images[2] = {{0}, {0}};
    char path[COMPARE_PATH], name[200];
    file_error error;
    for (int i = 0; i < 2 && figures_good(f); i++) {
        if (!compare_picture_path(f->compare, s, pair[i], 0, path))
            f->code = EXIT_CODE_USAGE;
        else if (picture_read(&images[i], path, "coverage", &error) != FILE_OK)
            f->code = compare_file_failure(f->compare, &error);
    }
    uint8_t *rgba = calloc(pixels, 4);
    if (figures_good(f) && !rgba)
        f->code = figures_no_memory();
    for (size_t i = 0; i < pixels && figures_good(f); i++) {
        const double difference = (double)images[0].pixels[i] - (double)images[1].pixels[i], t = fmin(2 * fabs(difference), 1);
        const uint8_t other = (uint8_t)lrint(255 * (1 - t)), own = (uint8_t)lrint(255 - 60 * t);
        const uint8_t pixel[4] = {difference > 0 ? own : other, other, difference > 0 ? other : own, 255};
        memcpy(rgba + 4 * i, pixel, 4);
    }
    snprintf(name, sizeof name, "%s-%s-error", s->name, f->renders.methods[picture - 1].file);
    figures_embed(f, sheet, name, rgba, s->width, s->height, p->crop, p->x, p->y, p->crop.width * p->scale, p->crop.height * p->scale);
    svg_box(sheet, p->x, p->y, p->crop.width * p->scale, p->crop.height * p->scale, "none", "#bbb");
    free(rgba);
    for (int i = 0; i < 2; i++)
        float_image_free(&images[i]);
}

/* A panel of the glitter, scaled to be `across` units wide. */
static panel panel_of(const figures_job *f, size_t scene, double x, double y, double across)
{
    panel p = {.x = x, .y = y, .crop = figures_glitter_crop(f->compare->scenes[scene].width, f->compare->scenes[scene].height)};
    p.scale = across / p.crop.width;
    return p;
}

/* ---- Figs. 13–16 ---- */

static const char *const scene_captions[FIGURE_SCENES] = {"Published: five sine waves of similar directions; the paper's model is almost the "
                                                          "reference near the camera and smooth far away, the other two alias everywhere.",
                                                          "Published: 64 sine waves, smooth detail: sparse reflections that earlier methods miss.",
                                                          "Published: 48 sine waves, medium detail.",
                                                          "Published: 32 shorter sine waves, high detail: accurate near the camera, without "
                                                          "aliasing far away."};

/* Draws the whole reference, with a frame around the part that the panels show. */
static void put_whole(figures_job *f, svg *sheet, size_t scene, double x, double y, double across)
{
    const compare_scene *s = &f->compare->scenes[scene];
    const panel whole = {.x = x, .y = y, .scale = across / s->width, .crop = {0, 0, s->width, s->height}};
    const svg_crop part = figures_glitter_crop(s->width, s->height);
    put_picture(f, sheet, scene, COMPARE_REFERENCE, &whole);
    svg_box(sheet, x + part.x * whole.scale, y + part.y * whole.scale, part.width * whole.scale, part.height * whole.scale, "none", "#e69f00");
    svg_text(sheet, x, y - 8, 14, SVG_LEFT, "font-weight=\"bold\"", "the whole reference");
}

static void glitter(figures_job *f, size_t scene)
{
    enum { ACROSS = 250, GAP = 12, TOP = 42 };
    const compare_scene *s = &f->compare->scenes[scene];
    const panel first = panel_of(f, scene, 0, 0, ACROSS);
    const double tall = first.crop.height * first.scale, row = tall + 62, across = (4.0 * ACROSS - 2 * GAP) / 6;
    char name[16], title[96];
    svg sheet;
    snprintf(name, sizeof name, "fig%zu", 13 + scene);
    snprintf(title, sizeof title, "Fig. %zu: the %s scene", 13 + scene, figure_scenes[scene]);
    if (!figures_sheet(f, &sheet, 4 * ACROSS + 5 * GAP, TOP + 2 * row + tall * across / ACROSS + 30))
        return;
    for (size_t i = 0; i < 7 && figures_good(f); i++) {
        /* Panels are in two rows of four. The reference is at the end of the first row, and methods skip that place. */
        const size_t place = i < 3 ? i : i == 6 ? 3 : i + 1;
        const double x = GAP + (ACROSS + GAP) * (double)(place % 4), y = TOP + row * (double)(place / 4);
        const panel p = panel_of(f, scene, x, y, ACROSS);
        const size_t picture = i == 6 ? COMPARE_REFERENCE : f->picture[i];
        put_picture(f, &sheet, scene, picture, &p);
        svg_text(&sheet, x, y - 8, 14, SVG_LEFT, "font-weight=\"bold\"", "(%c) %s", "abcdefg"[i], i == 6 ? "reference" : figure_methods[i].title);
        if (i == 6) {
            svg_text(&sheet, x, y + tall + 16, 11.5, SVG_LEFT, "", "%u × %u × %u samples a pixel", f->request->reference.spatial_samples,
                     f->request->reference.spatial_samples, f->request->reference.time_samples);
            continue;
        }
        const figure_score *score = &f->scores[scene][i];
        const double ms = 1000 * s->results[picture - 1].time.median;
        svg_text(&sheet, x, y + tall + 16, 11.5, SVG_LEFT, "", "RMSE %.4f displayed, %.4f coverage", score->displayed[FIGURE_SHOWN], score->rmse);
        if (isfinite(ms))
            svg_text(&sheet, x, y + tall + 31, 11.5, SVG_LEFT, "", "light kept %.2f, %.1f ms a frame", score->kept, ms);
        else
            svg_text(&sheet, x, y + tall + 31, 11.5, SVG_LEFT, "", "light kept %.2f", score->kept);
    }
    put_whole(f, &sheet, scene, GAP + 3.0 * (ACROSS + GAP), TOP + row, ACROSS);
    const double y = TOP + 2 * row;
    svg_text(&sheet, GAP, y - 8, 13, SVG_LEFT, "", "Error of coverage: red too bright, blue too dark, full colour at ±½");
    for (size_t i = 0; i < 6 && figures_good(f); i++) {
        const panel p = panel_of(f, scene, GAP + (across + GAP) * (double)i, y, across);
        put_error(f, &sheet, scene, f->picture[i], &p);
        svg_text(&sheet, p.x, y + tall * across / ACROSS + 15, 11.5, SVG_LEFT, "", "(%c) %s", "abcdef"[i], figure_methods[i].title);
    }
    figures_section(f, name, title);
    fprintf(f->page,
            "<p class=\"published\">%s</p>\n<p>The part of frame %u with the glitter, %g stops above the scene's exposure, every pixel a square. "
            "RMSE are of all frames.</p>\n",
            scene_captions[scene], compare_frame_number(f->compare, 0), figure_stops[FIGURE_SHOWN]);
    figures_plate(f, &sheet, name, "Seven renderings of one scene and their errors");
    figures_section_end(f);
}

void figures_simple(figures_job *f) { glitter(f, 0); }

void figures_smooth(figures_job *f) { glitter(f, 1); }

void figures_medium(figures_job *f) { glitter(f, 2); }

void figures_high(figures_job *f) { glitter(f, 3); }

/* ---- Fig. 11 ---- */

void figures_transition(figures_job *f)
{
    static const figure_method methods[] = {FIGURE_UNIFORM, FIGURE_HARD, FIGURE_MANGATA};
    static const char *const titles[] = {"(a) with a transition, 0.2 to 0.5", "(b) without: at once at 0.5", "(c) mangata"};
    enum { ACROSS = 320, GAP = 14, SCENE = 2 };
    const panel first = panel_of(f, SCENE, 0, 0, ACROSS);
    const double tall = first.crop.height * first.scale;
    svg sheet;
    if (!figures_sheet(f, &sheet, 4 * ACROSS + 5 * GAP, tall + 60))
        return;
    for (size_t i = 0; i < 4 && figures_good(f); i++) {
        const panel p = panel_of(f, SCENE, GAP + (ACROSS + GAP) * (double)i, 34, ACROSS);
        put_picture(f, &sheet, SCENE, i < 3 ? f->picture[methods[i]] : COMPARE_REFERENCE, &p);
        svg_text(&sheet, p.x, 25, 14, SVG_LEFT, "font-weight=\"bold\"", "%s", i < 3 ? titles[i] : "(d) reference");
        if (i < 3)
            svg_text(&sheet, p.x, 34 + tall + 17, 11.5, SVG_LEFT, "", "RMSE %.4f displayed, %.4f coverage",
                     f->scores[SCENE][methods[i]].displayed[FIGURE_SHOWN], f->scores[SCENE][methods[i]].rmse);
    }
    figures_section(f, "fig11", "Fig. 11: with and without transition regions");
    fputs("<p class=\"published\">Published: where a wave turns from resolved to unresolved at once, arcs of sudden change stand in the picture "
          "(b).</p>\n"
          "<p>The paper's model with a uniform distribution on the medium scene: without a transition scattered pixels of single glints meet "
          "smooth water at once. All scenes, RMSE of coverage:</p>\n<table><tr><th></th>",
          f->page);
    for (int s = 0; s < FIGURE_SCENES; s++)
        fprintf(f->page, "<th>%s</th>", figure_scenes[s]);
    fputs("</tr>\n", f->page);
    json_t *json = json_object();
    for (size_t i = 0; i < 3; i++) {
        json_t *list = json_array();
        fprintf(f->page, "<tr><td>%s</td>", titles[i]);
        for (int s = 0; s < FIGURE_SCENES; s++) {
            fprintf(f->page, "<td>%.4f</td>", f->scores[s][methods[i]].rmse);
            json_array_append_new(list, json_real(f->scores[s][methods[i]].rmse));
        }
        fputs("</tr>\n", f->page);
        json_object_set_new(json, figure_methods[methods[i]].spec, list);
    }
    fputs("</table>\n", f->page);
    json_object_set_new(f->result, "fig11_coverage_rmse", json);
    figures_plate(f, &sheet, "fig11", "The medium scene with and without a transition region");
    figures_section_end(f);
}

/* ---- Fig. 12 ---- */

/* Renders the scene by method `mangata` under a sky, so that the waves are visible. */
static int render_view(figures_job *f, size_t scene, uint32_t width, uint32_t height, uint8_t *rgba)
{
    mgt_scene view;
    if (!compare_frame_scene(f->compare, &f->compare->scenes[scene], COMPARE_REFERENCE, 0, &view))
        return EXIT_CODE_BAD_INPUT;
    view.image = (mgt_image){.width = width, .height = height};
    view.sky.model = MGT_SKY_ATMOSPHERE;
    mgt_quality_init(&view.quality, sizeof view.quality);
    view.quality.method = MGT_METHOD_MANGATA;
    const mgt_target target = target_of(MGT_LAYER_COLOR, MGT_FORMAT_RGBA8_SRGB, rgba);
    const mgt_status status = mgt_render(f->compare->context, &view, &target, 1);
    return status == MGT_OK ? EXIT_CODE_OK : console_library_error(f->compare->context, status);
}

void figures_scene_views(figures_job *f)
{
    enum { WIDTH = 640, HEIGHT = 360, GAP = 14 };
    static const char *const titles[] = {"(a) simple: 5 waves", "(b) smooth: 64 waves", "(c) medium: 48 waves", "(d) high: 32 short waves"};
    svg sheet;
    uint8_t *rgba = calloc((size_t)WIDTH * HEIGHT, 4);
    if (!rgba || !svg_start(&sheet, 2 * WIDTH + 3 * GAP, 2 * (HEIGHT + 34) + GAP)) {
        free(rgba);
        f->code = figures_no_memory();
        return;
    }
    figures_steps(f, FIGURE_SCENES);
    for (size_t s = 0; s < FIGURE_SCENES && figures_good(f); s++) {
        const double x = GAP + (WIDTH + GAP) * (double)(s % 2), y = 30 + (HEIGHT + 34) * (double)(s / 2);
        char name[64];
        snprintf(name, sizeof name, "%s-view", figure_scenes[s]);
        f->code = render_view(f, s, WIDTH, HEIGHT, rgba);
        figures_embed(f, &sheet, name, rgba, WIDTH, HEIGHT, (svg_crop){0, 0, WIDTH, HEIGHT}, x, y, WIDTH, HEIGHT);
        svg_text(&sheet, x, y - 8, 14, SVG_LEFT, "font-weight=\"bold\"", "%s", titles[s]);
        figures_step(f);
    }
    free(rgba);
    figures_section(f, "fig12", "Fig. 12: the four experimental scenes");
    fputs("<p class=\"published\">Published: a simple wave of five sine waves with similar directions, smooth, medium and high detail of 64, 48 "
          "and 32.</p>\n"
          "<p>Our four scenes under a sky, so that the waves show (everywhere else the sky is black and only the light is mirrored), by "
          "<code>mangata</code>.</p>\n",
          f->page);
    figures_plate(f, &sheet, "fig12", "The four scenes");
    figures_section_end(f);
}
