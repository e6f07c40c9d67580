/* SPDX-License-Identifier: MIT
 *
 * Elementary functions of double made of additions, products, quotients and roots alone, so that a sea made from its spectrum has the same
 * bits on every machine; the C library's differ in their last bits from one processor to the next. Relative errors below 2e-15.
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

/* Rounded to seven significant digits, in which what else differs from one machine to the next is lost. */
double seven_digits(double value);

#endif
