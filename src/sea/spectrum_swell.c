/* SPDX-License-Identifier: MIT
 *
 * The spectrum of swell.
 */
#include "sea/spectrum_swell.h"

#include <math.h>

#include "sea/spectrum_math.h"
#include "sea/spectrum_sample.h"

/* Peak enhancement factor. Goda (1983) found 3 to 10 for swell that had crossed an ocean. */
static const double PEAKEDNESS = 7;

static const double LOWEST = 0.33, HIGHEST = 2.5; /* frequencies over that of the peak */

bool swell_spectrum_make(wave_spectrum *out, double height, double period, double direction_deg, double spread)
{
    const double half_turns = (direction_deg + 180) / 360, peak = 2 * SPECTRUM_PI / period;
    wave_spectrum s = {
        .kind = SPECTRUM_JONSWAP,
        .alpha = 1,
        .gamma = PEAKEDNESS,
        .peak = peak,
        .low = LOWEST * peak,
        .high = HIGHEST * peak,
        .tail_from = INFINITY,
        .bend_from = INFINITY,
        .directions = DIRECTIONS_FIXED,
        .spread = spread,
        .downwind = 2 * SPECTRUM_PI * (half_turns - floor(half_turns)),
    };
    sea_statistics unscaled;
    if (!spectrum_statistics(&s, &unscaled))
        return false;
    const double ratio = height / unscaled.height;
    s.alpha = ratio * ratio;
    *out = s;
    return true;
}
