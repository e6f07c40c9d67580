/* SPDX-License-Identifier: MIT
 * The matrix from CIE XYZ, whose white D65 is (0.95047, 1, 1.08883), to linear sRGB. */
#ifndef MANGATA_BASE_SRGB_MATRIX_H
#define MANGATA_BASE_SRGB_MATRIX_H

static const double srgb_from_xyz[3][3] = {{3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};

#endif
