/* SPDX-License-Identifier: MIT
 * Rays against triangles by Embree 3. */
#include "trace/trace.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

struct trace_scene {
    RTCDevice device;
    RTCScene tree;
    trace_triangles triangles;
    _Atomic int64_t bytes; /* of Embree's */
};

bool trace_available(void) { return true; }

/* ---- building ---- */

static bool count_bytes(void *user, ssize_t bytes, bool post)
{
    (void)post;
    trace_scene *s = user;
    atomic_fetch_add(&s->bytes, bytes);
    return true;
}

/* AVX2 where there is AVX-512 too, for the same bits on both. Threads start with the first tree that is worth them. */
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
    case RTC_ERROR_NONE:
        return MGT_OK;
    case RTC_ERROR_OUT_OF_MEMORY:
        return report_error(r, MGT_ERROR_MEMORY, "trace.memory", "out of memory for the tree of triangles that rays are traced through");
    case RTC_ERROR_UNSUPPORTED_CPU:
        return report_error(r, MGT_ERROR_UNAVAILABLE, "trace.cpu", "Embree does not run on this processor");
    default:
        return report_error(r, MGT_ERROR_UNAVAILABLE, "trace.embree", "Embree fails with error %d", (int)error);
    }
}

static void build_tree(trace_scene *s)
{
    const trace_triangles *t = &s->triangles;
    s->tree = rtcNewScene(s->device);
    if (!s->tree)
        return;
    rtcSetSceneFlags(s->tree, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    if (t->count) {
        const RTCGeometry geometry = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        if (!geometry)
            return;
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, t->positions, 0, 3 * sizeof(float), t->vertex_count);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, t->indices, 0, 3 * sizeof(uint32_t), t->count);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(s->tree, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(s->tree);
}

mgt_status trace_scene_update(trace_scene **scene, const trace_triangles *triangles, uint32_t threads, const reporter *r)
{
    if (*scene && (*scene)->triangles.version == triangles->version)
        return MGT_OK;
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

size_t trace_scene_bytes(const trace_scene *scene) { return scene ? sizeof *scene + (size_t)atomic_load(&scene->bytes) : 0; }

/* ---- asking ---- */

enum { PACKET = 8 };

/* Which of several triangles at the same distance a search finds first depends on the tree: of those the first of the list counts. */
typedef struct search {
    struct RTCIntersectContext context;
    float distance[PACKET];
    uint32_t triangle[PACKET];
} search;

/* Embree calls with whole packets, and with a single ray of one whose others are done. */
static void prefer_first(const struct RTCFilterFunctionNArguments *a)
{
    search *s = (search *)(void *)a->context;
    const float *distance = (const float *)a->ray + 8 * a->N;
    const uint32_t *id = (const uint32_t *)a->ray + 10 * a->N, *triangle = (const uint32_t *)a->hit + 5 * a->N;
    for (uint32_t i = 0; i < a->N; i++) {
        if (!a->valid[i])
            continue;
        const uint32_t lane = id[i];
        if (distance[i] > s->distance[lane] || (distance[i] == s->distance[lane] && triangle[i] > s->triangle[lane])) {
            a->valid[i] = 0;
            continue;
        }
        s->distance[lane] = distance[i];
        s->triangle[lane] = triangle[i];
    }
}

_Static_assert(offsetof(struct RTCRay, tfar) == 8 * sizeof(float) && offsetof(struct RTCRay, id) == 10 * sizeof(float), "as prefer_first reads it");
_Static_assert(offsetof(struct RTCHit, primID) == 5 * sizeof(float), "as prefer_first reads it");

static bool is_traceable(const trace_ray *ray)
{
    float sum = 0, square = 0;
    for (int i = 0; i < 3; i++) {
        sum += ray->origin[i] + ray->direction[i];
        square += ray->direction[i] * ray->direction[i];
    }
    return isfinite(sum) && square > 0 && isfinite(square) && ray->least <= ray->most;
}

/* Fills a packet with up to eight rays; those that it is asked for are marked −1 in `valid`. */
static void fill_packet(struct RTCRay8 *packet, int valid[PACKET], const trace_ray *rays, size_t count)
{
    for (uint32_t i = 0; i < PACKET; i++) {
        const trace_ray *ray = &rays[i < count ? i : 0];
        valid[i] = i < count && is_traceable(ray) ? -1 : 0;
        packet->org_x[i] = ray->origin[0];
        packet->org_y[i] = ray->origin[1];
        packet->org_z[i] = ray->origin[2];
        packet->tnear[i] = ray->least;
        packet->dir_x[i] = ray->direction[0];
        packet->dir_y[i] = ray->direction[1];
        packet->dir_z[i] = ray->direction[2];
        packet->time[i] = 0;
        packet->tfar[i] = ray->most;
        packet->mask[i] = UINT32_MAX;
        packet->id[i] = i;
        packet->flags[i] = 0;
    }
}

static double clamped(double x, double most) { return x > 0 ? fmin(x, most) : 0; }

/* Distance and place where the ray's line meets the triangle's plane; what rounding took beyond its edges is put back. */
static trace_hit place_hit(const trace_triangles *t, const trace_ray *ray, uint32_t triangle, float distance)
{
    const uint32_t *corner = t->indices + 3 * (size_t)triangle;
    const float *first = t->positions + 3 * (size_t)corner[0], *second = t->positions + 3 * (size_t)corner[1], *third = t->positions + 3 * (size_t)corner[2];
    double a[3], b[3], o[3], d[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (double)second[i] - (double)first[i];
        b[i] = (double)third[i] - (double)first[i];
        o[i] = (double)ray->origin[i] - (double)first[i];
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
    search s;
    rtcInitIntersectContext(&s.context);
    s.context.filter = prefer_first;
    s.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t first = 0; first < count; first += PACKET) {
        const size_t some = count - first < PACKET ? count - first : PACKET;
        _Alignas(32) int valid[PACKET];
        struct RTCRayHit8 asked;
        fill_packet(&asked.ray, valid, rays + first, some);
        for (int i = 0; i < PACKET; i++) {
            asked.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            s.distance[i] = HUGE_VALF;
            s.triangle[i] = UINT32_MAX;
        }
        rtcIntersect8(valid, scene->tree, &s.context, &asked);
        for (size_t i = 0; i < some; i++)
            hits[first + i] = asked.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                                  ? (trace_hit){.along = HUGE_VALF, .triangle = -1}
                                  : place_hit(&scene->triangles, &rays[first + i], asked.hit.primID[i], asked.ray.tfar[i]);
    }
}

void trace_occluded(const trace_scene *scene, size_t count, const trace_ray *rays, uint8_t *occluded)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t first = 0; first < count; first += PACKET) {
        const size_t some = count - first < PACKET ? count - first : PACKET;
        _Alignas(32) int valid[PACKET];
        struct RTCRay8 asked;
        fill_packet(&asked, valid, rays + first, some);
        rtcOccluded8(valid, scene->tree, &context, &asked);
        for (size_t i = 0; i < some; i++)
            occluded[first + i] = valid[i] && asked.tfar[i] < 0;
    }
}
