/* SPDX-License-Identifier: MIT */
/* The pictures that `mangata diff --error-map` writes: the error of each pixel by a metric. */
#ifndef MANGATA_CLI_DIFF_DIFF_MAPS_H
#define MANGATA_CLI_DIFF_DIFF_MAPS_H

#include "cli/common/console.h"
#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "image/metrics_clip.h"

typedef struct diff_map {
    const char *path; /* as given; NULL: not wanted */
    frame_path name;
    picture_format format;
} diff_map;

/* Start from all zero. */
typedef struct diff_maps {
    bool wanted, overwrite;
    double top; /* what the brightest colour of a .png stands for, but for FLIP and SSIM, where it is 1; 0: 1 */
    diff_map maps[CLIP_METRICS];
    clip_maps pixels; /* of the frame last measured; owned */
    json_t *files;    /* [{"metric", "frame", "file"}]; NULL before the first */
} diff_maps;

/* --error-map METRIC=FILE; `place` is a diff_maps. */
option_set option_error_map;

/* The metrics whose maps are wanted, as a set. */
uint32_t diff_maps_metrics(const diff_maps *maps);

/* Refuses names that do not go with `numbered` frames, files that exist, and those of `inputs`, three paths or NULL. An exit code. */
int diff_maps_check(const diff_maps *maps, bool numbered, const frame_list *frames, const char *const inputs[3]);

/* Memory for pictures of so many pixels, kept from frame to frame. An exit code. */
int diff_maps_prepare(diff_maps *maps, size_t pixels);

/* Writes the files of a frame that has been measured. An exit code. */
int diff_maps_write(diff_maps *maps, uint32_t frame, uint32_t width, uint32_t height, const clip_scores *scores);

void diff_maps_free(diff_maps *maps);

#endif
