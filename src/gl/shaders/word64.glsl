/* SPDX-License-Identifier: MIT
 *
 * 64-bit words as uvec2(low, high), and the random numbers that are drawn from them.
 */
#define WORD64 uvec2
#define HASH
#define HASH_FLOAT(u) float(u)

uvec2 word_of(uint high, uint low) { return uvec2(low, high); }
uvec2 word_of(int high, int low) { return uvec2(uint(low), uint(high)); }
uint word_high(uvec2 x) { return x.y; }
uint word_low(uvec2 x) { return x.x; }
uvec2 word_xor(uvec2 a, uvec2 b) { return a ^ b; }
uvec2 word_shift(uvec2 x, int places) { return uvec2(x.x >> places | x.y << (32 - places), x.y >> places); }

uvec2 word_product(uvec2 a, uvec2 b)
{
    uvec2 product;
    umulExtended(a.x, b.x, product.y, product.x);
    product.y += a.x * b.y + a.y * b.x;
    return product;
}

uvec2 word_sum(uvec2 a, uvec2 b)
{
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

#include "base/hash_rounds.h"
