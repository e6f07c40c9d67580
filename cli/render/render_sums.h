/* SPDX-License-Identifier: MIT */
/* Frames as sums of samples: of this run's samples, with checkpoints, or of parts that other runs have written. Functions print errors and return exit codes. */
#ifndef MANGATA_CLI_RENDER_RENDER_SUMS_H
#define MANGATA_CLI_RENDER_RENDER_SUMS_H

#include "cli/render/render_job.h"

/* Whether frames of this request are made of sums, once its quality is known. */
bool render_sums_wanted(const render_request *request);

/* Says what cannot be asked for together. `scene`: of any frame. */
int render_sums_check(const render_request *request, const mgt_scene *scene);

/* Memory for the sums of a frame. */
int render_sums_create(render_job *job);

/* Of a merge, before anything is rendered: reads the heads of a frame's parts into job->ranges. Each must belong to the frame and share no sample with
 * another; a picture needs all samples. */
int render_sums_plan(render_job *job, uint32_t frame);

/* Whether the planned sums are of all samples of a pixel. */
bool render_sums_complete(const render_job *job);

/* Fills the sums of a frame and job->ranges, after the same checks. `path`: the output's, beside which a checkpoint stands. */
int render_sums_fill(render_job *job, uint32_t frame, const mgt_scene *scene, const char *path);

/* Writes the sums of the frame. `record`: what any output of it records; gets more. */
file_status render_sums_write(render_job *job, uint32_t frame, const char *path, render_record *record, const output_options *output, file_error *error);

/* Once the output stands: removes the checkpoint. */
void render_sums_done(const render_job *job, const char *path);

#endif
