/* SPDX-License-Identifier: MIT */
/* How far a method's clip is from the reference's: frames go in one by one, scores of each frame and of the whole clip come out. */
#ifndef MANGATA_IMAGE_METRICS_CLIP_H
#define MANGATA_IMAGE_METRICS_CLIP_H

#include <stdbool.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/image_metrics.h"
#include "image/picture.h"

/* A: the method's frames, B: the reference's. P: a pixel's temporal power, the mean of (frame − frame before)² over the clip. 0 is best,
 * but for energy, SSIM and the flicker ratio, where 1 is. No flicker score rewards blur: whatever moves less than the reference is
 * charged like what moves more. */
typedef enum clip_metric {
    CLIP_RMSE,           /* √ mean (A − B)², values as given */
    CLIP_RELATIVE_RMSE,  /* RMSE / √ mean B² */
    CLIP_ENERGY,         /* mean A / mean B */
    CLIP_FLIP,           /* mean of FLIP over pixels and frames, 0 … 1; see metrics_flip.h */
    CLIP_HDR_FLIP,       /* mean of HDR-FLIP: the worst of FLIP over exposures; for scene-linear light */
    CLIP_SSIM,           /* mean structural similarity of sRGB-encoded luminance, −1 … 1; see metrics_ssim.h */
    CLIP_YEE,            /* share of pixels that fail Yee's perceptual test, 0 … 1; see metrics_yee.h */
    CLIP_FLICKER,        /* √ mean ((A[n] − A[n−1]) − (B[n] − B[n−1]))² */
    CLIP_FLICKER_POWER,  /* mean over pixels of |P(A) − P(B)|, in squared units of the values */
    CLIP_FLICKER_RATIO,  /* mean P(A) / mean P(B): below 1 too calm (blur), above 1 too restless */
    CLIP_FLICKER_BRIGHT, /* distance of the histograms over frames of how many pixels are bright; see metrics_flicker.h */
    CLIP_FLICKER_GLINTS, /* the same of how many glints (connected bright pixels) there are */
    CLIP_FLICKER_SIZES,  /* distance of the histograms of the glints' sizes */
    CLIP_METRICS
} clip_metric;

/* Sets of metrics: bits 1u << clip_metric. */
enum { CLIP_ALL_METRICS = (1u << CLIP_METRICS) - 1, CLIP_ALL_FLICKER = CLIP_ALL_METRICS & ~((1u << CLIP_FLICKER) - 1) };

/* "rmse", "relrmse", "energy", "flip", "hdr-flip", "ssim", "yee", "flicker", "flicker-power", … */
const char *clip_metric_name(clip_metric metric);
/* The set of a list such as "rmse,flip,flicker"; there "flicker" stands for all that begin with it. False when a word is unknown. */
bool clip_metrics_parse(const char *list, uint32_t *metrics);
/* The words that clip_metrics_parse() knows, for messages and helps. */
extern const char clip_metric_words[];

/* The metrics that have maps: those that clip_metrics_add() fills. */
enum { CLIP_MAPPED = 6 };
extern const clip_metric clip_mapped[CLIP_MAPPED];
#define CLIP_MAPPED_WORDS "rmse, relrmse, flip, hdr-flip, ssim or flicker"

typedef struct clip_metrics_desc {
    uint32_t width, height;
    uint32_t channels;                    /* 1 (coverage, grey light) or 3 (colour) */
    uint32_t metrics;                     /* set of what to measure; only that costs time and memory */
    bool srgb_encoded;                    /* the values are sRGB-encoded; false: linear. RMSE, energy and flicker take values as given; the others
                                 decode or encode as their definitions ask, with white at 1 */
    double pixels_per_degree;             /* of the viewer's eye, for FLIP, above 0; 0: 67.0206, a 0.7 m wide 4K screen at 0.7 m */
    double glint_threshold;               /* a pixel is bright when its linear luminance (coverage) is above this; 0: above half of what a thousandth of the
                                 pixels of the reference's first frame exceed, so that every method is judged alike */
    bool fixed_exposures;                 /* HDR-FLIP: take the range below; false: from each frame of the reference, as its paper says */
    double first_exposure, last_exposure; /* in stops */
    uint32_t exposures;                   /* HDR-FLIP: how many, 1 … 64; 0: one a stop, at least 2. Used with either range */
    const char *idiff;                    /* OpenImageIO's idiff; NULL: the one on the PATH. Borrowed as long as the metrics live */
} clip_metrics_desc;

/* Bounded memory: two frames, three sums a pixel, buffers of the filters, a few bytes a frame. One thread at a time may use an object;
 * different objects may be used at the same time. */
typedef struct clip_metrics clip_metrics;

/* FILE_ARGUMENT for meaningless values. A missing idiff is no error: its score is unavailable. On failure *metrics is NULL. */
file_status clip_metrics_create(clip_metrics **metrics, const clip_metrics_desc *desc, file_error *error);
void clip_metrics_free(clip_metrics *metrics);

/* Scores; NaN: not asked for, not defined (flicker of a first frame), or unavailable. */
typedef struct clip_scores {
    double values[CLIP_METRICS];
} clip_scores;

typedef struct clip_frame {
    clip_scores scores;            /* of this frame alone. Flicker: of the step from the frame before; counts of glints: |A − B| / max(B, 1) */
    uint32_t bright[2], glints[2]; /* of A, of B; 0 unless asked for */
} clip_frame;

/* Error maps wanted of one frame: width · height floats each, top row first, NULL: not wanted. Filled for RMSE (√ mean over channels of
 * squared differences), relative RMSE (the same over √(mean over channels of B² + (0.01 √ mean B² of the frame)²), or as it is where B is
 * black), FLIP, HDR-FLIP, SSIM (1 − SSIM) and flicker (as RMSE, of the steps; 0 in the first frame), where those are measured; others are
 * left alone. */
typedef struct clip_maps {
    float *maps[CLIP_METRICS];
} clip_maps;

/* Adds a frame; `maps` and `frame` may be NULL. FILE_ARGUMENT where sizes or channels are not those of the description, FILE_MEMORY;
 * nothing is added then. Values that are not finite count as mismatches (clip_metrics_sums) and stand as 0 in all but the sums. */
file_status clip_metrics_add(clip_metrics *metrics, const float_image *a, const float_image *b, const clip_maps *maps, clip_frame *frame, file_error *error);

/* The clip's scores over the frames added so far, one or more; may be asked at any time. FILE_MEMORY. */
file_status clip_metrics_scores(const clip_metrics *metrics, clip_scores *scores, file_error *error);

/* Why a metric asked for has no score (one line), or NULL where it has one. */
const char *clip_metrics_missing(const clip_metrics *metrics, clip_metric metric);

/* The value of a picture that is the reference: 1 of energy, SSIM and the flicker ratio, else 0. */
double clip_metric_best(clip_metric metric);

/* The noise floor of a reference that is the mean of two halves with independent noise, from metrics to which its first half was added as A and that
 * mean as B: the half is as far from the mean as the mean is from the truth, so the floor is the distance of each score from its best. Of RMSE it is
 * noise_sums_floor(). Of energy it is the standard deviation, √ Σ (A − B)² / |Σ B|, of values with independent noise, since one sum's own distance may
 * be 0 by chance. NaN where there is no score. FILE_MEMORY. */
file_status clip_metrics_noise(const clip_metrics *metrics, clip_scores *floors, file_error *error);

/* Sums, maximum and mismatches as `mangata diff` reports them; kept for every set of metrics. */
const image_metrics *clip_metrics_sums(const clip_metrics *metrics);

/* The threshold of glints in use; 0 before a first frame that has to tell it. */
double clip_metrics_glint_threshold(const clip_metrics *metrics);

#endif
