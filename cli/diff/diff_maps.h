/* SPDX-License-Identifier: MIT */
/* The pictures that `mangata diff --error-map` writes. They show the error of each pixel by a metric. */
#ifndef MANGATA_CLI_DIFF_DIFF_MAPS_H
#define MANGATA_CLI_DIFF_DIFF_MAPS_H

#include "cli/common/console.h"
#include "cli/common/frames.h"
#include "cli/common/options.h"
#include "image/metrics_clip.h"

/* The pictures that are read: A, B, the second reference and the mask. */
enum { DIFF_INPUTS = 4 };

/* The map of one metric. */
typedef struct diff_map {
    const char *path; /* as given; NULL: no map of this metric */
    frame_path name;
    picture_format format;
} diff_map;

/* All maps. It must be all zero at first. */
typedef struct diff_maps {
    bool wanted, overwrite;
    double top; /* error of the brightest colour of a .png file; 0: 1. It does not apply to FLIP, HDR-FLIP and SSIM, where it is 1 */
    diff_map maps[CLIP_METRICS];
    clip_maps pixels; /* errors of the last frame measured; owned */
    json_t *files;    /* [{"metric", "frame", "file"}]; NULL before the first */
} diff_maps;

/* Reads --error-map METRIC=FILE. `place` is a diff_maps. */
option_set option_error_map;

/* The set of metrics that have a map: bits 1u << clip_metric. */
uint32_t diff_maps_metrics(const diff_maps *maps);

/* Checks the names of the maps: they have numbers if `numbered`, no two are one file, none is a file of `inputs` (NULL: none), however it is spelt, and none
 * exists without --overwrite. Returns an exit code; errors are printed. */
int diff_maps_check(const diff_maps *maps, bool numbered, const frame_list *frames, const frame_path *const inputs[DIFF_INPUTS]);

/* Whether some map shows errors without a greatest value in colours, which --error-top is for. */
bool diff_maps_show_top(const diff_maps *maps);

/* Allocates the maps for pictures of `pixels` pixels. They are kept from frame to frame. Returns an exit code; errors are printed. */
int diff_maps_prepare(diff_maps *maps, size_t pixels);

/* Writes the maps of a frame that has been measured. Returns an exit code; errors are printed. */
int diff_maps_write(diff_maps *maps, uint32_t frame, uint32_t width, uint32_t height, const clip_scores *scores);

void diff_maps_free(diff_maps *maps);

#endif
