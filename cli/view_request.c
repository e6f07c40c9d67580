/* SPDX-License-Identifier: MIT */
/* The command line of `mangata view` and of mangata-viewer. */
#include "cli/view_request.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/common/options.h"
#include "params/methods.h"

enum { OPT_BACKEND, OPT_METHOD, OPT_SIZE, OPT_SET, OPT_THREADS, OPT_ISA, OPT_SCRIPT, OPT_SHADERS };

static const option view_options[] = {
    [OPT_BACKEND] = {"backend", 0, "NAME",
                     "auto (default: OpenGL where there is hardware for it, else the\n"
                     "CPU), cpu or gl"},
    [OPT_METHOD] = {"method", 0, OPTION_VALUE_METHOD, "of side A: one of the methods below (default mangata)"},
    [OPT_SIZE] = {"size", 0, "WxH", "size of the window and of the picture instead of the scene's"},
    [OPT_SET] = {"set", 0, "KEY=VALUE",
                 "change a value of the scene, e.g. light.elevation_deg=3;\n"
                 "may be repeated"},
    [OPT_THREADS] = CONTEXT_OPTION_THREADS,
    [OPT_ISA] = CONTEXT_OPTION_ISA,
    [OPT_SCRIPT] = {"script", 0, "FILE", "run a script of the viewer (docs/viewer.md)"},
    [OPT_SHADERS] = {"shaders", 0, "DIR",
                     "OpenGL: kernel files that replace the built-in ones, and are\n"
                     "read again when they change"},
};

static const option_table view_table =
    {"view",
     "SCENE [options]",
     "Opens a scene in the interactive viewer, the program mangata-viewer.",
     view_options,
     sizeof view_options / sizeof view_options[0],
     .notes = "exit codes: 0 done, 1 failed, 64 usage, 65 bad scene, 66 no such input, 69 no viewer, no display\nor no such backend",
     .quality = true};

static int bad_value(size_t id, const char *value, const char *allowed)
{
    return console_error(EXIT_CODE_USAGE, "--%s %s: allowed is %s", view_options[id].name, value, allowed);
}

static int set_quality(view_request *r, const char *name, const char *value)
{
    char wrong[600];
    bool known;
    return quality_option_set(&r->quality, name, strlen(name), value, &known, wrong, sizeof wrong) ? EXIT_CODE_OK : console_error(EXIT_CODE_USAGE, "%s", wrong);
}

static int set_option(view_request *r, int id, const char *value)
{
    uint64_t side[2];
    switch (id) {
    case OPT_BACKEND:
        if (!mgt_backend_from_name(value, &r->context.backend) || r->context.backend == MGT_BACKEND_NULL)
            return bad_value(OPT_BACKEND, value, "auto, cpu or gl");
        break;
    case OPT_METHOD:
        return set_quality(r, view_options[id].name, value);
    case OPT_SIZE:
        if (!number_parse_list(value, 'x', MGT_MAX_IMAGE_SIDE, 2, side) || side[0] == 0 || side[1] == 0)
            return bad_value(OPT_SIZE, value, "WxH, each from 1 to 32768 pixels, such as 1280x720");
        r->width = (uint32_t)side[0];
        r->height = (uint32_t)side[1];
        break;
    case OPT_SET:
        r->overrides[r->override_count++] = value;
        break;
    case OPT_THREADS:
    case OPT_ISA: {
        const char *allowed = context_option_set(&r->context, view_options[id].name, value);
        return allowed ? bad_value((size_t)id, value, allowed) : EXIT_CODE_OK;
    }
    case OPT_SCRIPT:
        r->script = value;
        break;
    case OPT_SHADERS:
        r->shader_folder = value;
        break;
    default:
        return set_quality(r, quality_fields[id - OPTION_QUALITY].key, value);
    }
    return EXIT_CODE_OK;
}

int view_request_read(view_request *request, int count, char **arguments)
{
    view_request *r = request;
    *r = (view_request){.context.backend = MGT_BACKEND_AUTO, .quality = quality_options_none()};
    /* Each --set takes a word of the command line; two more hold the size. */
    r->overrides = calloc((size_t)count + 2, sizeof *r->overrides);
    if (!r->overrides)
        return console_error(EXIT_CODE_FAILED, "out of memory");
    option_reader reader = option_reader_start(&view_table, &r->out, count, arguments);
    const char *value = NULL;
    int id;
    while ((id = option_reader_next(&reader, &value)) != OPTION_END) {
        if (id == OPTION_HELP)
            return -1;
        if (id == OPTION_ERROR)
            return EXIT_CODE_USAGE;
        if (id == OPTION_OPERAND && r->scene_path)
            return console_error(EXIT_CODE_USAGE, "one scene at a time: %s and %s are given", r->scene_path, value);
        if (id == OPTION_OPERAND) {
            r->scene_path = value;
            continue;
        }
        const int code = set_option(r, id, value);
        if (code != EXIT_CODE_OK)
            return code;
    }
    if (!r->scene_path)
        return console_error(EXIT_CODE_USAGE, "no scene given: mangata view SCENE");
    if (r->width) {
        snprintf(r->size_words[0], sizeof r->size_words[0], "image.width=%u", r->width);
        snprintf(r->size_words[1], sizeof r->size_words[1], "image.height=%u", r->height);
        r->overrides[r->override_count++] = r->size_words[0];
        r->overrides[r->override_count++] = r->size_words[1];
    }
    return EXIT_CODE_OK;
}

void view_request_free(view_request *request)
{
    free(request->overrides);
    request->overrides = NULL;
}
