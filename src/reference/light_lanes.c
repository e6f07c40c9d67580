/* SPDX-License-Identifier: MIT
 *
 * Cells of the water in lanes: compiled once per lane count.
 *
 * The slopes that mirror a light with a small disk are −(h.x, h.z)/h.y for h = l − v, where l is any direction to the disk and v any direction in which the
 * camera sees the cell. With h = h₀ + Δ this is (slope of h₀) − (Δ.xz + slope · Δ.y)/(h₀.y + Δ.y). It is linear in Δ except for the denominator, for which
 * bounds take its least value. A cell is dark if along some direction in slope space the cell's slopes and these slopes do not overlap.
 */
#include "reference/double_lanes.h"
#include "reference/light_lanes.h"

#define PASTE(name, lanes) name##lanes
#define NAME(name, lanes) PASTE(name, lanes)
#define JUDGE NAME(reference_judge_, REFERENCE_LANES)

typedef struct lane_pair {
    reals x, z;
} lane_pair;

/* The slopes of a cell: the slope in its middle, its changes along the half sides by first derivatives, and bounds of the rest. */
typedef struct lane_slopes {
    lane_pair middle, along_a, along_b;
    reals rest[2]; /* along the two axes */
} lane_slopes;

/* Slopes that mirror a light. */
typedef struct lane_mirror {
    lane_pair slope;
    reals inverse; /* 1 / the least h.y */
    reals turn;    /* bound of |Δv|, the change of the view direction within the cell */
    masks bounded; /* the bounds hold */
} lane_mirror;

static inline reals dot_pair(lane_pair a, lane_pair b) { return fused(a.x, b.x, a.z * b.z); }

static inline reals size_pair(lane_pair a) { return absolute(a.x) + absolute(a.z); /* no less than its length */ }

static inline lane_mirror mirror_of(const light_disk *disk, const reals seen[3], lane_slopes *s, reals reach)
{
    const reals distance = square_root(fused(seen[0], seen[0], fused(seen[1], seen[1], seen[2] * seen[2])));
    const reals h_x = disk->direction[0] - seen[0] / distance, h_y = disk->direction[1] - seen[1] / distance, h_z = disk->direction[2] - seen[2] / distance;
    lane_mirror m = {.slope = {-h_x / h_y, -h_z / h_y}};
    const reals turn = reach / (distance - reach);
    m.turn = fused(turn, turn, turn);
    const reals least = h_y - (disk->sine + disk->sagitta) - m.turn;
    m.inverse = 1.0 / least;
    m.bounded = (masks)(reach < 0.5 * distance) & (masks)(least > 0.1 * h_y);
    return m;
}

/* Half extent of the slopes that mirror the light along a vector. */
static inline reals reach_along(const light_disk *disk, const lane_mirror *m, lane_pair along)
{
    const reals y = dot_pair(along, m->slope), square = fused(y, y, dot_pair(along, along));
    const reals by_light = fused(along.x, splat(disk->direction[0]), fused(y, splat(disk->direction[1]), along.z * disk->direction[2]));
    const reals light = disk->sine * square_root(greater(square - by_light * by_light, splat(0))) + disk->sagitta * absolute(by_light);
    return (light + m->turn * square_root(square)) * m->inverse;
}

static inline reals rest_along(const reference_cells *cells, const lane_slopes *s, lane_pair along)
{
    const reals first = along.x * cells->axes[0][0] + along.z * cells->axes[0][1], second = along.x * cells->axes[1][0] + along.z * cells->axes[1][1];
    return absolute(first) * s->rest[0] + absolute(second) * s->rest[1];
}

/* Whether the cell's slopes and the slopes that mirror the light do not overlap along a vector. */
static inline masks apart(const reference_cells *cells, const light_disk *disk, const lane_slopes *s, const lane_mirror *m, lane_pair along)
{
    const lane_pair gap = {s->middle.x - m->slope.x, s->middle.z - m->slope.z};
    const reals own = absolute(dot_pair(s->along_a, along)) + absolute(dot_pair(s->along_b, along)) + rest_along(cells, s, along);
    return (masks)(absolute(dot_pair(gap, along)) > own + reach_along(disk, m, along));
}

/* How many disks wide the cell is along the sides of the given half, in slopes: the greatest along the axes. */
static inline reals disks_across(const reference_cells *cells, const light_disk *disk, const lane_mirror *m, lane_pair half, const double rest[2], reals scale,
                                 reals other_scale)
{
    reals widest = splat(0);
    for (int i = 0; i < 2; i++) {
        const lane_pair axis = {splat(cells->axes[i][0]), splat(cells->axes[i][1])};
        const reals bend = fused(scale * rest[i], scale, 0.5 * cells->bend.both[i] * scale * other_scale);
        widest = greater(widest, (absolute(dot_pair(half, axis)) + bend) / reach_along(disk, m, axis));
    }
    return widest;
}

static inline masks judge_light(const reference_cells *cells, const light_disk *disk, const reals seen[3], lane_slopes *s, reals reach, reals scale_x,
                                reals scale_y)
{
    const lane_mirror m = mirror_of(disk, seen, s, reach);
    const lane_pair across[4] = {{splat(cells->axes[0][0]), splat(cells->axes[0][1])},
                                 {splat(cells->axes[1][0]), splat(cells->axes[1][1])},
                                 {-s->along_a.z, s->along_a.x},
                                 {-s->along_b.z, s->along_b.x}};
    masks dark = {0};
    for (int i = 0; i < 4; i++)
        dark |= apart(cells, disk, s, &m, across[i]);
    const reals wide_x = disks_across(cells, disk, &m, s->along_a, cells->bend.first, scale_x, scale_y);
    const reals wide_y = disks_across(cells, disk, &m, s->along_b, cells->bend.second, scale_y, scale_x);
    const masks halve = (masks)(greater(wide_x, wide_y) > cells->fair_share), by_x = (masks)(wide_x > wide_y);
    const masks halves = (by_x & CELL_HALVE_X) | (~by_x & CELL_HALVE_Y);
    const masks lit = (halve & halves) | (~halve & CELL_POINT);
    return (m.bounded & ~dark & lit) | (~m.bounded & CELL_POINT);
}

void JUDGE(const reference_frame *frame, reference_cells *cells, uint32_t count)
{
    for (uint32_t i = count; i % REFERENCE_LANES != 0; i++) { /* whole vectors: repeat the last place */
        cells->x[i] = cells->x[count - 1];
        cells->z[i] = cells->z[count - 1];
        cells->time_offset[i] = cells->time_offset[count - 1];
    }
    for (uint32_t at = 0; at < count; at += REFERENCE_LANES) {
        lane_hessian bend;
        const reals x = load(&cells->x[at]), z = load(&cells->z[at]);
        const lane_surface sum = waves_at_with_hessian(frame->waves, frame->wave_count, x, z, load(&cells->time_offset[at]), &bend);
        store(&cells->height[at], sum.height);
        store(&cells->slope_x[at], sum.slope_x);
        store(&cells->slope_z[at], sum.slope_z);

        const lane_pair a = {load(&cells->a_x[at]), load(&cells->a_z[at])}, b = {load(&cells->b_x[at]), load(&cells->b_z[at])};
        lane_slopes s = {.middle = {sum.slope_x, sum.slope_z},
                         .along_a = {fused(bend.xx, a.x, bend.xz * a.z), fused(bend.xz, a.x, bend.zz * a.z)},
                         .along_b = {fused(bend.xx, b.x, bend.xz * b.z), fused(bend.xz, b.x, bend.zz * b.z)}};
        const reals scale_x = load(&cells->scale_x[at]), scale_y = load(&cells->scale_y[at]);
        for (int i = 0; i < 2; i++)
            s.rest[i] =
                fused(scale_x * cells->bend.first[i], scale_x, fused(scale_x * cells->bend.both[i], scale_y, scale_y * cells->bend.second[i] * scale_y));
        const reals steepest = size_pair(s.middle) + size_pair(s.along_a) + size_pair(s.along_b) + s.rest[0] + s.rest[1];
        const reals reach = (size_pair(a) + size_pair(b)) * (1.0 + steepest);
        const reals seen[3] = {x - load(&cells->eye_x[at]), sum.height - load(&cells->eye_y[at]), z - load(&cells->eye_z[at])};
        masks verdict = {0};
        for (int i = 0; i < cells->lights; i++) {
            const masks by_light = judge_light(cells, &cells->disks[i], seen, &s, reach, scale_x, scale_y);
            const masks first = verdict == CELL_DARK;
            verdict = (first & by_light) | (~first & verdict);
        }
        store_mask(&cells->verdict[at], verdict);
    }
}
