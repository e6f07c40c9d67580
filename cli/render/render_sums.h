/* SPDX-License-Identifier: MIT */
/* Frames as sums of samples: of samples that this run renders, with checkpoints, or of parts that other runs have written. Functions that return int print
 * their errors and return an exit code. */
#ifndef MANGATA_CLI_RENDER_RENDER_SUMS_H
#define MANGATA_CLI_RENDER_RENDER_SUMS_H

#include "cli/render/render_job.h"

/* Whether frames of this request are made of sums. */
bool render_sums_wanted(const render_request *request);

/* Checks that the options fit sums. `scene` is that of any frame. The request's quality must be set. */
int render_sums_check(const render_request *request, const mgt_scene *scene);

/* Allocates the sums of a frame. */
int render_sums_create(render_job *job);

/* Checks the parts of a frame of a merge before anything is written, and fills job->ranges from them. Each part must belong to the frame, and no two may have a
 * sample in common. A picture needs all samples. */
int render_sums_plan(render_job *job, uint32_t frame);

/* Whether job->ranges holds all samples of a pixel. */
bool render_sums_complete(const render_job *job);

/* Fills the sums of a frame and job->ranges, with the same checks. `path` is that of the output. The checkpoint is the file beside it. */
int render_sums_fill(render_job *job, uint32_t frame, const mgt_scene *scene, const char *path);

/* Writes the sums of the frame to a file. `record` is the metadata of any output; it gets those of sums, too. */
file_status render_sums_write(render_job *job, uint32_t frame, const char *path, render_record *record, const output_options *output, file_error *error);

/* Checks before anything is rendered that the checkpoint of an output, if there is one, is that of this frame. */
int render_sums_check_checkpoint(render_job *job, uint32_t frame, const char *path);

/* Removes the checkpoint of an output that is complete. Without --checkpoint only one of this very frame is removed, which an earlier run left. */
void render_sums_done(const render_job *job, uint32_t frame, const char *path);

#endif
