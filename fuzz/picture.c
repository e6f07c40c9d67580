/* SPDX-License-Identifier: MIT
 *
 * Pictures that `diff` reads: EXR, PFM and PNG, with their metadata, and whether they are whole.
 */
#define _GNU_SOURCE /* memfd_create */

#include <sys/mman.h>
#include <unistd.h>

#include "fuzz.h"
#include "image/file_whole.h"
#include "image/metadata.h"
#include "image/picture.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static const char *const layers[] = {NULL, "color", "depth", "coverage"};
    char path[64];
    file_error error = {0};
    char *value = NULL;
    file_state state;
    const int descriptor = memfd_create("fuzz", MFD_CLOEXEC);
    fuzz_require(descriptor >= 0 && write(descriptor, bytes, size) == (ssize_t)size, "no memory file");
    setenv("MANGATA_PIXELS", "1048576", 1);
    snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
    for (int i = 0; i < 4; i++) {
        float_image image;
        if (picture_read(&image, path, layers[i], &error) != FILE_OK)
            fuzz_require_message(error.text);
        float_image_free(&image);
    }
    if (metadata_read(path, "render_hash", &value, &error) != FILE_OK)
        fuzz_require_message(error.text);
    free(value);
    file_state_read(path, "render_hash", "abc", true, &state, &error);
    close(descriptor);
    return 0;
}
