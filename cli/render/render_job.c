/* SPDX-License-Identifier: MIT */
/* A render from loading the scene to the last file. Everything that can be checked is checked before the frames are rendered. */
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/file_whole.h"
#include "image/video.h"
#include "cli/common/interrupt.h"
#include "cli/render/render_job.h"
#include "cli/render/render_sums.h"
#include "params/methods.h"

enum { FRAMES_TEXT = 240 };

int render_job_stopped(const render_job *job)
{
    console_note(&job->request->out, "mangata: stopped; nothing unfinished was left behind%s",
                 job->request->checkpoint > 0  ? "; the same command goes on from the last checkpoint"
                 : job->request->path.numbered ? "; --skip-existing goes on where it stopped"
                                               : "");
    return interrupt_exit_code();
}

int render_job_file_failure(render_job *job, const file_error *error)
{
    progress_clear(&job->progress);
    return error->status == FILE_CANCELLED ? render_job_stopped(job) : console_file_error(error);
}

int render_job_ended(render_job *job, uint32_t frame, mgt_status status)
{
    if (status == MGT_OK && !*interrupt_flag())
        return EXIT_CODE_OK;
    progress_clear(&job->progress);
    if (status == MGT_CANCELLED || *interrupt_flag())
        return render_job_stopped(job);
    return console_error(exit_code_of_status(status), "frame %u: %s", frame, mgt_last_error(job->context));
}

static bool on_progress(void *user, double fraction)
{
    render_job *job = user;
    progress_update(&job->progress, job->before + job->share * fraction);
    return *interrupt_flag() == 0;
}

/* ---- before the first pixel ---------------------------------------------------------------------------- */

static int frame_scene(const render_job *job, uint32_t frame, mgt_scene *scene)
{
    if (!scene_file_frame(job->scene, (int)frame, scene))
        return console_error(EXIT_CODE_BAD_INPUT, "%s: the camera of frame %u is not a legal one", job->request->scene_path, frame);
    if (job->request->crop[2]) {
        const uint64_t *crop = job->request->crop;
        scene->image.crop_x = (uint32_t)crop[0];
        scene->image.crop_y = (uint32_t)crop[1];
        scene->image.crop_width = (uint32_t)crop[2];
        scene->image.crop_height = (uint32_t)crop[3];
    } else {
        scene->image.crop_x = scene->image.crop_y = 0;
        scene->image.crop_width = scene->image.width;
        scene->image.crop_height = scene->image.height;
    }
    scene->quality = job->request->quality;
    return EXIT_CODE_OK;
}

/* Frames behind the end of the film are rendered, for a scene may go on, but perhaps nobody meant them. A scene of one frame says nothing of a film, and that
 * of --sea is as long as the command says. */
static void note_end(const render_job *job)
{
    const render_request *r = job->request;
    const uint32_t count = (uint32_t)scene_file_frame_count(job->scene);
    if (count > 1 && job->last_frame >= count && strncmp(r->scene_path, "--", 2) != 0)
        console_note(&r->out,
                     "mangata: warning: %s: the film ends with frame %u (time.frames is %u), and --frames goes on to %u: waves move on, a camera's path rests",
                     r->scene_path, count - 1, count, job->last_frame);
}

static int load_scene(render_job *job)
{
    render_request *r = job->request;
    scene_error error;
    job->scene = scene_file_open(r->scene_path, r->changes.items, r->changes.count, &error);
    if (!job->scene)
        return console_scene_error(&error);
    if (scene_file_warning(job->scene)[0])
        console_note(&r->out, "mangata: warning: %s", scene_file_warning(job->scene));
    job->canonical = scene_file_canonical(job->scene, NULL);
    if (!job->canonical)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    char wrong[600];
    const mgt_quality base = scene_file_quality(job->scene);
    if (!quality_options_apply(&r->options, &base, &r->quality, wrong, sizeof wrong))
        return console_error(EXIT_CODE_USAGE, "%s", wrong);
    if (!r->frames.count) {
        const bool one = !render_is_film(r) && !r->path.numbered;
        frame_list_span(&r->frames, 0, one ? 0 : (uint32_t)scene_file_frame_count(job->scene) - 1);
    }
    mgt_scene first;
    const int code = frame_scene(job, frame_list_at(&r->frames, 0), &first);
    if (code != EXIT_CODE_OK)
        return code;
    job->last_frame = frame_list_at(&r->frames, frame_list_length(&r->frames) - 1);
    frame_list_shard(&r->frames, &r->shard);
    job->image = first.image;
    const mgt_image *i = &job->image;
    if (i->crop_x >= i->width || i->crop_y >= i->height || i->crop_width > i->width - i->crop_x || i->crop_height > i->height - i->crop_y)
        return console_error(EXIT_CODE_USAGE, "--crop %u,%u,%u,%u: it lies outside the picture of %u x %u pixels", i->crop_x, i->crop_y, i->crop_width,
                             i->crop_height, i->width, i->height);
    return render_sums_wanted(r) ? render_sums_check(r, &first) : EXIT_CODE_OK;
}

static int create_context(render_job *job)
{
    const int code = context_open(&job->request->context, &job->request->out, on_progress, job, &job->context, &job->info);
    if (code != EXIT_CODE_OK)
        return code;
    if (job->info.backend == MGT_BACKEND_GL)
        console_detail(&job->request->out, "backend gl, %s", job->info.renderer);
    else
        console_detail(&job->request->out, "backend %s, %s, %u lanes, %u threads", mgt_backend_name(job->info.backend), mgt_isa_name(job->info.isa),
                       job->info.lanes, job->info.threads);
    return EXIT_CODE_OK;
}

static int create_crypto(render_job *job)
{
    render_request *r = job->request;
    const int code = render_crypto_create(&job->crypto, job->scene, &r->context, r->exr.crypto, job->image.crop_width, job->image.crop_height);
    if (code == EXIT_CODE_OK)
        r->exr.crypto_names = render_crypto_names(job->crypto);
    return code;
}

/* Checks all frames, so that an error does not appear after an hour of rendering. */
static int check_frames(render_job *job)
{
    const render_request *r = job->request;
    const uint64_t count = frame_list_length(&r->frames);
    for (uint64_t i = 0; i < count; i++) {
        const uint32_t frame = frame_list_at(&r->frames, i);
        mgt_scene scene;
        const int code = frame_scene(job, frame, &scene);
        if (code != EXIT_CODE_OK)
            return code;
        const mgt_status status = mgt_scene_check(job->context, &scene);
        if (status == MGT_ERROR_SCENE || status == MGT_ERROR_UNSUPPORTED)
            return console_error(exit_code_of_status(status), "%s: frame %u: %s", r->scene_path, frame, mgt_last_error(job->context));
        if (status != MGT_OK)
            return console_library_error(job->context, status);
        if (*interrupt_flag())
            return render_job_stopped(job);
    }
    return EXIT_CODE_OK;
}

/* Whether and how one output file is written. */
typedef struct output_plan {
    bool skip;             /* the file exists as these options would make it */
    output_options output; /* otherwise; overwrites a damaged file */
} output_plan;

/* Whether --skip-existing keeps the file at `path`, or replaces a damaged one. Prints an error if it does neither. Only with `whole` it is read to its end. */
static int check_existing(render_job *job, const char *path, const sha256_text *hash, bool whole, output_plan *plan)
{
    file_error error;
    file_state state;
    const file_status status = file_state_read(path, RENDER_HASH_KEY, hash->text, whole, &state, &error);
    plan->skip = status == FILE_OK && state == FILE_STATE_SAME;
    if (plan->skip)
        return EXIT_CODE_OK;
    if (status == FILE_MEMORY)
        return render_job_file_failure(job, &error);
    if (status == FILE_OK && state == FILE_STATE_DAMAGED) {
        plan->output.overwrite = true;
        if (whole) {
            progress_clear(&job->progress);
            console_note(&job->request->out, "%s: damaged; it is rendered again", path);
        }
    } else if (!job->request->overwrite) {
        const bool unreadable = access(path, R_OK) != 0 && errno == EACCES && access(path, F_OK) == 0;
        if (status == FILE_MISSING && !unreadable)
            return EXIT_CODE_OK;
        /* What --overwrite does not replace, such as a directory, has an error of its own. */
        if (output_file_check(path, &(output_options){.overwrite = true}, &error) != FILE_OK)
            return render_job_file_failure(job, &error);
        progress_clear(&job->progress);
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s: it exists, but %s; --overwrite replaces it", path,
                             unreadable ? "cannot be read: Permission denied" : "was not rendered from this scene with these options");
    }
    return EXIT_CODE_OK;
}

/* Fills the plan for `path`; prints an error if it may not be written. Another machine may finish the file between the two looks, then it is looked at once more. */
static int check_output(render_job *job, const char *path, const sha256_text *hash, bool whole, output_plan *plan)
{
    file_error error;
    file_status status = FILE_EXISTS;
    *plan = (output_plan){.output = job->output};
    for (int looks = 0; looks < 2 && status == FILE_EXISTS; looks++) {
        const int code = job->request->skip_existing ? check_existing(job, path, hash, whole, plan) : EXIT_CODE_OK;
        if (code != EXIT_CODE_OK || plan->skip)
            return code;
        status = output_file_check(path, &plan->output, &error);
    }
    return status == FILE_OK ? EXIT_CODE_OK : render_job_file_failure(job, &error);
}

/* Whether a file that could not be written because it exists by now is kept, as --skip-existing asks. Prints an error if not. */
static int check_finished(render_job *job, const char *path, const sha256_text *hash, const file_error *error, bool *kept)
{
    output_plan plan = {0};
    if (error->status != FILE_EXISTS || !job->request->skip_existing)
        return render_job_file_failure(job, error);
    const int code = check_output(job, path, hash, true, &plan);
    *kept = plan.skip;
    return code != EXIT_CODE_OK || plan.skip ? code : render_job_file_failure(job, error);
}

int render_job_path(const frame_path *pattern, const char *given, uint32_t frame, char path[JOB_PATH])
{
    if (!frame_path_print(pattern, frame, path, JOB_PATH))
        return console_error(EXIT_CODE_USAGE, "%s: the path is too long", given);
    return EXIT_CODE_OK;
}

static int print_path(const render_job *job, uint32_t frame, char path[JOB_PATH])
{
    return render_job_path(&job->request->path, job->request->output, frame, path);
}

/* Checks the folder of the output, so that all frames need not be gone through to see that it is missing. */
static int check_folder(render_job *job)
{
    const render_request *r = job->request;
    char path[JOB_PATH];
    file_error error;
    const int code = frame_list_length(&r->frames) ? print_path(job, frame_list_at(&r->frames, 0), path) : EXIT_CODE_OK;
    if (code != EXIT_CODE_OK || !frame_list_length(&r->frames))
        return code;
    if (output_file_check_folder(path, &error) == FILE_OK)
        return EXIT_CODE_OK;
    if (error.status == FILE_WRITE && frame_path_folder_is_marked(&r->path))
        return console_error(EXIT_CODE_CANNOT_WRITE, "%s; a frame number is allowed in the file's name alone", error.text);
    return console_file_error(&error);
}

/* Writes the frame as text into `number`. The hash of a part that a merge writes also covers the samples that it holds. */
static int hash_frame(render_job *job, uint32_t frame, char number[16], sha256_text *hash)
{
    char meant[100];
    snprintf(number, 16, "%u", frame);
    snprintf(meant, sizeof meant, "%s", number);
    if (job->request->part_count && job->request->format == PICTURE_SUMS) {
        const int code = render_sums_plan(job, frame);
        if (code != EXIT_CODE_OK)
            return code;
        if (!render_sums_complete(job))
            snprintf(meant, sizeof meant, "%s in %s", number, sha256(job->ranges.items, job->ranges.count * sizeof job->ranges.items[0]).text);
    }
    if (!render_hash(job->request, job->canonical, &job->image, &job->info, meant, hash))
        return console_error(EXIT_CODE_FAILED, "out of memory");
    return EXIT_CODE_OK;
}

static int check_stills(render_job *job)
{
    const bool merges = job->request->part_count > 0;
    const uint64_t count = frame_list_length(&job->request->frames);
    for (uint64_t i = 0; i < count; i++) {
        const uint32_t frame = frame_list_at(&job->request->frames, i);
        char path[JOB_PATH], number[16];
        sha256_text hash;
        output_plan plan;
        int code = print_path(job, frame, path);
        if (code == EXIT_CODE_OK && job->request->skip_existing)
            code = hash_frame(job, frame, number, &hash);
        if (code == EXIT_CODE_OK)
            code = check_output(job, path, &hash, false, &plan);
        if (code == EXIT_CODE_OK && merges && !plan.skip)
            code = render_sums_plan(job, frame);
        if (code == EXIT_CODE_OK && job->request->checkpoint > 0 && !plan.skip)
            code = render_sums_check_checkpoint(job, frame, path);
        if (code != EXIT_CODE_OK)
            return code;
    }
    return EXIT_CODE_OK;
}

/* ---- rendering ----------------------------------------------------------------------------------------- */

/* Renders the layers of a frame, from the sums if pictures are made of sums. A file of sums needs no layers. */
static mgt_status render_pixels(render_job *job, const mgt_scene *scene)
{
    if (job->request->format == PICTURE_SUMS)
        return MGT_OK;
    return job->sums ? mgt_render_sums(job->context, scene, job->sums, job->buffer.targets, job->buffer.count)
                     : mgt_render(job->context, scene, job->buffer.targets, job->buffer.count);
}

static int render_frame(render_job *job, uint32_t frame, const char *path, mgt_scene *scene, double *seconds)
{
    int code = frame_scene(job, frame, scene);
    if (code != EXIT_CODE_OK)
        return code;
    progress_frame(&job->progress, frame);
    const double start = seconds_now();
    if (job->sums)
        code = render_sums_fill(job, frame, scene, path);
    if (code != EXIT_CODE_OK)
        return code;
    const mgt_status status = render_pixels(job, scene);
    *seconds = seconds_now() - start;
    code = render_job_ended(job, frame, status);
    if (code != EXIT_CODE_OK)
        return code;
    if (job->buffer.displayed)
        frame_buffer_display(&job->buffer);
    job->seconds += *seconds;
    job->least = job->rendered == 0 || *seconds < job->least ? *seconds : job->least;
    job->most = *seconds > job->most ? *seconds : job->most;
    job->rendered++;
    return EXIT_CODE_OK;
}

/* Adds the exposure to the metadata of a file of displayed colour. */
static int record_exposure(render_job *job, const mgt_scene *scene, render_record *record)
{
    double stops;
    if (!job->buffer.displayed || job->request->layers[0] != MGT_LAYER_COLOR || job->info.backend == MGT_BACKEND_NULL)
        return EXIT_CODE_OK;
    const mgt_status status = mgt_exposure(job->context, scene, &stops);
    if (status != MGT_OK)
        return console_library_error(job->context, status);
    render_record_add_exposure(record, stops);
    return EXIT_CODE_OK;
}

static void list_file(render_job *job, const char *path, const char *frames, const sha256_text *hash, bool skipped)
{
    if (job->files)
        json_array_append_new(job->files, json_pack("{s:o, s:s, s:s, s:b}", "path", console_json_text(path), render_is_film(job->request) ? "frames" : "frame",
                                                    frames, RENDER_HASH_KEY, hash->text, "skipped", skipped));
    job->skipped += skipped;
    if (skipped)
        console_detail(&job->request->out, "%s: kept", path);
}

static int render_still(render_job *job, uint32_t frame)
{
    char path[JOB_PATH], number[16];
    sha256_text hash;
    output_plan plan = {0};
    /* Another machine of a render farm may have finished the frame since the first check. */
    int code = print_path(job, frame, path);
    if (code == EXIT_CODE_OK)
        code = hash_frame(job, frame, number, &hash);
    if (code == EXIT_CODE_OK)
        code = check_output(job, path, &hash, true, &plan);
    if (code != EXIT_CODE_OK)
        return code;
    mgt_scene scene;
    double seconds = 0;
    if (!plan.skip) {
        code = render_frame(job, frame, path, &scene, &seconds);
        if (code != EXIT_CODE_OK)
            return code;
        render_record record;
        file_error error;
        render_record_fill(&record, job->request, &job->info, &hash, number, scene.time, seconds);
        code = record_exposure(job, &scene, &record);
        if (code != EXIT_CODE_OK)
            return code;
        file_status status = job->request->format == PICTURE_SUMS
                                 ? render_sums_write(job, frame, path, &record, &plan.output, &error)
                                 : frame_buffer_write(&job->buffer, job->request, &scene, scene_file_fps(job->scene), path, &record.list, &plan.output, &error);
        if (status != FILE_OK)
            code = check_finished(job, path, &hash, &error, &plan.skip);
        if (code != EXIT_CODE_OK)
            return code;
        job->lost += plan.skip;
    }
    render_sums_done(job, frame, path);
    list_file(job, path, number, &hash, plan.skip);
    progress_frame_done(&job->progress, path, seconds);
    return EXIT_CODE_OK;
}

static int render_stills(render_job *job)
{
    const uint64_t count = frame_list_length(&job->request->frames);
    for (uint64_t i = 0; i < count; i++) {
        const int code = *interrupt_flag() ? render_job_stopped(job) : render_still(job, frame_list_at(&job->request->frames, i));
        if (code != EXIT_CODE_OK)
            return code;
    }
    return EXIT_CODE_OK;
}

/* Checks what can be checked before a film is rendered. `frames` gets the list of its frames as text, which may be cut short. */
static int check_film(render_job *job, char frames[FRAMES_TEXT], sha256_text *hash, output_plan *plan)
{
    const render_request *r = job->request;
    const uint64_t count = frame_list_length(&r->frames);
    frame_list_print(&r->frames, frames, FRAMES_TEXT);
    /* The hash covers every range. */
    *hash = sha256(r->frames.ranges, r->frames.count * sizeof r->frames.ranges[0]);
    if (!render_hash(r, job->canonical, &job->image, &job->info, hash->text, hash))
        return console_error(EXIT_CODE_FAILED, "out of memory");
    int code = check_output(job, r->path.before, hash, true, plan);
    for (uint64_t i = 0; i < count && r->part_count && code == EXIT_CODE_OK && !plan->skip; i++)
        code = render_sums_plan(job, frame_list_at(&r->frames, i));
    return code;
}

static int render_film(render_job *job)
{
    const render_request *r = job->request;
    const uint64_t count = frame_list_length(&r->frames);
    const char *path = r->path.before;
    char frames[FRAMES_TEXT];
    sha256_text hash;
    output_plan plan;
    int code = check_film(job, frames, &hash, &plan);
    if (code != EXIT_CODE_OK || r->dry_run)
        return code;
    if (plan.skip) {
        list_file(job, path, frames, &hash, true);
        return EXIT_CODE_OK;
    }
    if (r->format != PICTURE_Y4M && (job->buffer.width % 2 || job->buffer.height % 2))
        console_note(&r->out,
                     "mangata: warning: %s: encoders take even sides, so the film has %u x %u pixels, its last column or row twice; .y4m keeps %u x %u", path,
                     job->buffer.width + job->buffer.width % 2, job->buffer.height + job->buffer.height % 2, job->buffer.width, job->buffer.height);
    mgt_scene first;
    code = frame_scene(job, frame_list_at(&r->frames, 0), &first);
    if (code != EXIT_CODE_OK)
        return code;
    render_record record;
    render_record_fill(&record, r, &job->info, &hash, frames, first.time, -1);
    code = record_exposure(job, &first, &record);
    if (code != EXIT_CODE_OK)
        return code;
    const video_desc desc = {.width = job->buffer.width,
                             .height = job->buffer.height,
                             .frames_per_second = scene_file_fps(job->scene),
                             .codec = r->film.codec,
                             .crf = r->film.crf,
                             .metadata = &record.list,
                             .output = plan.output};
    video_writer *writer = NULL;
    file_error error;
    bool kept = false;
    if (video_writer_open(&writer, path, &desc, &error) != FILE_OK) {
        code = check_finished(job, path, &hash, &error, &kept);
        if (code == EXIT_CODE_OK)
            list_file(job, path, frames, &hash, kept);
        return code;
    }
    for (uint64_t i = 0; i < count; i++) {
        mgt_scene scene;
        double seconds;
        code = render_frame(job, frame_list_at(&r->frames, i), path, &scene, &seconds);
        if (code == EXIT_CODE_OK && video_writer_frame(writer, job->buffer.targets[0].pixels, 0, &error) != FILE_OK)
            code = render_job_file_failure(job, &error);
        if (code != EXIT_CODE_OK) {
            video_writer_abort(writer);
            return code;
        }
        progress_frame_done(&job->progress, path, seconds);
    }
    if (video_writer_finish(writer, &error) != FILE_OK)
        code = check_finished(job, path, &hash, &error, &kept);
    if (code != EXIT_CODE_OK)
        return code;
    job->lost += kept;
    list_file(job, path, frames, &hash, kept);
    return EXIT_CODE_OK;
}

/* ---- the end -------------------------------------------------------------------------------------------- */

/* What the report says of files that were kept beside those that were rendered. */
static void print_kept(const render_job *job, char *text, size_t size)
{
    const bool film = render_is_film(job->request);
    text[0] = 0;
    if (job->lost && (film || job->lost == job->rendered))
        snprintf(text, size, "; kept %s that another process has finished meanwhile", film ? "the film" : job->lost == 1 ? "the picture" : "the pictures");
    else if (job->lost)
        snprintf(text, size, "; kept %" PRIu64 " that another process has finished meanwhile", job->lost);
    if (job->skipped > job->lost)
        snprintf(text + strlen(text), size - strlen(text), ", others kept");
}

static int report(render_job *job, double wall)
{
    char kept[120];
    print_kept(job, kept, sizeof kept);
    const render_request *r = job->request;
    const double mean = job->rendered ? job->seconds / (double)job->rendered : 0;
    if (r->dry_run)
        console_note(&r->out, "%s: nothing speaks against it; a dry run renders nothing", r->output);
    else if (job->rendered)
        console_note(&r->out, "%s: %" PRIu64 " frame%s of %u x %u by %s, %.1f ms each%s", r->output, job->rendered, job->rendered == 1 ? "" : "s",
                     job->buffer.width, job->buffer.height, method_name(&r->quality).text, 1e3 * mean, kept);
    else
        console_note(&r->out, "%s: %snothing to render", r->output, job->skipped ? "kept, " : "");
    if (!r->out.json)
        return EXIT_CODE_OK;
    return console_print_json(json_pack("{s:s, s:o, s:s, s:i, s:i, s:I, s:I, s:{s:f, s:f, s:f}, s:f, s:s, s:s, s:i, s:O}", "version", mgt_version(), "scene",
                                        console_json_text(r->scene_path), "method", method_name(&r->quality).text, "width", (int)job->image.crop_width,
                                        "height", (int)job->image.crop_height, "rendered", (json_int_t)job->rendered, "skipped", (json_int_t)job->skipped,
                                        "seconds_per_frame", "mean", mean, "min", job->least, "max", job->most, "seconds", wall, "backend",
                                        mgt_backend_name(job->info.backend), "isa", mgt_isa_name(job->info.isa), "threads", (int)job->info.threads, "files",
                                        job->files));
}

static int run(render_job *job)
{
    const double start = seconds_now();
    int code = load_scene(job);
    interrupt_install();
    if (code == EXIT_CODE_OK)
        code = check_folder(job);
    if (code == EXIT_CODE_OK)
        code = create_context(job);
    if (code == EXIT_CODE_OK)
        code = check_frames(job);
    if (code == EXIT_CODE_OK && job->request->exr.crypto)
        code = create_crypto(job);
    if (code == EXIT_CODE_OK && !render_is_film(job->request))
        code = check_stills(job);
    if (code == EXIT_CODE_OK && job->request->dry_run && render_is_film(job->request))
        code = render_film(job);
    if (code == EXIT_CODE_OK)
        note_end(job);
    if (code == EXIT_CODE_OK && job->request->dry_run)
        return report(job, seconds_now() - start);
    if (code == EXIT_CODE_OK && render_sums_wanted(job->request))
        code = render_sums_create(job);
    if (code == EXIT_CODE_OK)
        code = frame_buffer_create(&job->buffer, job->request, job->image.crop_width, job->image.crop_height);
    if (code != EXIT_CODE_OK)
        return code;
    job->buffer.crypto = job->crypto;
    /* A render farm may have more machines than there are frames. */
    if (frame_list_length(&job->request->frames) == 0)
        return report(job, seconds_now() - start);
    job->progress = progress_start(job->request->progress, frame_list_length(&job->request->frames));
    code = render_is_film(job->request) ? render_film(job) : render_stills(job);
    progress_clear(&job->progress);
    if (code == EXIT_CODE_OK && *interrupt_flag())
        code = render_job_stopped(job); /* while the last file got its name */
    return code == EXIT_CODE_OK ? report(job, seconds_now() - start) : code;
}

int render_job_run(render_request *request)
{
    render_job *job = calloc(1, sizeof *job);
    if (!job)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    job->request = request;
    job->share = 1;
    job->output = (output_options){.overwrite = request->overwrite, .cancel = interrupt_flag()};
    if (request->out.json)
        job->files = json_array();
    const int code = run(job);
    json_decref(job->files);
    frame_buffer_free(&job->buffer);
    render_crypto_free(job->crypto);
    free(job->sums);
    mgt_context_destroy(job->context);
    free(job->canonical);
    scene_file_free(job->scene);
    free(job);
    return code;
}
