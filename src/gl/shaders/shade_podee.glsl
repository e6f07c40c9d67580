/* SPDX-License-Identifier: MIT
 *
 * The state of a pixel for methods `podee-*`, which is not set unless it is `wanted`.
 */
PodeeState state_where(bool wanted, vec3 ray, ivec2 pixel)
{
    PodeeState state;
    if (wanted)
        state = podee_state(0, ray, pixel_estimate(pixel));
    return state;
}
