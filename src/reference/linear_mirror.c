/* SPDX-License-Identifier: MIT
 * Gaussians of slopes mirrored onto the light plane: true and linear. */
#include "reference/linear_mirror.h"

#include <math.h>

#include "reference/equations.h"

static const double pi = 3.14159265358979323846;

static double gaussian(const double mean[2], const double covariance[3], const double at[2])
{
    const double x = at[0] - mean[0], y = at[1] - mean[1];
    const double det = covariance[0] * covariance[2] - covariance[1] * covariance[1];
    return exp(-0.5 * (covariance[2] * x * x - 2 * covariance[1] * x * y + covariance[0] * y * y) / det) / (2 * pi * sqrt(det));
}

static double determinant(const double j[2][2]) { return j[0][0] * j[1][1] - j[0][1] * j[1][0]; }

/* Density of the mirrored rays at a point of the light plane: the density of the one slope that sends a ray there, divided by the map's determinant. */
static double mirrored_density(const double to_eye[3], const double light[3], const double e[3], const double f[3], const slope_law *law, double x, double y)
{
    double direction[3], slope[2], j[2][2];
    for (int i = 0; i < 3; i++)
        direction[i] = light[i] + x * e[i] + y * f[i];
    const double length = sqrt(1 + x * x + y * y);
    for (int i = 0; i < 3; i++)
        direction[i] /= length;
    if (direction[1] + to_eye[1] <= 1e-9)
        return 0;
    mirror_slope(to_eye, direction, slope);
    const double density = gaussian(law->mean, law->covariance, slope);
    return density > 0 && mirror_map_jacobian(to_eye, light, slope, j) ? density / fabs(determinant(j)) : 0;
}

double mirror_disk_fraction(const double to_eye[3], const double light[3], const slope_law *law, double radius)
{
    /* Gauss–Legendre in the squared distance, even steps around. */
    static const double node[6] = {0.12523340851146891547, 0.36783149899818019375, 0.58731795428661744730,
                                   0.76990267419430468704, 0.90411725637047485668, 0.98156063424671925069};
    static const double weight[6] = {0.24914704581340278500, 0.23349253653835480876, 0.20316742672306592175,
                                     0.16007832854334622633, 0.10693932599531843096, 0.04717533638651182719};
    enum { AROUND = 24 };
    double e[3], f[3], sum = 0;
    light_plane_axes(light, e, f);
    for (int i = 0; i < 12; i++) {
        const double u = 0.5 + 0.5 * (i < 6 ? -node[i] : node[i - 6]), distance = radius * sqrt(u);
        for (int k = 0; k < AROUND; k++) {
            const double angle = 2 * pi * (k + 0.5) / AROUND;
            sum += 0.5 * weight[i % 6] / AROUND * mirrored_density(to_eye, light, e, f, law, distance * cos(angle), distance * sin(angle));
        }
    }
    return sum * pi * radius * radius;
}

typedef struct linear_map {
    double point[2], jacobian[2][2];
} linear_map;

static bool linear_map_at(const double to_eye[3], const double light[3], const double at[2], linear_map *map)
{
    return mirror_map(to_eye, light, at, map->point) && mirror_map_jacobian(to_eye, light, at, map->jacobian);
}

/* Mean and covariance that the linear map, expanded at `at`, gives on the light plane. */
static void map_law(const linear_map *map, const slope_law *law, const double at[2], double mean[2], double covariance[3])
{
    const double(*j)[2] = map->jacobian, *s = law->covariance;
    for (int row = 0; row < 2; row++)
        mean[row] = map->point[row] + j[row][0] * (law->mean[0] - at[0]) + j[row][1] * (law->mean[1] - at[1]);
    covariance[0] = j[0][0] * j[0][0] * s[0] + 2 * j[0][0] * j[0][1] * s[1] + j[0][1] * j[0][1] * s[2];
    covariance[1] = j[0][0] * j[1][0] * s[0] + (j[0][0] * j[1][1] + j[0][1] * j[1][0]) * s[1] + j[0][1] * j[1][1] * s[2];
    covariance[2] = j[1][0] * j[1][0] * s[0] + 2 * j[1][0] * j[1][1] * s[1] + j[1][1] * j[1][1] * s[2];
}

double linear_disk_fraction(const double to_eye[3], const double light[3], const slope_law *law, double radius, const double at[2])
{
    linear_map map;
    double mean[2], covariance[3];
    if (!linear_map_at(to_eye, light, at, &map))
        return 0;
    map_law(&map, law, at, mean, covariance);
    return disk_probability(mean, covariance, radius);
}

/* The integral is taken over slopes, where the true density is the law itself: r = Φ(s) turns ∬ |N(r) − p(s(r))/|J|| dr into ∬ |N(Φ(s)) |J| − p(s)| ds. The
 * part of the linear density that these slopes do not reach is added at the end. */
double linear_density_error(const double to_eye[3], const double light[3], const slope_law *law)
{
    enum { STEPS = 64 };
    linear_map map;
    double mean[2], covariance[3], difference = 0, reached = 0;
    if (!linear_map_at(to_eye, light, law->mean, &map))
        return 2;
    map_law(&map, law, law->mean, mean, covariance);
    const double reach_x = 6 * sqrt(law->covariance[0]), reach_z = 6 * sqrt(law->covariance[2]), cell = 4 * reach_x * reach_z / (STEPS * STEPS);
    for (int row = 0; row < STEPS; row++)
        for (int column = 0; column < STEPS; column++) {
            const double slope[2] = {law->mean[0] + reach_x * (2 * (column + 0.5) / STEPS - 1), law->mean[1] + reach_z * (2 * (row + 0.5) / STEPS - 1)};
            const double density = gaussian(law->mean, law->covariance, slope);
            double point[2], j[2][2], linear = 0;
            if (mirror_map(to_eye, light, slope, point) && mirror_map_jacobian(to_eye, light, slope, j))
                linear = gaussian(mean, covariance, point) * fabs(determinant(j));
            difference += fabs(linear - density) * cell;
            reached += linear * cell;
        }
    return fmin(difference + fmax(1 - reached, 0), 2);
}
