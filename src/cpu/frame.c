/* SPDX-License-Identifier: MIT
 * From a scene in double precision to the uniform floats of a frame and of its tiles. */
#include "cpu/frame.h"

#include <float.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

static void normalize3(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static void cross3(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

camera_rays camera_rays_of(const mgt_camera *camera, uint32_t width, uint32_t height)
{
    camera_rays rays;
    double forward[3], right[3], up[3];
    for (int i = 0; i < 3; i++) {
        rays.position[i] = camera->position[i];
        forward[i] = camera->target[i] - camera->position[i];
    }
    normalize3(forward);
    cross3(forward, camera->up, right);
    normalize3(right);
    cross3(right, forward, up);
    const double pixel = 2 * tan(camera->fov_y_deg * pi / 360) / height;
    for (int i = 0; i < 3; i++) {
        rays.right[i] = right[i] * pixel;
        rays.down[i] = -up[i] * pixel;
        rays.corner[i] = forward[i] + rays.right[i] * (0.5 - 0.5 * width) + rays.down[i] * (0.5 - 0.5 * height);
    }
    return rays;
}

static void light_axes(const double light[3], FrameData *d)
{
    const double up[3] = {0, 1, 0}, north[3] = {0, 0, -1};
    double e[3], f[3];
    cross3(fabs(light[1]) < 0.999 ? up : north, light, e);
    normalize3(e);
    cross3(light, e, f);
    d->axis_e_x = (float)e[0], d->axis_e_y = (float)e[1], d->axis_e_z = (float)e[2];
    d->axis_f_x = (float)f[0], d->axis_f_y = (float)f[1], d->axis_f_z = (float)f[2];
}

/* Where waves turn from resolved to unresolved: P1's linear ramp, or ours, chosen by error and flicker on the standard scenes. */
static void set_method(frame *f)
{
    const mgt_quality *q = &f->scene->quality;
    const bool podee = q->method == MGT_METHOD_PODEE_UNIFORM || q->method == MGT_METHOD_PODEE_PIXEL;
    f->ramp_start = podee ? 0.2 : 0.1;
    f->ramp_end = podee ? 0.5 : 1.2;
    f->data.ramp_start = (float)f->ramp_start;
    f->data.ramp_scale = (float)(podee ? 1 / (f->ramp_end - f->ramp_start) : 1 / (f->ramp_end * f->ramp_end));
    f->podee = podee;
    f->keep_filtered = q->method == MGT_METHOD_PODEE_PIXEL;
    f->data.ndf_per_pixel = f->keep_filtered;
    f->data.ndf_mean = f->keep_filtered && !q->ndf_mean_drop ? 1 : 0;
}

static void sum_lesser_waves(const mgt_water *water, float *lesser_variance)
{
    for (size_t i = 0; i < water->wave_count; i++) {
        double sum = 0;
        for (size_t j = 0; j < water->wave_count; j++)
            if (water->waves[j].amplitude <= water->waves[i].amplitude)
                sum += water->waves[j].amplitude * water->waves[j].amplitude / 2;
        lesser_variance[i] = (float)sum;
    }
}

frame frame_of(const mgt_scene *scene, const sky_state *sky, bool want_color)
{
    frame f = {.scene = scene};
    FrameData *d = &f.data;
    d->light_x = (float)sky->direction[0];
    d->light_y = (float)sky->direction[1];
    d->light_z = (float)sky->direction[2];
    d->light_radius = (float)sky->tan_radius;
    d->light_azimuth_x = (float)sky->azimuth[0];
    d->light_azimuth_z = (float)sky->azimuth[1];
    d->limb = (float)sky->limb;
    d->light_visible = scene->light.elevation_deg >= 0 ? 1 : 0;
    d->light_radiance_r = (float)sky->light_radiance[0];
    d->light_radiance_g = (float)sky->light_radiance[1];
    d->light_radiance_b = (float)sky->light_radiance[2];
    d->index_of_refraction = (float)scene->water.index_of_refraction;
    light_axes(sky->direction, d);
    double body[3];
    sky_body_radiance(sky, &scene->water, body);
    d->body_r = (float)body[0];
    d->body_g = (float)body[1];
    d->body_b = (float)body[2];
    const double ev = scene->post.exposure_ev + (scene->post.auto_exposure ? sky->exposure_ev : 0);
    d->exposure = (float)exp2(ev);
    d->tone_map = (int)scene->post.tone_map;
    d->slope_floor = 1e-9f;
    d->pixel_angle = (float)(2 * tan(scene->camera.fov_y_deg * pi / 360) / scene->image.height);
    d->want_color = want_color;
    d->sky_black = scene->sky.model == MGT_SKY_BLACK;
    set_method(&f);
    sum_lesser_waves(&scene->water, f.lesser_variance);
    f.close = camera_rays_of(&scene->camera, scene->image.width, scene->image.height);
    f.open = scene->camera_moves ? camera_rays_of(&scene->camera_open, scene->image.width, scene->image.height) : f.close;
    return f;
}

/* ---- waves of an interval ---- */

static WaveData wave_data(const mgt_wave *w, double half)
{
    const double cos_half = cos(w->c * half), sin_half = sin(w->c * half);
    const double squared = w->a * w->a + w->b * w->b, A = w->amplitude;
    const double octave = squared > 0 ? 0.5 * log2(squared) : 0;
    return (WaveData){
        .turns_x = (float)(w->a / (2 * pi)),
        .turns_z = (float)(w->b / (2 * pi)),
        .amplitude = (float)A,
        .even_x = (float)(A * w->a * cos_half),
        .even_z = (float)(A * w->b * cos_half),
        .odd_x = (float)(A * w->a * sin_half),
        .odd_z = (float)(A * w->b * sin_half),
        .bend_xx = (float)(-A * w->a * w->a),
        .bend_xz = (float)(-A * w->a * w->b),
        .bend_zz = (float)(-A * w->b * w->b),
        .even_height = (float)(A * cos_half),
        .k_x = (float)w->a,
        .k_z = (float)w->b,
        .half_variance = (float)(A * A / 2),
        .odd_height = (float)(A * sin_half),
        .cos_half = (float)cos_half,
        .sin_half = (float)sin_half,
        .octave_mass = (float)(A * A * squared / 2 * octave),
        .octave_sq_mass = (float)(A * A * squared / 2 * octave * octave),
        .variance_xx = (float)(A * A / 2 * w->a * w->a),
        .variance_xz = (float)(A * A / 2 * w->a * w->b),
        .variance_zz = (float)(A * A / 2 * w->b * w->b),
    };
}

void wave_set_build(const mgt_water *water, const camera_rays *camera, interval time, wave_set *set)
{
    set->count = water->wave_count;
    double variance = 0, slope_variance = 0;
    for (size_t i = 0; i < set->count; i++) {
        const mgt_wave *w = &water->waves[i];
        set->data[i] = wave_data(w, time.half);
        set->turns_x[i] = w->a / (2 * pi);
        set->turns_z[i] = w->b / (2 * pi);
        const double phase = (w->a * camera->position[0] + w->b * camera->position[2] + w->c * time.middle + w->phase) / (2 * pi);
        set->phase[i] = phase - rint(phase);
        variance += w->amplitude * w->amplitude / 2;
        slope_variance += w->amplitude * w->amplitude * (w->a * w->a + w->b * w->b) / 2;
    }
    set->height_deviation = sqrt(variance);
    set->slope_deviation = sqrt(slope_variance);
}

/* ---- tiles ---- */

/* ∂(x, z)/∂(pixel) on the mean surface at five places of a tile: what frequencies its waves may have there. */
enum { PROBES = 5 };

typedef struct tile_probes {
    float right[PROBES][2], down[PROBES][2];
    int count;         /* probes that see water */
    bool horizon;      /* some probe sees none: frequencies go up without end */
    float nearest;     /* metres from the camera to the nearest probe */
    float least_margin, most_margin; /* factors on squared frequencies for the displaced surface being nearer or farther */
} tile_probes;

static void tile_ray(const camera_rays *camera, double x, double y, double ray[3])
{
    for (int i = 0; i < 3; i++)
        ray[i] = camera->corner[i] + x * camera->right[i] + y * camera->down[i];
}

static tile_probes probe_tile(const camera_rays *camera, uint32_t tile_x, uint32_t tile_y, double displacement)
{
    static const double at[PROBES][2] = {{0.5, 0.5}, {0, 0}, {1, 0}, {0, 1}, {1, 1}};
    tile_probes p = {.nearest = INFINITY};
    const double height = camera->position[1];
    const double relative = fmin(displacement / height, 0.5);
    p.least_margin = (float)((1 - relative) * (1 - relative) * 0.9);
    p.most_margin = (float)((1 + relative) * (1 + relative) * 1.1);
    for (int i = 0; i < PROBES; i++) {
        double ray[3];
        tile_ray(camera, tile_x * (double)TILE_WIDTH - 1 + at[i][0] * (TILE_WIDTH + 1), tile_y * (double)TILE_HEIGHT - 1 + at[i][1] * (TILE_HEIGHT + 1), ray);
        if (ray[1] >= -1e-9) {
            p.horizon = true;
            continue;
        }
        const double along = height / -ray[1];
        p.nearest = fminf(p.nearest, (float)along);
        for (int j = 0; j < 2; j++) {
            const int axis = 2 * j;
            p.right[p.count][j] = (float)(along * (camera->right[axis] - ray[axis] / ray[1] * camera->right[1]));
            p.down[p.count][j] = (float)(along * (camera->down[axis] - ray[axis] / ray[1] * camera->down[1]));
        }
        p.count++;
    }
    return p;
}

/* Squared frequency of a wave over the tile, in (cycles per pixel)²: least and most on the displaced surface, and least and most
 * on the mean one. */
typedef struct frequency_range {
    float least, most;
    float flat_least, flat_most;
} frequency_range;

static frequency_range frequencies(const tile_probes *p, const WaveData *w)
{
    float least = p->count ? FLT_MAX : INFINITY, most = 0;
    for (int i = 0; i < p->count; i++) {
        const float u = p->right[i][0] * w->turns_x + p->right[i][1] * w->turns_z;
        const float v = p->down[i][0] * w->turns_x + p->down[i][1] * w->turns_z;
        const float squared = u * u + v * v;
        least = squared < least ? squared : least;
        most = squared > most ? squared : most;
    }
    if (p->horizon)
        most = INFINITY;
    return (frequency_range){least * p->least_margin, most * p->most_margin, least, most};
}

/* A point near which the tile's phases are exact: where its centre meets the mean surface, or its steepest corner. */
static void tile_origin(const camera_rays *camera, uint32_t tile_x, uint32_t tile_y, TileData *d)
{
    double best[3];
    tile_ray(camera, (tile_x + 0.5) * TILE_WIDTH, (tile_y + 0.5) * TILE_HEIGHT, best);
    for (int corner = 0; corner < 4 && best[1] > -1e-3; corner++) {
        double ray[3];
        tile_ray(camera, (tile_x + (corner & 1)) * (double)TILE_WIDTH, (tile_y + (corner >> 1)) * (double)TILE_HEIGHT, ray);
        if (ray[1] < best[1])
            for (int i = 0; i < 3; i++)
                best[i] = ray[i];
    }
    const double along = camera->position[1] / fmax(-best[1], 1e-4);
    d->origin_x = (float)(best[0] * along);
    d->origin_z = (float)(best[2] * along);
}

/* What bounds the marched waves along the view: sums of worst cases and of variances, whichever is tighter in the end. */
typedef struct march_sums {
    float direction[2]; /* horizontal, of the tile's centre; zero when the tile looks straight down */
    float spread;       /* sine of the largest angle between it and the tile's other rays */
    float amplitude, variance, slope, slope_variance, bend, bend_variance;
    float largest_turns, most_frequency; /* squared */
} march_sums;

static march_sums march_sums_of(const camera_rays *camera, uint32_t tile_x, uint32_t tile_y)
{
    march_sums s = {.spread = 1};
    double centre[3];
    tile_ray(camera, (tile_x + 0.5) * TILE_WIDTH, (tile_y + 0.5) * TILE_HEIGHT, centre);
    const double length = sqrt(centre[0] * centre[0] + centre[2] * centre[2]);
    if (length < 1e-9)
        return s;
    double least = 1;
    for (int corner = 0; corner < 4; corner++) {
        double ray[3];
        tile_ray(camera, (tile_x + (corner & 1)) * (double)TILE_WIDTH, (tile_y + (corner >> 1)) * (double)TILE_HEIGHT, ray);
        least = fmin(least, (ray[0] * centre[0] + ray[2] * centre[2]) / (length * fmax(sqrt(ray[0] * ray[0] + ray[2] * ray[2]), 1e-9)));
    }
    if (least < 0.7)
        return s;
    s.direction[0] = (float)(centre[0] / length);
    s.direction[1] = (float)(centre[2] / length);
    s.spread = (float)sqrt(fmax(1 - least * least, 0));
    return s;
}

static void add_march_wave(tile_waves *out, march_sums *sums, const WaveData *w, float phase, float most_frequency)
{
    out->march[out->data.march_count++] = (MarchWave){w->turns_x, w->turns_z, phase, w->even_height};
    const float squared = w->k_x * w->k_x + w->k_z * w->k_z, length = sqrtf(squared), A = w->amplitude;
    const float along = fabsf(w->k_x * sums->direction[0] + w->k_z * sums->direction[1]) + length * sums->spread;
    const float k = along < length ? along : length;
    sums->amplitude += A;
    sums->variance += A * A / 2;
    sums->slope += A * k;
    sums->slope_variance += A * A * k * k / 2;
    sums->bend += A * k * k;
    sums->bend_variance += A * A * k * k * k * k / 2;
    if (A > 0 && squared > sums->largest_turns)
        sums->largest_turns = squared;
    if (A > 0 && most_frequency > sums->most_frequency)
        sums->most_frequency = most_frequency;
}

/* A wave with all of its frequencies beyond this many cycles per pixel does not steer the first hit of filtered methods; point
 * samples of tiles with such waves look for each pixel's hit on its own. */
static const float march_cycles = 0.25f;

/* The smallest waves that together lift the surface by less than this part of a pixel are left to Newton's step. */
static const float march_pixels = 0.07f;

static void finish_march(const march_sums *s, bool filter, TileData *d)
{
    /* A sum of many sines of random phases exceeds four deviations once in 30,000 places; few sines never reach their sum. */
    const float deviations = 4;
    d->march_bound = fminf(s->amplitude, deviations * sqrtf(s->variance));
    d->march_slope = fminf(s->slope, deviations * sqrtf(s->slope_variance));
    d->march_bend = fminf(s->bend, deviations * sqrtf(s->bend_variance));
    d->march_tolerance = s->largest_turns > 0 ? (filter ? 0.1f : 0.02f) * (float)(2 * pi) / sqrtf(s->largest_turns) : 1e-3f;
    d->march_pixels = !filter && s->most_frequency > march_cycles * march_cycles;
    d->far_distance = 1e5f;
}

static void add_filtered(TileData *d, const WaveData *w)
{
    d->filtered_xx += w->variance_xx;
    d->filtered_xz += w->variance_xz;
    d->filtered_zz += w->variance_zz;
    d->filtered_octave += w->octave_mass;
    d->filtered_octave_sq += w->octave_sq_mass;
}

/* The mirror slope s_h of a ray; false where none exists. `size` gets what the disk's radius can be worth in slope. */
static bool mirror_slope(const FrameData *f, const double ray[3], double slope[2], double *size)
{
    const double inverse = 1 / sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
    double h[3] = {(double)f->light_x - ray[0] * inverse, (double)f->light_y - ray[1] * inverse, (double)f->light_z - ray[2] * inverse};
    const double facing = -(h[0] * ray[0] + h[1] * ray[1] + h[2] * ray[2]) * inverse;
    if (h[1] < 1e-3 || facing < 1e-3)
        return false;
    slope[0] = -h[0] / h[1];
    slope[1] = -h[2] / h[1];
    normalize3(h);
    /* |det J| = 4 (h·v) h.y³ and no singular value of J exceeds 2. */
    *size = (double)f->light_radius / (2 * (-(h[0] * ray[0] + h[1] * ray[1] + h[2] * ray[2]) * inverse) * h[1] * h[1] * h[1]);
    return true;
}

/* Whether a slope within seven deviations of level could mirror the light somewhere in the tile. */
static bool light_reaches(const frame *f, const camera_rays *camera, const wave_set *set, uint32_t tile_x, uint32_t tile_y)
{
    if (f->data.light_visible <= 0)
        return false;
    double centre[2] = {0, 0}, size = 0, spread = 0;
    for (int place = 0; place < 5; place++) {
        const double x = place == 0 ? 0.5 : place & 1, y = place == 0 ? 0.5 : (place - 1) >> 1;
        double ray[3], slope[2], here;
        tile_ray(camera, (tile_x + x) * TILE_WIDTH, (tile_y + y) * TILE_HEIGHT, ray);
        if (!mirror_slope(&f->data, ray, slope, &here))
            return true;
        if (place == 0) {
            centre[0] = slope[0];
            centre[1] = slope[1];
        }
        spread = fmax(spread, hypot(slope[0] - centre[0], slope[1] - centre[1]));
        size = fmax(size, here);
    }
    return hypot(centre[0], centre[1]) - 1.5 * spread - 1.5 * size < 7 * set->slope_deviation + 0.02;
}

static TileData tile_view(const camera_rays *camera, uint32_t tile_x, uint32_t tile_y)
{
    TileData d = {0};
    double ray[3];
    tile_ray(camera, tile_x * (double)TILE_WIDTH, tile_y * (double)TILE_HEIGHT, ray);
    d.ray_x = (float)ray[0], d.ray_y = (float)ray[1], d.ray_z = (float)ray[2];
    d.right_x = (float)camera->right[0], d.right_y = (float)camera->right[1], d.right_z = (float)camera->right[2];
    d.down_x = (float)camera->down[0], d.down_y = (float)camera->down[1], d.down_z = (float)camera->down[2];
    d.camera_height = (float)camera->position[1];
    const double steepness = fmax(hypot(camera->right[1], camera->down[1]), 1e-10);
    d.horizon_steepness = (float)steepness;
    d.horizon_inverse = (float)(1 / steepness);
    tile_origin(camera, tile_x, tile_y, &d);
    return d;
}

/* A wave whose resolved share hardly changes over the tile needs no share per pixel: one serves all. */
static bool share_is_constant(const frame *f, const frequency_range *range)
{
    return !f->podee && range->flat_most < 0.1024f && (range->flat_most - range->flat_least) * f->data.ramp_scale < 0.04f;
}

/* Takes the unresolved part out of such a wave and adds it to the tile's covariance; resolved_share() and unresolved_variance() of
 * surface.k at one frequency. */
static void split_wave(const frame *f, float frequency, WaveData *w, TileData *d)
{
    const float root = 1 - f->data.ramp_scale * frequency, share = root * root;
    const float lost = fmaxf(1 - share * share * (1 + 3.2898681f * frequency), 0);
    w->even_x *= share, w->even_z *= share, w->odd_x *= share, w->odd_z *= share;
    w->bend_xx *= share, w->bend_xz *= share, w->bend_zz *= share;
    w->even_height *= share, w->odd_height *= share;
    d->filtered_xx += lost * w->variance_xx;
    d->filtered_xz += lost * w->variance_xz;
    d->filtered_zz += lost * w->variance_zz;
    d->filtered_octave += lost * w->octave_mass;
    d->filtered_octave_sq += lost * w->octave_sq_mass;
}

void tile_build(const frame *f, const camera_rays *camera, const wave_set *set, bool filter, uint32_t tile_x, uint32_t tile_y, tile_waves *out)
{
    out->data = tile_view(camera, tile_x, tile_y);
    const tile_probes probes = probe_tile(camera, tile_x, tile_y, 4 * set->height_deviation);
    const float start = (float)(f->ramp_start * f->ramp_start), end = (float)(f->ramp_end * f->ramp_end);
    const float negligible = filter ? march_pixels * f->data.pixel_angle * probes.nearest : 0;
    march_sums sums = march_sums_of(camera, tile_x, tile_y);
    int mixed = 0; /* gathered from the array's end, then moved behind the resolved ones */
    for (size_t i = 0; i < set->count; i++) {
        const WaveData *w = &set->data[i];
        const frequency_range range = frequencies(&probes, w);
        if (filter && !f->keep_filtered && range.least >= end) {
            add_filtered(&out->data, w);
            continue;
        }
        const double turns = set->phase[i] + set->turns_x[i] * (double)out->data.origin_x + set->turns_z[i] * (double)out->data.origin_z;
        const float phase = (float)(turns - rint(turns));
        const bool constant = filter && share_is_constant(f, &range);
        const bool resolved = !filter || constant || range.most <= start;
        WaveData *place = resolved ? &out->waves[out->data.resolved_count++] : &out->waves[MGT_MAX_WAVES - ++mixed];
        *place = *w;
        place->phase = phase;
        if (constant)
            split_wave(f, 0.5f * (range.flat_least + range.flat_most), place, &out->data);
        if (!filter || (range.least < march_cycles * march_cycles && f->lesser_variance[i] > negligible * negligible))
            add_march_wave(out, &sums, w, phase, range.most);
    }
    for (int i = 0; i < mixed; i++)
        out->waves[out->data.resolved_count + i] = out->waves[MGT_MAX_WAVES - mixed + i];
    out->data.mixed_count = mixed;
    finish_march(&sums, filter, &out->data);
    out->data.slope_variance = (float)(set->slope_deviation * set->slope_deviation);
    out->data.light_reach = filter && light_reaches(f, camera, set, tile_x, tile_y);
}

bool tile_sees_water(const tile_waves *tile)
{
    const TileData *d = &tile->data;
    if (d->camera_height < d->march_bound)
        return true;
    const float width = TILE_WIDTH, height = TILE_HEIGHT;
    const float steep = fabsf(d->right_y) + fabsf(d->down_y); /* a pixel's margin for partly covered ones */
    float least = d->ray_y;
    least = fminf(least, d->ray_y + width * d->right_y);
    least = fminf(least, d->ray_y + height * d->down_y);
    least = fminf(least, d->ray_y + width * d->right_y + height * d->down_y);
    return least < steep;
}
