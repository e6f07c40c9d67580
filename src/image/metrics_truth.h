/* SPDX-License-Identifier: MIT */
/* What pictures show of the truth's own texture and noise: texture, specks, and errors freed of the references' noise. Private to src/image, cli
 * and their tests. */
#ifndef MANGATA_IMAGE_METRICS_TRUTH_H
#define MANGATA_IMAGE_METRICS_TRUTH_H

#include "image/metrics_noise.h"
#include "image/metrics_texture.h"

/* The metrics of this file that a list asks for. */
typedef struct truth_words {
    bool texture, specks;
} truth_words;

/* Takes a list of --metrics: words of this file into *words, those of clips (metrics_clip.h) into the set *clip. False when a word is unknown; then
 * nothing is changed. */
bool truth_words_parse(const char *list, truth_words *words, uint32_t *clip);
/* The words that this file adds, for messages. */
extern const char truth_words_text[];

/* Start from all zero, then fill the first two members; the size comes with the first frame. One thread at a time may use an object. */
typedef struct truth_metrics {
    truth_words wants;
    bool srgb_encoded;                /* the values; false: linear */
    uint32_t width, height, channels; /* of the first frame */
    float *luminance[3];              /* linear, of A, B and the second reference; NULL unless texture or specks are wanted */
    texture *bands;                   /* NULL unless texture is wanted */
    noise_sums noise;                 /* empty without a second reference */
    bool has_second;                  /* a frame had a second reference */
    uint64_t pixels;                  /* that were looked at for specks, over all frames */
    uint64_t specks;                  /* of A against B */
    uint64_t reference_specks[2];     /* of B against the second reference, and the other way round */
} truth_metrics;

/* The pictures of a frame: A, B and, where there is one, the second reference, of one size. */
typedef struct truth_frame {
    const float_image *images;
    size_t count;        /* 2 or 3 */
    const bool *counted; /* one a pixel, false leaves it out; NULL: all count */
    uint64_t left_out;   /* pixels that do not count */
} truth_frame;

/* Adds a frame; texture needs three pictures. FILE_ARGUMENT for unlike sizes and for other than 1 or 3 channels, FILE_MEMORY. */
file_status truth_metrics_add(truth_metrics *metrics, const truth_frame *frame, file_error *error);

/* Of the pixels looked at. The excess is what stands out of A beyond what the references show of each other (the mean of both ways): 0 without a
 * second reference. */
typedef struct speck_figures {
    double share, reference_count, reference_share, excess, excess_share;
} speck_figures;

speck_figures truth_metrics_specks(const truth_metrics *metrics);

/* Why there is no texture to tell of; NULL where there is some. */
const char *truth_metrics_texture_missing(const truth_metrics *metrics);

/* Frees what it holds and clears it. */
void truth_metrics_free(truth_metrics *metrics);

#endif
