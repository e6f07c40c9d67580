/* SPDX-License-Identifier: MIT */
/* Pictures and metrics behind the public header. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/struct_size.h"
#include "image/metrics_clip.h"
#include "io/io_error.h"
#include "io/plain_numbers.h"

mgt_io_status mgt_io_picture_read(mgt_io_picture *picture, const char *path, const char *layer, mgt_io_error *error)
{
    float_image image;
    file_error problem;
    const bool fits = picture && picture->struct_size >= sizeof *picture;
    if (fits) {
        picture->pixels = NULL;
        picture->width = picture->height = picture->channels = 0;
    }
    if (!fits || !path)
        return io_error_take(error, MGT_IO_ARGUMENT, "a pointer or picture.struct_size is missing");
    const plain_numbers numbers = plain_numbers_begin();
    const file_status status = picture_read(&image, path, layer, &problem);
    plain_numbers_end(numbers);
    if (status != FILE_OK)
        return io_error_of_file(error, &problem, path);
    picture->width = image.width;
    picture->height = image.height;
    picture->channels = image.channels;
    picture->pixels = image.pixels;
    return MGT_IO_OK;
}

void mgt_io_picture_free(mgt_io_picture *picture)
{
    if (!picture)
        return;
    float_image_free(&(float_image){.pixels = picture->pixels});
    picture->pixels = NULL;
}

void mgt_metrics_desc_init(mgt_metrics_desc *desc, size_t size)
{
    if (desc && struct_size_fits(size, sizeof desc->struct_size, sizeof *desc)) {
        memset(desc, 0, size);
        desc->struct_size = size;
    }
}

const char *mgt_metric_name(uint32_t metric) { return metric < CLIP_METRICS ? clip_metric_name((clip_metric)metric) : NULL; }

static mgt_io_status read_desc(clip_metrics_desc *out, const mgt_metrics_desc *desc, mgt_io_error *error)
{
    *out = (clip_metrics_desc){.width = desc->width,
                               .height = desc->height,
                               .channels = desc->channels,
                               .metrics = CLIP_ALL_METRICS & ~(1u << CLIP_YEE),
                               .srgb_encoded = desc->srgb_encoded,
                               .pixels_per_degree = desc->pixels_per_degree};
    if (desc->metrics && !clip_metrics_parse(desc->metrics, &out->metrics)) {
        char text[512];
        snprintf(text, sizeof text, "metrics %.200s: allowed are %s", desc->metrics, clip_metric_words);
        return io_error_take(error, MGT_IO_ARGUMENT, text);
    }
    return MGT_IO_OK;
}

static bool has_map(uint32_t metric)
{
    for (int i = 0; i < CLIP_MAPPED; i++)
        if (clip_mapped[i] == (clip_metric)metric)
            return true;
    return false;
}

/* The pixels are only read. */
static float_image image_of(const mgt_metrics_desc *desc, const float *pixels)
{
    return (float_image){.width = desc->width, .height = desc->height, .channels = desc->channels, .pixels = (float *)pixels};
}

mgt_io_status mgt_metrics_measure(const mgt_metrics_desc *desc, const float *const *a, const float *const *b, size_t frames, double *scores,
                                  uint32_t map_metric, float *map, mgt_io_error *error)
{
    clip_metrics_desc d;
    clip_metrics *metrics = NULL;
    file_error problem;
    clip_scores result;
    clip_maps maps = {{0}};
    if (!desc || !struct_size_fits(desc->struct_size, sizeof *desc, sizeof *desc) || !a || !b || !scores || frames == 0 || (map && map_metric >= CLIP_METRICS))
        return io_error_take(error, MGT_IO_ARGUMENT, "a pointer is missing, or there is no frame or no such metric");
    if (map && !has_map(map_metric)) {
        char text[120];
        snprintf(text, sizeof text, "metric %s has no map; allowed is " CLIP_MAPPED_WORDS, mgt_metric_name(map_metric));
        return io_error_take(error, MGT_IO_ARGUMENT, text);
    }
    const mgt_io_status status = read_desc(&d, desc, error);
    if (status != MGT_IO_OK)
        return status;
    if (map) {
        d.metrics |= 1u << map_metric;
        maps.maps[map_metric] = map;
    }
    file_status code = clip_metrics_create(&metrics, &d, &problem);
    for (size_t i = 0; i < frames && code == FILE_OK; i++) {
        const float_image of_a = image_of(desc, a[i]), of_b = image_of(desc, b[i]);
        code = of_a.pixels && of_b.pixels ? clip_metrics_add(metrics, &of_a, &of_b, map && i + 1 == frames ? &maps : NULL, NULL, &problem)
                                          : file_error_set(&problem, FILE_ARGUMENT, "the pixels of a frame are missing");
    }
    if (code == FILE_OK)
        code = clip_metrics_scores(metrics, &result, &problem);
    const bool comparable = code == FILE_OK && clip_metrics_sums(metrics)->mismatches == 0;
    clip_metrics_free(metrics);
    if (code != FILE_OK)
        return io_error_of_file(error, &problem, NULL);
    for (int m = 0; m < CLIP_METRICS; m++)
        scores[m] = comparable && d.metrics & 1u << m ? result.values[m] : NAN;
    return MGT_IO_OK;
}
