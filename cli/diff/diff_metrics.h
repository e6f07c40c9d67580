/* SPDX-License-Identifier: MIT */
/* The additional metrics of `mangata diff --metrics`. */
#ifndef MANGATA_CLI_DIFF_DIFF_METRICS_H
#define MANGATA_CLI_DIFF_DIFF_METRICS_H

#include <jansson.h>

#include "cli/common/console.h"
#include "cli/diff/diff_maps.h"
#include "cli/diff/diff_prepare.h"
#include "image/metrics_clip.h"

/* It must be all zero at first, with `wanted` filled in. The first frame sets size and channels. */
typedef struct diff_metrics {
    clip_metrics_desc wanted; /* wanted.metrics 0: nothing is measured */
    clip_metrics *clip;
    clip_metrics *noise; /* noise: B against the mean of B and the second reference; NULL: there is no second reference */
    json_t *per_frame;   /* the scores of each frame; NULL before the first one */
} diff_metrics;

/* Adds a frame of two or three pictures and writes its maps. Returns an exit code; errors are printed. */
int diff_metrics_add(diff_metrics *metrics, uint32_t number, const diff_frame *frame, diff_maps *maps);

/* Adds "metrics", "per_frame" and, if there are any, "unavailable" and "noise_floors" to the report. per_frame then belongs to the report. Returns an exit
 * code; errors are printed. */
int diff_metrics_report(diff_metrics *metrics, json_t *report);

/* The noise floor of a metric; NaN: it is not measured, or there is no second reference. */
double diff_metrics_floor(const diff_metrics *metrics, clip_metric metric);

/* Prints the scores as lines of text, except those that diff always prints. Returns an exit code; errors are printed. */
int diff_metrics_print(const diff_metrics *metrics);

void diff_metrics_free(diff_metrics *metrics);

#endif
