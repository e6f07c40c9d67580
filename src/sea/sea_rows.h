/* SPDX-License-Identifier: MIT
 *
 * Rows of an mgt_sea and of an mgt_swell: the ranges of their members.
 */
#ifndef MANGATA_SEA_SEA_ROWS_H
#define MANGATA_SEA_SEA_ROWS_H

#include "mangata/waves.h"
#include "params/field.h"

extern const field_row sea_rows[];
extern const field_row swell_rows[];

#endif
