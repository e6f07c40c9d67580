/* SPDX-License-Identifier: MIT */
#include "base/pixel_budget.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS_MOST = 18 };

/* Whether the variable is neither empty nor a number that fits. */
static bool is_wrong(const char *text)
{
    const size_t length = strlen(text);
    return length > DIGITS_MOST || strspn(text, "0123456789") != length;
}

static const char *variable(void)
{
    const char *text = getenv(PIXEL_BUDGET_VARIABLE);
    return text != NULL ? text : "";
}

uint64_t pixel_budget(void)
{
    const char *text = variable();
    return text[0] == '\0' ? PIXEL_BUDGET_DEFAULT : is_wrong(text) ? 0 : strtoull(text, NULL, 10);
}

pixel_budget_text pixel_budget_allowed(uint64_t pixels)
{
    pixel_budget_text out;
    if (is_wrong(variable()))
        snprintf(out.text, sizeof out.text, "the environment has %s=%.40s; allowed: a whole number of at most %d digits, such as %d", PIXEL_BUDGET_VARIABLE,
                 variable(), DIGITS_MOST, PIXEL_BUDGET_DEFAULT);
    else
        snprintf(out.text, sizeof out.text, "allowed: %llu, more with %s=%llu in the environment", (unsigned long long)pixel_budget(), PIXEL_BUDGET_VARIABLE,
                 (unsigned long long)pixels);
    return out;
}
