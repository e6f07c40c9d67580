/* SPDX-License-Identifier: MIT
 *
 * Wavelengths, the standard observer and linear sRGB.
 */
#include "frame/spectrum.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/srgb_matrix.h"

/* Value of a table whose nodes lie `step` apart from `first`, linear between them, constant outside. */
static double table_at(const double *values, size_t count, double first, double step, double at)
{
    double x = (at - first) / step;
    if (!(x > 0.0)) {
        return values[0];
    }
    if (x >= (double)(count - 1)) {
        return values[count - 1];
    }
    size_t i = (size_t)x;
    return values[i] + (values[i + 1] - values[i]) * (x - (double)i);
}

/* Extraterrestrial solar spectrum, W/(m²·nm), linear between nodes 20 nm apart (ASTM E490, smoothed). */
static double sun_spectrum(double nanometres)
{
    static const double irradiance[] = {1.10, 1.60, 1.74, 1.82, 2.05, 2.04, 1.93, 1.85, 1.87,
                                        1.83, 1.80, 1.74, 1.68, 1.62, 1.54, 1.48, 1.42, 1.36}; /* 380 … 720 */
    return table_at(irradiance, sizeof irradiance / sizeof irradiance[0], 380.0, 20.0, nanometres);
}

double spectrum_ozone(double nanometres)
{
    static const double section[] = {0.00, 0.01, 0.03, 0.13, 0.35, 0.72, 1.22, 1.80, 2.85,
                                     3.90, 4.62, 5.05, 3.95, 2.90, 2.05, 1.40, 0.90, 0.55}; /* 380 … 720, 1e-25 m² */
    return 1e-25 * table_at(section, sizeof section / sizeof section[0], 380.0, 20.0, nanometres);
}

static double lobe(double nanometres, double centre, double below, double above)
{
    double x = (nanometres - centre) / (nanometres < centre ? below : above);
    return spectrum_exp(-0.5 * x * x);
}

/* CIE 1931 observer as sums of one-sided Gaussians: Wyman, Sloan, Shirley, JCGT 2(2), 2013, table 1. */
static void observer_xyz(double nm, double xyz[3])
{
    xyz[0] = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2);
    xyz[1] = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    xyz[2] = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
}

spectrum_weights spectrum_weights_make(void)
{
    spectrum_weights weights;
    memset(&weights, 0, sizeof weights);
    for (int nm = 360; nm <= 780; ++nm) {
        double xyz[3];
        observer_xyz(nm, xyz);
        double x = fmin(fmax((nm - SPECTRUM_FIRST) / SPECTRUM_STEP, 0.0), SPECTRUM_BANDS - 1.0);
        int band = x < SPECTRUM_BANDS - 2.0 ? (int)x : SPECTRUM_BANDS - 2;
        for (int c = 0; c < 3; ++c) {
            const double *m = srgb_from_xyz[c];
            double response = (m[0] * xyz[0] + m[1] * xyz[1] + m[2] * xyz[2]) * sun_spectrum(nm);
            weights.weight[c][band] += response * (1.0 - (x - band));
            weights.weight[c][band + 1] += response * (x - band);
        }
    }
    for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int band = 0; band < SPECTRUM_BANDS; ++band) {
            sum += weights.weight[c][band];
        }
        for (int band = 0; band < SPECTRUM_BANDS; ++band) {
            weights.weight[c][band] /= sum;
        }
    }
    return weights;
}

double spectrum_luminance(const double rgb[3]) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

void spectrum_to_rgb(const spectrum_weights *weights, const double spectrum[SPECTRUM_BANDS], const double light[3], double rgb[3])
{
    double lowest = 0.0;
    for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int band = 0; band < SPECTRUM_BANDS; ++band) {
            sum += weights->weight[c][band] * spectrum[band];
        }
        rgb[c] = sum * light[c];
        lowest = fmin(lowest, rgb[c]);
    }
    if (lowest < 0.0) {
        double grey = fmax(spectrum_luminance(rgb), 0.0);
        double keep = grey / (grey - lowest);
        for (int c = 0; c < 3; ++c) {
            rgb[c] = fmax(grey + (rgb[c] - grey) * keep, 0.0);
        }
    }
}

double spectrum_exp(double x)
{
    if (!(x > -700.0)) {
        return 0.0;
    }
    if (x > 700.0) {
        x = 700.0;
    }
    /* x = k·ln 2 + r, |r| ≤ ln 2 / 2; ln 2 in two parts so that k·high is exact. */
    double k = floor(x * 1.4426950408889634 + 0.5);
    double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
    double sum = 1.0 / 6227020800.0;
    static const double inverse_factorial[] = {1.0 / 479001600.0,
                                               1.0 / 39916800.0,
                                               1.0 / 3628800.0,
                                               1.0 / 362880.0,
                                               1.0 / 40320.0,
                                               1.0 / 5040.0,
                                               1.0 / 720.0,
                                               1.0 / 120.0,
                                               1.0 / 24.0,
                                               1.0 / 6.0,
                                               0.5,
                                               1.0,
                                               1.0};
    for (size_t i = 0; i < sizeof inverse_factorial / sizeof inverse_factorial[0]; ++i) {
        sum = sum * r + inverse_factorial[i];
    }
    uint64_t bits = (uint64_t)((int64_t)k + 1023) << 52; /* 2^k */
    double scale;
    memcpy(&scale, &bits, sizeof scale);
    return sum * scale;
}
