/* SPDX-License-Identifier: MIT
 *
 * First hits of rays with choppy water, in which the water at rest at u is shifted to u + D(u). The lane builds include this file. Lanes are waves.
 *
 * The vertical plane of a ray, with the directions d along the ray and n across it, cuts the water along a curve of places at rest u = o + v d + w n. For each
 * v, Newton's steps find the w whose water lies in the plane. Along the curve, s(v) is the distance of the water from the eye, and g(v) the ray's height above
 * it. Sums of sines bound the derivatives of g, so that a step in v cannot pass its first zero. Where the water folds, s(v) only goes back a little. Sums are
 * over the longest waves alone if the others cannot reach the ray.
 */
#ifndef MANGATA_REFERENCE_CHOPPY_H
#define MANGATA_REFERENCE_CHOPPY_H

/* ---- the curve ---- */

typedef struct choppy_ray {
    const reference_frame *frame;
    double origin[3], time_offset;
    double along[2], across[2]; /* unit horizontal directions d and n */
    double rise;                /* height that the ray gains per horizontal metre */
} choppy_ray;

typedef struct curve_point {
    double along, across;   /* v, w */
    double distance;        /* s */
    double above;           /* g */
    double above_change;    /* dg/dv */
    double distance_change; /* ds/dv */
    double across_change;   /* dw/dv */
    choppy_sums sums;
} curve_point;

static inline double dot2(const double a[2], const double b[2]) { return a[0] * b[0] + a[1] * b[1]; }

static inline double between(const double a[2], const double m[3], const double b[2])
{
    return a[0] * (m[0] * b[0] + m[1] * b[1]) + a[1] * (m[1] * b[0] + m[2] * b[1]);
}

/* Largest error of the height above the water, as a fraction of it, at a point where the ray is still above the water. */
static const double most_doubt = 0.02;

/* The point at v. `across` is an estimate of its w. Newton's steps stay within the bound of the shift, and are replaced by bisection where they would leave it.
 * They end early if the ray is above `rest`, and the remaining distance to the plane cannot change its height above the water by more than the fraction
 * most_doubt; g and dg/dv are then lowered by as much. `rest` = +inf: they never end early. */
static curve_point curve_at(const choppy_ray *ray, const choppy_level *level, double v, double across, double rest)
{
    const reference_columns *c = &ray->frame->columns;
    double least = -level->shift, most = level->shift, w = fmin(fmax(across, least), most);
    const double fall = level->slope * level->most_stretch, rise = fabs(ray->rise) * level->most_stretch; /* upper bounds per metre of w */
    double doubt = 0, stretch = 1;
    choppy_sums sums = {0};
    for (int i = 0; i < 60; i++) {
        sums = choppy_sums_at(c, level->waves, ray->origin[0] + v * ray->along[0] + w * ray->across[0], ray->origin[2] + v * ray->along[1] + w * ray->across[1],
                              ray->time_offset);
        const double off = w + dot2(ray->across, sums.shift);
        stretch = between(ray->across, sums.stretch, ray->across);
        if (fabs(off) < 1e-10 * (1 + level->shift))
            break;
        const double above = ray->origin[1] + ray->rise * (v + dot2(ray->along, sums.shift)) - sums.height - rest;
        if (stretch > 0.5 && fabs(off) / stretch * (fall + rise) < most_doubt * above) {
            doubt = fabs(off) / stretch;
            break;
        }
        if (off > 0)
            most = w;
        else
            least = w;
        const double next = w - off / stretch;
        w = stretch > 0.05 && next > least && next < most ? next : 0.5 * (least + most);
    }
    curve_point p = {.along = v, .across = w, .sums = sums};
    p.across_change = -between(ray->across, sums.stretch, ray->along) / fmax(stretch, 0.05);
    p.distance = v + dot2(ray->along, sums.shift);
    p.above = ray->origin[1] + ray->rise * p.distance - sums.height - doubt * (fall + rise);
    p.distance_change = between(ray->along, sums.stretch, ray->along) + p.across_change * between(ray->along, sums.stretch, ray->across);
    p.above_change = ray->rise * p.distance_change - dot2(sums.slope, ray->along) - p.across_change * dot2(sums.slope, ray->across);
    p.above_change -= doubt * (level->bend + fabs(ray->rise) * level->shift_bend);
    return p;
}

/* Lower bound of the distance in v at which g reaches 0. Its derivative d falls by at most `bend` per metre and never below `least`. */
static double free_way(double g, double d, double least, double bend)
{
    const double until = fmax(d - least, 0) / bend, there = g + until * 0.5 * (d + least);
    if (there > 0)
        return until + there / -least;
    const double root = sqrt(d * d + 2 * g * bend);
    return d < 0 ? 2 * g / (root - d) : (root + d) / bend;
}

/* Slope of the surface, with the eigenvalues of the stretch bounded from below. */
static void choppy_slope(const choppy_sums *sums, double slope[2])
{
    const double middle = 0.5 * (sums->stretch[0] + sums->stretch[2]), half = 0.5 * (sums->stretch[0] - sums->stretch[2]);
    const double radius = hypot(half, sums->stretch[1]), angle = 0.5 * atan2(sums->stretch[1], half), c = cos(angle), s = sin(angle);
    const double first = fmax(middle + radius, 0.1), second = fmax(middle - radius, 0.1);
    const double p = (c * sums->slope[0] + s * sums->slope[1]) / first, q = (c * sums->slope[1] - s * sums->slope[0]) / second;
    slope[0] = c * p - s * q;
    slope[1] = s * p + c * q;
}

static void keep_hit(const choppy_ray *ray, const curve_point *p, double horizontal, reference_batch *batch, uint32_t i)
{
    double slope[2];
    choppy_slope(&p->sums, slope);
    batch->rest_x[i] = ray->origin[0] + p->along * ray->along[0] + p->across * ray->across[0];
    batch->rest_z[i] = ray->origin[2] + p->along * ray->along[1] + p->across * ray->across[1];
    batch->distance[i] = fmax(p->distance, 0) / horizontal;
    batch->slope_x[i] = slope[0];
    batch->slope_z[i] = slope[1];
}

/* Second derivatives of the surface at a hit. */
static void choppy_bend(const reference_frame *frame, reference_batch *batch, uint32_t i)
{
    if (!(batch->distance[i] < HUGE_VAL))
        return;
    const double slope[2] = {batch->slope_x[i], batch->slope_z[i]};
    choppy_sums sums;
    double bend[3];
    choppy_bend_at_rest(frame->waves, frame->wave_count, frame->choppiness, (const double[]){batch->rest_x[i], batch->rest_z[i], batch->time_offset[i]}, slope,
                        bend, &sums);
    /* B⁻¹ M B⁻¹ by the eigenvectors of B, whose eigenvalues are bounded as for the slope. */
    const double first[2] = {bend[0], bend[1]}, second[2] = {bend[1], bend[2]};
    double left[2], right[2], row[2], column[2];
    choppy_sums part = sums;
    memcpy(part.slope, first, sizeof first);
    choppy_slope(&part, left);
    memcpy(part.slope, second, sizeof second);
    choppy_slope(&part, right);
    row[0] = left[0], row[1] = right[0];
    column[0] = left[1], column[1] = right[1];
    memcpy(part.slope, row, sizeof row);
    choppy_slope(&part, left);
    memcpy(part.slope, column, sizeof column);
    choppy_slope(&part, right);
    batch->bend_xx[i] = left[0];
    batch->bend_xz[i] = left[1];
    batch->bend_zz[i] = right[1];
}

static void choppy_search(const reference_frame *frame, reference_batch *batch, uint32_t i)
{
    batch->distance[i] = HUGE_VAL;
    batch->slope_x[i] = batch->slope_z[i] = 0;
    if (!(batch->start[i] < HUGE_VAL))
        return;
    const double flat = hypot(batch->direction_x[i], batch->direction_z[i]), horizontal = fmax(flat, 1e-6);
    choppy_ray ray = {.frame = frame,
                      .origin = {batch->origin_x[i], batch->origin_y[i], batch->origin_z[i]},
                      .time_offset = batch->time_offset[i],
                      .along = {1, 0},
                      .rise = batch->direction_y[i] / horizontal};
    if (flat > 1e-9)
        ray.along[0] = batch->direction_x[i] / flat, ray.along[1] = batch->direction_z[i] / flat;
    ray.across[0] = -ray.along[1];
    ray.across[1] = ray.along[0];
    const uint32_t finest = frame->level_count - 1;
    const double start = batch->start[i] * horizontal, end = batch->end[i] * horizontal;
    uint32_t level = 0;
    double v = start - frame->choppy[finest].shift, across = 0, last = v;
    for (int64_t k = 0; k < most_evaluations; k++) {
        const choppy_level *l = &frame->choppy[level];
        const double rest = l->rest * (1 + fabs(ray.rise) * l->most_stretch) + l->rest_shift;
        const curve_point p = curve_at(&ray, l, v, across, rest);
        const double above = p.above - rest;
        batch->evaluations++;
        across = p.across;
        if (p.distance < start) { /* the point lies before the ray's beginning */
            last = v;
            v += fmax((start - p.distance) / l->most_stretch, 1e-9 * (1 + start));
            continue;
        }
        if (p.distance > end && above > 0)
            return;
        if (level < finest && above < 0.5 * rest) {
            level++;
            continue;
        }
        const double least = -(l->slope + fabs(ray.rise)) * l->most_stretch, bend = l->bend + fabs(ray.rise) * l->shift_bend;
        const double tolerance = relative_tolerance * (p.distance / horizontal + least_distance) * horizontal;
        if (above <= 0) {
            double free = last, under = v;
            curve_point hit = p;
            for (int halvings = 0; halvings < 100 && under - free > tolerance; halvings++) {
                const double middle = 0.5 * (free + under);
                const curve_point q = curve_at(&ray, l, middle, across, HUGE_VAL);
                if (q.above > 0)
                    free = middle;
                else
                    under = middle, hit = q;
            }
            keep_hit(&ray, &hit, horizontal, batch, i);
            return;
        }
        const double step = free_way(above, p.above_change, fmin(least, -1e-12), fmax(bend, 1e-12));
        if (level == finest && step < tolerance) {
            keep_hit(&ray, &p, horizontal, batch, i);
            return;
        }
        last = v;
        v += step;
        across += p.across_change * step;
        if (p.distance / horizontal > far_away)
            return;
        if (level > 0) {
            const choppy_level *coarser = &frame->choppy[level - 1];
            const double margin = coarser->rest * (1 + fabs(ray.rise) * coarser->most_stretch) + coarser->rest_shift;
            if (above > 2.5 * margin)
                level--;
        }
    }
}

#endif
