/* SPDX-License-Identifier: MIT
 *
 * Textures from PNG and JPEG files.
 */
#include "fuzz.h"
#include "scene/model.h"

void fuzz_input(const uint8_t *bytes, size_t size)
{
    model_fault fault = {0};
    /* What is left of the budget: a million pixels, as larger ones only take longer. */
    uint64_t hash, pixels = (1 << 25) - (1 << 20);
    mgt_texture *texture = texture_parse(bytes, size, "fuzz.png", &pixels, &hash, &fault);
    if (texture == NULL)
        fuzz_require_message(fault.text);
    mgt_texture_destroy(texture);
}
