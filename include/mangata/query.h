/* SPDX-License-Identifier: MIT
 *
 * Questions about the water: how high it is at a place, how it leans and how it moves. They need no context. */
#ifndef MANGATA_QUERY_H
#define MANGATA_QUERY_H

#include "mangata/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What mgt_water_query() computes, and where it writes. Answers whose pointer is NULL are left out. */
typedef struct mgt_water_answers {
    size_t struct_size;
    double least_wavelength; /* metres, 0 … 1e9: shorter waves count in `covariance` alone. 0: all waves count at the points */
    uint32_t exact;          /* 0: heights within 1e-6 of the sum of all amplitudes. 1: within 1e-9 m, in about twice the time. Up to 100 km and 1e6 s from 0 */
    uint32_t reserved;       /* 0 */
    double *height;          /* metres, water.level included: a number a point */
    float *normal;           /* unit, of the side of the air: x, y, z of each point */
    float *velocity;         /* metres per second, of the surface: x, y, z of each point; x and z are 0 where the water is not choppy */
    double covariance[3];    /* written: xx, xz and zz of the slopes of the waves shorter than least_wavelength */
    float *jacobian;         /* area of a piece of water divided by its area at rest, a number a point: 1 without choppiness; below 0 the water folds over */
    size_t unsettled;       /* written: number of points of choppy water whose place at rest was not found. They get the answers of a place near it. Where water
                                folds, other points may miss the highest water (docs/query.md) */
    float *foam;            /* fraction of each point that foam covers, 0 … 1, a number a point: 0 without choppiness */
    float foam_share;       /* for `foam`: scene.foam, fraction of the whole water, 0 … 0.5 */
    float foam_persistence; /* for `foam`: scene.foam_persistence, seconds, 0 … 60; 3 */
} mgt_water_answers;

/* All pointers NULL: asks nothing. */
MGT_API void mgt_water_answers_init(mgt_water_answers *answers, size_t size);

/* Answers for `count` points, x and z of each in metres, within ±1e9. Of `water`, its waves, choppiness and level are read. A point that is not finite gets NaN.
 * Any thread, several at once; nothing is allocated or kept, and a point's answer depends neither on the others nor on the thread. With AVX2 and AVX-512 it is
 * the same to the bit. 64 waves take a core some 40 to 70 ns a point, choppy water about four times as long (docs/benchmarks.md), and a little more in winds
 * so strong that crests fold. The stack needs up to 0.4 MiB, with more than 512 waves 0.7.
 * MGT_ERROR_SCENE: a wave is out of its range; MGT_ERROR_ARGUMENT: the time is not within ±1e9 s, a finite point not within ±1e9 m, or a pointer is missing.
 * mgt_last_error(NULL) says which, and nothing has been written. */
MGT_API mgt_status mgt_water_query(const mgt_water *water, double time, const double *points, size_t count, mgt_water_answers *answers);

/* Where rays first meet the surface, from above or from below. `rays` are `count` origins and directions, x y z and x y z in metres; origins within ±1e9, and
 * directions of lengths from 1e-100 to 1e100. `distance` gets `count` numbers: multiples of the direction, at most `reach` (0 … 1e9); +infinity where the
 * water is not met by then; NaN where a ray is not finite, has no such direction, or has not ended after 100,000 evaluations of the water, as a ray along the
 * surface may not. No crest is stepped over: a hit is the first one. It lies within 1e-9 m of the surface, or within 1e-9 of the way to it.
 * Where choppy water folds (steepness times choppiness above 1) this is not promised: the surface is then the highest water that mgt_water_query() finds, which
 * ends straight down where a crest hangs over, and a thin crest may be missed.
 * Threads and errors as for mgt_water_query(). */
MGT_API mgt_status mgt_water_trace(const mgt_water *water, double time, const double *rays, size_t count, double reach, double *distance);

#ifdef __cplusplus
}
#endif
#endif
