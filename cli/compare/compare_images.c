/* SPDX-License-Identifier: MIT */
/* The pictures of a comparison: an EXR file with coverage and colour for each scene, method and frame. A file with the right render hash is kept. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "image/file_whole.h"
#include "cli/compare/compare_external.h"
#include "cli/compare/compare_tables.h"
#include "cli/common/interrupt.h"
#include "params/methods.h"
#include "cli/render/render_frame.h"
#include "cli/render/render_record.h"

static const char seconds_key[] = "render_seconds";

/* The request of the `mangata render` that would make the same file. */
static render_request picture_request(const compare_job *job, const compare_scene *scene, size_t picture)
{
    render_request request = {.scene_path = scene->path,
                              .format = PICTURE_EXR,
                              .quality = *compare_picture_quality(scene, picture),
                              .layers = {MGT_LAYER_COLOR, MGT_LAYER_COVERAGE},
                              .layer_count = 2};
    for (size_t i = 0; i < job->request->layer_count; i++)
        request.layers[request.layer_count++] = job->request->layers[i];
    return request;
}

static bool is_halved(const compare_job *job, size_t picture) { return picture == COMPARE_REFERENCE && job->request->halved; }

static int hash_render(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, sha256_text *hash)
{
    const render_request request = picture_request(job, scene, picture);
    const mgt_image image = {.width = scene->width, .height = scene->height, .crop_width = scene->width, .crop_height = scene->height};
    char number[16];
    snprintf(number, sizeof number, "%u", compare_frame_number(job, frame));
    return render_hash(&request, scene->canonical, &image, &job->info, number, hash) ? EXIT_CODE_OK : console_error(EXIT_CODE_FAILED, "out of memory");
}

/* The hash of a picture. That of a reference of two halves follows from their hashes. */
static int hash_picture(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, sha256_text *hash)
{
    sha256_text halves[2];
    char text[2 * sizeof halves[0].text + 16];
    if (!is_halved(job, picture))
        return hash_render(job, scene, picture, frame, hash);
    for (size_t half = 0; half < 2; half++) {
        const int code = hash_render(job, scene, COMPARE_HALF + half, frame, &halves[half]);
        if (code != EXIT_CODE_OK)
            return code;
    }
    const int length = snprintf(text, sizeof text, "mean of %s %s", halves[0].text, halves[1].text);
    *hash = sha256(text, (size_t)length);
    return EXIT_CODE_OK;
}

/* Whether the file exists and is the one that these options would make. Other files are rendered again, because the folder belongs to the report. */
static bool file_is_kept(const char *path, const sha256_text *hash)
{
    file_error error;
    file_state state;
    return file_state_read(path, RENDER_HASH_KEY, hash->text, true, &state, &error) == FILE_OK && state == FILE_STATE_SAME;
}

/* Finds out the same for a picture. A reference of two halves needs their files, too. */
static int look_for_picture(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame, bool *kept)
{
    const size_t pictures[] = {picture, COMPARE_HALF, COMPARE_HALF + 1};
    *kept = true;
    for (int i = 0; i < (is_halved(job, picture) ? 3 : 1) && *kept; i++) {
        char path[COMPARE_PATH];
        sha256_text hash;
        if (!compare_picture_path(job, scene, pictures[i], frame, path))
            return EXIT_CODE_USAGE;
        const int code = hash_picture(job, scene, pictures[i], frame, &hash);
        if (code != EXIT_CODE_OK)
            return code;
        *kept = file_is_kept(path, &hash);
    }
    return EXIT_CODE_OK;
}

static int make_folder(compare_job *job, const char *name)
{
    char path[COMPARE_PATH];
    if (!compare_file_path(job, name, path))
        return EXIT_CODE_USAGE;
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s: cannot make this folder: %s", path, strerror(errno));
    return EXIT_CODE_OK;
}

static int make_folders(compare_job *job)
{
    int code = make_folder(job, "frames");
    for (size_t s = 0; s < job->request->scene_count && code == EXIT_CODE_OK; s++) {
        char name[80];
        snprintf(name, sizeof name, "frames/%s", job->scenes[s].name);
        code = make_folder(job, name);
    }
    return code;
}

/* Approximate work for a picture, from which the time left is estimated. */
static double picture_work(const compare_scene *scene, size_t picture)
{
    const mgt_quality *quality = compare_picture_quality(scene, picture);
    const double each = method_of(quality->method)->way == METHOD_SAMPLES ? 1 : 4; /* a filtered sample takes about four times as long as a point sample */
    return each * (double)compare_samples(quality) * scene->width * scene->height;
}

static int write_picture(compare_job *job, frame_buffer *buffer, const compare_scene *scene, size_t picture, size_t frame, double seconds)
{
    const render_request request = picture_request(job, scene, picture);
    char path[COMPARE_PATH], number[16];
    sha256_text hash;
    mgt_scene view;
    render_record record;
    file_error error;
    if (!compare_picture_path(job, scene, picture, frame, path) || !compare_frame_scene(job, scene, picture, frame, &view))
        return EXIT_CODE_BAD_INPUT;
    const int code = hash_picture(job, scene, picture, frame, &hash);
    if (code != EXIT_CODE_OK)
        return code;
    snprintf(number, sizeof number, "%u", compare_frame_number(job, frame));
    render_record_fill(&record, &request, &job->info, &hash, number, view.time, seconds);
    const size_t last = record.list.count;
    if (last < RECORD_ENTRIES) {
        snprintf(record.values[last], RECORD_TEXT, "%.6f", seconds);
        record.entries[last] = (metadata_entry){seconds_key, record.values[last]};
        record.list.count++;
    }
    return frame_buffer_write(buffer, &request, NULL, 0, path, &record.list, &job->output, &error) == FILE_OK ? EXIT_CODE_OK
                                                                                                              : compare_file_failure(job, &error);
}

/* Renders and writes a picture. */
static int draw_picture(compare_job *job, frame_buffer *buffer, const compare_scene *scene, size_t picture, size_t frame)
{
    mgt_scene view;
    if (!compare_frame_scene(job, scene, picture, frame, &view))
        return EXIT_CODE_BAD_INPUT;
    const double start = seconds_now();
    const mgt_status status = mgt_render(job->context, &view, buffer->targets, buffer->count);
    const double seconds = seconds_now() - start;
    if (status == MGT_CANCELLED || *interrupt_flag())
        return compare_stopped(job);
    if (status != MGT_OK) {
        progress_clear(&job->progress);
        return console_error(exit_code_of_status(status), "%s: frame %u by %s: %s", scene->path, compare_frame_number(job, frame),
                             compare_picture_name(job, picture), mgt_last_error(job->context));
    }
    return write_picture(job, buffer, scene, picture, frame, seconds);
}

/* Rendering time of a picture from its file's metadata; NaN: it has none. */
static double recorded_seconds(const compare_job *job, const compare_scene *scene, size_t picture, size_t frame)
{
    char path[COMPARE_PATH], *value = NULL;
    file_error error;
    if (!compare_picture_path(job, scene, picture, frame, path) || metadata_read(path, seconds_key, &value, &error) != FILE_OK)
        value = NULL;
    const double seconds = value ? strtod(value, NULL) : NAN;
    free(value);
    return seconds;
}

/* Sets a layer to the mean of the same layers of two files. */
static int read_mean(compare_job *job, const char paths[2][COMPARE_PATH], const mgt_target *target)
{
    float_image halves[2] = {{0}}, mean = {0};
    file_error error;
    bool good = true;
    for (int half = 0; half < 2 && good; half++)
        good = picture_read(&halves[half], paths[half], mgt_layer_name(target->layer), &error) == FILE_OK;
    good = good && noise_mean(&mean, &halves[0], &halves[1], &error) == FILE_OK;
    if (good)
        memcpy(target->pixels, mean.pixels, (size_t)mean.width * mean.height * mean.channels * sizeof(float));
    float_image_free(&halves[0]);
    float_image_free(&halves[1]);
    float_image_free(&mean);
    return good ? EXIT_CODE_OK : compare_file_failure(job, &error);
}

/* Renders the halves of a reference that do not exist, and writes their mean. */
static int draw_reference(compare_job *job, frame_buffer *buffer, const compare_scene *scene, size_t frame)
{
    char paths[2][COMPARE_PATH];
    double seconds = 0;
    int code = EXIT_CODE_OK;
    for (size_t half = 0; half < 2 && code == EXIT_CODE_OK; half++) {
        bool kept;
        if (!compare_picture_path(job, scene, COMPARE_HALF + half, frame, paths[half]))
            return EXIT_CODE_USAGE;
        job->part_first = 0.5 * (double)half;
        job->part_share = 0.5;
        code = look_for_picture(job, scene, COMPARE_HALF + half, frame, &kept);
        if (code == EXIT_CODE_OK && !kept)
            code = draw_picture(job, buffer, scene, COMPARE_HALF + half, frame);
        seconds += code == EXIT_CODE_OK ? recorded_seconds(job, scene, COMPARE_HALF + half, frame) : 0;
    }
    job->part_first = 0;
    job->part_share = 1;
    for (size_t i = 0; i < buffer->count && code == EXIT_CODE_OK; i++)
        code = read_mean(job, paths, &buffer->targets[i]);
    return code == EXIT_CODE_OK ? write_picture(job, buffer, scene, COMPARE_REFERENCE, frame, seconds) : code;
}

static int render_picture(compare_job *job, frame_buffer *buffer, const compare_scene *scene, size_t picture, size_t frame)
{
    char path[COMPARE_PATH];
    if (!compare_picture_path(job, scene, picture, frame, path))
        return EXIT_CODE_USAGE;
    progress_frame(&job->progress, compare_frame_number(job, frame));
    job->progress.work_now = picture_work(scene, picture);
    const int code = is_halved(job, picture) ? draw_reference(job, buffer, scene, frame) : draw_picture(job, buffer, scene, picture, frame);
    if (code != EXIT_CODE_OK)
        return code;
    job->rendered++;
    progress_frame_done(&job->progress, path, recorded_seconds(job, scene, picture, frame));
    return EXIT_CODE_OK;
}

/* Marks in `kept`, which has an element for each frame and picture, those that are not rendered. Adds up the number and the work of the others. */
static int look_for_kept(compare_job *job, const compare_scene *scene, bool *kept, uint64_t *missing, double *work)
{
    const size_t pictures = job->request->method_count + 1, each = job->frame_count * pictures, before = (size_t)(scene - job->scenes) * each;
    for (size_t i = 0; i < each; i++) {
        const size_t picture = i % pictures;
        const bool external = picture != COMPARE_REFERENCE && compare_is_external(job->request, picture - 1);
        if (external || !compare_draws(scene, picture) || scene->view->only_timed || !shard_has(&job->request->shard, before + i)) {
            kept[i] = true;
            continue;
        }
        const int code = look_for_picture(job, scene, picture, i / pictures, &kept[i]);
        if (code != EXIT_CODE_OK)
            return code;
        *missing += !kept[i];
        *work += kept[i] ? 0 : picture_work(scene, picture);
        job->kept += kept[i];
    }
    return EXIT_CODE_OK;
}

static int render_scene(compare_job *job, const compare_scene *scene, const bool *kept)
{
    const size_t pictures = job->request->method_count + 1;
    const render_request request = picture_request(job, scene, COMPARE_REFERENCE);
    frame_buffer buffer;
    int code = frame_buffer_create(&buffer, &request, scene->width, scene->height);
    /* All pictures of a frame come one after the other, so that the reference's work is evenly distributed and the time left is estimated well. */
    for (size_t i = 0; i < job->frame_count * pictures && code == EXIT_CODE_OK; i++) {
        if (*interrupt_flag())
            code = compare_stopped(job);
        else if (!kept[i])
            code = render_picture(job, &buffer, scene, i % pictures, i / pictures);
    }
    frame_buffer_free(&buffer);
    return code;
}

/* Reads the times of the reference from its files, so that they are also known if nothing was rendered. */
static void read_reference_seconds(compare_job *job, compare_scene *scene)
{
    double sum = 0;
    for (size_t frame = 0; frame < job->frame_count; frame++)
        sum += recorded_seconds(job, scene, COMPARE_REFERENCE, frame);
    scene->reference_seconds = sum / (double)job->frame_count;
}

int compare_render(compare_job *job)
{
    const size_t scenes = job->request->scene_count, each = job->frame_count * (job->request->method_count + 1);
    uint64_t missing = 0;
    double work = 0;
    bool *kept = calloc(scenes * each, sizeof *kept);
    int code = kept ? make_folders(job) : console_error(EXIT_CODE_FAILED, "out of memory");
    for (size_t s = 0; s < scenes && code == EXIT_CODE_OK; s++)
        code = look_for_kept(job, &job->scenes[s], kept + s * each, &missing, &work);
    job->progress = progress_start(job->request->progress, missing);
    job->progress.work = work;
    for (size_t s = 0; s < scenes && code == EXIT_CODE_OK; s++)
        code = render_scene(job, &job->scenes[s], kept + s * each);
    progress_clear(&job->progress);
    for (size_t s = 0; s < scenes && code == EXIT_CODE_OK; s++)
        read_reference_seconds(job, &job->scenes[s]);
    free(kept);
    return code;
}
