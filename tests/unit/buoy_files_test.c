/* SPDX-License-Identifier: MIT */
/* Files of NDBC and Datawell against sums of their own numbers; bad ones. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/spectrum_table_read.h"

static const double PI = 3.14159265358979323846;

static char folder[] = "/tmp/mangata-buoys-XXXXXX";

static const char *in_folder(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_text(const char *name, const char *text)
{
    FILE *stream = fopen(in_folder(name), "wb");
    assert_non_null(stream);
    fputs(text, stream);
    assert_int_equal(fclose(stream), 0);
}

static spectrum_table load(const char *name)
{
    spectrum_table table;
    scene_error error;
    if (!spectrum_table_load(&table, in_folder(name), &error))
        fail_msg("%s", error.text);
    return table;
}

/* The share at the angle φ in degrees that waves of a row come from, per radian. */
static double share(const spectrum_table *table, size_t row, double from)
{
    const double azimuth = (from + 180) * PI / 180;
    return spectrum_table_at(table, table->rows[row].frequency, azimuth) / table->rows[row].density;
}

static const char *const real_time[][2] = {
    {"46042.data_spec", "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) spec_3 (freq_3) ... >\n"
                        "2026 01 31 12 40 0.117 0.500 (0.033) 8.000 (0.070) 2.000 (0.100) 0.250 (0.200)\n"
                        "2026 01 31 11 40 9.999 9.000 (0.033) 9.000 (0.070) 9.000 (0.100) 9.000 (0.200)\n"},
    {"46042.swdir", "#YY  MM DD hh mm alpha1_1 (freq_1) alpha1_2 (freq_2) alpha1_3 (freq_3) ... >\n"
                    "2026 01 31 13 40 1.0 (0.033) 1.0 (0.070) 1.0 (0.100) 1.0 (0.200)\n"
                    "2026 01 31 12 40 999.0 (0.033) 290.0 (0.070) 310.0 (0.100) 20.0 (0.200)\n"},
    {"46042.swdir2", "#YY  MM DD hh mm alpha2_1 (freq_1) ... >\n2026 01 31 12 40 999.0 (0.033) 292.0 (0.070) 300.0 (0.100) 40.0 (0.200)\n"},
    {"46042.swr1", "#YY  MM DD hh mm r1_1 (freq_1) ... >\n2026 01 31 12 40 999.00 (0.033) 0.90 (0.070) 0.60 (0.100) 0.30 (0.200)\n"},
    {"46042.swr2", "#YY  MM DD hh mm r2_1 (freq_1) ... >\n2026 01 31 12 40 999.00 (0.033) 0.40 (0.070) 0.20 (0.100) MM (0.200)\n"},
};

static const char *const archived[][2] = {
    {"46042w2025.txt",
     "\xef\xbb\xbf#YY  MM DD hh mm   .0330  .0700  .1000  .2000\r\n2026 01 31 12 40   0.50   8.00   2.00   0.25\r\n2026 01 31 13 40 1 1 1 1\r\n"},
    {"46042d2025.txt", "#YY  MM DD hh mm   .0330  .0700  .1000  .2000\n2026 01 31 12 40 999.0 290.0 310.0 20.0\n"},
    {"46042i2025.txt", "#YY  MM DD hh mm   .0330  .0700  .1000  .2000\n2026 01 31 12 40 999.0 292.0 300.0 40.0\n"},
    {"46042j2025.txt", "\xef\xbb\xbf#YY  MM DD hh mm   .0330  .0700  .1000  .2000\n2026 01 31 12 40 999.0 90.0 60.0 30.0\n"},
    {"46042k2025.txt", "#YY  MM DD hh mm   .0330  .0700  .1000  .2000\n2026 01 31 12 40 999.0 40.0 20.0 999.0\n"},
};

static const char datawell[] = "\xef\xbb\xbf"
                               "17\r\n231\r\n7.143\r\n4.5E+0\r\n10.0\r\n8.5\r\n7\r\n0\r\n0\r\n0\r\n40\r\n60\r\n"
                               "0.025,0.000E+00,100.0,70.0,0.1,2.0\r\n0.080,1.000E+00,281.2,20.0,0.1,2.0\r\n"
                               "0.120,4.000E-01,300.0,30.0,0.1,2.0\r\n0.580,1.000E-03,20.0,75.0,0.1,2.0\r\n";

static void make_texts(void)
{
    for (int i = 0; i < 5; i++) {
        write_text(real_time[i][0], real_time[i][1]);
        write_text(archived[i][0], archived[i][1]);
    }
    write_text("buoy.spt", datawell);
}

static int make_files(void **state)
{
    (void)state;
    if (mkdtemp(folder) == NULL)
        return -1;
    make_texts();
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

/* D(f, θ) = (1/π)(1/2 + r1 cos(θ - α1) + r2 cos 2(θ - α2)), without what is below 0. */
static void records_of_ndbc_are_what_they_say(void **state)
{
    (void)state;
    static const char *const names[] = {"46042.data_spec", "46042w2025.txt"};
    for (int k = 0; k < 2; k++) {
        spectrum_table table = load(names[k]);
        assert_int_equal(table.row_count, 4);
        static const double hertz[] = {0.033, 0.07, 0.1, 0.2}, density[] = {0.5, 8, 2, 0.25};
        static const double alpha1[] = {0, 290, 310, 20}, alpha2[] = {0, 292, 300, 40}, r1[] = {0, 0.9, 0.6, 0.3}, r2[] = {0, 0.4, 0.2, 0};
        for (size_t i = 0; i < 4; i++) {
            assert_true(fabs(table.rows[i].frequency / (2 * PI * hertz[i]) - 1) < 1e-8);
            assert_true(fabs(table.rows[i].density * 2 * PI / density[i] - 1) < 1e-6);
            double form[72], sum = 0;
            for (int d = 0; d < 72; d++) {
                form[d] = fmax(0, 0.5 + r1[i] * cos((5 * d - alpha1[i]) * PI / 180) + r2[i] * cos(2 * (5 * d - alpha2[i]) * PI / 180));
                sum += form[d] * 5 * PI / 180;
            }
            for (int d = 0; d < 72; d++)
                assert_true(fabs(share(&table, i, 5 * d) - form[d] / sum) < 1e-6);
        }
        const double to = spectrum_table_mean_azimuth(&table) * 180 / PI;
        if (!(fabs(to - (294 - 180)) < 3))
            fail_msg("%s: waves run to %g", names[k], to);
        spectrum_table_free(&table);
    }
}

/* cos^2s around the direction with the deviation that the file gives. */
static void a_spectrum_of_datawell_is_what_it_says(void **state)
{
    (void)state;
    spectrum_table table = load("buoy.spt");
    assert_int_equal(table.row_count, 4);
    static const double density[] = {0, 4.5, 1.8, 0.0045}, direction[] = {100, 281.2, 300, 20}, deviation[] = {70, 20, 30, 75};
    for (size_t i = 1; i < 4; i++) {
        assert_true(fabs(table.rows[i].density * 2 * PI / density[i] - 1) < 1e-6);
        double x = 0, y = 0;
        for (int d = 0; d < 720; d++) {
            const double angle = (d * 0.5 - direction[i]) * PI / 180, part = share(&table, i, d * 0.5) * 0.5 * PI / 180;
            x += part * cos(angle);
            y += part * sin(angle);
        }
        assert_true(fabs(y) < 2e-3);
        /* The circular deviation √(2 (1 - m1)). */
        if (!(fabs(sqrt(2 * (1 - x)) * 180 / PI / deviation[i] - 1) < 0.02))
            fail_msg("deviation %g, not %g", sqrt(2 * (1 - x)) * 180 / PI, deviation[i]);
    }
    spectrum_table_free(&table);
}

static void bad_files_say_where(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *message;
    } cases[] = {
        {"a.data_spec", "#YY MM DD hh mm Sep_Freq\n", "a.data_spec: there is no record at all; allowed"},
        {"a.data_spec", "#YY MM DD hh mm Sep_Freq\n2026 1 1 1 1 0.1 x (0.1)\n", "a.data_spec:2:18: this is no number; allowed"},
        {"a.data_spec", "#YY MM DD hh mm\n2026 1 1 1 1 0.1 1 (0.1) 1 (0.1)\n", "a.data_spec:2:28: this is no frequency of the spectrum"},
        {"a.data_spec", "#YY MM DD hh mm\n2026 1 1 1 1 0.1 1 (0.1) 1\n", "a.data_spec:2:26: a value has no frequency"},
        {"a.data_spec", "#YY MM DD hh mm\n2026 1 1 1 1 0.1 1 (0.1)\n", "a.data_spec:2:1: there are fewer values than frequencies"},
        {"a.data_spec", "#YY MM DD hh mm\n2026 1 1 1 1 0.1 1 (0.1) 1 (0.2)\n", "a.swdir: No such file"},
        {"b.txt", "#YY MM DD hh mm\n2026 1 1 1 1 0.1 1 (0.1) 1 (0.2)\n", "b.txt: the name does not say where its directions are; allowed: STATION.data_spec"},
        {"46042.swr1", "#YY MM DD hh mm\n2026 01 31 12 40 0.9 (0.033) 0.9 (0.071) 1 (0.1) 1 (0.2)\n", "46042.swr1:2:1: it has other frequencies than"},
        {"46042.data_spec", "#YY MM DD hh mm\n\n2026 01 31 12 40 0.1 0.0 (0.033) 0.0 (0.070) 0.0 (0.1) 0 (0.2)\n",
         "46042.data_spec:3:1: the table holds no waves, every density is 0; allowed: densities above 0 at two frequencies at least"},
        {"46042.data_spec", "#YY MM DD hh mm\n2026 01 31 12 40 0.1 MM (0.033) MM (0.070) MM (0.1) 999 (0.2)\n", "46042.data_spec:2:1: the table holds no rows"},
        {"46042.data_spec", "#YY MM DD hh mm\n2026 01 31 12 40 0.1 MM (0.033) MM (0.070) 3 (0.1) MM (0.2)\n",
         "46042.data_spec:2:1: the table holds only one frequency"},
        {"46042w2025.txt", "#YY MM DD hh mm .0330 .0700 .1000 .2000\n2026 01 31 12 40 0 0 0 0\n", "46042w2025.txt:2:1: the table holds no waves"},
        {"46042i2025.txt", "#YY MM DD hh mm .0330 .0700 .1000 .2100\n2026 01 31 12 40 0 0 0 0\n", "46042i2025.txt:1:1: it has other frequencies than"},
        {"46042.swr1", "#YY MM DD hh mm\n2026 01 31 12 41 0.9 (0.033)\n", "46042.swr1: there is no record of 2026 01 31 12 40; allowed"},
        {"46042.swr1", "nothing\n", "46042.swr1:1:1: the header is missing"},
        {"46042.swr1", "\x01", "46042.swr1:1:1: not a text file"},
        {"1w2025.txt", "#YY MM DD hh mm .1 .2 .3\n2026 1 1 1 1 1 1\n", "1w2025.txt:2:1: there are fewer values than frequencies"},
        {"1w2025.txt", "#YY MM DD hh mm .1 .2\n2026 1 1 1 1 1 1 1\n", "1w2025.txt:2:18: there are more values than frequencies"},
        {"1w2025.txt", "#YY MM DD hh mm .2 .1\n", "1w2025.txt:1:20: this is no frequency of the spectrum"},
        {"a.spt", "1\n2\n3\n", "a.spt:4:1: the file ends before its spectrum"},
        {"a.spt", "1\n2\n3\nmuch\n", "a.spt:4:1: this is no number about the buoy"},
        {"a.spt", "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n0.1,1,90\n", "a.spt:13:9: a number is missing"},
        {"a.spt", "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n0.1,1,90,20\n0.1,1,90,20\n", "a.spt:14:1: these are not frequency, density, direction and spread"},
        {"a.spt", "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n0.1,1,9e9,20\n", "a.spt:13:1: these are not"},
        {"a.spt", "1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n11\n12\n0.1,0,90,20\n0.2,0,90,20\n", "a.spt:13:1: the table holds no waves, every density is 0"},
        {"a.spt", "1\n2\n3\n0\n5\n6\n7\n8\n9\n10\n11\n12\n0.1,1,90,20\n0.2,1,90,20\n", "a.spt:4:1: the greatest density is 0"},
        {"a.spt", "1\n2\n3\n9e3\n5\n6\n7\n8\n9\n10\n11\n12\n0.1,1,90,20\n0.2,900,90,20\n0.3,1,90,20\n",
         "a.spt:14:1: densities such as this one make a wave of"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        spectrum_table table;
        scene_error error = {0};
        write_text(cases[i].name, cases[i].text);
        const bool archive = strncmp(cases[i].name, "46042", 5) == 0 && strstr(cases[i].name, "2025.txt") != NULL;
        const char *load_name = archive ? "46042w2025.txt" : strncmp(cases[i].name, "46042", 5) == 0 ? "46042.data_spec" : cases[i].name;
        if (spectrum_table_load(&table, in_folder(load_name), &error))
            fail_msg("%s is no error", cases[i].text);
        assert_null(table.rows);
        if (strstr(error.text, cases[i].message) == NULL)
            fail_msg("\"%s\" gives \"%s\", not \"%s\"", cases[i].text, error.text, cases[i].message);
        make_texts();
    }
}

/* A byte of a file changed or cut off: an error or another sea, no more. */
static void damaged_files_do_no_harm(void **state)
{
    (void)state;
    static const char *const files[][2] = {{"46042.data_spec", "46042.data_spec"}, {"46042.swr1", "46042.data_spec"}, {"buoy.spt", "buoy.spt"}};
    static const char *const texts[] = {"46042.data_spec", "46042.swr1", "buoy.spt"};
    for (int k = 0; k < 3; k++) {
        const char *text = k == 2 ? datawell : real_time[k == 0 ? 0 : 3][1];
        char *changed = strdup(text);
        const size_t length = strlen(text);
        for (size_t i = 0; i < length; i++) {
            static const char bytes[] = "9\n( -e";
            changed[i] = bytes[i % (sizeof bytes - 1)];
            if (i % 7 == 0)
                changed[i] = '\0';
            write_text(texts[k], changed);
            spectrum_table table;
            scene_error error = {0};
            if (spectrum_table_load(&table, in_folder(files[k][1]), &error))
                spectrum_table_free(&table);
            else
                assert_true(strlen(error.text) > 10);
            changed[i] = text[i];
        }
        write_text(texts[k], text);
        free(changed);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(records_of_ndbc_are_what_they_say),
        cmocka_unit_test(a_spectrum_of_datawell_is_what_it_says),
        cmocka_unit_test(bad_files_say_where),
        cmocka_unit_test(damaged_files_do_no_harm),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
