/* SPDX-License-Identifier: MIT */
/* The report of `mangata waves` about a sea: values in closed form, of the spectrum, and of the waves. */
#ifndef MANGATA_CLI_WAVES_REPORT_H
#define MANGATA_CLI_WAVES_REPORT_H

#include "cli/common/console.h"
#include "scene/scene_sea.h"

typedef struct waves_report {
    const scene_spectrum *settings;
    wave_spectrum spectrum;    /* its table is not used */
    double peak_period;        /* s */
    double longest, shortest;  /* wavelengths, m */
    size_t count;              /* number of waves */
    sea_statistics sea, waves; /* of the spectrum, by quadrature, and of the waves */
    double height, slope;      /* significant height, m, and mean square slope in closed form; NAN: the spectrum has none */
    cox_munk clean;            /* Cox and Munk's slopes for this wind; NAN: a buoy's spectrum without a wind */
} waves_report;

/* Measures `sea` and the waves that were drawn from it. The report borrows `settings`. False: out of memory. */
bool waves_report_make(waves_report *report, const scene_spectrum *settings, const scene_sea *sea, const mgt_wave *waves, size_t count);

/* The report as JSON, which the caller prints. `path` is the file that was written; NULL: none. NULL: out of memory. */
json_t *waves_report_json(const waves_report *report, const char *path);

/* Prints the report as lines on stderr, unless --quiet is given. */
void waves_report_print(const waves_report *report, const console *out);

/* One line about the sea, for a scene's description. */
typedef struct waves_title {
    char text[320];
} waves_title;
waves_title waves_report_title(const waves_report *report);

#endif
