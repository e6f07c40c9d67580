/* SPDX-License-Identifier: MIT
 * Scheme podee of method adaptive: the numbers that the paper leaves to its user (docs/adaptive.md). */
#ifndef MANGATA_FRAME_PODEE_RULES_H
#define MANGATA_FRAME_PODEE_RULES_H

#include "mangata/mangata.h"

/* Options of scheme podee with their defaults filled in. */
typedef struct podee_rules {
    double center, width, threshold;
} podee_rules;

podee_rules podee_rules_of(const mgt_quality *quality);

/* Sample slots for each pixel of water, for scenes that give no number for the whole picture. */
double podee_samples_of(const mgt_quality *quality);

#endif
