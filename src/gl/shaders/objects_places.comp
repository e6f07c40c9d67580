/* SPDX-License-Identifier: MIT
 *
 * What pixels see through the surface and mirrored by it, as the mean over several places of each pixel. The pixels of a workgroup belong to one tile, whose
 * waves they sum. On Mesa's llvmpipe the sums of pixels from several tiles would depend on which pixels share a workgroup.
 */
#define WEIGHTED_WAVES
#define OBJECTS_PASS
#include "lattice_data.glsl"
#include "kernels/glitter/glitter.k"
#include "objects_water.glsl"
#include "objects_through.glsl"
#include "objects_tracing.glsl"

layout(local_size_x = TILE_WIDTH, local_size_y = GROUP_ROWS) in;
layout(binding = 1) writeonly uniform image2D mirrored_image; /* as in objects_mirrored.comp */

void main()
{
    TilePixel where = tile_pixel();
    if (!where.inside)
        return;
    ivec2 texel = where.texel;
    int pixel = tile_slot * TILE_PIXELS + where.at.y * TILE_WIDTH + where.at.x;
    if (!is_through(pixel))
        return;
    int places = objects_data.places;
    float seen = 0.0f, error = 0.0f;
    vec3 color = vec3(0.0f);
    vec4 mirrored = vec4(0.0f);
    ivec2 image = texel + ivec2(pass_data.area_x, pass_data.area_y);
    bool edge = is_at_front(pixel);
    for (int i = 0; i <= places * places; i++) {
        /* The last place is the centre, for pixels whose others have no water or are hidden. */
        bool centre = i == places * places;
        if (centre && seen > 0.0f)
            break;
        vec2 at = centre ? vec2(0.0f) : (vec2(float(i % places), float(i / places)) + 0.5f) / float(places) - 0.5f;
        PixelWater water = water_at(where, at);
        if (!(water.share > 0.0f) || (edge && !centre && is_hidden(image, water, at)))
            continue;
        float part = 0.0f;
        vec3 place = vec3(0.0f);
        for (int branch = 0; branch < 2 && part < LEAST_WHOLE; branch++) {
            ThroughEnd through = end_through(water, branch);
            RayEnd end = through.end;
            if (through.traced)
                end = end_traced(water, through.ray);
            part = through.ray.part;
            place += part * shaded(end.triangle, end.ray);
            error = max(error, end.error);
        }
        color += place;
        if (objects_data.mirrors != 0)
            mirrored += mirrors_all(water) ? vec4(place, 1.0f) : seen_mirrored(water);
        seen += 1.0f;
    }
    imageStore(body_image, texel, vec4(color / max(seen, 1.0f), 1.0f));
    imageStore(error_image, texel, vec4(error));
    imageStore(mirrored_image, texel, mirrored / max(seen, 1.0f));
}
