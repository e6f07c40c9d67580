/* SPDX-License-Identifier: MIT */
/* What a screenshot of the viewer must look like:
 *
 *   window_check lively FILE                 neither black nor white nor all the same
 *   window_check wipe FILE A B SHARE WIDTH   left of SHARE x WIDTH as in A, right of it as in B, but for the divider and its labels
 *   window_check size FILE WxH
 *
 * Exit code 0: so it is, 1: not, 64: usage, 66: unreadable. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/picture.h"

static int read_picture(float_image *image, const char *path)
{
    file_error error;
    if (picture_read(image, path, NULL, &error) == FILE_OK)
        return 0;
    fprintf(stderr, "window_check: %s\n", error.text);
    return 66;
}

static int check_lively(const float_image *image)
{
    const size_t count = (size_t)image->width * image->height * image->channels;
    double sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++) {
        sum += (double)image->pixels[i];
        squares += (double)image->pixels[i] * (double)image->pixels[i];
    }
    const double mean = sum / (double)count, deviation = sqrt(fmax(squares / (double)count - mean * mean, 0));
    printf("mean %.4f, deviation %.4f\n", mean, deviation);
    return mean > 0.02 && mean < 0.95 && deviation > 0.03 ? 0 : 1;
}

static double distance(const float_image *a, const float_image *b, uint32_t x, uint32_t y)
{
    const size_t at = ((size_t)y * a->width + x) * a->channels;
    double most = 0;
    for (size_t c = 0; c < a->channels; c++)
        most = fmax(most, fabs((double)a->pixels[at + c] - (double)b->pixels[at + c]));
    return most;
}

/* The labels stand in the upper 60 rows, the divider's handle around it. */
static int check_wipe(const float_image *all, const float_image *a, const float_image *b, double share, uint32_t width)
{
    if (a->width != all->width || b->width != all->width || a->height != all->height || b->height != all->height)
        return 1;
    size_t wrong = 0, unlike = 0, seen = 0;
    for (uint32_t y = 60; y < all->height * 3 / 4; y++)
        for (uint32_t x = 0; x < width && x < all->width; x++) {
            const double from = x + 0.5 - share * width;
            if (fabs(from) < 20)
                continue;
            seen++;
            unlike += distance(a, b, x, y) > 0;
            wrong += distance(all, from < 0 ? a : b, x, y) > 0;
        }
    printf("%zu of %zu pixels are wrong; A and B differ in %zu\n", wrong, seen, unlike);
    return wrong == 0 && unlike > seen / 100 ? 0 : 1;
}

static int check_size(const float_image *image, const char *expected)
{
    char size[32];
    snprintf(size, sizeof size, "%ux%u", image->width, image->height);
    return strcmp(size, expected) == 0 ? 0 : 1;
}

int main(int count, char **arguments)
{
    const char *verb = count > 2 ? arguments[1] : "";
    const bool lively = !strcmp(verb, "lively") && count == 3, wipe = !strcmp(verb, "wipe") && count == 7, size = !strcmp(verb, "size") && count == 4;
    const int files = wipe ? 3 : lively || size ? 1 : 0;
    if (files == 0) {
        fprintf(stderr, "usage: window_check lively FILE | wipe FILE A B SHARE WIDTH | size FILE WxH\n");
        return 64;
    }
    float_image images[3] = {{0}};
    int code = 0;
    for (int i = 0; i < files && code == 0; i++)
        code = read_picture(&images[i], arguments[2 + i]);
    if (code == 0 && size)
        code = check_size(&images[0], arguments[3]);
    else if (code == 0 && lively)
        code = check_lively(&images[0]);
    else if (code == 0)
        code = check_wipe(&images[0], &images[1], &images[2], atof(arguments[5]), (uint32_t)atoi(arguments[6]));
    for (int i = 0; i < files; i++)
        float_image_free(&images[i]);
    return code;
}
