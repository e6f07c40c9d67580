/* SPDX-License-Identifier: MIT
 *
 * Elementary functions of double that use sums, products, quotients and square roots alone. So a sea that is made from a spectrum has the same bits on every
 * machine, which it would not have with the C library's functions. Relative errors are below 2e-15.
 */
#ifndef MANGATA_SEA_SPECTRUM_MATH_H
#define MANGATA_SEA_SPECTRUM_MATH_H

#define SPECTRUM_PI 3.14159265358979323846

double portable_exp(double x);           /* 0 below -700; at most e^700 */
double portable_log(double x);           /* x > 0 */
double portable_pow(double x, double y); /* x ≥ 0; 0 for x = 0 */
double portable_tanh(double x);          /* x ≥ 0 */
double portable_sin(double x);           /* |x| ≤ 1e6 */
double portable_cos(double x);

/* A value rounded to seven significant digits, which removes differences between machines in the last bits. */
double seven_digits(double value);

#endif
