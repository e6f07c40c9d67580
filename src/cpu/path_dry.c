/* SPDX-License-Identifier: MIT
 * Which points lie inside dry hulls, decided by rays traced from each point. */
#include "cpu/path_dry.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { AROUND = 32, MAY_MISS = AROUND / 8 };

struct path_dry {
    trace_scene *trace;
    uint32_t *indices;        /* vertices of the dry triangles */
    double low[3], high[3];   /* box around them */
    trace_ray around[AROUND]; /* horizontal directions */
};

void path_dry_free(path_dry *dry)
{
    if (!dry)
        return;
    trace_scene_free(dry->trace);
    free(dry->indices);
    free(dry);
}

/* Fills indices, low and high. Returns the number of dry triangles. */
static size_t take_triangles(path_dry *dry, const world *w)
{
    size_t count = 0;
    for (int k = 0; k < 3; k++)
        dry->low[k] = HUGE_VAL, dry->high[k] = -HUGE_VAL;
    for (size_t t = 0; t < w->triangle_count; t++)
        for (size_t c = 0; c < 3 && w->objects[w->object[t]].dry; c++) {
            const uint32_t vertex = w->indices[3 * t + c];
            dry->indices[count++] = vertex;
            for (int k = 0; k < 3; k++) {
                dry->low[k] = fmin(dry->low[k], (double)w->positions[3 * (size_t)vertex + (size_t)k]);
                dry->high[k] = fmax(dry->high[k], (double)w->positions[3 * (size_t)vertex + (size_t)k]);
            }
        }
    return count / 3;
}

mgt_status path_dry_update(path_dry **out, const world *w, uint32_t threads, const reporter *r)
{
    path_dry_free(*out);
    *out = NULL;
    if (!w->dry)
        return MGT_OK;
    path_dry *dry = calloc(1, sizeof *dry);
    if (!dry || !(dry->indices = malloc((w->triangle_count + 1) * 3 * sizeof *dry->indices))) {
        path_dry_free(dry);
        return report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the scene's dry objects");
    }
    const trace_triangles triangles = {take_triangles(dry, w), w->vertex_count, w->positions, dry->indices, w->version};
    const mgt_status status = trace_scene_update(&dry->trace, &triangles, threads, r);
    if (status != MGT_OK) {
        path_dry_free(dry);
        return status;
    }
    for (int i = 0; i < AROUND; i++) {
        const double angle = 6.283185307179586 * (i + 0.5) / AROUND;
        dry->around[i] = (trace_ray){.direction = {(float)sin(angle), 0, (float)cos(angle)}, .most = FLT_MAX};
    }
    *out = dry;
    return MGT_OK;
}

bool path_dry_holds(const path_dry *dry, const double point[3])
{
    for (int k = 0; k < 3; k++)
        if (!(point[k] > dry->low[k] && point[k] < dry->high[k]))
            return false;
    trace_ray down = {.origin = {(float)point[0], (float)point[1], (float)point[2]}, .direction = {0, -1, 0}, .most = FLT_MAX};
    uint8_t met[AROUND] = {0};
    trace_occluded(dry->trace, 1, &down, met);
    if (!met[0])
        return false;
    trace_ray rays[AROUND];
    for (int i = 0; i < AROUND; i++) {
        rays[i] = dry->around[i];
        for (int k = 0; k < 3; k++)
            rays[i].origin[k] = down.origin[k];
    }
    trace_occluded(dry->trace, AROUND, rays, met);
    int missed = 0;
    for (int i = 0; i < AROUND; i++)
        missed += !met[i];
    return missed <= MAY_MISS;
}
