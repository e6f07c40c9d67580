/* SPDX-License-Identifier: MIT
 * The most fused multiply-adds that this machine does in registers. */
#ifndef MANGATA_BENCH_FMA_PEAK_H
#define MANGATA_BENCH_FMA_PEAK_H

enum { FMA_CHAINS = 12 };

/* `rounds` rounds of FMA_CHAINS independent fma of whole vectors; returns something that depends on them all. */
typedef float fma_rounds(float seed, long rounds);

fma_rounds fma_rounds_4;
#if defined(__x86_64__)
fma_rounds fma_rounds_8;
fma_rounds fma_rounds_16;
#endif

/* Floating-point operations a second (an fma counts as two) of `threads` threads together over about `seconds`; 0 when threads
 * are short. */
double fma_peak(fma_rounds *run, int lanes, int threads, double seconds);

#endif
