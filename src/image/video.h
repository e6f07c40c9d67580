/* SPDX-License-Identifier: MIT */
/* Films: .mp4 and .mov by ffmpeg as a subprocess, .y4m by a writer of its own. Frames are streamed, and the file appears when it is whole. */
#ifndef MANGATA_IMAGE_VIDEO_H
#define MANGATA_IMAGE_VIDEO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"

/* Codec of a .mp4 or .mov. Frames are Y'CbCr by BT.709, and tagged so. */
typedef enum video_codec {
    VIDEO_CODEC_DEFAULT = 0, /* H.264 in .mp4, ProRes in .mov */
    VIDEO_CODEC_H264,        /* 4:2:0, 8 bits */
    VIDEO_CODEC_HEVC,        /* 4:2:0, 10 bits */
    VIDEO_CODEC_PRORES       /* 422 HQ, 10 bits; only in .mov */
} video_codec;

#define VIDEO_CODEC_NAMES "h264, hevc or prores"
enum { VIDEO_CRF_DEFAULT = 16, VIDEO_CRF_MOST = 51 };

const char *video_codec_name(video_codec codec);
bool video_codec_from_name(const char *name, video_codec *codec); /* VIDEO_CODEC_DEFAULT has no name */

typedef struct video_desc {
    uint32_t width, height;        /* size of the frames; mp4 and mov pad odd sides by repeating the last column or row */
    double frames_per_second;      /* written as frame_rate_of() */
    video_codec codec;             /* y4m ignores it */
    int crf;                       /* H.264, HEVC: 0 (best) to VIDEO_CRF_MOST */
    bool full_chroma;              /* only for y4m: 4:4:4 instead of 4:2:0 */
    const metadata_list *metadata; /* mp4 and mov: tags and PATH.json; y4m: PATH.json; NULL: neither. Only video_writer_open() reads it */
    output_options output;
} video_desc;

typedef struct video_writer video_writer;

/* Starts a film. The format follows from the extension: .mp4, .mov or .y4m. FILE_UNAVAILABLE: mp4 or mov without ffmpeg on the PATH. On failure *writer is NULL
 * and no file is left. It installs no signal handler and needs none, because SIGPIPE cannot arise. */
file_status video_writer_open(video_writer **writer, const char *path, const video_desc *desc, file_error *error);

/* Appends a frame of displayed colour (sRGB), four bytes per pixel; alpha is ignored. `row_stride`: as in picture_layer. Blocks until the encoder has taken the
 * frame. After a failure only video_writer_abort() may follow. */
file_status video_writer_frame(video_writer *writer, const uint8_t *rgba, ptrdiff_t row_stride, file_error *error);

/* Completes the film and its sidecar and gives them their names. Frees the writer in every case. On failure no file is left. FILE_ARGUMENT: there was no
 * frame. */
file_status video_writer_finish(video_writer *writer, file_error *error);

/* Ends ffmpeg, removes the temporary file and frees the writer. NULL is allowed. */
void video_writer_abort(video_writer *writer);

#endif
