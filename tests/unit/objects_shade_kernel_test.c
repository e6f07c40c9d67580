/* SPDX-License-Identifier: MIT
 * The kernels that shade points of objects, at one lane, against box means, integrals, areas of light and finite differences in double precision. */
#include "unit/light_data.h"
#include "unit/objects_lane.h"

static ShadeData shade_data; /* of the case */

#define SHADE(cx) shade_data
#define CHOPPY_LIGHT(cx) 0

/* A texture of any size, whose texels' colours are a formula. */
typedef struct TextureLevel {
    real width, height;
} TextureLevel;

#define TEXTURE_NAME TextureLevel
#define TEXTURE_LEVEL(cx, name, level) ((TextureLevel){fmaxf((name).width / exp2f(level), 1), fmaxf((name).height / exp2f(level), 1)})

static double texel_at(int column, int row, int color) { return fmod(0.37 * (column + 1) * (color + 1) + 0.61 * (row + 1), 1); }

static bool texels_inside;

KERNEL vec3 TEXTURE_TEXEL(CTX cx, TextureLevel l, real column, real row)
{
    texels_inside = texels_inside && column >= 0 && row >= 0 && column < l.width && row < l.height;
    return vec3((float)texel_at((int)column, (int)row, 0), (float)texel_at((int)column, (int)row, 1), (float)texel_at((int)column, (int)row, 2));
}

KERNEL vec3 TEXTURE(CTX cx, real texture, real u, real v, real level) { return vec3(texture, u, v * level); }
KERNEL real SUN_VISIBILITY(CTX cx, vec3 position, vec3 first, vec3 second, mask dry) { return 1.0f; }

#include "kernels/refraction/texture.k"
#include "kernels/refraction/material.k"
#include "kernels/common/mirror.k"

#include "unit/kernel_words_off.h"

/* ---- patterns ---- */

static double tile_at(double x, double joint)
{
    const double f = x - floor(x);
    return f > joint / 2 && f < 1 - joint / 2 ? 1 : 0;
}

static double square_at(double x) { return ((long long)floor(x) & 1) == 0 ? 1 : -1; }

static double pattern_at(int kind, double joint, double u, double v)
{
    const double tiles = 1 - tile_at(u, joint) * tile_at(v, joint), checks = 0.5 * (1 - square_at(u) * square_at(v)), stripes = 0.5 * (1 - square_at(u));
    return kind == 1 ? tiles : kind == 2 ? checks : kind == 3 ? stripes : 0;
}

static void patterns_are_box_means(void **state)
{
    (void)state;
    enum { STEPS = 400 };
    numbers.state = 1;
    double worst = 0;
    for (int i = 0; i < 400; i++) {
        const int kind = i % 4;
        const double joint = range(0, 0.5), u = range(-30, 30), v = range(-30, 30), wide = exp(range(-4, 2)), high = exp(range(-4, 2));
        double sum = 0;
        for (int y = 0; y < STEPS; y++)
            for (int x = 0; x < STEPS; x++)
                sum += pattern_at(kind, joint, u + wide * ((x + 0.5) / STEPS - 0.5), v + high * ((y + 0.5) / STEPS - 0.5));
        const float share = pattern_share(NULL, (float)kind, (float)joint, (float)u, (float)v, (float)wide, (float)high);
        worst = fmax(worst, fabs((double)share - sum / (STEPS * STEPS)));
    }
    printf("patterns: within %.2g of the box's mean\n", worst);
    assert_true(worst < 0.012); /* the sum's own steps: two edges of 1/400 a side, twice */
}

/* ---- textures ---- */

/* Bilinear, repeated. */
static double level_at(int width, int height, double u, double v, int color)
{
    const double x = u * width - 0.5, y = v * height - 0.5, across = x - floor(x), down = y - floor(y);
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double column = floor(x) + (k & 1), row = floor(y) + (k >> 1);
        sum += (k & 1 ? across : 1 - across) * (k >> 1 ? down : 1 - down) *
               texel_at((int)(column - width * floor(column / width)), (int)(row - height * floor(row / height)), color);
    }
    return sum;
}

static void textures_repeat_between_texels_and_levels(void **state)
{
    (void)state;
    numbers.state = 6;
    texels_inside = true;
    double worst = 0;
    for (int i = 0; i < 4000; i++) {
        const int width = 1 + (int)range(0, 300), height = i % 4 == 0 ? 256 : 1 + (int)range(0, 300);
        const TextureLevel t = {(float)width, (float)height};
        const bool edge = i % 5 == 0; /* at a multiple of a texel's half, where a rounded place changes the texels */
        const float u = edge ? floorf((float)range(-900, 900)) / (float)(2 * width) : (float)range(-30, 30), v = (float)range(-2, 2),
                    level = i % 3 ? 0 : (float)range(-1, 1);
        const vec3 found = texture_color(NULL, t, u, v, level, 0);
        for (int k = 0; k < 3; k++)
            worst = fmax(worst, fabs((double)(k == 0 ? found.x : k == 1 ? found.y : found.z) - level_at(width, height, (double)u, (double)v, k)));
    }
    const TextureLevel t = {64, 32};
    for (int i = 0; i < 400; i++) {
        const float u = (float)range(-3, 3), v = (float)range(-3, 3), level = (float)range(0, 3);
        const int fine = (int)level;
        const double share = (double)level - fine;
        const vec3 found = texture_color(NULL, t, u, v, level, 4);
        const double wanted =
            (1 - share) * level_at(64 >> fine, 32 >> fine, (double)u, (double)v, 1) + share * level_at(32 >> fine, 16 >> fine, (double)u, (double)v, 1);
        worst = fmax(worst, fabs((double)found.y - wanted));
    }
    static const float far_away[] = {-1e-30f, 1e8f, -1e8f, 9.9e8f, 1e9f, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof far_away / sizeof *far_away; i++) {
        const vec3 found = texture_color(NULL, t, far_away[i], 0.3f, 0, 0);
        assert_true(fabsf(far_away[i]) < 1e9f ? found.x >= 0 && found.x < 1 : found.x == 0);
    }
    printf("textures: within %.2g of bilinear colour in double precision\n", worst);
    assert_true(texels_inside);
    assert_true(worst < 1e-4); /* 2⁻²³ of 300 texels */
}

/* ---- highlights ---- */

static double ggx_at(double alpha, double cosine)
{
    const double squared = alpha * alpha, spread = cosine * cosine * (squared - 1) + 1;
    return squared / (pi * spread * spread);
}

static double density_of(GlossyNormals g) { return (double)g.squared / (pi * (double)g.spread * (double)g.spread); }

/* Where nothing turns, it is GGX. Where normals turn along one axis, it is near the mean of GGX over them, and its peak within a fifth. */
static void highlights_are_means_over_normals(void **state)
{
    (void)state;
    numbers.state = 7;
    double flat = 0, error = 0, size = 0, peak = 0;
    for (int i = 0; i < 400; i++) {
        const double alpha = exp(range(-4, 0)), across = range(0, 0.4), along = range(0, 0.4), turn = range(0.5, 2) * alpha;
        HitSurface s = {.shading = vec3(0, 1, 0)};
        const double cosine = sqrt(1 - across * across - along * along);
        const vec3 half = vec3((float)across, (float)cosine, (float)along);
        flat = fmax(flat, fabs(density_of(glossy_normals(NULL, (float)alpha, s, half)) / ggx_at(alpha, cosine) - 1));
        if (turn > 0.3)
            continue;
        s.turn_first = vec3((float)(0.6 * turn), 0, 0);
        s.turn_second = vec3((float)(0.8 * turn), 0, 0);
        double sum = 0, weights = 0, summit = 0;
        for (int k = -400; k <= 400; k++) {
            const double tilt = k / 100.0 * turn, weight = exp(-tilt * tilt / (2 * turn * turn));
            sum += weight * ggx_at(alpha, across * sin(tilt) + cosine * cos(tilt));
            summit += weight * ggx_at(alpha, cos(tilt));
            weights += weight;
        }
        const double found = density_of(glossy_normals(NULL, (float)alpha, s, half)), top = density_of(glossy_normals(NULL, (float)alpha, s, vec3(0, 1, 0)));
        error += fabs(found - sum / weights);
        size += sum / weights;
        peak = fmax(peak, fabs(top * weights / summit - 1));
    }
    printf("highlights: flat within %.2g, of a curved surface off by %.3f of their mean, their peaks by %.3f at most\n", flat, error / size, peak);
    assert_true(flat < 2e-3);
    assert_true(error / size < 0.17);
    assert_true(peak < 0.2);
}

/* Λ of Smith's masking for GGX. */
static double smith_at(double alpha, double cosine) { return (sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1) / 2; }

/* D G₂/(4 n·v), and (1 − c)⁵. */
static void lobes_are_ggx_behind_smiths_masking(void **state)
{
    (void)state;
    numbers.state = 9;
    double lobe = 0, edge = 0;
    for (int i = 0; i < 400; i++) {
        const double alpha = exp(range(-3, 0)), cosine = range(0.5, 1), l = range(0.05, 1), v = range(0.05, 1);
        const HitSurface s = {.shading = vec3(0, 1, 0)};
        const GlossyNormals g = glossy_normals(NULL, (float)alpha, s, vec3((float)sqrt(1 - cosine * cosine), (float)cosine, 0));
        const double expected = ggx_at(alpha, cosine) / (4 * v * (1 + smith_at(alpha, l) + smith_at(alpha, v)));
        lobe = fmax(lobe, fabs((double)glossy_lobe(NULL, g, (float)l, (float)v) / expected - 1));
        edge = fmax(edge, fabs((double)schlick(NULL, (float)cosine) - pow(1 - cosine, 5)));
    }
    printf("lobes: within %.2g of GGX and Smith; Schlick's factor within %.2g\n", lobe, edge);
    assert_true(lobe < 2e-3 && edge < 1e-6);
}

/* The turning of the normal over the footprint against that between points a fifth of its deviation apart. */
static void normals_turn_as_they_do_between_points(void **state)
{
    (void)state;
    numbers.state = 8;
    double worst = 0;
    int curved = 0;
    for (int i = 0; i < 400; i++) {
        HitTriangle t = {.corner = vec3(0, 0, 0), .edge_1 = vec3(1, 0, (float)range(-0.3, 0.3)), .edge_2 = vec3((float)range(-0.3, 0.3), 0, -1)};
        vec3 *const normals[3] = {&t.normal_0, &t.normal_1, &t.normal_2};
        for (int k = 0; k < 3; k++) {
            double n[3] = {range(-0.5, 0.5), 1, range(-0.5, 0.5)};
            unit3(n);
            *normals[k] = vec3((float)n[0], (float)n[1], (float)n[2]);
        }
        double ray[3] = {range(-1, 1), -1, range(-1, 1)};
        unit3(ray);
        HitRay h = {.position = vec3(0.3f, 0, -0.3f), .direction = vec3((float)ray[0], (float)ray[1], (float)ray[2])};
        h.footprint = (RayFootprint){.side_side = 1e-4f, .side_rise = (float)range(-5e-5, 5e-5), .rise_rise = 1e-4f};
        const HitSurface s = hit_surface(NULL, t, h);
        const vec3 *const sides[2] = {&s.first, &s.second}, *const turns[2] = {&s.turn_first, &s.turn_second};
        for (int k = 0; k < 2; k++) {
            const float part = 0.1f / 3.4641016f; /* of a side, √12 deviations long */
            HitRay a = h, b = h;
            a.position = sub(h.position, scale(*sides[k], part));
            b.position = add(h.position, scale(*sides[k], part));
            const vec3 change = scale(sub(hit_surface(NULL, t, b).shading, hit_surface(NULL, t, a).shading), 5.0f);
            const double size = sqrt((double)length_squared(change));
            worst = fmax(worst, sqrt((double)length_squared(sub(change, *turns[k]))) - 0.02 * size);
            curved += size > 1e-3;
        }
    }
    printf("turning normals: off by %.2g at most, beside 2%% of themselves; %d turn\n", worst, curved);
    assert_true(worst < 1e-4 && curved > 300);
}

/* ---- light in water ---- */

static void glow_is_the_integral(void **state)
{
    (void)state;
    numbers.state = 2;
    for (int i = 0; i < 200; i++) {
        const double light = range(0, 10), sigma = exp(range(-6, 1)), b = sigma * range(0, 1), slant = range(1, 1.5), depth = range(0, 5),
                     distance = exp(range(-3, 3)), fall = range(-1, 1) > 0 ? range(0, 1) : -range(0, 1) * fmin(depth / distance, 1);
        double sum = 0;
        for (int k = 0; k < 20000; k++) {
            const double x = distance * (k + 0.5) / 20000;
            sum += light * b / (4 * pi) * exp(-sigma * slant * (depth + fall * x)) * exp(-sigma * x) * distance / 20000;
        }
        const float found = scattered_once(NULL, (float)light, (float)sigma, (float)b, (float)slant, (float)depth, (float)fall, (float)distance);
        assert_true(fabs((double)found - sum) <= 1e-4 * sum + 1e-7);
    }
}

static void water_dims_by_beers_law(void **state)
{
    (void)state;
    numbers.state = 3;
    for (int i = 0; i < 200; i++) {
        const double taken = range(0, 2), scattered = range(0, 2), distance = exp(range(-3, 2));
        shade_data = (ShadeData){.absorption_g = (float)taken, .scattering_g = (float)scattered};
        const vec3 left = water_transmittance(NULL, (float)distance);
        assert_true(fabs((double)left.x - 1) < 1e-6 && fabs((double)left.z - 1) < 1e-6);
        assert_true(fabs((double)left.y - exp(-(taken + scattered) * distance)) < 1e-6);
    }
}

/* A view from under water along the surface: down to the depth of what the surface mirrors, or on without end, each with the light of its own depth. */
static void mirrored_ways_have_two_parts(void **state)
{
    (void)state;
    enum { STEPS = 20000 };
    numbers.state = 7;
    for (int i = 0; i < 100; i++) {
        const bool endless = i % 2;
        const double depth = range(0.5, 5), before = depth * exp(range(0, 4)), fall = range(0.05, 0.9), after = endless ? 400 : exp(range(-1, 4)),
                     sigma = exp(range(-3, 0)), b = sigma * range(0.1, 1), sun = range(0, 10), sky = range(0, 10), slant = range(1, 1.4);
        shade_data = (ShadeData){.absorption_r = (float)(sigma - b),
                                 .scattering_r = (float)b,
                                 .sun_water_r = (float)sun,
                                 .sky_water_r = (float)sky,
                                 .sun_water_slant = (float)slant,
                                 .camera_depth = (float)depth,
                                 .glow_gain = 1};
        double sum = 0;
        for (int k = 0; k < 2 * STEPS; k++) {
            const bool behind = k >= STEPS;
            const double step = (behind ? after : before) / STEPS, x = step * (k % STEPS + 0.5), way = behind ? before + x : x;
            const double down = behind ? fall * x : depth * (1 - x / before);
            sum += b / (4 * pi) * step * exp(-sigma * way) * (sun * exp(-sigma * slant * down) + sky * exp(-sigma * 1.2 * down));
        }
        const HitRay ray = {.position = vec3(0, (float)(-fall * after), 0),
                            .direction = vec3((float)sqrt(1 - fall * fall), (float)-fall, 0),
                            .before = (float)before,
                            .after = endless ? 0 : (float)after,
                            .water = (float)(endless ? before : before + after),
                            .gain = 1};
        const HitTriangle triangle = {.edge_1 = vec3(1, 0, 0), .edge_2 = vec3(0, 0, 1)};
        const HitMaterial black = {.metallic = 1, .alpha = 1, .inverse_size = 1};
        const double found = (double)(endless ? shade_nothing(NULL, ray, vec3(0, 0, 0)) : shade_hit(NULL, black, triangle, ray)).x;
        if (!(fabs(found - sum) <= 1e-3 * sum + 1e-5 + 0.05 * exp(-sigma * (before + after))))
            fail_msg("%s, case %d: %g, the integral is %g", endless ? "without end" : "to an object", i, found, sum);
    }
}

/* ---- caustics ---- */

static void surface_at(double x, double z, double out[6])
{
    memset(out, 0, 6 * sizeof *out);
    for (int i = 0; i < shade_data.caustic_waves; i++) {
        const double a = 2 * pi * (double)waves[i].turns_x, b = 2 * pi * (double)waves[i].turns_z, A = (double)waves[i].amplitude;
        const double phase = a * x + b * z + 2 * pi * (double)waves[i].phase;
        out[0] += A * sin(phase), out[1] += A * a * cos(phase), out[2] += A * b * cos(phase);
    }
}

static void send(const double light[3], double x, double z, double depth, double to[2])
{
    double s[6], bent[3];
    surface_at(x, z, s);
    double normal[3] = {-s[1], 1, -s[2]}, ray[3] = {-light[0], -light[1], -light[2]};
    unit3(normal);
    assert_true(refract3(ray, normal, 1 / 1.333, bent));
    to[0] = x - (depth + s[0]) * bent[0] / bent[1];
    to[1] = z - (depth + s[0]) * bent[2] / bent[1];
}

/* Before rays cross, the light at a point is that of the one place that sends its ray there, over the share of the area. */
static void caustics_are_shares_of_area(void **state)
{
    (void)state;
    numbers.state = 4;
    double worst = 0;
    for (int i = 0; i < 400; i++) {
        double light[3] = {range(-0.5, 0.5), 1, range(-0.5, 0.5)};
        shade_data = (ShadeData){.index = 1.333f, .caustic_waves = 4, .sun_air_x = (float)light[0], .sun_air_z = (float)light[2]};
        unit3(light);
        for (int k = 0; k < 4; k++) {
            waves[k] = (SearchWave){.turns_x = (float)range(-0.5, 0.5), .turns_z = (float)range(-0.5, 0.5), .phase = (float)range(0, 1), .amplitude = 0.01f};
            waves[k].slope_x = (float)(0.02 * pi) * waves[k].turns_x, waves[k].slope_z = (float)(0.02 * pi) * waves[k].turns_z;
        }
        const double x = range(-5, 5), z = range(-5, 5), depth = range(0.5, 3), h = 1e-4;
        double at[2], right[2], ahead[2];
        send(light, x, z, depth, at);
        send(light, x + h, z, depth, right);
        send(light, x, z + h, depth, ahead);
        const double det = ((right[0] - at[0]) * (ahead[1] - at[1]) - (right[1] - at[1]) * (ahead[0] - at[0])) / (h * h);
        const float share = caustic_share(NULL, vec3((float)at[0], (float)-depth, (float)at[1]), 0.0f);
        double s[6];
        surface_at(x, z, s);
        const double falls = 1 - (s[1] * light[0] + s[2] * light[2]) / light[1]; /* on a square metre of the mean surface */
        worst = fmax(worst, fabs((double)share * sqrt(det * det + 0.02) / falls - 1));
    }
    printf("caustics: within %.2g of the share of area\n", worst);
    assert_true(worst < 5e-3);
}

/* ---- the light through the surface ---- */

static void slopes_bend_the_view_to_the_light(void **state)
{
    (void)state;
    numbers.state = 5;
    int seen = 0;
    for (int i = 0; i < 2000; i++) {
        /* Mirrored at the surface: the eye is above, the light below. */
        const double elevation = range(0.2, 1.5), azimuth = range(-0.7, 0.7), steep = range(0.7, 1.5);
        double light[3] = {cos(elevation), -sin(elevation), 0}, view[3] = {-cos(steep) * cos(azimuth), sin(steep), cos(steep) * sin(azimuth)};
        double e[3] = {-light[2], 0, light[0]}, f[3];
        unit3(e);
        for (int k = 0; k < 3; k++)
            f[k] = light[(k + 1) % 3] * e[(k + 2) % 3] - light[(k + 2) % 3] * e[(k + 1) % 3];
        frame_data = (FrameData){.lights[0] = light_data(light, e, f), .index_of_refraction = 1 / 1.333f, .camera_under = 1};
        const vec3 v = vec3((float)view[0], (float)view[1], (float)view[2]);
        const Mirror m = mirror_at(NULL, v);
        const double cosine =
            ((double)m.slope.x * light[0] - light[1] + (double)m.slope.y * light[2]) / sqrt(1 + pow((double)m.slope.x, 2) + pow((double)m.slope.y, 2));
        if (!(m.possible > 0) || cosine < 0.2) /* light along the surface: differences tell nothing */
            continue;
        seen++;
        const double ray[3] = {-view[0], -view[1], -view[2]}, h = 1e-5;
        double end[3][2];
        for (int k = 0; k < 3; k++) {
            double normal[3] = {-((double)m.slope.x + (k == 1 ? h : 0)), 1, -((double)m.slope.y + (k == 2 ? h : 0))}, bent[3];
            unit3(normal);
            assert_true(refract3(ray, normal, 1.333, bent));
            end[k][0] = dot3(bent, e) / dot3(bent, light);
            end[k][1] = dot3(bent, f) / dot3(bent, light);
            assert_true(dot3(bent, light) > 0);
        }
        const double j[4] = {(end[1][0] - end[0][0]) / h, (end[2][0] - end[0][0]) / h, (end[1][1] - end[0][1]) / h, (end[2][1] - end[0][1]) / h};
        const double found[4] = {(double)m.j.ex, (double)m.j.ez, (double)m.j.fx, (double)m.j.fz};
        assert_true(hypot(end[0][0], end[0][1]) < 2e-5);
        for (int k = 0; k < 4; k++)
            assert_true(fabs(found[k] - j[k]) < 3e-3 * (1 + fabs(j[k])));
        const LightRay l = light_ray(NULL, v, m.slope);
        assert_true(fabs((double)l.ray.x - light[0]) + fabs((double)l.ray.y - light[1]) + fabs((double)l.ray.z - light[2]) < 2e-5);
    }
    printf("light under water: %d of 2000 views have a slope for it\n", seen);
    assert_true(seen > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_are_box_means),
        cmocka_unit_test(textures_repeat_between_texels_and_levels),
        cmocka_unit_test(highlights_are_means_over_normals),
        cmocka_unit_test(lobes_are_ggx_behind_smiths_masking),
        cmocka_unit_test(normals_turn_as_they_do_between_points),
        cmocka_unit_test(glow_is_the_integral),
        cmocka_unit_test(water_dims_by_beers_law),
        cmocka_unit_test(mirrored_ways_have_two_parts),
        cmocka_unit_test(caustics_are_shares_of_area),
        cmocka_unit_test(slopes_bend_the_view_to_the_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
