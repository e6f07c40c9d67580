/* SPDX-License-Identifier: MIT
 *
 * Aerial perspective from the scattering of the sky.
 */
#include "frame/air.h"

#include <math.h>
#include <string.h>

#define KILOMETRE 1000.0

static double height_of(double metres) { return fmin(fmax(metres, AIR_LEAST), AIR_MOST); }

double air_rate(const scattering *air, double height) { return scattering_extinction(air, height_of(height) / KILOMETRE) / KILOMETRE; }

static void light_along(const scattering *air, const spectrum_weights *weights, const air_view *view, const scattering_ray *ray, double sine,
                        double cos_azimuth, double rgb[3])
{
    const double cos_light = sqrt(fmax(0.0, 1.0 - view->sin_light * view->sin_light)), cosine = sqrt(fmax(0.0, 1.0 - sine * sine));
    double radiance[SPECTRUM_BANDS];
    scattering_radiance(air, ray, view->sin_light, sine * view->sin_light + cosine * cos_light * cos_azimuth, radiance);
    spectrum_to_rgb(weights, radiance, view->rgb_irradiance, rgb);
}

static double aim(const scattering *air, const air_view *view, double distance, scattering_ray *ray)
{
    const double height = height_of(view->height), sine = distance > height ? -height / distance : -1.0;
    scattering_ray_aim_through(air, height / KILOMETRE, sine, distance / KILOMETRE, ray);
    return sine;
}

static void leaves_of(const scattering_ray *ray, const spectrum_weights *weights, double rgb[3])
{
    static const double white[3] = {1.0, 1.0, 1.0};
    double through[SPECTRUM_BANDS];
    scattering_ray_transmittance(ray, through);
    spectrum_to_rgb(weights, through, white, rgb);
}

void air_along(const scattering *air, const spectrum_weights *weights, const air_view *view, double distance, double cos_azimuth, scattering_ray *ray,
               double leaves[3], double light[3])
{
    const double sine = aim(air, view, distance, ray);
    if (leaves)
        leaves_of(ray, weights, leaves);
    light_along(air, weights, view, ray, sine, cos_azimuth, light);
}

/* Fills the row of the table for the finite distance at which the air's opacity is w < 1. */
static void fill_row(const scattering *air, const spectrum_weights *weights, const air_view *view, double w, const float night[3], scattering_ray *ray,
                     float *light, float *leaves)
{
    const double sine = aim(air, view, -log1p(-w) / air_rate(air, view->height), ray);
    double rgb[3];
    leaves_of(ray, weights, rgb);
    for (int c = 0; c < 3; c++)
        leaves[c] = (float)rgb[c];
    for (int column = 0; column < SKY_COLUMNS; column++) {
        const double u = (double)column / (SKY_COLUMNS - 1);
        light_along(air, weights, view, ray, sine, 1.0 - 2.0 * u * u, rgb);
        for (int c = 0; c < 3; c++)
            light[3 * column + c] = (float)(rgb[c] + w * night[c]);
    }
}

void air_fill(const scattering *air, const spectrum_weights *weights, const air_view *view, const float *horizon, const float night[3], scattering_ray *ray,
              float *table)
{
    enum { LAST = AIR_ROWS - 1, ROW = 3 * SKY_COLUMNS };
    float *leaves = table + AIR_ROWS * ROW;
    memset(leaves, 0, ROW * sizeof *leaves);
    for (int row = 0; row < LAST; row++)
        fill_row(air, weights, view, (double)row / LAST, night, ray, table + row * ROW, leaves + 3 * row);
    memcpy(table + LAST * ROW, horizon, ROW * sizeof *table);
}
