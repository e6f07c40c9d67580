/* SPDX-License-Identifier: MIT */
/* Render hashes and metadata. */
#include "cli/render/render_record.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cli/common/memory_text.h"
#include "cli/common/numbers.h"
#include "params/methods.h"

static const char *format_word(picture_format format)
{
    switch (format) {
    case PICTURE_PNG:
        return "png";
    case PICTURE_EXR:
        return "exr";
    case PICTURE_PFM:
        return "pfm";
    case PICTURE_MP4:
        return "mp4";
    case PICTURE_MOV:
        return "mov";
    case PICTURE_Y4M:
        return "y4m";
    case PICTURE_SUMS:
        return "sums";
    case PICTURE_UNKNOWN:
        break;
    }
    return "unknown";
}

/* Name of the group of builds and devices whose results agree to the bit. */
static const char *arithmetic_word(const mgt_context_info *info)
{
    if (info->backend == MGT_BACKEND_GL)
        return info->renderer;
    if (info->backend != MGT_BACKEND_CPU)
        return mgt_backend_name(info->backend);
    return info->isa == MGT_ISA_SSE2 ? "cpu without fma" : "cpu";
}

/* Writes what a sample depends on, with the range of samples. */
static void write_head(FILE *stream, const mgt_quality *q, const char *canonical, const mgt_image *image, uint64_t first, uint64_t count)
{
    fprintf(stream, "mangata %s\n%s\n", mgt_version(), canonical);
    fprintf(stream, "crop %u %u %u %u\n", image->crop_x, image->crop_y, image->crop_width, image->crop_height);
    fprintf(stream, "method %s\nsamples %u %u %" PRIu64 " %" PRIu64 "\nseed %" PRIu64 "\nndf_mean_drop %d\n", method_name(q).text, q->spatial_samples,
            q->time_samples, first, count, q->seed, q->ndf_mean_drop);
    quality_write(stream, q, "option %s %s\n");
}

static bool finish_hash(FILE *stream, char **text, const size_t *size, sha256_text *hash)
{
    if (!memory_text_finish(stream, text))
        return false;
    *hash = sha256(*text, *size);
    free(*text);
    return true;
}

bool render_hash(const render_request *request, const char *canonical, const mgt_image *image, const mgt_context_info *info, const char *frames,
                 sha256_text *hash)
{
    const mgt_quality *q = &request->quality;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return false;
    write_head(stream, q, canonical, image, q->sample_first, q->sample_count);
    fprintf(stream, "arithmetic %s\nformat %s\nlayers", arithmetic_word(info), format_word(request->format));
    for (size_t i = 0; i < request->layer_count; i++)
        fprintf(stream, " %s", mgt_layer_name(request->layers[i]));
    /* A whole picture adds no line, so that its hash equals that of files without this line. */
    if (request->format == PICTURE_EXR) {
        if (image->crop_x || image->crop_y || image->crop_width != image->width || image->crop_height != image->height)
            fputs("\ncrop in its place", stream);
        exr_choice_write(stream, &request->exr);
    }
    if (request->format == PICTURE_MOV ||
        (request->format == PICTURE_MP4 && (request->film.codec != VIDEO_CODEC_H264 || request->film.crf != VIDEO_CRF_DEFAULT)))
        fprintf(stream, "\ncodec %s crf %d", video_codec_name(request->film.codec), request->film.crf);
    fprintf(stream, "\nframes %s\n", frames);
    return finish_hash(stream, &text, &size, hash);
}

bool sums_hash(const render_request *request, const char *canonical, const mgt_image *image, const mgt_context_info *info, const char *frame, sha256_text *hash)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return false;
    write_head(stream, &request->quality, canonical, image, 0, 0);
    fprintf(stream, "arithmetic %s\nsums of frame %s\n", arithmetic_word(info), frame);
    return finish_hash(stream, &text, &size, hash);
}

static void add(render_record *record, const char *key, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void add(render_record *record, const char *key, const char *format, ...)
{
    if (record->list.count == RECORD_ENTRIES)
        return;
    const size_t i = record->list.count++;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(record->values[i], RECORD_TEXT, format, arguments);
    va_end(arguments);
    record->entries[i] = (metadata_entry){key, record->values[i]};
}

static void add_stamp(render_record *record, const mgt_context_info *info, double seconds)
{
    char host[128] = "unknown", date[32] = "unknown";
    gethostname(host, sizeof host - 1);
    const time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc))
        strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    add(record, "host", "%s", host);
    add(record, "threads", "%u", info->threads);
    if (info->backend == MGT_BACKEND_GL)
        add(record, "renderer", "%s", info->renderer);
    else
        add(record, "isa", "%s", mgt_isa_name(info->isa));
    add(record, "rendered_at", "%s", date);
    if (seconds >= 0)
        add(record, "render_seconds", "%.6f", seconds);
}

static void add_options(render_record *record, const mgt_quality *q)
{
    char options[RECORD_TEXT] = "";
    FILE *stream = fmemopen(options, sizeof options, "w");
    if (stream) {
        quality_write(stream, q, "%s %s ");
        fclose(stream);
    }
    if (options[0])
        add(record, "method_options", "%.*s", (int)strlen(options) - 1, options);
}

void render_record_fill(render_record *record, const render_request *request, const mgt_context_info *info, const sha256_text *hash, const char *frames,
                        double time, double seconds)
{
    const mgt_quality *q = &request->quality;
    record->list = (metadata_list){record->entries, 0};
    add(record, "mangata_version", "%s", mgt_version());
    add(record, RENDER_HASH_KEY, "%s", hash->text);
    add(record, "method", "%s", method_name(q).text);
    add_options(record, q);
    if (q->refraction != MGT_REFRACTION_TWO_PHASE)
        add(record, "refraction", "%s", field_print(field_find(quality_fields, "refraction", 10), &q->refraction).text);
    add(record, render_is_film(request) ? "frames" : "frame", "%s", frames);
    add(record, "time", "%s", number_print(time).text);
    const uint64_t samples = quality_range(q) ? quality_range(q) : quality_pixel_samples(q);
    if (samples) /* else the pixels differ */
        add(record, "samples", "%" PRIu64, samples);
    if (q->sample_count)
        add(record, "samples_range", "%" PRIu64 ",%" PRIu64, q->sample_first, q->sample_count);
    add(record, "seed", "%" PRIu64, q->seed);
    if (request->stamp)
        add_stamp(record, info, seconds);
}

void render_record_add_exposure(render_record *record, double stops) { add(record, "exposure", "%s", number_print(stops).text); }

void render_record_fill_sums(render_record *record, const render_request *request, const mgt_image *image, const mgt_context_info *info,
                             const sha256_text *sums_hash, const char *frame)
{
    const mgt_quality *q = &request->quality;
    record->list = (metadata_list){record->entries, 0};
    add(record, "mangata_version", "%s", mgt_version());
    add(record, "method", "%s", method_name(q).text);
    add_options(record, q);
    if (strcmp(record->entries[record->list.count - 1].key, "method_options") != 0)
        add(record, "method_options", "none");
    add(record, "frame", "%s", frame);
    add(record, "samples", "%" PRIu64, quality_range(q));
    add(record, "seed", "%" PRIu64, q->seed);
    add(record, "size", "%ux%u", image->width, image->height);
    add(record, "crop", "%u,%u,%u,%u", image->crop_x, image->crop_y, image->crop_width, image->crop_height);
    add(record, "arithmetic", "%s", arithmetic_word(info));
    add(record, SUMS_HASH_KEY, "%s", sums_hash->text);
}

void render_record_add_sums(render_record *record, const render_record *sums)
{
    for (size_t i = 0; i < sums->list.count; i++) {
        size_t k = 0;
        while (k < record->list.count && strcmp(record->entries[k].key, sums->entries[i].key) != 0)
            k++;
        if (k == record->list.count)
            add(record, sums->entries[i].key, "%s", sums->values[i]);
    }
}
