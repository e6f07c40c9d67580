/* SPDX-License-Identifier: MIT */
/* The results of a comparison as JSON, CSV and LaTeX. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_TABLES_H
#define MANGATA_CLI_COMPARE_COMPARE_TABLES_H

#include "cli/compare/compare_job.h"

/* Everything that was asked and measured; NULL when memory runs out. docs/compare.md describes it. */
json_t *compare_result_json(const compare_job *job);

/* Whole files; the caller frees them, NULL when memory runs out. */
char *compare_json_text(const compare_job *job, size_t *size);
char *compare_csv_text(const compare_job *job, size_t *size);
char *compare_tex_text(const compare_job *job, size_t *size);

/* What the gate is held against: the score over all scenes as one clip. */
double compare_gate_value(const compare_job *job, const compare_gate *gate);

/* Samples a pixel that the method shades. */
uint64_t compare_samples(const mgt_quality *quality);

#endif
