/* SPDX-License-Identifier: MIT
 * Vectors of three doubles, and the least and greatest of three numbers of any type. */
#ifndef MANGATA_BASE_TRIPLES_H
#define MANGATA_BASE_TRIPLES_H

#include <math.h>

static inline double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void cross3(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void normalize3(double v[3])
{
    const double length = sqrt(dot3(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

/* Least and greatest element of an array of three numbers. The argument is evaluated more than once. */
#define LEAST3(v) ((v)[0] < (v)[1] ? ((v)[0] < (v)[2] ? (v)[0] : (v)[2]) : ((v)[1] < (v)[2] ? (v)[1] : (v)[2]))
#define MOST3(v) ((v)[0] > (v)[1] ? ((v)[0] > (v)[2] ? (v)[0] : (v)[2]) : ((v)[1] > (v)[2] ? (v)[1] : (v)[2]))

#endif
