/* SPDX-License-Identifier: MIT
 * SplitMix64's increment and factors, upper and lower half, for C and GLSL. */
#ifndef MANGATA_BASE_HASH_NUMBERS_H
#define MANGATA_BASE_HASH_NUMBERS_H

#define HASH_STEP_HIGH 0x9e3779b9u
#define HASH_STEP_LOW 0x7f4a7c15u
#define HASH_FIRST_HIGH 0xbf58476du
#define HASH_FIRST_LOW 0x1ce4e5b9u
#define HASH_SECOND_HIGH 0x94d049bbu
#define HASH_SECOND_LOW 0x133111ebu

#endif
