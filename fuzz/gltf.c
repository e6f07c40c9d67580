/* SPDX-License-Identifier: MIT
 *
 * The check of glTF files: text, or binary where it begins as such.
 */
#include "fuzz.h"
#include "scene/gltf_check.h"

void fuzz_input(const uint8_t *bytes, size_t size)
{
    model_fault fault = {0};
    uint64_t weight = 0;
    const bool binary = size >= 4 && memcmp(bytes, "glTF", 4) == 0;
    if (!gltf_check("/nowhere/fuzz.gltf", (const char *)bytes, size, binary, &weight, &fault))
        fuzz_require_message(fault.text);
}
