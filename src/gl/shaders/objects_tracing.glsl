/* SPDX-License-Identifier: MIT
 *
 * What rays meet behind the surface, where the pictures do not certify an answer.
 */
#include "objects_shade.glsl"
#include "bvh.glsl"

RayEnd end_traced(PixelWater w)
{
    Bent bent = bent_at(0, w.hit.view, w.hit.normal);
    bool total = bent.total > 0.0f;
    RayEnd end;
    end.ray.direction = turned(0, bent.direction);
    vec3 from = camera_position() + w.hit.along * TRACE_START * turned(0, w.hit.view);
    TreeHit met = trace_nearest(from, end.ray.direction);
    end.triangle = met.triangle;
    end.ray.before = w.hit.along;
    end.ray.after = met.triangle >= 0 ? met.along : 0.0f;
    end.ray.position = from + end.ray.after * end.ray.direction;
    end.ray.water = metres_in_water(0, narrow_data.side, w.hit.along, end.ray.after, total);
    end.ray.footprint = footprint_behind(w.hit, bent, w.variation, end.ray.after);
    end.ray.gain = gain_behind(total);
    end.error = 0.0f;
    end.counts = true;
    return end;
}
