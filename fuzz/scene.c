/* SPDX-License-Identifier: MIT
 *
 * Scene files with overrides: a text, and behind a line "%%" one override a line. What is accepted is rendered at 8 x 8 by one method after the other, written
 * and read again.
 */
#include <math.h>

#include "fuzz.h"
#include "params/methods.h"
#include "scene/scene_edit.h"

enum { OVERRIDES = 16, SIDE = 8, OBJECTS = 100, INPUT_BYTES = 1 << 16 };

/* Scenes of millions of triangles are legal, and no matter for a fuzzer. */
static bool is_large(const char *text)
{
    size_t digits = 0, most = 0;
    for (const char *p = text; *p != '\0'; p++) {
        digits = *p >= '0' && *p <= '9' ? digits + 1 : 0;
        most = digits > most ? digits : most;
    }
    return (strstr(text, "triangles") != NULL || strstr(text, "count") != NULL) && most >= 5;
}

static void render(const scene_file *file, size_t turn)
{
    static mgt_context *context;
    float rgb[SIDE * SIDE * 3];
    mgt_scene scene;
    mgt_target target;
    if (!scene_file_frame(file, 0, &scene))
        return;
    if (context == NULL) {
        mgt_context_desc desc;
        mgt_context_desc_init(&desc, sizeof desc);
        desc.threads = 1;
        fuzz_require(mgt_context_create(&context, &desc) == MGT_OK, "no context");
    }
    if (scene.object_count > OBJECTS)
        return;
    scene.image = (mgt_image){.width = SIDE, .height = SIDE};
    const mgt_method method = (mgt_method)(turn % method_count);
    mgt_quality quality;
    mgt_quality_init(&quality, sizeof quality);
    quality.method = method;
    quality.spatial_samples = quality.time_samples = method == MGT_METHOD_SSAA || method == MGT_METHOD_REFERENCE ? 2 : 1;
    scene.quality = quality;
    mgt_target_init(&target, sizeof target);
    target.layer = MGT_LAYER_COLOR;
    target.format = MGT_FORMAT_RGB32F;
    target.pixels = rgb;
    const mgt_status status = mgt_render(context, &scene, &target, 1);
    if (status == MGT_ERROR_SCENE || status == MGT_ERROR_UNSUPPORTED)
        return;
    fuzz_require(status == MGT_OK, mgt_last_error(context));
    for (int i = 0; i < SIDE * SIDE * 3; i++)
        fuzz_require(isfinite(rgb[i]) && rgb[i] >= 0, "a pixel is negative or no finite number");
}

static void read_again(const scene_file *file)
{
    scene_values values;
    scene_error error;
    char *text = NULL;
    size_t size = 0;
    fuzz_require(scene_values_copy(&values, scene_file_values(file)), "out of memory");
    FILE *stream = open_memstream(&text, &size);
    fuzz_require(stream != NULL && scene_values_write(stream, &values) && fclose(stream) == 0, "a scene cannot be written");
    scene_file *again = scene_file_parse_like(&values, text, size, "again.yaml", NULL, 0, &error);
    if (again == NULL)
        fprintf(stderr, "%s\n%s\n", error.text, text);
    fuzz_require(again != NULL, "a scene that was written cannot be read");
    char *before = scene_file_canonical(file, NULL), *after = scene_file_canonical(again, NULL);
    fuzz_require(before != NULL && after != NULL, "out of memory");
    if (strcmp(before, after) != 0)
        fprintf(stderr, "%s\n----\n%s\n", before, after);
    fuzz_require(strcmp(before, after) == 0, "a scene that was written reads as another");
    free(before);
    free(after);
    free(text);
    scene_values_free(&values);
    scene_file_free(again);
}

void fuzz_input(const uint8_t *bytes, size_t size)
{
    const char *overrides[OVERRIDES];
    size_t count = 0, turn = size;
    scene_error error;
    if (size > INPUT_BYTES)
        return;
    char *text = fuzz_text(bytes, size), *mark = strstr(text, "\n%%\n");
    size_t length = mark != NULL ? (size_t)(mark - text) + 1 : size;
    for (size_t i = 0; i < size; i++)
        turn = turn * 31 + bytes[i];
    if (mark != NULL) {
        char *state = NULL;
        for (char *line = strtok_r(mark + 4, "\n", &state); line != NULL && count < OVERRIDES; line = strtok_r(NULL, "\n", &state))
            overrides[count++] = line;
    }
    scene_file *file = is_large(text) ? NULL : scene_file_parse(text, length, "fuzz.yaml", overrides, count, &error);
    if (file != NULL) {
        render(file, turn);
        read_again(file);
    } else if (!is_large(text)) {
        fuzz_require_message(error.text);
    }
    scene_file_free(file);
    free(text);
}
