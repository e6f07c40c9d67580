/* SPDX-License-Identifier: MIT
 * The state of method adaptive within a frame: the leaves of its refinement tree, the worth of their splits, and memory. */
#ifndef MANGATA_CPU_REFINEMENT_H
#define MANGATA_CPU_REFINEMENT_H

#include <stdatomic.h>

#include "cpu/adaptive.h"
#include "cpu/rounds_lane.h"
#include "frame/cell_waves.h"

enum {
    LEVELS = LEAF_LEVELS,
    SIDES = LEAF_SIDES,
    MOST_PARTS = LEAF_PARTS,
    INSTANTS = LEAF_INSTANTS,
};

extern const uint8_t halvings[4][2]; /* times that a split halves a leaf across and down, by SPLIT_… */

/* A pixel or cell that may still be split. */
typedef struct leaf {
    uint32_t column, row; /* place within the tile, in cells of this size */
    uint8_t across, down; /* number of times that the pixel has been halved across and down */
    uint8_t level;        /* (across + down) / 2 */
    uint8_t shape;        /* SPLIT_… of the next split */
    bool chosen;          /* this round splits the leaf */
    uint16_t bucket;      /* bucket of the split's worth, see leaf_bucket() */
    uint16_t points;      /* number of point samples whose mean the leaf's values are; 0: the leaf is a cell */
    float color[3], coverage, water, height, variance, contrast, places;
} leaf;

typedef struct refinement_tile {
    leaf *leaves;
    size_t count, capacity;
    double cost[LEVELS];   /* cost of a cell of each level, in evaluations of all waves; 0: unknown so far */
    double below[LEVELS];  /* cost of the four cells that a cell of each level is split into; estimated while it is unknown */
    float worth[LEVELS];   /* worth of a split per unit of squared error */
    double spent;          /* evaluations of all waves so far */
    bool dark;             /* tile_dark() of refinement.k */
    double final_variance; /* sum of the squared errors of settled leaves' coverage, each times its squared area */
    double final_shown;    /* sum of the squared errors of settled leaves' displayed luminance, each times its squared area; under a sky */
} refinement_tile;

/* The shutter in straight pieces. sets[i] is the wave set over piece i. */
typedef struct shutter_parts {
    int count;
    wave_set *sets[MOST_PARTS];
} shutter_parts;

struct refinement {
    const adaptive_frame *a;
    const picture_planes *out;
    uint32_t width, height; /* size of the picture that the memory is for */
    uint32_t columns, rows;
    bool by_coverage; /* splits are chosen by the error of coverage: quality.target_rmse is set */
    bool by_display;  /* splits are chosen by the error of the displayed picture: the sky is not black, and by_coverage is false */
    refinement_tile *tiles;
    float *weight;                     /* leaf_weight() of each pixel */
    float *hit_height;                 /* height of the surface at each pixel's hit, metres; NAN: the pixel is not all water */
    shutter_parts parts[CELL_CLASSES]; /* pieces of the shutter that leaves of each leaf_class() see */
    wave_set *instants[INSTANTS];      /* wave sets at the instants of point samples */
    tile_cells **cells;                /* one per worker */
    tile_cells **sums;                 /* one per worker: means over the shutter's pieces */
    struct census **census;            /* one per worker */
    size_t workers;
    RoundPlan plan;
    double done, share; /* fractions of the budget: spent before this round, and given to this round */
    int least_bucket;   /* leaves of buckets up to this one are settled */
    atomic_bool failed; /* out of memory */
};

/* ---- leaves ---- */

static inline LeafPlace place_of_leaf(const leaf *l) { return (LeafPlace){(int)l->column, (int)l->row, l->across, l->down}; }

/* The pixel that a leaf of the tile lies in. */
size_t leaf_pixel(const refinement *f, size_t tile, const leaf *l);
/* Adds a final leaf to its pixel. */
void leaf_settle(const refinement *f, size_t tile, const leaf *l);
/* Number of points that the leaf has after its next turn of points. */
int leaf_next_points(const leaf *l);
/* Cost of the leaf's split or of its next points, in evaluations of all waves. */
double leaf_cost(const refinement_tile *t, const leaf *l);
/* Adds a leaf, or settles it if no split is worth its cost. False: out of memory. */
bool refinement_add(const refinement *f, size_t tile, leaf l);
/* Sets the cost of a level's cells, which evaluate `waves` waves in each piece of the shutter, and with it the worth of splits. */
void refinement_price(const refinement *f, refinement_tile *t, int level, int waves);

/* ---- rounds ---- */

/* The pieces of the shutter that cells of this level see. */
const shutter_parts *refinement_parts(const refinement *f, const refinement_tile *t, int level);
/* Chooses the leaves that a round splits for `budget` evaluations. False: none. */
bool refinement_plan(refinement *f, double budget, size_t round);
/* Whether the round's plan splits the leaf. */
bool leaf_chosen(const refinement *f, size_t tile, const leaf *l);
/* Takes points for the chosen leaves of SPLIT_POINTS among the tile's first `end` ones (adaptive_points.c). False: out of memory. */
bool refinement_scatter_points(const refinement *f, size_t tile, size_t end, uint32_t worker);

/* Evaluations of all waves so far. */
double refinement_spent(const refinement *f);
/* Sum over pixels of their fraction of water. It is right only before the first round, when every leaf is a pixel, because open leaves are added without
 * their area. */
double refinement_water(const refinement *f);

/* RMSE over the picture: of coverage for quality.target_rmse; for quality.target_displayed of the displayed luminance, 0 to 1, or under a black sky of
 * coverage. */
typedef struct error_goal {
    double predicted; /* expected RMSE; 0 if there is no target */
    double target;    /* 0: the frame has none */
} error_goal;
error_goal refinement_goal(const refinement *f);

/* ---- memory ---- */

/* Allocates memory for a picture of this size. NULL: out of memory. */
refinement *refinement_make(const adaptive_frame *a, const picture_planes *out);
/* Empties the tree for a new frame. Memory stays. */
void refinement_clear(refinement *f, const adaptive_frame *a, const picture_planes *out);

#endif
