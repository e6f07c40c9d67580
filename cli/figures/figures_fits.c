/* SPDX-License-Identifier: MIT */
/* Circular kernels against the ellipse that they approximate (Fig. 21). */
#include <math.h>

#include "cpu/mixture_lane.h"
#include "cli/figures/figures_job.h"
#include "cli/common/plot.h"

static const double pi = 3.14159265358979323846;

enum { FIT_STEPS = 129, FITTED = 4, FITS = FITTED + 2 };
static const int fit_kernels[FITS] = {1, 3, 5, 9, 5, 9};
static const char *const fit_names[FITS] = {"1 kernel", "3 kernels", "5 kernels", "9 kernels", "Feline, at most 5", "Feline, at most 9"};
static const char *const fit_dashes[FITS] = {"", "", "", "", "2 3", "7 4"};
static const size_t fit_colors[FITS] = {0, 1, 2, 3, 2, 3};

static mixture fit_at(int fit, double e) { return fit < FITTED ? mixture_fitted(fit_kernels[fit], e) : mixture_feline(e, fit_kernels[fit]); }

/* The sum of Eq. 28 as it is printed, divided by Eq. 25, for three kernels at elongation e. */
static double printed_over_true(double e)
{
    const mixture m = mixture_fitted(3, e);
    const mixture_part center = m.members[0], pair = m.members[1];
    return mixture_error_printed(center.weight, center.deviation, pair.weight, pair.deviation, pair.place, e) / mixture_error(&m, e);
}

static void table_of_fits(figures_job *f)
{
    static const double shown[] = {1.5, 2, 3, 4, 6, 8, 9};
    json_t *json = json_object();
    fputs("<table><tr><th>relative L2 error at σ<sub>y</sub> =</th>", f->page);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++)
        fprintf(f->page, "<th>%g</th>", shown[i]);
    fputs("</tr>\n", f->page);
    for (int k = 0; k < FITS; k++) {
        json_t *list = json_array();
        fprintf(f->page, "<tr><td>%s</td>", fit_names[k]);
        for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
            const mixture m = fit_at(k, shown[i]);
            const double error = sqrt(fmax(mixture_relative_error(&m, shown[i]), 0));
            fprintf(f->page, "<td>%.4f</td>", error);
            json_array_append_new(list, json_pack("{s:f, s:f, s:f}", "sigma_y", shown[i], "relative_l2", error, "epsilon", mixture_error(&m, shown[i])));
        }
        fputs("</tr>\n", f->page);
        json_object_set_new(json, fit_names[k], list);
    }
    fputs("</table>\n", f->page);
    json_object_set_new(f->result, "fig21", json);
}

/* The largest ratio of a fit's error to that of the next coarser fit, for elongations from 1.5 to 9. */
static double worst_step(void)
{
    double worst = 0;
    for (double e = 1.5; e <= 9; e += 0.25)
        for (int k = 1; k < FITTED; k++) {
            const mixture fine = fit_at(k, e), coarse = fit_at(k - 1, e);
            worst = fmax(worst, mixture_error(&fine, e) / mixture_error(&coarse, e));
        }
    return worst;
}

/* The least ratio of Feline's relative error to that of fitted kernels, for elongations from 1.5 to 9. */
static double feline_least(int probes, int kernels)
{
    double least = INFINITY;
    for (double e = 1.5; e <= 9; e += 0.125) {
        const mixture feline = mixture_feline(e, probes), fitted = mixture_fitted(kernels, e);
        least = fmin(least, sqrt(mixture_relative_error(&feline, e) / mixture_relative_error(&fitted, e)));
    }
    return least;
}

void figures_fits(figures_job *f)
{
    double e[FIT_STEPS], error[FITS][FIT_STEPS], relative[FITS][FIT_STEPS], most = 0;
    svg sheet;
    for (int i = 0; i < FIT_STEPS; i++) {
        e[i] = 1 + 8.0 * i / (FIT_STEPS - 1);
        for (int k = 0; k < FITS; k++) {
            const mixture m = fit_at(k, e[i]);
            error[k][i] = fmax(mixture_error(&m, e[i]), 0);
            relative[k][i] = sqrt(fmax(mixture_relative_error(&m, e[i]), 1e-12));
        }
        most = fmax(most, error[1][i]);
    }
    if (!figures_sheet(f, &sheet, 1140, 410))
        return;
    const double step = pow(10, floor(log10(most)));
    const plot left = {.x = 95,
                       .y = 40,
                       .width = 380,
                       .height = 310,
                       .title = "as published: three kernels",
                       .across = {.label = "σy, the major deviation (minor: 1)", .low = 1, .high = 9, .step = 1},
                       .up = {.label = "ε (Eq. 25)", .low = 0, .high = step * ceil(most / step), .step = step / (most / step < 4 ? 2 : 1)}};
    const plot right = {.x = 575,
                        .y = 40,
                        .width = 380,
                        .height = 310,
                        .title = "all, relative: √(ε / ∬ ellipse²)",
                        .across = left.across,
                        .up = {.label = "relative L2 error", .low = 1e-3, .high = 1, .logarithmic = true}};
    plot_frame(&sheet, &left);
    plot_curve(&sheet, &left, e, error[1], FIT_STEPS, plot_color(1), "");
    plot_frame(&sheet, &right);
    for (int k = 0; k < FITS; k++) {
        plot_curve(&sheet, &right, e, relative[k], FIT_STEPS, plot_color(fit_colors[k]), fit_dashes[k]);
        plot_key(&sheet, 975, 60, k, plot_color(fit_colors[k]), fit_dashes[k], fit_names[k]);
    }
    figures_section(f, "fig21", "Fig. 21: error of the circular kernels");
    fputs("<p class=\"published\">Published: ε for three kernels over σ<sub>y</sub>, without printed values.</p>\n", f->page);
    figures_plate(f, &sheet, "fig21", "Fit error over elongation");
    table_of_fits(f);
    const double ratio = printed_over_true(4) / (4 * pi);
    fprintf(f->page,
            "<p>Eq. 28, with its b read as w₁, is 4π times Eq. 25 (measured: %.6f times 4π at σ<sub>y</sub> = 4). With as many probes as kernels "
            "Feline is worse at every elongation; its error jumps where a probe is added and grows where there are too few. Nine probes beat five "
            "fitted kernels in between: least error over theirs %.2f.</p>\n",
            ratio, feline_least(9, 5));
    figures_check(f, "Fig. 21: Eq. 28 as printed (b = w₁) over 4π times Eq. 25", ratio, 1 - 1e-4, 1 + 1e-4);
    figures_check(f, "Fig. 21: error of a fit over that of the next coarser one, largest from elongation 1.5", worst_step(), 0, 1);
    figures_check(f, "Fig. 21: relative error of Feline with five probes over that of five fitted kernels, least from elongation 1.5", feline_least(5, 5), 1,
                  INFINITY);
    figures_check(f, "Fig. 21: the same with nine", feline_least(9, 9), 1, INFINITY);
    figures_section_end(f);
}
