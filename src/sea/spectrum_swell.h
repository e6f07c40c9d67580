/* SPDX-License-Identifier: MIT
 *
 * Swell: waves that have left their wind. The narrow form of JONSWAP with a height, a period and a direction of its own.
 */
#ifndef MANGATA_SEA_SPECTRUM_SWELL_H
#define MANGATA_SEA_SPECTRUM_SWELL_H

#include "sea/spectrum_model.h"

/* A significant height in metres, a peak's period in seconds; where it comes from, 0 is -z, 90 is +x; s of cos^2s of half the angle. It has waves of a
 * third to two and a half times the peak's frequency, in deep water. False when memory runs out. */
bool swell_spectrum_make(wave_spectrum *out, double height, double period, double direction_deg, double spread);

#endif
