/* SPDX-License-Identifier: MIT
 * No pixel of water in a boat that rolls, with OpenGL. */
#include "gl/gl_sea.h"
#include "unit/dry_pixels.h"

static void no_pixel_in_the_boat_shows_water(void **state)
{
    (void)state;
    mgt_context *context = gl_context();
    dry_expect_none(context, MGT_SANITIZED ? DRY_FRAMES : 2);
    mgt_context_destroy(context);
}

static void no_specks_along_the_waterline(void **state)
{
    (void)state;
    mgt_context *context = gl_context();
    dry_expect_no_specks(context);
    mgt_context_destroy(context);
}

int main(void)
{
    if (gl_is_missing())
        return 77;
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_pixel_in_the_boat_shows_water), cmocka_unit_test(no_specks_along_the_waterline)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
