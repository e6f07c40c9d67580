/* SPDX-License-Identifier: MIT
 *
 * Elementary functions of double with the same bits on every machine.
 */
#include "sea/spectrum_math.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* ln 2 and π/2 in two parts. The first part has so few digits that its product with a small whole number is exact. */
static const double LN2 = 0.693147180559945309417, LN2_HIGH = 0x1.62e42fee00000p-1, LN2_LOW = 1.90821492927058770002e-10;
static const double HALF_PI_HIGH = 0x1.921fb54400000p+0, HALF_PI_LOW = 6.07710050650619224932e-11;

double portable_exp(double x)
{
    if (x < -700)
        return 0;
    x = x < 700 ? x : 700;
    const double n = floor(x / LN2 + 0.5), r = (x - n * LN2_HIGH) - n * LN2_LOW;
    double sum = 1;
    for (int i = 14; i > 0; i--) /* Taylor series for |r| ≤ ln 2 / 2 */
        sum = 1 + r / i * sum;
    return ldexp(sum, (int)n);
}

double portable_log(double x)
{
    int exponent;
    double m = frexp(x, &exponent);
    if (m < 0.70710678118654752440) {
        m *= 2;
        exponent--;
    }
    const double s = (m - 1) / (m + 1), square = s * s;
    double sum = 0;
    for (int i = 23; i > 1; i -= 2) /* 2 artanh s by its series for |s| < 0.172 */
        sum = square * (1.0 / i + sum);
    return exponent * LN2_HIGH + (exponent * LN2_LOW + 2 * s * (1 + sum));
}

double portable_pow(double x, double y) { return x > 0 ? portable_exp(y * portable_log(x)) : 0; }

double portable_tanh(double x)
{
    if (x > 20)
        return 1;
    const double square = x * x;
    if (x < 0.02) /* the quotient below would lose digits by cancellation */
        return x * (1 - square * (1.0 / 3 - square * (2.0 / 15 - square * (17.0 / 315))));
    const double e = portable_exp(2 * x);
    return (e - 1) / (e + 1);
}

/* Taylor's series of sine (first = 1) or cosine (0) for |x| ≤ π/4. */
static double series(double x, int first)
{
    const double square = x * x;
    double sum = 1;
    for (int i = first + 16; i > first; i -= 2)
        sum = 1 - square / (i * (i - 1)) * sum;
    return first == 1 ? x * sum : sum;
}

/* sin(x + quarters·π/2). */
static double turned_sin(double x, int quarters)
{
    const double n = floor(x / (SPECTRUM_PI / 2) + 0.5), r = (x - n * HALF_PI_HIGH) - n * HALF_PI_LOW;
    const int quadrant = ((int)n + quarters) & 3;
    const double value = series(r, (quadrant & 1) == 0);
    return (quadrant & 2) != 0 ? -value : value;
}

double portable_sin(double x) { return turned_sin(x, 0); }

double portable_cos(double x) { return turned_sin(x, 1); }

double seven_digits(double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.6e", value);
    return strtod(text, NULL);
}
