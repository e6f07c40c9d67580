/* SPDX-License-Identifier: MIT
 * Refraction by a flat surface in double precision: the oracle of kernels/refraction/refract_point.k. */
#ifndef MANGATA_REFERENCE_REFRACTION_H
#define MANGATA_REFERENCE_REFRACTION_H

/*
 * By Fermat's principle: of all paths between a point in air, `above` metres over the surface, and one in water of index n, `below` metres under it,
 * `across` metres apart, the one whose optical length is least. Returns how far along the surface it crosses it, from under the point in air, found
 * by halving. `above` and `below` > 0.
 */
double reference_crossing(double above, double below, double across, double index);

/* The angle of that path's ray in air to the vertical, radians. */
double reference_air_angle(double above, double below, double across, double index);

#endif
