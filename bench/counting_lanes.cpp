// SPDX-License-Identifier: MIT
// src/cpu/lanes.c once more, over reals that count what is done with them: see counting/kernels/common/prelude_c.h.
#define MGT_LANES 1
#define lane_kernels_1 counting_lane_kernels
#define _Static_assert static_assert

#include "operation_count.h"

operation_count operations_done;

#include "cpu/lanes.c"
