/* SPDX-License-Identifier: MIT */
/* The options of method adaptive alone: its scheme, and how much it samples. */
#include "cli/common/adaptive_options.h"

#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/common/option_words.h"
#include "params/methods.h"

static const option_word words[] = {
    {"adaptive", offsetof(adaptive_options, scheme)},        {"slots", offsetof(adaptive_options, slots)},
    {"samples", offsetof(adaptive_options, samples)},        {"target-rmse", offsetof(adaptive_options, target)},
    {"budget-ms", offsetof(adaptive_options, budget)},       {"importance-center", offsetof(adaptive_options, center)},
    {"importance-width", offsetof(adaptive_options, width)}, {"importance-threshold", offsetof(adaptive_options, threshold)},
};
enum { WORDS = sizeof words / sizeof *words };

/* A number for one member of mgt_quality; podee: for that scheme alone, cells: for the other. */
static const struct {
    const char *name;
    size_t value; /* offset in mgt_quality */
    double least, most;
    bool cells, podee;
} numbers[] = {
    {"samples", offsetof(mgt_quality, samples), 1, 4096, true, true},
    {"target-rmse", offsetof(mgt_quality, target_rmse), 1e-6, 1, true, false},
    {"budget-ms", offsetof(mgt_quality, budget_ms), 0.1, 1e7, true, false},
    {"importance-center", offsetof(mgt_quality, importance_center), 1e-6, 1, false, true},
    {"importance-width", offsetof(mgt_quality, importance_width), 1e-6, 1, false, true},
    {"importance-threshold", offsetof(mgt_quality, importance_threshold), 1e-6, 1, false, true},
};
enum { NUMBERS = sizeof numbers / sizeof *numbers };

const char **adaptive_option(adaptive_options *options, const char *name, size_t length) { return option_word_find(words, WORDS, options, name, length); }

static bool set_numbers(adaptive_options given, mgt_quality *q, char *wrong, size_t size)
{
    const bool podee = q->adaptive == MGT_ADAPTIVE_PODEE;
    for (size_t i = 0; i < NUMBERS; i++) {
        const char *word = *adaptive_option(&given, numbers[i].name, strlen(numbers[i].name));
        double value;
        if (!word)
            continue;
        if (podee ? !numbers[i].podee : !numbers[i].cells)
            return snprintf(wrong, size, "--%s: it is for --adaptive %s", numbers[i].name, numbers[i].podee ? "podee" : "cells"), false;
        if (!number_parse_double(word, &value) || !(value >= numbers[i].least && value <= numbers[i].most))
            return snprintf(wrong, size, "--%s %s: allowed is a number from %g to %g", numbers[i].name, word, numbers[i].least, numbers[i].most), false;
        memcpy((char *)q + numbers[i].value, &value, sizeof value);
    }
    return true;
}

bool adaptive_options_apply(const adaptive_options *given, mgt_quality *quality, char *wrong, size_t size)
{
    mgt_quality *q = quality;
    if (!option_word_given(words, WORDS, given))
        return true;
    if (!method_takes(q->method, METHOD_TAKES_ADAPTIVE))
        return snprintf(wrong, size, "--adaptive, --samples, --target-rmse, --budget-ms, --importance-… and --slots: only method adaptive takes them"), false;
    if (given->scheme) {
        if (strcmp(given->scheme, "cells") != 0 && strcmp(given->scheme, "podee") != 0)
            return snprintf(wrong, size, "--adaptive %s: allowed is cells or podee", given->scheme), false;
        q->adaptive = given->scheme[0] == 'p' ? MGT_ADAPTIVE_PODEE : MGT_ADAPTIVE_CELLS;
    }
    if ((given->samples != NULL) + (given->target != NULL) + (given->budget != NULL) + (given->slots != NULL) > 1)
        return snprintf(wrong, size, "--samples, --target-rmse, --budget-ms and --slots each say how much to sample; give one"), false;
    if (given->slots) {
        if (q->adaptive != MGT_ADAPTIVE_PODEE)
            return snprintf(wrong, size, "--slots: it is for --adaptive podee"), false;
        if (!number_parse_u64(given->slots, (uint64_t)1 << 32, &q->sample_slots) || q->sample_slots == 0)
            return snprintf(wrong, size, "--slots %s: allowed is a number from 1 to 4294967296", given->slots), false;
    }
    return set_numbers(*given, q, wrong, size);
}

adaptive_text adaptive_options_text(const mgt_quality *quality)
{
    const mgt_quality *q = quality;
    adaptive_text out = {""};
    if (!method_takes(q->method, METHOD_TAKES_ADAPTIVE))
        return out;
    if (q->adaptive == MGT_ADAPTIVE_PODEE)
        snprintf(out.text, sizeof out.text, "podee samples %s slots %" PRIu64 " center %s width %s threshold %s", number_print(q->samples).text,
                 q->sample_slots, number_print(q->importance_center).text, number_print(q->importance_width).text, number_print(q->importance_threshold).text);
    else
        snprintf(out.text, sizeof out.text, "cells samples %s target-rmse %s budget-ms %s", number_print(q->samples).text, number_print(q->target_rmse).text,
                 number_print(q->budget_ms).text);
    return out;
}
