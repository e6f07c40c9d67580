/* SPDX-License-Identifier: MIT */
/* How measured values are printed: to the digits that their noise leaves. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "cli/common/numbers.h"

static void test_digits_by_noise(void **state)
{
    (void)state;
    static const struct row {
        double value, noise;
        const char *text;
    } rows[] = {
        {0.0123456, 0.0003, "0.0123"},
        {0.0123456, 0.00099, "0.0123"},
        {0.0123456, 0.004, "0.012"},
        {0.0123456, 0.5, "0.012"},
        {0.0123456, 1e-9, "0.01235"},
        {0.0123456, 0, "0.01235"},
        {0.0123456, NAN, "0.01235"},
        {-0.0123456, 0.0003, "-0.0123"},
        {1.00234, 0.004, "1.002"},
        {1.00234, 0.00004, "1.002"},
        {146.2857, 1.2, "146"},
        {26.6968, 0.14, "26.7"},
        {123456, NAN, "123456"},
        {0, NAN, "0.000"},
        {0, 0.003, "0.0000"},
        {9.9999, 0.01, "10.00"},
        {INFINITY, 1, "-"},
        {NAN, NAN, "-"},
        {1e300, NAN, "1.000e+300"},
        {0.000012345, 0.000001, "0.000012"},
        {1e-300, NAN, "0.000000000000"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        assert_string_equal(number_print_measured(rows[i].value, rows[i].noise).text, rows[i].text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_digits_by_noise)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
