/* SPDX-License-Identifier: MIT */
/* Running sums of steps, and counts of glints. */
#include "image/metrics_flicker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNTS = 4, SIZE_CLASSES = 32 }; /* bright pixels of A and B, glints of A and B */

struct flicker {
    uint32_t width, height, channels;
    size_t pixels;
    size_t frames, capacity;
    float *previous[2];               /* the last frame of A, of B */
    double *power[2], *squared_error; /* sums over steps, per pixel, of the mean over channels */
    uint32_t *labels;
    uint32_t *counts; /* COUNTS a frame */
    uint64_t sizes[2][SIZE_CLASSES];
};

file_status flicker_create(flicker **result, uint32_t width, uint32_t height, uint32_t channels, file_error *error)
{
    *result = NULL;
    flicker *f = calloc(1, sizeof *f);
    if (!f)
        return file_error_set(error, FILE_MEMORY, "out of memory for flicker");
    f->width = width;
    f->height = height;
    f->channels = channels;
    f->pixels = (size_t)width * height;
    for (int i = 0; i < 2; i++) {
        f->previous[i] = calloc(f->pixels, channels * sizeof(float));
        f->power[i] = calloc(f->pixels, sizeof(double));
    }
    f->squared_error = calloc(f->pixels, sizeof(double));
    f->labels = calloc(f->pixels, 2 * sizeof(uint32_t));
    if (!f->previous[0] || !f->previous[1] || !f->power[0] || !f->power[1] || !f->squared_error || !f->labels) {
        flicker_free(f);
        return file_error_set(error, FILE_MEMORY, "out of memory for flicker of %u x %u pixels", width, height);
    }
    *result = f;
    return FILE_OK;
}

void flicker_free(flicker *f)
{
    if (!f)
        return;
    for (int i = 0; i < 2; i++) {
        free(f->previous[i]);
        free(f->power[i]);
    }
    free(f->squared_error);
    free(f->labels);
    free(f->counts);
    free(f);
}

/* ---- glints ---- */

/* labels[i] is 0 for a dark pixel, else 1 + the pixel that its group hangs on; a root hangs on itself. */
static uint32_t find_root(uint32_t *labels, uint32_t pixel)
{
    while (labels[pixel] != pixel + 1) {
        const uint32_t above = labels[pixel] - 1;
        labels[pixel] = labels[above];
        pixel = above;
    }
    return pixel;
}

static void join(uint32_t *labels, uint32_t p, uint32_t q)
{
    const uint32_t a = find_root(labels, p), b = find_root(labels, q);
    if (a < b)
        labels[b] = a + 1;
    else
        labels[a] = b + 1;
}

static void join_neighbours(uint32_t *labels, uint32_t x, uint32_t y, uint32_t width)
{
    const uint32_t pixel = y * width + x;
    if (x > 0 && labels[pixel - 1])
        join(labels, pixel, pixel - 1);
    if (y == 0)
        return;
    for (uint32_t left = x > 0 ? x - 1 : 0; left <= x + 1 && left < width; left++)
        if (labels[pixel - width - x + left])
            join(labels, pixel, pixel - width - x + left);
}

uint32_t flicker_count_glints(const float *luminance, uint32_t width, uint32_t height, float threshold, uint32_t *labels, uint64_t sizes[SIZE_CLASSES])
{
    const uint32_t pixels = width * height;
    uint32_t *const size = labels + pixels;
    uint32_t glints = 0;
    for (uint32_t i = 0; i < pixels; i++) {
        labels[i] = luminance[i] > threshold ? i + 1 : 0;
        size[i] = 0;
        if (labels[i])
            join_neighbours(labels, i % width, i / width, width);
    }
    for (uint32_t i = 0; i < pixels; i++)
        if (labels[i])
            size[find_root(labels, i)]++;
    for (uint32_t i = 0; i < pixels; i++) {
        int size_class = 0;
        if (!size[i])
            continue;
        while (size[i] >> (size_class + 1))
            size_class++;
        sizes[size_class]++;
        glints++;
    }
    return glints;
}

static uint32_t count_bright(const float *luminance, size_t pixels, float threshold)
{
    uint32_t bright = 0;
    for (size_t i = 0; i < pixels; i++)
        bright += luminance[i] > threshold;
    return bright;
}

static void add_counts(flicker *f, const flicker_input *input, flicker_step *step)
{
    uint32_t *const counts = f->counts + COUNTS * f->frames;
    for (int i = 0; i < 2; i++) {
        if (input->luminance[i]) {
            step->bright[i] = count_bright(input->luminance[i], f->pixels, input->threshold);
            step->glints[i] = flicker_count_glints(input->luminance[i], f->width, f->height, input->threshold, f->labels, f->sizes[i]);
        }
        counts[i] = step->bright[i];
        counts[2 + i] = step->glints[i];
    }
}

/* ---- steps ---- */

static double ratio_of(double a, double b) { return b > 0 ? a / b : a > 0 ? INFINITY : 1; }

static void add_step(flicker *f, const flicker_input *input, float *map, flicker_step *step)
{
    double error = 0, difference = 0, power_a = 0, power_b = 0;
    for (size_t i = 0; i < f->pixels; i++) {
        double pixel_error = 0, a = 0, b = 0;
        for (size_t v = i * f->channels; v < (i + 1) * f->channels; v++) {
            const double step_a = (double)input->values[0][v] - (double)f->previous[0][v];
            const double step_b = (double)input->values[1][v] - (double)f->previous[1][v];
            a += step_a * step_a / f->channels;
            b += step_b * step_b / f->channels;
            pixel_error += (step_a - step_b) * (step_a - step_b) / f->channels;
        }
        f->power[0][i] += a;
        f->power[1][i] += b;
        f->squared_error[i] += pixel_error;
        error += pixel_error;
        difference += fabs(a - b);
        power_a += a;
        power_b += b;
        if (map)
            map[i] = (float)sqrt(pixel_error);
    }
    step->error = sqrt(error / (double)f->pixels);
    step->power = difference / (double)f->pixels;
    step->ratio = ratio_of(power_a, power_b);
}

file_status flicker_add(flicker *f, const flicker_input *input, float *map, flicker_step *step, file_error *error)
{
    *step = (flicker_step){.error = NAN, .power = NAN, .ratio = NAN};
    if (f->frames == f->capacity) {
        const size_t capacity = f->capacity ? 2 * f->capacity : 64;
        uint32_t *counts = capacity > SIZE_MAX / COUNTS / sizeof *counts ? NULL : realloc(f->counts, capacity * COUNTS * sizeof *counts);
        if (!counts)
            return file_error_set(error, FILE_MEMORY, "out of memory for flicker");
        f->counts = counts;
        f->capacity = capacity;
    }
    add_counts(f, input, step);
    if (f->frames > 0)
        add_step(f, input, map, step);
    else if (map)
        memset(map, 0, f->pixels * sizeof *map);
    for (int i = 0; i < 2; i++)
        memcpy(f->previous[i], input->values[i], f->pixels * f->channels * sizeof(float));
    f->frames++;
    return FILE_OK;
}

/* ---- the clip ---- */

static int ascending(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Column `of_a` of the counts against the one after it. */
static double count_distance(const flicker *f, int of_a, uint32_t *sorted_a, uint32_t *sorted_b)
{
    double sum = 0, all_b = 0;
    for (size_t i = 0; i < f->frames; i++) {
        sorted_a[i] = f->counts[COUNTS * i + of_a];
        sorted_b[i] = f->counts[COUNTS * i + of_a + 1];
    }
    qsort(sorted_a, f->frames, sizeof *sorted_a, ascending);
    qsort(sorted_b, f->frames, sizeof *sorted_b, ascending);
    for (size_t i = 0; i < f->frames; i++) {
        sum += fabs((double)sorted_a[i] - sorted_b[i]);
        all_b += sorted_b[i];
    }
    return sum / fmax(all_b, 1);
}

static void measure_sizes(const flicker *f, flicker_scores *scores)
{
    double difference = 0, all_a = 0, all_b = 0;
    for (int i = 0; i < SIZE_CLASSES; i++) {
        difference += fabs((double)f->sizes[0][i] - (double)f->sizes[1][i]);
        all_a += (double)f->sizes[0][i];
        all_b += (double)f->sizes[1][i];
    }
    scores->sizes = difference / fmax(all_b, 1);
    scores->has_glints = all_a + all_b > 0;
}

static void measure_steps(const flicker *f, flicker_scores *scores)
{
    double error = 0, difference = 0, power_a = 0, power_b = 0;
    for (size_t i = 0; i < f->pixels; i++) {
        error += f->squared_error[i];
        difference += fabs(f->power[0][i] - f->power[1][i]);
        power_a += f->power[0][i];
        power_b += f->power[1][i];
    }
    const double values = (double)f->pixels * (double)(f->frames - 1);
    scores->error = sqrt(error / values);
    scores->power = difference / values;
    scores->ratio = ratio_of(power_a, power_b);
}

file_status flicker_measure(const flicker *f, flicker_scores *scores, file_error *error)
{
    *scores = (flicker_scores){NAN, NAN, NAN, NAN, NAN, NAN, false, false};
    uint32_t *sorted = malloc((2 * f->frames + 1) * sizeof *sorted);
    if (!sorted)
        return file_error_set(error, FILE_MEMORY, "out of memory for flicker");
    measure_sizes(f, scores);
    scores->has_steps = f->frames > 1;
    if (scores->has_steps)
        measure_steps(f, scores);
    if (scores->has_glints) {
        scores->bright = count_distance(f, 0, sorted, sorted + f->frames);
        scores->glints = count_distance(f, 2, sorted, sorted + f->frames);
    } else {
        scores->sizes = NAN;
    }
    free(sorted);
    return FILE_OK;
}
