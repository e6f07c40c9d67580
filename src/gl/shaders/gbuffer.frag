/* SPDX-License-Identifier: MIT
 *
 * The triangle that a pixel sees; its depth is that of the framebuffer.
 */
layout(location = 0) flat in int triangle;
layout(location = 0) out int seen;

void main()
{
    seen = triangle;
}
