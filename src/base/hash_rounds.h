/* SPDX-License-Identifier: MIT
 * Random numbers from 64-bit words, for C and GLSL. The includer defines the type WORD64; HASH, which begins a function; HASH_FLOAT(u), a uint as a float; and
 *     WORD64 word_of(uint high, uint low), word_sum(a, b), word_product(a, b), word_xor(a, b), word_shift(a, places)   0 < places < 32, to the right
 *     uint word_high(a), word_low(a). */
#ifndef MANGATA_BASE_HASH_ROUNDS_H
#define MANGATA_BASE_HASH_ROUNDS_H

/* The step of SplitMix64's state: 2^64 over the golden ratio. */
#define HASH_STEP_HIGH 0x9e3779b9u
#define HASH_STEP_LOW 0x7f4a7c15u

HASH WORD64 word_folded(WORD64 x, int places) { return word_xor(x, word_shift(x, places)); }

/* The finaliser of SplitMix64 with its two rounds. */
HASH WORD64 hash_mixed(WORD64 x)
{
    x = word_product(word_folded(x, 30), word_of(0xbf58476du, 0x1ce4e5b9u));
    x = word_product(word_folded(x, 27), word_of(0x94d049bbu, 0x133111ebu));
    return word_folded(x, 31);
}

/* The output of SplitMix64 after the state x. */
HASH WORD64 hash_of(WORD64 x) { return hash_mixed(word_sum(x, word_of(HASH_STEP_HIGH, HASH_STEP_LOW))); }

/* A uniform number in [0, 1). */
HASH float hash_unit(WORD64 hash) { return HASH_FLOAT(word_high(hash) >> 8) * 5.9604644775390625e-8f; }

/* Key of a sample from the seed and the sample's number. hash_of_pixel() makes the key of a pixel from it. */
HASH WORD64 hash_of_sample(WORD64 seed, WORD64 number) { return hash_of(word_xor(seed, hash_of(number))); }
HASH WORD64 hash_of_pixel(WORD64 key, uint x, uint y) { return hash_of(word_xor(key, word_of(x, y))); }

#endif
