/* SPDX-License-Identifier: MIT
 *
 * Light scattered by a spherical atmosphere.
 */
#include "frame/scattering.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BANDS SPECTRUM_BANDS
#define PI 3.14159265358979323846

/* Lengths are in kilometres throughout this file. */
#define EARTH 6371.0
#define TOP_HEIGHT 120.0
#define TOP (EARTH + TOP_HEIGHT)
#define SEA_ALBEDO 0.06

#define LIGHT_ROWS 40    /* heights of the table of transmittance */
#define LIGHT_COLUMNS 96 /* zenith angles above the horizon of the table of transmittance */
#define MEAN_ROWS 16     /* heights of the table of mean radiance */
#define MEAN_BELOW 40    /* angles of light below the horizontal in that table: sines from −0.4 to 0 in steps of 0.01 */
#define MEAN_ABOVE 24    /* angles above it: sine = (i/24)² */
#define MEAN_COLUMNS (MEAN_BELOW + MEAN_ABOVE + 1)
#define VIEW_STEPS 40
#define AIR_STEPS 12 /* number of stretches of a path that ends in the air */
#define GATHER_STEPS 12
#define GATHER_ZENITHS 8
#define GATHER_AZIMUTHS 4
#define ORDERS 4 /* orders of scattering that are gathered one by one; a geometric series stands for the others */

/* A radiance or a fraction for each band, as a vector; entries beyond BANDS are unused. */
typedef float band_values __attribute__((vector_size(16 * sizeof(float)), aligned(16)));
_Static_assert(BANDS <= 16, "bands fit into a vector");

/* Coefficients at full density, 1/km. */
typedef struct medium {
    double rayleigh[BANDS];
    double aerosol_scattering[BANDS];
    double aerosol[BANDS];
    double ozone[BANDS];
} medium;

struct scattering {
    medium air;
    double sin_radius;
    band_values light[LIGHT_ROWS][LIGHT_COLUMNS];  /* transmittance to space */
    band_values mean[MEAN_ROWS][MEAN_COLUMNS];     /* mean radiance of all orders */
    band_values order[2][MEAN_ROWS][MEAN_COLUMNS]; /* of the last two orders, while gathering */
};

/* A stretch of a ray: its place in the tables, and the light that it scatters to the eye per unit of incoming light. */
typedef struct ray_step {
    double distance, radius;
    double horizon;                /* sine of the horizon's depression, ≤ 0 */
    double nearest, inverse_range; /* least distance to space, and 1/(greatest − least distance), for the columns of the transmittance table */
    int light_row, mean_row;
    float light_up, mean_up;
    band_values rayleigh, aerosol, all; /* transmittance to the eye × scattering × length */
} ray_step;

struct scattering_ray {
    double start; /* radius */
    int count;
    ray_step steps[VIEW_STEPS];
    bool hits_ground;
    double length;
    band_values through; /* transmittance of the whole ray */
};

static double clamped(double x, double least, double most) { return x < least ? least : x > most ? most : x; }

/* ---- the medium ----------------------------------------------------------------------------------------- */

static medium medium_make(double turbidity)
{
    /* Air at 15 °C (Bucholtz 1995): 0.01162/km at 550 nm. Aerosol: Ångström exponent 1, single scattering albedo 0.95, as clean sea air.
     * Ozone: 300 Dobson units in a layer of triangular profile, 12 … 37 km, peak at 22 km. */
    const double aerosol_scale = 1.2;
    const double ozone_column = 300.0 * 2.687e20;          /* molecules per m² */
    const double ozone_peak = ozone_column / (0.5 * 25.0); /* per m² and km */
    medium air;
    for (int b = 0; b < BANDS; ++b) {
        double nm = SPECTRUM_FIRST + SPECTRUM_STEP * b;
        air.rayleigh[b] = 0.01162 * pow(550.0 / nm, 4.08);
        air.aerosol[b] = 0.0972 * (turbidity - 1.0) / aerosol_scale * (550.0 / nm);
        air.aerosol_scattering[b] = 0.95 * air.aerosol[b];
        air.ozone[b] = spectrum_ozone(nm) * ozone_peak;
    }
    return air;
}

/* Density of air over sea level's: U.S. Standard Atmosphere 1976, exponential between its nodes. */
static double rayleigh_density(double height)
{
    static const double minus_log[] = {0.0,   0.509, 1.085, 1.839, 2.623, 3.412, 4.198, 4.979, 5.726, 6.430, 7.084, 7.690, 8.282,
                                       8.920, 9.602, 10.32, 11.10, 11.93, 12.79, 13.67, 14.59, 15.46, 16.30, 17.07, 17.78}; /* every 5 km up to 120 */
    double x = clamped(height / 5.0, 0.0, 23.999);
    int i = (int)x;
    return spectrum_exp(-(minus_log[i] + (minus_log[i + 1] - minus_log[i]) * (x - i)));
}

static double aerosol_density(double height) { return spectrum_exp(-fmax(height, 0.0) / 1.2); }

static double ozone_density(double height) { return fmax(0.0, height < 22.0 ? (height - 12.0) / 10.0 : (37.0 - height) / 15.0); }

static double rayleigh_phase(double cosine) { return 3.0 / (16.0 * PI) * (1.0 + cosine * cosine); }

/* Cornette and Shanks 1992. */
static double lobe_phase(double cosine, double g)
{
    double base = fmax(1.0 + g * g - 2.0 * g * cosine, 1e-9);
    return 3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + cosine * cosine) / ((2.0 + g * g) * base * sqrt(base));
}

/* Sea aerosol has large drops with a narrow lobe and small ones with a broad lobe. 32 directions cannot sample the narrow lobe
 * without noise, so the mean radiance is gathered with one milder lobe. */
static double aerosol_phase(double cosine, bool seen) { return seen ? 0.5 * (lobe_phase(cosine, 0.9) + lobe_phase(cosine, 0.6)) : lobe_phase(cosine, 0.45); }

/* ---- geometry ------------------------------------------------------------------------------------------- */

static double distance_to_space(double radius, double sine)
{
    const double square = radius * radius * (sine * sine - 1.0) + TOP * TOP, distance = -radius * sine + sqrt(square > 0.0 ? square : 0.0);
    return distance > 0.0 ? distance : 0.0;
}

static double horizon_sine(double radius)
{
    double ratio = EARTH / radius;
    return -sqrt(fmax(0.0, 1.0 - ratio * ratio));
}

static double radius_at(double start, double sine, double distance)
{
    double r = sqrt(start * start + distance * distance + 2.0 * start * sine * distance);
    return clamped(r, EARTH, TOP);
}

/* ---- transmittance to space, tabulated over height and zenith angle after Bruneton and Neyret 2008 -------- */

static void transmittance_to_space(const medium *air, double radius, double sine, int steps, double transmittance[BANDS])
{
    double length = distance_to_space(radius, sine);
    double rayleigh = 0.0, aerosol = 0.0, ozone = 0.0;
    for (int i = 0; i < steps; ++i) { /* midpoints, dense near the start where the air is */
        double s0 = (double)i / steps, s1 = (double)(i + 1) / steps;
        double from = length * s0 * s0, to = length * s1 * s1;
        double height = radius_at(radius, sine, 0.5 * (from + to)) - EARTH;
        rayleigh += rayleigh_density(height) * (to - from);
        aerosol += aerosol_density(height) * (to - from);
        ozone += ozone_density(height) * (to - from);
    }
    for (int b = 0; b < BANDS; ++b) {
        transmittance[b] = spectrum_exp(-(air->rayleigh[b] * rayleigh + air->aerosol[b] * aerosol + air->ozone[b] * ozone));
    }
}

static void fill_light_table(scattering *air)
{
    const double full = sqrt(TOP * TOP - EARTH * EARTH);
    for (int row = 0; row < LIGHT_ROWS; ++row) {
        double above = full * row / (LIGHT_ROWS - 1);
        double radius = sqrt(above * above + EARTH * EARTH);
        double nearest = TOP - radius, farthest = above + full;
        for (int column = 0; column < LIGHT_COLUMNS; ++column) {
            double d = nearest + (farthest - nearest) * column / (LIGHT_COLUMNS - 1);
            double sine = d > 0.0 ? (full * full - above * above - d * d) / (2.0 * radius * d) : 1.0;
            double through[BANDS];
            transmittance_to_space(&air->air, radius, clamped(sine, -1.0, 1.0), 32, through);
            for (int b = 0; b < BANDS; ++b) {
                air->light[row][column][b] = (float)through[b];
            }
        }
    }
}

static void place_step(ray_step *step, double distance, double radius)
{
    const double full = sqrt(TOP * TOP - EARTH * EARTH);
    double above = sqrt(fmax(radius * radius - EARTH * EARTH, 0.0));
    double x = fmin(above / full * (LIGHT_ROWS - 1), LIGHT_ROWS - 1.0);
    double y = sqrt(clamped((radius - EARTH) / TOP_HEIGHT, 0.0, 1.0)) * (MEAN_ROWS - 1);
    step->distance = distance;
    step->radius = radius;
    step->horizon = horizon_sine(radius);
    step->nearest = TOP - radius;
    step->inverse_range = 1.0 / fmax(above + full - step->nearest, 1e-6);
    step->light_row = x < LIGHT_ROWS - 2 ? (int)x : LIGHT_ROWS - 2;
    step->light_up = (float)(x - step->light_row);
    step->mean_row = y < MEAN_ROWS - 2 ? (int)y : MEAN_ROWS - 2;
    step->mean_up = (float)(y - step->mean_row);
}

static band_values blend(const band_values *low, const band_values *high, float right, float up)
{
    float w00 = (1.0f - right) * (1.0f - up), w10 = right * (1.0f - up), w01 = (1.0f - right) * up, w11 = right * up;
    return (w00 * low[0] + w10 * low[1]) + (w01 * high[0] + w11 * high[1]);
}

/* Fraction of the light's disk above the horizon, seen from a stretch. */
static float light_above(const scattering *air, const ray_step *at, double sine)
{
    return (float)clamped(0.5 + 0.5 * (sine - at->horizon) / air->sin_radius, 0.0, 1.0);
}

static band_values light_at(const scattering *air, const ray_step *at, double sine)
{
    double lit = sine > at->horizon ? sine : at->horizon;
    double x = (distance_to_space(at->radius, lit) - at->nearest) * at->inverse_range;
    x = clamped(x, 0.0, 1.0) * (LIGHT_COLUMNS - 1);
    int column = x < LIGHT_COLUMNS - 2 ? (int)x : LIGHT_COLUMNS - 2;
    return blend(&air->light[at->light_row][column], &air->light[at->light_row + 1][column], (float)(x - column), at->light_up);
}

static double mean_sine(int column)
{
    double above = (double)(column - MEAN_BELOW) / MEAN_ABOVE;
    return column < MEAN_BELOW ? 0.01 * (column - MEAN_BELOW) : above * above;
}

static band_values mean_at(const band_values (*table)[MEAN_COLUMNS], const ray_step *at, double sine)
{
    double x = sine < 0.0 ? fmax(MEAN_BELOW + 100.0 * sine, 0.0) : MEAN_BELOW + MEAN_ABOVE * sqrt(fmin(sine, 1.0));
    int column = x < MEAN_COLUMNS - 2 ? (int)x : MEAN_COLUMNS - 2;
    return blend(&table[at->mean_row][column], &table[at->mean_row + 1][column], (float)(x - column), at->mean_up);
}

/* ---- rays ----------------------------------------------------------------------------------------------- */

typedef enum stretches { EVEN, DENSE_NEAR_START } stretches;

/* Splits a ray of length `whole` into stretches, within each of which the density counts as constant. */
static void split_ray(const medium *air, double start, double sine, double whole, stretches how, int count, scattering_ray *ray)
{
    ray->length = whole;
    ray->start = start;
    ray->count = count;
    double through[BANDS];
    for (int b = 0; b < BANDS; ++b) {
        through[b] = 1.0;
    }
    for (int i = 0; i < count; ++i) {
        double s0 = (double)i / count, s1 = (double)(i + 1) / count;
        double from = whole * s0 * (how == EVEN ? 1.0 : s0), to = whole * s1 * (how == EVEN ? 1.0 : s1), length = to - from;
        double middle = 0.5 * (from + to), radius = radius_at(start, sine, middle), height = radius - EARTH;
        double rayleigh = rayleigh_density(height), aerosol = aerosol_density(height), ozone = ozone_density(height);
        ray_step *step = &ray->steps[i];
        place_step(step, middle, radius);
        for (int b = 0; b < BANDS; ++b) {
            double extinction = air->rayleigh[b] * rayleigh + air->aerosol[b] * aerosol + air->ozone[b] * ozone;
            double depth = extinction * length, after = spectrum_exp(-depth);
            double seen = through[b] * (depth > 1e-6 ? (1.0 - after) / extinction : length);
            step->rayleigh[b] = (float)(air->rayleigh[b] * rayleigh * seen);
            step->aerosol[b] = (float)(air->aerosol_scattering[b] * aerosol * seen);
            through[b] *= after;
        }
        step->all = step->rayleigh + step->aerosol;
    }
    for (int b = 0; b < BANDS; ++b) {
        ray->through[b] = (float)through[b];
    }
}

static double sine_along(const scattering_ray *ray, const ray_step *step, double sin_light, double cos_angle)
{
    return clamped((ray->start * sin_light + step->distance * cos_angle) / step->radius, -1.0, 1.0);
}

/* Aims a ray that ends at the sea or in space. */
static void aim_ray(const medium *air, double start, double sine, int count, scattering_ray *ray)
{
    double discriminant = start * start * (sine * sine - 1.0) + EARTH * EARTH;
    ray->hits_ground = sine < 0.0 && discriminant >= 0.0;
    split_ray(air, start, sine, ray->hits_ground ? fmax(-start * sine - sqrt(discriminant), 0.0) : distance_to_space(start, sine), DENSE_NEAR_START, count,
              ray);
}

/* Radiance along a ray by single scattering with the phase functions. `seen` true: for the eye; false: for the table of mean radiance. */
static band_values single_scattering(const scattering *air, const scattering_ray *ray, double sin_light, double cos_angle, bool seen)
{
    band_values rayleigh = {0}, aerosol = {0};
    for (int i = 0; i < ray->count; ++i) {
        const ray_step *step = &ray->steps[i];
        double sine = sine_along(ray, step, sin_light, cos_angle);
        float lit = light_above(air, step, sine);
        if (lit > 0.0f) {
            band_values in = lit * light_at(air, step, sine);
            rayleigh += step->rayleigh * in;
            aerosol += step->aerosol * in;
        }
    }
    float rayleigh_share = (float)rayleigh_phase(cos_angle), aerosol_share = (float)aerosol_phase(cos_angle, seen);
    return rayleigh_share * rayleigh + aerosol_share * aerosol;
}

/* Adds the light that a ray scatters isotropically from a table of mean radiance. */
static void add_scattered_mean(const band_values (*mean)[MEAN_COLUMNS], const scattering_ray *ray, double sin_light, double cos_angle, band_values *sum)
{
    for (int i = 0; i < ray->count; ++i) {
        const ray_step *step = &ray->steps[i];
        *sum += step->all * mean_at(mean, step, sine_along(ray, step, sin_light, cos_angle));
    }
}

/* Adds the sea at the ray's end. `mean` NULL: the light itself shines on it. Otherwise a sky of twice the mean radiance does, because the lower half of the
 * directions is dark. */
static void add_ground(const scattering *air, const scattering_ray *ray, const band_values (*mean)[MEAN_COLUMNS], double sin_light, double cos_angle,
                       band_values *sum)
{
    ray_step ground;
    memset(&ground, 0, sizeof ground);
    place_step(&ground, ray->length, EARTH);
    double sine = sine_along(ray, &ground, sin_light, cos_angle);
    band_values in;
    float factor;
    if (mean) {
        in = mean_at(mean, &ground, sine);
        factor = (float)(2.0 * SEA_ALBEDO);
    } else {
        in = light_at(air, &ground, sine);
        factor = (float)(SEA_ALBEDO / PI * fmax(sine, 0.0)) * light_above(air, &ground, sine);
    }
    *sum += factor * in * ray->through;
}

/* ---- mean radiance of all orders -------------------------------------------------------------------------- */

typedef struct gather_direction {
    double sine, cosine, weight; /* of the zenith angle */
    double azimuth_cosine[GATHER_AZIMUTHS];
} gather_direction;

static gather_direction gather_direction_make(int index)
{
    /* Four-point Gauss–Legendre on either side of the horizontal; azimuths are the midpoints of half a circle. */
    static const double node[4] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813, 0.93056815579702629};
    static const double weight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};
    static const double azimuth_cosine[GATHER_AZIMUTHS] = {0.92387953251128674, 0.38268343236508977, -0.38268343236508977, -0.92387953251128674};
    gather_direction d;
    d.sine = index < 4 ? -node[index] : node[index - 4];
    d.cosine = sqrt(1.0 - d.sine * d.sine);
    d.weight = 0.5 * weight[index % 4] / GATHER_AZIMUTHS;
    memcpy(d.azimuth_cosine, azimuth_cosine, sizeof azimuth_cosine);
    return d;
}

/* Fills order[to] with the mean radiance of the light that order[from] scatters; from < 0: that the light itself scatters. */
static void gather_order(scattering *air, int from, int to, scattering_ray rays[GATHER_ZENITHS])
{
    band_values(*out)[MEAN_COLUMNS] = air->order[to];
    const band_values(*source)[MEAN_COLUMNS] = from < 0 ? NULL : (const band_values(*)[MEAN_COLUMNS])air->order[from];
    for (int row = 0; row < MEAN_ROWS; ++row) {
        double x = (double)row / (MEAN_ROWS - 1), radius = EARTH + TOP_HEIGHT * x * x;
        for (int zenith = 0; zenith < GATHER_ZENITHS; ++zenith) {
            aim_ray(&air->air, radius, gather_direction_make(zenith).sine, GATHER_STEPS, &rays[zenith]);
        }
        for (int column = 0; column < MEAN_COLUMNS; ++column) {
            double sin_light = mean_sine(column), cos_light = sqrt(fmax(0.0, 1.0 - sin_light * sin_light));
            band_values total = {0};
            for (int zenith = 0; zenith < GATHER_ZENITHS; ++zenith) {
                gather_direction d = gather_direction_make(zenith);
                const scattering_ray *ray = &rays[zenith];
                for (int azimuth = 0; azimuth < GATHER_AZIMUTHS; ++azimuth) {
                    double cos_angle = d.sine * sin_light + d.cosine * cos_light * d.azimuth_cosine[azimuth];
                    band_values in = {0};
                    if (source) {
                        add_scattered_mean(source, ray, sin_light, cos_angle, &in);
                    } else {
                        in = single_scattering(air, ray, sin_light, cos_angle, false);
                    }
                    if (ray->hits_ground) {
                        add_ground(air, ray, source, sin_light, cos_angle, &in);
                    }
                    total += (float)d.weight * in;
                }
            }
            out[row][column] = total;
        }
    }
}

static void fill_mean_table(scattering *air, scattering_ray rays[GATHER_ZENITHS])
{
    for (int order = 1; order <= ORDERS; ++order) {
        int to = order % 2, from = 1 - to;
        gather_order(air, order == 1 ? -1 : from, to, rays);
        for (int row = 0; row < MEAN_ROWS; ++row) {
            for (int column = 0; column < MEAN_COLUMNS; ++column) {
                const band_values *now = &air->order[to][row][column], *before = &air->order[from][row][column];
                band_values *sum = &air->mean[row][column];
                for (int b = 0; b < BANDS; ++b) {
                    float rest = 0.0f;
                    if (order == ORDERS && (*before)[b] > 1e-30f) {
                        float ratio = fminf((*now)[b] / (*before)[b], 0.8f);
                        rest = (*now)[b] * ratio / (1.0f - ratio);
                    }
                    (*sum)[b] += (*now)[b] + rest;
                }
            }
        }
    }
}

/* ---- interface ------------------------------------------------------------------------------------------ */

scattering *scattering_create(double turbidity, double sin_radius)
{
    scattering *air = calloc(1, sizeof *air);
    scattering_ray *rays = calloc(GATHER_ZENITHS, sizeof *rays);
    if (!air || !rays) {
        goto fail;
    }
    air->air = medium_make(turbidity);
    air->sin_radius = fmax(sin_radius, 1e-4);
    fill_light_table(air);
    fill_mean_table(air, rays);
    free(rays);
    return air;
fail:
    free(rays);
    free(air);
    return NULL;
}

void scattering_destroy(scattering *air) { free(air); }

void scattering_transmittance(const scattering *air, double sin_elevation, double transmittance[SPECTRUM_BANDS])
{
    transmittance_to_space(&air->air, EARTH, fmax(sin_elevation, 0.0), 200, transmittance);
}

scattering_ray *scattering_ray_create(void) { return calloc(1, sizeof(scattering_ray)); }

void scattering_ray_destroy(scattering_ray *ray) { free(ray); }

void scattering_ray_aim(const scattering *air, double sin_elevation, scattering_ray *ray)
{
    aim_ray(&air->air, EARTH, fmax(sin_elevation, 0.0), VIEW_STEPS, ray);
}

void scattering_ray_aim_through(const scattering *air, double height, double sine, double length, scattering_ray *ray)
{
    const double start = EARTH + height;
    ray->hits_ground = false;
    split_ray(&air->air, start, sine, fmin(length, distance_to_space(start, sine)), EVEN, AIR_STEPS, ray);
}

void scattering_ray_transmittance(const scattering_ray *ray, double transmittance[SPECTRUM_BANDS])
{
    for (int b = 0; b < BANDS; ++b) {
        transmittance[b] = (double)ray->through[b];
    }
}

double scattering_extinction(const scattering *air, double height)
{
    const int band = 5, steps = 16;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        double at = height * (i + 0.5) / steps;
        sum += air->air.rayleigh[band] * rayleigh_density(at) + air->air.aerosol[band] * aerosol_density(at) + air->air.ozone[band] * ozone_density(at);
    }
    return sum / steps;
}

void scattering_radiance(const scattering *air, const scattering_ray *ray, double sin_light, double cos_angle, double radiance[SPECTRUM_BANDS])
{
    band_values sum = single_scattering(air, ray, sin_light, cos_angle, true);
    add_scattered_mean((const band_values(*)[MEAN_COLUMNS])air->mean, ray, sin_light, cos_angle, &sum);
    for (int b = 0; b < BANDS; ++b) {
        radiance[b] = (double)sum[b];
    }
}
