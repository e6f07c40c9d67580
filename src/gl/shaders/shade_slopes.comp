/* SPDX-License-Identifier: MIT
 *
 * Methods that shade a pixel from its slopes. The text is assembled once for each method: method.k is its kernel, method_result the kernel's function,
 * but for `mangata`.
 *
 * Few pixels need a search or a second look at the surface. A workgroup gathers these pixels, so that neighbouring invocations process them.
 */
#define WEIGHTED_WAVES
#define FOAM_LAYER
#define CACHES_TILE
#define UNROLLED 4 /* steps of searches: without it, some compilers take half a minute to unroll them */
#include "lattice_data.glsl"
#ifdef LEAN_MAP
#include "lean_data.glsl"
#endif
#include "method.k"
#include "kernels/glitter/foam_over.k"

/* Pixels that wait for a search or for a second look: their inputs and results. */
shared int waiting;
shared int waiting_pixel[GROUP_PIXELS]; /* place of the hit in the tile: row · TILE_WIDTH + column */
shared float waiting_along[GROUP_PIXELS];
shared vec2 waiting_shift[GROUP_PIXELS];
shared Surface found_surface[GROUP_PIXELS];
shared SearchHit found_hit[GROUP_PIXELS];

/* Lists the pixel of this invocation if `wanted` is true. Returns its place in the list; −1: it does not wait. */
int wait_for(bool wanted, ivec2 pixel, float along, vec2 shift)
{
    barrier(); /* all results of the previous list have been read */
    if (gl_LocalInvocationIndex == 0u)
        waiting = 0;
    barrier();
    int place = wanted ? atomicAdd(waiting, 1) : -1;
    if (wanted) {
        waiting_pixel[place] = pixel.y * TILE_WIDTH + pixel.x;
        waiting_along[place] = along;
        waiting_shift[place] = shift;
    }
    barrier();
    return place;
}

/* Whether this invocation processes a pixel of the list. */
bool is_worker() { return int(gl_LocalInvocationIndex) < waiting; }

vec3 waiting_ray()
{
    int pixel = waiting_pixel[gl_LocalInvocationIndex];
    return pixel_ray_filtered(0, float(pixel % TILE_WIDTH), float(pixel / TILE_WIDTH)).ray;
}

/* Searches the first hits of the pixels whose `wanted` is true. The whole workgroup must call it. */
SearchHit search_where(bool wanted, ivec2 pixel, HitEstimate estimate)
{
    SearchHit hit = SearchHit(0.0f, 0.0f, vec2(0.0f), vec2(0.0f));
    int place = wait_for(wanted, pixel, estimate.from, vec2(0.0f));
    if (is_worker())
        found_hit[gl_LocalInvocationIndex] = search(0, waiting_ray(), waiting_along[gl_LocalInvocationIndex], 1.0f);
    barrier();
    if (wanted)
        hit = found_hit[place];
    return hit;
}

/* slope_state() of glitter.k. The whole workgroup must call it. */
SlopeState state_where(bool wanted, vec3 ray, ivec2 pixel)
{
    HitEstimate estimate = pixel_estimate(pixel);
    float along = estimated_along(0, ray, estimate);
    SurfaceLook look;
    bool lost = wanted && estimate.search > 0.0f;
    look.again = 0.0f;
    for (int turn = 0; turn < 2; turn++) { /* searches first where the lattice doubts the estimate, then where the look finds it wrong */
        SearchHit hit = search_where(lost, pixel, estimate);
        bool found = lost && hit.found > 0.0f;
        if (turn == 0) {
            along = found ? hit.along : along;
            estimate.slope = found ? hit.slope : estimate.slope;
            estimate.shift = found ? hit.shift : estimate.shift;
            if (wanted) {
                look = look_at_estimate(0, ray, along, estimate.slope, estimate.shift);
                estimate.shift = look.surface.shift;
            }
            lost = wanted && look.lost > 0.0f;
        } else if (found) {
            look.correction = hit.along - along;
            look.again = 1.0f;
            estimate.shift = hit.shift;
        }
    }
    bool again = wanted && look.again > 0.0f;
    look.along = again ? along + look.correction : along;
    int place = wait_for(again, pixel, look.along, estimate.shift);
    if (is_worker())
        found_surface[gl_LocalInvocationIndex] =
            surface_along(0, waiting_ray(), waiting_along[gl_LocalInvocationIndex], vec2(0.0f), waiting_shift[gl_LocalInvocationIndex]);
    barrier();
    if (again)
        look.surface = found_surface[place];
    return slopes_at(0, ray, look.along, look.surface);
}

#ifndef method_result /* method `mangata` sees the whole shutter in one state */
#define method_result(cx, p, open, close) glitter_result(cx, p, close)
#endif
#define METHOD_STATE SlopeState
#define OVER_STATE
#include "shade.glsl"
