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
#define SEARCH_WAVE(cx, i) SearchWave(waves[i].turns_x, waves[i].turns_z, waves[i].phase, waves[i].even_height, waves[i].shift * waves[i].k_x, waves[i].shift * waves[i].k_z, 0.0, 0.0)
#define SKY_TEXEL(cx, column, row) vec3(0.0) /* coverage asks for no sky */
#include "mangata_glitter.glsl"

layout(location = 0) out float coverage;

/* Waves come longest first: those below a quarter of a cycle a pixel steer the first hit, the others would only add noise to it. */
int searched_waves(vec3 ray)
{
    Footprint pixel = footprint_at(0, ray, tile.camera_height / -ray.y);
    int count = 0;
    while (count < tile.mixed_count && wave_frequency(0, pixel, waves[count]) < 0.0625)
        count++;
    return count;
}

void main()
{
    tile = whole_image;
    PixelRay p = pixel_ray_filtered(0, gl_FragCoord.x - 0.5, gl_FragCoord.y - 0.5);
    coverage = 0.0;
    if (p.water > 0.0) {
        tile.search_count = tile.coarse_count = searched_waves(p.ray);
        SlopeState slopes = slope_state(0, p.ray, HitEstimate(0.0, 0.0, 1.0, vec2(0.0), vec2(0.0))); /* from the camera, search */
        coverage = p.water * glitter_coverage(0, slopes, slopes);
    }
}
