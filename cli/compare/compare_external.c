/* SPDX-License-Identifier: MIT */
/* External methods: their options, paths and checks. */
#include "cli/compare/compare_external.h"

#include <string.h>

#include "cli/common/interrupt.h"
#include "params/methods.h"

static bool is_name(const char *text, size_t length)
{
    static const char allowed[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-";
    return length >= 1 && length <= 40 && strspn(text, allowed) >= length && text[0] != '.' && text[0] != '-';
}

static bool is_taken(const compare_request *r, const char *name)
{
    mgt_quality quality;
    mgt_quality_init(&quality, sizeof quality);
    bool taken = strncmp(name, "reference", 9) == 0 || method_from_name(name, &quality);
    for (size_t m = 0; m < r->method_count; m++)
        taken = taken || strcmp(r->methods[m].name, name) == 0;
    return taken;
}

/* Returns what is wrong with the path; NULL: nothing. */
static const char *check_path(const compare_request *r, const char *path)
{
    frame_path name;
    const char *wrong = frame_path_parse(&name, path);
    const picture_format format = picture_format_of(path);
    if (wrong)
        return wrong;
    if (format != PICTURE_EXR && format != PICTURE_PFM)
        return "allowed are .exr and .pfm, which hold scene-linear light";
    if (!name.numbered && frame_list_length(&r->frames) > 1)
        return "several frames are compared; number the files: dir/%04d.exr";
    if (r->scene_count > 1 && !strstr(path, EXTERNAL_SCENE))
        return "several scenes are compared; write " EXTERNAL_SCENE " where the path holds the scene's name, such as dir/" EXTERNAL_SCENE "/%04d.exr";
    return NULL;
}

int compare_external_add(compare_request *r, const char *text)
{
    const size_t length = strcspn(text, "=");
    if (!text[length] || !is_name(text, length))
        return console_error(EXIT_CODE_USAGE, "--external %s: allowed is NAME=PATH, NAME of at most 40 letters, digits, _, . and -, such as mine=dir/%%04d.exr",
                             text);
    if (r->method_count == COMPARE_METHODS)
        return console_error(EXIT_CODE_USAGE, "--external: at most %d methods are allowed", COMPARE_METHODS);
    method_spec *spec = &r->methods[r->method_count];
    *spec = (method_spec){.given = quality_options_none()};
    memcpy(spec->name, text, length);
    memcpy(spec->file, text, length);
    if (is_taken(r, spec->name))
        return console_error(EXIT_CODE_USAGE, "--external %s: %s is the name of a method; give it one of its own", text, spec->name);
    const char *wrong = check_path(r, text + length + 1);
    if (wrong)
        return console_error(EXIT_CODE_USAGE, "--external %s: %s", text, wrong);
    r->external[r->method_count++] = text + length + 1;
    return EXIT_CODE_OK;
}

bool compare_external_path(const compare_job *job, const compare_scene *scene, size_t method, size_t frame, char path[COMPARE_PATH])
{
    const char *pattern = job->request->external[method];
    char text[COMPARE_PATH] = "";
    size_t used = 0;
    frame_path name;
    for (const char *p = pattern; *p;) {
        const bool here = strncmp(p, EXTERNAL_SCENE, strlen(EXTERNAL_SCENE)) == 0;
        const size_t length = here ? strlen(scene->name) : 1;
        if (used + length >= sizeof text)
            return console_error(0, "--external %s: the path is too long", pattern), false;
        memcpy(text + used, here ? scene->name : p, length);
        used += length;
        p += here ? strlen(EXTERNAL_SCENE) : 1;
    }
    text[used] = 0;
    if (!frame_path_parse(&name, text) && frame_path_print(&name, compare_frame_number(job, frame), path, COMPARE_PATH))
        return true;
    return console_error(0, "--external %s: the path is too long", pattern), false;
}

/* Finds out whether a file holds a layer with that many channels and the scene's size. Returns an exit code; errors are printed. */
static int look_for_layer(compare_job *job, const compare_scene *scene, const char *path, const char *layer, uint32_t channels, bool *found)
{
    float_image image;
    file_error error;
    const bool pfm = picture_format_of(path) == PICTURE_PFM; /* a .pfm file holds one layer, which has no name */
    const file_status status = picture_read(&image, path, layer, &error);
    *found = status == FILE_OK && image.channels == channels;
    if (status != FILE_OK)
        return status == FILE_ARGUMENT ? EXIT_CODE_OK : compare_file_failure(job, &error);
    const uint32_t width = image.width, height = image.height, own = image.channels;
    float_image_free(&image);
    if (width != scene->width || height != scene->height)
        return console_error(EXIT_CODE_FAILED, "%s has %u x %u pixels, %s is compared at %u x %u; --size changes that", path, width, height, scene->name,
                             scene->width, scene->height);
    return *found || (pfm && (own == 1 || own == 3))
               ? EXIT_CODE_OK
               : console_error(EXIT_CODE_BAD_INPUT, "%s: the layer %s has %u channel%s; allowed: %u", path, layer, own, own == 1 ? "" : "s", channels);
}

static int check_frame(compare_job *job, compare_scene *scene, size_t method, size_t frame)
{
    compare_result *result = &scene->results[method];
    char path[COMPARE_PATH];
    bool coverage, color;
    if (!compare_external_path(job, scene, method, frame, path))
        return EXIT_CODE_USAGE;
    int code = look_for_layer(job, scene, path, "coverage", 1, &coverage);
    if (code == EXIT_CODE_OK)
        code = look_for_layer(job, scene, path, "color", 3, &color);
    if (code != EXIT_CODE_OK)
        return code;
    if (!coverage && !color)
        return console_error(EXIT_CODE_BAD_INPUT, "%s: it holds neither color (channels R, G, B) nor coverage (channel coverage.Y)", path);
    if (frame > 0 && (coverage == result->lacks_coverage || color == result->lacks_color))
        return console_error(EXIT_CODE_BAD_INPUT, "%s: it does not hold the layers that the first frame holds", path);
    result->lacks_coverage = !coverage;
    result->lacks_color = !color;
    return EXIT_CODE_OK;
}

/* A limit of a method without coverage could never be kept. */
static int check_gates(const compare_job *job)
{
    for (size_t s = 0; s < job->request->scene_count; s++)
        for (size_t i = 0; i < job->request->gate_count; i++) {
            const compare_gate *gate = &job->request->gates[i];
            if (job->scenes[s].results[gate->method].lacks_coverage)
                return console_error(EXIT_CODE_USAGE, "--%s %s: its pictures of %s hold no coverage, whose error is limited",
                                     gate->flicker ? "max-flicker" : "max-rmse", job->request->methods[gate->method].name, job->scenes[s].name);
        }
    return EXIT_CODE_OK;
}

int compare_external_check(compare_job *job)
{
    const compare_request *r = job->request;
    for (size_t s = 0; s < r->scene_count; s++)
        for (size_t m = 0; m < r->method_count; m++)
            for (size_t frame = 0; frame < job->frame_count && compare_is_external(r, m); frame++) {
                const int code = *interrupt_flag() ? compare_stopped(job) : check_frame(job, &job->scenes[s], m, frame);
                if (code != EXIT_CODE_OK)
                    return code;
            }
    return check_gates(job);
}
