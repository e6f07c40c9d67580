/* SPDX-License-Identifier: MIT
 *
 * Wave spectra: plain tables, and files in the formats of buoy networks.
 */
#include <math.h>

#include "fuzz.h"
#include "scene/buoy_files.h"
#include "scene/spectrum_table_read.h"

static void read_table(const char *text, size_t length)
{
    spectrum_table table;
    scene_error error;
    if (!spectrum_table_parse(&table, text, length, "fuzz.txt", &error)) {
        fuzz_require_message(error.text);
        return;
    }
    for (int i = 0; i < 8; i++) {
        fuzz_require(isfinite(spectrum_table_density(&table, 0.3 * i)) && spectrum_table_density(&table, 0.3 * i) >= 0, "a density is negative or not finite");
        fuzz_require(spectrum_table_at(&table, 0.3 * i, 0.9 * i) >= 0, "a density is negative or not a number");
    }
    fuzz_require(isfinite(spectrum_table_mean_azimuth(&table)), "the mean direction is not finite");
    spectrum_table_free(&table);
}

void fuzz_input(const uint8_t *bytes, size_t size)
{
    scene_error error;
    scene_place place;
    char *text = fuzz_text(bytes, size);
    read_table((const char *)bytes, size);
    if (scene_text_is_clean(text, size, &place)) {
        const buoy_format format = buoy_format_of(text);
        char *table = format != BUOY_TABLE ? buoy_file_convert(format, "41002.data_spec", text, &error) : NULL;
        if (table != NULL)
            read_table(table, strlen(table));
        else if (format != BUOY_TABLE)
            fuzz_require_message(error.text);
        free(table);
    }
    free(text);
}
