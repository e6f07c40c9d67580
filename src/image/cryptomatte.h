/* SPDX-License-Identifier: MIT */
/* Cryptomatte (specification 1.2) in an EXR: names as 32-bit floats for channels, and the attributes that list the names. */
#ifndef MANGATA_IMAGE_CRYPTOMATTE_H
#define MANGATA_IMAGE_CRYPTOMATTE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/metadata.h"

/* MurmurHash3_x86_32 of the name's bytes, seed 0. */
uint32_t cryptomatte_hash(const char *name);

/* The hash with the exponent of a float that is neither 0, denormal, infinite nor NaN. */
uint32_t cryptomatte_bits(const char *name);

/* The float of these bits, which is the channel's value. */
float cryptomatte_id(const char *name);

enum { CRYPTOMATTE_ENTRIES = 4, CRYPTOMATTE_KEY = 48 };

/* Attributes "cryptomatte/KEY/name", …/hash, …/conversion and …/manifest, a JSON object of names and eight hexadecimal digits. */
typedef struct cryptomatte_header {
    metadata_entry entries[CRYPTOMATTE_ENTRIES];
    char keys[CRYPTOMATTE_ENTRIES][CRYPTOMATTE_KEY];
    char *manifest; /* owned */
} cryptomatte_header;

/* Makes the attributes of a layer, such as "crypto_object", and of the names that it may show. Repeated names are listed once. `layer` is borrowed. The struct
 * must not be copied. False: out of memory. */
bool cryptomatte_header_make(cryptomatte_header *header, const char *layer, const char *const *names, size_t count);
void cryptomatte_header_free(cryptomatte_header *header);

#endif
