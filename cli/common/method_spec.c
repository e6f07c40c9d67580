/* SPDX-License-Identifier: MIT */
/* Methods with their options in one word. */
#include "cli/common/method_spec.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "params/methods.h"

static bool fail(char *wrong, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

static bool fail(char *wrong, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(wrong, size, format, arguments);
    va_end(arguments);
    return false;
}

static void append(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

/* Adds an option to spec->options and to `name`, the part of the spec's name that has been read. */
static void add_words(method_spec *spec, char name[METHOD_SPEC_TEXT], const char *word, size_t length)
{
    const char *value = word + length + 1;
    quality_option_first_names(&word, &length, &value);
    append(spec->options, sizeof spec->options, " --%.*s %s", (int)length, word, value);
    append(name, METHOD_SPEC_TEXT, ":%.*s=%s", (int)length, word, value);
}

static bool set_option(method_spec *spec, char name[METHOD_SPEC_TEXT], const char *word, char *wrong, size_t wrong_size)
{
    const size_t length = strcspn(word, "=");
    char reason[512];
    bool known = false;
    if (!word[length])
        return fail(wrong, wrong_size, "%s: options are written NAME:OPTION=VALUE", spec->name);
    /* The method comes first, refraction follows the +, and all methods have the same seed. */
    const bool apart = strncmp(word, "method=", 7) == 0 || strncmp(word, "refraction=", 11) == 0 || strncmp(word, "seed=", 5) == 0;
    if (!apart && quality_option_set(&spec->given, word, length, word + length + 1, &known, reason, sizeof reason)) {
        add_words(spec, name, word, length);
        return strlen(name) < METHOD_SPEC_TEXT - 1 ||
               fail(wrong, wrong_size, "%.*s…: the name with its options has more than %d characters", 32, name, METHOD_SPEC_TEXT - 2);
    }
    if (known)
        return fail(wrong, wrong_size, "%s: %s", spec->name, reason);
    return fail(
        wrong, wrong_size,
        "%s: unknown option %.*s; allowed are the options of quality in mangata render --help, but for seed and for refraction, which is written METHOD+NAME",
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
    *spec = (method_spec){.given = quality_options_none()};
    if (length >= sizeof spec->name)
        return fail(wrong, wrong_size, "%.*s…: the name with its options has %zu characters; allowed are %d", 32, text, length, METHOD_SPEC_TEXT - 1);
    memcpy(spec->name, text, length);
    char words[METHOD_SPEC_TEXT], name[METHOD_SPEC_TEXT];
    memcpy(words, spec->name, sizeof words);
    char *rest = strchr(words, ':');
    if (rest)
        *rest++ = 0;
    char *refraction = strchr(words, '+');
    char reason[600];
    bool known;
    if (refraction)
        *refraction++ = 0;
    if (!quality_option_set(&spec->given, "method", 6, words, &known, reason, sizeof reason))
        return fail(wrong, wrong_size, "unknown method %s; allowed are %s", words, method_names().text);
    if (refraction && !quality_option_set(&spec->given, "refraction", 10, refraction, &known, reason, sizeof reason))
        return fail(wrong, wrong_size, "%s: %s", spec->name, reason);
    const char *refraction_name = refraction ? refraction : "";
    quality_option_first_names(&(const char *){"refraction"}, &(size_t){10}, &refraction_name);
    snprintf(spec->options, sizeof spec->options, "--method %s%s%s", words, refraction ? " --refraction " : "", refraction_name);
    if (snprintf(name, sizeof name, "%s%s%s", words, refraction ? "+" : "", refraction_name) >= (int)sizeof name)
        return fail(wrong, wrong_size, "%s: more than %d characters", spec->name, METHOD_SPEC_TEXT - 1);
    while (rest) {
        char *next = strchr(rest, ':');
        if (next)
            *next++ = 0;
        if (!set_option(spec, name, rest, wrong, wrong_size))
            return false;
        rest = next;
    }
    memcpy(spec->name, name, sizeof name);
    print_file_name(spec);
    const mgt_quality base = quality_defaults();
    return quality_options_apply(&spec->given, &base, &spec->quality, reason, sizeof reason) || fail(wrong, wrong_size, "%s: %s", spec->name, reason);
}
