/* SPDX-License-Identifier: MIT
 * Spectra that must be good. */
#ifndef MANGATA_TESTS_UNIT_TEST_SPECTRUM_H
#define MANGATA_TESTS_UNIT_TEST_SPECTRUM_H

#include <math.h>

#include "sea/spectrum_sample.h"

static inline void assert_near(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.10g is not %.10g within %g", value, expected, relative);
}

static inline wave_spectrum make(const spectrum_settings *settings)
{
    wave_spectrum s;
    spectrum_fault fault = {0};
    if (!wave_spectrum_make(&s, settings, NULL, &fault))
        fail_msg("%s %s", fault.key, fault.text);
    return s;
}

static inline sea_statistics statistics(const wave_spectrum *s)
{
    sea_statistics result;
    assert_true(spectrum_statistics(s, &result));
    return result;
}

#endif
