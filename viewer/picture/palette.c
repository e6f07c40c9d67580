/* SPDX-License-Identifier: MIT
 * Palettes: colours at equal steps, with linear interpolation between them. */
#include "viewer/picture/palette.h"

#include <math.h>

enum { POINTS = 7 };

static const uint8_t points[PALETTE_KINDS][POINTS][3] = {
    [PALETTE_AMOUNT] = {{6, 8, 20}, {24, 38, 92}, {28, 82, 134}, {38, 132, 138}, {106, 172, 108}, {226, 188, 92}, {255, 246, 214}},
    [PALETTE_DIFFERENCE] = {{168, 226, 255}, {64, 160, 232}, {30, 84, 150}, {20, 22, 28}, {150, 66, 32}, {238, 132, 58}, {255, 224, 160}},
};

uint32_t palette_color(palette_kind kind, double fraction)
{
    const double at = fraction > 0 ? fraction < 1 ? fraction * (POINTS - 1) : POINTS - 1 : 0; /* also for what is not a number */
    const int i = at < POINTS - 2 ? (int)at : POINTS - 2;
    uint32_t color = 0;
    for (int c = 0; c < 3; c++) {
        const double low = points[kind][i][c], high = points[kind][i + 1][c];
        color = color << 8 | (uint32_t)(low + (high - low) * (at - i) + 0.5);
    }
    return color << 8 | 0xff;
}

uint32_t palette_lean(double x, double z)
{
    static const double level[3] = {0.06, 0.07, 0.09}, full_turn = 2 * 3.14159265358979323846;
    const double turn = atan2(x, -z) / full_turn, fraction = sqrt(fmin(hypot(x, z), 1));
    uint32_t color = 0;
    for (int c = 0; c < 3; c++) {
        const double hue = 0.55 + 0.45 * cos(full_turn * (turn + c / 3.0));
        color = color << 8 | (uint32_t)(255 * (level[c] + fraction * (hue - level[c])) + 0.5);
    }
    return color << 8 | 0xff;
}
