/* SPDX-License-Identifier: MIT
 * Method adaptive, scheme podee: Podee et al., Adaptive Supersampling for Rendering Reflections on Water Surfaces, as published
 * (docs/adaptive.md). */
#ifndef MANGATA_CPU_ADAPTIVE_PODEE_H
#define MANGATA_CPU_ADAPTIVE_PODEE_H

#include "cpu/adaptive.h"
#include "frame/podee_rules.h"

/* `out` holds colour, coverage and water of the approximate picture; they become the blended ones, and the other planes but depth are
 * filled. MGT_ERROR_MEMORY where memory is short. */
mgt_status adaptive_podee_render(const adaptive_frame *a, const picture_planes *out);

/* ---- its parts ---- */

/* M: as many slots as asked for, or so many a pixel of `water` pixels; at least 1. */
uint64_t podee_slots_of(const mgt_quality *quality, double water);

/* Eq. 1, scaled to 1 at its peak. */
float podee_importance(const podee_rules *rules, float coverage);

/* Eq. 2 as it must be: where slot k of `slots` looks in a prefix sum that ends at `sum`. */
double podee_slot_place(uint64_t k, uint64_t slots, double sum);

/* The first slot that looks at `place` or beyond; `slots` where none does. */
uint64_t podee_first_slot(double place, uint64_t slots, double sum);

/* The last of `count` tasks whose exclusive prefix sum is at most `place`; the first one where none is. */
size_t podee_task_at(const double *prefix, size_t count, double place);

/* Eq. 3: `samples` is M v/Σv, `frequency` that of the finest wave, cycles per pixel. */
double podee_detail_weight(double samples, double frequency);

#endif
