/* SPDX-License-Identifier: MIT */
/* What `mangata waves` says about a sea: closed forms beside what the spectrum and the waves have. */
#ifndef MANGATA_CLI_WAVES_REPORT_H
#define MANGATA_CLI_WAVES_REPORT_H

#include "cli/common/console.h"
#include "scene/scene_sea.h"

typedef struct waves_report {
    const scene_spectrum *settings;
    wave_spectrum spectrum;   /* its table is not looked at */
    double peak_period;       /* s */
    double longest, shortest; /* m, of the waves */
    size_t count;
    sea_statistics sea, waves; /* by quadrature, and of the sines */
    double height, slope;      /* closed forms; NAN where there is none */
    cox_munk clean;            /* Cox and Munk's sea in this wind; NAN for a buoy without one */
} waves_report;

/* Measures `sea` and the waves drawn from it. False when memory runs out. */
bool waves_report_make(waves_report *report, const scene_spectrum *settings, const scene_sea *sea, const mgt_wave *waves, size_t count);

/* As JSON with the written file's name, NULL: none; to be printed by the caller. */
json_t *waves_report_json(const waves_report *report, const char *path);

/* As some lines on stderr, unless --quiet. */
void waves_report_print(const waves_report *report, const console *out);

/* One line for a scene's description. */
typedef struct waves_title {
    char text[240];
} waves_title;
waves_title waves_report_title(const waves_report *report);

#endif
