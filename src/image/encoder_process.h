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
    uint32_t width, height; /* even */
    video_codec codec;      /* not the default; ProRes takes frames of full chroma */
    int crf;
    uint32_t rate_numerator, rate_denominator;
    const metadata_list *metadata; /* NULL: no tags */
    const char *path;              /* final name, for messages only; must outlive the process */
    const output_file *file;       /* ffmpeg writes its temporary path; its cancel flag is heeded */
} encoder_desc;

/* Finds ffmpeg on the PATH and starts it without a shell, in a process group of its own, so that Ctrl-C reaches us alone. */
file_status encoder_process_start(encoder_process **process, const encoder_desc *desc, file_error *error);

/* Passes bytes of frames; blocks until they are taken. */
file_status encoder_process_write(encoder_process *process, const void *bytes, size_t size, file_error *error);

/* Ends the input, waits for ffmpeg and checks that it said success. Frees the process in every case. */
file_status encoder_process_finish(encoder_process *process, file_error *error);

/* Kills ffmpeg, reaps it, frees the process. NULL is allowed. */
void encoder_process_abort(encoder_process *process);

/* Whether the file is a whole .mp4 with its index in front: boxes that fill it exactly, moov before mdat. */
file_status encoder_check_mp4(int descriptor, const char *path, file_error *error);

#endif
