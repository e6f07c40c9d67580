/* SPDX-License-Identifier: MIT
 *
 * Settings and spectra of seas of wind and swell.
 */
#include "sea/sea.h"

#include "sea/spectrum_sample.h"

spectrum_settings sea_of_wind(double wind, double direction_deg, double fetch, double depth)
{
    return (spectrum_settings){.kind = SPECTRUM_ELFOUHAILY,
                               .wind = wind,
                               .wind_height = 10,
                               .fetch = fetch,
                               .depth = depth,
                               .direction_deg = direction_deg,
                               .slope = SLOPE_COX_MUNK};
}

bool sea_spectrum_make(wave_spectrum *out, const spectrum_settings *settings, const spectrum_table *table, spectrum_fault *fault)
{
    return wave_spectrum_make(out, settings, table, fault) &&
           (settings->slope != SLOPE_COX_MUNK || spectrum_bend_tail(out, cox_munk_slopes(wind_at_height(out->wind_10, 10, 12.5)), fault));
}

uint32_t swell_seed(uint32_t seed, size_t index) { return seed + 0x9e3779b9u * ((uint32_t)index + 1); }
