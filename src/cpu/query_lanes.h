/* SPDX-License-Identifier: MIT
 *
 * Queries of the water at points and along rays, for mgt_water_query() and mgt_water_trace(), in lanes.
 */
#ifndef MANGATA_CPU_QUERY_LANES_H
#define MANGATA_CPU_QUERY_LANES_H

#include "frame/water_terms.h"

/* Writes all answers except foam. `points`: those of mgt_water_query(). `level`: height of the mean surface, metres. `rest`: receives x and z of the place at
 * rest of the water at each point if the water is choppy; NULL: not wanted. */
typedef void query_function(const water_terms *terms, double level, const double *points, size_t count, mgt_water_answers *answers, double *rest);

/* Writes the distances. `rays`, `reach` and `distance`: those of mgt_water_trace(). */
typedef void trace_function(const water_terms *terms, double level, const double *rays, size_t count, double reach, double *distance);

/* One of each per lane width, in query_lanes.c. */
extern query_function query_lanes_1, query_lanes_4, query_lanes_8, query_lanes_16;
extern trace_function trace_lanes_1, trace_lanes_4, trace_lanes_8, trace_lanes_16;

typedef struct query_functions {
    query_function *query;
    trace_function *trace;
} query_functions;

/* The functions of the widest lanes that this processor has. */
query_functions query_lanes(void);

#endif
