/* SPDX-License-Identifier: MIT */
/* What `mangata diff` makes of pictures before it compares them. */
#include "cli/diff/diff_prepare.h"

#include <math.h>

#include "cli/common/console.h"
#include "image/metrics_color.h"

void diff_prepare_display(float_image *image, double exposure)
{
    const size_t count = (size_t)image->width * image->height * image->channels;
    const float factor = (float)exp2(exposure);
    for (size_t i = 0; i < count; i++)
        image->pixels[i] = color_srgb_encode(color_clamp(image->pixels[i] * factor));
}

static void blacken(float_image *image, size_t pixel)
{
    for (uint32_t c = 0; c < image->channels; c++)
        image->pixels[pixel * image->channels + c] = 0;
}

uint64_t diff_prepare_mask(float_image pair[2], const float_image *mask)
{
    uint64_t left_out = 0;
    for (size_t i = 0; i < (size_t)mask->width * mask->height; i++) {
        if (mask->pixels[i] >= 0.999f)
            continue;
        left_out++;
        blacken(&pair[0], i);
        blacken(&pair[1], i);
    }
    return left_out;
}

static int apply_mask(const diff_prepare *p, uint32_t frame, float_image pair[2], uint64_t *left_out)
{
    char path[sizeof p->mask_name.before + 64 + sizeof p->mask_name.after];
    float_image mask = {0};
    file_error error;
    if (!frame_path_print(&p->mask_name, frame, path, sizeof path))
        return console_error(EXIT_CODE_USAGE, "%s: the path is too long", p->mask);
    if (picture_read(&mask, path, NULL, &error) != FILE_OK)
        return console_file_error(&error);
    if (mask.width != pair[0].width || mask.height != pair[0].height || mask.channels != 1) {
        const int code = console_error(EXIT_CODE_FAILED, "%s has %u x %u pixels of %u channel%s; a mask of %u x %u of 1 is needed", path, mask.width,
                                       mask.height, mask.channels, mask.channels == 1 ? "" : "s", pair[0].width, pair[0].height);
        float_image_free(&mask);
        return code;
    }
    *left_out = diff_prepare_mask(pair, &mask);
    float_image_free(&mask);
    return EXIT_CODE_OK;
}

int diff_prepare_pair(const diff_prepare *prepare, uint32_t frame, float_image pair[2], uint64_t *left_out)
{
    *left_out = 0;
    for (int i = 0; i < 2 && prepare->displayed; i++)
        diff_prepare_display(&pair[i], prepare->exposure);
    return prepare->mask ? apply_mask(prepare, frame, pair, left_out) : EXIT_CODE_OK;
}
