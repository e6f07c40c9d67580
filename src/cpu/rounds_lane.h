/* SPDX-License-Identifier: MIT
 * The kernels of rounds.k in one lane, for C. */
#ifndef MANGATA_CPU_ROUNDS_LANE_H
#define MANGATA_CPU_ROUNDS_LANE_H

/* The prelude redefines names of these headers, so they come first. */
#include <math.h>
#include <stdlib.h>

#include "base/hash.h"

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/adaptive/rounds.k"

#endif
