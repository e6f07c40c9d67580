/* SPDX-License-Identifier: MIT */
/* The results of a comparison as JSON, CSV and LaTeX. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_TABLES_H
#define MANGATA_CLI_COMPARE_COMPARE_TABLES_H

#include "cli/compare/compare_job.h"

/* The request and all results, which docs/compare.md describes. NULL: out of memory. */
json_t *compare_result_json(const compare_job *job);

/* The contents of the files report.json, report.csv and report.tex. `size` gets their length. The caller frees them. NULL: out of memory. */
char *compare_json_text(const compare_job *job, size_t *size);
char *compare_csv_text(const compare_job *job, size_t *size);
char *compare_tex_text(const compare_job *job, size_t *size);

/* The score that a gate limits: that of all scenes as one clip. */
double compare_gate_value(const compare_job *job, const compare_gate *gate);

/* The product of the numbers of samples of a quality. */
uint64_t compare_samples(const mgt_quality *quality);

/* Samples of each pixel of a method on a scene, as in layer `samples`; NaN: the pixels differ, or are not known. */
double compare_method_samples(const compare_job *job, const compare_scene *scene, size_t method);

/* The numbers of samples a pixel of the scenes' references, such as "512" or "512 to 1024". */
number_text compare_reference_samples(const compare_job *job);

#endif
