/* SPDX-License-Identifier: MIT */
/* Texture and specks as JSON, for `mangata diff` and `mangata compare`. */
#ifndef MANGATA_CLI_COMMON_TRUTH_JSON_H
#define MANGATA_CLI_COMMON_TRUTH_JSON_H

#include <jansson.h>

#include "image/metrics_truth.h"

/* New objects, which docs/command.md describes. Values that are not defined are null, and so is a texture without bands. NULL: out of memory. */
json_t *truth_texture_json(const truth_metrics *metrics);
json_t *truth_specks_json(const truth_metrics *metrics);

#endif
