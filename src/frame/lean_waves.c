/* SPDX-License-Identifier: MIT
 * The waves on the grid of the tiled map of slope moments of methods lean and leadr. */
#include "frame/lean_waves.h"

#include <math.h>

#include "frame/frame.h"

static const double turn = 6.28318530717958647692;

static double map_period(const mgt_water *water)
{
    double least = HUGE_VAL, most = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double k = hypot(w->kx, w->kz);
        if (w->amplitude > 0 && k > 0)
            least = fmin(least, k), most = fmax(most, k);
    }
    return most > 0 ? fmax(LEAN_SIZE / 4 * turn / most, 8 * turn / least) : LEAN_SIZE;
}

LeanData lean_snap_waves(const frame *f, lean_waves *out)
{
    const mgt_scene *s = f->scene;
    const double period = map_period(&s->water), limit = LEAN_SIZE / 2.5;
    double xx = 0, xz = 0, zz = 0;
    *out = (lean_waves){0};
    for (size_t i = 0; i < s->water.wave_count; i++) {
        const mgt_wave *w = &s->water.waves[i];
        const double across = rint(w->kx * period / turn), down = rint(w->kz * period / turn), variance = w->amplitude * w->amplitude / 2;
        if (hypot(across, down) > limit) {
            xx += variance * w->kx * w->kx;
            xz += variance * w->kx * w->kz;
            zz += variance * w->kz * w->kz;
            continue;
        }
        const size_t at = out->count++;
        out->across[at] = (int)across;
        out->down[at] = (int)down;
        out->turns[at] = (w->kx * f->close.position[0] + w->kz * f->close.position[2] + w->omega * s->time + w->phase) / turn + wave_turns(f);
        out->slope_x[at] = (float)(w->amplitude * w->kx);
        out->slope_z[at] = (float)(w->amplitude * w->kz);
    }
    return (LeanData){
        .texels_per_metre = (float)(LEAN_SIZE / period),
        .turns_per_metre = (float)(1 / period),
        .size = LEAN_SIZE,
        .last_level = LEAN_LEVELS - 1,
        .rest_xx = (float)xx,
        .rest_xz = (float)xz,
        .rest_zz = (float)zz,
    };
}
