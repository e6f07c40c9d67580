/* SPDX-License-Identifier: MIT
 *
 * Sizes and enums that C and GLSL share: macros that stand for numbers, for both languages read them. Those that an enum of the public headers has too
 * are compared with it in src/frame/constants.c.
 */
#ifndef MANGATA_KERNELS_COMMON_CONSTANTS_H
#define MANGATA_KERNELS_COMMON_CONSTANTS_H

/* ---- waves ---- */

#define MAX_WAVES 2048  /* of a scene */
#define BLOCK_WAVES 512 /* that uniform blocks hold, where waves stand in these: 48 KiB */

#define SKYLINE_MOST 4096 /* entries of a skyline */
#define SORT_KEYS 6       /* members of SortData that sort a wave, see tile.k */

/* WaveClass.kind: how a tile counts a wave. */
#define WAVE_UNRESOLVED 0
#define WAVE_RESOLVED 1
#define WAVE_MIXED 2

/* TileSums.value: what is summed over a tile's waves; from SUM_LARGEST on maxima. */
#define SUM_LOST 0     /* slope covariance xx, xz, zz that no pixel resolves, its octaves, and their squares */
#define SUM_SEARCHED 5 /* of all searched waves: height, slope, bend, each followed by its variance */
#define SUM_COARSE 11  /* of the largest ones */
#define SUM_REST 17    /* height of the others, and its variance */
#define SUM_LARGEST 19 /* squared frequency of searched waves */
#define SUM_MOST 20    /* and on the screen */
#define TILE_SUMS 21

/* ---- the picture's lattice ---- */

/* Tiles of one fixed lattice of the whole image, whatever the crop. */
#define TILE_WIDTH 32
#define TILE_HEIGHT 16
#define TILE_PIXELS (TILE_WIDTH * TILE_HEIGHT)

/* Hits of a pixel in grazing water at most, one above the other. */
#define HIT_ROWS 2
#define WALK_PARTS 4 /* of a column of hits at the horizon */
#define HIT_FLOATS 5 /* that are kept of one: see HitEstimate */
#define TILE_FLOATS (TILE_PIXELS * HIT_ROWS * HIT_FLOATS)

/* Nodes of a tile's lattice of first hits; they lie on the tile's edges too. The water is foreshortened down the screen, seldom across. */
#define NODE_STEP_X 8
#define NODE_STEP_Y 4
#define NODE_COLUMNS (TILE_WIDTH / NODE_STEP_X + 1)
#define NODE_ROWS (TILE_HEIGHT / NODE_STEP_Y + 1)
#define NODE_COUNT (NODE_COLUMNS * NODE_ROWS)
#define NODE_FLOATS 11

/* ---- workgroups of shaders ---- */

#define GROUP_SIDE 8 /* pixels along a side of a workgroup over pixels of the picture */
#define GROUP_ROWS 4 /* of a workgroup over pixels of a tile, which is as wide as the tile */
#define GROUPS_A_TILE (TILE_HEIGHT / GROUP_ROWS)
#define LIST_GROUP 64 /* entries of a list in a workgroup over a list */

/* ---- tables ---- */

/* The sky's radiance around the light, see sky.k. */
#define SKY_COLUMNS 192
#define SKY_ROWS 96

/* Below it, what the air before the water does; see air.k. */
#define AIR_ROWS 32

/* Below these, the stars; see stars.k. */
#define STAR_CLEAR_ROW (SKY_ROWS + AIR_ROWS + 1)
#define STAR_CELL_ROW (STAR_CLEAR_ROW + 1)
#define STAR_CELLS 64 /* along a side of the square around the hemisphere's map */
#define STAR_ROW (STAR_CELL_ROW + 22)
#define STAR_COUNT (22 * SKY_COLUMNS)
#define STARS_A_CELL 16  /* at most */
#define STAR_SPOT 1.7610 /* radius in pixels of a star's spot, see stars.k */
#define SKY_TABLE_ROWS (STAR_ROW + 22)

/* Circular kernels of podee-*, see podee_mixture.k. As a texture the slices of the sweep stand side by side. */
#define PODEE_COLUMNS 512
#define PODEE_ROWS 512
#define PODEE_SLICES 64
#define PODEE_SLICES_ACROSS 8

/* The map of slope moments: texels along a side of level 0. */
#define LEAN_SIZE 4096

/* Objects' materials as a table of RGBA texels: linear values of all codes of a texture's channel, waves that make caustics, then the materials. */
#define TEXTURE_CODES 256
#define CODE_TEXELS (TEXTURE_CODES / 4)
#define MATERIAL_TEXELS 4

/* ---- glare: a level's spline weights of the nearer and of the farther coarse texel, each way ---- */

#define GLARE_NEAR 0.75f
#define GLARE_FAR 0.25f

/* ---- a tree of boxes over triangles, see gl_bvh.h ---- */

#define BVH_LEVELS 32        /* no path is longer */
#define BVH_LEAF_TRIANGLES 4 /* at most */
#define BVH_NODE_TEXELS 4
#define BVH_LEAF 0x80000000u
#define BVH_NOTHING 0xffffffffu /* counts as a leaf */

/* ---- objects ---- */

#define EDGE_PLACES 8          /* of a pixel, that look for objects at edges */
#define EDGE_RAYS 4            /* of a pixel at an outline behind the surface, besides that through its centre */
#define SURFACE_STEPS 128      /* triangles that a ray goes through to find its own */
#define SHARP_PLACES 16        /* pixels along a ray's image in a layer that are asked where the search did not converge */
#define AROUND_PLACES 24       /* pixels around the search's last one that are asked where the ray met nothing at those */
#define IN_DRY_HULL (-1.0f)    /* metres of water before a hit inside a dry hull: light reaches it as in air */
#define FRONT_SHOWS 0.5f       /* share of a pixel from which on objects in front of the water are what depth and normal show */
#define TRACE_START (1 - 2e-6) /* of the way to the surface, where rays begin: rounding must not put them behind a wall that stands in the water */

/* RefractData.map: where triangles beyond the surface are drawn. */
#define MAP_STRAIGHT 0 /* where they are, as if there were no water: off, narrow, screen-space */
#define MAP_SAGITTAL 1 /* at their sagittal images: two-phase, hybrid, broad */
#define MAP_PATH 2     /* along the camera's ray at the length of the refracted path: liu */

/* Pictures of objects that points are looked up in. */
#define LAYER_REFRACTED 0 /* what lies beyond the surface */
#define LAYER_REFLECTED 1 /* what the surface mirrors */

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

/* Lists of a band's pixels, and what is kept of each pixel's water: see objects_pixel.glsl. */
#define LIST_FRONT 0
#define LIST_EDGES 1
#define LIST_THROUGH 2
#define LIST_DEEP 3
#define LIST_TRACED 4
#define LISTS 5
#define WATER_FLOATS 41
#define WATER_THROUGH 17 /* the place of the flag */
#define WATER_LIGHT 18
#define WATER_RAYS 21
#define RAY_FLOATS 10

/* How often a ray behind the surface is followed where it meets it again. */
#define MOST_AGAIN 6
/* A part of its light that is as large stands for all of it. */
#define LEAST_WHOLE 0.98f

/* ---- method adaptive, scheme podee: see slots_data.glsl ---- */

#define SLOT_GROUP 64     /* slots of a workgroup */
#define SLOT_GROUPS 32768 /* workgroups in a row of a dispatch, at most */
#define SLOT_FLOATS 5     /* a result: colour, coverage, water */
#define TASK_LANES 128    /* invocations over a tile's tasks */

/* ---- method adaptive: the leaves of its refinement, see refinement.k ---- */

#define LEAF_LEVELS 9                    /* a pixel has up to 4^8 cells */
#define LEAF_SIDES (2 * LEAF_LEVELS - 1) /* a pixel may be halved up to 16 times one way */
#define LEAF_SHARP_LEVEL 5               /* from which cells see glints so sharp that the bend of a path shows */
#define LEAF_PARTS 16                    /* straight pieces of the shutter, at most */
#define LEAF_INSTANTS 8                  /* of the shutter, that points are spread over */

/* Into 2 × 2, four rows or four columns, whatever makes the parts' shape on the water rounder; or points instead. */
#define SPLIT_EVEN 0
#define SPLIT_ROWS 1
#define SPLIT_COLUMNS 2
#define SPLIT_POINTS 3

#define LEAF_POINTS_PLACES 16 /* cells of more places are given points: splits would long say the same */
#define LEAF_POINTS_LEVEL 5   /* under a sky only from this level, for the model knows the mirrored sky well */
#define LEAF_LEAST_POINTS 256 /* of a leaf's first turn; every next turn gives it four times as many */
#define LEAF_MOST_POINTS 4096 /* of a leaf */

/* What a split is worth, counted in steps of a 32nd of an octave from 2^-80 on. */
#define WORTH_STEPS 32
#define WORTH_OCTAVES 96
#define WORTH_BUCKETS (WORTH_STEPS * WORTH_OCTAVES)
#define WORTH_ZERO 80
#define KEPT_OCTAVES 5 /* leaves worth less than 2^-5 of what was split last are settled */
#define KEPT_ROUNDS 2  /* rounds that settle none, for they take only the best */

#define COST_UNIT 65536 /* evaluations of all waves are counted in these parts */
/* What a cell and a point sample cost besides their waves, in waves of a cell; measured, as are the 11 tenths that a wave of a sample costs. */
#define CELL_WAVES 20
#define SAMPLE_WAVES 1
#define SAMPLE_TENTHS 11
/* Of a point, evaluations of all waves: points lie where rays graze, and search to their hits over every wave. Measured. */
#define POINT_COST 12

/* ---- options ---- */

/* FrameData.podee_kernels, an mgt_mixture; other numbers count circular kernels. */
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
