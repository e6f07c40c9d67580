/* SPDX-License-Identifier: MIT
 *
 * Pictures that `diff` reads: EXR, PFM and PNG, with their metadata, and whether they are whole.
 */
#define _GNU_SOURCE /* memfd_create */

#include "fuzz_file.h"
#include "image/picture.h"

void fuzz_input(const uint8_t *bytes, size_t size)
{
    static const char *const layers[] = {NULL, "color", "depth", "coverage"};
    const fuzz_file file = fuzz_file_open(bytes, size);
    file_error error = {0};
    setenv("MANGATA_PIXELS", "1048576", 1);
    for (int i = 0; i < 4; i++) {
        float_image image;
        if (picture_read(&image, file.path, layers[i], &error) != FILE_OK)
            fuzz_require_message(error.text);
        float_image_free(&image);
    }
    fuzz_file_close(&file);
}
