/* SPDX-License-Identifier: MIT */
/* Scores every picture against the reference: coverage, and displayed colour at several exposures. */
#include <math.h>
#include <stdlib.h>

#include "cli/figures/figures_job.h"
#include "image/image_metrics.h"

/* A frame of a picture: coverage, and displayed RGBA at each exposure. */
typedef struct scored_frame {
    float_image coverage;
    uint8_t *displayed[FIGURE_EXPOSURES];
} scored_frame;

/* Sums of a method over the frames of a scene. */
typedef struct scored_clip {
    image_metrics coverage;
    double squares[FIGURE_EXPOSURES]; /* sums of squared displayed differences */
    double half[2], excess[2];        /* the same at FIGURE_SHOWN above and below the middle row; of values that are too bright there */
    double values;                    /* number of displayed values */
} scored_clip;

static void free_frame(scored_frame *frame)
{
    float_image_free(&frame->coverage);
    for (int i = 0; i < FIGURE_EXPOSURES; i++)
        free(frame->displayed[i]);
}

static int read_frame(figures_job *f, size_t scene, size_t picture, size_t frame, scored_frame *out)
{
    char path[COMPARE_PATH];
    file_error error;
    *out = (scored_frame){.coverage = {0}};
    if (!compare_picture_path(f->compare, &f->compare->scenes[scene], picture, frame, path))
        return EXIT_CODE_USAGE;
    if (picture_read(&out->coverage, path, "coverage", &error) != FILE_OK)
        return compare_file_failure(f->compare, &error);
    int code = EXIT_CODE_OK;
    for (int i = 0; i < FIGURE_EXPOSURES && code == EXIT_CODE_OK; i++)
        code = figures_display(f->compare, scene, picture, frame, figure_stops[i], &out->displayed[i]);
    return code;
}

static int add_method(figures_job *f, size_t scene, size_t picture, size_t frame, const scored_frame *reference, scored_clip *clip)
{
    scored_frame own;
    file_error error;
    int code = read_frame(f, scene, picture, frame, &own);
    if (code == EXIT_CODE_OK && image_metrics_add(&clip->coverage, &own.coverage, &reference->coverage, &error) != FILE_OK)
        code = compare_file_failure(f->compare, &error);
    if (code == EXIT_CODE_OK) {
        const size_t row = 4 * (size_t)own.coverage.width, rows = own.coverage.height;
        for (int i = 0; i < FIGURE_EXPOSURES; i++)
            for (size_t p = 0; p < row * rows; p++) {
                const double difference = ((double)own.displayed[i][p] - reference->displayed[i][p]) / 255;
                const double square = p % 4 < 3 ? difference * difference : 0;
                const bool below = p / row >= rows / 2;
                clip->squares[i] += square;
                clip->half[below] += i == FIGURE_SHOWN ? square : 0;
                clip->excess[below] += i == FIGURE_SHOWN && difference > 0 ? square : 0;
            }
        clip->values += 0.75 * (double)(row * rows);
    }
    free_frame(&own);
    return code;
}

static void measure_scene(figures_job *f, size_t scene)
{
    scored_clip clips[FIGURE_METHODS] = {{.values = 0}};
    for (size_t frame = 0; frame < f->compare->frame_count && figures_good(f); frame++) {
        scored_frame reference;
        f->code = read_frame(f, scene, COMPARE_REFERENCE, frame, &reference);
        for (int m = 0; m < FIGURE_METHODS && figures_good(f); m++)
            if (f->picture[m]) {
                f->code = add_method(f, scene, f->picture[m], frame, &reference, &clips[m]);
                figures_step(f);
            }
        free_frame(&reference);
    }
    for (int m = 0; m < FIGURE_METHODS; m++) {
        figure_score *score = &f->scores[scene][m];
        score->rmse = f->picture[m] ? image_metrics_rmse(&clips[m].coverage) : NAN;
        score->kept = f->picture[m] ? image_metrics_mean_ratio(&clips[m].coverage) : NAN;
        for (int i = 0; i < FIGURE_EXPOSURES; i++)
            score->displayed[i] = sqrt(clips[m].squares[i] / clips[m].values);
        for (int i = 0; i < 2; i++) {
            score->half[i] = sqrt(2 * clips[m].half[i] / clips[m].values);
            score->excess[i] = clips[m].half[i] > 0 ? clips[m].excess[i] / clips[m].half[i] : 0;
        }
    }
}

void figures_measure(figures_job *f)
{
    figures_steps(f, FIGURE_SCENES * f->compare->frame_count * f->renders.method_count);
    for (size_t scene = 0; scene < FIGURE_SCENES && figures_good(f); scene++)
        measure_scene(f, scene);
    progress_clear(&f->compare->progress);
}
