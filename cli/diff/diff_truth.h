/* SPDX-License-Identifier: MIT */
/* Texture, specks and errors freed of noise, as `mangata diff` reports them. */
#ifndef MANGATA_CLI_DIFF_DIFF_TRUTH_H
#define MANGATA_CLI_DIFF_DIFF_TRUTH_H

#include <jansson.h>

#include "cli/diff/diff_prepare.h"
#include "image/metrics_truth.h"

/* Adds a frame of two pictures or three; texture needs three. An exit code, after a line on stderr where it is not 0. */
int diff_truth_add(truth_metrics *truth, const diff_frame *frame);

/* Adds what was measured to the report. An exit code. */
int diff_truth_report(const truth_metrics *truth, json_t *report);

/* Prints what was measured as lines of text. */
void diff_truth_print(const truth_metrics *truth);

#endif
