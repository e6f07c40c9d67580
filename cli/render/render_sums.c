/* SPDX-License-Identifier: MIT */
/* Sums of samples, parts of sums, and checkpoints. */
#define _POSIX_C_SOURCE 200809L

#include "cli/render/render_sums.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/common/interrupt.h"
#include "params/methods.h"

_Static_assert((int)SUMS_WORDS == (int)MGT_SUM_WORDS, "files hold what the library sums up");

/* The range of samples that the request asks for. */
static sums_range wanted_range(const mgt_quality *q)
{
    return (sums_range){q->sample_first, q->sample_count ? q->sample_count : quality_range(q) - q->sample_first};
}

bool render_sums_wanted(const render_request *r) { return r->format == PICTURE_SUMS || r->part_count > 0 || r->checkpoint > 0; }

int render_sums_check(const render_request *r, const mgt_scene *scene)
{
    const char *what = r->part_count ? "merge" : r->format == PICTURE_SUMS ? "-o .sums" : "--checkpoint";
    if (quality_range(&r->quality) == 0)
        return console_error(
            EXIT_CODE_USAGE,
            "%s: method %s has no exact sums of samples; reference, ssaaN, and adaptive --adaptive podee --slots have, and others share out frames by --shard",
            what, method_name(&r->quality).text);
    const mgt_image *image = &scene->image;
    const bool displayed = r->format != PICTURE_SUMS && r->format != PICTURE_EXR && r->format != PICTURE_PFM && r->layers[0] == MGT_LAYER_COLOR;
    if (displayed && scene->post.glare > 0 && (image->crop_width != image->width || image->crop_height != image->height))
        return console_error(EXIT_CODE_USAGE,
                             "-o %s: the glare of displayed colour needs the sums of the whole picture; leave out --crop, or write .exr or .pfm", r->output);
    return EXIT_CODE_OK;
}

static size_t pixels_of(const render_job *job) { return (size_t)job->image.crop_width * job->image.crop_height; }

int render_sums_create(render_job *job)
{
    const double bytes = (double)pixels_of(job) * MGT_SUM_WORDS * sizeof *job->sums;
    if (frame_buffer_fits(bytes))
        job->sums = calloc(pixels_of(job) * MGT_SUM_WORDS, sizeof *job->sums);
    if (job->sums)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_FAILED, "out of memory: the sums of %u x %u pixels need %.1f GB; --crop renders a part", job->image.crop_width,
                         job->image.crop_height, bytes * 1e-9);
}

static void clear_sums(render_job *job)
{
    memset(job->sums, 0, pixels_of(job) * MGT_SUM_WORDS * sizeof *job->sums);
    job->ranges.count = 0;
}

/* ---- the record of sums ---- */

/* Fills the record that a file of sums of this frame has. */
static int record_of(const render_job *job, uint32_t frame, render_record *record)
{
    char number[16];
    sha256_text hash;
    snprintf(number, sizeof number, "%u", frame);
    if (!sums_hash(job->request, job->canonical, &job->image, &job->info, number, &hash))
        return console_error(EXIT_CODE_FAILED, "out of memory");
    render_record_fill_sums(record, job->request, &job->image, &job->info, &hash, number);
    return EXIT_CODE_OK;
}

/* The first entry of `record` that differs in the file; the hash of the scene is the last one. NULL: the file belongs to this frame. */
static const metadata_entry *other_entry(const sums_file *file, const render_record *record)
{
    for (size_t i = 0; i < record->list.count; i++) {
        const metadata_entry *entry = &record->list.entries[i];
        const char *found = sums_metadata(file, entry->key);
        if (!found || strcmp(found, entry->value) != 0)
            return entry;
    }
    return NULL;
}

/* ---- parts ---- */

static int other_part(const sums_file *part, const metadata_entry *entry, const char *path)
{
    const char *found = sums_metadata(part, entry->key);
    if (strcmp(entry->key, SUMS_HASH_KEY) == 0)
        return console_error(EXIT_CODE_BAD_INPUT, "%s: it was rendered from another scene, or with other values of --set", path);
    return console_error(EXIT_CODE_BAD_INPUT, "%s: it has %s %.80s, and this merge has %s", path, entry->key, found ? found : "unknown", entry->value);
}

/* Adds the ranges of a part to those of the job. */
static int join_part(render_job *job, const sums_file *part, const char *path)
{
    const sums_range all = wanted_range(&job->request->quality);
    for (size_t i = 0; i < part->ranges.count; i++) {
        const sums_range *range = &part->ranges.items[i];
        sums_range overlap;
        const bool inside = range->first >= all.first && range->first + range->count <= all.first + all.count;
        const sums_joined joined = inside ? sums_ranges_join(&job->ranges, *range, &overlap) : SUMS_JOINED;
        if (inside && joined == SUMS_JOINED)
            continue;
        progress_clear(&job->progress);
        if (!inside)
            return console_error(EXIT_CODE_BAD_INPUT, "%s: it has the samples %" PRIu64 ",%" PRIu64 "; allowed are those within %" PRIu64 ",%" PRIu64, path,
                                 range->first, range->count, all.first, all.count);
        if (joined == SUMS_OVERLAP)
            return console_error(EXIT_CODE_BAD_INPUT, "%s: its samples %" PRIu64 ",%" PRIu64 " are in an earlier part as well", path, overlap.first,
                                 overlap.count);
        return console_error(EXIT_CODE_BAD_INPUT, "%s: the parts leave more than %d gaps between their samples", path, SUMS_RANGES_MOST);
    }
    return EXIT_CODE_OK;
}

/* Opens a part and checks that it belongs to the frame. */
static int open_part(render_job *job, size_t index, uint32_t frame, const render_record *record, char path[JOB_PATH], sums_file *part)
{
    file_error error;
    const int code = render_job_path(&job->request->parts[index], job->request->part_paths[index], frame, path);
    if (code != EXIT_CODE_OK)
        return code;
    if (sums_open(part, path, &error) != FILE_OK)
        return render_job_file_failure(job, &error);
    const metadata_entry *other = other_entry(part, record);
    if (!other)
        return EXIT_CODE_OK;
    progress_clear(&job->progress);
    const int wrong = other_part(part, other, path);
    sums_close(part);
    return wrong;
}

/* Opens every part of the frame and joins their ranges. `add`: also adds up their sums. */
static int read_parts(render_job *job, uint32_t frame, const render_record *record, bool add)
{
    const render_request *r = job->request;
    char path[JOB_PATH];
    sums_file part;
    file_error error;
    if (add)
        clear_sums(job);
    job->ranges.count = 0;
    for (size_t i = 0; i < r->part_count; i++) {
        int code = *interrupt_flag() ? render_job_stopped(job) : open_part(job, i, frame, record, path, &part);
        if (code != EXIT_CODE_OK)
            return code;
        code = join_part(job, &part, path);
        if (code == EXIT_CODE_OK && add && sums_add(&part, job->image.crop_width, job->image.crop_height, job->sums, &error) != FILE_OK)
            code = render_job_file_failure(job, &error);
        sums_close(&part);
        if (code != EXIT_CODE_OK)
            return code;
        if (add)
            progress_update(&job->progress, job->share * (double)(i + 1) / (double)r->part_count);
    }
    const sums_range gap = sums_ranges_gap(&job->ranges, wanted_range(&r->quality));
    if (gap.count == 0 || r->format == PICTURE_SUMS)
        return EXIT_CODE_OK;
    progress_clear(&job->progress);
    return console_error(EXIT_CODE_NO_INPUT,
                         "frame %u: no part has the samples %" PRIu64 ",%" PRIu64 " of %" PRIu64 "; mangata render … -o PART.sums --samples-range %" PRIu64
                         ",%" PRIu64 " makes it",
                         frame, gap.first, gap.count, quality_range(&r->quality), gap.first, gap.count);
}

/* ---- checkpoints ---- */

static bool checkpoint_path(const char *output, char path[JOB_PATH]) { return snprintf(path, JOB_PATH, "%s.checkpoint", output) < JOB_PATH; }

typedef enum checkpoint_state { CHECKPOINT_NONE = 0, CHECKPOINT_OURS, CHECKPOINT_OTHER, CHECKPOINT_DAMAGED } checkpoint_state;

/* Says what the file at `path` is for the frame of `record`. Only CHECKPOINT_OURS leaves it open. FILE_OK or FILE_MEMORY. */
static file_status open_checkpoint(const render_job *job, const render_record *record, const char *path, sums_file *file, checkpoint_state *state,
                                   file_error *error)
{
    const file_status status = sums_open(file, path, error);
    const sums_range wanted = wanted_range(&job->request->quality);
    const bool ours = status == FILE_OK && !other_entry(file, record) && file->ranges.count == 1 && file->ranges.items[0].first == wanted.first &&
                      file->ranges.items[0].count <= wanted.count;
    *state = ours                                         ? CHECKPOINT_OURS
             : status == FILE_MISSING                     ? CHECKPOINT_NONE
             : status == FILE_BAD && sums_are_begun(path) ? CHECKPOINT_DAMAGED
                                                          : CHECKPOINT_OTHER;
    if (!ours)
        sums_close(file);
    return status == FILE_MEMORY ? FILE_MEMORY : FILE_OK;
}

static int refuse_checkpoint(render_job *job, const char *path)
{
    progress_clear(&job->progress);
    return console_error(EXIT_CODE_CANNOT_WRITE, "%s: it is no checkpoint of this scene with these options; --overwrite begins anew", path);
}

static void note_damaged(render_job *job, const char *path)
{
    progress_clear(&job->progress);
    console_note(&job->request->out, "%s: damaged; the frame begins anew", path);
}

int render_sums_check_checkpoint(render_job *job, uint32_t frame, const char *path)
{
    render_record record;
    char checkpoint[JOB_PATH];
    sums_file file;
    file_error error;
    checkpoint_state state;
    int code = record_of(job, frame, &record);
    if (code != EXIT_CODE_OK || job->output.overwrite || !checkpoint_path(path, checkpoint))
        return code;
    if (open_checkpoint(job, &record, checkpoint, &file, &state, &error) != FILE_OK)
        return render_job_file_failure(job, &error);
    if (state == CHECKPOINT_OTHER)
        code = refuse_checkpoint(job, checkpoint);
    sums_close(&file);
    return code;
}

/* Loads the checkpoint of this frame, if there is one. */
static int load_checkpoint(render_job *job, const render_record *record, const char *path)
{
    sums_file file;
    file_error error;
    checkpoint_state state;
    if (open_checkpoint(job, record, path, &file, &state, &error) != FILE_OK)
        return render_job_file_failure(job, &error);
    if (state == CHECKPOINT_NONE)
        return output_file_check_kind(path, &error) == FILE_OK ? EXIT_CODE_OK : render_job_file_failure(job, &error);
    if (state == CHECKPOINT_OTHER && !job->output.overwrite)
        return refuse_checkpoint(job, path);
    if (state == CHECKPOINT_DAMAGED)
        note_damaged(job, path);
    if (state != CHECKPOINT_OURS)
        return EXIT_CODE_OK;
    if (sums_add(&file, job->image.crop_width, job->image.crop_height, job->sums, &error) == FILE_OK) {
        job->ranges = file.ranges;
        progress_clear(&job->progress);
        console_note(&job->request->out, "%s: goes on after %" PRIu64 " of %" PRIu64 " samples", path, job->ranges.items[0].count,
                     wanted_range(&job->request->quality).count);
    } else {
        clear_sums(job);
        note_damaged(job, path);
    }
    sums_close(&file);
    return EXIT_CODE_OK;
}

/* Saves a checkpoint. If it cannot be written, that is noted once, and rendering goes on. */
static int save_checkpoint(render_job *job, const render_record *record, const char *path)
{
    file_error error;
    output_options output = job->output;
    output.overwrite = true;
    const file_status status = sums_write(path, job->image.crop_width, job->image.crop_height, job->sums, &job->ranges, &record->list, &output, &error);
    if (status == FILE_CANCELLED)
        return render_job_file_failure(job, &error);
    if (status != FILE_OK && !job->unsaved) {
        progress_clear(&job->progress);
        console_note(&job->request->out, "%s; the frame goes on without a checkpoint", error.text);
    }
    job->unsaved |= status != FILE_OK;
    return EXIT_CODE_OK;
}

static int sum_range(render_job *job, uint32_t frame, const mgt_scene *scene, sums_range range)
{
    mgt_scene part = *scene;
    sums_range unused;
    part.quality.sample_first = range.first;
    part.quality.sample_count = range.count;
    const int code = render_job_ended(job, frame, mgt_sum_samples(job->context, &part, job->sums));
    if (code == EXIT_CODE_OK)
        sums_ranges_join(&job->ranges, range, &unused);
    return code;
}

/* Renders the samples in slices that take about the time between checkpoints. */
static int sum_in_slices(render_job *job, uint32_t frame, const mgt_scene *scene, const render_record *record, const char *path)
{
    const sums_range all = wanted_range(&job->request->quality);
    const double between = job->request->checkpoint, most = job->share;
    int code = load_checkpoint(job, record, path);
    uint64_t done = job->ranges.count ? job->ranges.items[0].count : 0, slice = (all.count + 127) / 128;
    double saved = seconds_now();
    while (code == EXIT_CODE_OK && done < all.count) {
        slice = slice < all.count - done ? slice : all.count - done;
        job->before = most * (double)done / (double)all.count;
        job->share = most * (double)slice / (double)all.count;
        const double start = seconds_now();
        code = sum_range(job, frame, scene, (sums_range){all.first + done, slice});
        if (code != EXIT_CODE_OK)
            break;
        done += slice;
        const double now = seconds_now(), fits = between / ((now - start) / (double)slice + 1e-9);
        slice = fits < 1 ? 1 : fits < (double)all.count ? (uint64_t)fits : all.count;
        if (done < all.count && now - saved >= 0.5 * between) {
            code = save_checkpoint(job, record, path);
            saved = seconds_now();
        }
    }
    return code;
}

void render_sums_done(const render_job *job, uint32_t frame, const char *path)
{
    render_record record;
    char checkpoint[JOB_PATH];
    sums_file file;
    file_error error;
    checkpoint_state state = CHECKPOINT_OURS;
    if (quality_range(&job->request->quality) == 0 || !checkpoint_path(path, checkpoint))
        return;
    if (job->request->checkpoint <= 0) {
        /* One that an earlier run with --checkpoint left. That of another picture may still be wanted. */
        if (access(checkpoint, F_OK) != 0 || record_of(job, frame, &record) != EXIT_CODE_OK ||
            open_checkpoint(job, &record, checkpoint, &file, &state, &error) != FILE_OK)
            return;
        sums_close(&file);
    }
    if (state == CHECKPOINT_OURS)
        unlink(checkpoint);
}

/* ---- a frame ---- */

bool render_sums_complete(const render_job *job) { return sums_ranges_gap(&job->ranges, (sums_range){0, quality_range(&job->request->quality)}).count == 0; }

file_status render_sums_write(render_job *job, uint32_t frame, const char *path, render_record *record, const output_options *output, file_error *error)
{
    render_record own;
    if (record_of(job, frame, &own) != EXIT_CODE_OK)
        return file_error_set(error, FILE_MEMORY, "%s: out of memory", path);
    render_record_add_sums(record, &own);
    return sums_write(path, job->image.crop_width, job->image.crop_height, job->sums, &job->ranges, &record->list, output, error);
}

int render_sums_plan(render_job *job, uint32_t frame)
{
    render_record record;
    const int code = record_of(job, frame, &record);
    return code == EXIT_CODE_OK ? read_parts(job, frame, &record, false) : code;
}

/* Fraction of a frame's progress that its sums make. Making the picture from them takes about as long as a sample, or as reading the parts. */
static double progress_of_sums(const render_request *r)
{
    const double samples = (double)wanted_range(&r->quality).count;
    return r->format == PICTURE_SUMS ? 1 : r->part_count ? 0.5 : samples / (samples + 1);
}

/* Fills the sums from parts, or from samples that are rendered. */
static int fill(render_job *job, uint32_t frame, const mgt_scene *scene, const char *path)
{
    render_record record;
    char checkpoint[JOB_PATH];
    const int code = record_of(job, frame, &record);
    if (code != EXIT_CODE_OK)
        return code;
    if (job->request->part_count)
        return read_parts(job, frame, &record, true);
    clear_sums(job);
    if (job->request->checkpoint <= 0)
        return sum_range(job, frame, scene, wanted_range(&job->request->quality));
    if (!checkpoint_path(path, checkpoint))
        return console_error(EXIT_CODE_USAGE, "-o %s: the path is too long", path);
    return sum_in_slices(job, frame, scene, &record, checkpoint);
}

int render_sums_fill(render_job *job, uint32_t frame, const mgt_scene *scene, const char *path)
{
    const double sums = progress_of_sums(job->request);
    job->before = 0;
    job->share = sums;
    const int code = fill(job, frame, scene, path);
    job->before = sums;
    job->share = 1 - sums;
    return code;
}
