/* SPDX-License-Identifier: MIT */
#include "cli/common/method_options.h"

const char **method_option(method_options *options, const char *name, size_t length)
{
    const char **word = podee_option(&options->podee, name, length);
    if (!word)
        word = adaptive_option(&options->adaptive, name, length);
    return word ? word : refraction_option(&options->refraction, name, length);
}

bool method_options_apply(const method_options *given, mgt_quality *quality, char *wrong, size_t size)
{
    return podee_options_apply(&given->podee, quality, wrong, size) && adaptive_options_apply(&given->adaptive, quality, wrong, size) &&
           refraction_options_apply(&given->refraction, quality, wrong, size);
}
