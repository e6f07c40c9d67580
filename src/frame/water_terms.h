/* SPDX-License-Identifier: MIT
 *
 * The water at an instant as a sum of sines of phases that grow evenly, for those who ask at points.
 */
#ifndef MANGATA_FRAME_WATER_TERMS_H
#define MANGATA_FRAME_WATER_TERMS_H

#include "mangata/mangata.h"

/* With t = along_x·x + along_z·z + start turns: height Σ up·sin t, slope Σ lean·cos t, its speed upwards Σ rise·cos t. */
typedef struct water_terms {
    int count;
    double along_x[MGT_MAX_WAVES], along_z[MGT_MAX_WAVES]; /* turns per metre */
    double start[MGT_MAX_WAVES];                           /* turns, within ±1/2 */
    double up[MGT_MAX_WAVES];                              /* metres */
    double lean_x[MGT_MAX_WAVES], lean_z[MGT_MAX_WAVES];
    double rise[MGT_MAX_WAVES]; /* metres per second */
    struct {
        float up, lean_x, lean_z, rise;
    } single[MGT_MAX_WAVES]; /* the same in single precision */
} water_terms;

/* Fills the terms of waves that are at least `least` metres long, and the covariance (xx, xz, zz) of the slopes of all others. */
void water_terms_at(const mgt_water *water, double time, double least, water_terms *terms, double covariance[3]);

#endif
