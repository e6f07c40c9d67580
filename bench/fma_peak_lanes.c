/* SPDX-License-Identifier: MIT
 * Independent chains of fma in registers, compiled once per lane width with the kernels' own prelude. */
#include "fma_peak.h"

#include "kernels/common/prelude_c.h"

#define ROUNDS_NAME_(n) fma_rounds_##n
#define ROUNDS_NAME(n) ROUNDS_NAME_(n)
#define EACH(do_it) do_it(0) do_it(1) do_it(2) do_it(3) do_it(4) do_it(5) do_it(6) do_it(7) do_it(8) do_it(9) do_it(10) do_it(11)
#define START(i) real chain##i = real(seed + 0.1f * i);
#define STEP(i) chain##i = fma(chain##i, factor, term);
#define SUM(i) sum = sum + chain##i;

float ROUNDS_NAME(MGT_LANES)(float seed, long rounds)
{
    /* x·0.75 + 0.25·seed stays near seed: no infinities, no denormals. */
    const real factor = real(0.75f), term = real(0.25f * seed);
    EACH(START)
    for (long i = 0; i < rounds; i++) {
        EACH(STEP)
    }
    real sum = real(0.0f);
    EACH(SUM)
    return sum[0];
}
