/* SPDX-License-Identifier: MIT
 * What foam is made of, for C and GLSL: see src/params/foam.h. */
#ifndef MANGATA_BASE_FOAM_NUMBERS_H
#define MANGATA_BASE_FOAM_NUMBERS_H

#define FOAM_MOMENTS 4    /* that its age is made of; the first is now */
#define FOAM_OCTAVES 7    /* of its patterns */
#define FOAM_SINES 42     /* of a pattern, as many an octave */
#define FOAM_FINE 0.2f    /* deviation of what a pattern has beyond them */
#define FOAM_LONGER 0.45f /* of the slopes' deviation: what counts where faces are seen, see foam_sight() */

#endif
