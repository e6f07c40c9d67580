/* SPDX-License-Identifier: MIT
 *
 * The water at an instant as a sum of sines of phases that grow evenly, for those who ask at points.
 */
#ifndef MANGATA_FRAME_WATER_TERMS_H
#define MANGATA_FRAME_WATER_TERMS_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* With t = along_x·x + along_z·z + start turns: height Σ up·sin t, slope Σ lean·cos t, its speed upwards Σ rise·cos t. */
typedef struct water_terms {
    int count;
    double along_x[MGT_MAX_WAVES], along_z[MGT_MAX_WAVES]; /* turns per metre */
    double start[MGT_MAX_WAVES];                           /* turns, within ±1/2 */
    double up[MGT_MAX_WAVES];                              /* metres */
    double lean_x[MGT_MAX_WAVES], lean_z[MGT_MAX_WAVES];
    double rise[MGT_MAX_WAVES]; /* metres per second */

    /* Of choppy water, whose terms stand in order of size: at a place of rest it is shifted by Σ shift·cos t, which grows by Σ drift·sin t a second, and its
     * derivative is −Σ press·sin t. */
    bool choppy;
    bool folds;                                            /* it is pressed so hard that it may fold */
    double shift_x[MGT_MAX_WAVES], shift_z[MGT_MAX_WAVES]; /* metres */
    double drift_x[MGT_MAX_WAVES], drift_z[MGT_MAX_WAVES]; /* metres per second */
    double press_xx[MGT_MAX_WAVES], press_xz[MGT_MAX_WAVES], press_zz[MGT_MAX_WAVES];
    double sum;      /* metres: of all heights */
    double pressed;  /* of all derivatives of the shift */
    double straight; /* metres over which the slopes change little */

    struct {
        float along_x, along_z, radians_x, radians_z, up, lean_x, lean_z, rise, shift_x, shift_z, drift_x, drift_z, press_xx, press_xz, press_zz;
    } single[MGT_MAX_WAVES]; /* the same in single precision */
} water_terms;

/* Fills the terms of waves that are at least `least` metres long, and the covariance (xx, xz, zz) of the slopes of all others. */
void water_terms_at(const mgt_water *water, double time, double least, water_terms *terms, double covariance[3]);

#endif
