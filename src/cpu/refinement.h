/* SPDX-License-Identifier: MIT
 * What method adaptive knows of a frame: the pixels and cells that may still be split, what that is worth, and the memory they live in. */
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

extern const uint8_t halvings[4][2]; /* of a pixel across and down, by shape */

/* A pixel or cell that may be split. */
typedef struct leaf {
    uint32_t column, row; /* within the tile, in cells of this size */
    uint8_t across, down; /* how often the pixel has been halved each way */
    uint8_t level;        /* (across + down) / 2 */
    uint8_t shape;        /* SPLIT_… of the split to come */
    bool chosen;          /* to be split in this round */
    uint16_t bucket;      /* of what a split is worth */
    uint16_t points;      /* samples that its values are the mean of; 0: it is a cell */
    float color[3], coverage, water, height, variance, contrast, places;
} leaf;

typedef struct refinement_tile {
    leaf *leaves;
    size_t count, capacity;
    double cost[LEVELS];  /* of a cell, evaluations of all waves; 0 as long as it is unknown */
    double below[LEVELS]; /* of the four cells that one of this level is split into, as far as is known */
    float worth[LEVELS];  /* of a split, for each unit of squared error */
    double spent;
    bool dark;             /* under a sky: no light is mirrored here, and what is mirrored of the sky needs no pieces of the shutter */
    double final_variance; /* of what is split no more: sum of squared errors of pixels' coverage */
    double final_shown;    /* the same of their displayed luminance, under a sky */
} refinement_tile;

/* The shutter in straight pieces. While the camera stands, sets[i] is over piece i; where it moves, sets[i] and sets[i + 1] are the instants around it. */
typedef struct shutter_parts {
    int count;
    wave_set *sets[MOST_PARTS + 1];
} shutter_parts;

struct refinement {
    const adaptive_frame *a;
    const picture_planes *out;
    uint32_t width, height; /* that the memory is for */
    uint32_t columns, rows;
    bool by_coverage; /* leaves are worth what they save of the coverage's error, not of the picture's */
    bool by_display;  /* under a sky, not by coverage: of the displayed picture's */
    refinement_tile *tiles;
    float *weight;                     /* a pixel's, squared */
    float *hit_height;                 /* of the surface where a pixel's ray meets it, metres; NAN where it is not all water */
    bool moves;                        /* the camera does */
    shutter_parts parts[CELL_CLASSES]; /* of pixels, of cells and of sharp cells */
    wave_set *instants[INSTANTS];      /* as points see them */
    tile_cells **cells;                /* one a worker */
    tile_cells **sums;                 /* one a worker, for the mean over the shutter's parts */
    struct census **census;            /* one a worker */
    size_t workers;
    RoundPlan plan;
    double done, share; /* of the budget, before this round and in it */
    int least_bucket;   /* leaves up to this one are settled */
    atomic_bool failed; /* memory was short */
};

/* ---- leaves ---- */

static inline LeafPlace place_of_leaf(const leaf *l) { return (LeafPlace){(int)l->column, (int)l->row, l->across, l->down}; }

/* The pixel that a leaf of the tile lies in. */
size_t leaf_pixel(const refinement *f, size_t tile, const leaf *l);
/* A leaf is final: its share of the pixel. */
void leaf_settle(const refinement *f, size_t tile, const leaf *l);
/* How many points it has after its next turn. */
int leaf_next_points(const leaf *l);
/* Of its split or points, evaluations of all waves. */
double leaf_cost(const refinement_tile *t, const leaf *l);
/* Adds a leaf, or settles it where a split is worth nothing. False: memory is short. */
bool refinement_add(const refinement *f, size_t tile, leaf l);
/* Cells of a size cost so many waves in each part of the shutter: what splits are worth from now on. */
void refinement_price(const refinement *f, refinement_tile *t, int level, int waves);

/* ---- rounds ---- */

/* Of cells of this level. */
const shutter_parts *refinement_parts(const refinement *f, const refinement_tile *t, int level);
/* Which leaves may be split for `budget` evaluations. False: none. */
bool refinement_plan(refinement *f, double budget, size_t round);
bool leaf_chosen(const refinement *f, size_t tile, const leaf *l);
/* Points for the chosen ones among the tile's first `end` leaves that take them (adaptive_points.c). False: memory is short. */
bool refinement_scatter_points(const refinement *f, size_t tile, size_t end, uint32_t worker);

/* Evaluations so far; pixels of water. */
double refinement_spent(const refinement *f);
double refinement_water(const refinement *f);

/* The RMSE over the picture that the leaves expect, of coverage or of the displayed luminance (0 to 1; under a black sky of coverage), and the target of it. */
typedef struct error_goal {
    double predicted, target; /* target 0: the frame has none, and nothing is predicted */
} error_goal;
error_goal refinement_goal(const refinement *f);

/* ---- memory ---- */

/* NULL where memory is short. */
refinement *refinement_make(const adaptive_frame *a, const picture_planes *out);
/* Ready for a frame: empty but for memory. */
void refinement_clear(refinement *f, const adaptive_frame *a, const picture_planes *out);

#endif
