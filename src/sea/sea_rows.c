/* SPDX-License-Identifier: MIT
 *
 * Rows of an mgt_sea and of an mgt_swell.
 */
#include "sea/sea_rows.h"

#include "params/names.h"
#include "sea/sea.h"

#define NO_RANGE 0, 0

const field_row sea_rows[] = {{"spectrum", FIELD_CHOICE, offsetof(mgt_sea, spectrum), 0, NO_RANGE, NULL, .choices = spectrum_names},
                              {"spreading", FIELD_CHOICE, offsetof(mgt_sea, spreading), 0, NO_RANGE, NULL, .choices = spreading_names},
                              {"wind", FIELD_NUMBER, offsetof(mgt_sea, wind), FIELD_OR_ZERO, SEA_WIND, .unit = "m/s"},
                              {"wind_height", FIELD_NUMBER, offsetof(mgt_sea, wind_height), FIELD_OR_ZERO, SEA_WIND_HEIGHT, .unit = "m"},
                              {"direction_deg", FIELD_NUMBER, offsetof(mgt_sea, direction_deg), 0, SEA_DIRECTION, .unit = "degrees"},
                              {"fetch", FIELD_NUMBER, offsetof(mgt_sea, fetch), FIELD_OR_ZERO, SEA_FETCH, .unit = "m"},
                              {"depth", FIELD_NUMBER, offsetof(mgt_sea, depth), 0, SEA_DEPTH, .unit = "m"},
                              {"gamma", FIELD_NUMBER, offsetof(mgt_sea, gamma), 0, SEA_GAMMA, .unit = NULL},
                              {"spread", FIELD_NUMBER, offsetof(mgt_sea, spread), 0, SEA_SPREAD, .unit = NULL},
                              {"shortest", FIELD_NUMBER, offsetof(mgt_sea, shortest), FIELD_OR_ZERO, SEA_SHORTEST, .unit = "m"},
                              {"count", FIELD_COUNT, offsetof(mgt_sea, count), 0, 1, MGT_MAX_WAVES, .unit = NULL},
                              {"seed", FIELD_COUNT, offsetof(mgt_sea, seed), 0, 0, 4294967295, .unit = NULL},
                              {"cox_munk", FIELD_COUNT, offsetof(mgt_sea, cox_munk), 0, 0, 1, .unit = NULL},
                              {"choppiness", FIELD_FLOAT, offsetof(mgt_sea, choppiness), 0, 0, 1, .unit = NULL},
                              {"foam", FIELD_FLOAT, offsetof(mgt_sea, foam), 0, SEA_FOAM, .unit = NULL},
                              {"swell_count", FIELD_COUNT, offsetof(mgt_sea, swell_count), 0, 0, SEA_SWELLS, .unit = NULL},
                              {0}};

const field_row swell_rows[] = {{"height", FIELD_NUMBER, offsetof(mgt_swell, height), 0, SWELL_HEIGHT, .unit = "m"},
                                {"period", FIELD_NUMBER, offsetof(mgt_swell, period), 0, SWELL_PERIOD, .unit = "s"},
                                {"direction_deg", FIELD_NUMBER, offsetof(mgt_swell, direction_deg), 0, SEA_DIRECTION, .unit = "degrees"},
                                {"spread", FIELD_NUMBER, offsetof(mgt_swell, spread), 0, SEA_SPREAD, .unit = NULL},
                                {"count", FIELD_COUNT, offsetof(mgt_swell, count), 0, 1, MGT_MAX_WAVES, .unit = NULL},
                                {"seed", FIELD_COUNT, offsetof(mgt_swell, seed), 0, 0, 4294967295, .unit = NULL},
                                {0}};
