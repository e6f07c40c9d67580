/* SPDX-License-Identifier: MIT
 * After kernels at one lane: the dialect's words for functions of <math.h> mean those of <math.h> again. No guard: it takes back what stands before it. */
#undef sqrt
#undef floor
#undef min
#undef max
#undef abs
#undef fma
#undef clamp
#undef real
