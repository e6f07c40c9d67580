/* SPDX-License-Identifier: MIT */
/* Methods with their options in one word. */
#include "cli/common/method_spec.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/method_options.h"
#include "cli/common/names.h"
#include "cli/common/numbers.h"

typedef struct spec_option {
    const char *name, *allowed;
    bool (*set)(mgt_quality *quality, const char *value); /* false: `allowed` says what would do */
} spec_option;

static bool set_number(const char *value, uint64_t limit, uint32_t *number)
{
    uint64_t n;
    if (!number_parse_u64(value, limit, &n) || n == 0)
        return false;
    *number = (uint32_t)n;
    return true;
}

static bool set_spatial(mgt_quality *quality, const char *value)
{
    return method_takes(quality->method, METHOD_TAKES_STRATA) && set_number(value, 1024, &quality->spatial_samples);
}

static bool set_time(mgt_quality *quality, const char *value)
{
    return method_takes(quality->method, METHOD_TAKES_TIMES) && set_number(value, 65536, &quality->time_samples);
}

static bool set_ndf_mean(mgt_quality *quality, const char *value)
{
    const bool drop = strcmp(value, "drop") == 0;
    if (!method_takes(quality->method, METHOD_TAKES_NDF_MEAN) || (!drop && strcmp(value, "add") != 0))
        return false;
    quality->ndf_mean_drop = drop;
    return true;
}

static const spec_option spec_options[] = {
    {"spatial", "reference with a number from 1 to 1024", set_spatial},
    {"time-samples", "ssaaN or reference with a number from 1 to 65536", set_time},
    {"ndf-mean", "podee-pixel with add or drop", set_ndf_mean},
};
enum { OPTION_COUNT = sizeof spec_options / sizeof spec_options[0] };

static bool fail(char *wrong, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

static bool fail(char *wrong, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(wrong, size, format, arguments);
    va_end(arguments);
    return false;
}

static void add_words(method_spec *spec, const char *word, size_t length)
{
    const size_t used = strlen(spec->options);
    snprintf(spec->options + used, sizeof spec->options - used, " --%.*s %s", (int)length, word, word + length + 1);
}

static bool set_option(method_spec *spec, const char *word, method_options *given, char *wrong, size_t wrong_size)
{
    const size_t length = strcspn(word, "=");
    if (!word[length])
        return fail(wrong, wrong_size, "%s: options are written NAME:OPTION=VALUE", spec->name);
    const char **value = method_option(given, word, length);
    if (value && value != &given->refraction.method) { /* which follows the + and is no option */
        *value = word + length + 1;
        add_words(spec, word, length);
        return true;
    }
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        const spec_option *o = &spec_options[i];
        if (strlen(o->name) != length || strncmp(o->name, word, length) != 0)
            continue;
        if (!o->set(&spec->quality, word + length + 1))
            return fail(wrong, wrong_size, "%s: %s is for %s", spec->name, o->name, o->allowed);
        add_words(spec, word, length);
        return true;
    }
    return fail(wrong, wrong_size,
                "%s: unknown option %.*s; allowed are spatial, time-samples, ndf-mean, kernels, integral, elongation, path-segments, "
                "transition, transition-width, adaptive, samples, target-rmse, budget-ms, importance-center, importance-width, importance-threshold, slots, "
                "tess-error, refraction-samples, caustics",
                spec->name, (int)length, word);
}

static void print_file_name(method_spec *spec)
{
    size_t i = 0;
    for (; spec->name[i]; i++) {
        const char c = spec->name[i];
        const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
        spec->file[i] = plain ? c : '-';
    }
    spec->file[i] = 0;
}

bool method_spec_parse(method_spec *spec, const char *text, size_t length, char *wrong, size_t wrong_size)
{
    *spec = (method_spec){0};
    mgt_quality_init(&spec->quality, sizeof spec->quality);
    if (length >= sizeof spec->name)
        return fail(wrong, wrong_size, "%.*s…: the name is too long", 32, text);
    memcpy(spec->name, text, length);
    char words[METHOD_SPEC_TEXT];
    memcpy(words, spec->name, sizeof words);
    char *rest = strchr(words, ':');
    if (rest)
        *rest++ = 0;
    method_options given = {0};
    char *refraction = strchr(words, '+');
    if (refraction) {
        *refraction++ = 0;
        mgt_refraction known;
        if (!refraction_from_name(refraction, strlen(refraction), &known))
            return fail(wrong, wrong_size, "%s: unknown refraction %s; allowed after the + are %s", spec->name, refraction, refraction_words);
        given.refraction.method = refraction;
    }
    if (!method_from_name(words, &spec->quality))
        return fail(wrong, wrong_size, "unknown method %s; allowed are %s", words, method_names().text);
    snprintf(spec->options, sizeof spec->options, "--method %s%s%s", words, refraction ? " --refraction " : "", refraction ? refraction : "");
    print_file_name(spec);
    while (rest) {
        char *next = strchr(rest, ':');
        if (next)
            *next++ = 0;
        if (!set_option(spec, rest, &given, wrong, wrong_size))
            return false;
        rest = next;
    }
    char reason[200];
    return method_options_apply(&given, &spec->quality, reason, sizeof reason) || fail(wrong, wrong_size, "%s: %s", spec->name, reason);
}
