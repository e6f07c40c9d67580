/* SPDX-License-Identifier: MIT */
/* Colours of other primaries. Private to src/image. */
#ifndef MANGATA_IMAGE_EXR_PRIMARIES_H
#define MANGATA_IMAGE_EXR_PRIMARIES_H

#include <openexr.h>
#include <stddef.h>

/* Converts linear RGB of the given chromaticities to the primaries of sRGB, in place; white is adapted by Bradford's matrix. Pixels stay as they are where the
 * chromaticities are those of sRGB or meaningless, and where a value is not finite. */
void exr_primaries_to_srgb(float *rgb, size_t pixels, const exr_attr_chromaticities_t *chromaticities);

#endif
