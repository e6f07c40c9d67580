/* SPDX-License-Identifier: MIT
 *
 * Ends of rays behind the surface.
 */
#include "objects_shade.glsl"

/* The ray to a point that was found. `wet` is its length in water, metres. */
HitRay ray_of(WaterHit hit, FoundPoint f, float wet)
{
    vec3 position = turned(0, f.position);
    HitRay r;
    r.position = vec3(position.x + narrow_data.foot_x, position.y, position.z + narrow_data.foot_z);
    r.direction = turned(0, f.direction);
    r.before = hit.along;
    r.after = f.after;
    r.water = wet;
    r.gain = 1.0f;
    return r;
}

/* What the surface with its mean slope mirrors of objects and, under water, of the water. alpha is 1, or 0 if it mirrors the sky. */
vec4 seen_mirrored(PixelWater water)
{
    Bent bent = Bent(mirrored_by_mean(0, water.hit.view, water.hit.normal), 1.0f);
    FoundPoint f = find_mirrored(0, water.hit, bent.direction);
    bool above = narrow_data.side > 0.0f;
    int triangle = f.shown > 0.0f ? layer_triangle(LAYER_REFLECTED, ivec2(int(f.column), int(f.row))) : -1;
    if (triangle < 0 && above)
        return vec4(0.0f);
    HitRay ray = ray_of(water.hit, f, above ? 0.0f : water.hit.along + f.after);
    ray.footprint = footprint_behind(water.hit, bent, water.variation, f.after);
    return vec4(shaded(triangle, ray), 1.0f);
}
