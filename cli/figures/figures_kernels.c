/* SPDX-License-Identifier: MIT */
/* Circular kernels instead of an ellipse (Fig. 17): in pictures, and as errors of the light's fraction over elongation. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "cpu/mixture_lane.h"
#include "cli/figures/figures_job.h"
#include "cli/common/plot.h"
#include "reference/equations.h"

static const double pi = 3.14159265358979323846;

/* The approximations of Fig. 17, in its order. */
enum { WAYS = 6 };
static const figure_method way_methods[WAYS] = {FIGURE_KERNELS_1, FIGURE_KERNELS_3, FIGURE_KERNELS_5, FIGURE_KERNELS_9, FIGURE_FELINE, FIGURE_RIEMANN};
static const mgt_mixture way_kernels[WAYS] = {MGT_MIXTURE_1, MGT_MIXTURE_3, MGT_MIXTURE_5, MGT_MIXTURE_9, MGT_MIXTURE_FELINE, MGT_MIXTURE_RIEMANN};
static const char *const way_dashes[WAYS] = {"", "", "", "", "7 4", "2 3"};
enum { WAY_5 = 2, WAY_9 = 3, WAY_FELINE = 4, WAY_RIEMANN = 5 };

/* ---- the light's fraction in one pixel ---- */

/* Numbers of elongations, which are half an octave apart, and of random cases for each. */
enum { ELONGATIONS = 10, CASES = 200 };

static double elongation_at(int i) { return pow(2, 0.5 * i); }

typedef struct random_numbers {
    uint64_t state;
} random_numbers;

static double random_between(random_numbers *r, double low, double high) { return low + (high - low) * hash_fraction(hash_next(&r->state)); }

/* A path and a covariance as they are found in pixels, in radii of the disk. The minor deviation is log-uniform from 0.1 to 8. The path's length is log-uniform
 * from 0.01 to 10, its direction uniform. It starts within 1.5 (1 + minor deviation) of the disk's centre. */
typedef struct path_case {
    double from[2], to[2], covariance[3];
} path_case;

static path_case random_case(random_numbers *r, double elongation)
{
    const double minor = 0.1 * pow(80, random_between(r, 0, 1)), major = minor * elongation, length = 0.01 * pow(1000, random_between(r, 0, 1));
    const double heading = random_between(r, -pi, pi), tilt = random_between(r, -pi, pi), around = random_between(r, -pi, pi);
    const double distance = 1.5 * (1 + minor) * sqrt(random_between(r, 0, 1)), c = cos(tilt), s = sin(tilt);
    path_case p = {.from = {distance * cos(around), distance * sin(around)},
                   .covariance = {major * major * c * c + minor * minor * s * s, (major * major - minor * minor) * c * s,
                                  major * major * s * s + minor * minor * c * c}};
    p.to[0] = p.from[0] + length * cos(heading);
    p.to[1] = p.from[1] + length * sin(heading);
    return p;
}

typedef struct share_errors {
    double elongation[ELONGATIONS];
    double moving[WAYS][ELONGATIONS], still[WAYS][ELONGATIONS]; /* rms */
    double nine_over_riemann;                                   /* ratio of the sums of fractions of points at rest, elongations up to 9 */
} share_errors;

static void in_order(void *user, size_t count, void (*body)(void *, size_t), void *argument)
{
    (void)user;
    for (size_t i = 0; i < count; i++)
        body(argument, i);
}

static void measure_shares(figures_job *f, const podee_tables *tables, share_errors *out)
{
    random_numbers random = {17};
    double nine = 0, riemann = 0;
    for (int i = 0; i < ELONGATIONS && figures_good(f); i++) {
        double squares[2][WAYS] = {{0}};
        out->elongation[i] = elongation_at(i);
        for (int k = 0; k < CASES; k++) {
            const path_case p = random_case(&random, out->elongation[i]);
            for (int moves = 0; moves < 2; moves++) {
                const double *from = moves ? p.from : p.to;
                const double exact = moves ? disk_path_quadrature(from, p.to, p.covariance, 1) : disk_probability(p.to, p.covariance, 1);
                for (int w = 0; w < WAYS; w++) {
                    const double share = mixture_path_fraction(tables, way_kernels[w], from, p.to, p.covariance);
                    squares[moves][w] += (share - exact) * (share - exact) / CASES;
                    if (!moves && out->elongation[i] <= 9) {
                        nine += w == WAY_9 ? share : 0;
                        riemann += w == WAY_RIEMANN ? share : 0;
                    }
                }
            }
        }
        for (int w = 0; w < WAYS; w++) {
            out->still[w][i] = sqrt(squares[0][w]);
            out->moving[w][i] = sqrt(squares[1][w]);
        }
        figures_step(f);
    }
    out->nine_over_riemann = nine / riemann;
}

static void plot_shares(figures_job *f, const share_errors *errors)
{
    svg sheet;
    if (!figures_sheet(f, &sheet, 1090, 400))
        return;
    for (int moves = 0; moves < 2; moves++) {
        const plot p = {.x = 85 + 430 * moves,
                        .y = 40,
                        .width = 350,
                        .height = 300,
                        .title = moves ? "the light moves along its path" : "nothing moves",
                        .across = {.label = "elongation: major over minor deviation", .low = 1, .high = elongation_at(ELONGATIONS - 1), .logarithmic = true},
                        .up = {.label = "rms error of the share", .low = 1e-4, .high = 0.2, .logarithmic = true}};
        plot_frame(&sheet, &p);
        for (int w = 0; w < WAYS; w++)
            plot_curve(&sheet, &p, errors->elongation, moves ? errors->moving[w] : errors->still[w], ELONGATIONS, plot_color((size_t)w), way_dashes[w]);
    }
    for (int w = 0; w < WAYS; w++)
        plot_key(&sheet, 890, 60, w, plot_color((size_t)w), way_dashes[w], figure_methods[way_methods[w]].title);
    figures_plate(f, &sheet, "fig17-elongation", "Error of the light's share over elongation, by kernels");
}

/* Root mean square of the errors at elongations up to 8, with equal weights. */
static double mean_to_eight(const double errors[ELONGATIONS])
{
    double sum = 0;
    int count = 0;
    for (int i = 0; i < ELONGATIONS && elongation_at(i) < 9; i++, count++)
        sum += errors[i] * errors[i];
    return sqrt(sum / count);
}

static void figure_of_shares(figures_job *f)
{
    podee_tables tables = {NULL, NULL};
    share_errors *errors = calloc(1, sizeof *errors);
    if (!errors || !podee_tables_build(&tables, in_order, NULL)) {
        free(errors);
        f->code = figures_no_memory();
        return;
    }
    measure_shares(f, &tables, errors);
    podee_tables_free(&tables);
    plot_shares(f, errors);
    if (figures_good(f)) {
        json_t *json = json_object();
        for (int w = 0; w < WAYS; w++) {
            json_t *list = json_array();
            for (int i = 0; i < ELONGATIONS; i++)
                json_array_append_new(list, json_pack("{s:f, s:f, s:f}", "elongation", errors->elongation[i], "still", errors->still[w][i], "moving",
                                                      errors->moving[w][i]));
            json_object_set_new(json, figure_methods[way_methods[w]].title, list);
        }
        json_object_set_new(f->result, "fig17_share_error", json);
        fprintf(f->page,
                "<p>The share of a Gaussian and its path in the light's disk, against quadrature, over %d random paths at each elongation: root "
                "mean square of the error. Over elongations 1 to 8, moving: 1, 3, 5, 9 kernels %.4f, %.4f, %.4f, %.4f; Feline %.4f. The Riemann "
                "sum leaves the path out, which is its whole error. Beyond 9, where the fits end, the paper falls back to it.</p>\n",
                CASES, mean_to_eight(errors->moving[0]), mean_to_eight(errors->moving[1]), mean_to_eight(errors->moving[WAY_5]),
                mean_to_eight(errors->moving[WAY_9]), mean_to_eight(errors->moving[WAY_FELINE]));
        figures_check(f, "Fig. 17: error of Feline's share over that of five fitted kernels, elongations 1 to 8, moving",
                      mean_to_eight(errors->moving[WAY_FELINE]) / mean_to_eight(errors->moving[WAY_5]), 1, INFINITY);
        figures_check(f, "Fig. 17: the same, nothing moves", mean_to_eight(errors->still[WAY_FELINE]) / mean_to_eight(errors->still[WAY_5]), 1, INFINITY);
        figures_check(f, "Fig. 17: shares by 9 kernels over those by Riemann sums, elongations to 8, nothing moves", errors->nine_over_riemann, 0.97, 1.03);
    }
    free(errors);
}

/* ---- pictures ---- */

/* Sums of coverage without a shutter, by nine kernels and by the Riemann sum. In that case both approximate the same value. */
static void still_sums(figures_job *f, size_t scene, double sums[2])
{
    compare_job *job = f->compare;
    const compare_scene *s = &job->scenes[scene];
    const size_t pixels = (size_t)s->width * s->height;
    float *coverage = calloc(pixels, sizeof *coverage);
    if (!coverage) {
        f->code = figures_no_memory();
        return;
    }
    const mgt_target target = target_of(MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, coverage);
    sums[0] = sums[1] = 0;
    for (size_t frame = 0; frame < job->frame_count; frame++)
        for (int way = 0; way < 2 && figures_good(f); way++) {
            mgt_scene view;
            if (!compare_frame_scene(job, s, f->picture[FIGURE_KERNELS_9], frame, &view)) {
                f->code = EXIT_CODE_BAD_INPUT;
                break;
            }
            view.shutter = 0;
            view.quality.kernels = way ? MGT_MIXTURE_RIEMANN : MGT_MIXTURE_9;
            view.quality.elongation_limit = way ? 0 : 9;
            const mgt_status status = mgt_render(job->context, &view, &target, 1);
            if (status != MGT_OK)
                f->code = console_library_error(job->context, status);
            figures_step(f);
            for (size_t i = 0; i < pixels; i++)
                sums[way] += (double)coverage[i];
        }
    free(coverage);
}

static void plate_of_pictures(figures_job *f)
{
    enum { ACROSS = 250, GAP = 12, SCENE = 1 };
    const compare_scene *s = &f->compare->scenes[SCENE];
    const svg_crop crop = figures_glitter_crop(s->width, s->height);
    const double tall = crop.height * ACROSS / crop.width, row = tall + 60;
    svg sheet;
    if (!figures_sheet(f, &sheet, 4 * ACROSS + 5 * GAP, 2 * row + 10))
        return;
    for (int way = -1; way < WAYS && figures_good(f); way++) {
        const int place = way + 1;
        const double x = GAP + (ACROSS + GAP) * (place % 4), y = 34 + row * (place / 4);
        figures_put(f, &sheet, SCENE, way < 0 ? COMPARE_REFERENCE : f->picture[way_methods[way]], &crop, x, y, ACROSS / crop.width);
        svg_text(&sheet, x, y - 8, 14, SVG_LEFT, "font-weight=\"bold\"", "(%c) %s", "abcdefg"[place],
                 way < 0 ? "reference" : figure_methods[way_methods[way]].title);
        if (way >= 0)
            svg_text(&sheet, x, y + tall + 16, 11.5, SVG_LEFT, "", "RMSE %.4f displayed, %.4f coverage",
                     f->scores[SCENE][way_methods[way]].displayed[FIGURE_SHOWN], f->scores[SCENE][way_methods[way]].rmse);
    }
    figures_plate(f, &sheet, "fig17", "The smooth scene by 1, 3, 5, 9 kernels, Feline and convolution");
}

static void table_of_ways(figures_job *f, double stills[FIGURE_SCENES][2])
{
    json_t *json = json_object();
    fputs("<table><tr><th>RMSE</th>", f->page);
    for (int s = 0; s < FIGURE_SCENES; s++)
        fprintf(f->page, "<th>%s, displayed</th><th>coverage</th>", figure_scenes[s]);
    fputs("</tr>\n", f->page);
    for (int w = 0; w < WAYS; w++) {
        json_t *list = json_array();
        fprintf(f->page, "<tr><td>%s</td>", figure_methods[way_methods[w]].title);
        for (int s = 0; s < FIGURE_SCENES; s++) {
            const figure_score *score = &f->scores[s][way_methods[w]];
            fprintf(f->page, "<td>%.4f</td><td>%.4f</td>", score->displayed[FIGURE_SHOWN], score->rmse);
            json_array_append_new(list,
                                  json_pack("{s:s, s:o, s:o, s:o}", "scene", figure_scenes[s], "displayed_rmse", figures_number(score->displayed[FIGURE_SHOWN]),
                                            "coverage_rmse", figures_number(score->rmse), "light_kept", figures_number(score->kept)));
        }
        fputs("</tr>\n", f->page);
        json_object_set_new(json, figure_methods[way_methods[w]].title, list);
    }
    fputs("</table>\n<p>Sum of coverage with a closed shutter, where both apply, nine kernels over Riemann sums:", f->page);
    for (int s = 0; s < FIGURE_SCENES; s++) {
        char claim[96];
        const double ratio = stills[s][0] / stills[s][1];
        fprintf(f->page, " %s %.4f%s", figure_scenes[s], ratio, s < FIGURE_SCENES - 1 ? "," : ".</p>\n");
        snprintf(claim, sizeof claim, "Fig. 17, %s: coverage by 9 kernels over that by Riemann sums, closed shutter", figure_scenes[s]);
        figures_check(f, claim, ratio, 0.97, 1.03);
    }
    json_object_set_new(f->result, "fig17", json);
}

void figures_kernels(figures_job *f)
{
    double stills[FIGURE_SCENES][2];
    figures_steps(f, ELONGATIONS + 2 * FIGURE_SCENES * f->compare->frame_count);
    figures_section(f, "fig17", "Fig. 17: numbers of kernels, Feline, convolution");
    fputs("<p class=\"published\">Published: a reference of 8 spatial samples (a) and five pictures (b)–(f) by different numbers of circular "
          "kernels without fallback, Feline and convolution, RMSE of displayed colour .0209, .0195, .0181, .0191, .0183. (d) captures most and has "
          "time, (f) is better near the horizon, so the paper uses both.</p>\n"
          "<p>The paper's model per pixel, kernels without fallback. The plate shows the smooth scene; the table all of them.</p>\n",
          f->page);
    for (size_t s = 0; s < FIGURE_SCENES && figures_good(f); s++)
        still_sums(f, s, stills[s]);
    plate_of_pictures(f);
    if (figures_good(f)) {
        table_of_ways(f, stills);
        figure_of_shares(f);
    }
    figures_section_end(f);
}
