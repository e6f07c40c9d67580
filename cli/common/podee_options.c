/* SPDX-License-Identifier: MIT */
/* The options of podee-* alone: how the Gaussian is integrated and how waves turn from resolved to unresolved. */
#include "cli/common/podee_options.h"

#include <stdio.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/common/option_words.h"
#include "params/methods.h"

static const struct {
    const char *word;
    mgt_kernels kernels;
} kernel_words[] = {
    {"exact", MGT_KERNELS_EXACT},     {"1", MGT_KERNELS_1}, {"3", MGT_KERNELS_3}, {"5", MGT_KERNELS_5}, {"9", MGT_KERNELS_9}, {"feline", MGT_KERNELS_FELINE},
    {"riemann", MGT_KERNELS_RIEMANN},
};
enum { KERNEL_WORDS = sizeof kernel_words / sizeof *kernel_words };

static const option_word words[] = {
    {"kernels", offsetof(podee_options, kernels)},       {"integral", offsetof(podee_options, integral)},
    {"elongation", offsetof(podee_options, elongation)}, {"path-segments", offsetof(podee_options, segments)},
    {"transition", offsetof(podee_options, transition)}, {"transition-width", offsetof(podee_options, width)},
};
enum { WORDS = sizeof words / sizeof *words };

const char **podee_option(podee_options *options, const char *name, size_t length) { return option_word_find(words, WORDS, options, name, length); }

static bool set_kernels(const podee_options *o, mgt_quality *q, char *wrong, size_t size)
{
    if (o->kernels) {
        size_t i = 0;
        while (i < KERNEL_WORDS && strcmp(o->kernels, kernel_words[i].word) != 0)
            i++;
        if (i == KERNEL_WORDS)
            return snprintf(wrong, size, "--kernels %s: allowed is 1, 3, 5, 9, feline, riemann or exact", o->kernels), false;
        q->kernels = kernel_words[i].kernels;
    }
    if (!o->integral)
        return true;
    const bool exact = strcmp(o->integral, "exact") == 0;
    if (!exact && strcmp(o->integral, "kernels") != 0)
        return snprintf(wrong, size, "--integral %s: allowed is exact or kernels", o->integral), false;
    if (o->kernels && exact != (q->kernels == MGT_KERNELS_EXACT))
        return snprintf(wrong, size, "--integral %s and --kernels %s contradict each other", o->integral, o->kernels), false;
    if (!o->kernels)
        q->kernels = exact ? MGT_KERNELS_EXACT : MGT_KERNELS_9;
    return true;
}

bool podee_options_apply(const podee_options *given, mgt_quality *quality, char *wrong, size_t size)
{
    mgt_quality *q = quality;
    const char *name = option_word_given(words, WORDS, given);
    uint64_t n;
    if (!name)
        return true;
    if (!method_takes(q->method, METHOD_TAKES_PODEE))
        return snprintf(wrong, size, "--%s: only the methods podee-uniform and podee-pixel take it", name), false;
    if (!set_kernels(given, q, wrong, size))
        return false;
    if (given->elongation) {
        if (q->kernels == MGT_KERNELS_EXACT || q->kernels == MGT_KERNELS_RIEMANN)
            return snprintf(wrong, size, "--elongation: it is for --kernels 1, 3, 5, 9 and feline, which fall back to riemann beyond it"), false;
        if (!number_parse_double(given->elongation, &q->elongation_limit) || !(q->elongation_limit >= 1 && q->elongation_limit <= 1e6))
            return snprintf(wrong, size, "--elongation %s: allowed is a number from 1 to 1e6", given->elongation), false;
    }
    if (given->segments) {
        if (!number_parse_u64(given->segments, 64, &n) || n == 0)
            return snprintf(wrong, size, "--path-segments %s: allowed is a number from 1 to 64", given->segments), false;
        q->path_segments = n > 1 ? (uint32_t)n : 0;
    }
    if (given->transition) {
        if (strcmp(given->transition, "soft") != 0 && strcmp(given->transition, "hard") != 0)
            return snprintf(wrong, size, "--transition %s: allowed is soft or hard", given->transition), false;
        q->transition_hard = given->transition[0] == 'h';
    }
    if (given->width) {
        if (q->transition_hard)
            return snprintf(wrong, size, "--transition-width: a hard transition has none"), false;
        if (!number_parse_double(given->width, &q->transition_width) || !(q->transition_width > 0 && q->transition_width <= 0.5))
            return snprintf(wrong, size, "--transition-width %s: allowed is more than 0 and at most 0.5 cycles per pixel", given->width), false;
    }
    return true;
}

podee_text podee_options_text(const mgt_quality *quality)
{
    const mgt_quality *q = quality;
    podee_text out = {""};
    if (q->kernels == MGT_KERNELS_EXACT && q->elongation_limit == 0 && q->path_segments < 2 && q->transition_width == 0 && !q->transition_hard)
        return out;
    const char *kernels = "";
    for (size_t i = 0; i < KERNEL_WORDS; i++)
        kernels = kernel_words[i].kernels == q->kernels ? kernel_words[i].word : kernels;
    snprintf(out.text, sizeof out.text, "kernels %s elongation %s segments %u transition %s %s", kernels, number_print(q->elongation_limit).text,
             q->path_segments, q->transition_hard ? "hard" : "soft", number_print(q->transition_width).text);
    return out;
}
