/* SPDX-License-Identifier: MIT
 *
 * The random numbers of src/cpu/tile_job.c, bit for bit: 64-bit words as uvec2(low, high).
 */
#include "base/hash_numbers.h"

uvec2 multiply_64(uvec2 a, uvec2 b)
{
    uvec2 product;
    umulExtended(a.x, b.x, product.y, product.x);
    product.y += a.x * b.y + a.y * b.x;
    return product;
}

uvec2 add_64(uvec2 a, uvec2 b)
{
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

/* x ^ (x >> places), 0 < places < 32. */
uvec2 fold_64(uvec2 x, int places)
{
    return x ^ uvec2(x.x >> places | x.y << (32 - places), x.y >> places);
}

/* The finaliser of SplitMix64. */
uvec2 mix_64(uvec2 x)
{
    x = add_64(x, uvec2(HASH_STEP_LOW, HASH_STEP_HIGH));
    x = multiply_64(fold_64(x, 30), uvec2(HASH_FIRST_LOW, HASH_FIRST_HIGH));
    x = multiply_64(fold_64(x, 27), uvec2(HASH_SECOND_LOW, HASH_SECOND_HIGH));
    return fold_64(x, 31);
}

/* In [0, 1), from the upper 24 bits. */
float unit_64(uvec2 bits) { return float(bits.y >> 8) * 5.9604644775390625e-8f; }
