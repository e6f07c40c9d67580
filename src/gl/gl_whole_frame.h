/* SPDX-License-Identifier: MIT
 * Functions that all methods over whole pictures use on the GPU. */
#ifndef MANGATA_GL_GL_WHOLE_FRAME_H
#define MANGATA_GL_GL_WHOLE_FRAME_H

#include "frame/whole_frame.h"
#include "gl/gl_renderer.h"

void gl_plain_frame_of(const frame *f, mgt_method method, gl_plain_frame *out);

/* The progress of one picture as a part of the frame's progress, which it takes from `first` to first + share. */
typedef struct gl_progress_part {
    mgt_progress_function tell;
    void *user;
    double first, share;
} gl_progress_part;

gl_progress_part gl_progress_part_of(const gl_job *job, double first, double share);

/* The same job for another frame, which reports its progress to `part`. `part` must outlive the job. */
gl_job gl_job_of_part(const gl_job *job, const frame *f, gl_progress_part *part);

#endif
