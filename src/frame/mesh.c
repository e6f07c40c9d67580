/* SPDX-License-Identifier: MIT
 * Which triangles of a mesh share an edge.
 *
 * Vertices at one position count as one: meshes hold several where normals or texture coordinates differ. */
#include "frame/mesh.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

enum { MOST_AROUND = 64 }; /* most edges at a vertex that are compared; it bounds the time for hostile meshes */

/* Edges by the vertex at which they begin. Those of vertex v are edge[start[v]] … edge[start[v + 1] − 1]. Edge e of triangle t has the number 3 t + e. */
typedef struct edge_list {
    uint32_t *start, *edge;
} edge_list;

static uint64_t hash_of_position(const float p[3])
{
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        const float x = p[k] + 0.0f; /* turns −0 into 0 */
        uint32_t bits;
        memcpy(&bits, &x, sizeof bits);
        hash = hash_of(hash ^ bits);
    }
    return hash;
}

static bool same_position(const float a[3], const float b[3]) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

/* For each vertex the first vertex at its position. NULL: out of memory. */
static uint32_t *find_first(const mgt_mesh *m)
{
    size_t room = 16;
    while (room < 2 * (size_t)m->vertex_count)
        room *= 2;
    uint32_t *table = malloc(room * sizeof *table), *first = malloc((size_t)m->vertex_count * sizeof *first);
    if (!table || !first) {
        free(table);
        free(first);
        return NULL;
    }
    memset(table, 0xff, room * sizeof *table);
    for (uint32_t v = 0; v < m->vertex_count; v++) {
        const float *p = m->positions + 3 * (size_t)v;
        size_t at = (size_t)hash_of_position(p) & (room - 1);
        while (table[at] != UINT32_MAX && !same_position(p, m->positions + 3 * (size_t)table[at]))
            at = (at + 1) & (room - 1);
        if (table[at] == UINT32_MAX)
            table[at] = v;
        first[v] = table[at];
    }
    free(table);
    return first;
}

static bool list_edges(const mgt_mesh *m, const uint32_t *first, edge_list *l)
{
    const size_t edges = 3 * (size_t)m->triangle_count;
    l->start = calloc((size_t)m->vertex_count + 2, sizeof *l->start);
    l->edge = malloc(edges * sizeof *l->edge);
    if (!l->start || !l->edge)
        return false;
    for (size_t i = 0; i < edges; i++)
        l->start[first[m->indices[i]] + 2]++;
    for (size_t v = 2; v < (size_t)m->vertex_count + 2; v++)
        l->start[v] += l->start[v - 1];
    for (size_t i = 0; i < edges; i++)
        l->edge[l->start[first[m->indices[i]] + 1]++] = (uint32_t)i;
    return true;
}

static uint32_t next_edge(uint32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }

static uint32_t last_edge(uint32_t edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }

static uint32_t count_at(const edge_list *l, uint32_t vertex)
{
    const uint32_t count = l->start[vertex + 1] - l->start[vertex];
    return count < MOST_AROUND ? count : MOST_AROUND;
}

/* The triangle that has an edge from `end` to `begin`; −1: none. Of the two vertices, the search takes the one where fewer edges begin. */
static int32_t triangle_across(const mgt_mesh *m, const uint32_t *first, const edge_list *l, uint32_t begin, uint32_t end)
{
    const uint32_t at_begin = count_at(l, begin), at_end = count_at(l, end);
    const bool by_end = at_end <= at_begin;
    const uint32_t *edges = l->edge + l->start[by_end ? end : begin];
    for (uint32_t k = 0; k < (by_end ? at_end : at_begin); k++) {
        const uint32_t other = by_end ? first[m->indices[next_edge(edges[k])]] : first[m->indices[last_edge(edges[k])]];
        if (other == (by_end ? begin : end))
            return (int32_t)(edges[k] / 3);
    }
    return -1;
}

bool mesh_find_neighbours(mgt_mesh *m)
{
    edge_list l = {0};
    uint32_t *first = find_first(m);
    m->neighbours = malloc(3 * (size_t)m->triangle_count * sizeof *m->neighbours);
    const bool ready = first && m->neighbours && list_edges(m, first, &l);
    for (uint32_t i = 0; ready && i < 3 * m->triangle_count; i++)
        m->neighbours[i] = triangle_across(m, first, &l, first[m->indices[i]], first[m->indices[next_edge(i)]]);
    free(first);
    free(l.start);
    free(l.edge);
    return ready;
}
