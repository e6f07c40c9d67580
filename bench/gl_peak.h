/* SPDX-License-Identifier: MIT
 * The most fused multiply-adds that a GPU does in registers. */
#ifndef MANGATA_BENCH_GL_PEAK_H
#define MANGATA_BENCH_GL_PEAK_H

#include <stdbool.h>

/* Floating-point operations a second (an fma counts as two) of EGL's device 0, the best of several runs; 0 without OpenGL. */
double gl_fma_peak(bool quick);

#endif
