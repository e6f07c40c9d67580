/* SPDX-License-Identifier: MIT */
/* The measures of `mangata diff` that look at the truth's own texture and noise: texture, specks, and errors freed of the references' noise. */
#ifndef MANGATA_CLI_DIFF_DIFF_TRUTH_H
#define MANGATA_CLI_DIFF_DIFF_TRUTH_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "cli/diff/diff_prepare.h"
#include "image/metrics_noise.h"
#include "image/metrics_texture.h"

/* Start from all zero, then fill the first three members; the size comes with the first frame. */
typedef struct diff_truth {
    bool wants_texture, wants_specks;
    bool srgb_encoded;                /* the values; false: linear */
    uint32_t width, height, channels; /* of the first frame */
    float *luminance[3];              /* linear, of A, B and the second reference; NULL unless texture or specks are wanted */
    texture *bands;                   /* NULL unless texture is wanted */
    noise_sums noise;                 /* empty without a second reference */
    bool has_second;                  /* a frame had a second reference */
    uint64_t pixels;                  /* that were looked at for specks, over all frames */
    uint64_t specks;                  /* of A against B */
    uint64_t reference_specks[2];     /* of B against the second reference, and the other way round */
} diff_truth;

/* Takes a list of --metrics: words of this file into *truth, those of clips into the set *clip. False when a word is unknown; then nothing is changed. */
bool diff_truth_parse(diff_truth *truth, const char *list, uint32_t *clip);
/* The words that this file adds, for messages. */
extern const char diff_truth_words[];

/* Adds a frame of two pictures or three; texture needs three. An exit code, after a line on stderr where it is not 0. */
int diff_truth_add(diff_truth *truth, const diff_frame *frame);

/* Adds what was measured to the report. An exit code. */
int diff_truth_report(const diff_truth *truth, json_t *report);

/* Prints what was measured as lines of text. */
void diff_truth_print(const diff_truth *truth);

void diff_truth_free(diff_truth *truth);

#endif
