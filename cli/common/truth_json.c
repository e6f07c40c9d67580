/* SPDX-License-Identifier: MIT */
/* Texture and specks as JSON; see truth_json.h. */
#include "cli/common/truth_json.h"

#include <math.h>

/* A JSON number, or null for NaN and infinities, which JSON does not have. */
static json_t *json_number(double number) { return isfinite(number) ? json_real(number) : json_null(); }

json_t *truth_specks_json(const truth_metrics *t)
{
    const speck_figures f = truth_metrics_specks(t);
    json_t *specks = json_pack("{s:I, s:I, s:f}", "count", (json_int_t)t->specks, "pixels", (json_int_t)t->pixels, "share", f.share);
    if (specks && t->has_second) {
        json_object_set_new(specks, "reference_count", json_real(f.reference_count));
        json_object_set_new(specks, "reference_share", json_real(f.reference_share));
        json_object_set_new(specks, "excess", json_real(f.excess));
        json_object_set_new(specks, "excess_share", json_real(f.excess_share));
    }
    return specks;
}

json_t *truth_texture_json(const truth_metrics *t)
{
    if (truth_metrics_texture_missing(t))
        return json_null();
    const texture_summary s = texture_summarize(t->bands);
    json_t *list = json_array();
    for (uint32_t i = 0; i < texture_bands(t->bands); i++) {
        const texture_band b = texture_band_at(t->bands, i);
        json_array_append_new(list, json_pack("{s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:o}", "row", (json_int_t)b.row, "rows", (json_int_t)b.rows, "contrast",
                                              json_number(b.contrast), "correlation", json_number(b.correlation), "mean", json_number(b.mean), "contrast_noise",
                                              json_number(b.contrast_noise), "correlation_noise", json_number(b.correlation_noise), "mean_noise",
                                              json_number(b.mean_noise)));
    }
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "correlation_mean", json_number(s.correlation_mean), "correlation_least",
                     json_number(s.correlation_least), "contrast_least", json_number(s.contrast_least), "contrast_greatest", json_number(s.contrast_greatest),
                     "mean_least", json_number(s.mean_least), "mean_greatest", json_number(s.mean_greatest), "bands", list);
}
