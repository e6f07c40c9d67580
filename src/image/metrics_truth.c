/* SPDX-License-Identifier: MIT */
/* Makes luminances for the measures of texture and specks; see metrics_truth.h. */
#include "image/metrics_truth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/metrics_clip.h"
#include "image/metrics_color.h"
#include "image/metrics_specks.h"

/* ---- words ---- */

const char truth_words_text[] = "texture, specks";

static bool is_word(const char *text, size_t length, const char *word) { return strlen(word) == length && memcmp(text, word, length) == 0; }

bool truth_words_parse(const char *list, truth_words *words, uint32_t *clip)
{
    truth_words found = {false, false};
    uint32_t set = 0;
    for (;; list++) {
        const size_t length = strcspn(list, ",");
        char word[32] = "";
        uint32_t bits = 0;
        if (is_word(list, length, "texture")) {
            found.texture = true;
        } else if (is_word(list, length, "specks")) {
            found.specks = true;
        } else {
            if (length >= sizeof word)
                return false;
            memcpy(word, list, length);
            if (!clip_metrics_parse(word, &bits))
                return false;
            set |= bits;
        }
        list += length;
        if (!*list)
            break;
    }
    *words = found;
    *clip = set;
    return true;
}

/* ---- a frame ---- */

static file_status start(truth_metrics *t, const truth_frame *frame, file_error *error)
{
    const float_image *a = &frame->images[0];
    if (a->channels != 1 && a->channels != 3)
        return file_error_set(error, FILE_ARGUMENT, "pictures of %u channels have no luminance for --metrics %s; allowed: 1 or 3", a->channels,
                              t->wants.texture ? "texture" : "specks");
    t->width = a->width;
    t->height = a->height;
    t->channels = a->channels;
    for (size_t i = 0; i < frame->count; i++)
        if (!(t->luminance[i] = malloc((size_t)a->width * a->height * sizeof(float))))
            return file_error_set(error, FILE_MEMORY, "out of memory for metrics");
    return t->wants.texture ? texture_create(&t->bands, a->width, a->height, error) : FILE_OK;
}

/* What is not finite, or leaves the range of float on the way, stands as 0. */
static void make_luminance(float *luminance, const float_image *image, bool srgb_encoded)
{
    const size_t count = (size_t)image->width * image->height;
    for (size_t i = 0; i < count; i++) {
        float light[3];
        for (uint32_t c = 0; c < image->channels; c++) {
            const float value = image->pixels[i * image->channels + c];
            light[c] = srgb_encoded ? color_srgb_decode(value) : value;
        }
        luminance[i] = color_luminance(light, image->channels);
        if (!isfinite(luminance[i]))
            luminance[i] = 0;
    }
}

/* Values of all pictures against those of B. */
static uint64_t count_mismatches(const truth_frame *frame)
{
    const float_image *b = &frame->images[1];
    const size_t values = (size_t)b->width * b->height * b->channels;
    uint64_t count = 0;
    for (size_t k = 0; k < frame->count; k += 2)
        for (size_t i = 0; i < values; i++)
            count += !image_values_comparable(frame->images[k].pixels[i], b->pixels[i]);
    return count;
}

static uint64_t count_specks(const truth_metrics *t, const bool *counted, int picture, int truth)
{
    const specks_input input = {t->luminance[picture], t->luminance[truth], counted, t->width, t->height};
    return specks_count(&input);
}

/* Takes the luminances for its own: they are displayed values afterwards. */
static void add_specks(truth_metrics *t, const truth_frame *frame)
{
    const size_t count = (size_t)t->width * t->height;
    for (size_t k = 0; k < frame->count; k++)
        for (size_t i = 0; i < count; i++)
            t->luminance[k][i] = color_srgb_encode(color_clamp(t->luminance[k][i]));
    t->pixels += count - frame->left_out;
    t->specks += count_specks(t, frame->counted, 0, 1);
    if (frame->count < 3)
        return;
    t->reference_specks[0] += count_specks(t, frame->counted, 1, 2);
    t->reference_specks[1] += count_specks(t, frame->counted, 2, 1);
}

file_status truth_metrics_add(truth_metrics *t, const truth_frame *frame, file_error *error)
{
    file_status status = FILE_OK;
    t->has_second = frame->count == 3;
    if (t->has_second && (status = noise_sums_add(&t->noise, frame->images, frame->counted, error)) != FILE_OK)
        return status;
    if (!t->wants.texture && !t->wants.specks)
        return FILE_OK;
    const float_image *a = &frame->images[0];
    if (!t->luminance[0] && (status = start(t, frame, error)) != FILE_OK)
        return status;
    if (a->width != t->width || a->height != t->height || a->channels != t->channels)
        return file_error_set(error, FILE_ARGUMENT, "a frame has %u x %u pixels of %u channel%s, the first one %u x %u of %u; they must agree", a->width,
                              a->height, a->channels, a->channels == 1 ? "" : "s", t->width, t->height, t->channels);
    t->mismatches += count_mismatches(frame);
    for (size_t i = 0; i < frame->count; i++)
        make_luminance(t->luminance[i], &frame->images[i], t->srgb_encoded);
    const texture_input input = {t->luminance[0], {t->luminance[1], t->luminance[2]}, frame->counted};
    if (t->wants.texture)
        texture_add(t->bands, &input);
    if (t->wants.specks)
        add_specks(t, frame);
    return FILE_OK;
}

/* ---- what was measured ---- */

speck_figures truth_metrics_specks(const truth_metrics *t)
{
    const double pixels = t->pixels ? (double)t->pixels : 1, mean = ((double)t->reference_specks[0] + (double)t->reference_specks[1]) / 2;
    const double excess = (double)t->specks - mean;
    return (speck_figures){(double)t->specks / pixels, mean, mean / pixels, excess, excess / pixels};
}

const char *truth_metrics_specks_missing(const truth_metrics *t) { return t->mismatches ? image_mismatch_text : NULL; }

const char *truth_metrics_texture_missing(const truth_metrics *t)
{
    if (t->mismatches)
        return image_mismatch_text;
    return t->bands && texture_bands(t->bands) > 0 ? NULL : "texture needs at least five rows";
}

void truth_metrics_free(truth_metrics *t)
{
    for (int i = 0; i < 3; i++)
        free(t->luminance[i]);
    texture_free(t->bands);
    *t = (truth_metrics){.bands = NULL};
}
