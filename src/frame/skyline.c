/* SPDX-License-Identifier: MIT
 * The skyline of the water: a ray goes out from the camera in each direction and rises where it meets the surface, so that it ends up on the highest
 * crest.
 *
 * A bearing is a direction on the horizon, from −2 to 2 all around: aside/(|ahead| + |aside|) before the camera, and what is left to ±2 behind it. */
#include "frame/skyline.h"

#include <math.h>
#include <string.h>

/* ---- the picture's bearings ---- */

/* Slopes of rays between which a picture shows the horizon and what stands above it. */
static const double lowest_ray = -0.05, highest_ray = 1;

typedef struct heading {
    double x, z;
} heading;

static heading heading_of(const camera_rays *c, uint32_t width, uint32_t height)
{
    const double column = 0.5 * (width - 1.0), row = 0.5 * (height - 1.0);
    const double x = c->corner[0] + column * c->right[0] + row * c->down[0], z = c->corner[2] + column * c->right[2] + row * c->down[2];
    const double length = hypot(x, z);
    return length > 1e-9 ? (heading){x / length, z / length} : (heading){1, 0};
}

static double bearing_of(heading h, double x, double z)
{
    const double ahead = x * h.x + z * h.z, aside = z * h.x - x * h.z, sum = fabs(ahead) + fabs(aside);
    const double part = sum > 0 ? aside / sum : 0;
    return ahead >= 0 ? part : copysign(2, aside) - part;
}

typedef struct span {
    double first, last;
} span;

static void widen(const camera_rays *c, heading h, double column, double row, span *s)
{
    double ray[3];
    for (int i = 0; i < 3; i++)
        ray[i] = c->corner[i] + column * c->right[i] + row * c->down[i];
    const double level = hypot(ray[0], ray[2]);
    if (!(ray[1] > lowest_ray * level) || !(ray[1] < highest_ray * level))
        return;
    const double bearing = bearing_of(h, ray[0], ray[2]);
    s->first = fmin(s->first, bearing);
    s->last = fmax(s->last, bearing);
}

/* The extremes lie on the picture's sides. */
static void widen_by_sides(const camera_rays *c, heading h, uint32_t width, uint32_t height, span *s)
{
    enum { PLACES = 256 };
    for (int i = 0; i <= PLACES; i++) {
        const double x = (width + 1.0) * i / PLACES - 1, y = (height + 1.0) * i / PLACES - 1;
        widen(c, h, x, -1, s);
        widen(c, h, x, height, s);
        widen(c, h, -1, y, s);
        widen(c, h, width, y, s);
    }
}

int skyline_span(const camera_rays *open, const camera_rays *close, uint32_t width, uint32_t height, FrameData *const data[2])
{
    const heading h = heading_of(close, width, height);
    span s = {2, -2};
    widen_by_sides(open, h, width, height, &s);
    widen_by_sides(close, h, width, height, &s);
    const double entries = s.last > s.first ? fmin((double)width + height, SKYLINE_MOST) : 0, margin = 0.02 * (s.last - s.first);
    for (int i = 0; i < 2; i++) {
        data[i]->skyline_x = (float)h.x;
        data[i]->skyline_z = (float)h.z;
        data[i]->skyline_first = entries > 0 ? (float)(s.first - margin) : 0;
        data[i]->skyline_scale = entries > 0 ? (float)((entries - 1) / (s.last - s.first + 2 * margin)) : 0;
    }
    return (int)entries;
}

/* ---- the waves ---- */

/* The largest waves. */
typedef struct large_waves {
    int count;
    float slope, bend; /* four deviations of their slopes, 1.4 of their second derivatives */
} large_waves;

/* What is looked at from a distance on: the waves that a pixel there can show, and the largest of these, high above which no other is looked at. */
typedef struct reach {
    large_waves all, largest;
    float rest; /* three deviations of what all have more than the largest, metres */
} reach;

/* Distances double from a quarter of a metre. */
enum { REACHES = 24 };

typedef struct water_line {
    const FrameData *frame;
    SearchWave waves[MGT_MAX_WAVES];
    reach reaches[REACHES];
    float camera_height, crest;
    bool choppy;
    float pixel; /* radians */
} water_line;

static float reach_begins(int i) { return ldexpf(0.25f, i); }

static large_waves first_waves(const wave_set *set, int count)
{
    double slope, bend;
    sines_first(set, count, &slope, &bend);
    return (large_waves){count, (float)(4 * sqrt(slope)), fmaxf((float)(1.4 * sqrt(bend)), 1e-9f)};
}

static void place_waves(const wave_set *set, double pixel, water_line *w)
{
    sines_for_rays(set, w->waves);
    int count = set->view.wave_count;
    for (int i = 0; i < REACHES; i++) {
        const double least = 0.1 * pixel * (double)reach_begins(i);
        while (count > 0 && sines_lesser_variance(set, count - 1) < least * least)
            count--;
        const int largest = count < 16 ? count : count / 2;
        const double rest = sines_lesser_variance(set, largest) - sines_lesser_variance(set, count);
        w->reaches[i] = (reach){first_waves(set, count), first_waves(set, largest), (float)(3 * sqrt(fmax(rest, 0)))};
    }
}

/* The direction of an entry, a unit vector. */
static void direction_of(const FrameData *f, int entry, float out[2])
{
    const double bearing = (double)f->skyline_first + entry / (double)f->skyline_scale;
    const double part = fabs(bearing) <= 1 ? bearing : copysign(2, bearing) - bearing;
    const double ahead = copysign(1 - fabs(part), 1 - fabs(bearing)), length = hypot(ahead, part);
    out[0] = (float)((ahead * (double)f->skyline_x - part * (double)f->skyline_z) / length);
    out[1] = (float)((ahead * (double)f->skyline_z + part * (double)f->skyline_x) / length);
}

/* ---- four directions at a time ---- */

#define MGT_LANES 4
#include "kernels/common/prelude_c.h"

struct kernel_context {
    const FrameData *frame;
};
#define FRAME(cx) (*(cx)->frame)
#include "kernels/waves/choppy.k"
#include "kernels/waves/search_step.k"

static inline real load(const float *p)
{
    real r;
    memcpy(&r, p, sizeof r);
    return r;
}

static float least_of(real x, mask busy)
{
    float lanes[MGT_LANES], least = 1e30f;
    const real counted = SELECT(busy, x, real(1e30f));
    memcpy(lanes, &counted, sizeof lanes);
    for (int i = 0; i < MGT_LANES; i++)
        least = lanes[i] < least ? lanes[i] : least;
    return least;
}

/* Height and slope of the surface at a point. `shift`: about that of choppy water there; the better one is left. */
typedef struct surface_point {
    real height;
    vec2 slope;
} surface_point;

static surface_point flat_point(CTX cx, const water_line *w, int count, real x, real z)
{
    SearchSums s = search_sums_zero(cx);
    for (int i = 0; i < count; i++)
        s = add_searched(cx, s, w->waves[i], true, x, z);
    return (surface_point){s.height, scale(s.slope, real(6.2831853f))};
}

static surface_point choppy_point(CTX cx, const water_line *w, int count, real x, real z, int looks, vec2 *shift)
{
    surface_point p;
    for (int look = 0; look < looks; look++) {
        SearchSums s = search_sums_zero(cx);
        for (int i = 0; i < count; i++)
            s = add_searched_shift(cx, s, w->waves[i], true, x - shift->x, z - shift->y);
        const Symmetric rest = at_rest(cx, real(6.2831853f) * s.xx, real(6.2831853f) * s.xz, real(6.2831853f) * s.zz);
        const vec2 left = sub(*shift, s.shift);
        p.slope = symmetric_times(cx, rest, scale(s.slope, real(6.2831853f)));
        p.height = fma(p.slope.x, left.x, fma(p.slope.y, left.y, s.height));
        *shift = sub(*shift, symmetric_times(cx, rest, left));
    }
    return p;
}

/* `looks`: at choppy water. */
static surface_point surface_at(CTX cx, const water_line *w, int count, real x, real z, int looks, vec2 *shift)
{
    return w->choppy ? choppy_point(cx, w, count, x, z, looks, shift) : flat_point(cx, w, count, x, z);
}

/* Steps at most: past them a ray keeps what it has risen to. */
enum { MOST_LOOKS = 4096 };

/* Rays on their way out. */
typedef struct rising_rays {
    real dx, dz;   /* their directions */
    real slope;    /* how steeply they rise */
    real distance; /* of the crest that they rose on; 0: they met none */
    real along;    /* how far they are out, metres */
    vec2 shift;    /* about that of choppy water there */
    mask busy;
} rising_rays;

/* What a ray sees of the surface under it. */
typedef struct glance {
    const large_waves *waves; /* that were looked at */
    real gap;                 /* to the surface of them, less what the others may lift it by, metres */
    vec2 slope;
} glance;

static glance look_at(CTX cx, const water_line *w, const reach *r, rising_rays *rays)
{
    const real x = rays->along * rays->dx, z = rays->along * rays->dz, height = fma(rays->slope, rays->along, real(w->camera_height));
    vec2 shift = rays->shift;
    surface_point p = surface_at(cx, w, r->largest.count, x, z, 1, &shift);
    const real gap = height - p.height - real(r->rest);
    if (!any_lane(AND(rays->busy, gap < real(0.0f)))) {
        rays->shift = shift;
        return (glance){&r->largest, gap, p.slope};
    }
    p = surface_at(cx, w, r->all.count, x, z, 2, &rays->shift);
    return (glance){&r->all, height - p.height, p.slope};
}

/* A ray that has met the surface climbs as far as the slope lasts at least; elsewhere it goes as far as the surface cannot rise to it. */
static real step_of(CTX cx, const rising_rays *rays, const glance *g)
{
    const large_waves *waves = g->waves;
    const real closing = fma(g->slope.x, rays->dx, g->slope.y * rays->dz) - rays->slope;
    const SearchBounds bounds = bounds_along(cx, (vec3){rays->dx, rays->slope, rays->dz}, real(1.0f), waves->slope, waves->bend);
    const real free_step = search_step(cx, bounds, max(g->gap, real(0.0f)), closing);
    const mask climbs = AND(g->gap <= real(0.0f), closing > real(0.0f));
    return max(SELECT(climbs, closing / real(waves->bend), free_step), real(0.05f * waves->slope / waves->bend));
}

/* Rays that rise by `start` at first, where `wanted`; the others stay where they are. */
static rising_rays rise_from(CTX cx, const water_line *w, real dx, real dz, real start, mask wanted)
{
    rising_rays rays = {dx, dz, start, real(0.0f), real(reach_begins(0)), {real(0.0f), real(0.0f)}, wanted};
    int at = 0;
    for (int look = 0; look < MOST_LOOKS && any_lane(rays.busy); look++) {
        const float nearest = least_of(rays.along, rays.busy);
        while (at + 1 < REACHES && nearest >= reach_begins(at + 1))
            at++;
        const reach *r = &w->reaches[at];
        if (r->all.count == 0)
            break;
        const glance g = look_at(cx, w, r, &rays);
        const mask meets = AND(rays.busy, g.gap < real(0.0f));
        rays.slope = SELECT(meets, min(rays.slope - g.gap / rays.along, real(4.0f)), rays.slope);
        rays.distance = SELECT(meets, rays.along, rays.distance);
        rays.along = rays.along + step_of(cx, &rays, &g);
        /* No crest further out would lift the ray by a tenth of a pixel. */
        rays.busy = AND(rays.busy, fma(rays.slope + real(0.1f * w->pixel), rays.along, real(w->camera_height)) < real(w->crest));
    }
    return rays;
}

typedef struct rise {
    real slope, distance;
} rise;

/* `before`: the slope of the neighbouring rays. These are seldom much lower, and where they begin a little lower they pass over nearer crests at once. */
static rise rise_beside(CTX cx, const water_line *w, real dx, real dz, real before)
{
    const real least = real(0.02f * w->pixel);
    const real start = max(before - real(0.4f * w->pixel), least);
    const rising_rays first = rise_from(cx, w, dx, dz, start, start >= least);
    const mask lower = AND(first.distance == real(0.0f), start > least);
    if (!any_lane(lower))
        return (rise){first.slope, first.distance};
    const rising_rays anew = rise_from(cx, w, dx, dz, least, lower);
    return (rise){SELECT(lower, anew.slope, first.slope), SELECT(lower, anew.distance, first.distance)};
}

/* Whether the camera is above the surface. Within a wave it sees no skyline. */
static bool stands_over_water(CTX cx, const water_line *w)
{
    float height[MGT_LANES];
    vec2 shift = {real(0.0f), real(0.0f)};
    const surface_point p = surface_at(cx, w, w->reaches[0].all.count, real(0.0f), real(0.0f), 4, &shift);
    memcpy(height, &p.height, sizeof height);
    return height[0] < w->camera_height;
}

void skyline_copy(const wave_set *from, wave_set *to)
{
    to->view.skyline = from->view.skyline;
    to->view.skyline_top = from->view.skyline_top;
    if (from->view.skyline)
        memcpy(to->skyline, from->skyline, sizeof to->skyline);
}

bool skyline_may_stand(const frame *f, const camera_rays *camera)
{
    return f->data.grazing_fall > 0 && f->skyline_entries > 0 && !f->under && camera->position[1] < sines_crest(&f->scene->water);
}

/* Four entries, `each` apart, from the i-th on. Returns their slopes. */
static real find_entries(CTX cx, const water_line *line, int i, int each, real before, wave_set *set)
{
    float dx[MGT_LANES], dz[MGT_LANES], slope[MGT_LANES], distance[MGT_LANES];
    for (int lane = 0; lane < MGT_LANES; lane++) {
        float direction[2];
        direction_of(line->frame, lane * each + i, direction);
        dx[lane] = direction[0];
        dz[lane] = direction[1];
    }
    const rise risen = rise_beside(cx, line, load(dx), load(dz), before);
    memcpy(slope, &risen.slope, sizeof slope);
    memcpy(distance, &risen.distance, sizeof distance);
    for (int lane = 0; lane < MGT_LANES && lane * each + i < SKYLINE_MOST; lane++) {
        float *entry = set->skyline[lane * each + i];
        entry[0] = distance[lane] > 0 ? slope[lane] : 0;
        entry[1] = distance[lane];
    }
    return risen.slope;
}

void skyline_find(const frame *f, wave_set *set)
{
    const FrameData *data = &f->data;
    water_line line = {.frame = data,
                       .camera_height = set->view.camera_height,
                       .crest = set->view.displacement,
                       .choppy = set->view.pressed > 0,
                       .pixel = data->pixel_angle};
    place_waves(set, (double)data->pixel_angle, &line);
    const struct kernel_context cx = {data};
    if (!stands_over_water(&cx, &line))
        return;
    /* A lane goes through neighbouring directions. */
    const int each = (f->skyline_entries + MGT_LANES - 1) / MGT_LANES;
    real before = real(0.0f);
    for (int i = 0; i < each; i++)
        before = find_entries(&cx, &line, i, each, before, set);
    float top = 0;
    for (int i = 0; i < f->skyline_entries; i++)
        top = set->skyline[i][0] > top ? set->skyline[i][0] : top;
    set->view.skyline = top > 0;
    set->view.skyline_top = top > 0 ? top + 2 * data->pixel_angle : 0;
}
