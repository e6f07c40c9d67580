/* SPDX-License-Identifier: MIT
 *
 * Overrides, one a line, on a scene with something of everything.
 */
#include "fuzz.h"
#include "scene/scene_file.h"

static const char base[] = "mangata: 1\nimage: {width: 64, height: 36}\ncamera: {position: [0, 4, 0], target: [0, 3, -9], up: [0, 1, 0], fov_y_deg: 50}\n"
                           "time: {start: 1, fps: 30, frames: 2}\nlight: {body: sun, elevation_deg: 18}\nsky: {model: atmosphere}\n"
                           "water: {waves: [{amplitude: 0.02, a: 1.5, b: 0.3, c: -3.8, phase: 0.7}, {amplitude: 0.01, a: 2, b: 1, c: 4}]}\n"
                           "objects: [{shape: box, position: [0, -1, -5]}, {shape: steps, count: 3}]\n";

void fuzz_input(const uint8_t *bytes, size_t size)
{
    enum { WORDS = 16, BYTES = 4096 };
    const char *words[WORDS];
    size_t count = 0;
    char *state = NULL;
    scene_error error;
    if (size > BYTES)
        return;
    char *text = fuzz_text(bytes, size);
    for (char *line = strtok_r(text, "\n", &state); line != NULL && count < WORDS; line = strtok_r(NULL, "\n", &state))
        if (strstr(line, "triangles") == NULL)
            words[count++] = line;
    scene_file *file = scene_file_parse(base, sizeof base - 1, "fuzz.yaml", words, count, &error);
    if (file == NULL)
        fuzz_require_message(error.text);
    scene_file_free(file);
    free(text);
}
