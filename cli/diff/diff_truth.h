/* SPDX-License-Identifier: MIT */
/* Texture, specks and errors without the reference's noise, as `mangata diff` reports them. */
#ifndef MANGATA_CLI_DIFF_DIFF_TRUTH_H
#define MANGATA_CLI_DIFF_DIFF_TRUTH_H

#include <jansson.h>

#include "cli/diff/diff_prepare.h"
#include "image/metrics_truth.h"

/* Adds a frame of two or three pictures. Texture needs three. Returns an exit code; errors are printed. */
int diff_truth_add(truth_metrics *truth, const diff_frame *frame);

/* Adds the results to the report. Returns an exit code; errors are printed. */
int diff_truth_report(const truth_metrics *truth, json_t *report);

/* Prints the results as lines of text. */
void diff_truth_print(const truth_metrics *truth);

#endif
