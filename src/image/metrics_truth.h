/* SPDX-License-Identifier: MIT */
/* Metrics against the truth behind two references: texture, specks, and errors without the references' noise. Private to src/image, cli and their tests. */
#ifndef MANGATA_IMAGE_METRICS_TRUTH_H
#define MANGATA_IMAGE_METRICS_TRUTH_H

#include "image/metrics_noise.h"
#include "image/metrics_texture.h"

/* The metrics of this file that a list asks for. */
typedef struct truth_words {
    bool texture, specks;
} truth_words;

/* Reads a list of --metrics. Words of this file set *words, those of metrics_clip.h the set *clip. False: a word is unknown, and nothing changes. */
bool truth_words_parse(const char *list, truth_words *words, uint32_t *clip);
/* The words that this file adds, for messages. */
extern const char truth_words_text[];

/* Metrics, which start zeroed except for the first two members. The size follows from the first frame. One thread at a time may use an object. */
typedef struct truth_metrics {
    truth_words wants;
    bool srgb_encoded;                /* values are sRGB-encoded; false: linear */
    uint32_t width, height, channels; /* those of the first frame */
    float *luminance[3];              /* linear luminance of A, B and the second reference; NULL: neither texture nor specks are wanted */
    texture *bands;                   /* NULL: texture is not wanted */
    noise_sums noise;                 /* zeroed without a second reference */
    bool has_second;                  /* a frame had a second reference */
    uint64_t mismatches;              /* number of values that are not comparable; above 0 texture and specks are not defined */
    uint64_t pixels;                  /* number of pixels in which specks were searched, over all frames */
    uint64_t specks;                  /* number of specks of A against B */
    uint64_t reference_specks[2];     /* number of specks of B against the second reference, and of that against B */
} truth_metrics;

/* The pictures of a frame, of one size: A, B and, if there is one, the second reference. */
typedef struct truth_frame {
    const float_image *images;
    size_t count;        /* 2 or 3 */
    const bool *counted; /* one per pixel, false: it is left out; NULL: no pixel is left out */
    uint64_t left_out;   /* number of pixels that are left out */
} truth_frame;

/* Adds a frame. Texture needs three pictures. Returns FILE_OK, FILE_ARGUMENT if sizes differ or channels are neither 1 nor 3, or FILE_MEMORY. */
file_status truth_metrics_add(truth_metrics *metrics, const truth_frame *frame, file_error *error);

/* Specks: `share` and other shares are fractions of the pixels in which they were searched. `excess` is the number of A's specks minus the references', which
 * is the mean of both directions; 0 without a second reference. */
typedef struct speck_figures {
    double share, reference_count, reference_share, excess, excess_share;
} speck_figures;

speck_figures truth_metrics_specks(const truth_metrics *metrics);

/* Why there are no scores of texture, or no count of specks; NULL: there are some. */
const char *truth_metrics_texture_missing(const truth_metrics *metrics);
const char *truth_metrics_specks_missing(const truth_metrics *metrics);

/* Frees the members and zeroes the struct. */
void truth_metrics_free(truth_metrics *metrics);

#endif
