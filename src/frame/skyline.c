/* SPDX-License-Identifier: MIT
 * The skyline of the water: in each direction a ray marches away from the camera. Where it meets the surface, it is raised, so that in the end it touches the
 * highest crest.
 *
 * A bearing is a horizontal direction as a number from −2 to 2. It is b = aside/(|ahead| + |aside|) in front of the camera, and ±2 − b behind it. */
#include "frame/skyline.h"

#include <math.h>
#include <string.h>

/* ---- the picture's bearings ---- */

/* A ray between these slopes shows the horizon or what may stand above it. */
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

/* Widens a span by the bearings along the picture's border, where the extremes are. */
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

/* The `count` largest waves. */
typedef struct large_waves {
    int count;
    float slope, bend; /* bounds: four standard deviations of their slopes, and 1.4 of their second derivatives */
} large_waves;

/* Waves that rays sum from a distance on. A ray high above the largest waves needs no others. */
typedef struct reach {
    large_waves all, largest; /* the waves that a pixel at this distance can show, and the largest of them */
    float rest;               /* three standard deviations of the height of all without the largest, metres */
} reach;

/* Number of distances. They begin with a quarter of a metre, and each is twice the one before. */
enum { REACHES = 24 };

typedef struct water_line {
    const FrameData *frame;
    SearchWave waves[MGT_MAX_WAVES];
    reach reaches[REACHES];
    float camera_height, crest;
    bool choppy;
    float pixel; /* angle of a pixel, radians */
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

/* Height and slope of the surface at a point. */
typedef struct surface_point {
    real height;
    vec2 slope;
} surface_point;

static surface_point flat_point(CTX cx, const water_line *w, int count, real x, real z)
{
    SearchSums s = search_sums_zero(cx);
    for (int i = 0; i < count; i++)
        s = add_searched(cx, s, w->waves[i], true, false, x, z);
    return (surface_point){s.height, s.slope};
}

static surface_point choppy_point(CTX cx, const water_line *w, int count, real x, real z, int looks, vec2 *shift)
{
    surface_point p;
    for (int look = 0; look < looks; look++) {
        SearchSums s = search_sums_zero(cx);
        for (int i = 0; i < count; i++)
            s = add_searched_shift(cx, s, w->waves[i], true, false, x - shift->x, z - shift->y);
        const Symmetric rest = inverse_stretch(cx, s.xx, s.xz, s.zz);
        const vec2 left = sub(*shift, s.shift);
        p.slope = symmetric_times(cx, rest, s.slope);
        p.height = fma(p.slope.x, left.x, fma(p.slope.y, left.y, s.height));
        *shift = sub(*shift, symmetric_times(cx, rest, left));
    }
    return p;
}

/* The surface at a point. For choppy water `looks` Newton steps improve *shift, an estimate of the water's horizontal shift there. */
static surface_point surface_at(CTX cx, const water_line *w, int count, real x, real z, int looks, vec2 *shift)
{
    return w->choppy ? choppy_point(cx, w, count, x, z, looks, shift) : flat_point(cx, w, count, x, z);
}

/* Most steps of a ray. After them it keeps the slope that it has. */
enum { MOST_LOOKS = 4096 };

/* Rays that march away from the camera. */
typedef struct rising_rays {
    real dx, dz;   /* horizontal directions, unit */
    real slope;    /* height gained per metre */
    real distance; /* horizontal distance of the crest that raised the ray last, metres; 0: none did */
    real along;    /* horizontal distance from the camera, metres */
    vec2 shift;    /* estimate of choppy water's shift at the ray's place, metres */
    mask busy;
} rising_rays;

/* The surface under a ray. */
typedef struct glance {
    const large_waves *waves; /* the waves that were summed */
    real gap;                 /* lower bound of the ray's height above the surface, metres; < 0: the ray is below the surface */
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

/* Length of the next step. A ray that was below a rising surface steps as far as the slope lasts at least. Any other steps as far as the surface cannot reach
 * it. */
static real step_of(CTX cx, const rising_rays *rays, const glance *g)
{
    const large_waves *waves = g->waves;
    const real closing = fma(g->slope.x, rays->dx, g->slope.y * rays->dz) - rays->slope;
    const SearchBounds bounds = bounds_along(cx, (vec3){rays->dx, rays->slope, rays->dz}, real(1.0f), real(waves->slope), waves->bend);
    const real free_step = search_step(cx, bounds, max(g->gap, real(0.0f)), closing);
    const mask climbs = AND(g->gap <= real(0.0f), closing > real(0.0f));
    return max(SELECT(climbs, closing / real(waves->bend), free_step), real(0.05f * waves->slope / waves->bend));
}

/* Marches rays that begin with the slope `start`, in the lanes `wanted`. */
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
        /* A ray is done when no crest farther away can raise it by a tenth of a pixel. */
        rays.busy = AND(rays.busy, fma(rays.slope + real(0.1f * w->pixel), rays.along, real(w->camera_height)) < real(w->crest));
    }
    return rays;
}

typedef struct rise {
    real slope, distance;
} rise;

/* Marches rays that begin a little below `before`, the slope of the neighbouring rays, which saves the steps up nearer crests. Rays that meet nothing begin
 * anew from the lowest slope. */
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

/* Whether the camera is above the surface. A camera within a wave sees no skyline. */
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

/* Fills four entries, i, i + each, i + 2·each and i + 3·each. Returns their slopes. */
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
    /* Each lane goes through neighbouring directions, because a ray begins with its neighbour's slope. */
    const int each = (f->skyline_entries + MGT_LANES - 1) / MGT_LANES;
    real before = real(0.0f);
    for (int i = 0; i < each; i++)
        before = find_entries(&cx, &line, i, each, before, set);
    float top = 0;
    for (int i = 0; i < f->skyline_entries; i++)
        top = set->skyline[i][0] > top ? set->skyline[i][0] : top;
    set->view.skyline = top > 0 ? 1 : SKYLINE_NONE;
    set->view.skyline_top = top > 0 ? top + 2 * data->pixel_angle : 0;
}
