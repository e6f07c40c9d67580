/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface.
 */
#include "objects_behind.glsl"
#undef SEARCH_WAVE
#define SEARCH_WAVE(cx, i) wave_met_again(i)
#include "kernels/refraction/again.k"

layout(binding = 0) writeonly uniform image2D body_image;  /* radiance that comes through the surface */
layout(binding = 4) writeonly uniform image2D error_image; /* error of the point behind the surface, pixels */

/* ---- discontinuities of a layer ---- */

bool bends(int a, int b)
{
    return a != b && a >= 0 && b >= 0 && planes_bend(0, texelFetch(plane_table, a).xyz, texelFetch(plane_table, b).xyz);
}

/* Whether depth or normal are discontinuous at a texel of a layer, or the texel lies on the layer's border. */
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

/* Whether the layer does not prove that the point is the right one. */
bool is_doubtful(FoundPoint f, int layer)
{
    return f.column >= 0.0f && point_is_doubtful(0, f.residual, breaks_off(layer, ivec2(int(f.column), int(f.row))));
}

/* Replaces a doubtful end by the nearest point of the surfaces that the layer shows along the ray. */
RayEnd sharpened(RayEnd end, WaterHit hit, int layer, FoundPoint f)
{
    if (!is_doubtful(f, layer))
        return end;
    DoubtfulEnd doubtful = DoubtfulEnd(camera_position() + hit.along * turned(0, hit.view), end.ray.direction, layer, f.column, f.row, f.last_column, f.last_row,
                                       end.error, end.ray.after);
    ShownSurfaces s = surfaces_shown(0, doubtful, narrow_data.side < 0.0f);
    if (s.stands)
        return end;
    end.triangle = s.met;
    end.ray.after = s.met < 0 ? 0.0f : s.nearest;
    if (s.met >= 0)
        end.ray.position = doubtful.from + s.nearest * doubtful.direction;
    return end;
}

struct ThroughEnd {
    RayEnd end;
    TracedRay ray;
    bool traced;   /* the ray must be traced: the end is not valid */
    bool doubtful; /* the end is doubtful, and outlines get more rays */
};

/* What the pixel sees on a branch of again.k. If the surface reflects totally, that is on the camera's own side. */
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
    through.ray.unsure = s.unsure;
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
        through.traced = s.unsure > 0.0f || is_doubtful(f, layer) || passed_place(0, layer, s.from, f, f.column >= 0.0f ? 1.0f : 0.0f).inside > 0.0f;
    return through;
}
