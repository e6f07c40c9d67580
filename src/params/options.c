/* SPDX-License-Identifier: MIT
 *
 * Rows of the options of quality.
 */
#include "params/options.h"

#include <assert.h>
#include <string.h>

#include "params/methods.h"
#include "params/names.h"

static const char *const mean_words[] = {"add", "drop", NULL};
static const char *const transition_words[] = {"soft", "hard", NULL};
static const char *const switch_words[] = {"off", "on", NULL};

/* Sets the method's default numbers of samples. */
static void decide_method(void *parent)
{
    mgt_quality *q = parent;
    const method_row *row = method_of(q->method);
    q->spatial_samples = row->spatial ? row->spatial : METHOD_SIDE_DEFAULT;
    q->time_samples = row->time ? row->time : 1;
}

static bool read_method(const char *text, void *parent)
{
    mgt_quality *q = parent, named;
    if (!method_from_name(text, &named))
        return false;
    q->method = named.method;
    decide_method(q);
    if (method_of(q->method)->numbered)
        q->spatial_samples = named.spatial_samples;
    return true;
}

static const field_spelling numbered_methods = {"ssaaN (N from 1 to 1024)", "^ssaa0*([1-9][0-9]{0,2}|10[01][0-9]|102[0-4])$", read_method};
static_assert(METHOD_SIDE_MOST == 1024, "the texts above and the range of spatial say so");

#define MEMBER(name) offsetof(mgt_quality, name)
#define LARGEST 18446744073709551615.0
#define ONE(place) (UINT64_C(1) << (place))
#define SAMPLED "method", ONE(MGT_METHOD_SSAA) | ONE(MGT_METHOD_REFERENCE), true
#define RANGED "method", ONE(MGT_METHOD_SSAA) | ONE(MGT_METHOD_REFERENCE) | ONE(MGT_METHOD_ADAPTIVE), true
#define PODEE "method", ONE(MGT_METHOD_PODEE_UNIFORM) | ONE(MGT_METHOD_PODEE_PIXEL)
#define ADAPTIVE "method", ONE(MGT_METHOD_ADAPTIVE)
#define ALONG "adaptive", ONE(MGT_ADAPTIVE_PODEE)
#define BY_CELLS "adaptive", ONE(MGT_ADAPTIVE_CELLS)
enum { PLACE_1 = 1, PLACE_3, PLACE_5, PLACE_9, PLACE_FELINE }; /* in kernels_names */
#define MIXTURES "kernels", ONE(PLACE_1) | ONE(PLACE_3) | ONE(PLACE_5) | ONE(PLACE_9) | ONE(PLACE_FELINE), true
#define BENDING "refraction", ONE(MGT_REFRACTION_TWO_PHASE) | ONE(MGT_REFRACTION_HYBRID) | ONE(MGT_REFRACTION_LIU) | ONE(MGT_REFRACTION_BROAD), true
enum { HOW_MUCH = 1 }; /* field_row.alternative of options that say how much to sample */

const field_row quality_fields[] =
    {{"method", FIELD_CHOICE, MEMBER(method), FIELD_NO_FLAG, .doc = "how waves smaller than a pixel and the open shutter are averaged",
      .choices = &method_rows[0].properties.name, .choice_stride = sizeof(method_row), .preset = MGT_METHOD_MANGATA, .label = "NAME", .also = &numbered_methods,
      .decide = decide_method},
     {"spatial", FIELD_COUNT, MEMBER(spatial_samples), 0, 1, METHOD_SIDE_MOST, NULL, .doc = "N of N x N samples a pixel for each time sample", .preset = 4,
      .absent = "8 for reference, 4 for ssaa", .member = "spatial_samples", .when = {{SAMPLED}}},
     {"time_samples", FIELD_COUNT, MEMBER(time_samples), 0, 1, 65536, NULL, .doc = "samples of the open shutter", .preset = 1,
      .absent = "8 for reference, 1 for ssaa", .label = "M", .when = {{SAMPLED}}},
     {"sample_first", FIELD_LARGE, MEMBER(sample_first), FIELD_NO_FLAG, 0, LARGEST, NULL,
      .doc = "first of the samples that are taken; of adaptive, of the slots of podee", .when = {{RANGED}}},
     {"sample_count", FIELD_LARGE, MEMBER(sample_count), FIELD_NO_FLAG, 0, LARGEST, NULL, .doc = "how many samples are taken", .absent = "all that remain",
      .when = {{RANGED}}},
     {"seed", FIELD_LARGE, MEMBER(seed), 0, 0, LARGEST, NULL, .doc = "seed of the jitter"},
     {"ndf_mean", FIELD_SWITCH, MEMBER(ndf_mean_drop), 0, .doc = "add the mean slope of the filtered waves, or drop it as printed in the paper",
      .choices = mean_words, .member = "ndf_mean_drop", .when = {{"method", ONE(MGT_METHOD_PODEE_PIXEL), true}}},
     {"kernels", FIELD_CHOICE, MEMBER(kernels),
      .doc = "how the elliptical Gaussian is integrated: exactly, as so many circular ones, as feline's, or as a sum over the disk", .choices = kernels_names,
      .alias = "mixture", .values = kernels_values, .label = "K", .when = {{PODEE}}},
     {"elongation", FIELD_NUMBER, MEMBER(elongation_limit), FIELD_OR_ZERO, 1, 1e6, NULL, .doc = "ellipses longer than this are summed as by riemann",
      .absent = "the number of kernels; 1 and feline: never", .member = "elongation_limit", .label = "E", .when = {{PODEE}, {MIXTURES}}},
     {"path_segments", FIELD_COUNT, MEMBER(path_segments), FIELD_OR_ZERO, 1, 64, NULL, .doc = "straight pieces of the open shutter", .absent = "1",
      .when = {{PODEE}}},
     {"transition", FIELD_SWITCH, MEMBER(transition_hard), .doc = "waves turn from resolved to unresolved softly or hard", .choices = transition_words,
      .member = "transition_hard", .label = "T", .when = {{PODEE}}},
     {"transition_width", FIELD_NUMBER, MEMBER(transition_width), 0, 0, 0.5, "cycles/pixel", .doc = "width of a soft transition", .absent = "0.3", .label = "W",
      .when = {{PODEE}, {"transition", 1, true}}},
     {"adaptive", FIELD_CHOICE, MEMBER(adaptive), .doc = "how pixels that need more samples are found: cells, or as Podee et al. do", .choices = adaptive_names,
      .label = "SCHEME", .when = {{ADAPTIVE}}},
     {"samples", FIELD_NUMBER, MEMBER(samples), FIELD_OR_ZERO, 1, 4096, NULL, .doc = "evaluations of all waves per pixel of water, on average", .absent = "8",
      .label = "N", .when = {{ADAPTIVE}}, .alternative = HOW_MUCH},
     {"target_rmse", FIELD_NUMBER, MEMBER(target_rmse), FIELD_OR_ZERO, 1e-6, 1, NULL, .doc = "sample until the predicted error of coverage is this",
      .absent = "as samples says", .label = "E", .when = {{ADAPTIVE}, {BY_CELLS}}, .alternative = HOW_MUCH},
     {"target_displayed", FIELD_NUMBER, MEMBER(target_displayed), FIELD_OR_ZERO, 1e-5, 1, NULL,
      .doc = "sample until the predicted error of the displayed luminance, 0 to 1, is this", .absent = "as samples says", .label = "E",
      .when = {{ADAPTIVE}, {BY_CELLS}}, .alternative = HOW_MUCH},
     {"budget_ms", FIELD_NUMBER, MEMBER(budget_ms), FIELD_OR_ZERO, 0.1, 1e7, "ms",
      .doc = "sample until a frame has taken so long; the pixels then depend on the machine", .absent = "as samples says", .label = "T",
      .when = {{ADAPTIVE}, {BY_CELLS}}, .alternative = HOW_MUCH},
     {"importance_center", FIELD_NUMBER, MEMBER(importance_center), 0, 0, 1, NULL, .doc = "coverage that is most important", .absent = "0.1", .label = "C",
      .when = {{ADAPTIVE}, {ALONG}}},
     {"importance_width", FIELD_NUMBER, MEMBER(importance_width), FIELD_OR_ZERO, 1e-6, 1, NULL, .doc = "deviation of the importance", .absent = "0.04",
      .label = "R", .when = {{ADAPTIVE}, {ALONG}}},
     {"importance_threshold", FIELD_NUMBER, MEMBER(importance_threshold), 0, 0, 1, NULL, .doc = "importance below which no samples are taken", .absent = "0.05",
      .label = "V", .when = {{ADAPTIVE}, {ALONG}}},
     {"slots", FIELD_LARGE, MEMBER(sample_slots), FIELD_OR_ZERO, 1, 4294967296.0, NULL, .doc = "samples of the whole picture", .absent = "as samples says",
      .member = "sample_slots", .label = "M", .when = {{ADAPTIVE}, {ALONG}}, .alternative = HOW_MUCH},
     {"refraction", FIELD_CHOICE, MEMBER(refraction), FIELD_OBJECTS, .doc = "how objects behind the surface are found", .choices = refraction_names,
      .aliases = refraction_aliases, .label = "NAME"},
     {"tess_error", FIELD_NUMBER, MEMBER(tess_error), FIELD_OBJECTS | FIELD_OR_ZERO, 0.01, 100, "pixels", .doc = "how far off a bent triangle may be",
      .absent = "0.1", .label = "PX", .when = {{BENDING}}},
     {"refraction_samples", FIELD_COUNT, MEMBER(refraction_samples), FIELD_OBJECTS | FIELD_OR_ZERO, 1, 64, NULL, .doc = "N of N x N refracted rays a pixel",
      .absent = "1 ray, 4 more at outlines of two-phase, and 4 x 4 for path-traced"},
     {"caustics", FIELD_SWITCH, MEMBER(caustics), FIELD_OBJECTS, .doc = "light that the waves focus on what lies under them", .choices = switch_words},
#define MGT_METHOD_OPTION(name, method_, least, most, preset_, meaning) \
    {#name, FIELD_NUMBER, MEMBER(name), 0, least, most, NULL, .doc = #meaning, .preset = preset_, .when = {{"method", ONE(method_)}}},
#include "mangata/method_options.h"
     {0}};
static_assert(sizeof quality_fields / sizeof *quality_fields == QUALITY_ROWS + 1, "QUALITY_ROWS");

const field_row post_fields[] = {{"exposure_ev", FIELD_NUMBER, offsetof(mgt_post, exposure_ev), 0, EXPOSURE_RANGE,
                                  .doc = "exposure, or added to the automatic one"},
                                 POST_ROWS(mgt_post),
                                 {0}};

static void reset(const field_row *field, void *values)
{
    void *value = (char *)values + field->offset;
    const double preset = field->preset;
    if (field->type == FIELD_COUNT)
        *(uint32_t *)value = (uint32_t)preset;
    else if (field->type == FIELD_CHOICE)
        *(int *)value = (int)preset;
    else if (field->type == FIELD_NUMBER)
        *(double *)value = preset;
    else if (field->type == FIELD_FLOAT)
        *(float *)value = (float)preset;
    else
        memset(value, 0, field_size(field));
}

mgt_quality quality_defaults(void)
{
    mgt_quality q;
    memset(&q, 0, sizeof q);
    for (const field_row *field = quality_fields; field->key; field++)
        reset(field, &q);
    return q;
}

bool option_is_set(const field_row *field, const mgt_quality *quality)
{
    mgt_quality defaults = *quality;
    reset(field, &defaults);
    return memcmp(field_at(field, quality), field_at(field, &defaults), field_size(field)) != 0;
}

mgt_quality quality_restricted(const mgt_quality *quality)
{
    mgt_quality q = *quality;
    for (const field_row *field = quality_fields; field->key; field++)
        if (!field_applies(quality_fields, field, &q, false))
            reset(field, &q);
    return q;
}

void quality_write(FILE *stream, const mgt_quality *q, const char *format)
{
    static const char *const apart[] = {"method", "spatial", "time_samples", "sample_first", "sample_count", "seed"};
    for (const field_row *field = quality_fields; field->key; field++) {
        bool written = option_is_set(field, q);
        for (size_t i = 0; i < sizeof apart / sizeof *apart; i++)
            written &= strcmp(field->key, apart[i]) != 0;
        if (written)
            fprintf(stream, format, field->key, field_print(field, field_at(field, q)).text);
    }
}

/* Whether two alternatives are set, or for a choice, whether two were chosen, even as defaults. */
static bool find_conflict(const mgt_quality *quality, const quality_choice *choice, char *wrong, size_t size)
{
    const field_row *first = NULL;
    for (const field_row *field = quality_fields; field->key; field++) {
        if (!field->alternative || !(choice ? quality_is_chosen(choice, field) : option_is_set(field, quality)))
            continue;
        if (first && first->alternative == field->alternative) {
            const char *const form = "%s and %s exclude each other: each says how much to sample";
            if (choice)
                snprintf(wrong, size, form, option_flag_of(first).text, option_flag_of(field).text);
            else
                snprintf(wrong, size, form, first->key, field->key);
            return true;
        }
        first = field;
    }
    return false;
}

bool quality_conflict(const mgt_quality *quality, char *wrong, size_t size) { return find_conflict(quality, NULL, wrong, size); }

/* ---- choices ------------------------------------------------------------------------------------------------- */

quality_choice quality_choice_none(void) { return (quality_choice){.values = quality_defaults()}; }

static uint64_t bit_of(const field_row *field) { return ONE(field - quality_fields); }

bool quality_is_chosen(const quality_choice *choice, const field_row *field) { return choice->rows & bit_of(field); }

/* Resets an option whose value is the default in words, so that one picture has one hash. */
static void simplify(const field_row *field, void *values)
{
    double number, written;
    if (field->absent && number_read(field->absent, &number) && number_read(field_print(field, field_at(field, values)).text, &written) && written == number)
        reset(field, values);
}

bool quality_choose(quality_choice *choice, const field_row *field, const char *text)
{
    mgt_quality *q = &choice->values;
    if (field == quality_fields) {
        mgt_quality method = *q;
        if (!method_from_name(text, &method))
            return false;
        q->method = method.method;
        if (!quality_is_chosen(choice, field_find(quality_fields, "spatial", 7)))
            q->spatial_samples = method.spatial_samples;
        if (!quality_is_chosen(choice, field_find(quality_fields, "time_samples", 12)))
            q->time_samples = method.time_samples;
    } else if (!field_parse(field, text, (char *)q + field->offset)) {
        return false;
    }
    choice->rows |= bit_of(field);
    return true;
}

bool quality_choose_name(quality_choice *choice, const field_row *field, bool alias, char *wrong, size_t size)
{
    const uint64_t bit = bit_of(field);
    if (choice->rows & bit && alias != ((choice->aliased & bit) != 0))
        return snprintf(wrong, size, "%s is the new name of %s; allowed is one of them", option_flag_alias(field).text, option_flag_of(field).text), false;
    choice->aliased = alias ? choice->aliased | bit : choice->aliased & ~bit;
    return true;
}

void quality_drop_alternatives(const field_row *field, mgt_quality *q)
{
    for (const field_row *other = quality_fields; other->key; other++)
        if (field->alternative && other != field && other->alternative == field->alternative)
            reset(other, q);
}

static option_flag flag_of(const char *key)
{
    option_flag flag;
    snprintf(flag.text, sizeof flag.text, "--%s", key);
    for (char *p = flag.text; *p; p++)
        if (*p == '_')
            *p = '-';
    return flag;
}

option_flag option_flag_of(const field_row *field) { return flag_of(field->key); }
option_flag option_flag_alias(const field_row *field) { return flag_of(field->alias); }

bool quality_apply(const quality_choice *choice, const mgt_quality *base, mgt_quality *out, char *wrong, size_t size)
{
    mgt_quality q = *base;
    char words[160];
    if (find_conflict(NULL, choice, wrong, size))
        return false;
    if (quality_is_chosen(choice, quality_fields)) {
        q.spatial_samples = choice->values.spatial_samples;
        q.time_samples = choice->values.time_samples;
    }
    for (const field_row *field = quality_fields; field->key; field++)
        if (quality_is_chosen(choice, field)) {
            quality_drop_alternatives(field, &q);
            memcpy((char *)&q + field->offset, field_at(field, &choice->values), field_size(field));
        }
    for (const field_row *field = quality_fields; field->key; field++)
        if (quality_is_chosen(choice, field) && !field_applies(quality_fields, field, &q, false)) {
            field_conditions(quality_fields, field, words, sizeof words);
            const option_flag flag = choice->aliased & bit_of(field) ? option_flag_alias(field) : option_flag_of(field);
            snprintf(wrong, size, "%s: it is for %s alone", flag.text, words);
            return false;
        }
    for (const field_row *field = quality_fields; field->key; field++)
        simplify(field, &q);
    *out = quality_restricted(&q);
    /* Methods that take no numbers of samples have one sample in records and hashes. */
    if (!field_applies(quality_fields, field_find(quality_fields, "spatial", 7), out, false))
        out->spatial_samples = out->time_samples = 1;
    return true;
}
