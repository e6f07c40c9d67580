/* SPDX-License-Identifier: MIT
 * From the waves of a scene in double precision to those of kernels. */
#include "frame/sines.h"

#include <math.h>
#include <string.h>

#include "frame/water_terms.h"

static const double pi = 3.14159265358979323846, turn = 6.28318530717958647692;

/* Sorts `order` from `first` up to `end`; equal amplitudes stay in their order. */
static void sort_order(const mgt_wave *waves, uint16_t *order, uint16_t *room, size_t first, size_t end)
{
    if (end - first < 2)
        return;
    const size_t middle = (first + end) / 2;
    sort_order(waves, order, room, first, middle);
    sort_order(waves, order, room, middle, end);
    memcpy(room + first, order + first, (middle - first) * sizeof *room);
    for (size_t left = first, right = middle, at = first; left < middle; at++)
        order[at] = right < end && waves[order[right]].amplitude > waves[room[left]].amplitude ? order[right++] : room[left++];
}

void sines_order(const mgt_water *water, uint16_t *order)
{
    uint16_t room[MGT_MAX_WAVES];
    for (size_t i = 0; i < water->wave_count; i++)
        order[i] = (uint16_t)i;
    sort_order(water->waves, order, room, 0, water->wave_count);
}

/* Covariance of the slopes of all waves at rest. */
typedef struct slope_covariance {
    double xx, xz, zz;
} slope_covariance;

static slope_covariance covariance_of(const mgt_water *water)
{
    slope_covariance c = {0, 0, 0};
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[i];
        const double half = w->amplitude * w->amplitude / 2;
        c.xx += half * w->kx * w->kx;
        c.xz += half * w->kx * w->kz;
        c.zz += half * w->kz * w->kz;
    }
    return c;
}

/* Relative increase of a choppy wave's slope variance per horizontal area by the slopes of all waves: choppiness² k̂ᵀCk̂, to the first order. It leaves out
 * that resolved waves compress unresolved ones; choppy.k adds this. */
static double steeper_by(const mgt_wave *w, double choppiness, const slope_covariance *c)
{
    const double squared = w->kx * w->kx + w->kz * w->kz;
    return squared > 0 ? choppiness * choppiness * (w->kx * w->kx * c->xx + 2 * w->kx * w->kz * c->xz + w->kz * w->kz * c->zz) / squared : 0;
}

static WaveData wave_data(const mgt_wave *w, double choppiness, double half, const slope_covariance *c)
{
    const double cos_half = cos(w->omega * half), sin_half = sin(w->omega * half);
    const double squared = w->kx * w->kx + w->kz * w->kz, A = w->amplitude;
    const double octave = squared > 0 ? 0.5 * log2(squared) : 0, unresolved = A * A / 2 * (1 + steeper_by(w, choppiness, c));
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
        .octave_mass = (float)(unresolved * squared * octave),
        .octave_sq_mass = (float)(unresolved * squared * octave * octave),
        .variance_xx = (float)(unresolved * w->kx * w->kx),
        .variance_xz = (float)(unresolved * w->kx * w->kz),
        .variance_zz = (float)(unresolved * w->kz * w->kz),
        .shift = squared > 0 ? (float)(choppiness / sqrt(squared)) : 0,
    };
}

_Static_assert(sizeof(SortData) >= SORT_KEYS * sizeof(float), "the keys come first");

/* A wave's sort keys, without lesser_variance. */
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

/* Number of octaves of waves. n octaves of equal weight have a standard deviation of log2 |k| of n/√12. `octave` and `octave_squared` are the sums of slope
 * variance times log2 |k| and its square. */
static double octaves_of(double slope_variance, double octave, double octave_squared)
{
    if (!(slope_variance > 0))
        return 0;
    const double mean = octave / slope_variance;
    return sqrt(12 * fmax(octave_squared / slope_variance - mean * mean, 0));
}

void sines_place(const mgt_water *water, const uint16_t *order, wave_meeting at, wave_set *set)
{
    const slope_covariance covariance = covariance_of(water);
    double variance = 0, slope_variance = 0, octave = 0, octave_squared = 0, heave = 0;
    for (size_t i = water->wave_count; i-- > 0;) { /* the smallest wave first: lesser_variance sums up the smaller ones */
        const mgt_wave *w = &water->waves[order[i]];
        SortData s = sort_data(w, at);
        set->data[i] = wave_data(w, at.turns != 0 ? -(double)water->choppiness : (double)water->choppiness, at.half, &covariance);
        const double change = 2 * w->amplitude * sin(w->omega * at.half);
        heave += change * change / 2;
        variance += w->amplitude * w->amplitude / 2;
        const double k_squared = w->kx * w->kx + w->kz * w->kz, slopes = w->amplitude * w->amplitude * k_squared / 2;
        slope_variance += slopes;
        if (slopes > 0) {
            octave += slopes * log2(k_squared) / 2;
            octave_squared += slopes * log2(k_squared) * log2(k_squared) / 4;
        }
        s.lesser_variance = (float)variance;
        store_keys(set, i, &s);
    }
    set->view.displacement = (float)(4 * sqrt(variance));
    set->view.slope_deviation = (float)sqrt(slope_variance);
    set->view.octaves = (float)octaves_of(slope_variance, octave, octave_squared);
    set->view.heave = (float)sqrt(heave);
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

/* A wave as rays search it. `k`: radians per metre; `phase`: turns; `shift`: see WaveData. */
static SearchWave search_wave(const double k[2], double phase, double amplitude, double shift)
{
    const double slope[2] = {amplitude * k[0], amplitude * k[1]};
    return (SearchWave){.turns_x = (float)(k[0] / turn),
                        .turns_z = (float)(k[1] / turn),
                        .phase = (float)phase,
                        .amplitude = (float)amplitude,
                        .slope_x = (float)slope[0],
                        .slope_z = (float)slope[1],
                        .shift_x = (float)(shift * slope[0]),
                        .shift_z = (float)(shift * slope[1]),
                        .press_xx = (float)(-shift * slope[0] * k[0]),
                        .press_xz = (float)(-shift * slope[0] * k[1]),
                        .press_zz = (float)(-shift * slope[1] * k[1])};
}

void sines_for_rays(const wave_set *set, SearchWave *out)
{
    for (int i = 0; i < set->view.wave_count; i++) {
        const WaveData *d = &set->data[i];
        out[i] = search_wave((const double[2]){(double)d->k_x, (double)d->k_z}, (double)set->keys[4][i], (double)d->amplitude, (double)d->shift);
    }
}

void sines_first(const wave_set *set, int count, double *slope, double *bend)
{
    *slope = *bend = 0;
    for (int i = 0; i < count; i++) {
        const WaveData *d = &set->data[i];
        const double k_squared = (double)(d->k_x * d->k_x + d->k_z * d->k_z);
        *slope += (double)d->half_variance * k_squared;
        *bend += (double)d->half_variance * k_squared * k_squared;
    }
}

double sines_lesser_variance(const wave_set *set, int i) { return i < set->view.wave_count ? (double)set->keys[5][i] : 0; }

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
        out[i] = search_wave((const double[2]){w->kx, w->kz}, phase - rint(phase), w->amplitude, shift);
    }
}

/* A bound that the surface's derivative of this order seldom exceeds: four standard deviations, or the sum over the waves if that is less. */
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

/* The place of rest of the choppy water that is shifted to `point`, by fixed-point iteration, and the shift's derivative there plus the unit matrix. */
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

#include "kernels/common/prelude_double.h"

#include "kernels/waves/lean_grid.k"

double lean_row_angle(const lean_waves *waves, size_t i, size_t row)
{
    return turn * grid_phase(NULL, waves->waves[i], waves->turns[i] - rint(waves->turns[i]), 0, (int)row);
}

/* ---- at points ---- */

static const double turns_per_radian = 0.15915494309189533577;

/* ω·t + phase in turns, within ±1/2. The product's rounding error is added back, because t may be many periods. */
static double turns_at(const mgt_wave *wave, double time)
{
    const double product = wave->omega * time, lost = fma(wave->omega, time, -product);
    const double turns = (remainder(product, 2 * pi) + lost + remainder(wave->phase, 2 * pi)) * turns_per_radian;
    return turns - nearbyint(turns);
}

static void add_shift_terms(water_term *t, const mgt_wave *w, double choppiness)
{
    const double k = hypot(w->kx, w->kz), shift = k > 0 ? choppiness / k : 0;
    t->shift_x = shift * t->slope_x;
    t->shift_z = shift * t->slope_z;
    t->shift_velocity_x = -w->omega * t->shift_x;
    t->shift_velocity_z = -w->omega * t->shift_z;
    t->press_xx = t->shift_x * w->kx;
    t->press_xz = t->shift_x * w->kz;
    t->press_zz = t->shift_z * w->kz;
    t->single.along_x = (float)t->along_x;
    t->single.along_z = (float)t->along_z;
    t->single.radians_x = (float)w->kx;
    t->single.radians_z = (float)w->kz;
    t->single.shift_x = (float)t->shift_x;
    t->single.shift_z = (float)t->shift_z;
    t->single.shift_velocity_x = (float)t->shift_velocity_x;
    t->single.shift_velocity_z = (float)t->shift_velocity_z;
    t->single.press_xx = (float)t->press_xx;
    t->single.press_xz = (float)t->press_xz;
    t->single.press_zz = (float)t->press_zz;
}

static void fill_term(water_term *t, const mgt_wave *w, double time)
{
    t->along_x = w->kx * turns_per_radian;
    t->along_z = w->kz * turns_per_radian;
    t->start = turns_at(w, time);
    t->height = w->amplitude;
    t->slope_x = w->amplitude * w->kx;
    t->slope_z = w->amplitude * w->kz;
    t->vertical_velocity = w->amplitude * w->omega;
    t->single.height = (float)t->height;
    t->single.slope_x = (float)t->slope_x;
    t->single.slope_z = (float)t->slope_z;
    t->single.vertical_velocity = (float)t->vertical_velocity;
}

/* See water_terms.folded. Water that is pressed by less than 1 folds nowhere, and by less than 1.5 only near where it was found to be pressed: compared with a
 * search from everywhere, over seas from wind and over one wave. */
static double folded_below(double pressed) { return pressed < 1 ? 0.2 : pressed < 1.5 ? 0.6 : (double)INFINITY; }

/* The bound of a sum of sines by the sum of their amplitudes, or by four standard deviations where that is less. It is kept below 1, where the surface stands
 * upright. Many sines seldom reach four deviations, so that .9 will do there. */
static double pressed_at_most(double sum, double variance)
{
    const double deviations = 4 * sqrt(variance);
    return sum <= deviations ? fmin(sum, 0.98) : fmin(deviations, 0.9);
}

water_terms water_terms_at(const mgt_water *water, double time, double least, water_term *room, double covariance[3])
{
    const bool choppy = water->choppiness > 0 && water->wave_count > 0;
    water_terms terms = {.choppy = choppy,
                         .folds = (double)water->choppiness * sines_steepest(water) >= 1,
                         .folded = folded_below((double)water->choppiness * sines_steepest(water)),
                         .straight = 0.3 * sines_steepest(water) / fmax(sines_sharpest(water), 1e-300),
                         .of = room};
    uint16_t order[MGT_MAX_WAVES];
    if (choppy)
        sines_order(water, order);
    double pressed = 0, pressed_variance = 0;
    covariance[0] = covariance[1] = covariance[2] = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *w = &water->waves[choppy ? order[i] : i];
        const double k = hypot(w->kx, w->kz);
        if (k * least <= 2 * pi) {
            water_term *t = &room[terms.count++];
            fill_term(t, w, time);
            terms.sum += w->amplitude;
            if (choppy) {
                add_shift_terms(t, w, (double)water->choppiness);
                const double press = (double)water->choppiness * w->amplitude * k;
                pressed += press;
                pressed_variance += press * press / 2;
            }
            continue;
        }
        const double variance = w->amplitude * w->amplitude / 2;
        covariance[0] += variance * w->kx * w->kx;
        covariance[1] += variance * w->kx * w->kz;
        covariance[2] += variance * w->kz * w->kz;
    }
    terms.pressed = pressed_at_most(pressed, pressed_variance);
    return terms;
}
