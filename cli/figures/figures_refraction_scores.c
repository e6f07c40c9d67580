/* SPDX-License-Identifier: MIT */
/* Scores the radiance that comes through the surface against path-traced references. */
#include <math.h>
#include <stdlib.h>

#include "cli/diff/diff_prepare.h"
#include "cli/figures/figures_refraction.h"
#include "cli/common/interrupt.h"

/* ---- pictures to compare ---- */

static int read_layer(refraction_figures *r, refraction_view view, size_t picture, const char *layer, float_image *out)
{
    char path[COMPARE_PATH];
    file_error error;
    if (!compare_picture_path(r->compare, refraction_scene(r, view), picture, 0, path))
        return EXIT_CODE_USAGE;
    return picture_read(out, path, layer, &error) == FILE_OK ? EXIT_CODE_OK : compare_file_failure(r->compare, &error);
}

int refraction_pair_read(refraction_figures *r, refraction_view view, size_t picture, size_t truth, refraction_pair *out)
{
    *out = (refraction_pair){.mask = {0}};
    int code = read_layer(r, view, picture, "refraction", &out->image[0]);
    if (code == EXIT_CODE_OK)
        code = read_layer(r, view, truth, "refraction", &out->image[1]);
    if (code == EXIT_CODE_OK)
        code = read_layer(r, view, truth, "mask", &out->mask);
    if (code != EXIT_CODE_OK) {
        refraction_pair_free(out);
        return code;
    }
    for (int i = 0; i < 2; i++)
        diff_prepare_display(&out->image[i], -REFRACTION_STOPS_DOWN);
    out->left_out = diff_prepare_mask(out->image, 2, &out->mask);
    return EXIT_CODE_OK;
}

void refraction_pair_free(refraction_pair *pair)
{
    for (int i = 0; i < 2; i++)
        float_image_free(&pair->image[i]);
    float_image_free(&pair->mask);
}

/* ---- scores ---- */

double refraction_pair_difference(const refraction_pair *pair, size_t pixel)
{
    double most = 0;
    for (size_t c = 0; c < 3; c++)
        most = fmax(most, fabs((double)pair->image[0].pixels[3 * pixel + c] - (double)pair->image[1].pixels[3 * pixel + c]));
    return 255 * most;
}

static double share_of_artefacts(const refraction_pair *pair)
{
    const size_t pixels = (size_t)pair->mask.width * pair->mask.height;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++)
        count += refraction_pair_difference(pair, i) > ARTEFACT;
    return pixels > pair->left_out ? (double)count / (double)(pixels - pair->left_out) : 0;
}

/* Computes the metrics of a pair. The RMSE is 0 to 255, over pixels that are all water. */
static int score_pair(refraction_figures *r, const refraction_pair *pair, uint32_t metrics, clip_scores *scores)
{
    const clip_metrics_desc desc = {.width = pair->mask.width, .height = pair->mask.height, .channels = 3, .metrics = metrics, .srgb_encoded = true};
    clip_metrics *clip = NULL;
    file_error error;
    file_status status = clip_metrics_create(&clip, &desc, &error);
    if (status == FILE_OK)
        status = clip_metrics_add(clip, &pair->image[0], &pair->image[1], NULL, NULL, &error);
    if (status == FILE_OK)
        status = clip_metrics_scores(clip, scores, &error);
    if (status == FILE_OK) {
        image_metrics sums = *clip_metrics_sums(clip);
        sums.values -= 3 * pair->left_out; /* these pixels are black in both pictures */
        scores->values[CLIP_RMSE] = 255 * image_metrics_rmse(&sums);
    }
    clip_metrics_free(clip);
    return status == FILE_OK ? EXIT_CODE_OK : compare_file_failure(r->compare, &error);
}

static int measure(refraction_figures *r, refraction_view view, refraction_method method)
{
    const bool yee = view == VIEW_FLAT || view == VIEW_WAVES;
    const uint32_t metrics = 1u << CLIP_RMSE | 1u << CLIP_SSIM | 1u << CLIP_FLIP | (yee ? 1u << CLIP_YEE : 0);
    refraction_score *score = &r->scores[view][method];
    clip_scores same, many;
    refraction_pair pair;
    int code = refraction_pair_read(r, view, refraction_picture(method), refraction_picture(SHOWN_RAY), &pair);
    if (code != EXIT_CODE_OK)
        return code;
    code = score_pair(r, &pair, metrics, &same);
    score->artefacts = share_of_artefacts(&pair);
    refraction_pair_free(&pair);
    if (code == EXIT_CODE_OK)
        code = refraction_pair_read(r, view, refraction_picture(method), COMPARE_REFERENCE, &pair);
    if (code != EXIT_CODE_OK)
        return code;
    code = score_pair(r, &pair, 1u << CLIP_RMSE, &many);
    refraction_pair_free(&pair);
    score->rmse = same.values[CLIP_RMSE];
    score->ssim = same.values[CLIP_SSIM];
    score->flip = same.values[CLIP_FLIP];
    score->yee = same.values[CLIP_YEE];
    score->many = many.values[CLIP_RMSE];
    return code;
}

static bool is_scored(const refraction_figures *r, int view, int method)
{
    const size_t place = r->place[view];
    return method < TIMED_TRUTH && place < COMPARE_SCENES && !r->renders.views[place].only_timed &&
           compare_draws(&r->compare->scenes[place], refraction_picture((refraction_method)method));
}

void refraction_measure(refraction_figures *r)
{
    uint64_t steps = 0;
    figures_job *f = r->figures;
    for (int v = 0; v < REFRACTION_VIEWS; v++)
        for (int m = 0; m < REFRACTION_METHODS; m++) {
            r->scores[v][m] = (refraction_score){NAN, NAN, NAN, NAN, NAN, NAN};
            steps += is_scored(r, v, m);
        }
    figures_steps(f, steps);
    for (int v = 0; v < REFRACTION_VIEWS && figures_good(f); v++)
        for (int m = 0; m < REFRACTION_METHODS && figures_good(f); m++)
            if (is_scored(r, v, m)) {
                f->code = measure(r, (refraction_view)v, (refraction_method)m);
                figures_step(f);
            }
    progress_clear(&f->compare->progress);
}

refraction_score_text refraction_score_print(const refraction_figures *r, refraction_view view, refraction_method method)
{
    const refraction_score *score = &r->scores[view][method];
    refraction_score_text out;
    snprintf(out.text, sizeof out.text, "RMSE %.1f, artefacts %.1f%%", score->rmse, 100 * score->artefacts);
    return out;
}
