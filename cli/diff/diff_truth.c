/* SPDX-License-Identifier: MIT */
/* Reports texture, specks, and errors without the reference's noise. */
#include "cli/diff/diff_truth.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "cli/common/console.h"
#include "cli/common/truth_json.h"

int diff_truth_add(truth_metrics *t, const diff_frame *frame)
{
    const truth_frame pictures = {frame->images, frame->count, frame->counted, frame->left_out};
    file_error error;
    if (truth_metrics_add(t, &pictures, &error) == FILE_OK)
        return EXIT_CODE_OK;
    return error.status == FILE_ARGUMENT ? console_error(EXIT_CODE_FAILED, "%s", error.text) : console_file_error(&error);
}

/* A JSON number, or null for NaN and infinities, which JSON does not have. */
static json_t *json_number(double number) { return isfinite(number) ? json_real(number) : json_null(); }

/* The report's object `key`, which is created if it does not exist. */
static json_t *object_of(json_t *report, const char *key)
{
    if (!json_object_get(report, key))
        json_object_set_new(report, key, json_object());
    return json_object_get(report, key);
}

int diff_truth_report(const truth_metrics *t, json_t *report)
{
    int failed = 0;
    if (t->has_second) {
        failed |= json_object_set_new(report, "noiseless_rmse", json_number(noise_sums_rmse(&t->noise)));
        failed |= json_object_set_new(report, "noise_floor", json_number(noise_sums_floor(&t->noise)));
    }
    const char *no_specks = truth_metrics_specks_missing(t), *no_texture = truth_metrics_texture_missing(t);
    if (t->wants.specks)
        failed |= json_object_set_new(object_of(report, "metrics"), "specks", no_specks ? json_null() : truth_specks_json(t));
    if (t->wants.specks && no_specks)
        failed |= json_object_set_new(object_of(report, "unavailable"), "specks", json_string(no_specks));
    if (t->wants.texture)
        failed |= json_object_set_new(object_of(report, "metrics"), "texture", t->mismatches ? json_null() : truth_texture_json(t));
    if (t->wants.texture && no_texture)
        failed |= json_object_set_new(object_of(report, "unavailable"), "texture", json_string(no_texture));
    return failed ? console_error(EXIT_CODE_FAILED, "out of memory") : EXIT_CODE_OK;
}

/* The number as text; "-": it is not defined. */
static const char *number_text(double number, char text[32])
{
    if (isfinite(number))
        snprintf(text, 32, "%.6g", number);
    else
        snprintf(text, 32, "-");
    return text;
}

static void print_texture(const truth_metrics *t)
{
    char text[6][32];
    const char *missing = truth_metrics_texture_missing(t);
    if (missing) {
        printf("%-15sunavailable: %s\n", "texture", missing);
        return;
    }
    const texture_summary s = texture_summarize(t->bands);
    printf("%-15scorrelation %s, least %s; contrast %s to %s; mean %s to %s\n", "texture", number_text(s.correlation_mean, text[0]),
           number_text(s.correlation_least, text[1]), number_text(s.contrast_least, text[2]), number_text(s.contrast_greatest, text[3]),
           number_text(s.mean_least, text[4]), number_text(s.mean_greatest, text[5]));
    printf("%7s %12s %12s %12s\n", "row", "contrast", "correlation", "mean");
    for (uint32_t i = 0; i < texture_bands(t->bands); i++) {
        const texture_band b = texture_band_at(t->bands, i);
        printf("%7" PRIu32 " %12s %12s %12s\n", b.row, number_text(b.contrast, text[0]), number_text(b.correlation, text[1]), number_text(b.mean, text[2]));
    }
}

void diff_truth_print(const truth_metrics *t)
{
    if (t->has_second)
        printf("%-15s%.6g\n%-15s%.6g\n", "noiseless rmse", noise_sums_rmse(&t->noise), "noise floor", noise_sums_floor(&t->noise));
    if (t->wants.specks && truth_metrics_specks_missing(t)) {
        printf("%-15sunavailable: %s\n", "specks", truth_metrics_specks_missing(t));
    } else if (t->wants.specks) {
        const speck_figures f = truth_metrics_specks(t);
        printf("%-15s%" PRIu64 " of %" PRIu64 " pixels, %.6g", "specks", t->specks, t->pixels, f.share);
        if (t->has_second)
            printf("; references of each other %.6g, %.6g; excess %.6g, %.6g", f.reference_count, f.reference_share, f.excess, f.excess_share);
        putchar('\n');
    }
    if (t->wants.texture)
        print_texture(t);
}
