/* SPDX-License-Identifier: MIT */
/* `mangata diff A B`: errors of a picture against another one, or of a series of pictures against another series, taken as one clip. */
#include <inttypes.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "cli/diff/diff_metrics.h"
#include "cli/diff/diff_prepare.h"
#include "cli/diff/diff_truth.h"
#include "cli/common/frames.h"
#include "cli/common/interrupt.h"
#include "image/image_metrics.h"
#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "cli/common/verbs.h"

enum { DIFF_PATH = sizeof(frame_path) + 64 };

typedef struct diff_request {
    console out;
    const char *paths[3], *layer; /* paths: A, B, and the second reference or NULL */
    frame_path names[3];
    bool gated, flicker;
    frame_list frames; /* empty: not given */
    double max_rmse;
    diff_metrics metrics;
    diff_prepare prepare;
    uint64_t counted; /* number of pixels that the mask has selected so far */
    truth_metrics truth;
    diff_maps maps;
    bool encoding_given, places_warned;
    uint32_t width, height, channels; /* of the first frame; 0: none was read */
} diff_request;

static int add_picture(const option *o, void *place, const char *value)
{
    diff_request *r = place;
    (void)o;
    if (r->paths[1])
        return console_error(EXIT_CODE_USAGE, "two pictures are compared; %s is one more", value);
    r->paths[r->paths[0] ? 1 : 0] = value;
    return EXIT_CODE_OK;
}

static int set_max_rmse(const option *o, void *place, const char *value)
{
    diff_request *r = place;
    r->gated = true;
    return number_parse_double(value, &r->max_rmse) && r->max_rmse >= 0 ? EXIT_CODE_OK : option_wrong(o, value, "a number from 0");
}

static int set_metrics(const option *o, void *place, const char *value)
{
    diff_request *r = place;
    if (truth_words_parse(value, &r->truth.wants, &r->metrics.wanted.metrics))
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed are %s, %s, separated by commas", o->name, value, clip_metric_words, truth_words_text);
}

static int set_encoding(const option *o, void *place, const char *value)
{
    diff_request *r = place;
    r->encoding_given = true;
    r->metrics.wanted.srgb_encoded = strcmp(value, "srgb") == 0;
    if (r->metrics.wanted.srgb_encoded || strcmp(value, "linear") == 0)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed are linear and srgb", o->name, value);
}

static int set_pixels_per_degree(const option *o, void *place, const char *value)
{
    double *number = place;
    return number_parse_double(value, number) && *number >= 4 && *number <= 400 ? EXIT_CODE_OK : option_wrong(o, value, "a number from 4 to 400");
}

static int set_glint_threshold(const option *o, void *place, const char *value)
{
    double *number = place;
    return number_parse_double(value, number) && *number > 0 ? EXIT_CODE_OK : option_wrong(o, value, "a number above 0");
}

static int set_display(const option *o, void *place, const char *value)
{
    diff_prepare *prepare = place;
    prepare->displayed = true;
    return number_parse_double(value, &prepare->exposure) && fabs(prepare->exposure) <= 100 ? EXIT_CODE_OK
                                                                                            : option_wrong(o, value, "a number of stops from -100 to 100");
}

static int set_error_top(const option *o, void *place, const char *value)
{
    double *number = place;
    return number_parse_double(value, number) && *number > 0 ? EXIT_CODE_OK : option_wrong(o, value, "a number above 0");
}

static bool is_png(const char *path) { return picture_format_of(path) == PICTURE_PNG; }

/* Checks the options of metrics, and chooses the encoding: .png files hold sRGB-encoded values, the others linear light. */
static int check_metrics(diff_request *r)
{
    if (r->flicker)
        return console_error(EXIT_CODE_USAGE, "--flicker compares differences and goes with no --metrics and no --error-map; --metrics flicker measures both");
    if (r->truth.wants.texture && !r->paths[2])
        return console_error(EXIT_CODE_USAGE, "--metrics texture needs --second-reference B2, a picture of what B shows with noise of its own");
    if (r->prepare.displayed)
        r->metrics.wanted.srgb_encoded = true;
    else if (!r->encoding_given)
        r->metrics.wanted.srgb_encoded = is_png(r->paths[1]);
    r->truth.srgb_encoded = r->metrics.wanted.srgb_encoded;
    if (!r->encoding_given && !r->prepare.displayed && is_png(r->paths[0]) != is_png(r->paths[1]))
        return console_error(EXIT_CODE_USAGE, "%s and %s hold values of unlike encoding; --encoding says how to take both", r->paths[0], r->paths[1]);
    return EXIT_CODE_OK;
}

/* Whether some picture may have layers. Files are read by their content, whatever their extension. */
static bool may_have_layers(const diff_request *r)
{
    for (size_t i = 0; i < 3 && r->paths[i]; i++)
        if (!is_png(r->paths[i]) && picture_format_of(r->paths[i]) != PICTURE_PFM)
            return true;
    return false;
}

static int check_second_reference(const diff_request *r)
{
    if (r->flicker)
        return console_error(EXIT_CODE_USAGE, "--flicker compares differences and goes with no --second-reference");
    if (strcmp(r->paths[2], r->paths[1]) == 0 || strcmp(r->paths[2], r->paths[0]) == 0)
        return console_error(EXIT_CODE_USAGE, "--second-reference %s is %s itself; a picture with noise of its own is needed", r->paths[2],
                             strcmp(r->paths[2], r->paths[1]) == 0 ? "B" : "A");
    if (r->names[2].numbered != r->names[1].numbered)
        return console_error(EXIT_CODE_USAGE, "%s and --second-reference %s: number both names or neither", r->paths[1], r->paths[2]);
    if (!r->encoding_given && !r->prepare.displayed && is_png(r->paths[1]) != is_png(r->paths[2]))
        return console_error(EXIT_CODE_USAGE, "%s and --second-reference %s hold values of unlike encoding; --encoding says how to take both", r->paths[1],
                             r->paths[2]);
    return EXIT_CODE_OK;
}

static bool measures(const diff_request *r) { return r->metrics.wanted.metrics || r->truth.wants.texture || r->truth.wants.specks; }

/* Prints the path of a picture of A, B or the second reference. */
static int print_path(const diff_request *r, size_t which, uint32_t frame, char path[DIFF_PATH])
{
    return frame_path_print(&r->names[which], frame, path, DIFF_PATH) ? EXIT_CODE_OK
                                                                      : console_error(EXIT_CODE_USAGE, "%s: the path is too long", r->paths[which]);
}

static int read_picture(const diff_request *r, size_t which, uint32_t frame, float_image *image)
{
    char path[DIFF_PATH];
    file_error error;
    const int code = print_path(r, which, frame, path);
    return code != EXIT_CODE_OK || picture_read(image, path, r->layer, &error) == FILE_OK ? code : console_file_error(&error);
}

/* A first picture that does not exist is told before the maps of many frames are looked for. */
static int check_maps(const diff_request *r)
{
    const frame_path *const inputs[DIFF_INPUTS] = {&r->names[0], &r->names[1], r->paths[2] ? &r->names[2] : NULL,
                                                   r->prepare.mask ? &r->prepare.mask_name : NULL};
    for (size_t i = 0; i < 3 && r->paths[i]; i++) {
        const uint32_t frame = frame_list_at(&r->frames, 0);
        char path[DIFF_PATH];
        float_image unused = {0};
        int code = print_path(r, i, frame, path);
        if (code == EXIT_CODE_OK && access(path, F_OK) != 0)
            code = read_picture(r, i, frame, &unused);
        float_image_free(&unused);
        if (code != EXIT_CODE_OK)
            return code;
    }
    return diff_maps_check(&r->maps, r->names[0].numbered, &r->frames, inputs);
}

static int check_request(diff_request *r)
{
    if (!r->paths[1])
        return console_error(EXIT_CODE_USAGE, "two pictures are needed: mangata diff A B");
    for (int i = 0; i < 3 && r->paths[i]; i++) {
        const char *wrong = frame_path_parse(&r->names[i], r->paths[i]);
        if (wrong)
            return console_error(EXIT_CODE_USAGE, "%s: %s", r->paths[i], wrong);
    }
    if (r->layer && !may_have_layers(r))
        return console_error(EXIT_CODE_USAGE, "--layer %s: it is for .exr alone", r->layer);
    const char *wrong = r->prepare.mask ? frame_path_parse(&r->prepare.mask_name, r->prepare.mask) : NULL;
    if (wrong)
        return console_error(EXIT_CODE_USAGE, "--mask %s: %s", r->prepare.mask, wrong);
    if (r->prepare.displayed && r->encoding_given)
        return console_error(EXIT_CODE_USAGE, "--display makes sRGB-encoded values; leave --encoding out");
    if (r->names[0].numbered != r->names[1].numbered)
        return console_error(EXIT_CODE_USAGE, "%s and %s: number both names or neither", r->paths[0], r->paths[1]);
    if (r->names[0].numbered && !r->frames.count)
        return console_error(EXIT_CODE_USAGE, "numbered names need --frames, such as --frames 0-59");
    if (!r->names[0].numbered && r->frames.count)
        return console_error(EXIT_CODE_USAGE, "--frames needs numbered names, such as frame_%%04d.pfm%s",
                             frame_path_folder_is_marked(&r->names[0]) ? "; a frame number is allowed in the file's name alone" : "");
    if (!r->frames.count)
        frame_list_span(&r->frames, 0, 0);
    if (r->flicker && frame_list_length(&r->frames) < 2)
        return console_error(EXIT_CODE_USAGE, "--flicker needs numbered names and at least two frames");
    int code = r->paths[2] ? check_second_reference(r) : EXIT_CODE_OK;
    if (code == EXIT_CODE_OK && r->maps.wanted)
        code = check_maps(r);
    r->metrics.wanted.metrics |= diff_maps_metrics(&r->maps);
    return code == EXIT_CODE_OK && measures(r) ? check_metrics(r) : code;
}

/* Warns of options that no metric or map reads. */
static void warn_of_options(const diff_request *r)
{
    const uint32_t metrics = r->metrics.wanted.metrics;
    const struct {
        const char *name, *reader;
        bool given, read;
    } options[] = {
        {"pixels-per-degree", "--metrics or --error-map flip and hdr-flip", r->metrics.wanted.pixels_per_degree > 0,
         metrics & (1u << CLIP_FLIP | 1u << CLIP_HDR_FLIP)},
        {"glint-threshold", "--metrics flicker-bright, flicker-glints and flicker-sizes", r->metrics.wanted.glint_threshold > 0,
         metrics & (1u << CLIP_FLICKER_BRIGHT | 1u << CLIP_FLICKER_GLINTS | 1u << CLIP_FLICKER_SIZES)},
        {"encoding", "--metrics, --error-map and --second-reference", r->encoding_given, measures(r) || r->paths[2]},
        {"error-top", ".png maps of rmse, relrmse and flicker", r->maps.top > 0, diff_maps_show_top(&r->maps)},
        {"overwrite", "--error-map", r->maps.overwrite, r->maps.wanted},
    };
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++)
        if (options[i].given && !options[i].read)
            console_note(&r->out, "mangata: warning: --%s does nothing here; it is for %s", options[i].name, options[i].reader);
}

/* PNG hold encoded values of colour, the other formats linear light. Fractions such as coverage are the same in all. */
static void warn_of_encoding(const diff_request *r)
{
    for (size_t i = 1; i < 3 && r->paths[i]; i++)
        if (is_png(r->paths[i]) != is_png(r->paths[0]))
            console_note(&r->out,
                         "mangata: warning: %s and %s are compared as they are stored, sRGB-encoded against linear if they are colours; "
                         "compare two .png, or two .exr or .pfm with --display EV",
                         r->paths[0], r->paths[i]);
}

/* The frames of a clip have one size, and metrics take grey and colours. */
static int check_clip(diff_request *r, uint32_t number, const float_image *image)
{
    char path[DIFF_PATH];
    const int code = print_path(r, 0, number, path);
    if (code != EXIT_CODE_OK)
        return code;
    if (measures(r) && image->channels != 1 && image->channels != 3)
        return console_error(EXIT_CODE_BAD_INPUT, "%s: it has %u channels; --metrics and --error-map take pictures of 1 or 3%s", path, image->channels,
                             may_have_layers(r) ? ", such as a --layer has" : "");
    if (!r->channels) {
        r->width = image->width;
        r->height = image->height;
        r->channels = image->channels;
    }
    if (image->width == r->width && image->height == r->height && image->channels == r->channels)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_FAILED, "%s has %u x %u pixels of %u channel%s, the first frame %u x %u of %u; the frames of a clip must agree", path,
                         image->width, image->height, image->channels, image->channels == 1 ? "" : "s", r->width, r->height, r->channels);
}

/* Crops of an EXR lie at their places, but are compared pixel by pixel. */
static void warn_of_places(diff_request *r, uint32_t number)
{
    char paths[3][DIFF_PATH];
    int32_t place[3][2];
    for (size_t i = 0; i < 3 && r->paths[i] && !r->places_warned; i++) {
        if (!frame_path_print(&r->names[i], number, paths[i], DIFF_PATH) || !picture_origin(paths[i], place[i]))
            return;
        r->places_warned = place[i][0] != place[0][0] || place[i][1] != place[0][1];
        if (r->places_warned)
            console_note(&r->out, "mangata: warning: %s lies at %d,%d of its whole picture, %s at %d,%d; they are compared as if they lay at one place",
                         paths[0], (int)place[0][0], (int)place[0][1], paths[i], (int)place[i][0], (int)place[i][1]);
    }
}

static int read_frame(diff_request *r, uint32_t number, diff_frame *frame)
{
    const float_image *a = &frame->images[0];
    for (size_t i = 0; i < frame->count; i++) {
        const int code = read_picture(r, i, number, &frame->images[i]);
        if (code != EXIT_CODE_OK)
            return code;
    }
    for (size_t i = 1; i < frame->count; i++) {
        const float_image *b = &frame->images[i];
        if (a->width != b->width || a->height != b->height || a->channels != b->channels)
            return console_error(EXIT_CODE_FAILED, "%s has %u x %u pixels of %u channel%s, %s has %u x %u of %u; they must agree", r->paths[0], a->width,
                                 a->height, a->channels, a->channels == 1 ? "" : "s", r->paths[i], b->width, b->height, b->channels);
    }
    warn_of_places(r, number);
    return check_clip(r, number, a);
}

/* Sets the images of A and B to next − image. Steps from or to an infinity that both pictures have are equal. */
static void to_difference(float_image images[2], const float_image next[2])
{
    const size_t count = (size_t)images[0].width * images[0].height * images[0].channels;
    for (size_t i = 0; i < count; i++) {
        float *a = &images[0].pixels[i], *b = &images[1].pixels[i];
        const float next_a = next[0].pixels[i], next_b = next[1].pixels[i];
        const bool comparable = image_values_comparable(*a, *b) && image_values_comparable(next_a, next_b);
        const bool finite = isfinite(*a) && isfinite(*b) && isfinite(next_a) && isfinite(next_b);
        *a = finite ? next_a - *a : comparable ? INFINITY : NAN;
        *b = finite ? next_b - *b : INFINITY;
    }
}

static int add_frame(const diff_request *r, const float_image pair[2], float_image previous[2], image_metrics *metrics)
{
    file_error error;
    if (!r->flicker)
        return image_metrics_add(metrics, &pair[0], &pair[1], &error) == FILE_OK ? EXIT_CODE_OK : console_file_error(&error);
    if (!previous[0].pixels)
        return EXIT_CODE_OK;
    to_difference(previous, pair);
    return image_metrics_add(metrics, &previous[0], &previous[1], &error) == FILE_OK ? EXIT_CODE_OK : console_file_error(&error);
}

/* Counts the pixels of frame `place` of the list that the mask selects. A mask of none in any frame would make all pictures alike. */
static int count_pixels(diff_request *r, uint64_t place, const diff_frame *frame)
{
    r->counted += (uint64_t)frame->images[0].width * frame->images[0].height - frame->left_out;
    if (r->counted > 0 || place + 1 < frame_list_length(&r->frames))
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_BAD_INPUT, "%s: this mask selects no pixel; those of at least 0.999 are compared", r->prepare.mask);
}

static int measure_frame(diff_request *r, uint64_t place, diff_frame *frame, float_image previous[2], image_metrics *metrics)
{
    const uint32_t number = frame_list_at(&r->frames, place);
    const uint64_t before = metrics->frames;
    int code = read_frame(r, number, frame);
    if (code == EXIT_CODE_OK)
        code = diff_prepare_frame(&r->prepare, number, frame);
    if (code == EXIT_CODE_OK && r->prepare.mask)
        code = count_pixels(r, place, frame);
    if (code == EXIT_CODE_OK)
        code = add_frame(r, frame->images, previous, metrics);
    if (code == EXIT_CODE_OK && metrics->frames > before)
        metrics->values -= frame->left_out * frame->images[0].channels; /* these are black in both, so they add nothing to the sums */
    if (code == EXIT_CODE_OK)
        code = diff_metrics_add(&r->metrics, number, frame, &r->maps);
    if (code == EXIT_CODE_OK)
        code = diff_truth_add(&r->truth, frame);
    return code;
}

static int stopped(void) { return console_error(interrupt_exit_code(), "stopped by a signal"); }

static int measure(diff_request *r, image_metrics *metrics)
{
    float_image previous[2] = {{0}};
    int code = EXIT_CODE_OK;
    const uint64_t count = frame_list_length(&r->frames);
    for (uint64_t i = 0; i < count && code == EXIT_CODE_OK; i++) {
        diff_frame frame = {.count = r->paths[2] ? 3 : 2};
        code = *interrupt_flag() ? stopped() : measure_frame(r, i, &frame, previous, metrics);
        for (int k = 0; k < 2; k++) { /* the difference from the next frame needs these pictures */
            float_image_free(&previous[k]);
            previous[k] = frame.images[k];
            frame.images[k] = (float_image){0};
        }
        diff_frame_free(&frame);
    }
    for (int k = 0; k < 2; k++)
        float_image_free(&previous[k]);
    /* A terminal's signal has ended idiff too, so that the last frame may lack its score. */
    return code == EXIT_CODE_OK && *interrupt_flag() ? stopped() : code;
}

/* A JSON number, or null for NaN and infinities, which JSON does not have. */
static json_t *json_number(double number) { return isfinite(number) ? json_real(number) : json_null(); }

static void print_score(const char *name, double score, double floor)
{
    printf("%-15s%.6g", name, score);
    if (isfinite(floor))
        printf("; noise floor %.6g", floor);
    putchar('\n');
}

static int print_report(diff_request *r, const image_metrics *m)
{
    const double rmse = image_metrics_rmse(m), relative = image_metrics_relative_rmse(m), ratio = image_metrics_mean_ratio(m);
    const uint32_t frame = frame_list_at(&r->frames, m->max_frame + (r->flicker ? 1 : 0));
    if (r->out.json) {
        json_t *report =
            json_pack("{s:o, s:o, s:b, s:I, s:I, s:o, s:o, s:o, s:o, s:o, s:{s:o, s:I, s:i, s:i, s:i}, s:I, s:I}", "a", console_json_text(r->paths[0]), "b",
                      console_json_text(r->paths[1]), "flicker", r->flicker, "frames", (json_int_t)m->frames, "values", (json_int_t)m->values, "rmse",
                      json_number(rmse), "relative_rmse", json_number(relative), "mean_ratio", json_number(ratio), "mean_a",
                      json_number(m->values ? m->sum_a / (double)m->values : 0), "mean_b", json_number(m->values ? m->sum_b / (double)m->values : 0), "maximum",
                      "difference", json_number(m->max_difference), "frame", (json_int_t)frame, "x", (int)m->max_x, "y", (int)m->max_y, "channel",
                      (int)m->max_channel, "equal_infinities", (json_int_t)m->equal_infinities, "mismatches", (json_int_t)m->mismatches);
        if (report && r->gated)
            json_object_set_new(report, "max_rmse", json_real(r->max_rmse));
        if (report && r->maps.files)
            json_object_set(report, "error_maps", r->maps.files);
        if (report && r->paths[2])
            json_object_set_new(report, "second_reference", console_json_text(r->paths[2]));
        int code = report ? diff_metrics_report(&r->metrics, report) : EXIT_CODE_OK;
        if (report && code == EXIT_CODE_OK)
            code = diff_truth_report(&r->truth, report);
        if (code != EXIT_CODE_OK) {
            json_decref(report);
            return code;
        }
        return console_print_json(report);
    }
    printf("%-15s%" PRIu64 "\n", r->flicker ? "frame steps" : "frames", m->frames);
    printf("%-15s%.6g\n", r->flicker ? "flicker" : "rmse", rmse);
    print_score("relative rmse", relative, diff_metrics_floor(&r->metrics, CLIP_RELATIVE_RMSE));
    print_score("mean ratio", ratio, diff_metrics_floor(&r->metrics, CLIP_ENERGY));
    printf("%-15s%.6g at x %u, y %u, channel %u", "maximum", m->max_difference, m->max_x, m->max_y, m->max_channel);
    if (r->names[0].numbered)
        printf(", frame %u", frame);
    putchar('\n');
    if (m->mismatches)
        printf("%-15s%" PRIu64 " values are %s\n", "mismatches", m->mismatches, image_mismatch_text);
    const int code = diff_metrics_print(&r->metrics);
    if (code == EXIT_CODE_OK)
        diff_truth_print(&r->truth);
    return code;
}

static int check_limit(const diff_request *r, const image_metrics *metrics)
{
    const double rmse = image_metrics_rmse(metrics);
    if (metrics->mismatches > 0)
        return console_error(EXIT_CODE_DIFFERENT, "%s against %s: %" PRIu64 " values are %s, so no limit is kept", r->paths[0], r->paths[1],
                             metrics->mismatches, image_mismatch_text);
    if (!(rmse <= r->max_rmse))
        return console_error(EXIT_CODE_DIFFERENT, "%s against %s: RMSE %g is above %g", r->paths[0], r->paths[1], rmse, r->max_rmse);
    return EXIT_CODE_OK;
}

static int run(void *request)
{
    diff_request *r = request;
    int code;
    image_metrics metrics = {0};
    if ((code = check_request(r)) != EXIT_CODE_OK)
        return code;
    if (r->maps.wanted || r->metrics.wanted.metrics & 1u << CLIP_YEE)
        interrupt_install(); /* so that no file is left incomplete, nor idiff's temporary ones */
    if ((code = measure(r, &metrics)) != EXIT_CODE_OK)
        return code;
    warn_of_encoding(r);
    warn_of_options(r);
    if (!(r->out.quiet && !r->out.json) && (code = print_report(r, &metrics)) != EXIT_CODE_OK)
        return code;
    return r->gated ? check_limit(r, &metrics) : EXIT_CODE_OK;
}

static const option diff_options[] = {
    {"frames", 0, "LIST", "frames to compare when A and B are numbered names", .set = option_frames, .offset = offsetof(diff_request, frames)},
    {"layer", 0, "NAME", "layer of .exr pictures (default color, or the only one)", .set = option_text, .offset = offsetof(diff_request, layer)},
    {"max-rmse", 0, "X", "exit with 2 when the RMSE is above X or values are not comparable", .set = set_max_rmse},
    {"flicker", 0, NULL,
     "compare the differences from frame to frame: the RMS of\n"
     "(A[n+1] - A[n]) - (B[n+1] - B[n])",
     .set = option_given, .offset = offsetof(diff_request, flicker)},
    {"metrics", 0, "LIST",
     "also measure: flip, hdr-flip, ssim, yee (by idiff), flicker, and rmse,\n"
     "relrmse, energy, which are always there; B is the reference; texture\n"
     "(needs --second-reference): contrast, correlation and mean of bands of\n"
     "ten rows; specks: pixels unlike all that B shows around them",
     .set = set_metrics},
    {"encoding", 0, "E", "of the values, for --metrics: linear or srgb (default srgb for .png)", .set = set_encoding},
    {"pixels-per-degree", 0, "X", "of the viewer's eye, for FLIP, 4 to 400 (default 67.0206)", .set = set_pixels_per_degree,
     .offset = offsetof(diff_request, metrics.wanted.pixels_per_degree)},
    {"glint-threshold", 0, "X",
     "luminance above which a pixel is a glint, for flicker (default:\n"
     "half of what a thousandth of B's first frame exceed)",
     .set = set_glint_threshold, .offset = offsetof(diff_request, metrics.wanted.glint_threshold)},
    {"display", 0, "EV",
     "first make displayed values of linear light: times 2^EV, clamped,\n"
     "sRGB-encoded, 0 to 1",
     .set = set_display, .offset = offsetof(diff_request, prepare)},
    {"mask", 0, "M",
     "count only the pixels that are 1 in this picture of one channel\n"
     "(or clip of such); the others are black in A and B",
     .set = option_text, .offset = offsetof(diff_request, prepare.mask)},
    {"second-reference", 0, "B2",
     "a picture (or clip) of what B shows with noise of its own, of B's size:\n"
     "takes the references' noise off the RMSE; for texture and specks too,\n"
     "and gives the noise floor of every metric",
     .set = option_text, .offset = offsetof(diff_request, paths[2])},
    {"error-map", 0, "METRIC=FILE",
     "writes the error of each pixel by rmse, relrmse, flip, hdr-flip, ssim\n"
     "or flicker, which is measured: a .png in colours from black to pale\n"
     "yellow, or .exr or .pfm with the values; repeat it for more metrics",
     .set = option_error_map, .offset = offsetof(diff_request, maps)},
    {"error-top", 0, "X", "what the brightest colour of a .png map of rmse, relrmse or flicker\nstands for (default 1)", .set = set_error_top,
     .offset = offsetof(diff_request, maps.top)},
    {"overwrite", 0, NULL, "replace existing maps", .set = option_given, .offset = offsetof(diff_request, maps.overwrite)},
};

static const option_table diff_table = {"diff",
                                        "A B [options]",
                                        "Measures how far A is from B (.png, .exr, .pfm): RMSE, relative RMSE (by the RMS of B),\n"
                                        "mean ratio (A / B) and the largest difference, over whole pictures. Numbered names\n"
                                        "(frame_%04d.pfm or frame_####.pfm) are read as clips and scored together.",
                                        diff_options,
                                        sizeof diff_options / sizeof diff_options[0],
                                        .notes = "exit codes: 0 done, 1 sizes or channels differ, 2 above --max-rmse, 64 usage, 65 bad picture,\n"
                                                 "66 no such picture, 73 cannot write, 129, 130 and 143 stopped by a signal",
                                        .operand = {.set = add_picture},
                                        .run = run};

int verb_diff(int count, char **arguments)
{
    diff_request request = {.out = {0}};
    const int code = options_run(&diff_table, &request, count, arguments);
    diff_metrics_free(&request.metrics);
    truth_metrics_free(&request.truth);
    diff_maps_free(&request.maps);
    return code;
}
