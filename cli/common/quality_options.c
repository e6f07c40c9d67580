/* SPDX-License-Identifier: MIT */
/* Options of quality on the command line. */
#include "cli/common/quality_options.h"

#include <string.h>

#include "cli/common/numbers.h"
#include "params/methods.h"

quality_options quality_options_none(void) { return (quality_options){.choice = quality_choice_none()}; }

static bool is(const char *name, size_t length, const char *known) { return strlen(known) == length && strncmp(name, known, length) == 0; }

static bool set_integral(quality_options *o, const char *value, char *wrong, size_t size)
{
    o->integral = strcmp(value, "exact") == 0 ? 1 : strcmp(value, "kernels") == 0 ? 2 : 0;
    return o->integral || (snprintf(wrong, size, "--integral %s: allowed is exact or kernels", value), false);
}

enum { PARTS_MOST = 1000000 };

static bool set_range(quality_options *o, const char *value, char *wrong, size_t size)
{
    uint64_t range[2];
    o->part[1] = 0;
    o->range_given = number_parse_list(value, '/', PARTS_MOST, 2, o->part) && o->part[0] < o->part[1];
    if (o->range_given)
        return true;
    o->range_given = number_parse_list(value, ',', UINT64_MAX, 2, range) && range[1] > 0;
    if (!o->range_given)
        return snprintf(wrong, size, "--samples-range %s: allowed is FIRST,COUNT with COUNT at least 1, or I/N, the part I of 0 ... N-1", value), false;
    o->choice.values.sample_first = range[0];
    o->choice.values.sample_count = range[1];
    return true;
}

/* The row of an option. *alias: whether `name` is its alias. NULL: there is no such option. */
static const field_row *row_of(const char *name, size_t length, bool *alias)
{
    char key[40];
    for (size_t i = 0; i < length && i < sizeof key; i++)
        key[i] = name[i] == '-' ? '_' : name[i];
    const field_row *field = length < sizeof key ? field_find(quality_fields, key, length) : NULL;
    *alias = field && field_is_alias(field, key, length);
    return field;
}

void quality_option_first_names(const char **name, size_t *length, const char **value)
{
    bool alias;
    const field_row *field = row_of(*name, *length, &alias);
    if (alias) {
        *name = field->key;
        *length = strlen(field->key);
    }
    if (field)
        *value = name_first(field->aliases, *value);
}

bool quality_count_read(const char *name, const char *value, uint32_t *count, char *wrong, size_t size)
{
    char allowed[160];
    bool alias;
    field_row row = *row_of(name, strlen(name), &alias);
    row.flags = 0;
    field_allowed(&row, allowed, sizeof allowed);
    return field_parse(&row, value, count) || (snprintf(wrong, size, "--%s %s: allowed is %s", name, value, allowed), false);
}

bool quality_option_set(quality_options *options, const char *name, size_t length, const char *value, bool *known, char *wrong, size_t size)
{
    char allowed[160];
    bool alias;
    *known = true;
    if (is(name, length, "integral"))
        return set_integral(options, value, wrong, size);
    if (is(name, length, "samples-range"))
        return set_range(options, value, wrong, size);
    const field_row *field = row_of(name, length, &alias);
    *known = field && (field == quality_fields || !(field->flags & FIELD_NO_FLAG));
    if (!*known)
        return false;
    if (!quality_choose_name(&options->choice, field, alias, wrong, size))
        return false;
    if (quality_choose(&options->choice, field, value)) {
        if (field == quality_fields)
            options->number_in_name = method_name_has_number(value);
        return true;
    }
    field_allowed(field, allowed, sizeof allowed);
    snprintf(wrong, size, "%s %s: allowed is %s", alias ? option_flag_alias(field).text : option_flag_of(field).text, value,
             field == quality_fields ? method_names().text : allowed);
    return false;
}

bool quality_options_apply(const quality_options *options, const mgt_quality *base, mgt_quality *out, char *wrong, size_t size)
{
    quality_options o = *options;
    mgt_quality *q = &o.choice.values;
    const field_row *kernels = field_find(quality_fields, "kernels", 7), *spatial = field_find(quality_fields, "spatial", 7);
    if (o.integral && quality_is_chosen(&o.choice, kernels)) {
        if ((o.integral == 1) != (q->kernels == MGT_MIXTURE_EXACT))
            return snprintf(wrong, size, "--integral and --kernels contradict each other"), false;
    } else if (o.integral) {
        quality_choose(&o.choice, kernels, o.integral == 1 ? "exact" : "9");
    }
    if (o.number_in_name && quality_is_chosen(&o.choice, spatial))
        return snprintf(wrong, size, "--spatial: the number stands in ssaaN already; allowed are ssaaN or --method ssaa --spatial N"), false;
    if (!quality_apply(&o.choice, base, out, wrong, size))
        return false;
    if (!o.range_given)
        return true;
    const uint64_t total = quality_range(out);
    const char *whose = out->method == MGT_METHOD_ADAPTIVE ? "the picture" : "a pixel";
    if (total == 0 && out->method == MGT_METHOD_ADAPTIVE)
        return snprintf(wrong, size, "--samples-range: of adaptive, --adaptive podee with --slots has ranges"), false;
    if (total == 0)
        return snprintf(wrong, size, "--samples-range: method %s takes one sample", method_name(out).text), false;
    if (o.part[1] > total)
        return snprintf(wrong, size, "--samples-range %llu/%llu: %s has only %llu samples", (unsigned long long)o.part[0], (unsigned long long)o.part[1], whose,
                        (unsigned long long)total),
               false;
    if (o.part[1]) {
        q->sample_first = total * o.part[0] / o.part[1];
        q->sample_count = total * (o.part[0] + 1) / o.part[1] - q->sample_first;
    }
    if (q->sample_first >= total || q->sample_count > total - q->sample_first)
        return snprintf(wrong, size, "--samples-range %llu,%llu: allowed is FIRST,COUNT within the %llu samples of %s", (unsigned long long)q->sample_first,
                        (unsigned long long)q->sample_count, (unsigned long long)total, whose),
               false;
    /* The whole range gives the same picture as no range. */
    out->sample_first = q->sample_first;
    out->sample_count = q->sample_count == total ? 0 : q->sample_count;
    return true;
}
