/* SPDX-License-Identifier: MIT
 *
 * Twelve wavelengths that carry visible light through the atmosphere, and their way back to linear sRGB.
 *
 * A spectrum is given at nodes 390, 420 … 720 nm and is linear between them. Colours are relative to sunlight outside the
 * atmosphere: a spectrum of ones (nothing absorbed) has the colour (1, 1, 1).
 */
#ifndef MANGATA_FRAME_SPECTRUM_H
#define MANGATA_FRAME_SPECTRUM_H

#define SPECTRUM_BANDS 12
#define SPECTRUM_FIRST 390.0
#define SPECTRUM_STEP 30.0

/* weight[c][band]: share of band in channel c; each channel's weights sum to 1. */
typedef struct spectrum_weights {
    double weight[3][SPECTRUM_BANDS];
} spectrum_weights;

spectrum_weights spectrum_weights_make(void);

/* Relative spectrum → linear sRGB for a light of colour `light`; colours outside the gamut are drawn towards grey of the
 * same luminance until no channel is negative. */
void spectrum_to_rgb(const spectrum_weights *weights, const double spectrum[SPECTRUM_BANDS], const double light[3], double rgb[3]);

/* Ozone absorption cross-section at about 225 K, m² (Chappuis band; after Gorshelev et al. 2014, smoothed). */
double spectrum_ozone(double nanometres);

/* Luminance (Rec. 709) of a linear sRGB colour. */
double spectrum_luminance(const double rgb[3]);

/* e^x by the same operations on every machine; within 1e-15 relative for |x| < 700, 0 below. */
double spectrum_exp(double x);

#endif
