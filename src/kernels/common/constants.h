/* SPDX-License-Identifier: MIT
 *
 * Sizes and enums that C and GLSL share. They are macros because both languages can read these. src/frame/constants.c compares them with the enums of the
 * public headers where these have them, too.
 */
#ifndef MANGATA_KERNELS_COMMON_CONSTANTS_H
#define MANGATA_KERNELS_COMMON_CONSTANTS_H

/* ---- waves ---- */

#define MAX_WAVES 2048  /* of a scene */
#define BLOCK_WAVES 512 /* waves that a uniform block holds, 48 KiB */

#define SKYLINE_MOST 4096 /* largest number of entries of a skyline */
#define SKYLINE_NONE 0    /* TileData.skyline where the horizon is the water's edge */
#define SORT_KEYS 6       /* members of SortData that sort a wave, see tile.k */

/* WaveClass.kind: how a tile counts a wave. */
#define WAVE_UNRESOLVED 0
#define WAVE_RESOLVED 1
#define WAVE_MIXED 2

/* Cycles per pixel from which nothing of a wave is resolved, f₀ of resolved.k. Methods podee-* and bruneton have ramps of their own, and so has
 * what is seen through the surface. */
#define RESOLVED_END 1.2f
#define RESOLVED_SCALE (1.0f / (RESOLVED_END * RESOLVED_END))

/* Pixels per wavelength between which method bruneton turns waves into geometry. */
#define BRUNETON_LEAST 1.0f
#define BRUNETON_MOST 2.5f

#define FACING_LEAST 0.4f /* a mean slope is turned until the eye sees at least this fraction of what it sees of level water, see facing_slope() */

/* Places of TileSums.value, the sums over a tile's waves; TILE_SUM_LARGEST and TILE_SUM_MOST are maxima. */
#define TILE_SUM_LOST 0     /* five values: slope covariance xx, xz, zz of the unresolved waves, filtered_octave, filtered_octave_sq */
#define TILE_SUM_SEARCHED 5 /* six values of all searched waves: height, slope and second derivative, each followed by its variance */
#define TILE_SUM_COARSE 11  /* the same six values of the largest searched waves */
#define TILE_SUM_REST 17    /* two values of the other searched waves: height and its variance */
#define TILE_SUM_LARGEST 19 /* largest squared frequency of a searched wave, (turns per metre)² */
#define TILE_SUM_MOST 20    /* largest squared frequency of a searched wave on the screen, (cycles per pixel)² */
#define TILE_SUMS 21

/* ---- the picture's lattice ---- */

/* Size of a tile in pixels. The tiles are those of one fixed lattice of the whole image, whatever the crop. */
#define TILE_WIDTH 32
#define TILE_HEIGHT 16
#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)

/* Largest number of hits, one above the other, of a pixel in grazing water. */
#define HIT_ROWS 8
#define WALK_PARTS 4 /* parts of a column of hits at the horizon */
#define HIT_FLOATS 5 /* floats that are kept of a hit: see HitEstimate */
/* Floats that are kept of a tile's hits, by FrameData.hit_rows. */
#define TILE_FLOATS(hit_rows) (TILE_PIXELS * HIT_FLOATS * ((hit_rows) > 1.0f ? HIT_ROWS : 1))

/* Nodes of a tile's lattice of first hits, which lie on the tile's edges, too. They are denser down the screen than across, because water is foreshortened
 * down the screen. */
#define NODE_STEP_X 8
#define NODE_STEP_Y 4
#define NODE_COLUMNS (TILE_WIDTH / NODE_STEP_X + 1)
#define NODE_ROWS (TILE_HEIGHT / NODE_STEP_Y + 1)
#define NODE_COUNT (NODE_COLUMNS * NODE_ROWS)
#define NODE_FLOATS 11

/* ---- workgroups of shaders ---- */

#define GROUP_SIDE 8 /* pixels along a side of a workgroup over pixels of the picture */
#define GROUP_ROWS 4 /* rows of a workgroup over pixels of a tile; it is as wide as the tile */
#define GROUPS_A_TILE (TILE_HEIGHT / GROUP_ROWS)
#define LIST_GROUP 64 /* entries of a workgroup over a list */

/* ---- tables ---- */

/* The sky's radiance around the light, see sky.k. */
#define SKY_COLUMNS 192
#define SKY_ROWS 96

/* The rows after those of the sky hold aerial perspective, see air.k. */
#define AIR_ROWS 32

/* The rows after those of the air hold the stars, see stars.k. */
#define STAR_CLEAR_ROW (SKY_ROWS + AIR_ROWS + 1)
#define STAR_CELL_ROW (STAR_CLEAR_ROW + 1)
#define STAR_CELLS 64 /* along a side of the square around the hemisphere's map */
#define STAR_ROW (STAR_CELL_ROW + 22)
#define STAR_COUNT (22 * SKY_COLUMNS)
#define STARS_A_CELL 16  /* largest number of stars in a cell */
#define STAR_SPOT 1.7610 /* radius in pixels of a star's spot, see stars.k */
#define SKY_TABLE_ROWS (STAR_ROW + 22)

/* Size of the tables for the circular kernels of podee-*, see podee_mixture.k. In a texture the sweep's slices stand side by side, PODEE_SLICES_ACROSS in a
 * row. */
#define PODEE_COLUMNS 512
#define PODEE_ROWS 512
#define PODEE_SLICES 64
#define PODEE_SLICES_ACROSS 8

/* The map of slope moments: texels along a side of level 0. */
#define LEAN_SIZE 4096

/* The table of objects' materials, in RGBA texels. It holds the linear values of all codes of a texture's channel, then the waves that make caustics, then
 * the materials. */
#define TEXTURE_CODES 256
#define CODE_TEXELS (TEXTURE_CODES / 4)
#define MATERIAL_TEXELS 4

/* ---- colour: luminance of linear sRGB (ITU-R BT.709) ---- */

#define LUMINANCE_RED 0.2126f
#define LUMINANCE_GREEN 0.7152f
#define LUMINANCE_BLUE 0.0722f

/* ---- glare: spline weights of the nearer and of the farther coarse texel, along each axis ---- */

#define GLARE_NEAR 0.75f
#define GLARE_FAR 0.25f

/* ---- the bounding volume hierarchy over triangles, see gl_bvh.h ---- */

#define BVH_LEVELS 32        /* longest path from the root to a leaf */
#define BVH_LEAF_TRIANGLES 4 /* largest number of triangles in a leaf */
#define BVH_NODE_TEXELS 4
#define BVH_LEAF 0x80000000u    /* bit of a child that is a leaf */
#define BVH_NOTHING 0xffffffffu /* a child that is absent; it counts as a leaf */

/* ---- objects ---- */

#define EDGE_PLACES 8          /* places in a pixel that look for objects at edges */
#define EDGE_PART 0.125f       /* part of the pixel's area, and so of its footprint's variances, that one of them stands for */
#define EDGE_STEPS 8           /* largest number of neighbouring triangles that the search for a place of an edge pixel follows */
#define EDGE_RAYS 4            /* rays of a pixel at an outline behind the surface, besides the one through its centre */
#define SURFACE_STEPS 128      /* largest number of triangles that a ray visits to find its own */
#define SHARP_PLACES 16        /* pixels along a ray's image in a layer that are tried where the search did not converge */
#define AROUND_PLACES 24       /* pixels around the search's last one that are tried where the ray met nothing in the SHARP_PLACES */
#define IN_DRY_HULL (-1.0f)    /* stands for the metres of water before a hit inside a dry hull, which light reaches as in air */
#define FRONT_SHOWS 0.5f       /* coverage of a pixel by objects in front of the water from which on depth and normal show these */
#define TRACE_START (1 - 2e-6) /* fraction of the way to the surface where rays begin, so that rounding puts none behind a wall that stands in the water */

/* RefractData.map: where triangles beyond the surface are drawn. */
#define MAP_STRAIGHT 0 /* where they are, as if there were no water: off, narrow, screen-space */
#define MAP_SAGITTAL 1 /* at their sagittal images: two-phase, hybrid, broad */
#define MAP_PATH 2     /* along the camera's ray at the length of the refracted path: liu */

/* Layers: pictures of objects in which points are looked up. */
#define LAYER_REFRACTED 0 /* objects beyond the surface */
#define LAYER_REFLECTED 1 /* objects that the surface mirrors */

/* NarrowData.method, an mgt_refraction. */
#define REFRACTION_TWO_PHASE 0
#define REFRACTION_HYBRID 1
#define REFRACTION_LIU 2
#define REFRACTION_BROAD 3
#define REFRACTION_NARROW 4
#define REFRACTION_SCREEN_SPACE 5
#define REFRACTION_OFF 7

/* HitMaterial.kind, an mgt_pattern. */
#define PATTERN_NONE 0
#define PATTERN_TILES 1
#define PATTERN_CHECKER 2
#define PATTERN_STRIPES 3

/* Lists of a band's pixels, and sizes and places of the values that are kept of each pixel's water: see objects_pixel.glsl. */
#define LIST_FRONT 0
#define LIST_EDGES 1
#define LIST_THROUGH 2
#define LIST_DEEP 3
#define LIST_TRACED 4
#define LISTS 5
#define WATER_FLOATS 43
#define WATER_THROUGH 17 /* place of the number that tells whether the pixel looks through the surface, see objects_pixel.glsl */
#define WATER_LIGHT 18
#define WATER_RAYS 21
#define RAY_FLOATS 11

/* How often a ray behind the surface is followed when it meets the surface again. */
#define MOST_AGAIN 6
/* A ray is not split if its greater part holds at least this fraction of the light. */
#define LEAST_WHOLE 0.98f

/* ---- method adaptive, scheme podee: see slots_data.glsl ---- */

#define SLOT_GROUP 64     /* slots of a workgroup */
#define SLOT_GROUPS 32768 /* largest number of workgroups in a row of a dispatch */
#define SLOT_FLOATS 5     /* floats of a result: colour, coverage, water */
#define TASK_LANES 128    /* invocations over a tile's tasks */

/* ---- method adaptive: the leaves of its refinement, see refinement.k ---- */

#define LEAF_LEVELS 9                    /* levels of the refinement: a pixel has up to 4^8 cells */
#define LEAF_SIDES (2 * LEAF_LEVELS - 1) /* a pixel may be halved up to 16 times one way */
#define LEAF_SHARP_LEVEL 5               /* level from which on glints in cells are so sharp that the bend of a path during the shutter shows */
#define LEAF_PARTS 16                    /* largest number of straight pieces of the shutter */
#define LEAF_INSTANTS 8                  /* instants of the shutter that points are spread over */

/* Classes of pixels and cells by the pieces of the shutter that they see, see leaf_class(). */
#define CELLS_WHOLE 0 /* the shutter as one piece: pixels, and if the camera stands still cells of tiles that mirror no light */
#define CELLS_PARTS 1 /* pieces */
#define CELLS_SHARP 2 /* the pieces of sharp cells */
#define CELL_CLASSES 3

/* How a leaf is refined: into 2 × 2 cells, four rows or four columns, whichever makes the parts rounder on the water, or by point samples. */
#define SPLIT_EVEN 0
#define SPLIT_ROWS 1
#define SPLIT_COLUMNS 2
#define SPLIT_POINTS 3

#define LEAF_POINTS_PLACES 16 /* cells with more places get points, because many splits would not change their result */
#define LEAF_POINTS_LEVEL 5   /* under a sky cells get points only from this level on, because the model is accurate for the mirrored sky */
#define LEAF_LEAST_POINTS 256 /* points of a leaf's first turn; every next turn gives it four times as many */
#define LEAF_MOST_POINTS 4096 /* largest number of points of a leaf */

/* The histogram of splits' worths: its buckets are 1 / WORTH_STEPS of an octave wide, and the first begins at 2^-WORTH_ZERO. */
#define WORTH_STEPS 32
#define WORTH_OCTAVES 96
#define WORTH_BUCKETS (WORTH_STEPS * WORTH_OCTAVES)
#define WORTH_ZERO 80
#define KEPT_OCTAVES 5  /* leaves worth less than 2^-5 of the worth that was split last are settled */
#define KEPT_HALVINGS 3 /* towards an error, also the leaves that so many halvings of the error need are kept */
#define KEPT_ROUNDS 2   /* number of first rounds that settle no leaf, because they take only the best */

#define COST_UNIT 65536 /* costs are counted in units of 1 / COST_UNIT of an evaluation of all waves */
/* Measured costs, in waves of a cell: CELL_WAVES of a cell besides its waves, SAMPLE_WAVES of a point sample besides its waves, SAMPLE_TENTHS tenths of each
 * wave of a point sample. */
#define CELL_WAVES 20
#define SAMPLE_WAVES 1
#define SAMPLE_TENTHS 11
/* Measured cost of a point in evaluations of all waves. Points lie where rays graze, and their hits are searched over every wave. */
#define POINT_COST 12

/* ---- options ---- */

/* FrameData.podee_kernels, an mgt_mixture; other values are the number of circular kernels. */
#define KERNELS_FELINE 32
#define KERNELS_RIEMANN 33

/* FrameData.tone_map, an mgt_tone_map. */
#define TONE_MAP_REINHARD 1
#define TONE_MAP_ACES 2
#define TONE_MAP_AGX 3

/* WindowData.color, an mgt_gl_color. */
#define HOST_COLOR_RADIANCE 0
#define HOST_COLOR_EXPOSED 1

#endif
