/* SPDX-License-Identifier: MIT */
/* The options of what is seen through the surface: the method, and how well. */
#include "cli/common/refraction_options.h"

#include <stdio.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/common/option_words.h"

const char refraction_words[] = "two-phase, hybrid, liu, broad, narrow, screen-space, distance-field, off, truth";

static const char *const names[] = {[MGT_REFRACTION_TWO_PHASE] = "two-phase",
                                    [MGT_REFRACTION_HYBRID] = "hybrid",
                                    [MGT_REFRACTION_LIU] = "liu",
                                    [MGT_REFRACTION_BROAD] = "broad",
                                    [MGT_REFRACTION_NARROW] = "narrow",
                                    [MGT_REFRACTION_SCREEN_SPACE] = "screen-space",
                                    [MGT_REFRACTION_DISTANCE_FIELD] = "distance-field",
                                    [MGT_REFRACTION_OFF] = "off",
                                    [MGT_REFRACTION_TRUTH] = "truth"};

bool refraction_from_name(const char *name, size_t length, mgt_refraction *refraction)
{
    for (int i = 0; i <= MGT_REFRACTION_TRUTH; i++)
        if (strlen(names[i]) == length && strncmp(names[i], name, length) == 0) {
            *refraction = (mgt_refraction)i;
            return true;
        }
    return false;
}

const char *refraction_name(mgt_refraction refraction) { return names[refraction]; }

const char **refraction_option(refraction_options *options, const char *name, size_t length)
{
    static const option_word words[] = {
        {"refraction", offsetof(refraction_options, method)},
        {"tess-error", offsetof(refraction_options, tess_error)},
        {"refraction-samples", offsetof(refraction_options, samples)},
        {"caustics", offsetof(refraction_options, caustics)},
    };
    return option_word_find(words, sizeof words / sizeof *words, options, name, length);
}

/* The methods that bend triangles. */
static bool bends_triangles(mgt_refraction r)
{
    return r == MGT_REFRACTION_TWO_PHASE || r == MGT_REFRACTION_HYBRID || r == MGT_REFRACTION_LIU || r == MGT_REFRACTION_BROAD;
}

bool refraction_options_apply(const refraction_options *given, mgt_quality *quality, char *wrong, size_t size)
{
    mgt_quality *q = quality;
    uint64_t n;
    if (given->method && !refraction_from_name(given->method, strlen(given->method), &q->refraction))
        return snprintf(wrong, size, "--refraction %s: allowed is %s", given->method, refraction_words), false;
    if (given->tess_error) {
        if (!bends_triangles(q->refraction))
            return snprintf(wrong, size, "--tess-error: it is for --refraction two-phase, hybrid, liu and broad, which bend triangles"), false;
        if (!number_parse_double(given->tess_error, &q->tess_error) || !(q->tess_error >= 0.01 && q->tess_error <= 100))
            return snprintf(wrong, size, "--tess-error %s: allowed is a number from 0.01 to 100 pixels", given->tess_error), false;
    }
    if (given->samples) {
        if (!number_parse_u64(given->samples, 64, &n) || n == 0)
            return snprintf(wrong, size, "--refraction-samples %s: allowed is a number from 1 to 64", given->samples), false;
        q->refraction_samples = (uint32_t)n;
    }
    if (given->caustics) {
        if (strcmp(given->caustics, "on") != 0 && strcmp(given->caustics, "off") != 0)
            return snprintf(wrong, size, "--caustics %s: allowed is on or off", given->caustics), false;
        q->caustics = strcmp(given->caustics, "on") == 0;
    }
    return true;
}

refraction_text refraction_options_text(const mgt_quality *quality)
{
    const mgt_quality *q = quality;
    refraction_text out = {""};
    if (q->refraction != MGT_REFRACTION_TWO_PHASE || q->tess_error != 0 || q->refraction_samples != 0 || q->caustics)
        snprintf(out.text, sizeof out.text, "%s tess-error %s samples %u caustics %d", refraction_name(q->refraction), number_print(q->tess_error).text,
                 q->refraction_samples, q->caustics);
    return out;
}
