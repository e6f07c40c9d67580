/* SPDX-License-Identifier: MIT */
/* A path through L*, chroma and hue that stays inside sRGB. */
#include "image/error_colors.h"

#include <math.h>

#include "base/srgb_matrix.h"
#include "image/metrics_color.h"

static double lab_inverse(double f) { return f > 6.0 / 29.0 ? f * f * f : 3 * (6.0 / 29.0) * (6.0 / 29.0) * (f - 4.0 / 29.0); }

static void color_of(double t, uint8_t rgb[3])
{
    static const double white[3] = {0.95047, 1, 1.08883};
    const double lightness = 98 * t;
    const double chroma = 220 * pow(t, 0.75) * pow(1 - t, 1.25) + 31 * t * t * t;
    const double hue = (293 + 56.4 * t + 119.2 * t * t) * acos(-1) / 180;
    const double y = (lightness + 16) / 116;
    const double f[3] = {y + chroma * cos(hue) / 500, y, y - chroma * sin(hue) / 200};
    for (int c = 0; c < 3; c++) {
        double light = 0;
        for (int k = 0; k < 3; k++)
            light += srgb_from_xyz[c][k] * white[k] * lab_inverse(f[k]);
        rgb[c] = (uint8_t)(color_srgb_encode(color_clamp((float)light)) * 255 + 0.5f);
    }
}

void error_colors(uint8_t colors[ERROR_COLORS][3])
{
    for (int i = 0; i < ERROR_COLORS; i++)
        color_of(i / (ERROR_COLORS - 1.0), colors[i]);
}
