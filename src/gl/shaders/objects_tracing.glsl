/* SPDX-License-Identifier: MIT
 *
 * Ends of rays behind the surface that are traced, because the layers do not prove an end.
 */
#include "objects_shade.glsl"
#include "bvh.glsl"

RayEnd end_traced(PixelWater w, TracedRay r)
{
    TreeHit met = trace_nearest(r.from, r.direction);
    RayEnd end;
    end.triangle = met.triangle;
    end.ray.direction = r.direction;
    end.ray.after = met.triangle >= 0 ? met.along : 0.0f;
    end.ray.position = r.from + end.ray.after * r.direction;
    end.error = 0.0f;
    end.counts = true;
    return end_behind(end, w, r, bent_at(0, w.hit.view, w.hit.normal));
}
