/* SPDX-License-Identifier: MIT
 * Method adaptive, scheme podee: Podee et al., Adaptive Supersampling for Rendering Reflections on Water Surfaces, as published
 * (docs/adaptive.md). */
#ifndef MANGATA_CPU_ADAPTIVE_PODEE_H
#define MANGATA_CPU_ADAPTIVE_PODEE_H

#include "cpu/adaptive.h"
#include "frame/podee_rules.h"

/* `out` holds colour, coverage and water of the approximate picture. The samples are blended into these planes, and all other planes but depth are filled.
 * Returns MGT_OK, MGT_CANCELLED or MGT_ERROR_MEMORY. */
mgt_status adaptive_podee_render(const adaptive_frame *a, const picture_planes *out);

/* ---- the equations, for tests ---- */

/* M, the number of slots: quality.sample_slots, or else the samples per pixel times `water`, the number of pixels of water; at least 1. */
uint64_t podee_slots_of(const mgt_quality *quality, double water);

/* Importance of a pixel, Eq. 1, scaled to 1 at its peak. */
float podee_importance(const podee_rules *rules, float coverage);

/* Eq. 2, corrected: place of slot k of `slots` in a prefix sum that ends at `sum`. */
double podee_slot_place(uint64_t k, uint64_t slots, double sum);

/* The first slot whose place is `place` or beyond; `slots`: there is none. */
uint64_t podee_first_slot(double place, uint64_t slots, double sum);

/* The last of `count` tasks whose exclusive prefix sum is at most `place`; the first task if there is none. */
size_t podee_task_at(const double *prefix, size_t count, double place);

/* Weight of a pixel's samples, Eq. 3. `samples` is M v/Σv. `frequency` is that of the finest wave, cycles per pixel. */
double podee_detail_weight(double samples, double frequency);

#endif
