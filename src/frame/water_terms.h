/* SPDX-License-Identifier: MIT
 *
 * The water at an instant as a sum of terms, for queries at points.
 */
#ifndef MANGATA_FRAME_WATER_TERMS_H
#define MANGATA_FRAME_WATER_TERMS_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* A wave's term. With t = along_x·x + along_z·z + start turns the water has the height Σ height·sin t, the slope Σ slope·cos t and the vertical
 * velocity Σ vertical_velocity·cos t. Choppy water at a place of rest is shifted by Σ shift·cos t. The shift grows by Σ shift_velocity·sin t a second. Its
 * spatial derivative is −Σ press·sin t. */
typedef struct water_term {
    double along_x, along_z; /* turns per metre */
    double start;            /* turns, within ±1/2 */
    double height;           /* metres */
    double slope_x, slope_z;
    double vertical_velocity; /* metres per second */
    /* The members from here to `single`, and `single` as far as it repeats them, are set for choppy water alone. */
    double shift_x, shift_z;                   /* metres */
    double shift_velocity_x, shift_velocity_z; /* metres per second */
    double press_xx, press_xz, press_zz;
    struct {
        float along_x, along_z, radians_x, radians_z, height, slope_x, slope_z, vertical_velocity, shift_x, shift_z, shift_velocity_x, shift_velocity_z;
        float press_xx, press_xz, press_zz;
    } single; /* the members in single precision; radians_x and radians_z are along_x and along_z in radians per metre */
} water_term;

typedef struct water_terms {
    bool choppy;     /* the water is choppy; the terms are then sorted by falling amplitude */
    bool folds;      /* the water is so steep that it may fold */
    double folded;   /* where the lesser eigenvalue of B = 1 + ∂shift/∂place is below this, other places may be shifted to the same point */
    double sum;      /* sum of the terms' amplitudes, metres */
    double pressed;  /* bound of the derivative of the shift, below 1 */
    double straight; /* distance over which the slopes change little, metres */
    int count;       /* number of terms */
    water_term *of;  /* the terms, in the caller's `room` */
} water_terms;

/* Makes the terms of waves that are at least `least` metres long, in `room`, which has space for all of the water's waves. `covariance` becomes the slope
 * covariance (xx, xz, zz) of the shorter waves. */
water_terms water_terms_at(const mgt_water *water, double time, double least, water_term *room, double covariance[3]);

#endif
