/* SPDX-License-Identifier: MIT
 *
 * The check of OBJ files.
 */
#include "fuzz.h"
#include "scene/obj_check.h"

void fuzz_input(const uint8_t *bytes, size_t size)
{
    model_fault fault = {0};
    if (!obj_check("fuzz.obj", (const char *)bytes, size, &fault))
        fuzz_require_message(fault.text);
}
