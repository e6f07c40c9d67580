/* SPDX-License-Identifier: MIT */
/* Comparisons of pictures for the image tests:
 *
 *   picture_check near A B MAX MEAN DIFFERENCE.png   largest and mean |A − B| within limits; else |A − B| × 8 is saved
 *   picture_check most A B FAR SHARE MEAN DIFFERENCE.png   the share of |A − B| beyond FAR and the mean of the others within limits; else the same
 *   picture_check runs A B FAR SHARE RUN DIFFERENCE.png   the share of pixels with |A − B| beyond FAR, and how long the longest of their connected
 *                                                    runs is, within limits; else the same
 *   picture_check crop WHOLE PART X Y                PART equals that place of WHOLE to the bit
 *   picture_check pick OUT.pfm N A                   writes the middle one of every N × N pixels
 *   picture_check mean OUT.pfm N A                   writes the mean of every N × N pixels; a grey A gets one channel
 *   picture_check shift N FINE COARSE                by how many of its own pixels COARSE lies right of and below the means of N × N pixels of FINE
 *   picture_check area WITHOUT WITH                  pixels that something black covers, from pictures without and with it
 *   picture_check depth A B                          per cent of B's pixels off by more than max(1%, 5 mm), and the largest error
 *
 * Exit code 0: alike, 1: not, 64: usage, 66: unreadable. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"

typedef struct picture_pair {
    float_image a, b;
} picture_pair;

static bool read_pair(picture_pair *pair, char **paths)
{
    file_error error;
    if (picture_read(&pair->a, paths[0], NULL, &error) != FILE_OK || picture_read(&pair->b, paths[1], NULL, &error) != FILE_OK) {
        fprintf(stderr, "picture_check: %s\n", error.text);
        return false;
    }
    return true;
}

static bool same_shape(const picture_pair *p)
{
    if (p->a.width == p->b.width && p->a.height == p->b.height && p->a.channels == p->b.channels)
        return true;
    fprintf(stderr, "picture_check: %u x %u x %u against %u x %u x %u\n", p->a.width, p->a.height, p->a.channels, p->b.width, p->b.height, p->b.channels);
    return false;
}

/* Infinities of one sign are alike; whatever else is not finite is infinitely far. */
static double distance(float a, float b)
{
    if (a == b)
        return 0;
    const double d = fabs((double)a - (double)b);
    return isfinite(d) ? d : INFINITY;
}

static void save_difference(const picture_pair *p, const char *path)
{
    const size_t pixels = (size_t)p->a.width * p->a.height;
    uint8_t *rgba = malloc(pixels * 4);
    if (!rgba)
        return;
    for (size_t i = 0; i < pixels; i++) {
        for (size_t c = 0; c < 3; c++) {
            const size_t at = i * p->a.channels + (c < p->a.channels ? c : 0);
            rgba[4 * i + c] = (uint8_t)lrint(fmin(distance(p->a.pixels[at], p->b.pixels[at]) * 8, 1) * 255);
        }
        rgba[4 * i + 3] = 255;
    }
    const metadata_list none = {0};
    const output_options options = {.overwrite = true};
    file_error error;
    if (picture_write_png(path, p->a.width, p->a.height, rgba, 0, &none, &options, &error) == FILE_OK)
        fprintf(stderr, "picture_check: the difference × 8 is in %s\n", path);
    free(rgba);
}

static int check_near(const picture_pair *p, char **limits)
{
    if (!same_shape(p))
        return 1;
    const size_t count = (size_t)p->a.width * p->a.height * p->a.channels;
    double largest = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double d = distance(p->a.pixels[i], p->b.pixels[i]);
        largest = fmax(largest, d);
        sum += d;
    }
    const double mean = sum / (double)count;
    printf("largest difference %.6f (≤ %s), mean %.7f (≤ %s)\n", largest, limits[0], mean, limits[1]);
    if (largest <= atof(limits[0]) && mean <= atof(limits[1]))
        return 0;
    save_difference(p, limits[2]);
    return 1;
}

static int check_most(const picture_pair *p, char **limits)
{
    if (!same_shape(p))
        return 1;
    const size_t count = (size_t)p->a.width * p->a.height * p->a.channels;
    const double far = atof(limits[0]);
    double sum = 0;
    size_t beyond = 0;
    for (size_t i = 0; i < count; i++) {
        const double d = distance(p->a.pixels[i], p->b.pixels[i]);
        if (d > far)
            beyond++;
        else
            sum += d;
    }
    const double share = (double)beyond / (double)count, mean = sum / (double)count;
    printf("share beyond %s: %.5f (≤ %s), mean of the others %.7f (≤ %s)\n", limits[0], share, limits[1], mean, limits[2]);
    if (share <= atof(limits[1]) && mean <= atof(limits[2]))
        return 0;
    save_difference(p, limits[3]);
    return 1;
}

/* ---- runs ---- */

static bool *find_far(const picture_pair *p, double far, size_t *count)
{
    const size_t pixels = (size_t)p->a.width * p->a.height;
    bool *off = calloc(pixels, sizeof *off);
    *count = 0;
    for (size_t i = 0; off && i < pixels; i++) {
        for (size_t c = 0; c < p->a.channels; c++)
            off[i] = off[i] || distance(p->a.pixels[i * p->a.channels + c], p->b.pixels[i * p->a.channels + c]) > far;
        *count += off[i];
    }
    return off;
}

/* Side of the smallest square that holds the pixels connected with `first`, corners counted; they are taken off. `stack` has room for all pixels. */
static uint32_t run_length(bool *off, size_t *stack, uint32_t width, uint32_t height, size_t first)
{
    uint32_t low_x = width, low_y = height, high_x = 0, high_y = 0;
    size_t waiting = 0;
    stack[waiting++] = first;
    off[first] = false;
    while (waiting > 0) {
        const size_t at = stack[--waiting];
        const uint32_t x = (uint32_t)(at % width), y = (uint32_t)(at / width);
        low_x = x < low_x ? x : low_x, high_x = x > high_x ? x : high_x;
        low_y = y < low_y ? y : low_y, high_y = y > high_y ? y : high_y;
        for (uint32_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row < height; row++)
            for (uint32_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column < width; column++) {
                const size_t next = (size_t)row * width + column;
                if (off[next])
                    stack[waiting++] = next;
                off[next] = false;
            }
    }
    const uint32_t across = high_x - low_x, down = high_y - low_y;
    return (across > down ? across : down) + 1;
}

static int check_runs(const picture_pair *p, char **limits)
{
    if (!same_shape(p))
        return 1;
    const size_t pixels = (size_t)p->a.width * p->a.height;
    size_t beyond, *stack = malloc(pixels * sizeof *stack);
    bool *off = find_far(p, atof(limits[0]), &beyond);
    uint32_t longest = 0;
    for (size_t i = 0; off && stack && i < pixels; i++) {
        const uint32_t length = off[i] ? run_length(off, stack, p->a.width, p->a.height, i) : 0;
        longest = length > longest ? length : longest;
    }
    const bool ready = off && stack;
    free(off);
    free(stack);
    if (!ready)
        return 66;
    const double share = (double)beyond / (double)pixels;
    printf("share beyond %s: %.5f (≤ %s), longest run %u (≤ %s)\n", limits[0], share, limits[1], longest, limits[2]);
    if (share <= atof(limits[1]) && longest <= strtoul(limits[2], NULL, 10))
        return 0;
    save_difference(p, limits[3]);
    return 1;
}

static int check_crop(const picture_pair *p, char **place)
{
    const unsigned long x = strtoul(place[0], NULL, 10), y = strtoul(place[1], NULL, 10);
    const float_image *whole = &p->a, *part = &p->b;
    if (x + part->width > whole->width || y + part->height > whole->height || whole->channels != part->channels) {
        fprintf(stderr, "picture_check: the part does not fit into the whole\n");
        return 1;
    }
    const size_t row = (size_t)part->width * part->channels;
    for (uint32_t j = 0; j < part->height; j++)
        if (memcmp(whole->pixels + (((y + j) * whole->width) + x) * whole->channels, part->pixels + j * row, row * sizeof *part->pixels) != 0) {
            fprintf(stderr, "picture_check: row %u of the part differs from the whole\n", j);
            return 1;
        }
    printf("%u x %u pixels at %lu, %lu are equal to the bit\n", part->width, part->height, x, y);
    return 0;
}

static int check_depth(const picture_pair *p)
{
    if (!same_shape(p) || p->a.channels != 1)
        return 1;
    const size_t count = (size_t)p->a.width * p->a.height;
    size_t off = 0;
    double largest = 0;
    for (size_t i = 0; i < count; i++) {
        const double exact = (double)p->b.pixels[i], d = distance(p->a.pixels[i], p->b.pixels[i]);
        off += !(d <= fmax(0.01 * exact, 0.005));
        if (isfinite(d))
            largest = fmax(largest, d);
    }
    printf("%.5f %.4g\n", 100.0 * (double)off / (double)count, largest);
    return 0;
}

/* Of the middle channel; pixels that are black anyway do not count. */
static int print_area(const picture_pair *p)
{
    if (!same_shape(p))
        return 1;
    const size_t count = (size_t)p->a.width * p->a.height;
    double most = 0, sum = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, (double)p->a.pixels[i * p->a.channels + p->a.channels / 2]);
    for (size_t i = 0; i < count; i++) {
        const double without = (double)p->a.pixels[i * p->a.channels + p->a.channels / 2], with = (double)p->b.pixels[i * p->b.channels + p->b.channels / 2];
        if (without > 1e-6 * most)
            sum += fmin(fmax((without - with) / without, 0), 1);
    }
    printf("%.2f\n", sum);
    return 0;
}

/* ---- pixels of a larger picture ---- */

static bool read_whole(float_image *whole, uint32_t step, const char *path)
{
    file_error error;
    if (step > 0 && picture_read(whole, path, NULL, &error) == FILE_OK)
        return true;
    fprintf(stderr, "picture_check: %s\n", step == 0 ? "every how many pixels?" : error.text);
    return false;
}

static int write_part(const char *path, uint32_t columns, uint32_t rows, const picture_layer *layer)
{
    const metadata_list none = {0};
    const output_options options = {.overwrite = true};
    file_error error;
    const file_status written = picture_write_pfm(path, columns, rows, layer, &none, &options, &error);
    if (written != FILE_OK)
        fprintf(stderr, "picture_check: %s\n", error.text);
    return written == FILE_OK ? 0 : 66;
}

static int write_picked(const char *path, const char *every, const char *from)
{
    const uint32_t step = (uint32_t)strtoul(every, NULL, 10);
    float_image whole = {0};
    if (!read_whole(&whole, step, from))
        return step == 0 ? 64 : 66;
    const uint32_t columns = whole.width / step, rows = whole.height / step;
    float *to = whole.pixels; /* nothing is overwritten before it is read */
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++, to += whole.channels) {
            const size_t at = (size_t)(row * step + step / 2) * whole.width + column * step + step / 2;
            memmove(to, whole.pixels + at * whole.channels, whole.channels * sizeof *to);
        }
    const picture_layer layer = {.name = "picked", .channels = whole.channels, .pixels = whole.pixels};
    const int code = write_part(path, columns, rows, &layer);
    float_image_free(&whole);
    return code;
}

/* Mean of channel c over step × step pixels whose first is at (left, top). */
static double block_mean(const float_image *whole, uint32_t step, uint32_t left, uint32_t top, uint32_t c)
{
    double sum = 0;
    for (uint32_t row = top; row < top + step; row++)
        for (uint32_t column = left; column < left + step; column++)
            sum += (double)whole->pixels[((size_t)row * whole->width + column) * whole->channels + c];
    return sum / ((double)step * step);
}

static bool is_grey(const float_image *image)
{
    const size_t pixels = (size_t)image->width * image->height;
    for (size_t i = 0; i < pixels; i++)
        for (uint32_t c = 1; c < image->channels; c++)
            if (image->pixels[i * image->channels + c] != image->pixels[i * image->channels])
                return false;
    return true;
}

static int write_means(const char *path, const char *every, const char *from)
{
    const uint32_t step = (uint32_t)strtoul(every, NULL, 10);
    float_image whole = {0};
    if (!read_whole(&whole, step, from))
        return step == 0 ? 64 : 66;
    const uint32_t columns = whole.width / step, rows = whole.height / step, channels = is_grey(&whole) ? 1 : whole.channels;
    float *means = malloc((size_t)columns * rows * channels * sizeof *means);
    for (uint32_t row = 0; means && row < rows; row++)
        for (uint32_t column = 0; column < columns; column++)
            for (uint32_t c = 0; c < channels; c++)
                means[((size_t)row * columns + column) * channels + c] = (float)block_mean(&whole, step, column * step, row * step, c);
    const picture_layer layer = {.name = "means", .channels = channels, .pixels = means};
    const int code = means ? write_part(path, columns, rows, &layer) : 66;
    free(means);
    float_image_free(&whole);
    return code;
}

/* Mean squared difference of the first channels where the means begin `right` and `down` pixels of the fine picture later; one pixel of the coarse
 * one all around does not count. */
static double displaced_error(const float_image *fine, const float_image *coarse, uint32_t step, int right, int down)
{
    double sum = 0;
    for (uint32_t row = 1; row + 1 < coarse->height; row++)
        for (uint32_t column = 1; column + 1 < coarse->width; column++) {
            const double mean = block_mean(fine, step, column * step + (uint32_t)right, row * step + (uint32_t)down, 0);
            const double d = mean - (double)coarse->pixels[((size_t)row * coarse->width + column) * coarse->channels];
            sum += d * d;
        }
    return sum / ((double)(coarse->width - 2) * (coarse->height - 2));
}

/* Where the parabola through three values at −1, 0 and 1 is least. */
static double least_at(double before, double here, double after)
{
    const double bend = before - 2 * here + after;
    return bend > 0 ? 0.5 * (before - after) / bend : INFINITY;
}

/* The means that are most like COARSE begin where it lies: the mean of the error of a picture and one displaced is even in how far. */
static int print_shift(const char *every, const char *fine_path, const char *coarse_path)
{
    const uint32_t step = (uint32_t)strtoul(every, NULL, 10);
    float_image fine = {0}, coarse = {0};
    int code = 66;
    if (read_whole(&fine, step, fine_path) && read_whole(&coarse, step, coarse_path)) {
        code = 1;
        if (coarse.width < 3 || coarse.height < 3 || fine.width != coarse.width * step || fine.height != coarse.height * step)
            fprintf(stderr, "picture_check: %s is not %u times as large as %s\n", fine_path, step, coarse_path);
        else {
            const double here = displaced_error(&fine, &coarse, step, 0, 0);
            const double right = least_at(displaced_error(&fine, &coarse, step, -1, 0), here, displaced_error(&fine, &coarse, step, 1, 0));
            const double down = least_at(displaced_error(&fine, &coarse, step, 0, -1), here, displaced_error(&fine, &coarse, step, 0, 1));
            printf("%.5f %.5f\n", right / step, down / step);
            code = 0;
        }
    }
    float_image_free(&fine);
    float_image_free(&coarse);
    return code;
}

int main(int count, char **arguments)
{
    const char *verb = count > 3 ? arguments[1] : "";
    const bool pick = !strcmp(verb, "pick") && count == 5;
    const bool near = !strcmp(verb, "near") && count == 7, crop = !strcmp(verb, "crop") && count == 6;
    const bool most = !strcmp(verb, "most") && count == 8, runs = !strcmp(verb, "runs") && count == 8, depth = !strcmp(verb, "depth") && count == 4;
    const bool area = !strcmp(verb, "area") && count == 4, means = !strcmp(verb, "mean") && count == 5, shift = !strcmp(verb, "shift") && count == 5;
    if (!pick && !means && !shift && !near && !most && !runs && !crop && !depth && !area) {
        fprintf(stderr, "usage: picture_check near A B MAX MEAN DIFFERENCE.png | most A B FAR SHARE MEAN DIFFERENCE.png |\n"
                        "       runs A B FAR SHARE RUN DIFFERENCE.png | crop WHOLE PART X Y | pick OUT.pfm N A | depth A B |\n"
                        "       area WITHOUT WITH | mean OUT.pfm N A | shift N FINE COARSE\n");
        return 64;
    }
    if (pick)
        return write_picked(arguments[2], arguments[3], arguments[4]);
    if (means)
        return write_means(arguments[2], arguments[3], arguments[4]);
    if (shift)
        return print_shift(arguments[2], arguments[3], arguments[4]);
    picture_pair pair = {0};
    int code = 66;
    if (read_pair(&pair, arguments + 2))
        code = near   ? check_near(&pair, arguments + 4)
               : most ? check_most(&pair, arguments + 4)
               : runs ? check_runs(&pair, arguments + 4)
               : crop ? check_crop(&pair, arguments + 4)
               : area ? print_area(&pair)
                      : check_depth(&pair);
    float_image_free(&pair.a);
    float_image_free(&pair.b);
    return code;
}
