/* SPDX-License-Identifier: MIT
 * The tree of boxes that shaders walk: what it holds, how deep it is, and what rays meet in it against all triangles in double precision. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "gl/gl_bvh.h"

enum { MOST = 20000, RAYS = 1000 };

static float unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (float)(*state >> 40) / 16777216.0f;
}

/* ---- shapes: every triangle has three vertices of its own ---- */

typedef void (*shape)(size_t triangle, size_t count, float corners[9]);

static void scattered(size_t triangle, size_t count, float corners[9])
{
    (void)count;
    uint64_t state = 77 * triangle + 5;
    float centre[3];
    unit(&state);
    for (int k = 0; k < 3; k++)
        centre[k] = 10 * unit(&state) - 5;
    for (int k = 0; k < 9; k++)
        corners[k] = centre[k % 3] + 0.6f * (unit(&state) - 0.5f);
}

/* All in the same place. */
static void stacked(size_t triangle, size_t count, float corners[9])
{
    (void)triangle, (void)count;
    static const float one[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    memcpy(corners, one, sizeof one);
}

/* Points and lines. */
static void degenerate(size_t triangle, size_t count, float corners[9])
{
    (void)count;
    for (int k = 0; k < 9; k++)
        corners[k] = (float)(triangle % 97) + (triangle % 2 && k >= 6 ? 1.0f : 0.0f);
}

/* Each twice as far away and as large as the one before: planes between equal bins split off one at a time. */
static void doubling(size_t triangle, size_t count, float corners[9])
{
    (void)count;
    const float size = ldexpf(1, (int)(triangle % 120) - 100);
    const float one[9] = {size, 0, 0, 1.2f * size, 0, 0, size, 0.3f * size, 0.1f * size};
    memcpy(corners, one, sizeof one);
}

static void sheet(size_t triangle, size_t count, float corners[9])
{
    const size_t side = count < 2 ? 1 : (size_t)sqrt((double)count / 2);
    const size_t cell = triangle / 2, x = cell % side, y = cell / side;
    static const int places[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    for (size_t c = 0; c < 3; c++) {
        const int *at = places[3 * (triangle % 2) + c];
        const float i = (float)((int)x + at[0]), j = (float)((int)y + at[1]);
        const float place[3] = {0.1f * i, 0.2f * sinf(0.3f * i) * cosf(0.2f * j), 0.1f * j};
        memcpy(corners + 3 * c, place, sizeof place);
    }
}

static world make_world(shape place, size_t count)
{
    world w = {.version = 1, .vertex_count = 3 * count, .triangle_count = count};
    w.positions = malloc((9 * count + 1) * sizeof *w.positions);
    w.indices = malloc((3 * count + 1) * sizeof *w.indices);
    assert_non_null(w.positions);
    assert_non_null(w.indices);
    for (size_t i = 0; i < count; i++)
        place(i, count, w.positions + 9 * i);
    for (size_t i = 0; i < 3 * count; i++)
        w.indices[i] = (uint32_t)i;
    return w;
}

static void free_world(world *w)
{
    free(w->positions);
    free(w->indices);
}

static gl_bvh build(const world *w, uint32_t threads)
{
    thread_pool *pool = thread_pool_create(threads);
    assert_non_null(pool);
    gl_bvh b;
    assert_int_equal(gl_bvh_build(&b, w, pool), MGT_OK);
    thread_pool_destroy(pool);
    return b;
}

/* ---- the tree itself ---- */

typedef struct visit {
    const world *world;
    const gl_bvh *tree;
    uint8_t *seen;
    size_t nodes, leaves, deepest;
} visit;

static void place_of(const uint32_t texel[4], float out[3]) { memcpy(out, texel, 3 * sizeof *out); }

static void visit_triangle(visit *v, uint32_t triangle, const float low[3], const float high[3])
{
    assert_true(triangle < v->world->triangle_count);
    assert_int_equal(v->seen[triangle], 0);
    v->seen[triangle] = 1;
    for (size_t c = 0; c < 3; c++)
        for (size_t k = 0; k < 3; k++) {
            const float p = v->world->positions[3 * (size_t)v->world->indices[3 * (size_t)triangle + c] + k];
            assert_true(low[k] <= p && p <= high[k]);
        }
}

static void visit_child(visit *v, uint32_t child, const float low[3], const float high[3], size_t depth);

static void visit_node(visit *v, uint32_t texel, const float low[3], const float high[3], size_t depth)
{
    assert_true(texel % BVH_NODE_TEXELS == 0 && texel / BVH_NODE_TEXELS < v->tree->node_count);
    uint32_t(*t)[4] = v->tree->texels + texel;
    v->nodes++;
    v->deepest = depth + 1 > v->deepest ? depth + 1 : v->deepest;
    for (int side = 0; side < 2; side++) {
        float inner_low[3], inner_high[3];
        place_of(t[2 * side], inner_low);
        place_of(t[2 * side + 1], inner_high);
        for (int k = 0; k < 3 && v->world->triangle_count > 1; k++)
            assert_true(low[k] <= inner_low[k] && inner_low[k] <= inner_high[k] && inner_high[k] <= high[k]);
        visit_child(v, t[side][3], inner_low, inner_high, depth + 1);
    }
}

static void visit_child(visit *v, uint32_t child, const float low[3], const float high[3], size_t depth)
{
    if (!(child & BVH_LEAF)) {
        visit_node(v, child, low, high, depth);
        return;
    }
    const size_t texel = child & ~BVH_LEAF;
    assert_true(texel >= BVH_NODE_TEXELS * v->tree->node_count && texel < v->tree->texel_count);
    v->leaves++;
    for (size_t i = 0; i < BVH_LEAF_TRIANGLES; i++) {
        const uint32_t triangle = v->tree->texels[texel][i];
        if (triangle != BVH_NOTHING)
            visit_triangle(v, triangle, low, high);
        assert_true(i == 0 || triangle == BVH_NOTHING || v->tree->texels[texel][i - 1] < triangle);
    }
}

/* Every triangle once, in boxes that hold it and lie in each other. Returns the depth. */
static size_t check_tree(const world *w, const gl_bvh *b)
{
    static const float low[3] = {-INFINITY, -INFINITY, -INFINITY}, high[3] = {INFINITY, INFINITY, INFINITY};
    visit v = {.world = w, .tree = b, .seen = calloc(w->triangle_count + 1, 1)};
    assert_non_null(v.seen);
    visit_node(&v, 0, low, high, 0);
    for (size_t i = 0; i < w->triangle_count; i++)
        assert_int_equal(v.seen[i], 1);
    free(v.seen);
    assert_int_equal(v.nodes, b->node_count);
    assert_int_equal(v.leaves, b->leaf_count);
    assert_int_equal(b->texel_count, BVH_NODE_TEXELS * b->node_count + b->leaf_count);
    assert_true(v.deepest <= BVH_LEVELS);
    return v.deepest;
}

static void trees_hold_every_triangle(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        shape place;
    } shapes[] = {{"scattered", scattered}, {"stacked", stacked}, {"degenerate", degenerate}, {"doubling", doubling}, {"sheet", sheet}};
    static const size_t counts[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 33, 4096, 4097, MOST};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            world w = make_world(shapes[s].place, counts[c]);
            gl_bvh b = build(&w, 2);
            const size_t depth = check_tree(&w, &b);
            if (counts[c] == MOST)
                print_message("  %s: %zu triangles, %zu nodes, %zu leaves, %zu deep\n", shapes[s].name, counts[c], b.node_count, b.leaf_count, depth);
            gl_bvh_free(&b);
            free_world(&w);
        }
}

static void threads_change_nothing(void **state)
{
    (void)state;
    world w = make_world(scattered, MOST);
    gl_bvh first = build(&w, 1);
    for (uint32_t threads = 2; threads <= 4; threads++) {
        gl_bvh other = build(&w, threads);
        assert_int_equal(other.texel_count, first.texel_count);
        assert_memory_equal(other.texels, first.texels, first.texel_count * sizeof *first.texels);
        gl_bvh_free(&other);
    }
    gl_bvh_free(&first);
    free_world(&w);
}

/* ---- rays ---- */

typedef struct ray {
    double from[3], direction[3];
} ray;

/* Multiple of the ray; `margin`: by how much it stays within the edges, as a share of the sides. */
static double meet(const world *w, size_t triangle, const ray *r, double *margin)
{
    double p[3][3], a[3], b[3], o[3], q[3], s[3];
    for (size_t c = 0; c < 3; c++)
        for (size_t k = 0; k < 3; k++)
            p[c][k] = (double)w->positions[3 * (size_t)w->indices[3 * triangle + c] + k];
    for (int k = 0; k < 3; k++)
        a[k] = p[1][k] - p[0][k], b[k] = p[2][k] - p[0][k], o[k] = r->from[k] - p[0][k];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        q[k] = r->direction[i] * b[j] - r->direction[j] * b[i];
        s[k] = o[i] * a[j] - o[j] * a[i];
    }
    double det = 0, u = 0, v = 0, along = 0;
    for (int k = 0; k < 3; k++)
        det += a[k] * q[k], u += o[k] * q[k], v += r->direction[k] * s[k], along += b[k] * s[k];
    *margin = fmin(fmin(u, v), det - u - v) / det;
    if (det < 0)
        *margin = fmin(fmin(-u, -v), u + v - det) / -det;
    return along / det;
}

typedef struct answer {
    double along;
    int64_t triangle;
    bool clear; /* neither an edge nor a second triangle is so near that rounding could decide */
} answer;

static void add_answer(answer *a, double along, double margin, size_t triangle)
{
    if (!(margin > -1e-5) || !(along > 0))
        return;
    a->clear = a->clear && margin > 1e-5 && fabs(along - a->along) > 1e-5;
    if (along < a->along)
        a->along = along, a->triangle = (int64_t)triangle;
}

static answer by_all(const world *w, const ray *r)
{
    answer a = {INFINITY, -1, true};
    for (size_t i = 0; i < w->triangle_count; i++) {
        double margin;
        const double along = meet(w, i, r, &margin);
        add_answer(&a, along, margin, i);
    }
    return a;
}

static bool enters(const uint32_t low[4], const uint32_t high[4], const ray *r, double most)
{
    double begin = 0, end = most;
    float corner[2][3];
    place_of(low, corner[0]);
    place_of(high, corner[1]);
    for (int k = 0; k < 3; k++) {
        const double a = ((double)corner[0][k] - r->from[k]) / r->direction[k], b = ((double)corner[1][k] - r->from[k]) / r->direction[k];
        begin = fmax(begin, fmin(a, b));
        end = fmin(end, fmax(a, b));
    }
    return begin <= end;
}

static void by_child(const world *w, const gl_bvh *b, uint32_t child, const ray *r, answer *a, size_t *visits)
{
    ++*visits;
    if (child & BVH_LEAF) {
        const uint32_t *triangles = b->texels[child & ~BVH_LEAF];
        for (int i = 0; i < BVH_LEAF_TRIANGLES && triangles[i] != BVH_NOTHING; i++) {
            double margin;
            const double along = meet(w, triangles[i], r, &margin);
            add_answer(a, along, margin, triangles[i]);
        }
        return;
    }
    uint32_t(*t)[4] = b->texels + child;
    for (int side = 0; side < 2; side++)
        if (enters(t[2 * side], t[2 * side + 1], r, a->along))
            by_child(w, b, t[side][3], r, a, visits);
}

static void rays_meet_what_they_meet_among_all(void **state)
{
    (void)state;
    static const shape shapes[] = {scattered, sheet};
    for (size_t s = 0; s < 2; s++) {
        world w = make_world(shapes[s], s ? 5000 : 3000);
        gl_bvh b = build(&w, 2);
        uint64_t state_of_rays = 9;
        size_t clear = 0, met = 0, visits = 0;
        for (int i = 0; i < RAYS; i++) {
            ray r;
            for (int k = 0; k < 3; k++) {
                r.from[k] = (double)(14 * unit(&state_of_rays) - 7);
                r.direction[k] = (double)(5 * unit(&state_of_rays)) - (s && k == 1 ? 2.5 : 0) - r.from[k];
            }
            const answer expected = by_all(&w, &r);
            answer got = {INFINITY, -1, true};
            by_child(&w, &b, 0, &r, &got, &visits);
            assert_true(got.along == expected.along || !expected.clear);
            if (!expected.clear)
                continue;
            assert_int_equal(got.triangle, expected.triangle);
            clear++;
            met += expected.triangle >= 0;
        }
        print_message("  %zu of %d rays are clear of edges, %zu meet something; %.1f visits a ray\n", clear, RAYS, met, (double)visits / RAYS);
        assert_true(clear > RAYS * 9 / 10 && met > RAYS / 20);
        assert_true(visits < 150 * RAYS); /* all leaves would be over 1,000 */
        gl_bvh_free(&b);
        free_world(&w);
    }
}

/* ---- many ---- */

static void millions_of_triangles(void **state)
{
    (void)state;
    const size_t count = 2 * 1600 * 1600;
    world w = make_world(sheet, count);
    gl_bvh b = build(&w, 2);
    const size_t depth = check_tree(&w, &b);
    const double bytes = (double)(b.texel_count * sizeof *b.texels) / (double)count;
    print_message("  %zu triangles: %zu deep, %.1f bytes a triangle\n", count, depth, bytes);
    assert_true(bytes < 40);
    gl_bvh_free(&b);
    free_world(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_hold_every_triangle),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(rays_meet_what_they_meet_among_all),
        cmocka_unit_test(millions_of_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
