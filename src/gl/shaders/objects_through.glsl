/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface.
 */
#include "objects_behind.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) writeonly uniform image2D body_image;  /* what comes through the surface */
layout(binding = 4) writeonly uniform image2D error_image; /* pixels that the point behind the surface is off by */

/* Method `broad` knows the mean surface alone, `off` looks straight through. */
WaterHit surface_of_method(WaterHit hit)
{
    if (narrow_data.method != 3)
        return hit;
    hit.along = narrow_data.distance / max(-hit.view.y, 1e-6f);
    hit.normal = vec3(0.0f, 1.0f, 0.0f);
    return hit;
}

/* Where the surface lets nothing through, it mirrors the camera's own side. */
RayEnd end_through(PixelWater w)
{
    WaterHit hit = surface_of_method(w.hit);
    Bent bent = bent_at(0, hit.view, hit.normal);
    if (narrow_data.method == 7)
        bent = Bent(hit.view, 0.0f);
    bool total = bent.total > 0.0f;
    FoundPoint f;
    if (total)
        f = find_mirrored(0, hit);
    else
        f = find_refracted(0, hit, bent);
    float wet = narrow_data.side > 0.0f ? f.after : hit.along + (total ? f.after : 0.0f);
    RayEnd end;
    end.triangle = f.shown > 0.0f ? layer_triangle(total ? 1 : 0, ivec2(int(f.column), int(f.row))) : -1;
    end.ray = ray_of(hit, f, wet, w.slopes);
    end.error = f.residual < 1e28f ? f.residual : INFINITY;
    end.counts = true;
    return end;
}
