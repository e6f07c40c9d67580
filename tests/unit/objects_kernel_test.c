/* SPDX-License-Identifier: MIT
 * The kernels that find points of objects behind the surface, at one lane, against finite differences, small steps and Snell's law in double precision. */
#include "unit/objects_lane.h"

/* The data of one case. */
static NarrowData narrow_data;
static RefractData refract_data;
static double floor_depth;                            /* of the plane that the layer shows */
static double post_column = -1, post_row, post_depth; /* of what stands before it, three pixels wide and high */

#define NARROW(cx) narrow_data
#define CHOPPY_BEHIND(cx) NARROW(cx).choppy
#define REFRACT(cx) refract_data

#include "kernels/refraction/layer.k"

/* Of a pixel. */
typedef struct layer_pixel {
    float depth;
    LayerPlane plane;
} layer_pixel;

static layer_pixel pixel_of_layer(double column, double row);
KERNEL real LAYER_DEPTH(CTX cx, int layer, real column, real row) { return pixel_of_layer((double)column, (double)row).depth; }
KERNEL LayerPlane LAYER_PLANE(CTX cx, int layer, real column, real row) { return pixel_of_layer((double)column, (double)row).plane; }
#define LAYER_NEAREST(cx, layer, column, row) 0.0f
#define MIRRORED_WITHIN(cx, a, b) ((void)(a), (void)(b), true)

#include "kernels/refraction/again.k"
#include "kernels/refraction/spread.k"

#include "unit/kernel_words_off.h"

/* ---- footprints ---- */

/* Where a camera's ray meets the surface, and what that does while its pixel and the shutter go by. */
typedef struct bent_case {
    double forward[3], right[3], down[3], place[2]; /* rays are forward + x right + y down */
    double ratio, distance, slope[2], bend[3], path[3], roots[2][2];
    bool mirrored;
} bent_case;

static void cross3(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static bent_case random_case(int i)
{
    bent_case c = {.ratio = i % 2 ? 1.333 : 1 / 1.333, .mirrored = i % 3 == 2, .distance = range(1, 20), .place = {range(-200, 200), range(-200, 200)}};
    const double steepness = range(0.25, 1.4), azimuth = range(0, 2 * pi), pixel = 1e-3;
    const double up[3] = {0, 1, 0}, forward[3] = {cos(steepness) * cos(azimuth), -sin(steepness), cos(steepness) * sin(azimuth)};
    memcpy(c.forward, forward, sizeof forward);
    cross3(forward, up, c.right);
    unit3(c.right);
    cross3(forward, c.right, c.down);
    for (int k = 0; k < 3; k++)
        c.right[k] *= pixel, c.down[k] *= pixel;
    for (int k = 0; k < 2; k++)
        c.slope[k] = range(-0.1, 0.1);
    for (int k = 0; k < 3; k++) {
        c.bend[k] = range(-0.5, 0.5);
        c.path[k] = k < 2 ? range(-2e-3, 2e-3) : range(-2e-3, 2e-3) * c.distance;
    }
    for (int k = 0; k < 4; k++)
        c.roots[k / 2][k % 2] = range(-1.5e-3, 1.5e-3);
    return c;
}

static void ray3(const bent_case *c, double x, double y, double ray[3])
{
    for (int k = 0; k < 3; k++)
        ray[k] = c->forward[k] + (c->place[0] + x) * c->right[k] + (c->place[1] + y) * c->down[k];
    unit3(ray);
}

/* Where the ray of a place in the pixel meets the surface's tangent plane at a share of the shutter, from the middle, and where it goes from there. The
 * surface's slope is `more` than it was. */
static bool follow(const bent_case *c, double x, double y, double share, const double more[2], double hit[3], double out[3])
{
    double middle[3], ray[3], normal[3] = {-c->slope[0], 1, -c->slope[1]};
    ray3(c, 0, 0, middle);
    ray3(c, x, y, ray);
    unit3(normal);
    const double along = c->distance * dot3(middle, normal) / dot3(ray, normal) + share * c->path[2];
    for (int k = 0; k < 3; k++)
        hit[k] = along * ray[k] - c->distance * middle[k];
    const double beside[2] = {hit[0] - share * c->path[2] * ray[0], hit[2] - share * c->path[2] * ray[2]};
    const double slope[2] = {c->slope[0] + c->bend[0] * beside[0] + c->bend[1] * beside[1] + share * c->path[0] + more[0],
                             c->slope[1] + c->bend[1] * beside[0] + c->bend[2] * beside[1] + share * c->path[1] + more[1]};
    double there[3] = {-slope[0], 1, -slope[1]};
    unit3(there);
    if (!c->mirrored)
        return refract3(ray, there, c->ratio, out);
    for (int k = 0; k < 3; k++)
        out[k] = ray[k] - 2 * dot3(ray, there) * there[k];
    return true;
}

/* The covariance across the middle ray, by the mean over pixel, shutter and slopes. */
static bool covariance_of(const bent_case *c, double after, double sum[3], double direction[3])
{
    enum { STEPS = 10 };
    const double none[2] = {0};
    double hit[3], side[3], rise[3], up[3] = {0, 1, 0};
    if (!follow(c, 0, 0, 0, none, hit, direction))
        return false;
    cross3(up, direction, side);
    for (int k = 0; k < 3; k++)
        side[k] = -side[k];
    unit3(side);
    cross3(side, direction, rise);
    double end[3];
    for (int k = 0; k < 3; k++)
        end[k] = hit[k] + after * direction[k];
    sum[0] = sum[1] = sum[2] = 0;
    for (int i = 0; i < STEPS * STEPS * STEPS * 4; i++) {
        const int s = i % 4, x = i / 4 % STEPS, y = i / 4 / STEPS % STEPS, t = i / 4 / STEPS / STEPS;
        const double sign = s % 2 ? -sqrt(2) : sqrt(2), more[2] = {sign * c->roots[s / 2][0], sign * c->roots[s / 2][1]};
        double out[3], aside[3];
        if (!follow(c, (x + 0.5) / STEPS - 0.5, (y + 0.5) / STEPS - 0.5, (t + 0.5) / STEPS - 0.5, more, hit, out))
            return false;
        for (int k = 0; k < 3; k++)
            aside[k] = end[k] - hit[k];
        const double way = dot3(aside, direction) / dot3(out, direction);
        for (int k = 0; k < 3; k++)
            aside[k] = hit[k] + way * out[k] - end[k];
        const double a = dot3(aside, side), b = dot3(aside, rise);
        sum[0] += a * a, sum[1] += a * b, sum[2] += b * b;
    }
    for (int k = 0; k < 3; k++)
        sum[k] /= STEPS * STEPS * STEPS * 4 * (1 - 1.0 / (STEPS * STEPS)); /* the strata's middles lack that much of the variance */
    return true;
}

static Spread spread_of_case(const bent_case *c, const double direction[3])
{
    double ray[3];
    ray3(c, 0, 0, ray);
    narrow_data = (NarrowData){
        .ratio = (float)c->ratio,
        .side = 1,
        .ray_side = 1,
        .lookup_side = 1,
        .depth_x = (float)c->forward[0],
        .depth_y = (float)c->forward[1],
        .depth_z = (float)c->forward[2],
        .right_x = (float)c->right[0],
        .right_y = (float)c->right[1],
        .right_z = (float)c->right[2],
        .down_x = (float)c->down[0],
        .down_y = (float)c->down[1],
        .down_z = (float)c->down[2],
    };
    double normal[3] = {-c->slope[0], 1, -c->slope[1]};
    unit3(normal);
    const WaterHit hit = {.view = vec3((float)ray[0], (float)ray[1], (float)ray[2]),
                          .along = (float)c->distance,
                          .normal = vec3((float)normal[0], (float)normal[1], (float)normal[2])};
    const WaterVariation v = {
        .bend_xx = (float)c->bend[0],
        .bend_xz = (float)c->bend[1],
        .bend_zz = (float)c->bend[2],
        .path = vec2((float)c->path[0], (float)c->path[1]),
        .path_along = (float)c->path[2],
        .variance_xx = (float)(c->roots[0][0] * c->roots[0][0] + c->roots[1][0] * c->roots[1][0]),
        .variance_xz = (float)(c->roots[0][0] * c->roots[0][1] + c->roots[1][0] * c->roots[1][1]),
        .variance_zz = (float)(c->roots[0][1] * c->roots[0][1] + c->roots[1][1] * c->roots[1][1]),
    };
    const Bent bent = {vec3((float)direction[0], (float)direction[1], (float)direction[2]), c->mirrored ? 1.0f : 0.0f};
    return spread_of(NULL, hit, bent, v);
}

static void footprints_follow_the_rays(void **state)
{
    (void)state;
    numbers.state = 3;
    double worst = 0;
    int seen = 0;
    for (int i = 0; i < 300; i++) {
        const bent_case c = random_case(i);
        const double after = range(0.1, 10);
        double exact[3], direction[3], ray[3], normal[3] = {-c.slope[0], 1, -c.slope[1]};
        ray3(&c, 0, 0, ray);
        unit3(normal);
        const double cosine = -dot3(ray, normal);
        /* Near the critical angle, and along the surface, differences tell nothing. */
        if (cosine < 0.2 || (!c.mirrored && 1 - c.ratio * c.ratio * (1 - cosine * cosine) < 0.1) || !covariance_of(&c, after, exact, direction))
            continue;
        seen++;
        const vec3 found = spread_after(NULL, spread_of_case(&c, direction), (float)after);
        const double told[3] = {(double)found.x, (double)found.y, (double)found.z};
        for (int k = 0; k < 3; k++)
            worst = fmax(worst, fabs(told[k] - exact[k]) / (exact[0] + exact[2]));
    }
    printf("footprints: within %.2g of the mean over pixel, shutter and slopes, in %d cases\n", worst, seen);
    assert_true(seen > 150 && worst < 0.01);
}

/* Rays through other places of a pixel meet the plane of the surface and bend as its slopes there say. */
static void rays_beside_meet_the_surface(void **state)
{
    (void)state;
    numbers.state = 8;
    double worst = 0, farthest = 0;
    for (int i = 0; i < 300; i++) {
        const bent_case c = random_case(i);
        const vec2 place = vec2((float)range(-0.5, 0.5), (float)range(-0.5, 0.5));
        double middle[3], ray[3], hit[3], out[3], normal[3] = {-c.slope[0], 1, -c.slope[1]};
        const double none[2] = {0};
        ray3(&c, 0, 0, middle);
        unit3(normal);
        if (-dot3(middle, normal) < 0.2 || !follow(&c, (double)place.x, (double)place.y, 0, none, hit, out))
            continue;
        spread_of_case(&c, (const double[3]){0, -1, 0});
        narrow_data.corner_x = (float)c.forward[0], narrow_data.corner_y = (float)c.forward[1], narrow_data.corner_z = (float)c.forward[2];
        const WaterHit centre = {.view = vec3((float)middle[0], (float)middle[1], (float)middle[2]),
                                 .along = (float)c.distance,
                                 .normal = vec3((float)normal[0], (float)normal[1], (float)normal[2]),
                                 .column = (float)c.place[0],
                                 .row = (float)c.place[1]};
        const WaterVariation v = {.bend_xx = (float)c.bend[0], .bend_xz = (float)c.bend[1], .bend_zz = (float)c.bend[2]};
        const WaterHit beside = hit_beside(NULL, centre, v, place);
        const double view[3] = {(double)beside.view.x, (double)beside.view.y, (double)beside.view.z};
        const double there[3] = {(double)beside.normal.x, (double)beside.normal.y, (double)beside.normal.z};
        double bent[3];
        if (c.mirrored)
            for (int k = 0; k < 3; k++)
                bent[k] = view[k] - 2 * dot3(view, there) * there[k];
        else
            assert_true(refract3(view, there, c.ratio, bent));
        ray3(&c, (double)place.x, (double)place.y, ray);
        for (int k = 0; k < 3; k++) {
            worst = fmax(worst, fabs(bent[k] - out[k]));
            farthest = fmax(farthest, fabs((double)beside.along * view[k] - c.distance * middle[k] - hit[k]) / c.distance);
        }
    }
    printf("rays beside: directions within %.1g, hits within %.1g of the distance\n", worst, farthest);
    assert_true(worst < 2e-5 && farthest < 2e-6);
}

/* Upside down, `rise` turns round: the mixed term changes its sign. */
static void spreads_turn_with_the_camera(void **state)
{
    (void)state;
    narrow_data = (NarrowData){.side = -1};
    const Spread s = {vec3(1.0f, 2.0f, 3.0f), vec3(4.0f, 5.0f, 6.0f), vec3(7.0f, 8.0f, 9.0f)};
    const vec3 at = spread_after(NULL, turned_spread(NULL, s), 2.0f);
    assert_true(at.x == 1 + 8 + 28 && at.y == -(2 + 10 + 32) && at.z == 3 + 12 + 36);
    const RayAxes above = ray_axes(NULL, vec3(0.6f, -0.8f, 0.0f)), below = ray_axes(NULL, vec3(0.6f, 0.8f, 0.0f));
    assert_true(above.side.x == below.side.x && above.side.z == below.side.z);
    assert_true(above.rise.x == -below.rise.x && above.rise.y == below.rise.y && above.rise.z == -below.rise.z);
}

/* ---- the narrow phase ---- */

static void rays_bend_by_snells_law(void **state)
{
    (void)state;
    numbers.state = 6;
    int total = 0;
    for (int i = 0; i < 5000; i++) {
        const double ratio = i % 2 ? 1.333 : 1 / 1.333, theta = range(0.01, 1.5), azimuth = range(0, 2 * pi);
        const double ray[3] = {sin(theta) * cos(azimuth), -cos(theta), sin(theta) * sin(azimuth)};
        double normal[3] = {range(-0.3, 0.3), 1, range(-0.3, 0.3)}, bent[3];
        unit3(normal);
        if (dot3(ray, normal) > -0.02)
            continue;
        narrow_data = (NarrowData){.ratio = (float)ratio};
        const Bent b = bent_at(NULL, vec3((float)ray[0], (float)ray[1], (float)ray[2]), vec3((float)normal[0], (float)normal[1], (float)normal[2]));
        const double cosine = -dot3(ray, normal), squared = 1 - ratio * ratio * (1 - cosine * cosine);
        if (fabs(squared) < 1e-4)
            continue;
        assert_true((b.total > 0) == (squared < 0));
        if (!refract3(ray, normal, ratio, bent))
            for (int k = 0; k < 3; k++)
                bent[k] = ray[k] + 2 * cosine * normal[k];
        total += squared < 0;
        assert_true(fabs((double)b.direction.x - bent[0]) + fabs((double)b.direction.y - bent[1]) + fabs((double)b.direction.z - bent[2]) < 3e-5);
    }
    assert_true(total > 300);
}

/* ---- the surface again ---- */

/* Height of `waves` in double precision at a place of rest relative to the foot, and where they shift it to. */
static double height_at_rest(const double rest[2], double shift[2])
{
    double height = 0;
    const double x = rest[0] + (double)narrow_data.foot_x, z = rest[1] + (double)narrow_data.foot_z;
    shift[0] = shift[1] = 0;
    for (int i = 0; i < 4; i++) {
        const SearchWave w = waves[i];
        const double phase = 2 * pi * ((double)w.turns_x * x + (double)w.turns_z * z + (double)w.phase);
        height += (double)w.amplitude * sin(phase);
        for (int k = 0; k < 2; k++)
            shift[k] += (double)(k ? w.shift_z : w.shift_x) * cos(phase);
    }
    return height * (double)narrow_data.side;
}

/* Height at a place relative to the foot. */
static double height_of(double x, double z)
{
    double rest[2] = {x, z}, shift[2], height = height_at_rest(rest, shift);
    for (int i = 0; narrow_data.choppy && i < 100 && hypot(x - rest[0] - shift[0], z - rest[1] - shift[1]) > 1e-10; i++)
        rest[0] = x - shift[0], rest[1] = z - shift[1], height = height_at_rest(rest, shift);
    return height;
}

/* The slope by differences. */
static double height_at(const double at[3], double slope[2])
{
    const double h = 1e-5;
    slope[0] = (height_of(at[0] + h, at[2]) - height_of(at[0] - h, at[2])) / (2 * h);
    slope[1] = (height_of(at[0], at[2] + h) - height_of(at[0], at[2] - h)) / (2 * h);
    return height_of(at[0], at[2]);
}

/* Metres from a place of the surface, which the ray leaves, to where it meets it next; −1: nowhere within five metres. In steps of a millimetre. */
static double next_crossing(const double from[3], const double direction[3], double above)
{
    for (int i = 5; i < 5000; i++) {
        const double way = 0.001 * i, at[3] = {from[0] + way * direction[0], from[1] + way * direction[1], from[2] + way * direction[2]};
        if (above * (at[1] - height_of(at[0], at[2])) < 0)
            return way;
    }
    return -1;
}

static void place_waves(double side, double choppiness)
{
    static const double numbers_of[4][3] = {{0.15, 1.1, 0.4}, {0.06, -2.1, 1.9}, {0.03, 3.2, -3.4}, {0.01, -7.5, 2.6}}; /* amplitude, turns of 2π metres */
    narrow_data = (NarrowData){.side = (float)side, .ratio = side < 0 ? 1.333f : 1 / 1.333f, .waves = 4, .distance = 1.5f, .foot_x = 0.7f, .foot_z = -1.2f};
    narrow_data.choppy = choppiness > 0;
    for (int i = 0; i < 4; i++) {
        const double *w = numbers_of[i], k = hypot(w[1], w[2]);
        waves[i] =
            (SearchWave){.turns_x = (float)(w[1] / (2 * pi)), .turns_z = (float)(w[2] / (2 * pi)), .phase = (float)range(0, 1), .amplitude = (float)w[0]};
        waves[i].slope_x = (float)(w[0] * w[1]), waves[i].slope_z = (float)(w[0] * w[2]);
        const double shift = choppiness * w[0] / k;
        waves[i].shift_x = (float)(shift * w[1]), waves[i].shift_z = (float)(shift * w[2]);
        waves[i].press_xx = (float)(-shift * w[1] * w[1]), waves[i].press_xz = (float)(-shift * w[1] * w[2]), waves[i].press_zz = (float)(-shift * w[2] * w[2]);
        narrow_data.wave_height += (float)w[0];
        narrow_data.wave_slope += (float)(w[0] * k);
        narrow_data.wave_bend += (float)(w[0] * k * k);
    }
    const float pressed = (float)choppiness * narrow_data.wave_slope, steeper = 1 / sqrtf(1 - pressed * pressed);
    narrow_data.wave_slope *= steeper, narrow_data.wave_bend *= steeper;
}

/* Rays that leave the surface on either side meet it next where steps of a millimetre do. */
static void rays_meet_the_next_wave(void **state)
{
    (void)state;
    for (int choppy = 0, rays = 8000; choppy < 2; choppy++, rays = 1000) {
        int met = 0, none = 0, disagree = 0;
        numbers.state = 11;
        for (int i = 0; i < rays; i++) {
            if (i % 100 == 0)
                place_waves(i % 200 ? 1 : -1, 0.8 * choppy);
            const double above = i % 2 ? 1 : -1, azimuth = range(0, 2 * pi), rise = range(-0.3, 0.6);
            double from[3] = {range(-3, 3), 0, range(-3, 3)}, slope[2], direction[3] = {cos(azimuth), above * rise, sin(azimuth)};
            from[1] = height_at(from, slope);
            unit3(direction);
            if (above * (direction[1] - slope[0] * direction[0] - slope[1] * direction[2]) < 0.03)
                continue; /* it does not leave it */
            const double exact = next_crossing(from, direction, above);
            const MetAgain m = meet_again(NULL, vec3((float)from[0], (float)from[1], (float)from[2]),
                                          vec3((float)direction[0], (float)direction[1], (float)direction[2]), (float)above, 1);
            const bool found = m.met > 0 && (double)m.along < 4.9;
            disagree += found != (exact >= 0 && exact < 4.9) || (found && fabs((double)m.along - exact) > 0.02);
            met += found, none += !found;
        }
        printf("the surface again: %d rays meet it, %d do not, %d are off by more than 2 cm\n", met, none, disagree);
        assert_true(met > rays / 16 && none > rays / 16);
        assert_true(disagree < (met + none) / 200); /* those that touch a crest */
    }
}

/* Both parts of a split ray together are all of its light, and each goes by Snell's law. */
static void parts_of_light_are_all_of_it(void **state)
{
    (void)state;
    numbers.state = 12;
    int split = 0;
    for (int i = 0; i < 2000; i++) {
        place_waves(i % 2 ? 1 : -1, 0);
        const double above = i % 4 < 2 ? 1 : -1, azimuth = range(0, 2 * pi), theta = range(0.05, 1.5);
        const double direction[3] = {sin(theta) * cos(azimuth), -above * cos(theta), sin(theta) * sin(azimuth)};
        SeenBehind s = {.bent = {vec3((float)direction[0], (float)direction[1], (float)direction[2]), above > 0 ? 1.0f : 0.0f}, .part = 1, .share = 1};
        s.from.view = vec3(0.0f, -1.0f, 0.0f);
        s.from.along = narrow_data.distance;
        const MetAgain m = {.along = 0.5f, .met = 1, .slope = vec2((float)range(-0.1, 0.1), (float)range(-0.1, 0.1))};
        const SeenBehind a = turned_again(NULL, s, m, true, 0), b = turned_again(NULL, s, m, true, 1);
        assert_true(fabs((double)a.part + (double)b.part - 1) < 1e-6 && a.part >= b.part);
        assert_true((a.bent.total > 0) != (b.bent.total > 0) && fabs((double)a.way - 0.5) < 1e-6);
        const SeenBehind *through = (a.bent.total > 0) != (above > 0) ? &a : &b, *mirrored = through == &a ? &b : &a;
        double normal[3] = {-(double)m.slope.x, 1, -(double)m.slope.y}, bent[3];
        unit3(normal);
        for (int k = 0; k < 3; k++)
            normal[k] *= above;
        const double cosine = -dot3(direction, normal);
        if (cosine < 0.02)
            continue;
        const double to_mirrored[3] = {(double)mirrored->bent.direction.x, (double)mirrored->bent.direction.y, (double)mirrored->bent.direction.z};
        for (int k = 0; k < 3; k++)
            assert_true(fabs(to_mirrored[k] - direction[k] - 2 * cosine * normal[k]) < 3e-5);
        const double ratio = above > 0 ? (double)narrow_data.ratio : 1 / (double)narrow_data.ratio;
        if (!refract3(direction, normal, ratio, bent) || through->part < 1e-3f)
            continue;
        split++;
        assert_true(fabs((double)through->bent.direction.x - bent[0]) + fabs((double)through->bent.direction.y - bent[1]) +
                        fabs((double)through->bent.direction.z - bent[2]) <
                    1e-4);
    }
    assert_true(split > 500);
}

enum { WIDTH = 320, HEIGHT = 180 };

/* What a flat surface shows of a level floor or ceiling at the centre of a pixel. */
static layer_pixel pixel_of_layer(double column, double row)
{
    double ray[3];
    if (post_column >= 0 && fabs(column - post_column) <= 1 && fabs(row - post_row) <= 1)
        return (layer_pixel){(float)post_depth, {vec3(0.0f, 0.0f, 1.0f), 0.0f, 1.0f}};
    const double x = column - (double)narrow_data.left, y = row - (double)narrow_data.top;
    ray[0] = (double)narrow_data.corner_x + x * (double)narrow_data.right_x + y * (double)narrow_data.down_x;
    ray[1] = (double)narrow_data.corner_y + x * (double)narrow_data.right_y + y * (double)narrow_data.down_y;
    ray[2] = (double)narrow_data.corner_z + x * (double)narrow_data.right_z + y * (double)narrow_data.down_z;
    const double length = sqrt(dot3(ray, ray)), up[3] = {0, 1, 0};
    double view[3] = {ray[0] / length, ray[1] / length, ray[2] / length}, bent[3];
    if (view[1] > -1e-3 || !refract3(view, up, (double)narrow_data.ratio, bent))
        return (layer_pixel){INFINITY, {vec3(0.0f, 1.0f, 0.0f), 0.0f, 0.0f}};
    const double h = (double)narrow_data.distance, along = h / -view[1], way = floor_depth / -bent[1];
    const double side = (double)narrow_data.side;
    const vec3 p = vec3((float)(along * view[0] + way * bent[0]), (float)(-side * floor_depth), (float)(along * view[2] + way * bent[2]));
    const vec3 image = virtual_point(NULL, p);
    const double from[3] = {(double)image.x, side * (double)image.y - h, (double)image.z};
    return (layer_pixel){(float)(dot3(from, ray) / (length * length)), {vec3(0.0f, 1.0f, 0.0f), (float)(-side * floor_depth), 1.0f}};
}

static void set_view(bool under, double height, double pitch)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    static mgt_scene kept;
    scene.image = (mgt_image){.width = WIDTH, .height = HEIGHT};
    scene.camera = (mgt_camera){{0, height, 0}, {0.3, height - sin(pitch), -cos(pitch)}, {0, 1, 0}, 45};
    kept = scene;
    frame f = {.scene = &kept, .under = under};
    f.data.pixel_angle = (float)(2 * tan(22.5 * pi / 180) / HEIGHT);
    f.close = camera_rays_of(&scene.camera, WIDTH, HEIGHT);
    const gbuffer layer = {.width = 400, .height = 240, .left = 40, .top = 30};
    const world nothing = {.low = {-1e3f, -1e3f, -1e3f}, .high = {1e3f, 1e3f, 1e3f}};
    narrow_data = refraction_narrow_data(&f, &nothing, &layer);
    narrow_data.method = 0;
    refract_data = refract_data_of(under ? -height : height, 1.333, MAP_SAGITTAL);
}

/* Under a flat surface the picture is the answer: every pixel is its own. */
static void flat_water_needs_no_search(void **state)
{
    (void)state;
    numbers.state = 7;
    double worst = 0;
    int pixels = 0;
    for (int i = 0; i < 3000; i++) {
        const bool under = i % 2;
        floor_depth = exp(range(-2, 2));
        set_view(under, exp(range(-1, 2)), under ? range(0.9, 1.4) : range(0.3, 1.4));
        const double column = floor(range(0, WIDTH)), row = floor(range(0, HEIGHT));
        const vec3 ray = layer_ray(NULL, (float)column, (float)row);
        double view[3] = {(double)ray.x, (double)ray.y, (double)ray.z};
        unit3(view);
        if (view[1] > -0.1)
            continue;
        const WaterHit hit = {vec3((float)view[0], (float)view[1], (float)view[2]), (float)((double)narrow_data.distance / -view[1]), vec3(0.0f, 1.0f, 0.0f),
                              (float)column, (float)row};
        const Bent bent = bent_at(NULL, hit.view, hit.normal);
        if (bent.total > 0 || bent.direction.y > -0.05f)
            continue;
        const FoundPoint f = find_refracted(NULL, hit, bent);
        pixels++;
        assert_true(f.shown > 0);
        assert_true((double)f.column == column + 40 && (double)f.row == row + 30);
        worst = fmax(worst, (double)f.residual);
        assert_true(fabs((double)f.position.y + floor_depth) < 1e-4 * (floor_depth + (double)narrow_data.distance));
    }
    printf("flat water: %d pixels, residual at most %.2g pixels\n", pixels, worst);
    assert_true(pixels > 1500 && worst < 0.01);
}

/* Under waves the answer lies where the bent ray meets the floor, and says how far off its pixel is. */
static void waves_lead_to_the_floor(void **state)
{
    (void)state;
    numbers.state = 8;
    int found = 0, certain = 0;
    for (int i = 0; i < 3000; i++) {
        floor_depth = range(0.5, 3);
        set_view(false, range(1, 5), range(0.4, 1.3));
        const double column = floor(range(20, WIDTH - 20)), row = floor(range(20, HEIGHT - 20));
        const vec3 ray = layer_ray(NULL, (float)column, (float)row);
        double view[3] = {(double)ray.x, (double)ray.y, (double)ray.z}, normal[3] = {range(-0.1, 0.1), 1, range(-0.1, 0.1)}, bent[3];
        unit3(view);
        unit3(normal);
        if (view[1] > -0.15 || !refract3(view, normal, 1 / 1.333, bent))
            continue;
        const double along = (double)narrow_data.distance / -view[1], way = floor_depth / -bent[1];
        const WaterHit hit = {vec3((float)view[0], (float)view[1], (float)view[2]), (float)along, vec3((float)normal[0], (float)normal[1], (float)normal[2]),
                              (float)column, (float)row};
        const FoundPoint f = find_refracted(NULL, hit, bent_at(NULL, hit.view, hit.normal));
        if (!(f.shown > 0))
            continue;
        found++;
        certain += f.residual < 1.0f;
        const double size = along + way;
        assert_true(fabs((double)f.position.x - along * view[0] - way * bent[0]) < 1e-4 * size);
        assert_true(fabs((double)f.position.z - along * view[2] - way * bent[2]) < 1e-4 * size);
        assert_true(fabs((double)f.after - way) < 1e-4 * size);
    }
    printf("waves: %d of %d points within a pixel\n", certain, found);
    assert_true(found > 2000 && certain > 0.9 * found);
}

/* Whether a ray that ends at `f` passes behind what a layer shows at a place of its image, 3 × 3 pixels that stand `share` times as deep as it does. */
static bool passes_behind(WaterHit hit, FoundPoint f, Place p, double share)
{
    post_column = rint((double)p.column) + 40, post_row = rint((double)p.row) + 30;
    post_depth = share * (double)p.depth;
    assert_true(passed_place(NULL, LAYER_REFRACTED, hit, f, 0.0f).inside == 0);
    const Place found = passed_place(NULL, LAYER_REFRACTED, hit, f, 1.0f);
    assert_true(found.inside == 0 || (fabs((double)found.column - post_column) <= 1 && fabs((double)found.row - post_row) <= 1));
    post_column = -1;
    return found.inside > 0;
}

/* Where the refracted layer shows the point of a ray `way` metres behind the surface. */
static Place image_behind(WaterHit hit, const double bent[3], double way)
{
    const double along = (double)hit.along;
    const vec3 at = vec3((float)(along * (double)hit.view.x + way * bent[0]), (float)(way * bent[1]), (float)(along * (double)hit.view.z + way * bent[2]));
    return place_at(NULL, from_camera(NULL, layer_image(NULL, LAYER_REFRACTED, at)));
}

/* A ray that bends over the picture of the floor passes behind what stands before it along its image, which is a curve, and behind nothing else. */
static void rays_pass_behind_things(void **state)
{
    (void)state;
    numbers.state = 9;
    int places = 0, curved = 0, wrong = 0;
    for (int i = 0; i < 20000; i++) {
        const bool under = i % 2;
        floor_depth = range(1, 6);
        set_view(under, range(1, 5), under ? range(0.9, 1.4) : range(0.4, 1.3));
        const double column = floor(range(20, WIDTH - 20)), row = floor(range(20, HEIGHT - 20));
        const vec3 ray = layer_ray(NULL, (float)column, (float)row);
        double view[3] = {(double)ray.x, (double)ray.y, (double)ray.z}, normal[3] = {range(-0.3, 0.3), 1, range(-0.3, 0.3)}, bent[3];
        unit3(view);
        unit3(normal);
        if (view[1] > -0.15 || !refract3(view, normal, (double)narrow_data.ratio, bent) || bent[1] > -0.15)
            continue;
        const double along = (double)narrow_data.distance / -view[1], way = floor_depth / -bent[1];
        const WaterHit hit = {vec3((float)view[0], (float)view[1], (float)view[2]), (float)along, vec3((float)normal[0], (float)normal[1], (float)normal[2]),
                              (float)column, (float)row};
        const FoundPoint f = find_refracted(NULL, hit, bent_at(NULL, hit.view, hit.normal));
        if (!(f.shown > 0 && f.residual < 1))
            continue;
        assert_true(passed_place(NULL, LAYER_REFRACTED, hit, f, 1.0f).inside == 0);
        const double ends[2] = {(double)f.column - 40 - column, (double)f.row - 30 - row}, length = hypot(ends[0], ends[1]);
        for (int k = 1; k < 4; k++) {
            const Place p = image_behind(hit, bent, way * k / 4), next = image_behind(hit, bent, way * k / 4 * 1.02);
            const double to[2] = {(double)p.column - column, (double)p.row - row};
            const double pixel = hypot((double)(next.column - p.column), (double)(next.row - p.row));
            const bool sinks = fabs((double)(next.depth / p.depth) - 1) * 3 > 0.2 * pixel; /* by a fifth within what stands there */
            if (sinks || hypot(to[0], to[1]) < 4 || hypot(to[0] - ends[0], to[1] - ends[1]) < 4)
                continue;
            places++;
            wrong += !passes_behind(hit, f, p, 0.8) + passes_behind(hit, f, p, 1.25);
            curved += fabs(to[0] * ends[1] - to[1] * ends[0]) > 2 * length;
        }
    }
    printf("behind things: %d places, %d of them more than two pixels beside the straight line, %d wrong\n", places, curved, wrong);
    assert_true(places > 3000 && curved > 200);
    assert_true(wrong < places / 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(footprints_follow_the_rays),   cmocka_unit_test(spreads_turn_with_the_camera), cmocka_unit_test(rays_bend_by_snells_law),
        cmocka_unit_test(flat_water_needs_no_search),   cmocka_unit_test(waves_lead_to_the_floor),      cmocka_unit_test(rays_meet_the_next_wave),
        cmocka_unit_test(parts_of_light_are_all_of_it), cmocka_unit_test(rays_pass_behind_things),      cmocka_unit_test(rays_beside_meet_the_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
