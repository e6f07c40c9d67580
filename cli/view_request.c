/* SPDX-License-Identifier: MIT */
/* The command line of `mangata view` and of mangata-viewer. */
#include "cli/view_request.h"

#include "cli/common/options.h"

static const option view_options[] = {
    OPTION_SEA,
    {"backend", 0, "NAME",
     "auto (default: OpenGL where there is hardware for it, else the\n"
     "CPU), cpu or gl",
     .set = option_drawing_backend, .offset = offsetof(view_request, context), .allowed = "auto, cpu or gl"},
    {"method", 0, OPTION_VALUE_METHOD, "of side A: one of the methods below (default mangata)", .set = option_quality,
     .offset = offsetof(view_request, quality)},
    {"size", 0, "WxH", "size of the window and of the picture instead of the scene's", .set = option_size, .offset = offsetof(view_request, changes),
     .least = 1, .allowed = "WxH, each from 1 to 32768 pixels, such as 1280x720"},
    {"set", 0, "KEY=VALUE",
     "change a value of the scene, e.g. light.elevation_deg=3;\n"
     "may be repeated",
     .set = option_change, .offset = offsetof(view_request, changes)},
    CONTEXT_OPTION_THREADS(view_request),
    CONTEXT_OPTION_ISA(view_request),
    {"script", 0, "FILE", "run a script of the viewer (docs/viewer.md)", .set = option_text, .offset = offsetof(view_request, script)},
    {"shaders", 0, "DIR",
     "OpenGL: kernel files that replace the built-in ones, and are\n"
     "read again when they change",
     .set = option_text, .offset = offsetof(view_request, shader_folder)},
};

static const option_table view_table =
    {"view",
     "[SCENE] [options]",
     "Opens a scene, or without one a sea of some wind, in the interactive viewer, the program mangata-viewer.",
     view_options,
     sizeof view_options / sizeof view_options[0],
     .notes = "exit codes: 0 done, 1 failed, 64 usage, 65 bad scene, 66 no such input, 69 no viewer, no display\nor no such backend",
     .operand = {.set = option_one_scene, .offset = offsetof(view_request, scene_path)},
     .quality = offsetof(view_request, quality),
     .changes = offsetof(view_request, changes)};

int view_request_read(view_request *request, int count, char **arguments)
{
    *request = (view_request){.context.backend = MGT_BACKEND_AUTO, .quality = quality_options_none()};
    const int code = options_read(&view_table, request, count, arguments);
    if (!request->scene_path)
        request->scene_path = "--sea wind=8";
    return code;
}

void view_request_free(view_request *request) { scene_changes_free(&request->changes); }
