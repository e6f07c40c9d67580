/* SPDX-License-Identifier: MIT
 *
 * Ends of rays behind the surface that are traced, because the layers do not prove an end.
 */
#include "objects_shade.glsl"
#include "bvh.glsl"

/* The ray, or if something stops it before it meets the surface again, the ray from the pixel's hit. */
TracedRay stopped_ray(PixelWater w, TracedRay r, Bent bent)
{
    TracedRay first = TracedRay(camera_position() + w.hit.along * TRACE_START * turned(0, w.hit.view), turned(0, bent.direction), 0.0f, 0.0f, r.part,
                                bent.total > 0.0f, 0.0f);
    return r.unsure > 0.0f && trace_nearest(first.from, first.direction).along <= r.unsure ? first : r;
}

RayEnd end_traced(PixelWater w, TracedRay r)
{
    Bent bent = bent_at(0, w.hit.view, w.hit.normal);
    r = stopped_ray(w, r, bent);
    TreeHit met = trace_nearest(r.from, r.direction);
    RayEnd end;
    end.triangle = met.triangle;
    end.ray.direction = r.direction;
    end.ray.after = met.triangle >= 0 ? met.along : 0.0f;
    end.ray.position = r.from + end.ray.after * r.direction;
    end.error = 0.0f;
    end.counts = true;
    return end_behind(end, w, r, bent);
}
