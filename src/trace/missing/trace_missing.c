/* SPDX-License-Identifier: MIT
 * A build without Embree: nothing can be traced, and callers are told so. */
#include "trace/trace.h"

#include <math.h>

bool trace_available(void) { return false; }

mgt_status trace_scene_update(trace_scene **scene, const trace_triangles *triangles, uint32_t threads, const reporter *r)
{
    (void)scene;
    (void)triangles;
    (void)threads;
    return report_error(r, MGT_ERROR_UNAVAILABLE, "trace.missing", "this build cannot trace rays: Embree was not found when it was made");
}

void trace_scene_free(trace_scene *scene) { (void)scene; }

size_t trace_scene_bytes(const trace_scene *scene)
{
    (void)scene;
    return 0;
}

void trace_nearest(const trace_scene *scene, size_t count, const trace_ray *rays, trace_hit *hits)
{
    (void)scene;
    (void)rays;
    for (size_t i = 0; i < count; i++)
        hits[i] = (trace_hit){.along = HUGE_VALF, .triangle = -1};
}

void trace_occluded(const trace_scene *scene, size_t count, const trace_ray *rays, uint8_t *occluded)
{
    (void)scene;
    (void)rays;
    for (size_t i = 0; i < count; i++)
        occluded[i] = 0;
}
