/* SPDX-License-Identifier: MIT
 *
 * The layout of the buffers of method adaptive's cells, for C and GLSL; see cells_data.glsl. Places are counted in words of four bytes. A double has two words.
 */
#ifndef CELLS_LAYOUT_H
#define CELLS_LAYOUT_H

/* ---- the frame's words ---- */

#define CELLS_ROUND 0
#define CELLS_RUNNING 1       /* 1: rounds go on; 0: the refinement has ended */
#define CELLS_BUCKET 2        /* the round splits the cells above this bucket */
#define CELLS_POINTS 3        /* the round adds points to the leaves above this bucket */
#define CELLS_LEAST 4         /* leaves up to this bucket are settled */
#define CELLS_SHARE 5         /* the round splits this fraction of the cells in the bucket, a double */
#define CELLS_JOBS 9          /* number of the round's jobs; a job is the cells of one size in a tile */
#define CELLS_GROUPS 10       /* number of the round's groups; a group is cells of one job */
#define CELLS_POINT_TILES 11  /* number of the round's tiles with points */
#define CELLS_POINT_GROUPS 12 /* number of the round's groups of points; a group is points of one leaf */
#define CELLS_LEAVES 13       /* number of open leaves */
#define CELLS_USED 14         /* evaluations before the round, a double */

/* Sizes of indirect dispatches, four words each. */
#define CELLS_SIZES 64
#define CELLS_BATCHES 16
#define CELLS_TILES_SIZE CELLS_SIZES
#define CELLS_SORT_SIZE (CELLS_TILES_SIZE + 4)
#define CELLS_SHADE_SIZE (CELLS_SORT_SIZE + 4 * CELLS_BATCHES)
#define CELLS_POINT_SORT_SIZE (CELLS_SHADE_SIZE + 4 * CELLS_BATCHES)
#define CELLS_POINT_SIZE (CELLS_POINT_SORT_SIZE + 4 * CELLS_BATCHES)
#define CELLS_SIZES_END (CELLS_POINT_SIZE + 4 * CELLS_BATCHES)

/* Cost of the leaves of each bucket: two words for cells, then two for points, the lower word first. */
#define CELLS_CENSUS 512
#define CELLS_TILES (CELLS_CENSUS + 4 * WORTH_BUCKETS)

/* ---- a tile's words ---- */

#define TILE_FIRST 0        /* place of its first leaf in the pool */
#define TILE_LEAVES 1       /* number of its leaves */
#define TILE_NEXT 2         /* place of its leaves in the other side of the pool: those that stay, then new cells, then those that take points */
#define TILE_KEPT 3         /* number that stay */
#define TILE_CHILDREN 4     /* number of new cells */
#define TILE_POINT_LEAVES 5 /* number that take points */
#define TILE_JOBS 6
#define TILE_GROUPS 7
#define TILE_POINT_GROUPS 8
#define TILE_JOB_FIRST 9
#define TILE_GROUP_FIRST 10
#define TILE_POINT_TILE 11
#define TILE_POINT_FIRST 12
#define TILE_DARK 13                             /* 1: the tile mirrors no light, and the mirrored sky needs no pieces of the shutter */
#define TILE_WAVES 14                            /* number of resolved and mixed waves of its pixels */
#define TILE_SPENT 16                            /* evaluations, a double */
#define TILE_VARIANCE 18                         /* squared error of the coverage of settled leaves, a double */
#define TILE_SHOWN 20                            /* squared error of the displayed luminance of settled leaves, a double */
#define TILE_OPEN_VARIANCE 22                    /* squared error of the coverage of open leaves, a double */
#define TILE_OPEN_SHOWN 24                       /* squared error of the displayed luminance of open leaves, a double */
#define TILE_WATER 26                            /* pixels of water, a double */
#define TILE_COST 32                             /* for each level the evaluations of a cell, doubles; 0: unknown */
#define TILE_BELOW (TILE_COST + 2 * LEAF_LEVELS) /* for each level the cost of splitting a cell, in units of 1 / COST_UNIT */
#define TILE_WORTH (TILE_BELOW + LEAF_LEVELS)    /* for each level the worth of such a split per unit of squared error, floats */
#define TILE_SIZES 72                            /* for each size the number of leaves that are split into cells of that size: see cell_size() */
#define CELL_SIZES (LEAF_LEVELS * LEAF_LEVELS - 1)
#define CELLS_TILE_WORDS (TILE_SIZES + CELL_SIZES)

/* ---- lists ---- */

#define JOB_WORDS 4          /* tile; halvings across, down and class, a byte each; waves */
#define GROUP_WORDS 4        /* job; first cell in the pool; count */
#define POINT_GROUP_WORDS 16 /* leaf in the pool; place of its tile in the list of tiles; which of its groups; then sums, doubles */
#define POINT_SUMS_AT 4
#define POINT_SUMS 6 /* colour, coverage, water and the square of the luminance */

/* ---- workgroups ---- */

#define CELLS_GROUP 64  /* cells of a workgroup, or leaves of a tile that are processed together */
#define POINT_GROUP 32  /* points of a leaf at one instant */
#define CELLS_LANES 256 /* invocations of passes over all tiles */

/* ---- wave sets, in words of 16 bytes: waves, as they are sorted, then views ---- */

#define SET_WAVE_VECTORS 6
#define SET_SORT_VECTORS 2
#define SET_VIEW_VECTORS 10
#define SET_VIEWS (CELL_SIZES + 1) /* of pixels, then of each size of cells */

/* ---- a leaf in the pool, words of 16 bytes ---- */

#define LEAF_VECTORS 3

/* CellsData.mode of cells_grow.comp: the leaves that it reads. */
#define GROW_PIXELS 0 /* pixels, from cells_plant.comp */
#define GROW_ROUND 1  /* the result of a round */
#define GROW_END 2    /* the last leaves, which are all settled */

#endif
