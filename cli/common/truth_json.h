/* SPDX-License-Identifier: MIT */
/* Texture and specks as the JSON of `mangata diff` and `mangata compare`. */
#ifndef MANGATA_CLI_COMMON_TRUTH_JSON_H
#define MANGATA_CLI_COMMON_TRUTH_JSON_H

#include <jansson.h>

#include "image/metrics_truth.h"

/* New objects; NULL when memory runs out. docs/command.md describes them. What is not defined is null, and a texture without bands is. */
json_t *truth_texture_json(const truth_metrics *metrics);
json_t *truth_specks_json(const truth_metrics *metrics);

#endif
