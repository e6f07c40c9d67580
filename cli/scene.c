/* SPDX-License-Identifier: MIT */
/* `mangata scene check FILE…` and `mangata scene schema`. */
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/options.h"
#include "cli/common/verbs.h"
#include "scene/scene_text.h"

typedef struct scene_request {
    console out;
    const char **words; /* has room for every argument */
    size_t word_count;
    scene_changes changes;
} scene_request;

/* Checks whether each frame can be rendered, which only the library knows. */
static int check_frames(const scene_file *scene, const char *path, scene_error *error)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_NULL;
    mgt_context *context = NULL;
    mgt_status status = mgt_context_create(&context, &desc);
    if (status != MGT_OK) {
        snprintf(error->text, sizeof error->text, "%s", mgt_last_error(NULL));
        return exit_code_of_status(status);
    }
    int code = EXIT_CODE_OK;
    for (int frame = 0; frame < scene_file_frame_count(scene) && code == EXIT_CODE_OK; frame++) {
        mgt_scene one;
        if (!scene_file_frame(scene, frame, &one)) {
            snprintf(error->text, sizeof error->text, "%.300s: the camera of frame %d is not a legal one", path, frame);
            code = EXIT_CODE_BAD_INPUT;
        } else if ((status = mgt_scene_check(context, &one)) != MGT_OK) {
            snprintf(error->text, sizeof error->text, "%.200s: frame %d: %.280s", path, frame, mgt_last_error(context));
            code = exit_code_of_status(status);
        }
    }
    mgt_context_destroy(context);
    return code;
}

static json_t *describe(const scene_file *scene, const char *path)
{
    mgt_scene first;
    if (!scene_file_frame(scene, 0, &first))
        return NULL;
    const char *warning = scene_file_warning(scene);
    return json_pack("{s:o, s:b, s:o, s:i, s:i, s:i, s:f, s:f, s:I, s:o}", "file", console_json_text(path), "ok", 1, "description",
                     console_json_text(scene_file_description(scene)), "width", (int)first.image.width, "height", (int)first.image.height, "frames",
                     scene_file_frame_count(scene), "fps", scene_file_fps(scene), "start", scene_file_start(scene), "waves",
                     (json_int_t)scene_file_wave_count(scene), "warning", warning[0] ? console_json_text(warning) : json_null());
}

static int check_file(const scene_request *r, const char *path, json_t *list)
{
    scene_error error = {0};
    scene_file *scene = scene_file_open(path, r->changes.items, r->changes.count, &error);
    int code = EXIT_CODE_OK;
    if (!scene) {
        console_scene_error(&error);
        code = exit_code_of_scene_error(error.kind);
    } else if ((code = check_frames(scene, path, &error)) != EXIT_CODE_OK) {
        error.kind = SCENE_ERROR_BAD_SCENE;
        console_scene_error(&error);
    }
    if (code == EXIT_CODE_OK && scene_file_warning(scene)[0])
        console_note(&r->out, "warning: %s", scene_file_warning(scene));
    if (list)
        json_array_append_new(list, code == EXIT_CODE_OK
                                        ? describe(scene, path)
                                        : json_pack("{s:o, s:b, s:o}", "file", console_json_text(path), "ok", 0, "error", console_json_text(error.text)));
    else if (code == EXIT_CODE_OK && !r->out.quiet) {
        char name[PATH_MAX];
        scene_copy_line(name, sizeof name, path, strlen(path));
        const size_t waves = scene_file_wave_count(scene);
        const int frames = scene_file_frame_count(scene);
        printf("%s: ok, %zu wave%s, %d frame%s\n", name, waves, waves == 1 ? "" : "s", frames, frames == 1 ? "" : "s");
    }
    scene_file_free(scene);
    return code;
}

static int check_files(const scene_request *r)
{
    json_t *list = r->out.json ? json_array() : NULL;
    int code = EXIT_CODE_OK;
    for (size_t i = 1; i < r->word_count; i++) {
        const int one = check_file(r, r->words[i], list);
        if (code == EXIT_CODE_OK)
            code = one;
    }
    const int printed = r->out.json ? console_print_json(list) : EXIT_CODE_OK;
    return code == EXIT_CODE_OK ? printed : code;
}

static int print_schema(void)
{
    if (scene_schema_write(stdout))
        return EXIT_CODE_OK;
    /* console_finish() reports that writing has failed. */
    return ferror(stdout) ? EXIT_CODE_CANNOT_WRITE : console_error(EXIT_CODE_FAILED, "cannot make the schema: %s", strerror(errno));
}

static int add_word(const option *o, void *place, const char *value)
{
    scene_request *r = place;
    (void)o;
    r->words[r->word_count++] = value;
    return EXIT_CODE_OK;
}

static int run(void *request)
{
    const scene_request *r = request;
    if (r->word_count == 1 && strcmp(r->words[0], "schema") == 0)
        return print_schema();
    if (r->word_count == 0 || strcmp(r->words[0], "check") != 0)
        return console_error(EXIT_CODE_USAGE, "mangata scene takes check FILE or schema; see mangata scene --help");
    if (r->word_count == 1)
        return console_error(EXIT_CODE_USAGE, "no scene given: mangata scene check FILE");
    return check_files(r);
}

static const option check_options[] = {
    OPTION_SEA,
    {"set", 0, "KEY=VALUE", "check the scene with this value changed; may be repeated", .set = option_change, .offset = offsetof(scene_request, changes)},
};

static const option_table scene_table = {"scene",
                                         "check FILE... [options]\n       mangata scene schema",
                                         "check: reads scene files and reports what is wrong as file:line:column: message.\n"
                                         "schema: prints the JSON Schema of scene files.",
                                         check_options,
                                         sizeof check_options / sizeof check_options[0],
                                         .notes = "exit codes: 0 all is well, 64 usage, 65 bad scene, 66 no such file, 69 method and scene do not go together",
                                         .operand = {.set = add_word},
                                         .changes = offsetof(scene_request, changes),
                                         .run = run};

int verb_scene(int count, char **arguments)
{
    scene_request request = {.words = calloc((size_t)count + 1, sizeof *request.words)};
    const int code = request.words ? options_run(&scene_table, &request, count, arguments) : console_error(EXIT_CODE_FAILED, "out of memory");
    free(request.words);
    return code;
}
