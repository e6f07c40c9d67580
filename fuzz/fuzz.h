/* SPDX-License-Identifier: MIT
 *
 * Functions that the fuzz targets share. A target is one function that gets the bytes of an input and must neither crash, leak nor hang; fuzz_require() checks
 * whatever else must hold.
 */
#ifndef MANGATA_FUZZ_FUZZ_H
#define MANGATA_FUZZ_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The target: a file of its own for each. */
void fuzz_input(const uint8_t *bytes, size_t size);

/* Calls it within a limit of time. Called by libFuzzer, or by driver.c where there is none. */
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

/* Where `good` is false, ends the process, which the fuzzer reports with the input. */
static inline void fuzz_require(bool good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

/* The input with a NUL behind; the caller frees it. */
static inline char *fuzz_text(const uint8_t *bytes, size_t size)
{
    char *text = malloc(size + 1);
    fuzz_require(text != NULL, "out of memory");
    if (size > 0)
        memcpy(text, bytes, size);
    text[size] = '\0';
    return text;
}

/* A message is one line and says something. */
static inline void fuzz_require_message(const char *text)
{
    fuzz_require(text[0] != '\0', "a refusal without a message");
    fuzz_require(strchr(text, '\n') == NULL, "a message of two lines");
}

#endif
