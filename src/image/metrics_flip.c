/* SPDX-License-Identifier: MIT */
/* FLIP: contrast sensitivity, colour difference, features, and the exposures of HDR-FLIP. Symbols are those of the 2020 paper. */
#include "image/metrics_flip.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "image/metrics_color.h"
#include "image/metrics_filter.h"

#define PI 3.14159265358979323846
#define COLOR_EXPONENT 0.7f   /* q_c */
#define FEATURE_EXPONENT 0.5f /* q_f */
#define KNEE_INPUT 0.4f       /* p_c: where the knee is, as a fraction of the greatest colour difference */
#define KNEE_OUTPUT 0.95f     /* p_t: fraction of 0 … 1 that differences below the knee get */
#define FEATURE_DEGREES 0.082 /* w: width of the edges and points looked for */
#define TONE_TARGET 0.85      /* where the range of exposures ends, of white */

enum { PLANE_L, PLANE_A, PLANE_B, PLANE_EDGE, PLANE_POINT, PLANES };
enum { SENSITIVITIES = 4, BUFFERS = 2 * PLANES + 3 + 2 + 2 };

typedef struct separable {
    filter_kernel rows, columns;
} separable;

/* Linear sRGB to (X/Xn, Y/Yn, Z/Zn) and back; white, the sum of a row, is 1. */
typedef struct color_matrices {
    float to_relative[3][3], to_light[3][3];
} color_matrices;

struct flip {
    uint32_t width, height;
    size_t count; /* pixels */
    color_matrices matrices;
    float greatest_difference;              /* c_max: of the primaries green and blue */
    separable sensitivity[SENSITIVITIES];   /* of luminance, red-green, and blue-yellow, which is a sum of two */
    filter_kernel smooth, slope, curvature; /* a Gaussian and its first and second derivative */
    float *buffers;                         /* what the rest points into */
    float *planes[2][PLANES];               /* what is compared, of A and of B */
    float *opponent[3], *scratch[2], *frame_map, *exposure_map;
};

/* ---- colour ---- */

static double determinant(double m[3][3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += m[0][c] * (m[1][(c + 1) % 3] * m[2][(c + 2) % 3] - m[1][(c + 2) % 3] * m[2][(c + 1) % 3]);
    return sum;
}

static void invert(double m[3][3], double inverse[3][3])
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            inverse[c][r] =
                (m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3] - m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3]) / determinant(m);
}

/* From chromaticities: sRGB's primaries, and D65 with the five digits of CIE, as the papers' program has it. */
static color_matrices make_matrices(void)
{
    static const double chromaticities[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}, white[2] = {0.31271, 0.32902};
    const double white_xyz[3] = {white[0] / white[1], 1, (1 - white[0] - white[1]) / white[1]};
    double primaries[3][3], inverse[3][3];
    color_matrices matrices;
    for (int c = 0; c < 3; c++) {
        primaries[0][c] = chromaticities[c][0];
        primaries[1][c] = chromaticities[c][1];
        primaries[2][c] = 1 - chromaticities[c][0] - chromaticities[c][1];
    }
    invert(primaries, inverse);
    for (int c = 0; c < 3; c++) {
        double amount = 0; /* of this primary in white */
        for (int k = 0; k < 3; k++)
            amount += inverse[c][k] * white_xyz[k];
        for (int r = 0; r < 3; r++)
            primaries[r][c] *= amount / white_xyz[r];
    }
    invert(primaries, inverse);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            matrices.to_relative[r][c] = (float)primaries[r][c];
            matrices.to_light[r][c] = (float)inverse[r][c];
        }
    return matrices;
}

typedef struct triple {
    float x, y, z;
} triple;

static triple transform(const float m[3][3], triple v)
{
    return (triple){m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                    m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

static triple clamp_triple(triple v) { return (triple){color_clamp(v.x), color_clamp(v.y), color_clamp(v.z)}; }

static float lab_curve(float t)
{
    const float bend = 6.0f / 29.0f;
    return t > bend * bend * bend ? cbrtf(t) : t / (3.0f * bend * bend) + 4.0f / 29.0f;
}

/* L*a*b* with Hunt's effect: colours look paler where it is darker. */
static triple hunt_lab(const color_matrices *matrices, triple light)
{
    const triple relative = transform(matrices->to_relative, light);
    const float fx = lab_curve(relative.x), fy = lab_curve(relative.y), fz = lab_curve(relative.z);
    const float l = 116.0f * fy - 16.0f;
    return (triple){l, 0.01f * l * 500.0f * (fx - fy), 0.01f * l * 200.0f * (fy - fz)};
}

/* HyAB, which holds for large differences too, to the power q_c. */
static float lab_difference(triple p, triple q)
{
    const float a = p.y - q.y, b = p.z - q.z;
    return powf(fabsf(p.x - q.x) + sqrtf(a * a + b * b), COLOR_EXPONENT);
}

static float greatest_difference(const color_matrices *matrices)
{
    return lab_difference(hunt_lab(matrices, (triple){0, 1, 0}), hunt_lab(matrices, (triple){0, 0, 1}));
}

/* Small differences get most of 0 … 1. */
static float redistribute(float difference, float greatest)
{
    const float knee = KNEE_INPUT * greatest;
    if (difference < knee)
        return KNEE_OUTPUT / knee * difference;
    return fminf(KNEE_OUTPUT + (difference - knee) / (greatest - knee) * (1.0f - KNEE_OUTPUT), 1.0f);
}

float flip_color_difference(const float a[3], const float b[3])
{
    const color_matrices matrices = make_matrices();
    const triple p = hunt_lab(&matrices, clamp_triple((triple){a[0], a[1], a[2]}));
    const triple q = hunt_lab(&matrices, clamp_triple((triple){b[0], b[1], b[2]}));
    return redistribute(lab_difference(p, q), greatest_difference(&matrices));
}

/* ---- filters ---- */

/* What the eye resolves: each opponent channel's contrast sensitivity as a sum of a √(π/b) exp(−π² d²/b), d in degrees. */
static void make_sensitivities(flip *f, double pixels_per_degree)
{
    static const struct {
        double a, b;
    } terms[SENSITIVITIES] = {{1, 0.0047}, {1, 0.0053}, {34.1, 0.04}, {13.5, 0.025}};
    double volumes[SENSITIVITIES], sums[SENSITIVITIES];
    const int radius = (int)ceil(3 * sqrt(0.04 / (2 * PI * PI)) * pixels_per_degree);
    for (int i = 0; i < SENSITIVITIES; i++) {
        const double sigma = sqrt(terms[i].b / (2 * PI * PI)) * pixels_per_degree;
        f->sensitivity[i].rows = f->sensitivity[i].columns = filter_gaussian(sigma, radius);
        sums[i] = 0;
        for (int d = -radius; d <= radius; d++)
            sums[i] += exp(-d * d / (2 * sigma * sigma));
        volumes[i] = terms[i].a * sqrt(PI / terms[i].b) * sums[i] * sums[i];
    }
    for (int i = 2; i < SENSITIVITIES; i++)
        for (int tap = 0; tap <= 2 * radius; tap++)
            f->sensitivity[i].rows.weights[tap] *= (float)(volumes[i] / (volumes[2] + volumes[3]));
}

/* The weights above 0 made to sum to 1, those below to −1. */
static filter_kernel balanced(const double *weights, int radius)
{
    filter_kernel kernel = {.radius = radius};
    double above = 0, below = 0;
    for (int tap = 0; tap <= 2 * radius; tap++)
        *(weights[tap] > 0 ? &above : &below) += fabs(weights[tap]);
    for (int tap = 0; tap <= 2 * radius; tap++)
        kernel.weights[tap] = (float)(weights[tap] / (weights[tap] > 0 ? above : below));
    return kernel;
}

static void make_features(flip *f, double pixels_per_degree)
{
    const double sigma = 0.5 * FEATURE_DEGREES * pixels_per_degree;
    const int radius = (int)ceil(3 * sigma);
    double slope[2 * FILTER_RADIUS_MAX + 1], curvature[2 * FILTER_RADIUS_MAX + 1];
    for (int d = -radius; d <= radius; d++) {
        const double gaussian = exp(-d * d / (2 * sigma * sigma));
        slope[radius + d] = -d * gaussian;
        curvature[radius + d] = (d * d / (sigma * sigma) - 1) * gaussian;
    }
    f->smooth = filter_gaussian(sigma, radius);
    f->slope = balanced(slope, radius);
    f->curvature = balanced(curvature, radius);
}

file_status flip_create(flip **result, uint32_t width, uint32_t height, double pixels_per_degree, file_error *error)
{
    *result = NULL;
    if (width == 0 || height == 0 || (uint64_t)width * height > SIZE_MAX / sizeof(float) / BUFFERS)
        return file_error_set(error, FILE_ARGUMENT, "FLIP of %u x %u pixels is not possible", width, height);
    if (!(pixels_per_degree >= 4 && pixels_per_degree <= 400))
        return file_error_set(error, FILE_ARGUMENT, "FLIP at %g pixels per degree; allowed: 4 to 400", pixels_per_degree);
    flip *f = calloc(1, sizeof *f);
    if (!f)
        return file_error_set(error, FILE_MEMORY, "out of memory for FLIP");
    f->width = width;
    f->height = height;
    f->count = (size_t)width * height;
    float *next = f->buffers = malloc(f->count * BUFFERS * sizeof(float));
    if (!next) {
        flip_free(f);
        return file_error_set(error, FILE_MEMORY, "out of memory for FLIP of %u x %u pixels", width, height);
    }
    float **const places[] = {&f->planes[0][0], &f->planes[0][1], &f->planes[0][2], &f->planes[0][3], &f->planes[0][4], &f->planes[1][0],
                              &f->planes[1][1], &f->planes[1][2], &f->planes[1][3], &f->planes[1][4], &f->opponent[0],  &f->opponent[1],
                              &f->opponent[2],  &f->scratch[0],   &f->scratch[1],   &f->frame_map,    &f->exposure_map};
    _Static_assert(sizeof places / sizeof places[0] == BUFFERS, "one place for every buffer");
    for (int i = 0; i < BUFFERS; i++, next += f->count)
        *places[i] = next;
    f->matrices = make_matrices();
    f->greatest_difference = greatest_difference(&f->matrices);
    make_sensitivities(f, pixels_per_degree);
    make_features(f, pixels_per_degree);
    *result = f;
    return FILE_OK;
}

void flip_free(flip *f)
{
    if (f)
        free(f->buffers);
    free(f);
}

/* ---- one picture ---- */

double flip_tone(double light)
{
    const double x = 0.6 * light;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

double flip_tone_inverse(double value)
{
    const double a = 2.51 - 2.43 * value, b = 0.03 - 0.59 * value, c = -0.14 * value;
    return (sqrt(b * b - 4 * a * c) - b) / (2 * a) / 0.6;
}

/* What arrives at the eye: clamped light, or with `scale` above 0 scaled and tone-mapped light. */
static triple displayed(flip_picture picture, size_t index, double scale)
{
    const float *p = picture.pixels + index * picture.channels;
    triple light = picture.channels == 1 ? (triple){p[0], p[0], p[0]} : (triple){p[0], p[1], p[2]};
    if (scale > 0) {
        /* Far beyond white the curve is above 1 anyway, and its squares must not overflow. */
        light.x = (float)flip_tone(fmin(fmax(light.x * scale, 0), 1e6));
        light.y = (float)flip_tone(fmin(fmax(light.y * scale, 0), 1e6));
        light.z = (float)flip_tone(fmin(fmax(light.z * scale, 0), 1e6));
    }
    return clamp_triple(light);
}

/* YyCxCz without its constant factors, which filters pass through: luminance, X − Y (red-green), Y − Z (blue-yellow). */
static void to_opponent(flip *f, flip_picture picture, double scale)
{
    for (size_t i = 0; i < f->count; i++) {
        const triple relative = transform(f->matrices.to_relative, displayed(picture, i, scale));
        f->opponent[0][i] = relative.y;
        f->opponent[1][i] = relative.x - relative.y;
        f->opponent[2][i] = relative.y - relative.z;
    }
}

/* |∇| of the luminance with a filter and its turned twin. */
static void find_feature(flip *f, const filter_kernel *kernel, float *strength)
{
    filter_rows(f->scratch[0], f->opponent[0], f->width, f->height, kernel);
    filter_columns(strength, f->scratch[0], f->width, f->height, &f->smooth, 0);
    filter_rows(f->scratch[0], f->opponent[0], f->width, f->height, &f->smooth);
    filter_columns(f->scratch[1], f->scratch[0], f->width, f->height, kernel, 0);
    for (size_t i = 0; i < f->count; i++)
        strength[i] = sqrtf(strength[i] * strength[i] + f->scratch[1][i] * f->scratch[1][i]);
}

static void see_color(flip *f, float *const planes[PLANES])
{
    static const int channel_of[SENSITIVITIES] = {0, 1, 2, 2};
    for (int i = 0; i < SENSITIVITIES; i++) {
        filter_rows(f->scratch[0], f->opponent[channel_of[i]], f->width, f->height, &f->sensitivity[i].rows);
        filter_columns(planes[channel_of[i]], f->scratch[0], f->width, f->height, &f->sensitivity[i].columns, i == 3);
    }
    for (size_t i = 0; i < f->count; i++) {
        const float y = planes[0][i];
        const triple light = transform(f->matrices.to_light, (triple){planes[1][i] + y, y, y - planes[2][i]});
        const triple lab = hunt_lab(&f->matrices, clamp_triple(light));
        planes[PLANE_L][i] = lab.x;
        planes[PLANE_A][i] = lab.y;
        planes[PLANE_B][i] = lab.z;
    }
}

static void see(flip *f, flip_picture picture, double scale, float *const planes[PLANES])
{
    to_opponent(f, picture, scale);
    see_color(f, planes);
    find_feature(f, &f->slope, planes[PLANE_EDGE]);
    find_feature(f, &f->curvature, planes[PLANE_POINT]);
}

/* ---- two pictures ---- */

static double mean_of(const flip *f, const float *map)
{
    double sum = 0;
    for (size_t y = 0; y < f->height; y++) {
        double row = 0;
        for (size_t x = 0; x < f->width; x++)
            row += map[y * f->width + x];
        sum += row;
    }
    return sum / (double)f->count;
}

static void compare(flip *f, flip_picture a, flip_picture b, double scale, float *map)
{
    see(f, a, scale, f->planes[0]);
    see(f, b, scale, f->planes[1]);
    float *const *const p = f->planes[0], *const *const q = f->planes[1];
    for (size_t i = 0; i < f->count; i++) {
        const float difference = lab_difference((triple){p[PLANE_L][i], p[PLANE_A][i], p[PLANE_B][i]}, (triple){q[PLANE_L][i], q[PLANE_A][i], q[PLANE_B][i]});
        const float color = redistribute(difference, f->greatest_difference);
        const float edge = fabsf(p[PLANE_EDGE][i] - q[PLANE_EDGE][i]), point = fabsf(p[PLANE_POINT][i] - q[PLANE_POINT][i]);
        const float feature = fminf(powf(fmaxf(edge, point) * (float)sqrt(0.5), FEATURE_EXPONENT), 1.0f);
        map[i] = powf(color, 1.0f - feature);
    }
}

double flip_ldr(flip *f, flip_picture a, flip_picture b, float *map)
{
    float *const result = map ? map : f->frame_map;
    compare(f, a, b, 0, result);
    return mean_of(f, result);
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static double median_of(const float *sorted, size_t count) { return 0.5 * ((double)sorted[(count - 1) / 2] + sorted[count / 2]); }

flip_exposures flip_exposures_of(flip *f, flip_picture reference)
{
    float *const sorted = f->scratch[0];
    for (size_t i = 0; i < f->count; i++)
        sorted[i] = fmaxf(color_luminance(reference.pixels + i * reference.channels, reference.channels), 0.0f);
    qsort(sorted, f->count, sizeof *sorted, ascending);
    size_t dark = 0;
    while (dark < f->count && sorted[dark] == 0.0f)
        dark++;
    if (dark == f->count)
        return (flip_exposures){0, 0, 1};
    const double whole = median_of(sorted, f->count), median = whole > 0 ? whole : median_of(sorted + dark, f->count - dark);
    const double light = flip_tone_inverse(TONE_TARGET);
    const double first = log2(light / sorted[f->count - 1]), last = log2(light / median), count = ceil(last - first);
    return (flip_exposures){first, last, count < 2 ? 2 : count > FLIP_EXPOSURES_MAX ? FLIP_EXPOSURES_MAX : (uint32_t)count};
}

double flip_hdr(flip *f, flip_picture a, flip_picture b, const flip_exposures *exposures, float *map)
{
    float *const result = map ? map : f->frame_map;
    memset(result, 0, f->count * sizeof *result);
    for (uint32_t e = 0; e < exposures->count; e++) {
        const double share = exposures->count > 1 ? (double)e / (exposures->count - 1) : 0;
        compare(f, a, b, exp2(exposures->first + share * (exposures->last - exposures->first)), f->exposure_map);
        for (size_t i = 0; i < f->count; i++)
            result[i] = fmaxf(result[i], f->exposure_map[i]);
    }
    return mean_of(f, result);
}
