/* SPDX-License-Identifier: MIT */
/* Films: .mp4 and .mov through ffmpeg as a subprocess, .y4m by our own writer. Frames are streamed; the file appears when it is whole. */
#ifndef MANGATA_IMAGE_VIDEO_H
#define MANGATA_IMAGE_VIDEO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"

/* What a .mp4 or .mov holds; Y'CbCr by BT.709, tagged so. */
typedef enum video_codec {
    VIDEO_CODEC_DEFAULT = 0, /* H.264 in .mp4, ProRes in .mov */
    VIDEO_CODEC_H264,        /* 4:2:0, 8 bits */
    VIDEO_CODEC_HEVC,        /* 4:2:0, 10 bits */
    VIDEO_CODEC_PRORES       /* 422 HQ, 10 bits; .mov alone */
} video_codec;

#define VIDEO_CODEC_NAMES "h264, hevc or prores"
enum { VIDEO_CRF_DEFAULT = 16, VIDEO_CRF_MOST = 51 };

const char *video_codec_name(video_codec codec);
bool video_codec_from_name(const char *name, video_codec *codec); /* all but the default */

typedef struct video_desc {
    uint32_t width, height;        /* of the frames given; mp4 and mov pad odd sides by repeating the last column or row */
    double frames_per_second;      /* written as a fraction: 30 → 30/1, 29.97 → 30000/1001, else the nearest of thousandths */
    video_codec codec;             /* not of y4m */
    int crf;                       /* H.264, HEVC: 0 (best) to VIDEO_CRF_MOST */
    bool full_chroma;              /* y4m only: 4:4:4 instead of 4:2:0 */
    const metadata_list *metadata; /* NULL: none, and no sidecar. Read by video_writer_open only. mp4, mov: tags and PATH.json; y4m: PATH.json */
    output_options output;
} video_desc;

typedef struct video_writer video_writer;

/* Starts a film; the format is told by the extension (.mp4, .mov, .y4m). FILE_UNAVAILABLE: mp4 and mov without ffmpeg on the PATH.
 * On failure *writer is NULL and nothing is left behind. Installs no signal handler and needs none (SIGPIPE cannot arise). */
file_status video_writer_open(video_writer **writer, const char *path, const video_desc *desc, file_error *error);

/* Appends one frame: displayed colour (sRGB), four bytes a pixel, alpha ignored; `row_stride` bytes, negative allowed, 0: packed.
 * Blocks until the encoder has taken it. After a failure only abort is meaningful. */
file_status video_writer_frame(video_writer *writer, const uint8_t *rgba, ptrdiff_t row_stride, file_error *error);

/* Completes the film under its final name, then its sidecar. Frees the writer in every case; on failure, or without any frame (FILE_ARGUMENT),
 * nothing is left behind. */
file_status video_writer_finish(video_writer *writer, file_error *error);

/* Ends ffmpeg, removes the temporary file and frees the writer. NULL is allowed. */
void video_writer_abort(video_writer *writer);

#endif
