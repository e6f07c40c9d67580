/* SPDX-License-Identifier: MIT */
#include "base/pixel_budget.h"

#include <stdlib.h>
#include <string.h>

uint64_t pixel_budget(void)
{
    const char *text = getenv(PIXEL_BUDGET_VARIABLE);
    const size_t length = text != NULL ? strlen(text) : 0;
    return length > 0 && length < 19 && strspn(text, "0123456789") == length ? strtoull(text, NULL, 10) : PIXEL_BUDGET_DEFAULT;
}
