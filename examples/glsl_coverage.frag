#version 450 core
/* SPDX-License-Identifier: MIT */
/* The coverage of each pixel by Mangata's kernels in a shader of one's own; docs/glsl.md explains it. examples/glsl_coverage.c fills the blocks
 * and puts the installed files in place of the #include lines. */
#include "mangata_types.glsl"

layout(std140, binding = 0) uniform FrameBlock { FrameData frame; };
layout(std140, binding = 1) uniform TileBlock { TileData whole_image; };
layout(std140, binding = 2) uniform WaveBlock { WaveData waves[128]; };

/* A variable of this pixel, since each has a list of waves of its own. */
TileData tile;

#define FRAME(cx) frame
#define TILE(cx) tile
#define CHOPPY(cx) 0
#define WAVE(cx, i) waves[i]
#define SEARCH_WAVE(cx, i) search_wave_of(cx, waves[i], waves[i].phase)
#define SKY_TEXEL(cx, column, row) vec3(0.0) /* coverage asks for no sky */
#include "mangata_glitter.glsl"

layout(location = 0) out float coverage;

/* Number of the waves, which come longest first, whose frequency squared is below `most`, (cycles a pixel)². */
int waves_below(vec3 ray, float most)
{
    Footprint pixel = footprint_at(0, ray, tile.camera_height / -ray.y);
    int count = 0;
    while (count < whole_image.mixed_count && wave_frequency(0, pixel, waves[count]) < most)
        count++;
    return count;
}

/* Of one hit; the row is the tile's. */
float coverage_at(float column, float row)
{
    PixelRay p = pixel_ray_filtered(0, column, row);
    if (p.water <= 0.0)
        return 0.0;
    /* Waves below a quarter of a cycle a pixel steer the first hit; the others would only add noise to it. Those below a tenth are resolved: while the
     * shutter is open they carry the others through the pixel. */
    tile.search_count = tile.coarse_count = waves_below(p.ray, 0.0625);
    tile.resolved_count = waves_below(p.ray, 0.01);
    tile.mixed_count = whole_image.mixed_count - tile.resolved_count;
    SlopeState slopes = slope_state(0, p.ray, HitEstimate(0.0, 0.0, 1.0, vec2(0.0), vec2(0.0))); /* from the camera, search */
    return p.water * glitter_coverage(0, slopes);
}

/* Several hits, one above the other: the tile's rows become theirs. The library takes up to four times as many far away, see docs/grazing.md. */
void split_rows(float hits)
{
    float part = 1.0 / hits, first = 0.5 * (part - 1.0); /* of the pixel, from its middle */
    tile.ray_x += first * tile.down_x;
    tile.ray_y += first * tile.down_y;
    tile.ray_z += first * tile.down_z;
    tile.down_x *= part;
    tile.down_y *= part;
    tile.down_z *= part;
    tile.horizon_steepness *= part;
    tile.horizon_inverse *= hits;
    tile.hit_rows = hits;
}

void main()
{
    tile = whole_image;
    float column = gl_FragCoord.x - 0.5, row = gl_FragCoord.y - 0.5;
    vec3 ray = pixel_ray_at(0, column, row);
    float fall = -ray.y / (length(ray.xz) * sqrt(tile.slope_variance)); /* in deviations of the water's slope: docs/grazing.md */
    tile.grazing = tile.refined = fall < frame.grazing_fall ? 1 : 0;
    float hits = fall < frame.hit_rows_fall ? frame.hit_rows : 1.0;
    split_rows(hits);
    coverage = 0.0;
    for (float hit = 0.0; hit < hits; hit++)
        coverage += coverage_at(column, hits * row + hit) / hits;
}
