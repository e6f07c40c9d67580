/* SPDX-License-Identifier: MIT
 * The kernels of the rounds of method adaptive, for C: uniform numbers alone. */
#ifndef MANGATA_CPU_ROUNDS_LANE_H
#define MANGATA_CPU_ROUNDS_LANE_H

/* Before the prelude, whose words mean others. */
#include <math.h>
#include <stdlib.h>

#include "base/hash.h"

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/adaptive/rounds.k"

#endif
