/* SPDX-License-Identifier: MIT
 *
 * Swell: waves that have left the wind that made them. Its spectrum is a narrow JONSWAP spectrum with a given height, period and direction.
 */
#ifndef MANGATA_SEA_SPECTRUM_SWELL_H
#define MANGATA_SEA_SPECTRUM_SWELL_H

#include "sea/spectrum_model.h"

/* Makes the spectrum of swell in deep water. `height`: significant wave height, m. `period`: of the peak, s. `direction_deg`: where it comes from; 0 is -z, 90
 * is +x. `spread`: s of cos^2s of half the angle. Frequencies are from a third to two and a half times that of the peak. False: out of memory. */
bool swell_spectrum_make(wave_spectrum *out, double height, double period, double direction_deg, double spread);

#endif
