/* SPDX-License-Identifier: MIT
 *
 * Command lines: words, one a line, read by a table of the options that verbs share, and each word as frames, a path and a method.
 */
#include "cli/common/frames.h"
#include "cli/common/method_spec.h"
#include "cli/common/options.h"
#include "cli/common/progress.h"
#include "fuzz.h"
#include "scene/scene_file.h"

typedef struct fuzz_request {
    console out;
    scene_changes changes;
    quality_options quality;
    frame_list frames;
    const char *scene, *text;
    uint64_t number;
    bool flag;
    progress_mode progress;
} fuzz_request;

static const option options[] = {
    OPTION_SEA,
    {"frames", 0, "LIST", "frames", .set = option_frames, .offset = offsetof(fuzz_request, frames)},
    {"output", 'o', "OUT", "output", .set = option_text, .offset = offsetof(fuzz_request, text)},
    {"size", 0, "WxH", "size", .set = option_size, .offset = offsetof(fuzz_request, changes), .least = 1, .allowed = "WxH"},
    {"set", 0, "KEY=VALUE", "change", .set = option_change, .offset = offsetof(fuzz_request, changes)},
    {"threads", 0, "N", "threads", .set = option_number, .offset = offsetof(fuzz_request, number), .least = 1, .most = 1024},
    {"overwrite", 0, NULL, "replace", .set = option_given, .offset = offsetof(fuzz_request, flag)},
    {"progress", 0, "MODE", "progress", .set = option_progress, .offset = offsetof(fuzz_request, progress)},
};
static const option_table table = {"fuzz",
                                   "SCENE",
                                   "Reads words.",
                                   options,
                                   sizeof options / sizeof *options,
                                   .operand = {.set = option_one_scene, .offset = offsetof(fuzz_request, scene)},
                                   .quality = offsetof(fuzz_request, quality),
                                   .changes = offsetof(fuzz_request, changes)};

static void read_word(const char *word)
{
    frame_list list;
    frame_path *path = malloc(sizeof *path);
    method_spec spec;
    char text[256], wrong[600];
    fuzz_require(path != NULL, "out of memory");
    if (frame_list_parse(&list, word) == NULL) {
        const uint64_t length = frame_list_length(&list);
        fuzz_require(length > 0 && frame_list_at(&list, 0) <= frame_list_at(&list, length - 1), "frames out of order");
        frame_list_print(&list, text, sizeof text);
    }
    if (frame_path_parse(path, word) == NULL)
        frame_path_print(path, 7, text, sizeof text);
    if (!method_spec_parse(&spec, word, strlen(word), wrong, sizeof wrong))
        fuzz_require_message(wrong);
    free(path);
}

void fuzz_input(const uint8_t *bytes, size_t size)
{
    enum { WORDS = 32, BYTES = 4096 };
    char *words[WORDS + 1], *state = NULL;
    int count = 0;
    if (size > BYTES)
        return;
    fuzz_request *request = calloc(1, sizeof *request);
    char *text = fuzz_text(bytes, size);
    fuzz_require(request != NULL, "out of memory");
    request->quality = quality_options_none();
    for (char *word = strtok_r(text, "\n", &state); word != NULL && count < WORDS; word = strtok_r(NULL, "\n", &state)) {
        read_word(word);
        if (strcmp(word, "--help") != 0 && strcmp(word, "-h") != 0)
            words[count++] = word;
    }
    words[count] = NULL;
    if (options_read(&table, request, count, words) == 0 && request->scene != NULL && strncmp(request->scene, "--sea ", 6) == 0) {
        scene_error error;
        scene_file *file = scene_file_open(request->scene, request->changes.items, request->changes.count, &error);
        if (file == NULL)
            fuzz_require_message(error.text);
        scene_file_free(file);
    }
    scene_changes_free(&request->changes);
    free(request);
    free(text);
}
