/* SPDX-License-Identifier: MIT
 * From the waves of a scene in double precision to those of kernels. */
#include "frame/sines.h"

#include <math.h>
#include <string.h>

#include "frame/water_terms.h"

static const double pi = 3.14159265358979323846, turn = 6.28318530717958647692;

void sines_order(const mgt_water *water, uint16_t *order)
{
    for (size_t i = 0; i < water->wave_count; i++) {
        size_t at = i;
        for (; at > 0 && water->waves[order[at - 1]].amplitude < water->waves[i].amplitude; at--)
            order[at] = order[at - 1];
        order[at] = (uint16_t)i;
    }
}

static WaveData wave_data(const mgt_wave *w, double choppiness, double half)
{
    const double cos_half = cos(w->omega * half), sin_half = sin(w->omega * half);
    const double squared = w->kx * w->kx + w->kz * w->kz, A = w->amplitude;
    const double octave = squared > 0 ? 0.5 * log2(squared) : 0;
    return (WaveData){
        .turns_x = (float)(w->kx / (2 * pi)),
        .turns_z = (float)(w->kz / (2 * pi)),
        .amplitude = (float)A,
        .even_x = (float)(A * w->kx * cos_half),
        .even_z = (float)(A * w->kz * cos_half),
        .odd_x = (float)(A * w->kx * sin_half),
        .odd_z = (float)(A * w->kz * sin_half),
        .bend_xx = (float)(-A * w->kx * w->kx),
        .bend_xz = (float)(-A * w->kx * w->kz),
        .bend_zz = (float)(-A * w->kz * w->kz),
        .even_height = (float)(A * cos_half),
        .k_x = (float)w->kx,
        .k_z = (float)w->kz,
        .half_variance = (float)(A * A / 2),
        .odd_height = (float)(A * sin_half),
        .cos_half = (float)cos_half,
        .sin_half = (float)sin_half,
        .octave_mass = (float)(A * A * squared / 2 * octave),
        .octave_sq_mass = (float)(A * A * squared / 2 * octave * octave),
        .variance_xx = (float)(A * A / 2 * w->kx * w->kx),
        .variance_xz = (float)(A * A / 2 * w->kx * w->kz),
        .variance_zz = (float)(A * A / 2 * w->kz * w->kz),
        .shift = squared > 0 ? (float)(choppiness / sqrt(squared)) : 0,
    };
}

_Static_assert(sizeof(SortData) >= SORT_KEYS * sizeof(float), "the keys come first");

/* Its lesser_variance is left open. */
static SortData sort_data(const mgt_wave *w, wave_meeting at)
{
    const double turns_x = w->kx / (2 * pi), turns_z = w->kz / (2 * pi);
    const double phase = turns_x * at.x + turns_z * at.z + (w->omega * at.middle + w->phase) / (2 * pi) + at.turns;
    SortData s = {.turns_x = (float)turns_x, .turns_z = (float)turns_z, .phase = (float)(phase - rint(phase))};
    s.turns_low_x = (float)(turns_x - (double)s.turns_x);
    s.turns_low_z = (float)(turns_z - (double)s.turns_z);
    return s;
}

static void store_keys(wave_set *set, size_t i, const SortData *s)
{
    float keys[SORT_KEYS];
    memcpy(keys, s, sizeof keys);
    for (int key = 0; key < SORT_KEYS; key++)
        set->keys[key][i] = keys[key];
}

void sines_place(const mgt_water *water, const uint16_t *order, wave_meeting at, wave_set *set)
{
    double variance = 0, slope_variance = 0;
    for (size_t i = water->wave_count; i-- > 0;) { /* from the smallest, for lesser_variance */
        const mgt_wave *w = &water->waves[order[i]];
        SortData s = sort_data(w, at);
        set->data[i] = wave_data(w, at.turns != 0 ? -(double)water->choppiness : (double)water->choppiness, at.half);
        variance += w->amplitude * w->amplitude / 2;
        slope_variance += w->amplitude * w->amplitude * (w->kx * w->kx + w->kz * w->kz) / 2;
        s.lesser_variance = (float)variance;
        store_keys(set, i, &s);
    }
    set->view.displacement = (float)(4 * sqrt(variance));
    set->view.slope_deviation = (float)sqrt(slope_variance);
    set->view.pressed = (float)sines_pressed(water);
    set->view.wave_count = (int)water->wave_count;
}

void sines_sort_data(const wave_set *set, SortData *out)
{
    for (int i = 0; i < set->view.wave_count; i++) {
        float keys[sizeof out[i] / sizeof(float)] = {0};
        for (int key = 0; key < SORT_KEYS; key++)
            keys[key] = set->keys[key][i];
        memcpy(&out[i], keys, sizeof keys);
    }
}

int sines_moving(const wave_set *set)
{
    int count = set->view.wave_count;
    while (count > 0 && set->data[count - 1].amplitude <= 0)
        count--;
    return count;
}

void sines_searched(const mgt_water *water, wave_meeting at, SearchWave *out)
{
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double phase = (w->kx * at.x + w->kz * at.z + w->omega * at.middle + w->phase) / turn;
        const double k = hypot(w->kx, w->kz), shift = k > 0 ? (double)water->choppiness / k : 0;
        out[i] = (SearchWave){.turns_x = (float)(w->kx / turn),
                              .turns_z = (float)(w->kz / turn),
                              .phase = (float)(phase - rint(phase)),
                              .amplitude = (float)w->amplitude,
                              .shift_x = (float)(shift * w->kx),
                              .shift_z = (float)(shift * w->kz)};
    }
}

/* Of the surface's derivative of this order: its sum over the waves, or four deviations where that is less. */
static double seldom_above(const mgt_water *water, int order)
{
    double sum = 0, variance = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double most = w->amplitude * pow(hypot(w->kx, w->kz), order);
        sum += most;
        variance += most * most / 2;
    }
    return fmin(sum, 4 * sqrt(variance));
}

double sines_crest(const mgt_water *water) { return seldom_above(water, 0); }

double sines_steepest(const mgt_water *water) { return seldom_above(water, 1); }

double sines_sharpest(const mgt_water *water) { return seldom_above(water, 2); }

double sines_pressed(const mgt_water *water) { return fmin((double)water->choppiness * sines_steepest(water), 0.9); }

double sines_path_bend(const mgt_water *water, double half)
{
    double sum = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double away = 1 - cos(fmin(fabs(w->omega) * half, pi));
        sum += w->amplitude * w->amplitude * (w->kx * w->kx + w->kz * w->kz) / 2 * away * away;
    }
    return sqrt(sum);
}

/* The place of rest of choppy water that is shifted to a point: steps that always come nearer. */
static void place_of_rest(const mgt_water *water, const double point[2], double time, double rest[2], double stretch[3])
{
    rest[0] = point[0], rest[1] = point[1];
    for (int look = 0; look < 200; look++) {
        double shift[2] = {0, 0};
        stretch[0] = stretch[2] = 1, stretch[1] = 0;
        for (size_t i = 0; i < water->wave_count; i++) {
            const mgt_wave *w = &water->waves[i];
            const double phase = w->kx * rest[0] + w->kz * rest[1] + w->omega * time + w->phase, k = hypot(w->kx, w->kz);
            const double size = k > 0 ? (double)water->choppiness * w->amplitude / k : 0, pressed = size * sin(phase);
            shift[0] += size * w->kx * cos(phase);
            shift[1] += size * w->kz * cos(phase);
            stretch[0] -= pressed * w->kx * w->kx;
            stretch[1] -= pressed * w->kx * w->kz;
            stretch[2] -= pressed * w->kz * w->kz;
        }
        const double left[2] = {point[0] - rest[0] - shift[0], point[1] - rest[1] - shift[1]};
        if (!(hypot(left[0], left[1]) > 1e-9))
            break;
        rest[0] += left[0];
        rest[1] += left[1];
    }
}

void sines_lower(const mgt_water *water, const double point[2], double time, const double ray[3], double *gap, double *closing)
{
    double rest[2] = {point[0], point[1]}, stretch[3] = {1, 0, 1};
    if (water->choppiness > 0)
        place_of_rest(water, point, time, rest, stretch);
    const double det = fmax(stretch[0] * stretch[2] - stretch[1] * stretch[1], 0.1);
    const double along_x = (stretch[2] * ray[0] - stretch[1] * ray[2]) / det, along_z = (stretch[0] * ray[2] - stretch[1] * ray[0]) / det;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double phase = w->kx * rest[0] + w->kz * rest[1] + w->omega * time + w->phase;
        *gap -= w->amplitude * sin(phase);
        *closing -= w->amplitude * (w->kx * along_x + w->kz * along_z) * cos(phase);
    }
}

/* ---- the map of slope moments ---- */

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

LeanData sines_snap(const mgt_water *water, wave_meeting at, lean_waves *out)
{
    const double period = map_period(water), limit = LEAN_SIZE / 2.5;
    double xx = 0, xz = 0, zz = 0;
    *out = (lean_waves){0};
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double across = rint(w->kx * period / turn), down = rint(w->kz * period / turn), variance = w->amplitude * w->amplitude / 2;
        if (hypot(across, down) > limit) {
            xx += variance * w->kx * w->kx;
            xz += variance * w->kx * w->kz;
            zz += variance * w->kz * w->kz;
            continue;
        }
        const double turns = (w->kx * at.x + w->kz * at.z + w->omega * at.middle + w->phase) / turn + at.turns;
        out->turns[out->count] = turns;
        out->waves[out->count++] = (LeanWave){.periods_x = (int)across,
                                              .periods_z = (int)down,
                                              .turns = (float)(turns - rint(turns)),
                                              .slope_x = (float)(w->amplitude * w->kx),
                                              .slope_z = (float)(w->amplitude * w->kz)};
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

double lean_row_angle(const lean_waves *waves, size_t i, size_t row)
{
    const unsigned part = (unsigned)waves->waves[i].periods_z * (unsigned)row % LEAN_SIZE;
    return turn * (waves->turns[i] - rint(waves->turns[i]) + (double)part / LEAN_SIZE);
}

/* ---- at points ---- */

static const double turns_per_radian = 0.15915494309189533577;

/* ω·t + phase in turns, within ±1/2: what rounding takes from the product counts, for t may be many periods. */
static double turns_at(const mgt_wave *wave, double time)
{
    const double product = wave->omega * time, lost = fma(wave->omega, time, -product);
    const double turns = (remainder(product, 2 * pi) + lost + remainder(wave->phase, 2 * pi)) * turns_per_radian;
    return turns - nearbyint(turns);
}

/* Of the last term. */
static void add_shift_terms(water_terms *terms, const mgt_wave *w, double choppiness)
{
    const int n = terms->count - 1;
    const double k = hypot(w->kx, w->kz), shift = k > 0 ? choppiness / k : 0;
    terms->shift_x[n] = shift * terms->lean_x[n];
    terms->shift_z[n] = shift * terms->lean_z[n];
    terms->drift_x[n] = -w->omega * terms->shift_x[n];
    terms->drift_z[n] = -w->omega * terms->shift_z[n];
    terms->pressed += choppiness * w->amplitude * k;
    terms->press_xx[n] = terms->shift_x[n] * w->kx;
    terms->press_xz[n] = terms->shift_x[n] * w->kz;
    terms->press_zz[n] = terms->shift_z[n] * w->kz;
    terms->single[n].along_x = (float)terms->along_x[n];
    terms->single[n].along_z = (float)terms->along_z[n];
    terms->single[n].radians_x = (float)w->kx;
    terms->single[n].radians_z = (float)w->kz;
    terms->single[n].shift_x = (float)terms->shift_x[n];
    terms->single[n].shift_z = (float)terms->shift_z[n];
    terms->single[n].drift_x = (float)terms->drift_x[n];
    terms->single[n].drift_z = (float)terms->drift_z[n];
    terms->single[n].press_xx = (float)terms->press_xx[n];
    terms->single[n].press_xz = (float)terms->press_xz[n];
    terms->single[n].press_zz = (float)terms->press_zz[n];
}

static void add_term(water_terms *terms, const mgt_wave *w, double time)
{
    const int n = terms->count++;
    terms->along_x[n] = w->kx * turns_per_radian;
    terms->along_z[n] = w->kz * turns_per_radian;
    terms->start[n] = turns_at(w, time);
    terms->up[n] = w->amplitude;
    terms->lean_x[n] = w->amplitude * w->kx;
    terms->lean_z[n] = w->amplitude * w->kz;
    terms->rise[n] = w->amplitude * w->omega;
    terms->single[n].up = (float)terms->up[n];
    terms->single[n].lean_x = (float)terms->lean_x[n];
    terms->single[n].lean_z = (float)terms->lean_z[n];
    terms->single[n].rise = (float)terms->rise[n];
}

void water_terms_at(const mgt_water *water, double time, double least, water_terms *terms, double covariance[3])
{
    uint16_t order[MGT_MAX_WAVES];
    terms->count = 0;
    terms->choppy = water->choppiness > 0 && water->wave_count > 0;
    terms->folds = (double)water->choppiness * sines_steepest(water) >= 1;
    terms->sum = terms->pressed = 0;
    terms->straight = 0.3 * sines_steepest(water) / fmax(sines_sharpest(water), 1e-300);
    if (terms->choppy)
        sines_order(water, order);
    covariance[0] = covariance[1] = covariance[2] = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[terms->choppy ? order[i] : i];
        if (hypot(w->kx, w->kz) * least <= 2 * pi) {
            add_term(terms, w, time);
            terms->sum += w->amplitude;
            if (terms->choppy)
                add_shift_terms(terms, w, (double)water->choppiness);
            continue;
        }
        const double variance = w->amplitude * w->amplitude / 2;
        covariance[0] += variance * w->kx * w->kx;
        covariance[1] += variance * w->kx * w->kz;
        covariance[2] += variance * w->kz * w->kz;
    }
}
