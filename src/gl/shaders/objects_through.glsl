/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface.
 */
#include "objects_behind.glsl"
#undef SEARCH_WAVE
#define SEARCH_WAVE(cx, i) wave_met_again(i)
#include "kernels/refraction/again.k"

layout(binding = 0) writeonly uniform image2D body_image;  /* what comes through the surface */
layout(binding = 4) writeonly uniform image2D error_image; /* pixels that the point behind the surface is off by */

/* ---- where what a layer shows breaks off or bends ---- */

bool bends(int a, int b)
{
    return a != b && a >= 0 && b >= 0 && planes_bend(0, texelFetch(plane_table, a).xyz, texelFetch(plane_table, b).xyz);
}

bool breaks_off(int layer, ivec2 at)
{
    if (any(lessThan(at, ivec2(1))) || any(greaterThanEqual(at + 1, ivec2(int(narrow_data.columns), int(narrow_data.rows)))))
        return true;
    const ivec2 beside[4] = ivec2[4](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
    float inverse[4];
    int here_triangle = layer_triangle(layer, at);
    for (int i = 0; i < 4; i++) {
        if (bends(here_triangle, layer_triangle(layer, at + beside[i])))
            return true;
        inverse[i] = layer_inverse(layer, at + beside[i]);
    }
    return depth_breaks(0, layer_inverse(layer, at), inverse[0], inverse[1], inverse[2], inverse[3], narrow_data.focal);
}

/* Whether the pictures do not certify a point. */
bool is_doubtful(FoundPoint f, int layer)
{
    return f.column >= 0.0f && point_is_doubtful(0, f.residual, breaks_off(layer, ivec2(int(f.column), int(f.row))));
}

/* A ray, and its nearest hit among the surfaces that the pixels asked so far show. */
struct ShownSurfaces {
    vec3 from, direction;
    int met;     /* triangle of the hit; −1: none */
    float along; /* distance of the hit along the ray; INFINITE: none */
    int asked;   /* triangle of the last pixel asked */
    bool lost;   /* following a surface ended after SURFACE_STEPS triangles */
    bool unsure; /* the same for the surface that the answer's pixel shows */
    bool open;   /* a pixel that was asked shows nothing */
};

/* Follows the surface that a triangle near the ray belongs to. */
ShownSurfaces follow_surface(ShownSurfaces s, int triangle, int answer)
{
    int start = triangle, before = -1;
    for (int i = 0; i < SURFACE_STEPS; i++) {
        SurfaceStep next = surface_step(0, triangle, before, s.from, s.direction);
        if (next.along < s.along) {
            s.along = next.along;
            s.met = triangle;
        }
        if (next.next < 0)
            return s;
        before = triangle;
        triangle = next.next;
    }
    s.lost = true;
    s.unsure = s.unsure || start == answer;
    return s;
}

ShownSurfaces follow_shown(ShownSurfaces s, int layer, ivec2 at, int answer)
{
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(int(narrow_data.columns), int(narrow_data.rows)))))
        return s;
    int triangle = layer_triangle(layer, at);
    s.open = s.open || triangle < 0;
    if (triangle < 0 || triangle == s.asked)
        return s;
    s.asked = triangle;
    return follow_surface(s, triangle, answer);
}

/* An answer in doubt is decided by the nearest surface that the ray meets among those that its pixel and the neighbours show. Where the search did not converge,
 * the surfaces along the ray's image in the layer count as well, then those around its pixel. An empty pixel of the mirrored layer does not set `open`: that
 * picture may end before the scene does. */
RayEnd sharpened(RayEnd end, WaterHit hit, int layer, FoundPoint f)
{
    ivec2 at = ivec2(int(f.column), int(f.row));
    if (!is_doubtful(f, layer))
        return end;
    bool by_nothing = narrow_data.side < 0.0f && layer == LAYER_REFRACTED; /* over the water the sky is all around */
    bool is_lost = point_is_lost(0, end.error), refracted = layer == LAYER_REFRACTED;
    ShownSurfaces s =
        ShownSurfaces(camera_position() + hit.along * turned(0, hit.view), end.ray.direction, -1, INFINITE, -1, false, false, by_nothing);
    int along = 9 + (is_lost ? SHARP_PLACES : 0), last = along + (is_lost && f.last_column >= 0.0f ? 1 : 0);
    int around = last + (is_lost && refracted ? AROUND_PLACES : 0);
    float after = INFINITE;
    for (int i = 0; i < around; i++) {
        if (i == 9) {
            by_nothing = s.open;
            after = s.along;
        }
        if (i == last && s.met >= 0)
            break;
        ivec2 asked = i < 9 ? at + ivec2(i % 3 - 1, i / 3 - 1) : i < last ? ivec2(int(f.last_column), int(f.last_row)) : ivec2(roundEven(vec2(at) + place_around(0, i - last)));
        if (i >= 9 && i < along) {
            Place p = place_along(0, layer, left_at(0, hit), f.direction, after, (float(i - 9) + 0.5f) / float(SHARP_PLACES));
            LayerPlace there = layer_place(0, p.column, p.row);
            asked = p.inside > 0.0f ? ivec2(int(there.x), int(there.y)) : ivec2(-1);
        }
        s = follow_shown(s, layer, asked, end.triangle);
    }
    bool open = by_nothing || (s.open && (around == 9 || (refracted && !s.lost)));
    if ((s.unsure && point_is_near(0, end.error) && end.ray.after < s.along) || (s.met < 0 && !open))
        return end;
    end.triangle = s.met;
    end.ray.after = s.met < 0 ? 0.0f : s.along;
    if (s.met >= 0)
        end.ray.position = s.from + s.along * s.direction;
    return end;
}

struct ThroughEnd {
    RayEnd end;
    TracedRay ray;
    bool traced;   /* the ray shall be: the end does not count */
    bool doubtful; /* at outlines: the pictures do not certify the end */
};

/* On a branch of again.k. Where the surface lets nothing through, it mirrors the camera's own side. */
ThroughEnd end_through(PixelWater w, int branch)
{
    WaterHit hit = surface_of_method(0, w.hit);
    SeenBehind s = find_behind(0, hit, true, branch);
    FoundPoint f = s.found;
    bool total = s.bent.total > 0.0f;
    int layer = total ? LAYER_REFLECTED : LAYER_REFRACTED;
    ThroughEnd through;
    through.ray.direction = turned(0, s.bent.direction);
    through.ray.from = camera_position() + s.from.along * (s.way > 0.0f ? 1.0f : TRACE_START) * turned(0, s.from.view);
    through.ray.way = s.way;
    through.ray.wet = s.wet;
    through.ray.part = s.part;
    through.ray.total = total;
    RayEnd end;
    end.triangle = f.shown > 0.0f ? layer_triangle(layer, ivec2(int(f.column), int(f.row))) : -1;
    end.ray = ray_of(s.from, f, 0.0f);
    end.error = point_error(0, f.residual);
    end.counts = true;
    if (narrow_data.method == REFRACTION_TWO_PHASE)
        end = sharpened(end, s.from, layer, f);
    w.hit = hit;
    through.end = end_behind(end, w, through.ray, bent_by_method(0, hit));
    through.doubtful = narrow_data.edge_rays > 0 && is_doubtful(f, layer);
    through.traced = narrow_data.method == REFRACTION_HYBRID;
    if (through.traced)
        through.traced = is_doubtful(f, layer) || passed_place(0, layer, s.from, f, f.column >= 0.0f ? 1.0f : 0.0f).inside > 0.0f;
    return through;
}
