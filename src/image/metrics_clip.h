/* SPDX-License-Identifier: MIT */
/* Scores of a method's clip against the reference's. Frames are added one by one, and scores are those of each frame and of the whole clip. */
#ifndef MANGATA_IMAGE_METRICS_CLIP_H
#define MANGATA_IMAGE_METRICS_CLIP_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/image_metrics.h"
#include "image/picture.h"

/* A are the method's frames, B the reference's. P is a pixel's temporal power: the mean over the clip of (frame − previous frame)². The best score is 0, and 1
 * for energy, SSIM and the flicker ratio. No flicker score rewards blur, because too little change counts like too much. */
typedef enum clip_metric {
    CLIP_RMSE,           /* √ mean (A − B)² of the values as they are */
    CLIP_RELATIVE_RMSE,  /* RMSE / √ mean B² */
    CLIP_ENERGY,         /* mean A / mean B */
    CLIP_FLIP,           /* mean of FLIP over pixels and frames, 0 … 1; see metrics_flip.h */
    CLIP_HDR_FLIP,       /* mean of HDR-FLIP, the greatest FLIP over exposures; for scene-linear light */
    CLIP_SSIM,           /* mean structural similarity of sRGB-encoded luminance, −1 … 1; see metrics_ssim.h */
    CLIP_YEE,            /* fraction of pixels that fail Yee's perceptual test, 0 … 1; see metrics_yee.h */
    CLIP_FLICKER,        /* √ mean ((A[n] − A[n−1]) − (B[n] − B[n−1]))² */
    CLIP_FLICKER_POWER,  /* mean over pixels of |P(A) − P(B)|, in squared units of the values */
    CLIP_FLICKER_RATIO,  /* mean P(A) / mean P(B); below 1: A changes too little (blur); above 1: too much */
    CLIP_FLICKER_BRIGHT, /* distance of the histograms over frames of the number of bright pixels; see metrics_flicker.h */
    CLIP_FLICKER_GLINTS, /* distance of the histograms over frames of the number of glints, which are connected bright pixels */
    CLIP_FLICKER_SIZES,  /* distance of the histograms of glint sizes */
    CLIP_METRICS
} clip_metric;

/* Sets of metrics: bits 1u << clip_metric. */
enum { CLIP_ALL_METRICS = (1u << CLIP_METRICS) - 1, CLIP_ALL_FLICKER = CLIP_ALL_METRICS & ~((1u << CLIP_FLICKER) - 1) };

/* Name of a metric: "rmse", "relrmse", "energy", "flip", "hdr-flip", "ssim", "yee", "flicker", "flicker-power", … */
const char *clip_metric_name(clip_metric metric);
/* Reads a list such as "rmse,flip,flicker", in which "flicker" stands for all metrics that begin with it. False: a word is unknown. */
bool clip_metrics_parse(const char *list, uint32_t *metrics);
/* The words that clip_metrics_parse() knows, for messages and help. */
extern const char clip_metric_words[];

/* The metrics for which clip_metrics_add() fills maps. */
enum { CLIP_MAPPED = 6 };
extern const clip_metric clip_mapped[CLIP_MAPPED];
#define CLIP_MAPPED_WORDS "rmse, relrmse, flip, hdr-flip, ssim or flicker"

typedef struct clip_metrics_desc {
    uint32_t width, height;
    uint32_t channels;        /* 1 for coverage or grey light, 3 for colour */
    uint32_t metrics;         /* set of the metrics that are measured; others cost neither time nor memory */
    bool srgb_encoded;        /* values are sRGB-encoded; false: linear. RMSE, energy and flicker use them as they are. Other metrics decode or encode them by
                                 their definitions, with white at 1 */
    double pixels_per_degree; /* FLIP: pixels per degree of the viewer's field of view; 0: 67.0206, a 0.7 m wide 4K screen at 0.7 m */
    double glint_threshold;   /* a pixel is bright if its linear luminance, or coverage, is above this; 0: half of the value that a thousandth of the pixels of
                                 the reference's first frame exceed, so that all methods have the same threshold */
    bool fixed_exposures;     /* HDR-FLIP: exposures have the range below; false: the range follows from each frame of the reference, as in the paper */
    double first_exposure, last_exposure; /* HDR-FLIP: that range, stops */
    uint32_t exposures;                   /* HDR-FLIP: number of exposures of either range, 1 … 64; 0: one per stop, at least 2 */
    const char *idiff;                    /* OpenImageIO's idiff; NULL: the one on the PATH. Borrowed for the life of the metrics */
} clip_metrics_desc;

/* Metrics of a clip. Memory is bounded: two frames, three sums per pixel, buffers of filters, and a few bytes per frame. One thread at a time may use an
 * object. */
typedef struct clip_metrics clip_metrics;

/* Creates metrics. FILE_ARGUMENT: a value has no meaning. A missing idiff is no error, but its score is unavailable. On failure *metrics is NULL. */
file_status clip_metrics_create(clip_metrics **metrics, const clip_metrics_desc *desc, file_error *error);
void clip_metrics_free(clip_metrics *metrics);

/* Scores by clip_metric; NaN: not wanted, not defined (flicker of a first frame), or unavailable. */
typedef struct clip_scores {
    double values[CLIP_METRICS];
} clip_scores;

typedef struct clip_frame {
    clip_scores scores;            /* scores of this frame alone. Flicker: of the step from the previous frame; counts of glints: |A − B| / max(B, 1) */
    uint32_t bright[2], glints[2]; /* numbers of bright pixels and glints of A and B; 0: not wanted */
} clip_frame;

/* Error maps of one frame by clip_metric: width · height floats each, top row first; NULL: not wanted. Maps of the metrics in clip_mapped that are measured are
 * filled, others are not. RMSE: √ mean over channels of squared differences. Relative RMSE: this divided by √(mean over channels of B² + (0.01 √ mean B² of the
 * frame)²), or undivided if B is black. SSIM: 1 − SSIM. Flicker: RMSE of the steps; 0 in the first frame. */
typedef struct clip_maps {
    float *maps[CLIP_METRICS];
} clip_maps;

/* Adds a frame. `maps` and `frame` may be NULL. FILE_ARGUMENT: sizes or channels are not those of the description. After this or FILE_MEMORY nothing was added.
 * RMSE, relative RMSE and energy are of the values that are finite in both pictures. All other metrics have no score (NaN) as soon as values are not
 * comparable (image_values_comparable()), and maps are NaN there; equal infinities stand as 0. */
file_status clip_metrics_add(clip_metrics *metrics, const float_image *a, const float_image *b, const clip_maps *maps, clip_frame *frame, file_error *error);

/* Pixels of the frames added from now on that a mask has made black in A and B. RMSE is the mean over the other pixels. */
void clip_metrics_leave_out(clip_metrics *metrics, uint64_t pixels);

/* Scores of the frames added so far, at least one. Returns FILE_OK or FILE_MEMORY. */
file_status clip_metrics_scores(const clip_metrics *metrics, clip_scores *scores, file_error *error);

/* One line on why a wanted metric has no score; NULL: it has one. */
const char *clip_metrics_missing(const clip_metrics *metrics, clip_metric metric);

/* Score of a clip that equals the reference: 1 for energy, SSIM and the flicker ratio, else 0. */
double clip_metric_best(clip_metric metric);

/* The noise floor of a reference that is the mean of two halves with independent noise. In `metrics` frames of the first half were added as A, and of the mean
 * as B. The half is as far from the mean as the mean is from the truth, so a floor is the distance of a score from its best value. For RMSE that is
 * noise_sums_floor(). For energy it is the standard deviation √ Σ (A − B)² / |Σ B| of values with independent noise, because the distance itself may be 0 by
 * chance. NaN: there is no score. Returns FILE_OK or FILE_MEMORY. */
file_status clip_metrics_noise(const clip_metrics *metrics, clip_scores *floors, file_error *error);

/* Sums, maximum and mismatches for `mangata diff`. They are kept for every set of metrics. */
const image_metrics *clip_metrics_sums(const clip_metrics *metrics);

/* The threshold of glints in use; 0: it will follow from the first frame. */
double clip_metrics_glint_threshold(const clip_metrics *metrics);

#endif
