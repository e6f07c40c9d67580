/* SPDX-License-Identifier: MIT */
/* The further metrics of `mangata diff --metrics`. */
#ifndef MANGATA_CLI_DIFF_DIFF_METRICS_H
#define MANGATA_CLI_DIFF_DIFF_METRICS_H

#include <jansson.h>

#include "cli/common/console.h"
#include "cli/diff/diff_maps.h"
#include "cli/diff/diff_prepare.h"
#include "image/metrics_clip.h"

/* Start from all zero, then fill `wanted`; size and channels come with the first frame. */
typedef struct diff_metrics {
    clip_metrics_desc wanted; /* wanted.metrics 0: nothing is measured */
    clip_metrics *clip;
    clip_metrics *noise; /* of B against the mean of B and the second reference; NULL without one */
    json_t *per_frame;
} diff_metrics;

/* Adds a frame of two pictures or three and writes its maps; an exit code, after a line on stderr where it is not 0. */
int diff_metrics_add(diff_metrics *metrics, uint32_t number, const diff_frame *frame, diff_maps *maps);

/* Adds "metrics", "per_frame" and, where there are any, "unavailable" and "noise_floors" to the report; takes per_frame. An exit code. */
int diff_metrics_report(diff_metrics *metrics, json_t *report);

/* Lines of text for what diff does not print anyway. An exit code. */
int diff_metrics_print(const diff_metrics *metrics);

void diff_metrics_free(diff_metrics *metrics);

#endif
