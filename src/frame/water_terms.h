/* SPDX-License-Identifier: MIT
 *
 * The water at an instant as a sum of sines of phases that grow evenly, for those who ask at points.
 */
#ifndef MANGATA_FRAME_WATER_TERMS_H
#define MANGATA_FRAME_WATER_TERMS_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* With t = along_x·x + along_z·z + start turns: height Σ up·sin t, slope Σ lean·cos t, its speed upwards Σ rise·cos t. */
typedef struct water_term {
    double along_x, along_z; /* turns per metre */
    double start;            /* turns, within ±1/2 */
    double up;               /* metres */
    double lean_x, lean_z;
    double rise; /* metres per second */
    /* Of choppy water, else not set: at a place of rest it is shifted by Σ shift·cos t, which grows by Σ drift·sin t a second, and its derivative is
     * −Σ press·sin t. */
    double shift_x, shift_z; /* metres */
    double drift_x, drift_z; /* metres per second */
    double press_xx, press_xz, press_zz;
    struct {
        float along_x, along_z, radians_x, radians_z, up, lean_x, lean_z, rise, shift_x, shift_z, drift_x, drift_z, press_xx, press_xz, press_zz;
    } single; /* the same in single precision */
} water_term;

typedef struct water_terms {
    bool choppy;     /* the terms stand in order of size */
    bool folds;      /* it is pressed so hard that it may fold */
    double sum;      /* metres: of all heights */
    double pressed;  /* of all derivatives of the shift */
    double straight; /* metres over which the slopes change little */
    int count;
    water_term *of;
} water_terms;

/* The terms of waves that are at least `least` metres long, in `room`, a place each of the water's waves, and the covariance (xx, xz, zz) of the slopes of all
 * others. */
water_terms water_terms_at(const mgt_water *water, double time, double least, water_term *room, double covariance[3]);

#endif
