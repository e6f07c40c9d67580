/* SPDX-License-Identifier: MIT */
/* ffmpeg as a subprocess that takes raw frames and writes one .mp4 or .mov. Private to src/image. */
#ifndef MANGATA_IMAGE_ENCODER_PROCESS_H
#define MANGATA_IMAGE_ENCODER_PROCESS_H

#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"
#include "image/video.h"

typedef struct encoder_process encoder_process;

typedef struct encoder_desc {
    uint32_t width, height; /* even numbers */
    video_codec codec;      /* not VIDEO_CODEC_DEFAULT; frames for ProRes have full chroma */
    int crf;
    uint32_t rate_numerator, rate_denominator;
    const metadata_list *metadata; /* NULL: no tags */
    const char *path;              /* final name, for messages; must outlive the process */
    const output_file *file;       /* ffmpeg writes to its temporary path; its cancel flag ends the process */
} encoder_desc;

/* Finds ffmpeg on the PATH and starts it without a shell. It gets a process group of its own, so that Ctrl-C does not reach it. */
file_status encoder_process_start(encoder_process **process, const encoder_desc *desc, file_error *error);

/* Passes bytes of frames to ffmpeg. Blocks until it has taken them. */
file_status encoder_process_write(encoder_process *process, const void *bytes, size_t size, file_error *error);

/* Ends the input, waits for ffmpeg and checks its exit code. Frees the process in every case. */
file_status encoder_process_finish(encoder_process *process, file_error *error);

/* Kills ffmpeg, waits for it and frees the process. NULL is allowed. */
void encoder_process_abort(encoder_process *process);

/* Checks that the file is a whole .mp4 with its index in front: boxes fill it exactly, and moov comes before mdat. */
file_status encoder_check_mp4(int descriptor, const char *path, file_error *error);

#endif
