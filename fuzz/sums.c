/* SPDX-License-Identifier: MIT
 *
 * Files of sums, which `merge` and --checkpoint read.
 */
#define _GNU_SOURCE /* memfd_create */

#include "fuzz_file.h"
#include "image/sums_file.h"

enum { PIXELS_MOST = 4096 };

static void read_sums(const char *path)
{
    static uint64_t sums[PIXELS_MOST * SUMS_WORDS];
    sums_file file;
    file_error error = {0};
    if (sums_open(&file, path, &error) != FILE_OK) {
        fuzz_require_message(error.text);
        return;
    }
    uint64_t end = 0;
    for (size_t i = 0; i < file.ranges.count; i++) {
        const sums_range *range = &file.ranges.items[i];
        fuzz_require(range->count > 0 && (i == 0 || range->first > end), "ranges that touch or are out of order");
        end = range->first + range->count;
    }
    fuzz_require(end > 0, "no samples");
    fuzz_require(sums_add(&file, file.width + 1, file.height, sums, &error) == FILE_BAD, "sums of another size are taken");
    if ((uint64_t)file.width * file.height <= PIXELS_MOST && sums_add(&file, file.width, file.height, sums, &error) != FILE_OK)
        fuzz_require_message(error.text);
    sums_close(&file);
}

void fuzz_input(const uint8_t *bytes, size_t size)
{
    const fuzz_file file = fuzz_file_open(bytes, size);
    read_sums(file.path);
    fuzz_file_close(&file);
}
