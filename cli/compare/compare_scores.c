/* SPDX-License-Identifier: MIT */
/* The columns, their scores, and the best methods. */
#include "cli/compare/compare_scores.h"

#include <math.h>
#include <stdlib.h>

#include "cli/common/memory_text.h"

const score_column score_columns[] = {
    {KIND_COVERAGE, CLIP_RMSE, "coverage.rmse", "RMSE", "coverage: root mean square of the error, whole frames", 0, true},
    {KIND_COVERAGE, CLIP_RELATIVE_RMSE, "coverage.relrmse", "relative RMSE", "coverage: RMSE over the root mean square of the reference", 0, true},
    {KIND_COVERAGE, CLIP_ENERGY, "coverage.energy", "energy", "coverage: mean over the reference's mean; 1 is right", 1, true},
    {KIND_COVERAGE, CLIP_FLICKER, "coverage.flicker", "flicker",
     "coverage: root mean square of the difference between the method's frame steps and the reference's", 0, true},
    {KIND_COVERAGE, CLIP_FLICKER_POWER, "coverage.flicker-power", "flicker power", "coverage: mean over pixels of the difference of temporal power", 0, false},
    {KIND_COVERAGE, CLIP_FLICKER_RATIO, "coverage.flicker-ratio", "flicker ratio",
     "coverage: temporal power over the reference's; below 1 too calm, above 1 too restless", 1, true},
    {KIND_COVERAGE, CLIP_FLICKER_BRIGHT, "coverage.flicker-bright", "bright pixels",
     "coverage: distance of the histograms over frames of how many pixels are bright", 0, false},
    {KIND_COVERAGE, CLIP_FLICKER_GLINTS, "coverage.flicker-glints", "glints", "coverage: distance of the histograms over frames of how many glints there are",
     0, false},
    {KIND_COVERAGE, CLIP_FLICKER_SIZES, "coverage.flicker-sizes", "glint sizes", "coverage: distance of the histograms of the glints' sizes", 0, false},
    {KIND_DISPLAYED, CLIP_RMSE, "displayed.rmse", "displayed RMSE", "displayed colour (sRGB, 0 to 1): root mean square of the error", 0, true},
    {KIND_DISPLAYED, CLIP_FLIP, "displayed.flip", "FLIP", "displayed colour: mean FLIP, 0 to 1", 0, true},
    {KIND_LIGHT, CLIP_HDR_FLIP, "light.hdr-flip", "HDR-FLIP", "scene-linear colour: mean HDR-FLIP, 0 to 1", 0, true},
    {KIND_DISPLAYED, CLIP_SSIM, "displayed.ssim", "SSIM", "displayed colour: mean structural similarity; 1 is equal", 1, false},
    {KIND_DISPLAYED, CLIP_YEE, "displayed.yee", "Yee",
     "displayed colour: share of pixels that fail Yee's perceptual test by idiff, which minds hue more than brightness", 0, false},
    {KIND_DISPLAYED, CLIP_FLICKER, "displayed.flicker", "displayed flicker", "displayed colour: flicker as above", 0, false},
    {KIND_LIGHT, TRUTH_CORRELATION, "light.texture-correlation", "texture",
     "scene-linear luminance: correlation with the truth along rows, freed of the reference's noise; mean over bands of ten rows; 1 is right", 1, true},
    {KIND_LIGHT, TRUTH_CORRELATION_LEAST, "light.texture-correlation-least", "least texture", "the same: the least of the bands", 1, false},
    {KIND_LIGHT, TRUTH_CONTRAST_LEAST, "light.texture-contrast-least", "least contrast",
     "scene-linear luminance: contrast along rows over the truth's, the least of bands of ten rows; below 1 too smooth", 1, false},
    {KIND_LIGHT, TRUTH_CONTRAST_GREATEST, "light.texture-contrast-greatest", "greatest contrast", "the same: the greatest; above 1 too rough", 1, false},
    {KIND_LIGHT, TRUTH_MEAN_LEAST, "light.texture-mean-least", "least mean", "scene-linear luminance: mean over the truth's, the least of bands of ten rows", 1,
     false},
    {KIND_LIGHT, TRUTH_MEAN_GREATEST, "light.texture-mean-greatest", "greatest mean", "the same: the greatest", 1, false},
    {KIND_DISPLAYED, TRUTH_SPECKS, "displayed.specks", "specks",
     "displayed colour: share of pixels unlike all that the reference shows around them, beyond what its halves show of each other", 0, true},
};
const size_t score_column_count = sizeof score_columns / sizeof score_columns[0];

bool score_wanted(const compare_request *request, const score_column *column)
{
    if (column->metric >= CLIP_METRICS)
        return request->halved && (column->metric == TRUTH_SPECKS ? request->truth.specks : request->truth.texture);
    const bool flicker = (CLIP_ALL_FLICKER >> column->metric & 1) != 0;
    return (request->metrics >> column->metric & 1) && !(flicker && frame_list_length(&request->frames) < 2);
}

double score_of(const compare_result *result, const score_column *column)
{
    return column->metric >= CLIP_METRICS ? result->truth[column->metric - CLIP_METRICS] : result->clip[column->kind].values[column->metric];
}

double score_of_frame(const compare_result *result, const score_column *column, size_t frame)
{
    return column->metric >= CLIP_METRICS ? NAN : result->frames[column->kind][frame].values[column->metric];
}

const char *score_missing(const compare_job *job, const score_column *column)
{
    for (size_t s = 0; s < job->request->scene_count; s++)
        for (size_t m = 0; m < job->request->method_count; m++)
            if (!isnan(score_of(&job->scenes[s].results[m], column)))
                return NULL;
    const char *why = job->missing[column->kind][column->metric];
    return why[0] ? why : "it is not defined here";
}

double score_mean(const compare_job *job, size_t method, const score_column *column)
{
    double sum = 0;
    for (size_t s = 0; s < job->request->scene_count; s++)
        sum += score_of(&job->scenes[s].results[method], column);
    return sum / (double)job->request->scene_count;
}

static double noise_of_scene(const compare_job *job, const compare_scene *scene, const score_column *column)
{
    double most = NAN;
    if (column->metric < CLIP_METRICS)
        return scene->noise[column->kind].values[column->metric];
    for (size_t m = 0; m < job->request->method_count; m++)
        most = fmax(most, scene->results[m].truth_noise[column->metric - CLIP_METRICS]);
    return most;
}

double score_noise(const compare_job *job, const compare_scene *scene, const score_column *column)
{
    double sum = 0;
    if (scene)
        return noise_of_scene(job, scene, column);
    for (size_t s = 0; s < job->request->scene_count; s++)
        sum += noise_of_scene(job, &job->scenes[s], column);
    return sum / (double)job->request->scene_count;
}

number_text score_noise_text(double noise) { return number_print_measured(noise, 0.1 * noise); }

/* Distance of a method's score from the best value; infinity: it has no score. */
static double distance(const compare_job *job, const compare_scene *scene, size_t method, const score_column *column)
{
    const double score = scene ? score_of(&scene->results[method], column) : score_mean(job, method, column);
    return isfinite(score) ? fabs(score - column->best) : INFINITY;
}

/* The two methods nearest to the best value, and the difference of their distances from it. -1: fewer methods have a score. */
typedef struct leaders {
    int first, second;
    double lead;
} leaders;

static leaders leaders_of(const compare_job *job, const compare_scene *scene, const score_column *column)
{
    double least = INFINITY, next = INFINITY;
    leaders found = {-1, -1, 0};
    for (size_t m = 0; m < job->request->method_count; m++) {
        const double own = distance(job, scene, m, column);
        if (own < least) {
            found.second = found.first;
            next = least;
            found.first = (int)m;
            least = own;
        } else if (own < next) {
            found.second = (int)m;
            next = own;
        }
    }
    found.lead = found.second < 0 ? 0 : next - least;
    return found;
}

/* Whether a lead is greater than the noise floor. */
static bool leads(const compare_job *job, const compare_scene *scene, const score_column *column, double lead)
{
    const double noise = score_noise(job, scene, column);
    return lead > (isfinite(noise) ? noise : 0);
}

/* Whether the reference of the scene, or of some scene, shows nothing in the column's kind of picture. */
static bool is_black(const compare_job *job, const compare_scene *scene, const score_column *column)
{
    bool black = scene && scene->black[column->kind];
    for (size_t s = 0; !scene && s < job->request->scene_count; s++)
        black |= job->scenes[s].black[column->kind];
    return black;
}

int score_winner(const compare_job *job, const compare_scene *scene, const score_column *column)
{
    const leaders found = leaders_of(job, scene, column);
    if (found.second < 0 || is_black(job, scene, column))
        return -1;
    return leads(job, scene, column, found.lead) ? found.first : -1;
}

/* Whether there is no winner, although at least two methods have a score. */
static bool score_tied(const compare_job *job, const compare_scene *scene, const score_column *column)
{
    const leaders found = leaders_of(job, scene, column);
    return found.second >= 0 && !is_black(job, scene, column) && !leads(job, scene, column, found.lead);
}

/* Writes the columns with ties as "simple (RMSE, FLIP)". Returns their number. */
static size_t put_ties(FILE *stream, const compare_job *job, const compare_scene *scene, bool main_alone, size_t before)
{
    size_t count = 0;
    for (size_t c = 0; c < score_column_count; c++) {
        const score_column *column = &score_columns[c];
        if (!score_wanted(job->request, column) || (main_alone && !column->main) || !score_tied(job, scene, column))
            continue;
        if (count++ == 0)
            fprintf(stream, "%s%s (%s", before ? ", " : "", scene ? scene->name : "mean", column->title);
        else
            fprintf(stream, ", %s", column->title);
    }
    if (count)
        putc(')', stream);
    return count;
}

/* Writes the scenes whose reference is black in some kind of picture that is scored, as "simple (coverage)". Returns their number. */
static size_t put_black(FILE *stream, const compare_job *job)
{
    static const char *const names[COMPARE_KINDS] = {[KIND_COVERAGE] = "coverage", [KIND_DISPLAYED] = "displayed colour", [KIND_LIGHT] = "light"};
    size_t count = 0;
    for (size_t s = 0; s < job->request->scene_count; s++)
        for (int kind = 0; kind < COMPARE_KINDS; kind++) {
            bool scored = false;
            for (size_t c = 0; c < score_column_count; c++)
                scored |= (int)score_columns[c].kind == kind && score_wanted(job->request, &score_columns[c]);
            if (scored && job->scenes[s].black[kind])
                fprintf(stream, "%s%s (%s)", count++ ? ", " : "", job->scenes[s].name, names[kind]);
        }
    return count;
}

char *score_black_text(const compare_job *job)
{
    char *text = NULL, *places = NULL;
    size_t size = 0, count = 0;
    FILE *stream = open_memstream(&places, &size);
    if (!stream)
        return NULL;
    count = put_black(stream, job);
    if (memory_text_finish(stream, &places) && (stream = open_memstream(&text, &size))) {
        if (count)
            fprintf(stream, "The reference shows no light, so no best is marked: %s.", places);
        text = memory_text_finish(stream, &text);
    }
    free(places);
    return text;
}

char *score_ties_text(const compare_job *job, bool main_alone)
{
    const compare_request *r = job->request;
    char *places = NULL, *text = NULL;
    size_t size = 0, count = 0;
    FILE *stream = open_memstream(&places, &size);
    if (!stream)
        return NULL;
    for (size_t s = 0; s < r->scene_count; s++)
        count += put_ties(stream, job, &job->scenes[s], main_alone, count);
    if (r->scene_count > 1 && !main_alone)
        count += put_ties(stream, job, NULL, main_alone, count);
    if (memory_text_finish(stream, &places) && (stream = open_memstream(&text, &size))) {
        if (count)
            fprintf(stream, "No best is marked where the two that lead differ by no more than the noise floor: %s.", places);
        text = memory_text_finish(stream, &text);
    }
    free(places);
    return text;
}

char *score_mismatches_text(const compare_job *job, size_t method)
{
    enum { LISTED = 4 };
    char *text = NULL, path[COMPARE_PATH];
    size_t size = 0, files = 0;
    FILE *stream = open_memstream(&text, &size);
    if (!stream)
        return NULL;
    for (size_t s = 0; s < job->request->scene_count; s++)
        for (size_t f = 0; f < job->frame_count; f++) {
            const uint64_t count = job->scenes[s].results[method].mismatches[f];
            if (count == 0 || files++ >= LISTED || !compare_picture_path(job, &job->scenes[s], method + 1, f, path))
                continue;
            if (files == 1)
                fprintf(stream, "%s: values that are infinite or not a number in one picture only: ", job->request->methods[method].name);
            fprintf(stream, "%s%s (%llu)", files > 1 ? ", " : "", path, (unsigned long long)count);
        }
    if (files > LISTED)
        fprintf(stream, " and %zu more files", files - LISTED);
    return memory_text_finish(stream, &text);
}

double score_pooled(const compare_job *job, size_t method, const score_column *column)
{
    double sum = 0;
    for (size_t s = 0; s < job->request->scene_count; s++) {
        const double score = score_of(&job->scenes[s].results[method], column);
        sum += score * score;
    }
    return sqrt(sum / (double)job->request->scene_count);
}
