/* SPDX-License-Identifier: MIT */
/* Makes luminances for the measures of texture and specks, and prints their figures. */
#include "cli/diff/diff_truth.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/console.h"
#include "image/metrics_clip.h"
#include "image/metrics_color.h"
#include "image/metrics_specks.h"

static const char no_bands[] = "texture needs at least five rows";

/* ---- words ---- */

const char diff_truth_words[] = "texture, specks";

static bool is_word(const char *text, size_t length, const char *word) { return strlen(word) == length && memcmp(text, word, length) == 0; }

bool diff_truth_parse(diff_truth *truth, const char *list, uint32_t *clip)
{
    bool wants_texture = false, wants_specks = false;
    uint32_t set = 0;
    for (;; list++) {
        const size_t length = strcspn(list, ",");
        char word[32] = "";
        uint32_t bits = 0;
        if (is_word(list, length, "texture")) {
            wants_texture = true;
        } else if (is_word(list, length, "specks")) {
            wants_specks = true;
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
    truth->wants_texture = wants_texture;
    truth->wants_specks = wants_specks;
    *clip = set;
    return true;
}

/* ---- a frame ---- */

static int start(diff_truth *t, const diff_frame *frame)
{
    const float_image *a = &frame->images[0];
    file_error error;
    if (a->channels != 1 && a->channels != 3)
        return console_error(EXIT_CODE_FAILED, "pictures of %u channels have no luminance for --metrics %s; allowed: 1 or 3", a->channels,
                             t->wants_texture ? "texture" : "specks");
    t->width = a->width;
    t->height = a->height;
    t->channels = a->channels;
    for (size_t i = 0; i < frame->count; i++)
        if (!(t->luminance[i] = malloc((size_t)a->width * a->height * sizeof(float))))
            return console_error(EXIT_CODE_FAILED, "out of memory");
    if (t->wants_texture && texture_create(&t->bands, a->width, a->height, &error) != FILE_OK)
        return console_file_error(&error);
    return EXIT_CODE_OK;
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

static uint64_t count_specks(const diff_truth *t, const bool *counted, int picture, int truth)
{
    const specks_input input = {t->luminance[picture], t->luminance[truth], counted, t->width, t->height};
    return specks_count(&input);
}

/* Takes the luminances for its own: they are displayed values afterwards. */
static void add_specks(diff_truth *t, const diff_frame *frame)
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

int diff_truth_add(diff_truth *t, const diff_frame *frame)
{
    file_error error;
    t->has_second = frame->count == 3;
    if (t->has_second && noise_sums_add(&t->noise, frame->images, frame->counted, &error) != FILE_OK)
        return console_file_error(&error);
    if (!t->wants_texture && !t->wants_specks)
        return EXIT_CODE_OK;
    const float_image *a = &frame->images[0];
    const int code = t->luminance[0] ? EXIT_CODE_OK : start(t, frame);
    if (code != EXIT_CODE_OK)
        return code;
    if (a->width != t->width || a->height != t->height || a->channels != t->channels)
        return console_error(EXIT_CODE_FAILED, "a frame has %u x %u pixels of %u channel%s, the first one %u x %u of %u; they must agree", a->width, a->height,
                             a->channels, a->channels == 1 ? "" : "s", t->width, t->height, t->channels);
    for (size_t i = 0; i < frame->count; i++)
        make_luminance(t->luminance[i], &frame->images[i], t->srgb_encoded);
    const texture_input input = {t->luminance[0], {t->luminance[1], t->luminance[2]}, frame->counted};
    if (t->wants_texture)
        texture_add(t->bands, &input);
    if (t->wants_specks)
        add_specks(t, frame);
    return EXIT_CODE_OK;
}

/* ---- what was measured ---- */

typedef struct speck_figures {
    double share, reference_count, reference_share, excess, excess_share;
} speck_figures;

static speck_figures figures_of(const diff_truth *t)
{
    const double pixels = t->pixels ? (double)t->pixels : 1, mean = ((double)t->reference_specks[0] + (double)t->reference_specks[1]) / 2;
    const double excess = (double)t->specks - mean;
    return (speck_figures){(double)t->specks / pixels, mean, mean / pixels, excess, excess / pixels};
}

/* JSON has no NaN: null. */
static json_t *json_number(double number) { return isfinite(number) ? json_real(number) : json_null(); }

static json_t *specks_to_json(const diff_truth *t)
{
    const speck_figures f = figures_of(t);
    json_t *specks = json_pack("{s:I, s:I, s:f}", "count", (json_int_t)t->specks, "pixels", (json_int_t)t->pixels, "share", f.share);
    if (specks && t->has_second) {
        json_object_set_new(specks, "reference_count", json_real(f.reference_count));
        json_object_set_new(specks, "reference_share", json_real(f.reference_share));
        json_object_set_new(specks, "excess", json_real(f.excess));
        json_object_set_new(specks, "excess_share", json_real(f.excess_share));
    }
    return specks;
}

static json_t *texture_to_json(const texture *bands)
{
    const texture_summary s = texture_summarize(bands);
    json_t *list = json_array();
    for (uint32_t i = 0; i < texture_bands(bands); i++) {
        const texture_band b = texture_band_at(bands, i);
        json_array_append_new(list, json_pack("{s:I, s:I, s:o, s:o, s:o}", "row", (json_int_t)b.row, "rows", (json_int_t)b.rows, "contrast",
                                              json_number(b.contrast), "correlation", json_number(b.correlation), "mean", json_number(b.mean)));
    }
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "correlation_mean", json_number(s.correlation_mean), "correlation_least",
                     json_number(s.correlation_least), "contrast_least", json_number(s.contrast_least), "contrast_greatest", json_number(s.contrast_greatest),
                     "mean_least", json_number(s.mean_least), "mean_greatest", json_number(s.mean_greatest), "bands", list);
}

/* The report's object of that name, made where there is none. */
static json_t *object_of(json_t *report, const char *key)
{
    if (!json_object_get(report, key))
        json_object_set_new(report, key, json_object());
    return json_object_get(report, key);
}

int diff_truth_report(const diff_truth *t, json_t *report)
{
    int failed = 0;
    if (t->has_second) {
        failed |= json_object_set_new(report, "noiseless_rmse", json_number(noise_sums_rmse(&t->noise)));
        failed |= json_object_set_new(report, "noise_floor", json_number(noise_sums_floor(&t->noise)));
    }
    if (t->wants_specks)
        failed |= json_object_set_new(object_of(report, "metrics"), "specks", specks_to_json(t));
    if (t->bands && texture_bands(t->bands) == 0) {
        failed |= json_object_set_new(object_of(report, "metrics"), "texture", json_null());
        failed |= json_object_set_new(object_of(report, "unavailable"), "texture", json_string(no_bands));
    } else if (t->bands) {
        failed |= json_object_set_new(object_of(report, "metrics"), "texture", texture_to_json(t->bands));
    }
    return failed ? console_error(EXIT_CODE_FAILED, "out of memory") : EXIT_CODE_OK;
}

/* "-" for what is not defined. */
static const char *number_text(double number, char text[32])
{
    if (isfinite(number))
        snprintf(text, 32, "%.6g", number);
    else
        snprintf(text, 32, "-");
    return text;
}

static void print_texture(const texture *bands)
{
    char text[6][32];
    if (texture_bands(bands) == 0) {
        printf("%-15sunavailable: %s\n", "texture", no_bands);
        return;
    }
    const texture_summary s = texture_summarize(bands);
    printf("%-15scorrelation %s, least %s; contrast %s to %s; mean %s to %s\n", "texture", number_text(s.correlation_mean, text[0]),
           number_text(s.correlation_least, text[1]), number_text(s.contrast_least, text[2]), number_text(s.contrast_greatest, text[3]),
           number_text(s.mean_least, text[4]), number_text(s.mean_greatest, text[5]));
    printf("%7s %12s %12s %12s\n", "row", "contrast", "correlation", "mean");
    for (uint32_t i = 0; i < texture_bands(bands); i++) {
        const texture_band b = texture_band_at(bands, i);
        printf("%7" PRIu32 " %12s %12s %12s\n", b.row, number_text(b.contrast, text[0]), number_text(b.correlation, text[1]), number_text(b.mean, text[2]));
    }
}

void diff_truth_print(const diff_truth *t)
{
    if (t->has_second)
        printf("%-15s%.6g\n%-15s%.6g\n", "noiseless rmse", noise_sums_rmse(&t->noise), "noise floor", noise_sums_floor(&t->noise));
    if (t->wants_specks) {
        const speck_figures f = figures_of(t);
        printf("%-15s%" PRIu64 " of %" PRIu64 " pixels, %.6g", "specks", t->specks, t->pixels, f.share);
        if (t->has_second)
            printf("; references of each other %.6g, %.6g; excess %.6g, %.6g", f.reference_count, f.reference_share, f.excess, f.excess_share);
        putchar('\n');
    }
    if (t->bands)
        print_texture(t->bands);
}

void diff_truth_free(diff_truth *t)
{
    for (int i = 0; i < 3; i++)
        free(t->luminance[i]);
    texture_free(t->bands);
    *t = (diff_truth){.bands = NULL};
}
