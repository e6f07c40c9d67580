/* SPDX-License-Identifier: MIT
 *
 * The options of quality, one row each, and what concerns several of them at once.
 */
#ifndef MANGATA_PARAMS_OPTIONS_H
#define MANGATA_PARAMS_OPTIONS_H

#include "mangata/mangata.h"
#include "params/field.h"
#include "params/names.h"

/* Rows of an mgt_quality, ended by one without a key. A flag of the command line is a key with dashes. */
extern const field_row quality_fields[];
enum {
    QUALITY_ROWS = 25
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) +1
#include "mangata/method_options.h"
};

/* Rows of what mgt_post and the scene format have in common, for a struct with members of these names. */
#define POST_ROWS(type)                                                                                                              \
    {"tone_map", FIELD_CHOICE, offsetof(type, tone_map), .doc = "how radiance becomes displayed colour", .choices = tone_map_names}, \
    {                                                                                                                                \
        "glare", FIELD_FLOAT, offsetof(type, glare), 0, 0, 1, NULL, .doc = "fraction of the light that the eye scatters"             \
    }
#define EXPOSURE_RANGE -60, 60, "stops"

/* Rows of an mgt_post. */
extern const field_row post_fields[];

mgt_quality quality_defaults(void);

/* Whether an option is not at its default. */
bool option_is_set(const field_row *field, const mgt_quality *quality);

/* Options whose conditions do not hold go back to their defaults: for a base whose method is chosen elsewhere. */
mgt_quality quality_restricted(const mgt_quality *quality);

/* Options that somebody chose, apart from the defaults of all others. */
typedef struct quality_choice {
    mgt_quality values;
    uint64_t rows;    /* one bit each, by place in quality_fields */
    uint64_t aliased; /* those of them that were given by their alias */
} quality_choice;

quality_choice quality_choice_none(void);

/* Reads an option. False, with nothing changed, where the value is not allowed. */
bool quality_choose(quality_choice *choice, const field_row *field, const char *text);
bool quality_is_chosen(const quality_choice *choice, const field_row *field);

/* Notes by which of its names an option is given next. False, with one line in `wrong`, where it was given by the other one. */
bool quality_choose_name(quality_choice *choice, const field_row *field, bool alias, char *wrong, size_t size);

/* `base` with what was chosen in its place; what the method then does not take goes back to its default. False, with one line in `wrong`, where
 * a chosen option does not apply, or where chosen ones exclude each other. */
bool quality_apply(const quality_choice *choice, const mgt_quality *base, mgt_quality *out, char *wrong, size_t size);

/* Puts the alternatives of an option back to their defaults. */
void quality_drop_alternatives(const field_row *field, mgt_quality *q);

/* A key as a flag of the command line: "--time-samples". */
typedef struct option_flag {
    char text[40];
} option_flag;
option_flag option_flag_of(const field_row *field);
option_flag option_flag_alias(const field_row *field); /* the field has one */

/* Key and value, by `format`, of each option that is not at its default, but for method, samples and seed. For hashes and metadata. */
void quality_write(FILE *stream, const mgt_quality *q, const char *format) __attribute__((format(printf, 3, 0)));

/* What is wrong with options together: "samples and target_rmse exclude each other". False: nothing is. */
bool quality_conflict(const mgt_quality *quality, char *wrong, size_t size);

#endif
