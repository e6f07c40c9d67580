/* SPDX-License-Identifier: MIT
 * Rays against triangles by Embree 3. */
#include "trace/trace.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct trace_scene {
    RTCDevice device;
    RTCScene tree;
    trace_triangles triangles;
    _Atomic int64_t bytes; /* of Embree's */
};

bool trace_available(void)
{
    return true;
}

/* ---- building ---- */

static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    (void)post;
    trace_scene *s = user;
    atomic_fetch_add(&s->bytes, bytes);
    return true;
}

/* AVX2 where there is AVX-512 too, for the same bits on both. */
static RTCDevice create_device(uint32_t threads)
{
    char options[96];
    const char *isa = "";
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
        isa = ",isa=avx2";
#endif
    snprintf(options, sizeof options, "threads=%u%s,set_affinity=0,start_threads=0", threads, isa);
    return rtcNewDevice(options);
}

static mgt_status device_error(const reporter *r, RTCDevice device)
{
    const enum RTCError error = rtcGetDeviceError(device);
    switch (error) {
    case RTC_ERROR_NONE: return MGT_OK;
    case RTC_ERROR_OUT_OF_MEMORY: return report_error(r, MGT_ERROR_MEMORY, "trace.memory", "out of memory for the tree of triangles that rays are traced through");
    case RTC_ERROR_UNSUPPORTED_CPU: return report_error(r, MGT_ERROR_UNAVAILABLE, "trace.cpu", "Embree does not run on this processor");
    default: return report_error(r, MGT_ERROR_UNAVAILABLE, "trace.embree", "Embree fails with error %d", (int)error);
    }
}

static bool copy_triangles(RTCGeometry geometry, const trace_triangles *t)
{
    float *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * t->count);
    uint32_t *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), t->count);
    if (!vertices || !indices)
        return false;
    for (size_t i = 0; i < t->count; i++)
        memcpy(vertices + 9 * i, t->corners + t->stride * i, 9 * sizeof *vertices);
    for (size_t i = 0; i < 3 * t->count; i++)
        indices[i] = (uint32_t)i;
    return true;
}

static void build_tree(trace_scene *s)
{
    s->tree = rtcNewScene(s->device);
    if (!s->tree)
        return;
    rtcSetSceneFlags(s->tree, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    const RTCGeometry geometry = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!geometry)
        return;
    if (s->triangles.count == 0 || copy_triangles(geometry, &s->triangles)) {
        rtcCommitGeometry(geometry);
        if (s->triangles.count)
            rtcAttachGeometry(s->tree, geometry);
        rtcCommitScene(s->tree);
    }
    rtcReleaseGeometry(geometry);
}

mgt_status trace_scene_update(trace_scene **scene, const trace_triangles *triangles, uint32_t threads, const reporter *r)
{
    if (*scene && (*scene)->triangles.version == triangles->version) {
        (*scene)->triangles = *triangles;
        return MGT_OK;
    }
    trace_scene *s = calloc(1, sizeof *s);
    if (!s)
        return report_error(r, MGT_ERROR_MEMORY, "trace.memory", "out of memory");
    s->triangles = *triangles;
    s->device = create_device(threads);
    if (!s->device) {
        const mgt_status status = device_error(r, NULL);
        free(s);
        return status == MGT_OK ? report_error(r, MGT_ERROR_UNAVAILABLE, "trace.embree", "Embree does not start") : status;
    }
    rtcSetDeviceMemoryMonitorFunction(s->device, count_bytes, s);
    build_tree(s);
    const mgt_status status = device_error(r, s->device);
    if (status != MGT_OK) {
        trace_scene_free(s);
        return status;
    }
    trace_scene_free(*scene);
    *scene = s;
    return MGT_OK;
}

void trace_scene_free(trace_scene *scene)
{
    if (!scene)
        return;
    if (scene->tree)
        rtcReleaseScene(scene->tree);
    rtcReleaseDevice(scene->device);
    free(scene);
}

size_t trace_scene_bytes(const trace_scene *scene)
{
    return scene ? sizeof *scene + (size_t)atomic_load(&scene->bytes) : 0;
}

/* ---- asking ---- */

/* Which of several triangles at the same distance a search finds depends on the tree, and that on the threads which built it: of those the first
 * one counts. */
typedef struct search {
    struct RTCIntersectContext context;
    float distance;
    uint32_t triangle;
} search;

static void prefer_first(const struct RTCFilterFunctionNArguments *a)
{
    search *s = (search *)(void *)a->context;
    const float distance = ((const struct RTCRay *)a->ray)->tfar; /* one ray: N is 1 */
    const uint32_t triangle = ((const struct RTCHit *)a->hit)->primID;
    if (distance > s->distance || (distance == s->distance && triangle > s->triangle)) {
        a->valid[0] = 0;
        return;
    }
    s->distance = distance;
    s->triangle = triangle;
}

static bool is_traceable(const trace_ray *ray)
{
    float sum = 0, square = 0;
    for (int i = 0; i < 3; i++) {
        sum += ray->origin[i] + ray->direction[i];
        square += ray->direction[i] * ray->direction[i];
    }
    return isfinite(sum) && square > 0 && isfinite(square) && ray->least <= ray->most;
}

static struct RTCRay embree_ray(const trace_ray *ray)
{
    return (struct RTCRay){.org_x = ray->origin[0],
                           .org_y = ray->origin[1],
                           .org_z = ray->origin[2],
                           .tnear = ray->least,
                           .dir_x = ray->direction[0],
                           .dir_y = ray->direction[1],
                           .dir_z = ray->direction[2],
                           .tfar = ray->most,
                           .mask = UINT32_MAX};
}

static double clamped(double x, double most)
{
    return x > 0 ? fmin(x, most) : 0;
}

/* Distance and place where the ray's line meets the triangle's plane; what rounding took beyond its edges is put back. */
static trace_hit place_hit(const trace_triangles *t, const trace_ray *ray, uint32_t triangle, float distance)
{
    const float *corner = t->corners + t->stride * triangle;
    double a[3], b[3], o[3], d[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)corner[3 + i] - (double)corner[i];
        b[i] = (double)corner[6 + i] - (double)corner[i];
        o[i] = (double)ray->origin[i] - (double)corner[i];
        d[i] = (double)ray->direction[i];
    }
    const double p[3] = {d[1] * b[2] - d[2] * b[1], d[2] * b[0] - d[0] * b[2], d[0] * b[1] - d[1] * b[0]};
    const double q[3] = {o[1] * a[2] - o[2] * a[1], o[2] * a[0] - o[0] * a[2], o[0] * a[1] - o[1] * a[0]};
    const double volume = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
    trace_hit hit = {.along = distance, .triangle = (int32_t)triangle};
    if (volume == 0)
        return hit;
    const double u = clamped((o[0] * p[0] + o[1] * p[1] + o[2] * p[2]) / volume, 1);
    const double v = clamped((d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / volume, 1 - u);
    const double along = (b[0] * q[0] + b[1] * q[1] + b[2] * q[2]) / volume;
    hit.u = (float)u;
    hit.v = (float)v;
    hit.along = (float)fmin(fmax(along, (double)ray->least), (double)ray->most);
    return hit;
}

void trace_nearest(const trace_scene *scene, size_t count, const trace_ray *rays, trace_hit *hits)
{
    for (size_t i = 0; i < count; i++) {
        hits[i] = (trace_hit){.along = HUGE_VALF, .triangle = -1};
        if (!is_traceable(&rays[i]))
            continue;
        search s = {.distance = HUGE_VALF, .triangle = UINT32_MAX};
        rtcInitIntersectContext(&s.context);
        s.context.filter = prefer_first;
        struct RTCRayHit asked = {.ray = embree_ray(&rays[i]), .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        rtcIntersect1(scene->tree, &s.context, &asked);
        if (asked.hit.geomID != RTC_INVALID_GEOMETRY_ID)
            hits[i] = place_hit(&scene->triangles, &rays[i], asked.hit.primID, asked.ray.tfar);
    }
}

void trace_occluded(const trace_scene *scene, size_t count, const trace_ray *rays, uint8_t *occluded)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < count; i++) {
        struct RTCRay ray = embree_ray(&rays[i]);
        const bool asks = is_traceable(&rays[i]);
        if (asks)
            rtcOccluded1(scene->tree, &context, &ray);
        occluded[i] = asks && ray.tfar < 0;
    }
}
