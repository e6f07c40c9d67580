/* SPDX-License-Identifier: MIT */
/* The hash by Austin Appleby's description of MurmurHash3, and the manifest. */
#include "image/cryptomatte.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t rotate(uint32_t x, int bits) { return x << bits | x >> (32 - bits); }

static uint32_t scramble(uint32_t block) { return rotate(block * 0xcc9e2d51u, 15) * 0x1b873593u; }

uint32_t cryptomatte_hash(const char *name)
{
    const unsigned char *bytes = (const unsigned char *)name;
    const size_t length = strlen(name);
    uint32_t hash = 0, rest = 0;
    for (size_t i = 0; i + 4 <= length; i += 4)
        hash =
            rotate(hash ^ scramble(bytes[i] | (uint32_t)bytes[i + 1] << 8 | (uint32_t)bytes[i + 2] << 16 | (uint32_t)bytes[i + 3] << 24), 13) * 5 + 0xe6546b64u;
    for (size_t i = length; i > length / 4 * 4; i--)
        rest = rest << 8 | bytes[i - 1];
    hash ^= scramble(rest) ^ (uint32_t)length;
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

uint32_t cryptomatte_bits(const char *name)
{
    const uint32_t hash = cryptomatte_hash(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

float cryptomatte_id(const char *name)
{
    const uint32_t bits = cryptomatte_bits(name);
    float id;
    memcpy(&id, &bits, sizeof id);
    return id;
}

static char *manifest_of(const char *const *names, size_t count)
{
    json_t *object = json_object();
    bool good = object != NULL;
    for (size_t i = 0; i < count && good; i++) {
        char digits[9];
        snprintf(digits, sizeof digits, "%08x", cryptomatte_bits(names[i]));
        good = json_object_set_new(object, names[i], json_string(digits)) == 0;
    }
    char *text = good ? json_dumps(object, JSON_COMPACT | JSON_PRESERVE_ORDER) : NULL;
    json_decref(object);
    return text;
}

bool cryptomatte_header_make(cryptomatte_header *header, const char *layer, const char *const *names, size_t count)
{
    header->manifest = manifest_of(names, count);
    if (!header->manifest)
        return false;
    const metadata_entry entries[CRYPTOMATTE_ENTRIES] = {{"name", layer},
                                                         {"hash", "MurmurHash3_32"},
                                                         {"conversion", "uint32_to_float32"},
                                                         {"manifest", header->manifest}};
    for (int i = 0; i < CRYPTOMATTE_ENTRIES; i++) {
        /* The key tells layers apart: seven digits of the hash of the layer's name. */
        snprintf(header->keys[i], CRYPTOMATTE_KEY, "cryptomatte/%07x/%s", cryptomatte_hash(layer) >> 4, entries[i].key);
        header->entries[i] = (metadata_entry){header->keys[i], entries[i].value};
    }
    return true;
}

void cryptomatte_header_free(cryptomatte_header *header)
{
    free(header->manifest);
    header->manifest = NULL;
}
