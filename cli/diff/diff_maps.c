/* SPDX-License-Identifier: MIT */
/* Error maps: .png files show colours, .exr and .pfm files hold the errors themselves. */
#include "cli/diff/diff_maps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/common/interrupt.h"
#include "cli/common/numbers.h"
#include "image/error_colors.h"

enum { PATH_SIZE = sizeof(frame_path) };
static const char allowed[] = "METRIC=FILE, where METRIC is " CLIP_MAPPED_WORDS " and FILE ends in .png, .exr or .pfm";

int option_error_map(const option *o, void *place, const char *value)
{
    diff_maps *m = place;
    const size_t length = strcspn(value, "=");
    int i = 0;
    while (i < CLIP_MAPPED && (strlen(clip_metric_name(clip_mapped[i])) != length || strncmp(clip_metric_name(clip_mapped[i]), value, length) != 0))
        i++;
    if (i == CLIP_MAPPED || !value[length])
        return option_wrong(o, value, allowed);
    diff_map *map = &m->maps[clip_mapped[i]];
    if (map->path)
        return console_error(EXIT_CODE_USAGE, "--%s %s: the metric has a map already, %s", o->name, value, map->path);
    map->path = value + length + 1;
    file_error error;
    if (output_file_check_kind(map->path, &error) != FILE_OK)
        return console_file_error(&error);
    map->format = picture_format_of(map->path);
    if (map->format != PICTURE_PNG && map->format != PICTURE_EXR && map->format != PICTURE_PFM)
        return option_wrong(o, value, allowed);
    const char *wrong = frame_path_parse(&map->name, map->path);
    if (wrong)
        return console_error(EXIT_CODE_USAGE, "--%s %s: %s", o->name, value, wrong);
    m->wanted = true;
    return EXIT_CODE_OK;
}

uint32_t diff_maps_metrics(const diff_maps *maps)
{
    uint32_t set = 0;
    for (int i = 0; i < CLIP_MAPPED; i++)
        if (maps->maps[clip_mapped[i]].path)
            set |= 1u << clip_mapped[i];
    return set;
}

/* Whether the errors of a metric have the greatest value 1. */
static bool is_bounded(clip_metric metric) { return metric == CLIP_FLIP || metric == CLIP_HDR_FLIP || metric == CLIP_SSIM; }

static output_options options_of(const diff_maps *maps) { return (output_options){.overwrite = maps->overwrite, .cancel = interrupt_flag()}; }

static int print_path(const diff_map *map, uint32_t frame, char path[PATH_SIZE])
{
    return frame_path_print(&map->name, frame, path, PATH_SIZE) ? EXIT_CODE_OK
                                                                : console_error(EXIT_CODE_USAGE, "--error-map %s: the path is too long", map->path);
}

static bool same_file(const char *a, const char *b)
{
    struct stat x, y;
    return stat(a, &x) == 0 && stat(b, &y) == 0 && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

/* Whether two paths name one file, which need not exist. */
static bool same_name(const char *a, const char *b)
{
    char folders[2][PATH_SIZE] = {"./", "./"};
    const char *const paths[] = {a, b};
    const char *names[2];
    for (int i = 0; i < 2; i++) {
        const char *slash = strrchr(paths[i], '/');
        names[i] = slash ? slash + 1 : paths[i];
        if (slash)
            snprintf(folders[i], sizeof folders[i], "%.*s", (int)(names[i] - paths[i]), paths[i]);
    }
    return strcmp(names[0], names[1]) == 0 && (strcmp(folders[0], folders[1]) == 0 || same_file(folders[0], folders[1]));
}

static int check_number(const diff_map *map, bool numbered)
{
    if (map->name.numbered == numbered)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--error-map %s: %s", map->path,
                         numbered ? "several frames are compared; number the files: flip_%04d.png" : "one picture is compared; leave the frame number out");
}

/* Checks the file of map `place` for a frame: it is no input and no other map. */
static int check_file(const diff_maps *maps, int place, uint32_t frame, const char *path, const frame_path *const inputs[DIFF_INPUTS])
{
    const diff_map *map = &maps->maps[clip_mapped[place]];
    char other[PATH_SIZE];
    for (int i = 0; i < DIFF_INPUTS; i++)
        if (inputs[i] && frame_path_print(inputs[i], frame, other, sizeof other) && same_file(other, path))
            return console_error(EXIT_CODE_USAGE, "--error-map %s: that picture is compared, as %s", map->path, other);
    for (int i = 0; i < place; i++)
        if (maps->maps[clip_mapped[i]].path && frame_path_print(&maps->maps[clip_mapped[i]].name, frame, other, sizeof other) && same_name(other, path))
            return console_error(EXIT_CODE_USAGE, "--error-map %s: two maps of one name", map->path);
    return EXIT_CODE_OK;
}

int diff_maps_check(const diff_maps *maps, bool numbered, const frame_list *frames, const frame_path *const inputs[DIFF_INPUTS])
{
    const output_options options = options_of(maps);
    for (int i = 0; i < CLIP_MAPPED; i++) {
        const diff_map *map = &maps->maps[clip_mapped[i]];
        int code = map->path ? check_number(map, numbered) : EXIT_CODE_OK;
        for (uint64_t f = 0; map->path && f < frame_list_length(frames) && code == EXIT_CODE_OK; f++) {
            char path[PATH_SIZE];
            file_error error;
            const uint32_t frame = frame_list_at(frames, f);
            code = print_path(map, frame, path);
            if (code == EXIT_CODE_OK)
                code = check_file(maps, i, frame, path, inputs);
            if (code == EXIT_CODE_OK && output_file_check(path, &options, &error) != FILE_OK)
                code = console_file_error(&error);
        }
        if (code != EXIT_CODE_OK)
            return code;
    }
    return EXIT_CODE_OK;
}

bool diff_maps_show_top(const diff_maps *maps)
{
    for (int i = 0; i < CLIP_MAPPED; i++)
        if (maps->maps[clip_mapped[i]].path && maps->maps[clip_mapped[i]].format == PICTURE_PNG && !is_bounded(clip_mapped[i]))
            return true;
    return false;
}

int diff_maps_prepare(diff_maps *maps, size_t pixels)
{
    for (int i = 0; i < CLIP_MAPPED; i++) {
        float **map = &maps->pixels.maps[clip_mapped[i]];
        if (maps->maps[clip_mapped[i]].path && !*map && !(*map = calloc(pixels, sizeof **map)))
            return console_error(EXIT_CODE_FAILED, "out of memory");
    }
    return EXIT_CODE_OK;
}

static file_status write_png(const char *path, uint32_t width, uint32_t height, const float *errors, double top, const metadata_list *metadata,
                             const output_options *options, file_error *error)
{
    uint8_t colors[ERROR_COLORS][3];
    const size_t count = (size_t)width * height;
    uint8_t *rgba = malloc(count * 4);
    if (!rgba)
        return file_error_set(error, FILE_MEMORY, "%s: out of memory", path);
    error_colors(colors);
    for (size_t i = 0; i < count; i++) {
        const double share = errors[i] / top;
        memcpy(rgba + 4 * i, colors[share < 1 ? (int)(share * (ERROR_COLORS - 1) + 0.5) : ERROR_COLORS - 1], 3);
        rgba[4 * i + 3] = 255;
    }
    const file_status status = picture_write_png(path, width, height, rgba, 0, metadata, options, error);
    free(rgba);
    return status;
}

static int write_map(const diff_maps *maps, clip_metric metric, const char *path, uint32_t width, uint32_t height, double score)
{
    const double top = maps->top > 0 && !is_bounded(metric) ? maps->top : 1;
    const diff_map *map = &maps->maps[metric];
    const number_text score_text = number_print(score), top_text = number_print(top);
    metadata_entry entries[4] = {{"mangata_version", mgt_version()}, {"error_map", clip_metric_name(metric)}};
    metadata_list metadata = {entries, 2};
    if (isfinite(score)) /* the flicker of a first frame has no score */
        entries[metadata.count++] = (metadata_entry){"score", score_text.text};
    if (map->format == PICTURE_PNG)
        entries[metadata.count++] = (metadata_entry){"brightest", top_text.text};
    const output_options options = options_of(maps);
    const float *errors = maps->pixels.maps[metric];
    const picture_layer layer = {.name = "color", .channels = 1, .pixels = errors};
    file_error error;
    const file_status status = map->format == PICTURE_PNG   ? write_png(path, width, height, errors, top, &metadata, &options, &error)
                               : map->format == PICTURE_EXR ? picture_write_exr(path, width, height, &layer, 1, &metadata, &options, &error)
                                                            : picture_write_pfm(path, width, height, &layer, &metadata, &options, &error);
    if (status == FILE_CANCELLED)
        return console_error(interrupt_exit_code(), "stopped by a signal");
    return status == FILE_OK ? EXIT_CODE_OK : console_file_error(&error);
}

int diff_maps_write(diff_maps *maps, uint32_t frame, uint32_t width, uint32_t height, const clip_scores *scores)
{
    for (int i = 0; i < CLIP_MAPPED; i++) {
        const clip_metric metric = clip_mapped[i];
        char path[PATH_SIZE];
        if (!maps->maps[metric].path)
            continue;
        int code = print_path(&maps->maps[metric], frame, path);
        if (code == EXIT_CODE_OK)
            code = write_map(maps, metric, path, width, height, scores->values[metric]);
        if (code != EXIT_CODE_OK)
            return code;
        if (!maps->files)
            maps->files = json_array();
        json_array_append_new(maps->files,
                              json_pack("{s:s, s:I, s:o}", "metric", clip_metric_name(metric), "frame", (json_int_t)frame, "file", console_json_text(path)));
    }
    return EXIT_CODE_OK;
}

void diff_maps_free(diff_maps *maps)
{
    for (int i = 0; i < CLIP_MAPPED; i++)
        free(maps->pixels.maps[clip_mapped[i]]);
    json_decref(maps->files);
    *maps = (diff_maps){.wanted = false};
}
