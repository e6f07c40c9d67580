/* SPDX-License-Identifier: MIT
 * Refraction by a flat surface in double precision, the reference for kernels/refraction/refract_point.k. */
#ifndef MANGATA_REFERENCE_REFRACTION_H
#define MANGATA_REFERENCE_REFRACTION_H

/* The angle between the vertical and a light path in air, radians. The path goes from a point in air, `above` > 0 metres over the surface, to a point `below` >
 * 0 metres deep in water of the index of refraction `index`. The points are `across` metres apart horizontally. By Fermat's principle the path has the least
 * optical length of all paths. */
double reference_air_angle(double above, double below, double across, double index);

#endif
