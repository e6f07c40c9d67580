/* SPDX-License-Identifier: MIT
 *
 * Where rays behind the surface end.
 */
#include "objects_shade.glsl"

/* `wet`: metres in water. */
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
