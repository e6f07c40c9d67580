/* SPDX-License-Identifier: MIT
 * Numbers of foam for C and GLSL, see src/params/foam.h. */
#ifndef MANGATA_BASE_FOAM_NUMBERS_H
#define MANGATA_BASE_FOAM_NUMBERS_H

#define FOAM_MOMENTS 4    /* number of moments whose foam is shown; moment 0 is now */
#define FOAM_OCTAVES 7    /* octaves of wavelengths of a foam pattern */
#define FOAM_SINES 42     /* sines of a foam pattern, the same number in each octave */
#define FOAM_FINE 0.2f    /* standard deviation of the part of a pattern that its sines leave out */
#define FOAM_LONGER 0.45f /* fraction of the slopes' standard deviation that counts for the visibility of breaking waves, see foam_sight() */

#endif
