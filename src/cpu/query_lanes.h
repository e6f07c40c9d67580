/* SPDX-License-Identifier: MIT
 *
 * Heights, normals and velocities of the water at points, by lanes.
 */
#ifndef MANGATA_CPU_QUERY_LANES_H
#define MANGATA_CPU_QUERY_LANES_H

#include "frame/water_terms.h"

/* `points` as mgt_water_query() gets them; `level` metres. Writes all answers except foam. `rest` (NULL: not wanted)
 * gets x and z of the place at rest of the water at each point. */
typedef void query_function(const water_terms *terms, double level, const double *points, size_t count, mgt_water_answers *answers, double *rest);

/* `rays` and `distance` as mgt_water_trace() gets them. */
typedef void trace_function(const water_terms *terms, double level, const double *rays, size_t count, double reach, double *distance);

/* One a lane width, in query_lanes.c. */
extern query_function query_lanes_1, query_lanes_4, query_lanes_8, query_lanes_16;
extern trace_function trace_lanes_1, trace_lanes_4, trace_lanes_8, trace_lanes_16;

/* For the widest lanes that this processor has. */
typedef struct query_functions {
    query_function *query;
    trace_function *trace;
} query_functions;

query_functions query_lanes(void);

#endif
