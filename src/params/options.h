/* SPDX-License-Identifier: MIT
 *
 * Rows of the options of quality, and functions on several options at once.
 */
#ifndef MANGATA_PARAMS_OPTIONS_H
#define MANGATA_PARAMS_OPTIONS_H

#include "mangata/mangata.h"
#include "params/field.h"
#include "params/names.h"

/* Rows of an mgt_quality, the last one without a key. A flag of the command line is the key with dashes. */
extern const field_row quality_fields[];
enum {
    QUALITY_ROWS = 25
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) +1
#include "mangata/method_options.h"
};

/* Rows that mgt_post and the scene format have in common, for a struct with members of these names. */
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

/* A copy in which options whose conditions do not hold have their defaults. */
mgt_quality quality_restricted(const mgt_quality *quality);

/* Options that a user has chosen. Chosen defaults differ from options that were not chosen. */
typedef struct quality_choice {
    mgt_quality values;
    uint64_t rows;    /* bit i: the row quality_fields[i] was chosen */
    uint64_t aliased; /* bit i: it was given by its alias */
} quality_choice;

quality_choice quality_choice_none(void);

/* Chooses an option by the text of its value. False: the value is not allowed, and nothing changes. */
bool quality_choose(quality_choice *choice, const field_row *field, const char *text);
bool quality_is_chosen(const quality_choice *choice, const field_row *field);

/* Records by which of its names the next value of an option is given. False: the option was already given by its other name, and `wrong` holds one line. */
bool quality_choose_name(quality_choice *choice, const field_row *field, bool alias, char *wrong, size_t size);

/* Sets *out to `base` with the chosen options. Options that do not apply to its method get their defaults. False: a chosen option does not apply, or chosen
 * options exclude each other, and `wrong` holds one line. */
bool quality_apply(const quality_choice *choice, const mgt_quality *base, mgt_quality *out, char *wrong, size_t size);

/* Resets the alternatives of an option to their defaults. */
void quality_drop_alternatives(const field_row *field, mgt_quality *q);

/* A key as a flag of the command line: "--time-samples". */
typedef struct option_flag {
    char text[40];
} option_flag;
option_flag option_flag_of(const field_row *field);
option_flag option_flag_alias(const field_row *field); /* the field must have an alias */

/* Prints key and value by `format` for each option that is not at its default, except for method, samples and seed. For hashes and metadata. */
void quality_write(FILE *stream, const mgt_quality *q, const char *format) __attribute__((format(printf, 3, 0)));

/* Whether options exclude each other. If so, `wrong` holds one line: "samples and target_rmse exclude each other". */
bool quality_conflict(const mgt_quality *quality, char *wrong, size_t size);

#endif
