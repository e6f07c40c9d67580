/* SPDX-License-Identifier: MIT */
/* Films, frame by frame: our own y4m stream, or frames passed to ffmpeg; see video.h. */
#define _POSIX_C_SOURCE 200809L

#include "image/video.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/encoder_process.h"
#include "image/frame_rate.h"
#include "image/paired_output.h"
#include "image/picture_formats.h"
#include "image/yuv.h"

struct video_writer {
    picture_format format;
    uint32_t width, height;
    yuv_layout layout;
    uint8_t *planes; /* one converted frame */
    uint64_t frames;
    char *path;
    paired_output output;
    encoder_process *encoder; /* mp4 only */
};

static const char *const codec_names[] = {"default", "h264", "hevc", "prores"};

const char *video_codec_name(video_codec codec) { return codec_names[codec]; }

bool video_codec_from_name(const char *name, video_codec *codec)
{
    for (int i = VIDEO_CODEC_H264; i <= VIDEO_CODEC_PRORES; i++)
        if (strcmp(name, codec_names[i]) == 0)
            return *codec = (video_codec)i, true;
    return false;
}

static file_status check_desc(const char *path, const video_desc *desc, picture_format format, file_error *error)
{
    if (format != PICTURE_MP4 && format != PICTURE_MOV && format != PICTURE_Y4M)
        return file_error_set(error, FILE_ARGUMENT, "%s: a film's name must end in .mp4, .mov or .y4m", path);
    if (desc->codec == VIDEO_CODEC_PRORES && format != PICTURE_MOV)
        return file_error_set(error, FILE_ARGUMENT, "%s: ProRes goes into .mov", path);
    if (desc->crf < 0 || desc->crf > VIDEO_CRF_MOST)
        return file_error_set(error, FILE_ARGUMENT, "%s: crf %d is not within 0 and %d", path, desc->crf, (int)VIDEO_CRF_MOST);
    if (!(desc->frames_per_second >= 0.01 && desc->frames_per_second <= 1000.0))
        return file_error_set(error, FILE_ARGUMENT, "%s: %g frames per second are not within 0.01 and 1000", path, desc->frames_per_second);
    if (format != PICTURE_Y4M && (desc->width > 16384 || desc->height > 16384))
        return file_error_set(error, FILE_ARGUMENT, "%s: encoders take sides up to 16384, not %ux%u", path, desc->width, desc->height);
    return picture_check_size(path, desc->width, desc->height, error);
}

static file_status write_y4m_header(video_writer *writer, frame_rate rate, file_error *error)
{
    char header[160];
    int length = snprintf(header, sizeof header, "YUV4MPEG2 W%u H%u F%u:%u Ip A1:1 %s XCOLORRANGE=LIMITED\n", writer->width, writer->height, rate.numerator,
                          rate.denominator, writer->layout.full_chroma ? "C444" : "C420mpeg2 XYSCSS=420MPEG2");
    return output_file_write(writer->output.file, header, (size_t)length, error);
}

file_status video_writer_open(video_writer **result, const char *path, const video_desc *desc, file_error *error)
{
    *result = NULL;
    picture_format format = picture_format_of(path);
    file_status status = check_desc(path, desc, format, error);
    if (status != FILE_OK)
        return status;
    video_writer *writer = calloc(1, sizeof *writer);
    if (!writer)
        return file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
    writer->format = format;
    writer->width = desc->width;
    writer->height = desc->height;
    /* 4:2:0 H.264 has even sides. */
    uint32_t odd = format != PICTURE_Y4M ? 1 : 0;
    const video_codec codec = desc->codec != VIDEO_CODEC_DEFAULT ? desc->codec : format == PICTURE_MOV ? VIDEO_CODEC_PRORES : VIDEO_CODEC_H264;
    const bool full_chroma = format == PICTURE_Y4M ? desc->full_chroma : codec == VIDEO_CODEC_PRORES;
    writer->layout = yuv_layout_of(desc->width + (desc->width & odd), desc->height + (desc->height & odd), full_chroma);
    writer->planes = malloc(writer->layout.bytes);
    writer->path = strdup(path);
    if (!writer->planes || !writer->path) {
        status = file_error_errno(error, FILE_MEMORY, path, NULL, ENOMEM);
        goto fail;
    }
    status = paired_output_open(&writer->output, path, desc->metadata, &desc->output, error);
    if (status != FILE_OK)
        goto fail;
    frame_rate rate = frame_rate_of(desc->frames_per_second);
    if (format == PICTURE_Y4M) {
        status = write_y4m_header(writer, rate, error);
    } else {
        encoder_desc encoder = {.width = writer->layout.width,
                                .height = writer->layout.height,
                                .codec = codec,
                                .crf = desc->crf,
                                .rate_numerator = rate.numerator,
                                .rate_denominator = rate.denominator,
                                .metadata = desc->metadata,
                                .path = writer->path,
                                .file = writer->output.file};
        status = encoder_process_start(&writer->encoder, &encoder, error);
    }
    if (status != FILE_OK)
        goto fail;
    *result = writer;
    return FILE_OK;

fail:
    video_writer_abort(writer);
    return status;
}

file_status video_writer_frame(video_writer *writer, const uint8_t *rgba, ptrdiff_t row_stride, file_error *error)
{
    static const char mark[] = "FRAME\n";
    file_status status = FILE_OK;
    yuv_from_rgba(writer->planes, &writer->layout, rgba, row_stride, writer->width, writer->height);
    if (writer->format != PICTURE_Y4M) {
        status = encoder_process_write(writer->encoder, writer->planes, writer->layout.bytes, error);
    } else {
        status = output_file_write(writer->output.file, mark, sizeof mark - 1, error);
        if (status == FILE_OK)
            status = output_file_write(writer->output.file, writer->planes, writer->layout.bytes, error);
    }
    writer->frames += status == FILE_OK;
    return status;
}

file_status video_writer_finish(video_writer *writer, file_error *error)
{
    file_status status = FILE_OK;
    if (writer->frames == 0) {
        status = file_error_set(error, FILE_ARGUMENT, "%s: a film needs at least one frame", writer->path);
        goto fail;
    }
    if (writer->encoder) {
        status = encoder_process_finish(writer->encoder, error);
        writer->encoder = NULL;
        if (status == FILE_OK)
            status = encoder_check_mp4(output_file_descriptor(writer->output.file), writer->path, error);
    }
    if (status == FILE_OK)
        status = paired_output_finish(&writer->output, error);

fail:
    video_writer_abort(writer);
    return status;
}

void video_writer_abort(video_writer *writer)
{
    if (!writer)
        return;
    encoder_process_abort(writer->encoder);
    paired_output_abort(&writer->output);
    free(writer->planes);
    free(writer->path);
    free(writer);
}
