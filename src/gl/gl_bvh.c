/* SPDX-License-Identifier: MIT
 * Builds a bounding volume hierarchy over a world's triangles. A range of triangles is split at the plane that is cheapest by the surface area heuristic over
 * bins of centroids. If every plane would make some path too long, the range is halved. */
#include "gl/gl_bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bins of an axis. Ranges of at most 1/PARTS of the triangles, or of at most LEAST_PART triangles, are parts, which threads build in parallel. */
enum { BINS = 16, PARTS = 64, LEAST_PART = 4096 };

typedef struct box {
    float low[3], high[3];
} box;

/* A triangle and its box. */
typedef struct item {
    box box;
    uint32_t triangle;
} item;

/* Flag of a child while the tree is built. A child without a flag is the index of a node of the same tree. With BVH_LEAF it is the index of a leaf of that
 * tree. With CHILD_PART it is the index of a part, for whose root it stands. */
#define CHILD_PART 0x40000000u

typedef struct node {
    box boxes[2];
    uint32_t children[2];
} node;

typedef struct leaf {
    uint32_t triangles[BVH_LEAF_TRIANGLES];
} leaf;

/* A range of items that is built as a tree of its own. */
typedef struct part {
    size_t first, count;
    int levels; /* largest number of nodes on a path */
} part;

typedef struct tree {
    node *nodes;
    leaf *leaves;
    size_t node_count, node_room, leaf_count, leaf_room;
    uint32_t root;
    bool out_of_memory;
} tree;

typedef struct build_job {
    const world *world;
    item *items;
    part *parts;                  /* room for MOST_PARTS; NULL: the tree is built as a whole */
    size_t part_count, part_size; /* part_size: largest number of items of a part */
    tree *trees;                  /* a tree for each part */
} build_job;

/* A level has at most PARTS ranges that are larger than a part. Each of them is split into at most two parts. */
enum { MOST_PARTS = 2 * PARTS * BVH_LEVELS };

/* ---- boxes ---- */

static box empty_box(void) { return (box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}; }

static void box_add(box *b, const box *other)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = other->low[k] < b->low[k] ? other->low[k] : b->low[k];
        b->high[k] = other->high[k] > b->high[k] ? other->high[k] : b->high[k];
    }
}

/* Half the surface area of a box. */
static float box_area(const box *b)
{
    const float x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    return x * y + y * z + z * x;
}

static box box_of_triangle(const world *w, size_t triangle)
{
    box b = empty_box();
    for (size_t c = 0; c < 3; c++) {
        const float *p = w->positions + 3 * (size_t)w->indices[3 * triangle + c];
        box_add(&b, &(box){{p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
    }
    return b;
}

/* The box, wider on each side by at least four units in the last place, the error that rounding may have. */
static box widened(const box *b)
{
    box wide;
    for (int k = 0; k < 3; k++) {
        wide.low[k] = b->low[k] - 0x1p-21f * fabsf(b->low[k]);
        wide.high[k] = b->high[k] + 0x1p-21f * fabsf(b->high[k]);
    }
    return wide;
}

static box box_of_items(const item *items, size_t count)
{
    box b = empty_box();
    for (size_t i = 0; i < count; i++)
        box_add(&b, &items[i].box);
    return b;
}

/* Twice the coordinate of the box's centre. */
static float centroid(const item *i, int axis) { return i->box.low[axis] + i->box.high[axis]; }

/* ---- where to split ---- */

typedef struct bin {
    box box;
    size_t count;
} bin;

/* The bins of one axis. Bin i begins at the centroid() from + i / scale. */
typedef struct bins {
    float from, scale;
    bin bins[BINS];
} bins;

/* A plane that splits a range. The items in bins below `bin` of the axis come first. axis −1: no plane is allowed. */
typedef struct split {
    int axis, bin;
    float from, scale, cost;
} split;

static int bin_of(const item *i, int axis, float from, float scale)
{
    const float at = (centroid(i, axis) - from) * scale;
    return at > 0 ? at < BINS ? (int)at : BINS - 1 : 0;
}

/* Distributes the items over the bins of the three axes. */
static void fill_bins(const item *items, size_t count, bins out[3])
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const float c = centroid(&items[i], k);
            low[k] = c < low[k] ? c : low[k];
            high[k] = c > high[k] ? c : high[k];
        }
    for (int k = 0; k < 3; k++) {
        const float extent = high[k] - low[k];
        out[k].from = low[k];
        out[k].scale = extent > 0 ? BINS / extent : 0;
        out[k].scale = isfinite(out[k].scale) ? out[k].scale : 0;
        for (int b = 0; b < BINS; b++)
            out[k].bins[b] = (bin){empty_box(), 0};
    }
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            bin *b = &out[k].bins[bin_of(&items[i], k, out[k].from, out[k].scale)];
            box_add(&b->box, &items[i].box);
            b->count++;
        }
}

/* Cost of a range by the surface area heuristic. A ray tests all triangles of a leaf, so the count is that of whole leaves. */
static float cost_of(const box *b, size_t count) { return box_area(b) * (float)((count + BVH_LEAF_TRIANGLES - 1) / BVH_LEAF_TRIANGLES); }

/* Puts the cheapest plane of an axis in `best` if it is cheaper than that. Neither side may hold more than `most` items. */
static void try_axis(const bins *b, int axis, size_t count, uint64_t most, split *best)
{
    float right[BINS];
    box from_right = empty_box(), from_left = empty_box();
    size_t beyond = 0, before = 0;
    for (int i = BINS - 1; i > 0; i--) {
        box_add(&from_right, &b->bins[i].box);
        beyond += b->bins[i].count;
        right[i] = cost_of(&from_right, beyond);
    }
    for (int i = 1; i < BINS; i++) {
        box_add(&from_left, &b->bins[i - 1].box);
        before += b->bins[i - 1].count;
        if (before == 0 || before == count || before > most || count - before > most)
            continue;
        const float cost = cost_of(&from_left, before) + right[i];
        if (cost < best->cost)
            *best = (split){axis, i, b->from, b->scale, cost};
    }
}

static split best_split(const item *items, size_t count, uint64_t most)
{
    bins b[3];
    fill_bins(items, count, b);
    split best = {.axis = -1, .cost = INFINITY};
    for (int axis = 0; axis < 3; axis++)
        try_axis(&b[axis], axis, count, most, &best);
    return best;
}

/* Moves the items of the first side to the front of the range. Returns their number. */
static size_t divide(item *items, size_t count, const split *s)
{
    size_t first = 0, last = count;
    while (first < last) {
        if (bin_of(&items[first], s->axis, s->from, s->scale) < s->bin) {
            first++;
        } else {
            const item other = items[--last];
            items[last] = items[first];
            items[first] = other;
        }
    }
    return first;
}

/* ---- growing ---- */

/* Enlarges `list` if it has no room for one more element of `size` bytes. False: out of memory, `list` is unchanged. */
static bool has_room(void **list, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return true;
    const size_t more = 2 * *room + 64;
    void *grown = realloc(*list, more * size);
    if (!grown)
        return false;
    *list = grown;
    *room = more;
    return true;
}

/* Adds a node, whose members are not set, and returns its index. If memory runs out, it sets out_of_memory and returns 0. */
static uint32_t add_node(tree *t)
{
    void *nodes = t->nodes;
    if (!has_room(&nodes, t->node_count, &t->node_room, sizeof *t->nodes)) {
        t->out_of_memory = true;
        return 0;
    }
    t->nodes = nodes;
    return (uint32_t)t->node_count++;
}

/* Adds a leaf and sorts its triangles. Returns it as a child. If memory runs out, it sets out_of_memory and returns 0. */
static uint32_t add_leaf(tree *t, const item *items, size_t count)
{
    void *leaves = t->leaves;
    if (!has_room(&leaves, t->leaf_count, &t->leaf_room, sizeof *t->leaves)) {
        t->out_of_memory = true;
        return 0;
    }
    t->leaves = leaves;
    leaf *l = &t->leaves[t->leaf_count];
    for (size_t i = 0; i < BVH_LEAF_TRIANGLES; i++) {
        size_t at = i;
        const uint32_t triangle = i < count ? items[i].triangle : BVH_NOTHING;
        for (; at > 0 && l->triangles[at - 1] > triangle; at--)
            l->triangles[at] = l->triangles[at - 1];
        l->triangles[at] = triangle;
    }
    return BVH_LEAF | (uint32_t)t->leaf_count++;
}

static uint32_t add_part(build_job *job, size_t first, size_t count, int levels)
{
    job->parts[job->part_count] = (part){first, count, levels};
    return CHILD_PART | (uint32_t)job->part_count++;
}

/* Builds the tree of a range of items and returns its root as a child: see CHILD_PART. A path may pass at most `levels` nodes. So a side may hold at most
 * BVH_LEAF_TRIANGLES · 2^(levels − 1) items, which halves never exceed. */
static uint32_t grow(build_job *job, tree *t, size_t first, size_t count, int levels)
{
    item *items = job->items + first;
    if (count <= BVH_LEAF_TRIANGLES)
        return add_leaf(t, items, count);
    if (job->parts && count <= job->part_size)
        return add_part(job, first, count, levels);
    const uint32_t at = add_node(t);
    const uint64_t most = (uint64_t)BVH_LEAF_TRIANGLES << (levels - 1);
    const split s = best_split(items, count, most);
    const size_t left = s.axis < 0 ? count / 2 : divide(items, count, &s);
    if (t->out_of_memory)
        return 0;
    node n = {.boxes = {box_of_items(items, left), box_of_items(items + left, count - left)}};
    n.children[0] = grow(job, t, first, left, levels - 1);
    n.children[1] = grow(job, t, first + left, count - left, levels - 1);
    t->nodes[at] = n;
    return at;
}

static void grow_part(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    build_job *job = argument;
    const part *p = &job->parts[index];
    build_job whole = *job;
    whole.parts = NULL;
    job->trees[index].root = grow(&whole, &job->trees[index], p->first, p->count, p->levels);
}

/* ---- the list of texels ---- */

/* First texels of a tree's nodes and of its leaves. */
typedef struct start {
    size_t node, leaf;
} start;

/* The child as gl_bvh.h defines it. `of` is where the child's own tree begins, `parts` where the parts begin. */
static uint32_t address(uint32_t child, const start *of, const start *parts, const build_job *job)
{
    if (child & BVH_LEAF)
        return BVH_LEAF | (uint32_t)(of->leaf + (child & ~BVH_LEAF));
    if (child & CHILD_PART) {
        const size_t i = child & ~CHILD_PART;
        return address(job->trees[i].root, &parts[i], parts, job);
    }
    return (uint32_t)(of->node + BVH_NODE_TEXELS * child);
}

static void put_texel(uint32_t out[4], const float place[3], uint32_t number)
{
    memcpy(out, place, 3 * sizeof *place);
    out[3] = number;
}

static void put_tree(const tree *t, const start *at, const start *parts, const build_job *job, gl_bvh *out)
{
    for (size_t i = 0; i < t->node_count; i++) {
        const node *n = &t->nodes[i];
        uint32_t(*texels)[4] = out->texels + at->node + BVH_NODE_TEXELS * i;
        const box left = widened(&n->boxes[0]), right = widened(&n->boxes[1]);
        put_texel(texels[0], left.low, address(n->children[0], at, parts, job));
        put_texel(texels[1], left.high, address(n->children[1], at, parts, job));
        put_texel(texels[2], right.low, 0);
        put_texel(texels[3], right.high, 0);
    }
    if (t->leaf_count > 0)
        memcpy(out->texels + at->leaf, t->leaves, t->leaf_count * sizeof *t->leaves);
}

/* Writes the list of texels: the nodes of the top of the tree, whose root is the first one, and those of the parts, then the leaves in the same order. */
static mgt_status put_all(const tree *top, const build_job *job, gl_bvh *out)
{
    out->node_count = top->node_count;
    out->leaf_count = top->leaf_count;
    for (size_t i = 0; i < job->part_count; i++) {
        out->node_count += job->trees[i].node_count;
        out->leaf_count += job->trees[i].leaf_count;
    }
    out->texel_count = BVH_NODE_TEXELS * out->node_count + out->leaf_count;
    out->texels = malloc(out->texel_count * sizeof *out->texels);
    start *parts = malloc((job->part_count + 1) * sizeof *parts);
    if (!out->texels || !parts) {
        free(parts);
        return MGT_ERROR_MEMORY;
    }
    const start begin = {0, BVH_NODE_TEXELS * out->node_count};
    start at = {BVH_NODE_TEXELS * top->node_count, begin.leaf + top->leaf_count};
    for (size_t i = 0; i < job->part_count; i++) {
        parts[i] = at;
        at.node += BVH_NODE_TEXELS * job->trees[i].node_count;
        at.leaf += job->trees[i].leaf_count;
    }
    put_tree(top, &begin, parts, job, out);
    for (size_t i = 0; i < job->part_count; i++)
        put_tree(&job->trees[i], &parts[i], parts, job, out);
    free(parts);
    return MGT_OK;
}

/* ---- the whole ---- */

/* Triangles whose boxes a thread computes at a time. */
enum { BLOCK = 65536 };

static void fill_items(void *argument, size_t index, uint32_t worker)
{
    (void)worker;
    const build_job *job = argument;
    const size_t most = job->world->triangle_count, end = (index + 1) * BLOCK < most ? (index + 1) * BLOCK : most;
    for (size_t i = index * BLOCK; i < end; i++)
        job->items[i] = (item){box_of_triangle(job->world, i), (uint32_t)i};
}

/* Builds the tree of at most BVH_LEAF_TRIANGLES triangles, of which there may be none: a root with two leaves. */
static void grow_small(build_job *job, tree *t, size_t count)
{
    const size_t left = count / 2;
    const uint32_t at = add_node(t);
    node n = {.boxes = {box_of_items(job->items, left), box_of_items(job->items + left, count - left)}};
    for (int i = 0; i < 2; i++)
        if (!(n.boxes[i].low[0] <= n.boxes[i].high[0]))
            n.boxes[i] = (box){{0}, {0}};
    n.children[0] = add_leaf(t, job->items, left);
    n.children[1] = add_leaf(t, job->items + left, count - left);
    if (!t->out_of_memory)
        t->nodes[at] = n;
}

static void free_tree(tree *t)
{
    free(t->nodes);
    free(t->leaves);
}

static mgt_status build(build_job *job, thread_pool *pool, gl_bvh *out)
{
    const size_t count = job->world->triangle_count;
    tree top = {0};
    thread_pool_run(pool, &(thread_loop){.count = (count + BLOCK - 1) / BLOCK, .body = fill_items, .argument = job});
    if (count <= BVH_LEAF_TRIANGLES)
        grow_small(job, &top, count);
    else
        grow(job, &top, 0, count, BVH_LEVELS);
    thread_pool_run(pool, &(thread_loop){.count = job->part_count, .body = grow_part, .argument = job});
    bool lacks = top.out_of_memory;
    for (size_t i = 0; i < job->part_count; i++)
        lacks |= job->trees[i].out_of_memory;
    const mgt_status status = lacks ? MGT_ERROR_MEMORY : put_all(&top, job, out);
    free_tree(&top);
    for (size_t i = 0; i < job->part_count; i++)
        free_tree(&job->trees[i]);
    return status;
}

mgt_status gl_bvh_build(gl_bvh *out, const world *w, thread_pool *pool)
{
    *out = (gl_bvh){0};
    const size_t count = w->triangle_count;
    build_job job = {
        .world = w,
        .items = malloc((count + 1) * sizeof *job.items),
        .part_size = count / PARTS > LEAST_PART ? count / PARTS : LEAST_PART,
    };
    /* Fewer triangles would be a single part, and the top of the tree would have no root. */
    if (count > LEAST_PART) {
        job.parts = malloc(MOST_PARTS * sizeof *job.parts);
        job.trees = calloc(MOST_PARTS, sizeof *job.trees);
    }
    const bool lacks = !job.items || (count > LEAST_PART && (!job.parts || !job.trees));
    const mgt_status status = lacks ? MGT_ERROR_MEMORY : build(&job, pool, out);
    free(job.items);
    free(job.parts);
    free(job.trees);
    if (status != MGT_OK)
        gl_bvh_free(out);
    return status;
}

void gl_bvh_free(gl_bvh *b)
{
    free(b->texels);
    *b = (gl_bvh){0};
}
