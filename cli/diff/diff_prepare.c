/* SPDX-License-Identifier: MIT */
/* Preparation of pictures before `mangata diff` compares them. */
#include "cli/diff/diff_prepare.h"

#include <math.h>
#include <stdlib.h>

#include "cli/common/console.h"
#include "image/metrics_color.h"

void diff_prepare_display(float_image *image, double exposure)
{
    const size_t count = (size_t)image->width * image->height * image->channels;
    const float factor = (float)exp2(exposure);
    for (size_t i = 0; i < count; i++)
        if (!isnan(image->pixels[i])) /* clamping would make it black */
            image->pixels[i] = color_srgb_encode(color_clamp(image->pixels[i] * factor));
}

static void blacken(float_image *image, size_t pixel)
{
    for (uint32_t c = 0; c < image->channels; c++)
        image->pixels[pixel * image->channels + c] = 0;
}

static bool counts(const float_image *mask, size_t pixel) { return mask->pixels[pixel] >= 0.999f; }

uint64_t diff_prepare_mask(float_image *images, size_t count, const float_image *mask)
{
    uint64_t left_out = 0;
    for (size_t i = 0; i < (size_t)mask->width * mask->height; i++) {
        if (counts(mask, i))
            continue;
        left_out++;
        for (size_t k = 0; k < count; k++)
            blacken(&images[k], i);
    }
    return left_out;
}

static int use_mask(diff_frame *f, const float_image *mask, const char *path)
{
    const float_image *a = &f->images[0];
    const size_t pixels = (size_t)a->width * a->height;
    if (mask->width != a->width || mask->height != a->height || mask->channels != 1)
        return console_error(EXIT_CODE_FAILED, "%s has %u x %u pixels of %u channel%s; a mask of %u x %u of 1 is needed", path, mask->width, mask->height,
                             mask->channels, mask->channels == 1 ? "" : "s", a->width, a->height);
    if (!(f->counted = malloc(pixels * sizeof *f->counted)))
        return console_error(EXIT_CODE_FAILED, "out of memory");
    for (size_t i = 0; i < pixels; i++)
        f->counted[i] = counts(mask, i);
    f->left_out = diff_prepare_mask(f->images, f->count, mask);
    return EXIT_CODE_OK;
}

static int apply_mask(const diff_prepare *p, uint32_t frame, diff_frame *f)
{
    char path[sizeof p->mask_name.before + 64 + sizeof p->mask_name.after];
    float_image mask = {0};
    file_error error;
    if (!frame_path_print(&p->mask_name, frame, path, sizeof path))
        return console_error(EXIT_CODE_USAGE, "%s: the path is too long", p->mask);
    if (picture_read(&mask, path, NULL, &error) != FILE_OK)
        return console_file_error(&error);
    const int code = use_mask(f, &mask, path);
    float_image_free(&mask);
    return code;
}

int diff_prepare_frame(const diff_prepare *prepare, uint32_t frame, diff_frame *f)
{
    for (size_t i = 0; i < f->count && prepare->displayed; i++)
        diff_prepare_display(&f->images[i], prepare->exposure);
    return prepare->mask ? apply_mask(prepare, frame, f) : EXIT_CODE_OK;
}

void diff_frame_free(diff_frame *f)
{
    for (size_t i = 0; i < 3; i++)
        float_image_free(&f->images[i]);
    free(f->counted);
    *f = (diff_frame){.count = 0};
}
