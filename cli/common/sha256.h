/* SPDX-License-Identifier: MIT */
/* SHA-256 (FIPS 180-4), for render hashes. */
#ifndef MANGATA_CLI_COMMON_SHA256_H
#define MANGATA_CLI_COMMON_SHA256_H

#include <stddef.h>

/* 64 lower-case hexadecimal digits and a 0. */
typedef struct sha256_text {
    char text[65];
} sha256_text;

sha256_text sha256(const void *bytes, size_t size);

#endif
